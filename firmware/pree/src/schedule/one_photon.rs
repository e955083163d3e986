//! The baseline without AFTSO (Table II, middle column); in: the buffer's lists, out: the front one's entries; cost: nothing.

use super::{Buffer, Plan};

/// The hit points of one photon are spread over the PREUs; what its list does not fill stays idle (§III.C).
#[inline]
pub fn plan(buffer: &Buffer, preus: u32) -> Plan {
    match buffer.first() {
        None => Plan::Wait,
        Some(listed) if listed.n <= preus => Plan::Dispatch { whole: 1, part: 0 },
        Some(_) => Plan::Dispatch { whole: 0, part: preus },
    }
}
