//! Which hit points go to the PREUs in a cycle; in: photons' lists, out: one group of at most N a cycle; cost: one policy a file.
//!
//! [`aftso`] is the paper's controller, [`one_photon`] the baseline without it. Both see integers only ("the fixed-point
//! AFTSO-HpUOC controller", §IV): a photon's data wait in the photon file under a [`Tag`].

pub mod aftso;
pub mod one_photon;

use heapless::Vec;

/// Entries of the controller's buffer (§IV.B: four, whatever the number of PREUs).
pub const ENTRIES: usize = 4;

/// Names a photon in the photon file while its list is worked on.
pub type Tag = u8;

/// A photon's list in the buffer.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Listed {
    /// Whose list it is.
    pub tag: Tag,
    /// Its first entry in the index table.
    pub p_addr: u32,
    /// How many of its entries are not yet dispatched, counted from the front.
    pub n: u32,
}

/// The buffer, oldest photon first.
pub type Buffer = Vec<Listed, ENTRIES>;

/// What a policy will dispatch from the buffer in this cycle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Plan {
    /// Nothing: too little is there to fill the PREUs, and more may come.
    Wait,
    /// All of the first `whole` lists, and `part` entries of the next (0: none).
    Dispatch {
        /// Lists dispatched to their end.
        whole: usize,
        /// Entries dispatched of the list behind them.
        part: u32,
    },
}

impl Plan {
    /// How many lists stay in a buffer of `len`.
    pub const fn left(self, len: usize) -> usize {
        match self {
            Self::Wait => len,
            Self::Dispatch { whole, .. } => len - whole,
        }
    }
}

/// The policy (register `CONFIG.SCHEDULER`).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Scheduler {
    /// The paper's controller.
    #[default]
    Aftso,
    /// One photon at a time: the PREUs its list does not fill stay idle.
    OnePhoton,
}

impl Scheduler {
    /// What goes to `preus` units in this cycle. `drain`: no photon will come any more (D2).
    #[inline]
    pub fn plan(self, buffer: &Buffer, preus: u32, drain: bool) -> Plan {
        match self {
            Self::Aftso => aftso::plan(buffer, preus, drain),
            Self::OnePhoton => one_photon::plan(buffer, preus),
        }
    }
}

/// Consecutive entries of one photon's list, walked from its end: `ref_addr` downwards (§IV.B, D6).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Segment {
    /// The photon.
    pub tag: Tag,
    /// The index-table entry to take first.
    pub ref_addr: u32,
    /// How many to take.
    pub count: u32,
}

/// What is dispatched in one cycle: entries of at most four photons.
#[derive(Clone, Debug, Default)]
pub struct Group {
    segments: Vec<Segment, ENTRIES>,
    next: usize,
}

impl Group {
    /// Carries a plan out: takes its entries from the buffer and moves the rest to the front.
    #[inline]
    pub fn take(buffer: &mut Buffer, plan: Plan) -> Option<Self> {
        let Plan::Dispatch { whole, part } = plan else { return None };
        let mut group = Self::default();
        let touched = whole + usize::from(part > 0);
        for (place, listed) in buffer.iter_mut().take(touched).enumerate() {
            let count = if place < whole { listed.n } else { part.min(listed.n) };
            let ref_addr = listed.p_addr.wrapping_add(listed.n).wrapping_sub(1);
            listed.n -= count;
            // A plan names no more lists than the buffer has.
            let _ = group.segments.push(Segment { tag: listed.tag, ref_addr, count });
        }
        if whole > 0 {
            buffer.rotate_left(whole);
            buffer.truncate(buffer.len() - whole);
        }
        Some(group)
    }

    /// The operation whose turn it is: whose photon, which index-table entry.
    #[inline]
    pub fn first(&self) -> Option<(Tag, u32)> {
        self.segments.get(self.next).map(|segment| (segment.tag, segment.ref_addr))
    }

    /// That operation is done with.
    #[inline]
    pub fn advance(&mut self) {
        if let Some(segment) = self.segments.get_mut(self.next) {
            segment.count -= 1;
            segment.ref_addr = segment.ref_addr.wrapping_sub(1);
            self.next += usize::from(segment.count == 0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example of §IV.B: p_addr = 100, three hit points: 102, 101, 100.
    #[test]
    fn a_list_is_walked_from_its_end() {
        let mut buffer = Buffer::from_slice(&[Listed { tag: 5, p_addr: 100, n: 3 }]).unwrap();
        let mut group = Group::take(&mut buffer, Plan::Dispatch { whole: 1, part: 0 }).unwrap();
        for entry in [102, 101, 100] {
            assert_eq!(group.first(), Some((5, entry)));
            group.advance();
        }
        assert_eq!(group.first(), None);
        assert!(buffer.is_empty());
    }

    /// D6: a list longer than the PREUs are many stays in its entry with n reduced.
    #[test]
    fn a_part_leaves_the_front_of_the_list() {
        let mut buffer =
            Buffer::from_slice(&[Listed { tag: 0, p_addr: 10, n: 1 }, Listed { tag: 1, p_addr: 20, n: 9 }])
                .unwrap();
        let group = Group::take(&mut buffer, Plan::Dispatch { whole: 1, part: 3 }).unwrap();
        assert_eq!(
            group.segments,
            [Segment { tag: 0, ref_addr: 10, count: 1 }, Segment { tag: 1, ref_addr: 28, count: 3 }]
        );
        assert_eq!(buffer, [Listed { tag: 1, p_addr: 20, n: 6 }]);
    }
}
