//! The photon port; in: the ring in memory, out: photons with a list, up to four at hand; cost: one wide read a photon.
//!
//! The paper's external data controller (Fig. 5, dashed) drops photons whose cell is empty before the port (D9), so passing
//! over them takes no cycle here. The feed runs even while the engine's clock is gated, which is how a gated engine wakes.

use heapless::Deque;
use lucerna_fabric::window::Buffer;
use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::job::{Fault, FaultCode};
use crate::record::Arrival;
use crate::schedule::ENTRIES;

/// Photons on their way from the ring to the buffer.
#[derive(Clone, Debug)]
pub struct Feed<F> {
    ring: Buffer,
    normal_test: bool,
    lists: u32,
    head: u32,
    tail: u32,
    flush: bool,
    ready: Deque<Arrival<F>, ENTRIES>,
}

impl<F: Format> Feed<F> {
    /// A feed from an empty ring; `lists` is the number of entries of the index table.
    pub fn new(ring: Buffer, lists: u32, normal_test: bool) -> Self {
        Self { ring, normal_test, lists, head: 0, tail: 0, flush: false, ready: Deque::new() }
    }

    /// The doorbell: records up to `tail` (a free-running count) are in the ring.
    ///
    /// # Errors
    /// [`FaultCode::RingOverrun`] when that is more than the ring can hold.
    pub fn ring(&mut self, tail: u32) -> Result<(), Fault> {
        if tail.wrapping_sub(self.head) > self.ring.count() {
            return Err(Fault { code: FaultCode::RingOverrun, address: self.ring.address(0) });
        }
        self.tail = tail;
        Ok(())
    }

    /// No photon will come behind those in the ring (D2).
    pub fn flush(&mut self) {
        self.flush = true;
    }

    /// Whether [`flush`](Self::flush) was called.
    pub const fn is_flushing(&self) -> bool {
        self.flush
    }

    /// Records taken so far, a free-running count.
    pub const fn head(&self) -> u32 {
        self.head
    }

    /// Records in the ring that were not taken yet.
    pub const fn waiting(&self) -> u32 {
        self.tail.wrapping_sub(self.head)
    }

    /// Takes records from the ring until four photons with a list are at hand or the ring is empty.
    ///
    /// # Errors
    /// [`FaultCode::IndexRange`] for a list that leaves the index table.
    #[inline]
    pub fn fetch(&mut self, memory: &[u32], counters: &mut Counters) -> Result<(), Fault> {
        while self.head != self.tail && !self.ready.is_full() {
            let record = self.head % self.ring.count();
            let fault = Fault { code: FaultCode::IndexRange, address: self.ring.address(record) };
            let arrival = Arrival::read(memory, &self.ring, record, self.normal_test).ok_or(fault)?;
            let end = arrival.p_addr.checked_add(arrival.n).ok_or(fault)?;
            if end > self.lists {
                return Err(fault);
            }
            self.head = self.head.wrapping_add(1);
            counters.photons += 1;
            match arrival.n {
                0 => counters.empty_cells += 1,
                // The loop's condition made room.
                _ => _ = self.ready.push_back(arrival),
            }
        }
        Ok(())
    }

    /// Whether the engine must wait: it would load `wanted` photons, they are not at hand, and more may come.
    #[inline]
    pub fn starves(&self, wanted: usize) -> bool {
        self.ready.len() < wanted && !self.flush
    }

    /// Whether nothing will come any more.
    #[inline]
    pub fn is_dry(&self) -> bool {
        self.flush && self.ready.is_empty() && self.head == self.tail
    }

    /// The next photon.
    #[inline]
    pub fn take(&mut self) -> Option<Arrival<F>> {
        self.ready.pop_front()
    }
}
