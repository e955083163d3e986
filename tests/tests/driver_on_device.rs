//! Does the driver bring the real device through everything that goes wrong, and back?

use std::convert::Infallible;
use std::future::{Future, pending};
use std::pin::pin;
use std::task::{Context, Poll, Waker};

use embedded_hal::delay::DelayNs;
use embedded_hal::digital::ErrorType;
use embedded_hal_async::digital::Wait;
use lucerna_bus::{Bus, Fault, Faulty, FaultyError, Model, ModelBus, Moment, TargetError, Timing};
use lucerna_driver::{
    Cause, Deadline, DeviceError, Error, ErrorCode, EvaluateJob, Hazard, HitPoint, Layout, Lucerna,
    NumberFormat, Photon, Policies, Progress, Sizes, State, UpdateJob,
};
use lucerna_regs::{ident, interrupts, pree};
use lucerna_tests::devices::{Any, Kind};
use lucerna_tests::inorder;
use lucerna_tests::workload::SMALL;

const KIND: Kind = Kind { preus: 4, format: NumberFormat::F32, soft: false };
const PATIENCE: Deadline = Deadline::millis(100);

/// The first photons of the chip's run, in a ring of `ring` entries.
struct Small {
    points: Vec<HitPoint>,
    photons: Vec<Photon>,
    ring: u32,
}

/// What a run leaves in memory.
#[derive(Clone, PartialEq, Debug)]
struct Results {
    points: Vec<HitPoint>,
    pixels: Vec<[u32; 3]>,
}

impl Small {
    fn new(photons: usize, ring: u32) -> Self {
        Self { points: SMALL.hit_points(), photons: SMALL.photons()[..photons].to_vec(), ring }
    }

    fn sizes(&self) -> Sizes {
        Sizes {
            hit_points: self.points.len() as u32,
            index_entries: SMALL.prepared.grid.entries().len() as u32,
            pixels: SMALL.pixels,
            ring_entries: self.ring,
            normal_test: true,
        }
    }

    fn model(&self, timing: Timing) -> Model<Any> {
        Model::new(KIND.build(vec![0; (self.sizes().bytes() as usize).div_ceil(4)])).with_timing(timing)
    }

    /// By the in-order loop.
    fn expected(&self) -> Results {
        let config = pree::Config::RESET.with_normal_test(true);
        let mut job = SMALL.job(KIND, config);
        job.photons.truncate(self.photons.len());
        let (hits, _) = inorder::update(&job);
        let pixels = inorder::evaluate(&job, &hits);
        let points = hits.iter().map(|words| HitPoint::unpack(KIND.format, words)).collect();
        Results { points, pixels }
    }

    fn prepare<B: Bus, D: DelayNs>(&self, device: &mut Lucerna<B, D>) -> Result<Layout, Error<B::Error>> {
        let layout = Layout::packed(device.capabilities(), self.sizes()).expect("it fits");
        let mut pree = device.pree()?;
        pree.write_hit_points(&layout, 0, &self.points)?;
        pree.write_index(&layout, 0, SMALL.prepared.grid.entries())?;
        pree.zero_pixels(&layout)?;
        Ok(layout)
    }

    fn finish<B: Bus, D: DelayNs>(
        &self,
        device: &mut Lucerna<B, D>,
        layout: &Layout,
    ) -> Result<Results, Error<B::Error>> {
        let mut pree = device.pree()?;
        let job = EvaluateJob::new(layout, SMALL.emitted as f32, Policies::default()).expect("a job");
        pree.evaluate(&job)?.wait(PATIENCE)?;
        self.read(device, layout)
    }

    fn read<B: Bus, D: DelayNs>(
        &self,
        device: &mut Lucerna<B, D>,
        layout: &Layout,
    ) -> Result<Results, Error<B::Error>> {
        let mut pree = device.pree()?;
        let mut results = Results {
            points: vec![HitPoint::default(); self.points.len()],
            pixels: vec![[0; 3]; SMALL.pixels as usize],
        };
        pree.read_hit_points(layout, 0, &mut results.points)?;
        pree.read_pixel_bits(layout, 0, &mut results.pixels)?;
        Ok(results)
    }

    fn run<B: Bus, D: DelayNs>(&self, device: &mut Lucerna<B, D>) -> Result<Results, Error<B::Error>> {
        let layout = self.prepare(device)?;
        let mut pree = device.pree()?;
        let mut stream = pree.update(&update_job(&layout))?;
        stream.push_all(&self.photons, PATIENCE)?;
        stream.finish(PATIENCE)?;
        self.finish(device, &layout)
    }
}

fn update_job(layout: &Layout) -> UpdateJob {
    UpdateJob::new(layout, 0.7, Policies::default()).expect("a job")
}

/// Polls until it is ready. A model's futures wake themselves.
fn block_on<T>(future: impl Future<Output = T>) -> T {
    let mut future = pin!(future);
    let mut context = Context::from_waker(Waker::noop());
    for _ in 0..10_000_000 {
        if let Poll::Ready(output) = future.as_mut().poll(&mut context) {
            return output;
        }
    }
    panic!("it is never ready");
}

#[test]
fn a_clean_run_is_exact_and_so_is_the_next_one() {
    let small = Small::new(300, 64);
    let expected = small.expected();
    for timing in [Timing::Tick, Timing::Fast] {
        let model = small.model(timing);
        let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
        for _ in 0..2 {
            assert_eq!(small.run(&mut device).unwrap(), expected);
            assert_eq!(device.state(), State::Idle);
        }
        let counters = device.counters().unwrap();
        assert_eq!(counters.photons, 600, "they accumulate over jobs");
        device.clear_counters().unwrap();
        assert_eq!(device.counters().unwrap().photons, 0);
    }
}

/// A fault at every access, seen by the device or not: an error that says where it leaves the device, and after a recovery
/// everything is as if nothing had been.
#[test]
fn recovers_from_a_fault_at_any_access() {
    let small = Small::new(24, 8);
    let expected = small.expected();
    let accesses = {
        let model = small.model(Timing::Fast);
        let mut bus = Faulty::new(model.bus(), Fault::Never);
        let mut device = Lucerna::probe(&mut bus, model.delay()).unwrap();
        assert_eq!(small.run(&mut device).unwrap(), expected);
        bus.accesses()
    };
    assert!(accesses > 150, "{accesses}");
    for number in 0..accesses {
        for moment in [Moment::Before, Moment::After] {
            let model = small.model(Timing::Fast);
            let mut bus = Faulty::new(model.bus(), Fault::Nth(number)).at(moment);
            let mut device = match Lucerna::probe(&mut bus, model.delay()) {
                Ok(device) => device,
                Err(error) => {
                    assert_eq!(error.cause, Cause::Bus(FaultyError::Injected));
                    assert_eq!(error.state, State::Untouched);
                    continue;
                }
            };
            let error = small.run(&mut device).expect_err("a fault that nobody saw");
            assert_eq!(error.cause, Cause::Bus(FaultyError::Injected), "access {number} {moment:?}");
            // Only those that leave the device idle may go on without a recovery.
            if matches!(error.state, State::Untouched | State::Idle) {
                assert_eq!(
                    small.run(&mut device).as_ref(),
                    Ok(&expected),
                    "access {number} {moment:?}: not as idle as it said"
                );
            } else {
                let refused = small.run(&mut device).expect_err("a device in no known state");
                assert_eq!(refused.cause, Cause::NotReady);
            }
            device.recover().unwrap();
            assert_eq!(device.state(), State::Idle);
            assert_eq!(small.run(&mut device).as_ref(), Ok(&expected), "access {number} {moment:?}");
        }
    }
}

/// A cable pulled out and put back.
#[test]
fn a_dead_bus_is_no_idle_device() {
    let small = Small::new(24, 8);
    let model = small.model(Timing::Fast);
    for number in (0..140).step_by(7) {
        let mut bus = Faulty::new(model.bus(), Fault::Never);
        let from = bus.accesses() + 6 + number;
        bus.plan(Fault::From(from));
        let Ok(mut device) = Lucerna::probe(&mut bus, model.delay()) else { continue };
        assert!(small.run(&mut device).is_err());
        assert!(device.recover().is_err(), "still dead");
        let (bus, delay) = device.release();
        bus.plan(Fault::Never);
        let mut device = Lucerna::probe(bus, delay).unwrap();
        if device.state() != State::Idle {
            device.recover().unwrap();
        }
        assert_eq!(small.run(&mut device).unwrap(), small.expected());
    }
}

/// A bus whose answers at one register are another device's.
#[derive(Debug)]
struct Lie<'a> {
    bus: ModelBus<'a, Any>,
    offset: u32,
    answer: u32,
}

impl Bus for Lie<'_> {
    type Error = TargetError;
    fn read(&mut self, offset: u32) -> Result<u32, TargetError> {
        if offset == self.offset { Ok(self.answer) } else { self.bus.read(offset) }
    }
    fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError> {
        self.bus.write(offset, value)
    }
    fn read_block(&mut self, address: u32, words: &mut [u32]) -> Result<(), TargetError> {
        self.bus.read_block(address, words)
    }
    fn write_block(&mut self, address: u32, words: &[u32]) -> Result<(), TargetError> {
        self.bus.write_block(address, words)
    }
}

#[test]
fn another_device_is_told_from_this_one() {
    let small = Small::new(1, 1);
    let model = small.model(Timing::Fast);
    let probe = |offset, answer| Lucerna::probe(Lie { bus: model.bus(), offset, answer }, model.delay());
    for id in [0, u32::MAX, ident::ID_RESET ^ 1, ident::ID_RESET.swap_bytes()] {
        let error = probe(ident::ID, id).expect_err("not a Lucerna");
        assert_eq!((error.cause, error.state), (Cause::WrongDevice { id }, State::Untouched));
        assert!(
            error.to_string().contains(&format!("{id:#010x}"))
                || error.to_string().contains(&format!("{id:#x}")),
            "{error}"
        );
    }
    let version = ident::Version::RESET.with_major(2);
    assert_eq!(
        probe(ident::VERSION, version.bits()).expect_err("another map").cause,
        Cause::WrongVersion { major: 2, minor: 1 }
    );
    let bits = ident::Capabilities::RESET.with_preus(4).bits() | 7 << ident::Capabilities::FORMAT.shift;
    let error = probe(ident::CAPABILITIES, bits).expect_err("no such format");
    assert_eq!(error.cause, Cause::Nonsense { offset: ident::CAPABILITIES, bits });
    let bare = ident::Capabilities::RESET.with_preus(4).with_buffer_entries(4).with_units(0).bits();
    let mut device = probe(ident::CAPABILITIES, bare).unwrap();
    assert_eq!(device.pree().map(|_| ()).expect_err("no unit").cause, Cause::NoUnit);
}

#[test]
fn a_layout_of_another_device_is_refused() {
    let small = Small::new(4, 8);
    let other = Model::new(Kind { format: NumberFormat::F24, ..KIND }.build(vec![0; 1 << 15]));
    let layout = {
        let device = Lucerna::probe(other.bus(), other.delay()).unwrap();
        Layout::packed(device.capabilities(), small.sizes()).unwrap()
    };
    let model = small.model(Timing::Fast);
    let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let mut pree = device.pree().unwrap();
    let error = pree.update(&update_job(&layout)).map(|_| ()).expect_err("a foreign layout");
    assert_eq!((error.cause, error.state), (Cause::ForeignLayout, State::Untouched));
}

/// The deadline passes, the job does not mind: it is waited for again.
#[test]
fn a_timeout_leaves_the_job_running() {
    let small = Small::new(300, 512);
    let model = small.model(Timing::Tick);
    let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = small.prepare(&mut device).unwrap();
    {
        let mut pree = device.pree().unwrap();
        let mut stream = pree.update(&update_job(&layout)).unwrap();
        stream.push_all(&small.photons, PATIENCE).unwrap();
        let mut run = stream.flush().unwrap();
        for deadline in [Deadline::NOW, Deadline::micros(1), Deadline::micros(3)] {
            let error = run.wait(deadline).expect_err("it takes longer");
            assert_eq!((error.cause, error.state), (Cause::Timeout, State::Running));
        }
        run.wait(PATIENCE).unwrap();
        assert_eq!(run.poll(), Ok(Progress::Done));
    }
    assert_eq!(small.finish(&mut device, &layout).unwrap(), small.expected());

    // Nobody flushes: a push that finds no room gives up in time, and recovery drops the job.
    let stuck = Small::new(300, 4);
    let model = stuck.model(Timing::Fast);
    let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = stuck.prepare(&mut device).unwrap();
    {
        let mut pree = device.pree().unwrap();
        let stream = pree.update(&update_job(&layout)).unwrap();
        drop(stream);
        let error = pree.zero_pixels(&layout).expect_err("a job runs");
        assert_eq!((error.cause, error.state), (Cause::NotReady, State::Running));
    }
    device.recover().unwrap();
    assert_eq!(stuck.run(&mut device).unwrap(), stuck.expected());
}

/// An earlier owner's job is seen by the probe.
#[test]
fn an_orphaned_job_is_found_and_ended() {
    let small = Small::new(24, 8);
    let model = small.model(Timing::Fast);
    {
        let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
        let layout = small.prepare(&mut device).unwrap();
        let mut pree = device.pree().unwrap();
        let _ = pree.update(&update_job(&layout)).unwrap().push(&small.photons).unwrap();
    }
    let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
    assert_eq!(device.state(), State::Running);
    assert_eq!(small.run(&mut device).expect_err("not ours").cause, Cause::NotReady);
    device.recover().unwrap();
    assert_eq!(small.run(&mut device).unwrap(), small.expected());
}

/// Back-pressure down to one entry, blocking and by the interrupt.
#[test]
fn tiny_rings_take_everything_in_the_end() {
    for ring in [1, 2, 8] {
        let small = Small::new(200, ring);
        let model = small.model(Timing::Fast);
        let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
        let expected = small.expected();
        assert_eq!(small.run(&mut device).unwrap(), expected, "{ring}");

        for low in [0, ring / 2] {
            let layout = small.prepare(&mut device).unwrap();
            let job = update_job(&layout).with_ring_low(low).expect("within the ring");
            let mut pree = device.pree().unwrap();
            let mut stream = pree.update(&job).unwrap();
            block_on(async {
                stream
                    .push_all_on(&small.photons, &mut model.irq(), &mut model.delay(), PATIENCE)
                    .await
                    .unwrap();
                assert_eq!(stream.pushed(), 200);
                let mut run = stream.flush().unwrap();
                run.done(&mut model.irq(), &mut model.delay(), PATIENCE).await.unwrap();
            });
            let job = EvaluateJob::new(&layout, SMALL.emitted as f32, Policies::default()).unwrap();
            let mut run = pree.evaluate(&job).unwrap();
            block_on(run.done(&mut model.irq(), &mut model.delay(), PATIENCE)).unwrap();
            assert_eq!(small.read(&mut device, &layout).unwrap(), expected, "ring {ring}, low {low}");
        }
    }
}

/// A line that was never soldered.
struct Unconnected;

impl ErrorType for Unconnected {
    type Error = Infallible;
}

impl Wait for Unconnected {
    async fn wait_for_high(&mut self) -> Result<(), Infallible> {
        pending().await
    }
    async fn wait_for_low(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
    async fn wait_for_rising_edge(&mut self) -> Result<(), Infallible> {
        pending().await
    }
    async fn wait_for_falling_edge(&mut self) -> Result<(), Infallible> {
        pending().await
    }
    async fn wait_for_any_edge(&mut self) -> Result<(), Infallible> {
        pending().await
    }
}

#[test]
fn a_lost_interrupt_is_reported_and_loses_no_result() {
    let small = Small::new(100, 128);
    let model = small.model(Timing::Fast);
    let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = small.prepare(&mut device).unwrap();
    {
        let mut pree = device.pree().unwrap();
        let mut stream = pree.update(&update_job(&layout)).unwrap();
        stream.push_all(&small.photons, PATIENCE).unwrap();
        let mut run = stream.flush().unwrap();
        let error = block_on(run.done(&mut Unconnected, &mut model.delay(), PATIENCE)).expect_err("no line");
        assert_eq!((error.cause, error.state), (Cause::LostInterrupt, State::Idle));
    }
    assert!(!model.inspect(lucerna_bus::Target::interrupt));
    assert_eq!(small.finish(&mut device, &layout).unwrap(), small.expected());
}

/// What the device finds reaches the caller with code, address and words; recovery brings it back.
#[test]
fn device_errors_are_explained() {
    let small = Small::new(24, 64);
    let model = small.model(Timing::Fast);
    let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
    type Provocation = fn(&mut ModelBus<'_, Any>, &Layout);
    use lucerna_driver::Buffer;
    let provocations: [(ErrorCode, Provocation); 3] = [
        (ErrorCode::HitRange, |bus, layout| {
            let entry = layout.region(Buffer::Index).base() + SMALL.photons()[2].p_addr * 4;
            bus.write_block(entry, &[606]).unwrap();
        }),
        (ErrorCode::PixelRange, |bus, layout| {
            bus.write_block(layout.region(Buffer::HitPoints).base() + 64 * 10 + 56, &[300]).unwrap();
        }),
        (ErrorCode::RingOverrun, |_, _| {}),
    ];
    for (code, provoke) in provocations {
        let layout = small.prepare(&mut device).unwrap();
        provoke(&mut model.bus(), &layout);
        let error = (|| {
            let mut pree = device.pree()?;
            let mut stream = pree.update(&update_job(&layout))?;
            if code == ErrorCode::RingOverrun {
                // Somebody else rings.
                model.bus().write(pree::RING_TAIL, 65).unwrap();
            }
            stream.push_all(&small.photons, PATIENCE)?;
            stream.finish(PATIENCE)?;
            let job = EvaluateJob::new(
                &layout,
                1000.0,
                Policies { hazard: Hazard::Forward, ..Policies::default() },
            )
            .unwrap();
            pree.evaluate(&job)?.wait(PATIENCE)
        })()
        .expect_err("an error was provoked");
        let Cause::Device(DeviceError { code: found, address }) = error.cause else { panic!("{error}") };
        assert_eq!((found, error.state), (code, State::Faulted));
        assert_eq!(address, model.bus().read(pree::FAULT_ADDRESS).unwrap());
        assert!(
            error.to_string().contains(&format!("{address:#x}")) || code == ErrorCode::RingOverrun,
            "{error}"
        );
        assert!(error.to_string().len() > 40, "{error}");
        device.recover().unwrap();
        assert_eq!(model.bus().read(interrupts::STATUS), Ok(0));
        assert_eq!(small.run(&mut device).unwrap(), small.expected());
    }
}

#[test]
fn references_that_lead_nowhere_never_reach_the_device() {
    let small = Small::new(4, 8);
    let model = small.model(Timing::Fast);
    let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = small.prepare(&mut device).unwrap();
    let mut pree = device.pree().unwrap();
    let error = pree.write_index(&layout, 0, &[1, 2, 606]).expect_err("606 hit points");
    assert_eq!((error.cause, error.state), (Cause::BadReference { position: 2 }, State::Untouched));
    let stray = HitPoint { pixel: 300, ..HitPoint::default() };
    let error = pree.write_hit_points(&layout, 0, &[stray]).expect_err("300 pixels");
    assert_eq!(error.cause, Cause::BadReference { position: 0 });
    let error = pree.write_index(&layout, 4_848, &[0]).expect_err("behind the end");
    assert_eq!(error.cause, Cause::OutsideBuffer);
    assert_eq!(small.run(&mut device).unwrap(), small.expected());
}
