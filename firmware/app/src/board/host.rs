//! The host's stdout and stderr. In: text. Out: the same, on the host. Cost: a semihosting call.
//!
//! `cortex_m_semihosting::hio` tries for ever when the host takes nothing, as QEMU does once its stdout is a closed pipe; this
//! stream gives up.
#![allow(unsafe_code)] // A semihosting call passes a pointer to the debugger.

use core::fmt;

use cortex_m_semihosting::{nr, syscall};

/// An open stream of the host.
#[derive(Debug)]
pub struct HostStream {
    handle: usize,
}

impl HostStream {
    /// The host's stdout, if semihosting is on.
    pub fn stdout() -> Option<Self> {
        Self::open(nr::open::W_TRUNC)
    }

    /// The host's stderr, by the convention that appending to the terminal means it.
    pub fn stderr() -> Option<Self> {
        Self::open(nr::open::W_APPEND)
    }

    fn open(mode: usize) -> Option<Self> {
        const TERMINAL: &[u8] = b":tt\0";
        // SAFETY: the name ends with a zero, which its length leaves out, and lives for ever.
        let handle = unsafe { syscall!(OPEN, TERMINAL.as_ptr(), mode, TERMINAL.len() - 1) };
        (handle as isize != -1).then_some(Self { handle })
    }
}

impl fmt::Write for HostStream {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let mut rest = text.as_bytes();
        while !rest.is_empty() {
            // SAFETY: pointer and length are those of a slice that outlives the call, which only reads it.
            let left = unsafe { syscall!(WRITE, self.handle, rest.as_ptr(), rest.len()) };
            // The call says how much it left over; all of it, or more than there was, is an error.
            let taken = rest.len().checked_sub(left).filter(|taken| *taken > 0).ok_or(fmt::Error)?;
            rest = rest.get(taken..).unwrap_or_default();
        }
        Ok(())
    }
}
