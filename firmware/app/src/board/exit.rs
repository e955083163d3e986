//! How a program ends. In: a reason. Out: a line on stderr, and a status. Cost: semihosting calls, which need QEMU or a debug
//! probe.
#![allow(unsafe_code)] // The attributes of cortex-m-rt name symbols, and its hard-fault handler is an `unsafe fn`.

use core::fmt::Write;
use core::panic::PanicInfo;

use cortex_m_rt::{ExceptionFrame, exception};
use cortex_m_semihosting::debug;

use super::host::HostStream;

/// Ends with status 0.
pub fn success() -> ! {
    exit(debug::EXIT_SUCCESS)
}

/// Ends with status 1, and says why: in pieces, as core's formatting would add two KiB to every image.
pub fn failure(why: &[&str]) -> ! {
    if let Some(mut stderr) = HostStream::stderr() {
        for piece in why.iter().chain(&["\n"]) {
            // Nobody is left to tell, should it fail.
            let _ = stderr.write_str(piece);
        }
    }
    exit(debug::EXIT_FAILURE)
}

fn exit(status: debug::ExitStatus) -> ! {
    debug::exit(status);
    // A debugger may let the program go on.
    loop {
        cortex_m::asm::wfi();
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    let message = info.message().as_str().unwrap_or("a check failed");
    let (file, line) = info.location().map_or(("an unknown place", 0), |place| (place.file(), place.line()));
    defmt::error!("panic at {=str}:{=u32}: {=str}", file, line, message);
    failure(&["panic at ", file, ":", Digits::of(line, 10).text(), ": ", message])
}

#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    let (at, from) = (frame.pc(), frame.lr());
    defmt::error!("hard fault at {=u32:#x}, called from {=u32:#x}", at, from);
    failure(&["hard fault at 0x", Digits::of(at, 16).text(), ", called from 0x", Digits::of(from, 16).text()])
}

/// A number as text, its digits at the end.
struct Digits([u8; 10]);

impl Digits {
    /// In a base of 10 or more: ten digits suffice for 32 bits.
    fn of(mut number: u32, base: u32) -> Self {
        let mut digits = [b'0'; 10];
        for digit in digits.iter_mut().rev() {
            *digit = b"0123456789abcdef"[(number % base % 16) as usize];
            number /= base;
        }
        Self(digits)
    }

    fn text(&self) -> &str {
        let zeros = self.0.iter().take_while(|digit| **digit == b'0').count().min(self.0.len() - 1);
        core::str::from_utf8(&self.0[zeros..]).unwrap_or_default()
    }
}
