//! Which hit points are evaluated in a cycle; in: their number, out: at most one address a PREU and cycle; cost: one adder and
//! one comparator a PREU.
//!
//! [`Allocation::Leaping`] is ADISO-REC (PREE §IV.C, Figs. 9 and 10); [`Allocation::Sequential`] is each PREU walking its group
//! address by address (Fig. 3), and Fig. 4 shows the damage of it.

use crate::preu::components::EVALUATE_STAGES;

/// The order of evaluation (register `CONFIG.ALLOCATION`).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Allocation {
    /// ADISO-REC: each PREU leaps through a group of its own.
    #[default]
    Leaping,
    /// Each PREU walks its group address by address: neighbours, often of one pixel, meet in the pipeline.
    Sequential,
}

/// One PREU's share: the registers of Fig. 10.
#[derive(Clone, Copy, Debug)]
struct Share {
    /// Reg_start's reset value: the end of the group before (D10).
    first: u32,
    /// Reg_start: where the present row began.
    start: u32,
    /// Reg_leaping_addr.
    address: u32,
    /// Reg_end.
    end: u32,
}

/// The addresses of one evaluation for `N` PREUs, cycle by cycle.
#[derive(Clone, Debug)]
pub struct Addresses<const N: usize> {
    shares: [Share; N],
    leap: u32,
}

impl<const N: usize> Addresses<N> {
    /// All of `0..hits`: the groups of Fig. 10 (D10), walked with the leap of eq. (10), at least 1, or address by address.
    pub fn new(allocation: Allocation, hits: u32) -> Self {
        let mut first = 0;
        let shares = core::array::from_fn(|group| {
            let end = group_end::<N>(hits, group);
            let share = Share { first, start: first, address: first, end };
            first = end;
            share
        });
        let leap = match allocation {
            Allocation::Leaping => hits >> const { (N * EVALUATE_STAGES).next_power_of_two().ilog2() },
            Allocation::Sequential => 1,
        };
        Self { shares, leap: leap.max(1) }
    }

    /// This cycle's address for each PREU; all `None` when the evaluation is done.
    #[inline]
    pub fn step(&mut self) -> [Option<u32>; N] {
        let leap = self.leap;
        self.shares.each_mut().map(|share| share.next(leap))
    }
}

impl Share {
    /// Eqs. (12) and (13): leap on, or begin the next row when that would leave the group; a leap is as many rows wide.
    #[inline]
    fn next(&mut self, leap: u32) -> Option<u32> {
        if self.start - self.first >= leap || self.start >= self.end {
            return None;
        }
        let address = self.address;
        self.address = match address.checked_add(leap).filter(|next| *next < self.end) {
            Some(next) => next,
            None => {
                self.start += 1;
                self.start
            }
        };
        Some(address)
    }
}

/// Reg_end of Fig. 10: (group + 1)/N of all hit points as a sum of right shifts, rounding down each; the last is exact.
fn group_end<const N: usize>(hits: u32, group: usize) -> u32 {
    let (bits, share) = (N.ilog2(), group as u32 + 1);
    if share == N as u32 {
        return hits;
    }
    (0..bits).filter(|bit| share >> bit & 1 == 1).map(|bit| hits >> (bits - bit)).sum()
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use proptest::prelude::*;
    use std::{vec, vec::Vec};

    fn order<const N: usize>(allocation: Allocation, hits: u32) -> Vec<[Option<u32>; N]> {
        let mut addresses = Addresses::<N>::new(allocation, hits);
        let mut cycles = Vec::new();
        loop {
            let cycle = addresses.step();
            if cycle.iter().all(Option::is_none) {
                return cycles;
            }
            cycles.push(cycle);
            assert!(cycles.len() <= hits as usize, "more cycles than hit points");
        }
    }

    /// Fig. 11's pattern: each group by leaps, then the row beside it.
    #[test]
    fn leaps_and_then_moves_a_row_on() {
        let first: Vec<_> =
            order::<4>(Allocation::Leaping, 64 * 3).iter().map(|cycle| cycle[1].unwrap()).collect();
        assert_eq!(first[..4], [48, 51, 54, 57]);
        assert_eq!(first[16..18], [49, 52]);
        assert_eq!(first.len(), 48);
    }

    /// 606 hit points in groups of 151, 152, 151, 152: 152 cycles.
    #[test]
    fn the_small_picture_takes_152_cycles() {
        assert_eq!(order::<4>(Allocation::Leaping, 606).len(), 152);
        assert_eq!(order::<4>(Allocation::Sequential, 606).len(), 152);
    }

    fn once<const N: usize>(allocation: Allocation, hits: u32) {
        let mut seen = vec![0u8; hits as usize];
        for address in order::<N>(allocation, hits).iter().flatten().flatten() {
            seen[*address as usize] += 1;
        }
        assert!(seen.iter().all(|&times| times == 1), "{allocation:?}, N = {N}, {hits} hit points");
    }

    /// D10: every address exactly once, for every count from 1 on.
    #[test]
    fn every_small_count_is_covered_once() {
        for hits in 1..2000 {
            for allocation in [Allocation::Leaping, Allocation::Sequential] {
                once::<4>(allocation, hits);
                once::<8>(allocation, hits);
                once::<16>(allocation, hits);
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn every_count_is_covered_once(hits in 1u32..300_000) {
            once::<4>(Allocation::Leaping, hits);
            once::<16>(Allocation::Leaping, hits);
            once::<8>(Allocation::Sequential, hits);
        }
    }
}
