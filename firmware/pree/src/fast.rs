//! The same as `tick`, sooner; in: a number of cycles, out: the state after that many ticks; cost: a fraction of theirs.
//!
//! Two shortcuts, both exact. Cycles are *regular* while the front list is longer than the PREUs are many and the buffer is
//! full: nothing is loaded, and the whole group comes from the front list. And an operation whose hit point is surely not in
//! flight needs no judgement, so that a group of such operations is computed in one sweep. Whatever is neither is ticked.

use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::job::Fault;
use crate::preu;
use crate::record::{self, Accumulated, HIT_WORDS, HitRecord, INDEX_WORDS, Photon, Surface};
use crate::schedule::{Group, Plan, Tag};
use crate::update::{FILE, Progress, UpdatePass};

const HIT: usize = HIT_WORDS as usize;

impl<F: Format, const N: usize> UpdatePass<F, N> {
    /// Up to `cycles` ticks, fewer when the job ends; says how many. All cycles left when photons are wanted are starved.
    pub fn advance(
        &mut self,
        memory: &mut [u32],
        counters: &mut Counters,
        cycles: u64,
    ) -> (u64, Result<Progress, Fault>) {
        let mut used = 0;
        while used < cycles {
            let progress = match self.regular_dispatches() {
                0 => {
                    used += 1;
                    let tag = self.next_tag;
                    let progress = self.clock(memory, counters, Self::sweep);
                    self.warm(memory, tag);
                    progress
                }
                dispatches => self.regular(memory, counters, dispatches, cycles, &mut used),
            };
            match progress {
                Ok(Progress::Running) => {}
                Ok(Progress::Starved) => {
                    counters.starved_cycles += cycles - used;
                    return (cycles, progress);
                }
                Ok(Progress::Done) | Err(_) => return (used, progress),
            }
        }
        (used, Ok(Progress::Running))
    }

    /// Touches the hit points of the photons that came into the buffer after `tag` was the next one to be given.
    ///
    /// The model's time is mostly the host's cache misses. Here the loads of a whole list overlap; in the sweep, some cycles
    /// later, each would wait behind the arithmetic of those before.
    fn warm(&self, memory: &[u32], tag: Tag) {
        const HAS_CACHES: bool = cfg!(target_pointer_width = "64");
        let loaded = usize::from(self.next_tag.wrapping_sub(tag)) % FILE;
        if !HAS_CACHES || loaded == 0 {
            return;
        }
        let hits = self.job.hits.records::<HIT>(memory);
        let index = self.job.index.records::<{ INDEX_WORDS as usize }>(memory);
        for listed in self.buffer.iter().rev().take(loaded) {
            let list = index.get(listed.p_addr as usize..).and_then(|rest| rest.get(..listed.n as usize));
            let touched = list
                .unwrap_or_default()
                .iter()
                .fold(0, |sum, [hit]| sum ^ hits.get(*hit as usize).map_or(0, |words| words[0]));
            core::hint::black_box(touched);
        }
    }

    /// How many dispatches from now on are regular.
    fn regular_dispatches(&self) -> u32 {
        match self.buffer.first() {
            Some(front) if self.fill == 0 && self.buffer.is_full() => front.n.saturating_sub(1) / N as u32,
            _ => 0,
        }
    }

    /// Cycles until `dispatches` regular ones were made, or `used` reaches `cycles`.
    fn regular(
        &mut self,
        memory: &mut [u32],
        counters: &mut Counters,
        mut dispatches: u32,
        cycles: u64,
        used: &mut u64,
    ) -> Result<Progress, Fault> {
        // As in the first of these ticks; in the others there is no room for more.
        self.feed.fetch(memory, counters);
        let hits = self.job.hits;
        while dispatches > 0 && *used < cycles {
            *used += 1;
            counters.total_cycles += 1;
            self.pipe.clock(|hit, result: Accumulated<F>| result.write(memory, &hits, hit));
            if self.issuing.is_none() {
                let group = Group::take(&mut self.buffer, Plan::Dispatch { whole: 0, part: N as u32 });
                self.issuing = self.operands.shift(group);
                dispatches -= 1;
            }
            self.sweep(memory, counters)?;
            // Behind the issue, as in a tick: a cycle that ends in a fault is not counted.
            counters.update_cycles += 1;
        }
        Ok(Progress::Running)
    }

    /// Issues the group at the head as [`issue`](Self::issue) does, but without a judgement where none is needed.
    #[inline]
    fn sweep(&mut self, memory: &[u32], counters: &mut Counters) -> Result<(), Fault> {
        let Some(group) = &mut self.issuing else { return Ok(()) };
        if self.held {
            return self.issue(memory, counters);
        }
        let hits = self.job.hits.records::<HIT>(memory);
        let index = self.job.index.records::<{ INDEX_WORDS as usize }>(memory);
        let normal_test = self.job.rules.normal_test;
        while let Some((tag, entry)) = group.first() {
            let record = index.get(entry as usize).and_then(|[hit]| Some((*hit, hits.get(*hit as usize)?)));
            let Some((hit, words)) = record.filter(|(hit, _)| self.pipe.is_absent(*hit)) else {
                return self.issue(memory, counters);
            };
            let photon = &self.photons[usize::from(tag)];
            let result = match is_outside(words, photon) {
                true => None,
                false => {
                    let (surface, before) = (Surface::of(words), Accumulated::of(words));
                    preu::update(&surface, &before, photon, &self.constants, normal_test)
                }
            };
            counters.operations += 1;
            counters.updates += u64::from(result.is_some());
            // A group has no more operations than there are PREUs.
            let _ = self.pipe.issue(hit, result);
            group.advance();
        }
        self.issuing = None;
        Ok(())
    }
}

/// Whether the photon is too far away, of which most are: the rest of the record is then not looked at.
#[inline]
fn is_outside<F: Format>(words: &HitRecord, photon: &Photon<F>) -> bool {
    let (position, radius2) = record::position_and_radius2(words);
    (F::COSTLY && is_surely_outside(&position, radius2, &photon.position))
        || !preu::within(&position, radius2, &photon.position)
}

/// Whether one axis alone puts the photon outside, so that [`preu::within`] must say no.
///
/// A sum of squares, rounded after every step, is never less than one of them: rounding keeps order. With a NaN in either the
/// comparison is false in both.
#[inline]
fn is_surely_outside<F: Format>(hit: &[F; 3], radius2: F, photon: &[F; 3]) -> bool {
    (0..3).any(|axis| !hit[axis].sub(photon[axis]).square().le(radius2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lucerna_softfloat::F24;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]
        /// On any bits, with radii near one of the squares more often than chance has them.
        #[test]
        fn what_is_surely_outside_is_outside(hit: [u32; 3], photon: [u32; 3], radius2: u32, near in 0usize..6) {
            let [hit, photon] = [hit, photon].map(|bits| bits.map(F24::from_bits));
            let radius2 = match near {
                axis @ 0..3 => hit[axis].sub(photon[axis]).square(),
                _ => F24::from_bits(radius2),
            };
            if is_surely_outside(&hit, radius2, &photon) {
                prop_assert!(!preu::within(&hit, radius2, &photon));
            }
        }
    }
}
