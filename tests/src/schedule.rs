//! The controllers as plain loops over integers; in: list lengths, out: which entry is dispatched in which cycle; cost: a
//! few ns a cycle.
//!
//! Each cycle dispatches from what the buffer held at its start, then shifts, then loads; photons without a list are passed over
//! (D9); the first cycle only loads, and the drain is part of the count.

use std::collections::VecDeque;

/// D4.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Busy {
    /// No load in a cycle that began with a full buffer.
    Registered,
    /// Whatever room the shift left.
    Combinational,
}

/// What a schedule came to.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Totals {
    /// From the first load to the last dispatch.
    pub cycles: u64,
    /// Entries dispatched.
    pub operations: u64,
    /// D1.
    pub partial: u64,
}

impl Totals {
    /// Per cent of the slots in use, four digits behind the point.
    pub fn utilisation(&self, preus: u32) -> String {
        format!("{:.4}", 100.0 * self.operations as f64 / (self.cycles * u64::from(preus)) as f64)
    }
}

/// AFTSO (§IV.B) with D1 to D6 and D9; `dispatch` is given cycle, photon and entry of its list, in order.
pub fn aftso(
    lists: &[u32],
    preus: u32,
    width: usize,
    busy: Busy,
    mut dispatch: impl FnMut(u64, usize, u32),
) -> Totals {
    run(lists, width, busy, |cycle, buffer, drained, totals| {
        let held: u64 = buffer.iter().map(|(_, n)| u64::from(*n)).sum();
        let full = buffer.len() == 4;
        if held < u64::from(preus) {
            if !full && !drained {
                return;
            }
            totals.partial += u64::from(full);
        }
        let mut slots = preus;
        while let Some((photon, n)) = buffer.front_mut().filter(|_| slots > 0) {
            let count = slots.min(*n);
            (0..count).for_each(|_| {
                *n -= 1;
                dispatch(cycle, *photon, *n);
            });
            slots -= count;
            if *n == 0 {
                buffer.pop_front();
            }
        }
        totals.operations += u64::from(preus - slots);
    })
}

/// The baseline without AFTSO: one photon a cycle, as far as the PREUs reach.
pub fn one_photon(
    lists: &[u32],
    preus: u32,
    width: usize,
    busy: Busy,
    mut dispatch: impl FnMut(u64, usize, u32),
) -> Totals {
    run(lists, width, busy, |cycle, buffer, _, totals| {
        let Some((photon, n)) = buffer.front_mut() else { return };
        for _ in 0..preus.min(*n) {
            *n -= 1;
            totals.operations += 1;
            dispatch(cycle, *photon, *n);
        }
        if *n == 0 {
            buffer.pop_front();
        }
    })
}

type Entries = VecDeque<(usize, u32)>;

fn run(
    lists: &[u32],
    width: usize,
    busy: Busy,
    mut turn: impl FnMut(u64, &mut Entries, bool, &mut Totals),
) -> Totals {
    let mut input = lists.iter().copied().enumerate().filter(|(_, n)| *n > 0).peekable();
    let mut buffer = Entries::with_capacity(4);
    let mut totals = Totals::default();
    while input.peek().is_some() || !buffer.is_empty() {
        let full = buffer.len() == 4;
        let drained = input.peek().is_none();
        turn(totals.cycles, &mut buffer, drained, &mut totals);
        if !(full && busy == Busy::Registered) {
            let room = (4 - buffer.len()).min(width);
            buffer.extend(input.by_ref().take(room));
        }
        totals.cycles += 1;
    }
    totals
}

/// Which hit points are evaluated in which cycle (Figs. 10 and 11, D10): in cycle `t`, the `t`-th of each group.
pub fn evaluation(hits: u32, preus: u32, leaping: bool) -> Vec<Vec<u32>> {
    let end = |groups: u32| match groups == preus {
        true => hits,
        // k/N of all as a sum of halves, quarters and so on, each rounded down.
        false => (1..=preus.ilog2()).filter(|s| groups & (preus >> s) != 0).map(|s| hits >> s).sum(),
    };
    // Eq. (10): the hit points by the PREUs' number and the 12 stages, rounded up to a power of two.
    let leap = if leaping { (hits / (preus * 16)).max(1) } else { 1 };
    let groups: Vec<Vec<u32>> = (0..preus)
        .map(|group| {
            let (first, end) = (end(group), end(group + 1));
            (first..end.min(first + leap)).flat_map(|row| (row..end).step_by(leap as usize)).collect()
        })
        .collect();
    let cycles = groups.iter().map(Vec::len).max().unwrap_or(0);
    (0..cycles).map(|t| groups.iter().filter_map(|group| group.get(t).copied()).collect()).collect()
}
