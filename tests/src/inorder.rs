//! What a job must come to; in: the job, out: every word of it and the counters; cost: some 50 ns an operation.
//!
//! [`update`] and [`evaluate`] are scalar loops: one operation after the other, nothing in flight. [`Timed`] plays the same
//! operations as events with an issue cycle, a result 10 or 12 cycles later, and the three hazard policies (D7, D12).

use std::collections::{HashMap, VecDeque};

use hostsim::oracle::{Bits24, Number};
use lucerna_driver::{Allocation, Hazard, InputWidth, NumberFormat, Scheduler};
use lucerna_regs::counters::Counter;

use crate::job::Job;
use crate::schedule::{self, Busy};

/// The oracle's arithmetic on words of device memory.
trait Word: Number {
    fn word(bits: u32) -> Self;
}

impl Word for f32 {
    fn word(bits: u32) -> Self {
        Self::from_bits(bits)
    }
}

impl Word for Bits24 {
    fn word(bits: u32) -> Self {
        let fraction = (bits & 0xffff) as f32;
        let magnitude = match bits >> 16 & 0x7f {
            0 => fraction * 2f32.powi(-78),
            0x7f if fraction == 0.0 => f32::INFINITY,
            0x7f => f32::NAN,
            exponent => (65536.0 + fraction) * 2f32.powi(exponent as i32 - 63 - 16),
        };
        Self::from_f32(if bits >> 23 & 1 == 1 { -magnitude } else { magnitude })
    }
}

/// Words 9 to 13 of a hit point.
type Refined = [u32; 5];

fn operation<N: Word>(hit: &[u32; 16], photon: &[u32; 12], alpha: u32, normal_test: bool) -> Option<Refined> {
    let (h, p) = (|word: usize| N::word(hit[word]), |word: usize| N::word(photon[word]));
    let d = [0, 1, 2].map(|axis| h(axis).sub(p(axis)));
    let d = d.map(|x| x.mul(x));
    let distance2 = d[0].add(d[1]).add(d[2]);
    // Not "further away": a NaN is nowhere near.
    let near = distance2 <= h(12);
    if !near {
        return None;
    }
    if normal_test {
        let n = [0, 1, 2].map(|axis| h(3 + axis).mul(p(8 + axis)));
        let cosine = n[0].add(n[1]).add(n[2]);
        let faces = cosine > N::from_f32(1e-3);
        if !faces {
            return None;
        }
    }
    let inverse_pi = N::from_f32(std::f32::consts::FRAC_1_PI);
    let count = h(13).add(N::word(alpha));
    let gain = count.div(h(13).add(N::ONE));
    let flux = |c: usize| h(9 + c).add(h(6 + c).mul(p(3 + c)).mul(inverse_pi)).mul(gain).to_bits();
    Some([flux(0), flux(1), flux(2), h(12).mul(gain).to_bits(), count.to_bits()])
}

fn radiance<N: Word>(pixel: [u32; 3], hit: &[u32; 16], emitted: u32) -> [u32; 3] {
    let inverse_pi = N::from_f32(std::f32::consts::FRAC_1_PI);
    let share = N::ONE.div(N::word(hit[12]).mul(N::word(emitted)));
    [0, 1, 2].map(|c| N::word(pixel[c]).add(N::word(hit[9 + c]).mul(inverse_pi).mul(share)).to_bits())
}

impl Job {
    fn operation(&self, hit: &[u32; 16], photon: usize) -> Option<Refined> {
        let (photon, normal_test) = (&self.photons[photon], self.config.normal_test());
        match self.kind.format {
            NumberFormat::F32 => operation::<f32>(hit, photon, self.alpha, normal_test),
            NumberFormat::F24 => operation::<Bits24>(hit, photon, self.alpha, normal_test),
            NumberFormat::F64 => panic!("the study format has no bits to compare"),
        }
    }

    fn radiance(&self, pixel: [u32; 3], hit: &[u32; 16]) -> [u32; 3] {
        match self.kind.format {
            NumberFormat::F32 => radiance::<f32>(pixel, hit, self.emitted),
            NumberFormat::F24 => radiance::<Bits24>(pixel, hit, self.emitted),
            NumberFormat::F64 => panic!("the study format has no bits to compare"),
        }
    }

    fn lists(&self) -> Vec<u32> {
        self.photons.iter().map(|photon| photon[7]).collect()
    }

    fn hazard(&self) -> Hazard {
        self.config.hazard().expect("a legal policy")
    }
}

/// The hit points after all photons, one operation after the other; and how many operations changed something.
pub fn update(job: &Job) -> (Vec<[u32; 16]>, u64) {
    let mut hits = job.hits.clone();
    let mut updates = 0;
    for (number, photon) in job.photons.iter().enumerate() {
        let (first, n) = (photon[6] as usize, photon[7] as usize);
        // A list is walked from its end; the order matters where a hit point is in it twice.
        for hit in job.index[first..first + n].iter().rev() {
            let hit = &mut hits[*hit as usize];
            if let Some(refined) = job.operation(hit, number) {
                hit[9..14].copy_from_slice(&refined);
                updates += 1;
            }
        }
    }
    (hits, updates)
}

/// The pixels after all of `hits` were added, one after the other in the order of evaluation.
pub fn evaluate(job: &Job, hits: &[[u32; 16]]) -> Vec<[u32; 3]> {
    let mut pixels = job.pixels.clone();
    for hit in evaluation_cycles(job).into_iter().flatten() {
        let hit = &hits[hit as usize];
        let pixel = &mut pixels[hit[14] as usize];
        *pixel = job.radiance(*pixel, hit);
    }
    pixels
}

fn evaluation_cycles(job: &Job) -> Vec<Vec<u32>> {
    let leaping = job.config.allocation() == Allocation::Leaping;
    schedule::evaluation(job.hits.len() as u32, job.kind.preus, leaping)
}

/// Cycles from the first dispatch to its issue: two memory reads.
const UPDATE_OPERANDS: u64 = 8;
/// The same for an evaluation: one read.
const EVALUATE_OPERANDS: u64 = 4;
/// Cycles before the first load.
const FILL: u64 = 4;

/// Operations in flight: keys, when each was issued last, and results not yet written.
struct Pipeline<R> {
    stages: u64,
    bypass: u64,
    hazard: Hazard,
    issued: HashMap<u32, u64>,
    changed: HashMap<u32, u64>,
    results: VecDeque<(u64, u32, R)>,
    /// Cycles in which an operation was held.
    holds: Vec<u64>,
    conflicts: u64,
    stale: u64,
    forwards: u64,
}

impl<R: Copy> Pipeline<R> {
    fn new(stages: u64, bypass: u64, hazard: Hazard) -> Self {
        Self {
            stages,
            bypass,
            hazard,
            issued: HashMap::new(),
            changed: HashMap::new(),
            results: VecDeque::new(),
            holds: Vec::new(),
            conflicts: 0,
            stale: 0,
            forwards: 0,
        }
    }

    /// The cycle in which the operation that arrives in cycle `t` is issued, and the result that is forwarded to it. Everything
    /// written until then was given to `write`.
    fn issue(&mut self, mut t: u64, key: u32, mut write: impl FnMut(u32, R)) -> (u64, Option<R>) {
        let last = self.issued.insert(key, t).filter(|last| t - last < self.stages);
        let mut bypassed = None;
        if let Some(last) = last {
            self.conflicts += 1;
            let ready = last
                + match self.hazard {
                    Hazard::Interlock => self.stages,
                    Hazard::Forward => self.bypass,
                    Hazard::Published => 0,
                };
            while t < ready {
                self.holds.push(t);
                t += 1;
            }
            self.issued.insert(key, t);
        }
        while let Some((due, key, result)) = self.results.front().copied().filter(|(due, ..)| *due <= t) {
            debug_assert!(due <= t);
            write(key, result);
            self.results.pop_front();
        }
        if last.is_some() && self.hazard == Hazard::Forward {
            bypassed =
                self.results.iter().rev().find(|(_, other, _)| *other == key).map(|(.., result)| *result);
            self.forwards += u64::from(bypassed.is_some());
        }
        (t, bypassed)
    }

    fn result(&mut self, t: u64, key: u32, result: R) {
        let last = self.changed.insert(key, t);
        let is_stale = self.hazard == Hazard::Published && last.is_some_and(|last| t - last < self.stages);
        self.stale += u64::from(is_stale);
        self.results.push_back((t + self.stages, key, result));
    }

    /// When the front end's cycle comes: a hold in cycle `t` keeps the front end still in cycle `t + 1`.
    fn delayed(&self, cycle: u64) -> u64 {
        self.holds.iter().fold(cycle, |cycle, hold| cycle + u64::from(*hold < cycle))
    }

    fn holds_from(&self, cycle: u64) -> u64 {
        self.holds.iter().filter(|hold| **hold >= cycle).count() as u64
    }

    fn drain(&mut self, mut write: impl FnMut(u32, R)) {
        self.results.drain(..).for_each(|(_, key, result)| write(key, result));
    }
}

/// A job played as events.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Timed<R> {
    /// What memory holds at the end.
    pub records: Vec<R>,
    /// What the counters say at the end; those not listed are 0.
    pub counters: Vec<(Counter, u64)>,
}

/// The update.
pub fn timed_update(job: &Job) -> Timed<[u32; 16]> {
    let mut hits = job.hits.clone();
    let mut pipe = Pipeline::<Refined>::new(10, 6, job.hazard());
    let (mut operations, mut updates, mut last_dispatch, mut last_issue) = (0, 0, None, None);
    let write = |hits: &mut Vec<[u32; 16]>, hit: u32, result: Refined| {
        hits[hit as usize][9..14].copy_from_slice(&result)
    };

    let dispatch = |cycle: u64, photon: usize, entry: u32| {
        let hit = job.index[(job.photons[photon][6] + entry) as usize];
        let arrival = cycle + UPDATE_OPERANDS + pipe.holds.len() as u64;
        let (t, bypassed) = pipe.issue(arrival, hit, |key, result| write(&mut hits, key, result));
        operations += 1;
        (last_dispatch, last_issue) = (Some(cycle), Some(t));
        let mut record = hits[hit as usize];
        if let Some(result) = bypassed {
            record[9..14].copy_from_slice(&result);
        }
        if let Some(refined) = job.operation(&record, photon) {
            updates += 1;
            pipe.result(t, hit, refined);
        }
    };
    let busy = match job.config.busy() {
        lucerna_driver::Busy::Registered => Busy::Registered,
        lucerna_driver::Busy::Combinational => Busy::Combinational,
    };
    let width = match job.config.input_width().expect("a legal width") {
        InputWidth::One => 1,
        InputWidth::Two => 2,
        InputWidth::Four => 4,
    };
    let totals = match job.config.scheduler() {
        Scheduler::Aftso => schedule::aftso(&job.lists(), job.kind.preus, width, busy, dispatch),
        Scheduler::OnePhoton => schedule::one_photon(&job.lists(), job.kind.preus, width, busy, dispatch),
    };
    pipe.drain(|key, result| write(&mut hits, key, result));

    let last_dispatch = last_dispatch.map(|cycle| pipe.delayed(cycle));
    let empty = job.photons.iter().filter(|photon| photon[7] == 0).count() as u64;
    let counters = vec![
        (Counter::Photons, job.photons.len() as u64),
        (Counter::EmptyCells, empty),
        (Counter::Operations, operations),
        (Counter::Updates, updates),
        (Counter::UpdateCycles, last_dispatch.map_or(0, |cycle| cycle + 1 + pipe.holds_from(cycle + 1))),
        (Counter::TotalCycles, FILL + 1 + last_issue.map_or(0, |t| t + 10)),
        (Counter::StallCycles, pipe.holds.len() as u64),
        (Counter::PartialDispatches, totals.partial),
        (Counter::UpdateConflicts, pipe.conflicts),
        (Counter::StaleUpdates, pipe.stale),
        (Counter::Forwards, pipe.forwards),
    ];
    Timed { records: hits, counters }
}

/// The evaluation of `hits`.
pub fn timed_evaluate(job: &Job, hits: &[[u32; 16]]) -> Timed<[u32; 3]> {
    let mut pixels = job.pixels.clone();
    let mut pipe = Pipeline::<[u32; 3]>::new(12, 2, job.hazard());
    let mut last_issue = None;
    let cycles = evaluation_cycles(job);
    for (cycle, group) in cycles.iter().enumerate() {
        for hit in group {
            let hit = &hits[*hit as usize];
            let arrival = cycle as u64 + EVALUATE_OPERANDS + pipe.holds.len() as u64;
            let (t, bypassed) = pipe.issue(arrival, hit[14], |key, result| pixels[key as usize] = result);
            last_issue = Some(t);
            let sum = job.radiance(bypassed.unwrap_or(pixels[hit[14] as usize]), hit);
            pipe.result(t, hit[14], sum);
        }
    }
    pipe.drain(|key, result| pixels[key as usize] = result);
    // Until the front end finds that there are no more addresses; and whatever is held after that.
    let addressed = pipe.delayed(cycles.len() as u64);
    let active = addressed + pipe.holds_from(addressed);
    let counters = vec![
        (Counter::Evaluations, hits.len() as u64),
        (Counter::TotalCycles, 1 + last_issue.map_or(0, |t| t + 12)),
        (Counter::StallCycles, pipe.holds.len() as u64),
        (Counter::PixelConflicts, pipe.conflicts),
        (Counter::Forwards, pipe.forwards),
        (Counter::EvaluateCycles, active),
    ];
    Timed { records: pixels, counters }
}
