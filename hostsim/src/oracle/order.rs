//! The order in which hit points are added to pixels; in: their number and the PREUs', out: each number once; cost: one pass.
//!
//! Written from eqs. (10) to (13) and D10 as plain nested loops, to compare the engine's registers with: the sum of a
//! pixel with several hit points depends on it.

/// Group `i` of `units` and its hit points: (first, end), by the shifts of Fig. 10.
fn group(hits: u32, units: u32, i: u32) -> (u32, u32) {
    let end = |groups: u32| {
        if groups == units {
            return hits;
        }
        (0..units.ilog2()).filter(|bit| groups & 1 << bit != 0).map(|bit| hits >> (units.ilog2() - bit)).sum()
    };
    (end(i), end(i + 1))
}

/// How far a PREU leaps, eq. (10); at least 1 (D10).
pub fn leap(hits: u32, units: u32) -> u32 {
    const STAGES: u32 = 12;
    (hits / (STAGES * units).next_power_of_two()).max(1)
}

/// All hit points in the order of evaluation; `leap` is 1 for the sequential allocation.
pub fn evaluation_order(hits: u32, units: u32, leap: u32) -> Vec<u32> {
    let groups: Vec<Vec<u32>> = (0..units)
        .map(|i| {
            let (first, end) = group(hits, units, i);
            let rows = (first..end).take(leap as usize);
            rows.flat_map(|start| (start..end).step_by(leap as usize)).collect()
        })
        .collect();
    let longest = groups.iter().map(Vec::len).max().unwrap_or(0);
    (0..longest).flat_map(|turn| groups.iter().filter_map(move |group| group.get(turn).copied())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_a_permutation() {
        for (hits, units) in [(1, 4), (3, 4), (63, 8), (606, 4), (606, 16), (152_046, 4)] {
            for leap in [1, leap(hits, units)] {
                let mut order = evaluation_order(hits, units, leap);
                order.sort_unstable();
                assert!(order.into_iter().eq(0..hits), "{hits} hit points, {units} units, leap {leap}");
            }
        }
    }
}
