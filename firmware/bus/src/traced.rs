//! A bus which writes down what it does. In: accesses. Out: the inner bus's answers, and a line of text each.
//! Cost: the formatting of a line; nothing is held back.
//!
//! The text, all numbers hexadecimal but the delay's:
//!
//! | line | access |
//! |---|---|
//! | `r OFFSET VALUE` | register read, answered |
//! | `w OFFSET VALUE` | register write |
//! | `R ADDRESS WORD…` | block read, answered |
//! | `W ADDRESS WORD…` | block write |
//! | `r OFFSET !`, `w OFFSET VALUE !`, `R ADDRESS LENGTH !`, `W ADDRESS WORD… !` | the same, failed |
//! | `d NANOSECONDS` | a delay, by [`TracedDelay`] |
//! | `# …` or nothing | a remark; [`replay`](crate::replay) skips it |

use core::cell::RefCell;
use core::fmt::{self, Write};

use embedded_hal::delay::DelayNs;

use crate::Bus;

/// Wraps a bus and writes a line an access into a sink.
///
/// A sink that fails does not disturb the device: the line is lost, and counted.
#[derive(Clone, Debug)]
pub struct Traced<B, W> {
    bus: B,
    sink: W,
    lost: u64,
}

impl<B: Bus, W: Write> Traced<B, W> {
    /// Writes the accesses to `bus` into `sink`.
    pub const fn new(bus: B, sink: W) -> Self {
        Self { bus, sink, lost: 0 }
    }

    /// Lines the sink did not take: a trace is whole only if this is 0.
    pub const fn lost(&self) -> u64 {
        self.lost
    }

    /// The sink, to write a remark (a line that begins with `#`) or look at the text.
    pub const fn sink(&mut self) -> &mut W {
        &mut self.sink
    }

    /// The bus and the sink.
    pub fn into_parts(self) -> (B, W) {
        (self.bus, self.sink)
    }

    fn line(&mut self, write: impl FnOnce(&mut W) -> fmt::Result) {
        self.lost += u64::from(write(&mut self.sink).is_err());
    }
}

/// `" !"` after a failed access.
fn mark<T, E>(result: &Result<T, E>) -> &'static str {
    if result.is_ok() { "" } else { " !" }
}

fn words(sink: &mut impl Write, words: &[u32]) -> fmt::Result {
    words.iter().try_for_each(|word| write!(sink, " {word:x}"))
}

impl<B: Bus, W: Write> Bus for Traced<B, W> {
    type Error = B::Error;

    fn read(&mut self, offset: u32) -> Result<u32, B::Error> {
        let result = self.bus.read(offset);
        self.line(|sink| match result {
            Ok(value) => writeln!(sink, "r {offset:x} {value:x}"),
            Err(_) => writeln!(sink, "r {offset:x} !"),
        });
        result
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), B::Error> {
        let result = self.bus.write(offset, value);
        self.line(|sink| writeln!(sink, "w {offset:x} {value:x}{}", mark(&result)));
        result
    }

    fn read_block(&mut self, address: u32, block: &mut [u32]) -> Result<(), B::Error> {
        let result = self.bus.read_block(address, block);
        self.line(|sink| {
            if result.is_err() {
                return writeln!(sink, "R {address:x} {:x} !", block.len());
            }
            write!(sink, "R {address:x}")?;
            words(sink, block)?;
            writeln!(sink)
        });
        result
    }

    fn write_block(&mut self, address: u32, block: &[u32]) -> Result<(), B::Error> {
        let result = self.bus.write_block(address, block);
        self.line(|sink| {
            write!(sink, "W {address:x}")?;
            words(sink, block)?;
            writeln!(sink, "{}", mark(&result))
        });
        result
    }
}

/// Wraps a delay and writes its lines into the same text, so that a replay takes the same device time.
#[derive(Clone, Debug)]
pub struct TracedDelay<D, W> {
    delay: D,
    sink: W,
}

impl<D: DelayNs, W: Write> TracedDelay<D, W> {
    /// Writes the delays of `delay` into `sink`, commonly a [`SharedSink`].
    pub const fn new(delay: D, sink: W) -> Self {
        Self { delay, sink }
    }
}

impl<D: DelayNs, W: Write> DelayNs for TracedDelay<D, W> {
    fn delay_ns(&mut self, ns: u32) {
        self.delay.delay_ns(ns);
        // A sink that fails loses accesses too, and those are counted.
        let _ = writeln!(self.sink, "d {ns}");
    }
}

/// One sink for a [`Traced`] bus and a [`TracedDelay`].
#[derive(Debug)]
pub struct SharedSink<'a, W>(&'a RefCell<W>);

impl<'a, W> SharedSink<'a, W> {
    /// A handle on `sink`.
    pub const fn new(sink: &'a RefCell<W>) -> Self {
        Self(sink)
    }
}

impl<W> Clone for SharedSink<'_, W> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<W> Copy for SharedSink<'_, W> {}

impl<W: Write> Write for SharedSink<'_, W> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.try_borrow_mut().map_err(|_| fmt::Error)?.write_str(text)
    }
}
