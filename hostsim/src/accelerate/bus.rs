//! A bus that is written down or not; in: accesses, out: the same; cost: one branch, and the trace's text where there is one.

use std::cell::RefCell;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use embedded_hal::delay::DelayNs;
use lucerna_bus::{Bus, SharedSink, Traced, TracedDelay};

/// A text file as the sink of a trace.
#[derive(Debug)]
pub struct TraceFile {
    file: BufWriter<File>,
    lines: u64,
}

/// What the last line of a whole trace begins with; the number of lines before it follows.
pub const TRACE_END: &str = "# end of trace, lines: ";

impl TraceFile {
    /// Creates the file and writes what a replay has to know first.
    ///
    /// # Errors
    /// Whatever the file system says.
    pub fn create(path: &Path, header: &str) -> io::Result<Self> {
        let mut file = BufWriter::with_capacity(1 << 20, File::create(path)?);
        writeln!(file, "# {header}")?;
        Ok(Self { file, lines: 1 })
    }

    /// Writes the last line, without which a replay takes the trace for cut off, and all that is buffered.
    ///
    /// # Errors
    /// Whatever the file system says.
    pub fn finish(mut self) -> io::Result<()> {
        writeln!(self.file, "{TRACE_END}{}", self.lines)?;
        self.file.flush()
    }
}

impl core::fmt::Write for TraceFile {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        self.lines += text.bytes().filter(|byte| *byte == b'\n').count() as u64;
        self.file.write_all(text.as_bytes()).map_err(|_| core::fmt::Error)
    }
}

/// The sink that bus and delay write into.
pub type Sink<'a> = SharedSink<'a, TraceFile>;

/// A bus, perhaps traced.
#[derive(Debug)]
pub enum MaybeTraced<'a, B> {
    /// As it is.
    Plain(B),
    /// With every access written down.
    Traced(Traced<B, Sink<'a>>),
}

impl<'a, B: Bus> MaybeTraced<'a, B> {
    /// Traced when there is a file.
    pub fn new(bus: B, trace: Option<&'a RefCell<TraceFile>>) -> Self {
        match trace {
            None => Self::Plain(bus),
            Some(file) => Self::Traced(Traced::new(bus, SharedSink::new(file))),
        }
    }

    /// Lines that the trace lacks because its file did not take them.
    pub const fn lost(&self) -> u64 {
        match self {
            Self::Plain(_) => 0,
            Self::Traced(bus) => bus.lost(),
        }
    }
}

impl<B: Bus> Bus for MaybeTraced<'_, B> {
    type Error = B::Error;

    fn read(&mut self, offset: u32) -> Result<u32, B::Error> {
        match self {
            Self::Plain(bus) => bus.read(offset),
            Self::Traced(bus) => bus.read(offset),
        }
    }
    fn write(&mut self, offset: u32, value: u32) -> Result<(), B::Error> {
        match self {
            Self::Plain(bus) => bus.write(offset, value),
            Self::Traced(bus) => bus.write(offset, value),
        }
    }
    fn read_block(&mut self, address: u32, words: &mut [u32]) -> Result<(), B::Error> {
        match self {
            Self::Plain(bus) => bus.read_block(address, words),
            Self::Traced(bus) => bus.read_block(address, words),
        }
    }
    fn write_block(&mut self, address: u32, words: &[u32]) -> Result<(), B::Error> {
        match self {
            Self::Plain(bus) => bus.write_block(address, words),
            Self::Traced(bus) => bus.write_block(address, words),
        }
    }
}

/// A delay, traced with its bus so that a replay takes the same device time.
#[derive(Debug)]
pub enum MaybeTracedDelay<'a, D> {
    /// As it is.
    Plain(D),
    /// Written down.
    Traced(TracedDelay<D, Sink<'a>>),
}

impl<'a, D: DelayNs> MaybeTracedDelay<'a, D> {
    /// Traced when there is a file.
    pub fn new(delay: D, trace: Option<&'a RefCell<TraceFile>>) -> Self {
        match trace {
            None => Self::Plain(delay),
            Some(file) => Self::Traced(TracedDelay::new(delay, SharedSink::new(file))),
        }
    }
}

impl<D: DelayNs> DelayNs for MaybeTracedDelay<'_, D> {
    fn delay_ns(&mut self, ns: u32) {
        match self {
            Self::Plain(delay) => delay.delay_ns(ns),
            Self::Traced(delay) => delay.delay_ns(ns),
        }
    }
}
