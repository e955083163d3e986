//! The same as `tick`, sooner; in: a number of cycles, out: the state after them; cost: a loop without bubbles.

use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::job::Fault;
use crate::update::{Progress, UpdatePass};

impl<F: Format, const N: usize> UpdatePass<F, N> {
    /// Up to `cycles` ticks; says how many it took.
    pub fn advance(
        &mut self,
        memory: &mut [u32],
        counters: &mut Counters,
        cycles: u64,
    ) -> (u64, Result<Progress, Fault>) {
        let mut used = 0;
        let mut progress = Ok(Progress::Running);
        while used < cycles && progress == Ok(Progress::Running) {
            progress = self.tick(memory, counters);
            used += 1;
        }
        (used, progress)
    }
}
