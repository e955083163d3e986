//! defmt frames on UART1. In: log calls. Out: bytes. Cost: a wait for room a byte; interrupts are held off for a frame.
#![allow(unsafe_code)] // defmt's logger is an unsafe trait, and the UART is memory-mapped.

use core::cell::UnsafeCell;
use core::sync::atomic::{AtomicBool, Ordering};

use critical_section::RestoreState;

/// The AN386's second CMSDK UART, whose registers are DATA, STATE, CTRL, INTSTATUS and BAUDDIV.
const UART1: *mut u32 = 0x4000_5000 as *mut u32;
/// STATE: the transmit buffer is full.
const TX_FULL: u32 = 1 << 0;
/// CTRL: transmit.
const TX_ENABLE: u32 = 1 << 0;
/// 25 MHz to 115,200 baud.
const DIVISOR: u32 = 25_000_000 / 115_200;

#[defmt::global_logger]
struct Uart;

/// What a frame needs from its begin to its end.
struct Frame {
    restore: RestoreState,
    encoder: defmt::Encoder,
}

struct Shared(UnsafeCell<Frame>);

// SAFETY: it is only used between `acquire` and `release`, with interrupts off, on the only core.
unsafe impl Sync for Shared {}

static FRAME: Shared =
    Shared(UnsafeCell::new(Frame { restore: RestoreState::invalid(), encoder: defmt::Encoder::new() }));
static TAKEN: AtomicBool = AtomicBool::new(false);

/// Sends bytes, whenever there is room.
fn send(bytes: &[u8]) {
    // SAFETY: these are the addresses of UART1, which nothing else uses; the accesses have no other effect.
    unsafe {
        UART1.add(4).write_volatile(DIVISOR);
        UART1.add(2).write_volatile(TX_ENABLE);
        for byte in bytes {
            while UART1.add(1).read_volatile() & TX_FULL != 0 {}
            UART1.write_volatile(u32::from(*byte));
        }
    }
}

// SAFETY: `acquire` takes a critical section and `release` ends it; a second `acquire` between them panics.
unsafe impl defmt::Logger for Uart {
    fn acquire() {
        // SAFETY: `release` is called for every `acquire`, in order: defmt's contract.
        let restore = unsafe { critical_section::acquire() };
        assert!(!TAKEN.swap(true, Ordering::Relaxed), "a log call inside a log call");
        // SAFETY: TAKEN says that nobody else has the frame.
        let frame = unsafe { &mut *FRAME.0.get() };
        frame.restore = restore;
        frame.encoder.start_frame(send);
    }

    unsafe fn write(bytes: &[u8]) {
        // SAFETY: the caller has acquired the logger, and with it the frame.
        let frame = unsafe { &mut *FRAME.0.get() };
        frame.encoder.write(bytes, send);
    }

    unsafe fn flush() {}

    unsafe fn release() {
        // SAFETY: the caller has acquired the logger, and with it the frame.
        let frame = unsafe { &mut *FRAME.0.get() };
        frame.encoder.end_frame(send);
        TAKEN.store(false, Ordering::Relaxed);
        // SAFETY: the section taken by `acquire`.
        unsafe { critical_section::release(frame.restore) };
    }
}
