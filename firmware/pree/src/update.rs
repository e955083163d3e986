//! The update pass, cycle by cycle; in: photons from the ring, out: refined hit points in memory; cost: one group of N
//! operations a cycle, 4 + 8 + 10 cycles from a photon's record to its results.
//!
//! ```text
//! ring -> feed -> buffer -> scheduler -> operand fetch (index, hit point) -> issue -> N x PREU -> write back
//!                (four photons)         8 cycles                            hazards   10 stages
//! ```

use lucerna_fabric::delay::Delay;
use lucerna_fabric::inflight::InFlight;
use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::feed::Feed;
use crate::hazard::{Hazard, UPDATE_BYPASS, Verdict};
use crate::job::{Busy, Fault, FaultCode, UpdateJob};
use crate::preu::components::UPDATE_STAGES;
use crate::preu::{self, Constants};
use crate::record::{self, Accumulated, Photon, Surface};
use crate::schedule::{Buffer, Group, Listed, Plan, Scheduler, Tag, aftso};

/// Cycles of one memory read: the port is ideal, it takes any number of reads a cycle (the paper leaves memory to an
/// external data controller).
pub const READ_LATENCY: usize = 4;
/// From a dispatch to its issue: the index table, then the hit points.
pub const OPERAND_LATENCY: usize = 2 * READ_LATENCY;

/// Photons in work: at most four in the buffer and four in each of the groups dispatched and not yet issued; those are
/// consecutive arrivals, so a circular file is never overwritten too soon.
pub(crate) const FILE: usize = 64;
const _: () = assert!(FILE >= 4 * (1 + OPERAND_LATENCY + 1) && FILE.is_power_of_two());

/// What a tick came to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Progress {
    /// There is more to do.
    Running,
    /// The clock was gated: photons are wanted.
    Starved,
    /// All is written back.
    Done,
}

/// An update job at work on `N` PREUs.
#[derive(Clone, Debug)]
pub struct UpdatePass<F, const N: usize> {
    pub(crate) job: UpdateJob<F>,
    pub(crate) constants: Constants<F>,
    /// Cycles until the first record has come.
    pub(crate) fill: usize,
    pub(crate) feed: Feed<F>,
    pub(crate) photons: [Photon<F>; FILE],
    pub(crate) next_tag: Tag,
    pub(crate) buffer: Buffer,
    pub(crate) operands: Delay<Group, OPERAND_LATENCY>,
    pub(crate) issuing: Option<Group>,
    /// The operation at the head was found in conflict before: it is counted once.
    pub(crate) held: bool,
    pub(crate) pipe: InFlight<Accumulated<F>, UPDATE_STAGES, N>,
}

impl<F: Format, const N: usize> UpdatePass<F, N> {
    /// A pass that has not begun.
    pub fn new(job: UpdateJob<F>) -> Self {
        let nothing = Photon { position: [F::ZERO; 3], flux: [F::ZERO; 3], normal: [F::ZERO; 3] };
        Self {
            constants: Constants::new(job.alpha),
            fill: READ_LATENCY,
            feed: Feed::new(job.ring, job.index.count(), job.rules.normal_test),
            photons: [nothing; FILE],
            next_tag: 0,
            buffer: Buffer::new(),
            operands: Delay::new(),
            issuing: None,
            held: false,
            pipe: InFlight::new(),
            job,
        }
    }

    /// The photon ring.
    pub fn feed(&mut self) -> &mut Feed<F> {
        &mut self.feed
    }

    /// One clock.
    ///
    /// The whole engine stands still while it would load photons that are not there (also while a hazard holds the front, when
    /// it would not load them in this very cycle): what it does in which of its own cycles does not depend on the host's pace.
    ///
    /// # Errors
    /// A [`Fault`]: the job is over, what was in flight is dropped.
    pub fn tick(&mut self, memory: &mut [u32], counters: &mut Counters) -> Result<Progress, Fault> {
        self.clock(memory, counters, Self::issue)
    }

    /// One clock, with `issue` as the issue stage: the plain one, or the one of [`fast`](crate::fast).
    #[inline]
    pub(crate) fn clock(
        &mut self,
        memory: &mut [u32],
        counters: &mut Counters,
        issue: impl FnOnce(&mut Self, &[u32], &mut Counters) -> Result<(), Fault>,
    ) -> Result<Progress, Fault> {
        self.feed.fetch(memory, counters);
        let drained = self.feed.is_dry();
        let plan = self.job.rules.scheduler.plan(&self.buffer, N as u32, drained);
        let room = self.room(plan);
        if self.feed.starves(room) {
            counters.starved_cycles += 1;
            return Ok(Progress::Starved);
        }
        counters.total_cycles += 1;
        if self.fill > 0 {
            self.fill -= 1;
            return Ok(Progress::Running);
        }
        let scheduled = drained && self.buffer.is_empty();

        let hits = self.job.hits;
        self.pipe.clock(|hit, result: Accumulated<F>| result.write(memory, &hits, hit));
        if self.issuing.is_none() {
            let dispatched = self.dispatch(plan, counters);
            self.load(room)?;
            self.issuing = self.operands.shift(dispatched);
        }
        let stalls = counters.stall_cycles;
        issue(self, memory, counters)?;
        counters.update_cycles += u64::from(!scheduled || counters.stall_cycles > stalls);

        let done = scheduled && self.operands.is_empty() && self.issuing.is_none() && self.pipe.is_empty();
        Ok(if done { Progress::Done } else { Progress::Running })
    }

    /// How many photons this cycle takes in, if `plan` is carried out (D4, D5).
    pub(crate) fn room(&self, plan: Plan) -> usize {
        if self.job.rules.busy == Busy::Registered && self.buffer.is_full() {
            return 0;
        }
        let free = self.buffer.capacity() - plan.left(self.buffer.len());
        free.min(self.job.rules.input_width as usize)
    }

    fn dispatch(&mut self, plan: Plan, counters: &mut Counters) -> Option<Group> {
        let partial =
            self.job.rules.scheduler == Scheduler::Aftso && aftso::is_partial(&self.buffer, N as u32);
        counters.partial_dispatches += u64::from(partial);
        Group::take(&mut self.buffer, plan)
    }

    fn load(&mut self, room: usize) -> Result<(), Fault> {
        for _ in 0..room {
            let Some(arrival) = self.feed.take()? else { break };
            let tag = self.next_tag;
            self.next_tag = (tag + 1) % FILE as Tag;
            self.photons[usize::from(tag)] = arrival.photon;
            // `room` was counted from this buffer.
            let _ = self.buffer.push(Listed { tag, p_addr: arrival.p_addr, n: arrival.n });
        }
        Ok(())
    }

    /// Issues the group at the head, in order, up to the first operation that a hazard holds back.
    pub(crate) fn issue(&mut self, memory: &[u32], counters: &mut Counters) -> Result<(), Fault> {
        let Some(mut group) = self.issuing.take() else { return Ok(()) };
        while let Some((tag, entry)) = group.first() {
            let hit = self.hit_number(memory, entry)?;
            let age = self.pipe.age(hit);
            let verdict = self.job.rules.hazard.judge(age, UPDATE_BYPASS);
            counters.update_conflicts += u64::from(age.is_some() && !self.held);
            self.held = verdict == Verdict::Hold;
            if self.held {
                counters.stall_cycles += 1;
                self.issuing = Some(group);
                return Ok(());
            }
            let result = self.compute(memory, tag, hit, verdict, counters);
            // A group has no more operations than there are PREUs.
            let _ = self.pipe.issue(hit, result);
            group.advance();
        }
        Ok(())
    }

    fn hit_number(&self, memory: &[u32], entry: u32) -> Result<u32, Fault> {
        let number = self.job.index.read::<1>(memory, entry, 0).map(|words| words[0]);
        number
            .filter(|hit| *hit < self.job.hits.count())
            .ok_or(Fault { code: FaultCode::HitRange, address: self.job.index.address(entry) })
    }

    fn compute(
        &self,
        memory: &[u32],
        tag: Tag,
        hit: u32,
        verdict: Verdict,
        counters: &mut Counters,
    ) -> Option<Accumulated<F>> {
        counters.operations += 1;
        let words = record::read_hit(memory, &self.job.hits, hit)?;
        let in_flight = self.pipe.result(hit).map(|(_, result)| result);
        let before = match in_flight.filter(|_| verdict == Verdict::Bypass) {
            Some(result) => {
                counters.forwards += 1;
                result
            }
            None => Accumulated::of(words),
        };
        let photon = &self.photons[usize::from(tag)];
        let result =
            preu::update(&Surface::of(words), &before, photon, &self.constants, self.job.rules.normal_test);
        if result.is_some() {
            counters.updates += 1;
            let stale = self.job.rules.hazard == Hazard::Published && in_flight.is_some();
            counters.stale_updates += u64::from(stale);
        }
        result
    }
}
