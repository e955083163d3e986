//! A displaced surface from nothing to a report. In: a device behind any bus, room for a map. Out: lines of text,
//! `name value`, and pictures. Cost: two pictures of 32×24 rays over a map of 64×64.
//!
//! The map is made here, the driver makes pyramid and normals of it on their way to the device. The first picture is found
//! by the paper's hardware, a + b + c1; the second by the folded traversal, in fewer steps (P22, P23).

use core::fmt::{self, Write};

use embedded_hal::delay::DelayNs;
use lucerna_bus::Bus;
use lucerna_driver::displace::records::RESULT_WORDS;
use lucerna_driver::displace::{
    Algorithm, Counter, Counters, Image, ImageError, Job, JobError, Layout, LayoutError, Sizes, channels,
    normal,
};
use lucerna_driver::{Cache, Capabilities, Deadline, Displace, Error, Lucerna};

use crate::fixture::Fnv1a64;
use crate::picture;

pub mod scene;

/// Device memory for the maps and the results: they take 15,712 words.
pub const MEMORY_WORDS: usize = 16 * 1024;
/// The device needs less than a millisecond of its own time for a picture.
const PATIENCE: Deadline = Deadline::millis(100);
/// What of a result record is its colour.
const COLOUR: usize = 4;

/// Buffers of the job: the device makes the rays itself, from the camera.
pub const SIZES: Sizes = Sizes {
    map: scene::SHAPE,
    texture: scene::SHAPE,
    normals: scene::SHAPE,
    rays: 0,
    results: (scene::WIDTH * scene::HEIGHT) as u32,
};

/// Probes the device, draws the picture twice and reports. `heights` is room for the map.
///
/// # Errors
/// A [`SessionError`]; what was reported before stands.
pub fn run<B: Bus, D: DelayNs>(
    bus: B,
    delay: D,
    heights: &mut [u8; scene::TEXELS],
    out: &mut impl Write,
) -> Result<(), SessionError<B::Error>> {
    let mut lucerna = Lucerna::probe(bus, delay)?;
    let device = *lucerna.capabilities();
    describe(&device, out)?;
    let mut unit = lucerna.displace()?;
    let layout = Layout::packed(&device, SIZES)?;
    scene::heights(heights);
    write_maps(&mut unit, &layout, &Image::new(SIZES.map, heights)?)?;
    let mut counted = [Counters::default(); 2];
    for (algorithm, counters) in [Algorithm::Mix, Algorithm::Fold].into_iter().zip(&mut counted) {
        unit.clear_counters()?;
        unit.start(&job(&layout, algorithm)?)?.wait(PATIENCE)?;
        *counters = unit.counters()?;
        report(&mut unit, &layout, algorithm.name(), counters, out)?;
    }
    let [mix, fold] = counted;
    writeln!(out, "saved.steps {}", Saved { before: mix.steps, after: fold.steps })?;
    writeln!(out, "saved.cycles {}", Saved { before: mix.cycles, after: fold.cycles })?;
    Ok(())
}

/// The picture, found by an algorithm.
///
/// # Errors
/// A [`JobError`]; none for a layout of [`SIZES`].
pub fn job(layout: &Layout, algorithm: Algorithm) -> Result<Job, JobError> {
    Job::raster(layout, &scene::CAMERA, &scene::PLANE, algorithm.policies())?
        .with_light(scene::light())
        .map(|job| job.with_background(scene::BACKGROUND))
}

/// What was synthesised.
fn describe(device: &Capabilities, out: &mut impl Write) -> fmt::Result {
    let (major, minor) = device.version;
    writeln!(out, "device.version {major}.{minor}")?;
    writeln!(out, "device.format {}", device.format.name())?;
    writeln!(out, "device.memory_bytes {}", device.memory_bytes)?;
    let Some(unit) = &device.displace else { return Ok(()) };
    writeln!(out, "device.units {}", unit.units)?;
    writeln!(out, "device.stages {}", unit.stages)?;
    writeln!(out, "device.fill_latency {}", unit.fill_latency)?;
    writeln!(out, "device.port_bytes {}", unit.port_bytes)?;
    writeln!(out, "device.fifo0 {}", unit.fifo0)?;
    writeln!(out, "device.fifo1 {}", unit.fifo1)?;
    for (name, Cache { bytes, ways, line_bytes }) in
        [("height_cache", unit.height_cache), ("texture_cache", unit.texture_cache)]
    {
        writeln!(out, "device.{name} {bytes} bytes, {ways} ways, {line_bytes} bytes a line")?;
    }
    Ok(())
}

/// Height map with its pyramid, colours, and normals.
fn write_maps<B: Bus, D: DelayNs>(
    unit: &mut Displace<'_, B, D>,
    layout: &Layout,
    heights: &Image<'_, u8>,
) -> Result<(), Error<B::Error>> {
    unit.write_map(layout, heights)?;
    unit.write_texture_with(layout, scene::texel)?;
    unit.write_normals_with(layout, |x, y| normal(heights.normal_at(x, y, scene::PLANE.height_scale)))
}

/// Counters, the picture and the records' digest.
fn report<B: Bus, D: DelayNs>(
    unit: &mut Displace<'_, B, D>,
    layout: &Layout,
    name: &str,
    counters: &Counters,
    out: &mut impl Write,
) -> Result<(), SessionError<B::Error>> {
    for counter in Counter::ALL {
        writeln!(out, "{name}.{} {}", counter.name(), counters.get(counter))?;
    }
    let mut row = [[0; RESULT_WORDS]; scene::WIDTH];
    let mut digest = Fnv1a64::EMPTY;
    for first in (0..SIZES.results).step_by(scene::WIDTH) {
        unit.read_result_words(layout, first, &mut row)?;
        digest = row.iter().flatten().copied().fold(digest, Fnv1a64::with);
        write!(out, "{name}.picture |")?;
        for record in &row {
            let letter = picture::colour_letter(channels(record[COLOUR]));
            // A letter is about twice as high as it is wide.
            write!(out, "{letter}{letter}")?;
        }
        writeln!(out, "|")?;
    }
    writeln!(out, "{name}.fnv1a64 {:#018x}", digest.value())?;
    Ok(())
}

/// How much less than before, in per cent.
struct Saved {
    before: u64,
    after: u64,
}

impl fmt::Display for Saved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.after > self.before { "-" } else { "" };
        let permille = self.before.abs_diff(self.after) * 1000 / self.before.max(1);
        write!(f, "{sign}{}.{} %", permille / 10, permille % 10)
    }
}

/// Why there is no report, or only the beginning of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SessionError<E> {
    /// The device or the bus failed.
    Device(Error<E>),
    /// The device has not enough memory for the job.
    Layout(LayoutError),
    /// The room for the map is not as large as the map.
    Map(ImageError),
    /// The scene makes no job.
    Job(JobError),
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

impl<E> From<ImageError> for SessionError<E> {
    fn from(error: ImageError) -> Self {
        Self::Map(error)
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
            Self::Map(error) => error.fmt(f),
            Self::Job(error) => error.fmt(f),
            Self::Text => f.write_str("the report could not be written: check where it goes"),
        }
    }
}

impl<E: fmt::Debug> core::error::Error for SessionError<E> {}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::Saved;
    use std::string::ToString;

    #[test]
    fn per_cent_are_cut_and_signed() {
        let saved = |before, after| Saved { before, after }.to_string();
        assert_eq!(saved(1000, 877), "12.3 %");
        assert_eq!(saved(1000, 1001), "-0.1 %");
        assert_eq!(saved(3, 2), "33.3 %");
        assert_eq!(saved(0, 0), "0.0 %");
    }
}
