//! One update and one evaluation, through the driver; in: hit points, index table, photons in chunks, out: what the device made
//! of them; cost: the engine's cycles.

use std::cell::RefCell;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use lucerna_bus::{Bus, Model, TargetError};
use lucerna_device::PreeDevice;
use lucerna_driver::records::HIT_POINT_WORDS;
use lucerna_driver::{
    Buffer, Capabilities, Counters, Deadline, Error, EvaluateJob, HitPoint as HitRecord, JobError, Layout,
    LayoutError, Lucerna, Photon, Sizes, UpdateJob,
};
use lucerna_softfloat::Format;

use super::bus::{MaybeTraced, MaybeTracedDelay, TraceFile};
use super::memory::{self, HostMemory};
use super::setup::{self, OnDevice, Setup};
use crate::grid::HashGrid;
use crate::oracle::State;
use crate::trace::{HitPoint, PhotonChunk};

/// α of the published program.
pub const ALPHA: f32 = 0.7;

/// Device time that one chunk of photons, or an evaluation, may take.
const DEADLINE: Deadline = Deadline::seconds(3600);

/// What the device works on.
#[derive(Clone, Copy, Debug)]
pub struct Workload<'a> {
    /// In order of their numbers.
    pub points: &'a [HitPoint],
    /// Their index table and search radius.
    pub grid: &'a HashGrid,
    /// Pixels of the picture.
    pub pixels: u32,
    /// Photons emitted in all.
    pub emitted: u32,
}

/// Where the photons come from, in order.
pub trait PhotonSource {
    /// The next chunk; `None` at the end. Its time is not the device's.
    fn next_chunk(&mut self) -> Option<&PhotonChunk>;
}

/// What the device gave back.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// What it said it is.
    pub capabilities: Capabilities,
    /// Counted during the update.
    pub update: Counters,
    /// Counted during the evaluation.
    pub evaluate: Counters,
    /// Every hit point's accumulated words, in the device's format.
    pub states: Vec<State>,
    /// Every pixel's bits, in the device's format.
    pub pixel_bits: Vec<[u32; 3]>,
    /// The same as numbers.
    pub pixels: Vec<[f32; 3]>,
    /// Host time from the first write to the last read, photons' tracing not included.
    pub host_time: Duration,
}

impl Outcome {
    /// The pixels as the tone map takes them.
    pub fn radiance(&self) -> Vec<[f64; 3]> {
        self.pixels.iter().map(|pixel| pixel.map(f64::from)).collect()
    }
}

/// Why there is no outcome.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// More memory than 32-bit addresses reach.
    #[error(
        "the job needs {0} bytes of device memory, more than 32-bit addresses reach: make the picture smaller"
    )]
    TooLarge(u64),
    /// The buffers could not be laid out.
    #[error("the job's buffers cannot be laid out: {0}")]
    Layout(#[from] LayoutError),
    /// The job could not be expressed.
    #[error("the job is not one the device has: {0}")]
    Job(#[from] JobError),
    /// The driver gave up.
    #[error("the driver reports: {0}")]
    Driver(#[from] Error<TargetError>),
    /// The bus, outside the driver.
    #[error("the device does not answer: {0}")]
    Bus(TargetError),
    /// The trace's file.
    #[error(
        "the bus trace {path} cannot be written: {source}; name a file in a folder that is there, on a disk with room"
    )]
    Trace {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

/// Builds the device that `setup` names and runs the workload on it.
///
/// # Errors
/// [`RunError`].
pub fn run(
    setup: &Setup,
    workload: &Workload<'_>,
    source: &mut dyn PhotonSource,
) -> Result<Outcome, RunError> {
    let (format, arith, units) = (setup.format, setup.arith, setup.units);
    setup::on_device(format, arith, units, Session { setup, workload, source })
}

/// A run whose device is yet to be built.
struct Session<'a> {
    setup: &'a Setup,
    workload: &'a Workload<'a>,
    source: &'a mut dyn PhotonSource,
}

impl OnDevice for Session<'_> {
    type Output = Result<Outcome, RunError>;

    fn on<F: Format, const N: usize>(self) -> Self::Output {
        let Self { setup, workload, source } = self;
        let sizes = Sizes {
            hit_points: workload.points.len() as u32,
            index_entries: workload.grid.entries().len() as u32,
            pixels: workload.pixels,
            ring_entries: setup.ring_entries,
            normal_test: setup.normal_test,
        };
        let bytes = sizes.bytes();
        let words = memory::words(bytes).ok_or(RunError::TooLarge(bytes))?;
        let device: PreeDevice<F, N, _> = PreeDevice::new(HostMemory::new(words));
        let model = Model::new(device).with_timing(setup.timing);
        let header = header(setup, words);
        let path = setup.bus_trace.as_deref();
        let failed = |source| RunError::Trace { path: path.unwrap_or(Path::new("")).to_owned(), source };
        let trace = path
            .map(|path| TraceFile::create(path, &header).map(RefCell::new))
            .transpose()
            .map_err(failed)?;
        let mut bus = MaybeTraced::new(model.bus(), trace.as_ref());
        let delay = MaybeTracedDelay::new(model.delay(), trace.as_ref());
        let outcome = drive(&mut bus, delay, sizes, setup, workload, source)?;
        if bus.lost() > 0 {
            return Err(failed(io::Error::other(format!("{} lines were not taken", bus.lost()))));
        }
        if let Some(trace) = trace {
            trace.into_inner().finish().map_err(failed)?;
        }
        Ok(outcome)
    }
}

/// What `hostsim replay` has to know to build the same device.
fn header(setup: &Setup, words: usize) -> String {
    let (units, format) = (setup.units.count(), setup.format.name());
    format!("lucerna bus trace: units {units} format {format} words {words}")
}

fn drive(
    bus: &mut MaybeTraced<'_, impl Bus<Error = TargetError>>,
    delay: impl embedded_hal::delay::DelayNs,
    sizes: Sizes,
    setup: &Setup,
    workload: &Workload<'_>,
    source: &mut dyn PhotonSource,
) -> Result<Outcome, RunError> {
    let started = Instant::now();
    let mut lucerna = Lucerna::probe(bus, delay)?;
    let capabilities = *lucerna.capabilities();
    let layout = Layout::packed(&capabilities, sizes)?;
    let update_job = UpdateJob::new(&layout, ALPHA, setup.policies)?;
    let evaluate_job = EvaluateJob::new(&layout, workload.emitted as f32, setup.policies)?;
    lucerna.clear_counters()?;

    let mut pree = lucerna.pree()?;
    write_hit_points(workload, |first, records| pree.write_hit_points(&layout, first, records))?;
    pree.write_index(&layout, 0, workload.grid.entries())?;
    pree.zero_pixels(&layout)?;

    let mut host_time = started.elapsed();
    let mut photons = Vec::new();
    let mut stream = pree.update(&update_job)?;
    while let Some(chunk) = source.next_chunk() {
        let started = Instant::now();
        photons.clear();
        photons.extend(chunk.hits.iter().zip(&chunk.lists).map(|(hit, list)| Photon {
            position: hit.position.to_f32(),
            normal: hit.normal.to_f32(),
            flux: hit.flux.to_f32(),
            p_addr: list.p_addr,
            n: list.n,
        }));
        stream.push_all(&photons, DEADLINE)?;
        host_time += started.elapsed();
    }
    let started = Instant::now();
    stream.finish(DEADLINE)?;
    let update = pree.counters()?;

    pree.clear_counters()?;
    pree.evaluate(&evaluate_job)?.wait(DEADLINE)?;
    let evaluate = pree.counters()?;

    let mut pixels = vec![[0.0; 3]; workload.pixels as usize];
    pree.read_pixels(&layout, 0, &mut pixels)?;
    host_time += started.elapsed();
    let mut pixel_bits = vec![[0; 3]; workload.pixels as usize];
    pree.read_pixel_bits(&layout, 0, &mut pixel_bits)?;

    let (mut bus, _) = lucerna.release();
    let states = read_states(&mut bus, layout.region(Buffer::HitPoints).base(), workload.points.len())
        .map_err(RunError::Bus)?;
    Ok(Outcome { capabilities, update, evaluate, states, pixel_bits, pixels, host_time })
}

/// Writes the hit points as they are before the first photon, some at a time.
fn write_hit_points<E>(
    workload: &Workload<'_>,
    mut write: impl FnMut(u32, &[HitRecord]) -> Result<(), E>,
) -> Result<(), E> {
    const BATCH: usize = 4096;
    let radius_squared = (workload.grid.radius() * workload.grid.radius()) as f32;
    let mut first = 0;
    for points in workload.points.chunks(BATCH) {
        let records: Vec<HitRecord> = points
            .iter()
            .map(|point| HitRecord {
                position: point.position.to_f32(),
                normal: point.normal.to_f32(),
                colour: point.colour.to_f32(),
                radius_squared,
                pixel: point.pixel,
                ..HitRecord::default()
            })
            .collect();
        write(first, &records)?;
        first += points.len() as u32;
    }
    Ok(())
}

/// Every hit point's accumulated words just as they are in memory, to be compared with the oracle's.
fn read_states<B: Bus>(bus: &mut B, base: u32, count: usize) -> Result<Vec<State>, B::Error> {
    let mut words = vec![0; count * HIT_POINT_WORDS];
    bus.read_block(base, &mut words)?;
    let (records, _) = words.as_chunks::<HIT_POINT_WORDS>();
    let state = |record: &[u32; HIT_POINT_WORDS]| State {
        flux: [record[9], record[10], record[11]],
        r2: record[12],
        n: record[13],
    };
    Ok(records.iter().map(state).collect())
}
