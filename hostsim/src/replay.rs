//! A bus trace done again; in: its text, out: how many accesses agreed, or the first that did not; cost: the device's cycles.

use std::path::{Path, PathBuf};

use lucerna_bus::{Model, ReplayError, TargetError, replay_timed};
use lucerna_device::PreeDevice;
use lucerna_driver::NumberFormat;
use lucerna_softfloat::Format;

use crate::accelerate::Units;
use crate::accelerate::bus::TRACE_END;
use crate::accelerate::memory::HostMemory;
use crate::accelerate::setup::{self, OnDevice};
use crate::cli::ReplayArgs;

/// Why a trace could not be done again, or came out otherwise.
#[derive(Debug, thiserror::Error)]
pub enum TraceError {
    /// The file.
    #[error("{path} cannot be read as a bus trace: {source}")]
    Read {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The first line.
    #[error(
        "{0} does not begin with `# lucerna bus trace: units 4|8|16 format f32|f24 words N` (N below 2^30): it says which device to build"
    )]
    Header(PathBuf),
    /// The last line.
    #[error(
        "{path} is cut off: its last line does not say `{TRACE_END}{lines}`; trace the run again to its end"
    )]
    CutOff {
        /// Which.
        path: PathBuf,
        /// How many lines it has.
        lines: usize,
    },
    /// A line.
    #[error("{path}: {error}")]
    Line {
        /// Of which trace.
        path: PathBuf,
        /// Which line, and what about it.
        error: Box<ReplayError<TargetError>>,
    },
}

/// The device that a trace was taken from.
struct Header {
    units: Units,
    format: NumberFormat,
    words: usize,
}

impl Header {
    fn parse(line: &str) -> Option<Self> {
        let words: Vec<&str> = line.strip_prefix("# lucerna bus trace: ")?.split_whitespace().collect();
        let ["units", units, "format", format, "words", words] = words[..] else {
            return None;
        };
        Some(Self {
            units: [Units::Four, Units::Eight, Units::Sixteen]
                .into_iter()
                .find(|u| u.count().to_string() == units)?,
            format: NumberFormat::ALL.into_iter().find(|known| known.name() == format)?,
            words: words.parse().ok().filter(|words| *words < 1 << 30)?,
        })
    }
}

/// Does a trace again on a fresh device and compares every word that was read.
///
/// # Errors
/// [`TraceError`].
pub fn run(args: &ReplayArgs) -> Result<String, TraceError> {
    let path = &args.trace;
    let text =
        std::fs::read_to_string(path).map_err(|source| TraceError::Read { path: path.clone(), source })?;
    let first = text.lines().next().unwrap_or_default();
    let mut header = Header::parse(first).ok_or_else(|| TraceError::Header(path.clone()))?;
    if let Some(units) = args.units {
        header.units = units.into();
    }
    check_whole(path, &text)?;
    let (format, units) = (header.format, header.units);
    setup::on_device(format, args.arith.into(), units, Replay { args, words: header.words, text: &text })
}

/// A trace that was written to its end says how many lines it has.
fn check_whole(path: &Path, text: &str) -> Result<(), TraceError> {
    let lines = text.lines().count().saturating_sub(1);
    let said = text.lines().last().and_then(|last| last.strip_prefix(TRACE_END)?.trim().parse().ok());
    if said == Some(lines) { Ok(()) } else { Err(TraceError::CutOff { path: path.to_owned(), lines }) }
}

/// A replay whose device is yet to be built.
struct Replay<'a> {
    args: &'a ReplayArgs,
    words: usize,
    text: &'a str,
}

impl OnDevice for Replay<'_> {
    type Output = Result<String, TraceError>;

    fn on<F: Format, const N: usize>(self) -> Self::Output {
        let Self { args, words, text } = self;
        let device: PreeDevice<F, N, _> = PreeDevice::new(HostMemory::new(words));
        let model = Model::new(device).with_timing(args.timing.into());
        let replayed = replay_timed(text, &mut model.bus(), &mut model.delay())
            .map_err(|error| TraceError::Line { path: args.trace.clone(), error: Box::new(error) })?;
        Ok(format!("{} accesses, all as in the trace; {} cycles", replayed.accesses, model.elapsed()))
    }
}
