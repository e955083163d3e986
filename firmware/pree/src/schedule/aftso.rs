//! AFTSO-HpUOC (PREE §IV.B, Fig. 8); in: the buffer's lists, out: what fills the PREUs; cost: three adders, four comparators.

use super::{Buffer, ENTRIES, Plan};

/// The controller's rule, as drawn in Block 5 of Fig. 8, with D1 to D3.
///
/// `accuHP_i` are the running sums of the lists' lengths; the first entry (D3: of the buffer) whose sum reaches the number of
/// PREUs is dispatched as far as it is needed, all before it wholly. When no sum reaches it, nothing goes, unless the buffer
/// is full (D1: waiting would be for ever) or no photon will come any more (D2).
#[inline]
pub fn plan(buffer: &Buffer, preus: u32, drain: bool) -> Plan {
    let mut accumulated = 0u32;
    for (buf_addr, listed) in buffer.iter().enumerate() {
        let before = accumulated;
        accumulated = accumulated.saturating_add(listed.n);
        if accumulated >= preus {
            let needed = preus - before;
            return match needed == listed.n {
                true => Plan::Dispatch { whole: buf_addr + 1, part: 0 },
                false => Plan::Dispatch { whole: buf_addr, part: needed },
            };
        }
    }
    match buffer.len() == ENTRIES || (drain && !buffer.is_empty()) {
        true => Plan::Dispatch { whole: buffer.len(), part: 0 },
        false => Plan::Wait,
    }
}

/// Whether a plan was made by D1: a full buffer that does not fill the PREUs.
pub fn is_partial(buffer: &Buffer, preus: u32) -> bool {
    buffer.len() == ENTRIES && buffer.iter().fold(0u32, |sum, listed| sum.saturating_add(listed.n)) < preus
}

#[cfg(test)]
mod tests {
    use super::super::Listed;
    use super::*;

    fn buffer(lengths: &[u32]) -> Buffer {
        lengths.iter().map(|&n| Listed { tag: 0, p_addr: 0, n }).collect()
    }

    #[test]
    fn fills_the_preus_from_as_many_photons_as_it_takes() {
        assert_eq!(plan(&buffer(&[9]), 4, false), Plan::Dispatch { whole: 0, part: 4 });
        assert_eq!(plan(&buffer(&[4]), 4, false), Plan::Dispatch { whole: 1, part: 0 });
        assert_eq!(plan(&buffer(&[1, 1, 5]), 4, false), Plan::Dispatch { whole: 2, part: 2 });
        assert_eq!(plan(&buffer(&[1, 1, 1, 1]), 4, false), Plan::Dispatch { whole: 4, part: 0 });
    }

    #[test]
    fn waits_for_more_and_drains_when_told() {
        assert_eq!(plan(&buffer(&[1, 2]), 4, false), Plan::Wait);
        assert_eq!(plan(&buffer(&[1, 2]), 4, true), Plan::Dispatch { whole: 2, part: 0 });
        assert_eq!(plan(&buffer(&[]), 4, true), Plan::Wait);
    }

    /// D1: the literal rule would never dispatch here.
    #[test]
    fn a_full_buffer_goes_even_when_it_is_too_little() {
        let lists = buffer(&[1, 2, 1, 2]);
        assert_eq!(plan(&lists, 8, false), Plan::Dispatch { whole: 4, part: 0 });
        assert!(is_partial(&lists, 8));
        assert!(!is_partial(&lists, 4));
    }

    #[test]
    fn lists_of_any_length_do_not_overflow() {
        assert_eq!(plan(&buffer(&[1, u32::MAX, u32::MAX]), 16, false), Plan::Dispatch { whole: 1, part: 15 });
    }
}
