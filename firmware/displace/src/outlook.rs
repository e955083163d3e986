//! When a part may do more than wait; in: its state, out: a cycle, and what stalls until then; cost: some compares.

use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::instance::Instance;
use crate::sizes::MAX_UNITS;

const NEVER: u64 = u64::MAX;

/// Of an instance's address, read and colour units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shading {
    /// They wait until this cycle, unless a ray or a fill comes.
    pub event: u64,
    /// The first cycle whose stalls are not counted yet.
    pub seen: u64,
    /// The address calculation stalls in each.
    pub address_stalls: bool,
    /// The read unit does.
    pub read_stalls: bool,
}

impl Shading {
    /// From cycle `now` on.
    #[inline]
    pub fn of<F: Format, const LINES: usize>(instance: &Instance<F, LINES>, now: u64) -> Self {
        let Instance { fifo1, address, read, colour, .. } = instance;
        let mut event = colour.next_event().unwrap_or(NEVER);
        if read.is_done() {
            event = event.min(colour.next_issue());
        } else if !read.is_idle() && !read.is_waiting() {
            event = now;
        }
        let blocked = address.ready(now).is_some() && !read.is_idle();
        if !blocked {
            event = event.min(address.next_event().unwrap_or(NEVER));
            if let Some(ended) = fifo1.front() {
                event = event.min(address.next_issue().max(ended.left + 1));
            }
        }
        Self {
            event: event.max(now),
            seen: now,
            address_stalls: blocked,
            read_stalls: read.is_waiting() || read.is_done(),
        }
    }

    /// Counts the stalls of the cycles before `now`.
    #[inline]
    pub fn catch_up(&mut self, now: u64, counters: &mut Counters) {
        let waited = now - self.seen;
        counters.address_stalls += waited * u64::from(self.address_stalls);
        counters.read_stalls += waited * u64::from(self.read_stalls);
        self.seen = now;
    }
}

/// Of the switch and the view calculations it serves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Switching {
    /// Nothing can be handed over before this cycle, unless FIFO #0 gets room or a view calculation that was full gives a result.
    pub event: u64,
    /// The first cycle whose stalls are not counted yet.
    pub seen: u64,
    /// From when on each view calculation stalls.
    stalls: [u64; MAX_UNITS as usize],
}

impl Switching {
    /// From cycle `now` on.
    #[inline]
    pub fn of<F: Format, const LINES: usize>(instances: &[Instance<F, LINES>], dry: bool, now: u64) -> Self {
        let mut switching = Self { event: NEVER, seen: now, stalls: [NEVER; MAX_UNITS as usize] };
        if dry {
            return switching;
        }
        for (instance, stalls) in instances.iter().zip(&mut switching.stalls) {
            let issue = instance.view.next_issue().max(now);
            if instance.has_room() || instance.view.is_full() {
                switching.event = switching.event.min(issue);
            } else {
                *stalls = issue;
            }
        }
        switching
    }

    /// Counts the stalls of the cycles before `now`.
    #[inline]
    pub fn catch_up(&mut self, now: u64, counters: &mut Counters) {
        for stalls in &self.stalls {
            counters.view_stalls += now.saturating_sub(self.seen.max(*stalls));
        }
        self.seen = now;
    }
}
