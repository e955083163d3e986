//! A job from file to report. In: a device behind any bus, a fixture. Out: lines of text, `name value`, and the picture.
//! Cost: two passes of the job.
//!
//! The first pass is protected against hazards and tests normals; the second is the engine as published, without either
//! (D7, D8).

use core::fmt::{self, Write};

use embedded_hal::delay::DelayNs;
use lucerna_bus::Bus;
use lucerna_driver::records::decode;
use lucerna_driver::{
    Counter, Deadline, Error, EvaluateJob, Hazard, JobError, Layout, LayoutError, Lucerna, Photon, Policies,
    Pree, Sizes, UpdateJob,
};

use crate::fixture::{Fixture, Fnv1a64};
use crate::picture;

/// Device memory for the fixture of 20×15 pixels: its buffers take 19,000 words.
pub const MEMORY_WORDS: usize = 20 * 1024;
/// Photons in the ring: a few per cent of the job's, so that the driver meets back-pressure.
const RING_ENTRIES: u32 = 256;
/// Elements decoded from the fixture at a time: some KB of stack.
const BLOCK: usize = 32;
/// The widest picture that is drawn.
const WIDTH_MAX: usize = 64;
/// The device needs less than a millisecond of its own time for each step.
const PATIENCE: Deadline = Deadline::millis(100);

/// Probes the device, runs the fixture twice and reports.
///
/// # Errors
/// A [`SessionError`]; what was reported before stands.
pub fn run<B: Bus, D: DelayNs>(
    bus: B,
    delay: D,
    fixture: &Fixture<'_>,
    out: &mut impl Write,
) -> Result<(), SessionError<B::Error>> {
    let mut lucerna = Lucerna::probe(bus, delay)?;
    let device = *lucerna.capabilities();
    let (major, minor) = device.version;
    writeln!(out, "device.version {major}.{minor}")?;
    writeln!(out, "device.format {}", device.format.name())?;
    writeln!(out, "device.preus {}", device.preus)?;
    writeln!(out, "device.buffer_entries {}", device.buffer_entries)?;
    writeln!(out, "device.update_stages {}", device.update_stages)?;
    writeln!(out, "device.evaluate_stages {}", device.evaluate_stages)?;
    writeln!(out, "device.operand_latency {}", device.operand_latency)?;
    writeln!(out, "device.memory_bytes {}", device.memory_bytes)?;
    let mut pree = lucerna.pree()?;
    let passes = [("interlock", Hazard::Interlock, true), ("published", Hazard::Published, false)];
    for (name, hazard, normal_test) in passes {
        let header = fixture.header();
        let sizes = Sizes {
            hit_points: header.hit_points,
            index_entries: header.index_entries,
            pixels: fixture.pixels(),
            ring_entries: RING_ENTRIES,
            normal_test,
        };
        let layout = Layout::packed(&device, sizes)?;
        pass(&mut pree, fixture, &layout, Policies { hazard, ..Policies::default() })?;
        report(&mut pree, fixture, &layout, name, out)?;
    }
    Ok(())
}

/// All photons into the hit points, then all hit points into the pixels.
fn pass<B: Bus, D: DelayNs>(
    pree: &mut Pree<'_, B, D>,
    fixture: &Fixture<'_>,
    layout: &Layout,
    policies: Policies,
) -> Result<(), SessionError<B::Error>> {
    let update = UpdateJob::new(layout, fixture.header().alpha, policies)?;
    let evaluate = EvaluateJob::new(layout, fixture.header().emitted as f32, policies)?;
    pree.clear_counters()?;
    in_blocks(fixture.hit_points(), |first, block| pree.write_hit_points(layout, first, block))?;
    in_blocks(fixture.index(), |first, block| pree.write_index(layout, first, block))?;
    pree.zero_pixels(layout)?;
    let mut stream = pree.update(&update)?;
    in_blocks(fixture.photons(), |_, block: &[Photon]| stream.push_all(block, PATIENCE))?;
    stream.finish(PATIENCE)?;
    pree.evaluate(&evaluate)?.wait(PATIENCE)?;
    Ok(())
}

/// Hands elements on in slices, with the number of each slice's first one.
fn in_blocks<T: Copy + Default, E>(
    mut elements: impl Iterator<Item = T>,
    mut take: impl FnMut(u32, &[T]) -> Result<(), E>,
) -> Result<(), E> {
    let mut block = [T::default(); BLOCK];
    let mut first = 0;
    loop {
        let mut count = 0;
        for (place, element) in block.iter_mut().zip(elements.by_ref()) {
            *place = element;
            count += 1;
        }
        let filled = block.get(..count).unwrap_or(&block);
        if filled.is_empty() {
            return Ok(());
        }
        take(first, filled)?;
        first += count as u32;
    }
}

/// Counters, the pixels' digest and the picture.
fn report<B: Bus, D: DelayNs>(
    pree: &mut Pree<'_, B, D>,
    fixture: &Fixture<'_>,
    layout: &Layout,
    name: &str,
    out: &mut impl Write,
) -> Result<(), SessionError<B::Error>> {
    let counters = pree.counters()?;
    for counter in Counter::ALL {
        writeln!(out, "{name}.{} {}", counter.name(), counters.get(counter))?;
    }
    let mut row = [[0; 3]; WIDTH_MAX];
    let width = fixture.header().width;
    let row = row.get_mut(..width as usize).ok_or(SessionError::TooWide { width })?;
    let mut digest = Fnv1a64::EMPTY;
    for line in 0..fixture.header().height {
        pree.read_pixel_bits(layout, line * width, row)?;
        digest = row.iter().flatten().copied().fold(digest, Fnv1a64::with);
        write!(out, "{name}.picture |")?;
        for pixel in row.iter() {
            let letter = picture::letter(pixel.map(|bits| decode(layout.format(), bits)));
            // A letter is about twice as high as it is wide.
            write!(out, "{letter}{letter}")?;
        }
        writeln!(out, "|")?;
    }
    writeln!(out, "{name}.fnv1a64 {:#018x}", digest.value())?;
    Ok(())
}

/// Why there is no report, or only the beginning of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SessionError<E> {
    /// The device or the bus failed.
    Device(Error<E>),
    /// The device has not enough memory for the job.
    Layout(LayoutError),
    /// The fixture's constants make no job.
    Job(JobError),
    /// The picture is wider than a line.
    TooWide {
        /// Its width in pixels.
        width: u32,
    },
    /// The text could not be written.
    Text,
}

impl<E> From<Error<E>> for SessionError<E> {
    fn from(error: Error<E>) -> Self {
        Self::Device(error)
    }
}

impl<E> From<LayoutError> for SessionError<E> {
    fn from(error: LayoutError) -> Self {
        Self::Layout(error)
    }
}

impl<E> From<JobError> for SessionError<E> {
    fn from(error: JobError) -> Self {
        Self::Job(error)
    }
}

impl<E> From<fmt::Error> for SessionError<E> {
    fn from(_: fmt::Error) -> Self {
        Self::Text
    }
}

impl<E: fmt::Debug> fmt::Display for SessionError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Device(error) => error.fmt(f),
            Self::Layout(error) => error.fmt(f),
            Self::Job(error) => error.fmt(f),
            Self::TooWide { width } => {
                write!(f, "a picture of {width} pixels a line: draw at most {WIDTH_MAX}")
            }
            Self::Text => f.write_str("the report could not be written: check where it goes"),
        }
    }
}

impl<E: fmt::Debug> core::error::Error for SessionError<E> {}
