//! A pipeline's contents as a scoreboard; in: keys and results as they are issued, out: the same when they leave, and
//! "how many cycles ago was this key issued?" in between; cost: one compare a stage and lane, as in a content-addressed memory.

use heapless::Vec;

/// Keys that share their low bits share one place of the filter. A microcontroller has little memory, a host little time; the
/// answers are the same.
const FILTER: usize = if cfg!(target_pointer_width = "64") { 1024 } else { 128 };

/// What is issued to `LANES` pipelines of `STAGES` stages, cycle by cycle.
///
/// A key names what an operation reads and writes (a hit point, a pixel). An operation issued in cycle `t` leaves in cycle
/// `t + STAGES`; until then its key is in flight. Results are computed at issue and carried down; not every operation has one.
#[derive(Clone, Debug)]
pub struct InFlight<R, const STAGES: usize, const LANES: usize> {
    stages: [Stage<R, LANES>; STAGES],
    /// The stage that is issued to in this cycle.
    first: usize,
    held: usize,
    /// This cycle's number, counting round.
    now: u32,
    /// When a key with these low bits was issued last: long ago proves absence without looking at the stages.
    issued: [u32; FILTER],
}

#[derive(Clone, Debug)]
struct Stage<R, const LANES: usize> {
    keys: Vec<u32, LANES>,
    results: Vec<(u32, R), LANES>,
}

impl<R, const LANES: usize> Stage<R, LANES> {
    const EMPTY: Self = Self { keys: Vec::new(), results: Vec::new() };
}

impl<R: Copy, const STAGES: usize, const LANES: usize> InFlight<R, STAGES, LANES> {
    /// An empty pipeline.
    pub const fn new() -> Self {
        Self {
            stages: [const { Stage::EMPTY }; STAGES],
            first: 0,
            held: 0,
            now: STAGES as u32,
            issued: [0; FILTER],
        }
    }

    /// One clock: every operation moves on a stage, and `leave` is called, in order of issue, with the results of those that
    /// were issued `STAGES` cycles ago.
    #[inline]
    pub fn clock(&mut self, mut leave: impl FnMut(u32, R)) {
        self.now = self.now.wrapping_add(1);
        self.first = if self.first + 1 == STAGES { 0 } else { self.first + 1 };
        let leaving = &mut self.stages[self.first];
        self.held -= leaving.keys.len();
        for (key, result) in &leaving.results {
            leave(*key, *result);
        }
        leaving.keys.clear();
        leaving.results.clear();
    }

    /// Puts one operation into this cycle's first stage. Gives the key back when every lane is taken.
    #[inline]
    pub fn issue(&mut self, key: u32, result: Option<R>) -> Result<(), u32> {
        let stage = &mut self.stages[self.first];
        stage.keys.push(key)?;
        if let Some(result) = result {
            // As many lanes as keys: this one has room because that one had.
            let _ = stage.results.push((key, result));
        }
        self.held += 1;
        self.issued[key as usize % FILTER] = self.now;
        Ok(())
    }

    /// How many cycles ago the youngest operation with this key was issued (0: in this cycle), if one is in flight.
    ///
    /// ```
    /// use lucerna_fabric::inflight::InFlight;
    /// let mut pipe: InFlight<(), 10, 4> = InFlight::new();
    /// pipe.issue(7, None).unwrap();
    /// for _ in 0..9 {
    ///     pipe.clock(|_, ()| {});
    /// }
    /// assert_eq!(pipe.age(7), Some(9));
    /// pipe.clock(|_, ()| {});
    /// assert_eq!(pipe.age(7), None);
    /// ```
    #[inline]
    pub fn age(&self, key: u32) -> Option<usize> {
        if self.is_absent(key) {
            return None;
        }
        self.scan(|stage| stage.keys.contains(&key).then_some(())).map(|(age, ())| age)
    }

    /// The youngest result in flight for this key, with its age.
    #[inline]
    pub fn result(&self, key: u32) -> Option<(usize, R)> {
        if self.is_absent(key) {
            return None;
        }
        self.scan(|stage| stage.results.iter().rev().find(|(k, _)| *k == key).map(|(_, result)| *result))
    }

    /// Whether this key is surely not in flight; `false` says nothing.
    #[inline]
    pub const fn is_absent(&self, key: u32) -> bool {
        self.now.wrapping_sub(self.issued[key as usize % FILTER]) >= STAGES as u32
    }

    /// Whether nothing is in flight.
    #[inline]
    pub const fn is_empty(&self) -> bool {
        self.held == 0
    }

    fn scan<T>(&self, find: impl Fn(&Stage<R, LANES>) -> Option<T>) -> Option<(usize, T)> {
        (0..STAGES).find_map(|age| {
            let stage = (self.first + STAGES - age) % STAGES;
            find(&self.stages[stage]).map(|found| (age, found))
        })
    }
}

impl<R: Copy, const STAGES: usize, const LANES: usize> Default for InFlight<R, STAGES, LANES> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::InFlight;
    use proptest::prelude::*;
    use std::vec::Vec;

    #[test]
    fn a_full_cycle_gives_the_key_back() {
        let mut pipe: InFlight<(), 3, 2> = InFlight::new();
        assert_eq!(pipe.issue(1, None), Ok(()));
        assert_eq!(pipe.issue(2, None), Ok(()));
        assert_eq!(pipe.issue(3, None), Err(3));
        assert_eq!(pipe.age(3), None);
    }

    proptest! {
        /// Against a plain list of (cycle, key, result), searched from its end.
        #[test]
        fn is_a_list_of_the_last_stages(cycles in prop::collection::vec(prop::collection::vec((0u32..6, any::<bool>()), 0..=4), 1..60)) {
            let mut pipe: InFlight<usize, 5, 4> = InFlight::new();
            let mut issued: Vec<(usize, u32, Option<usize>)> = Vec::new();
            for (now, lanes) in cycles.iter().enumerate() {
                let mut left = Vec::new();
                pipe.clock(|key, result| left.push((key, result)));
                let expected: Vec<_> = issued.iter().filter(|(t, ..)| t + 5 == now).filter_map(|(_, k, r)| r.map(|r| (*k, r))).collect();
                prop_assert_eq!(left, expected);
                for (key, has_result) in lanes {
                    let youngest = issued.iter().rev().find(|(t, k, _)| k == key && now - t < 5).map(|(t, ..)| now - t);
                    prop_assert_eq!(pipe.age(*key), youngest);
                    let result = issued.iter().rev().find(|(t, k, r)| k == key && now - t < 5 && r.is_some()).map(|(t, _, r)| (now - t, r.unwrap()));
                    prop_assert_eq!(pipe.result(*key), result);
                    let carried = has_result.then_some(issued.len());
                    prop_assert!(pipe.issue(*key, carried).is_ok());
                    issued.push((now, *key, carried));
                }
            }
        }
    }
}
