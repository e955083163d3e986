//! Traces, executed again. In: the text of a [`Traced`](crate::Traced) bus, a bus. Out: how much was done, or
//! the first line that is malformed or answered differently. Cost: the accesses; 8 KiB of stack.

use core::fmt;
use core::num::IntErrorKind;
use core::str::SplitAsciiWhitespace;

use embedded_hal::delay::DelayNs;

use crate::Bus;

/// Words of a block in one access; a longer line becomes several (the driver's blocks are shorter).
const BLOCK: usize = 1024;

/// What a replay has done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Replayed {
    /// Accesses made again, and answered as before.
    pub accesses: u64,
    /// Delays found in the text, in nanoseconds.
    pub delay_ns: u64,
}

/// A line that could not be replayed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ReplayError<E> {
    /// The line's number, from 1.
    pub line: usize,
    /// What is wrong with it.
    pub kind: ReplayErrorKind<E>,
}

/// What is wrong with a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ReplayErrorKind<E> {
    /// It is no line of a trace.
    Malformed(Malformed),
    /// A read answers something else than in the trace.
    Differs {
        /// Offset or address of the word.
        address: u32,
        /// What the trace says.
        traced: u32,
        /// What the device says now.
        now: u32,
    },
    /// The access failed now, not in the trace.
    Bus(E),
    /// The access failed in the trace, not now.
    Succeeds,
}

/// Why a line is no line of a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Malformed {
    /// It begins with none of `r w R W d #`.
    Kind,
    /// It ends before its last field.
    Short,
    /// It goes on after its last field.
    Long,
    /// A field is not a number.
    Number,
    /// A number does not fit into 32 bits.
    TooLarge,
}

impl fmt::Display for Malformed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Kind => "it must begin with r, w, R, W, d or #",
            Self::Short => "a field is missing",
            Self::Long => "it has too many fields",
            Self::Number => "a field is not a number (hexadecimal; decimal after d)",
            Self::TooLarge => "a number does not fit into 32 bits",
        })
    }
}

impl<E: fmt::Debug> fmt::Display for ReplayError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: ", self.line)?;
        match &self.kind {
            ReplayErrorKind::Malformed(why) => why.fmt(f),
            ReplayErrorKind::Differs { address, traced, now } => {
                write!(f, "{address:#x} reads {now:#x}, but {traced:#x} in the trace")
            }
            ReplayErrorKind::Bus(error) => write!(f, "the access fails: {error:?}"),
            ReplayErrorKind::Succeeds => f.write_str("the access succeeds, but failed in the trace"),
        }
    }
}

impl<E: fmt::Debug> core::error::Error for ReplayError<E> {}

/// Makes the accesses of `text` again on `bus`, and checks what the reads answer. Delays are only summed up.
pub fn replay<B: Bus>(text: &str, bus: &mut B) -> Result<Replayed, ReplayError<B::Error>> {
    replay_timed(text, bus, &mut NoDelay)
}

/// As [`replay`], with the delays of the trace: on a model, the same device time passes.
pub fn replay_timed<B: Bus>(
    text: &str,
    bus: &mut B,
    delay: &mut impl DelayNs,
) -> Result<Replayed, ReplayError<B::Error>> {
    let mut done = Replayed::default();
    for (index, line) in text.lines().enumerate() {
        execute(line, bus, delay, &mut done).map_err(|kind| ReplayError { line: index + 1, kind })?;
    }
    Ok(done)
}

struct NoDelay;

impl DelayNs for NoDelay {
    fn delay_ns(&mut self, _: u32) {}
}

fn execute<B: Bus>(
    line: &str,
    bus: &mut B,
    delay: &mut impl DelayNs,
    done: &mut Replayed,
) -> Result<(), ReplayErrorKind<B::Error>> {
    // `!` is always last: a failed access.
    let line = line.trim_ascii();
    let (body, failed) = match line.strip_suffix('!') {
        Some(body) if !line.starts_with('#') => (body, true),
        _ => (line, false),
    };
    let mut fields = Fields(body.split_ascii_whitespace());
    match fields.0.next() {
        None if !failed => return Ok(()),
        Some("d") if !failed => {
            let ns = fields.number(10)?;
            fields.end()?;
            delay.delay_ns(ns);
            done.delay_ns += u64::from(ns);
            return Ok(());
        }
        Some("r") => {
            let offset = fields.number(16)?;
            let traced = if failed { None } else { Some(fields.number(16)?) };
            fields.end()?;
            outcome(bus.read(offset), failed)?
                .zip(traced)
                .map_or(Ok(()), |(now, traced)| same(offset, traced, now))?;
        }
        Some("w") => {
            let (offset, value) = (fields.number(16)?, fields.number(16)?);
            fields.end()?;
            outcome(bus.write(offset, value), failed)?;
        }
        Some("R") if failed => {
            let (address, length) = (fields.number(16)?, fields.number(16)?);
            fields.end()?;
            let mut block = [0; BLOCK];
            let (block, _) = block.split_at_mut((length as usize).min(BLOCK));
            outcome(bus.read_block(address, block), failed)?;
        }
        Some("R") => fields.blocks(failed, |address, traced| {
            let mut block = [0; BLOCK];
            let (block, _) = block.split_at_mut(traced.len());
            bus.read_block(address, block).map_err(ReplayErrorKind::Bus)?;
            let places = (0..).map(|index: u32| address.wrapping_add(4 * index));
            places
                .zip(traced.iter().zip(block))
                .try_for_each(|(address, (traced, now))| same(address, *traced, *now))
        })?,
        Some("W") => fields
            .blocks(failed, |address, block| outcome(bus.write_block(address, block), failed).map(|_| ()))?,
        Some(word) if word.starts_with('#') => return Ok(()),
        _ => return Err(ReplayErrorKind::Malformed(Malformed::Kind)),
    }
    done.accesses += 1;
    Ok(())
}

/// The value of an access that succeeded then and now; nothing if it failed both times.
fn outcome<T, E>(result: Result<T, E>, failed: bool) -> Result<Option<T>, ReplayErrorKind<E>> {
    match (result, failed) {
        (Ok(value), false) => Ok(Some(value)),
        (Ok(_), true) => Err(ReplayErrorKind::Succeeds),
        (Err(error), false) => Err(ReplayErrorKind::Bus(error)),
        (Err(_), true) => Ok(None),
    }
}

fn same<E>(address: u32, traced: u32, now: u32) -> Result<(), ReplayErrorKind<E>> {
    if traced == now { Ok(()) } else { Err(ReplayErrorKind::Differs { address, traced, now }) }
}

/// The fields of a line after its kind.
struct Fields<'a>(SplitAsciiWhitespace<'a>);

impl Fields<'_> {
    fn number<E>(&mut self, radix: u32) -> Result<u32, ReplayErrorKind<E>> {
        let field = self.0.next().ok_or(ReplayErrorKind::Malformed(Malformed::Short))?;
        number(field, radix).map_err(ReplayErrorKind::Malformed)
    }

    fn end<E>(&mut self) -> Result<(), ReplayErrorKind<E>> {
        if self.0.next().is_none() { Ok(()) } else { Err(ReplayErrorKind::Malformed(Malformed::Long)) }
    }

    /// Address and words; hands the words on in blocks, after all of them are known to be well-formed. An
    /// empty block is an access too.
    fn blocks<E>(
        mut self,
        failed: bool,
        mut act: impl FnMut(u32, &[u32]) -> Result<(), ReplayErrorKind<E>>,
    ) -> Result<(), ReplayErrorKind<E>> {
        let mut address = self.number(16)?;
        for field in self.0.clone() {
            number(field, 16).map_err(ReplayErrorKind::Malformed)?;
        }
        let mut block = [0; BLOCK];
        let mut filled = 0;
        let mut acted = false;
        loop {
            let field = self.0.next();
            if filled == BLOCK || (field.is_none() && (filled > 0 || !acted)) {
                act(address, &block[..filled])?;
                acted = true;
                address = address.wrapping_add(4 * filled as u32);
                filled = 0;
                // One failed access is all a failed line stands for.
                if failed {
                    return Ok(());
                }
            }
            let Some(field) = field else { return Ok(()) };
            block[filled] = number(field, 16).map_err(ReplayErrorKind::Malformed)?;
            filled += 1;
        }
    }
}

/// Digits only: `from_str_radix` alone would take a sign too.
fn number(field: &str, radix: u32) -> Result<u32, Malformed> {
    if !field.chars().all(|digit| digit.is_digit(radix)) {
        return Err(Malformed::Number);
    }
    u32::from_str_radix(field, radix).map_err(|error| match error.kind() {
        IntErrorKind::PosOverflow => Malformed::TooLarge,
        _ => Malformed::Number,
    })
}
