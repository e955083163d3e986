//! The evaluation pass, cycle by cycle; in: refined hit points, out: their radiance added to their pixels; cost: N hit
//! points a cycle, 4 + 12 cycles from an address to its pixel.

use lucerna_fabric::delay::Delay;
use lucerna_fabric::inflight::InFlight;
use lucerna_softfloat::Format;

use crate::allocation::Addresses;
use crate::counters::Counters;
use crate::hazard::{EVALUATE_BYPASS, Verdict};
use crate::job::{EvaluateJob, Fault, FaultCode};
use crate::preu;
use crate::preu::components::EVALUATE_STAGES;
use crate::record::{self, Accumulated};
use crate::update::{Progress, READ_LATENCY};

/// An evaluation job at work on `N` PREUs.
#[derive(Clone, Debug)]
pub struct EvaluatePass<F, const N: usize> {
    job: EvaluateJob<F>,
    inverse_pi: F,
    addresses: Addresses<N>,
    /// All addresses were generated.
    addressed: bool,
    operands: Delay<[Option<u32>; N], READ_LATENCY>,
    issuing: [Option<u32>; N],
    held: bool,
    pipe: InFlight<[F; 3], EVALUATE_STAGES, N>,
}

impl<F: Format, const N: usize> EvaluatePass<F, N> {
    /// A pass that has not begun.
    pub fn new(job: EvaluateJob<F>) -> Self {
        Self {
            addresses: Addresses::new(job.allocation, job.hits.count()),
            inverse_pi: preu::inverse_pi(),
            addressed: false,
            operands: Delay::new(),
            issuing: [None; N],
            held: false,
            pipe: InFlight::new(),
            job,
        }
    }

    /// One clock.
    ///
    /// # Errors
    /// A [`Fault`]: the job is over, what was in flight is dropped.
    pub fn tick(&mut self, memory: &mut [u32], counters: &mut Counters) -> Result<Progress, Fault> {
        counters.total_cycles += 1;
        let pixels = self.job.pixels;
        self.pipe.clock(|pixel, value| record::write_pixel(memory, &pixels, pixel, value));

        if self.issuing == [None; N] {
            let addresses = self.addresses.step();
            self.addressed = addresses == [None; N];
            self.issuing = self.operands.shift((!self.addressed).then_some(addresses)).unwrap_or([None; N]);
        }
        let stalled = self.issue(memory, counters)?;
        counters.evaluate_cycles += u64::from(!self.addressed || stalled);
        counters.stall_cycles += u64::from(stalled);

        let done =
            self.addressed && self.issuing == [None; N] && self.operands.is_empty() && self.pipe.is_empty();
        Ok(if done { Progress::Done } else { Progress::Running })
    }

    /// Issues this cycle's hit points, in the PREUs' order, up to the first that a hazard holds back; says whether one was.
    fn issue(&mut self, memory: &[u32], counters: &mut Counters) -> Result<bool, Fault> {
        for preu in 0..N {
            let Some(hit) = self.issuing[preu] else { continue };
            let fault = Fault { code: FaultCode::PixelRange, address: self.job.hits.address(hit) };
            let words = record::read_hit(memory, &self.job.hits, hit).ok_or(fault)?;
            let pixel = Some(record::pixel_of(words))
                .filter(|pixel| *pixel < self.job.pixels.count())
                .ok_or(fault)?;
            let age = self.pipe.age(pixel);
            let verdict = self.job.hazard.judge(age, EVALUATE_BYPASS);
            counters.pixel_conflicts += u64::from(age.is_some() && !self.held);
            self.held = verdict == Verdict::Hold;
            if self.held {
                return Ok(true);
            }
            let in_flight = self.pipe.result(pixel).filter(|_| verdict == Verdict::Bypass);
            counters.forwards += u64::from(in_flight.is_some());
            let sum = match in_flight {
                Some((_, sum)) => sum,
                None => record::read_pixel(memory, &self.job.pixels, pixel).ok_or(fault)?,
            };
            let sum = preu::evaluate(&sum, &Accumulated::of(words), self.job.emitted, self.inverse_pi);
            // One hit point a PREU and cycle.
            let _ = self.pipe.issue(pixel, Some(sum));
            self.issuing[preu] = None;
            counters.evaluations += 1;
        }
        Ok(false)
    }
}
