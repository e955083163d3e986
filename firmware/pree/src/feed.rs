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
    /// The record at the head is bad.
    bad: Option<Fault>,
}

impl<F: Format> Feed<F> {
    /// A feed from an empty ring; `lists` is the number of entries of the index table.
    pub fn new(ring: Buffer, lists: u32, normal_test: bool) -> Self {
        Self { ring, normal_test, lists, head: 0, tail: 0, flush: false, ready: Deque::new(), bad: None }
    }

    /// The doorbell: records up to `tail` (a free-running count) are in the ring.
    ///
    /// # Errors
    /// [`FaultCode::RingOverrun`] when that is more than the ring can hold, or when more come after [`flush`](Self::flush).
    pub fn ring(&mut self, tail: u32) -> Result<(), Fault> {
        let late = self.flush && tail != self.tail;
        if late || tail.wrapping_sub(self.head) > self.ring.count() {
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

    /// Takes records from the ring until four photons with a list are at hand, the ring is empty, or a record is bad.
    #[inline]
    pub fn fetch(&mut self, memory: &[u32], counters: &mut Counters) {
        while self.head != self.tail && !self.ready.is_full() && self.bad.is_none() {
            let Some(arrival) = self.read(memory) else {
                let record = self.head % self.ring.count();
                self.bad = Some(Fault { code: FaultCode::IndexRange, address: self.ring.address(record) });
                return;
            };
            self.head = self.head.wrapping_add(1);
            counters.photons += 1;
            match arrival.n {
                0 => counters.empty_cells += 1,
                // The loop's condition made room.
                _ => _ = self.ready.push_back(arrival),
            }
        }
    }

    /// The record at the head, if its list lies in the index table.
    #[inline]
    fn read(&self, memory: &[u32]) -> Option<Arrival<F>> {
        let record = self.head % self.ring.count();
        let arrival = Arrival::read(memory, &self.ring, record, self.normal_test)?;
        let end = arrival.p_addr.checked_add(arrival.n)?;
        (end <= self.lists).then_some(arrival)
    }

    /// Whether the engine must wait: it would load `wanted` photons, they are not at hand, and more may come.
    #[inline]
    pub fn starves(&self, wanted: usize) -> bool {
        self.ready.len() < wanted && !self.flush && self.bad.is_none()
    }

    /// Whether nothing will come any more.
    #[inline]
    pub fn is_dry(&self) -> bool {
        self.flush && self.ready.is_empty() && self.head == self.tail
    }

    /// The next photon.
    ///
    /// # Errors
    /// [`FaultCode::IndexRange`] when it is the turn of one whose list leaves the index table: not sooner, so that what was
    /// done before does not depend on how far the feed has run ahead.
    #[inline]
    pub fn take(&mut self) -> Result<Option<Arrival<F>>, Fault> {
        match self.ready.pop_front() {
            None => self.bad.map_or(Ok(None), Err),
            next => Ok(next),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lucerna_fabric::window::{Window, Windows};
    use lucerna_softfloat::F32;

    const RECORD: usize = 8;

    /// A ring of four records in memory of just that size.
    fn feed(lists: u32) -> Feed<F32> {
        let bytes = 4 * RECORD as u32 * 4;
        let ring = Windows::new([Window { base: 0, limit: bytes }], bytes).buffer(0, 4, RECORD as u32);
        Feed::new(ring.unwrap(), lists, false)
    }

    fn record(memory: &mut [u32; 4 * RECORD], number: u32, p_addr: u32, n: u32) {
        let first = (number % 4) as usize * RECORD;
        memory[first..first + RECORD].copy_from_slice(&[0, 0, 0, 0, 0, 0, p_addr, n]);
    }

    #[test]
    fn overrun_is_one_more_than_there_is_room_for() {
        let mut feed = feed(1);
        assert_eq!(feed.ring(4), Ok(()));
        assert_eq!(feed.ring(5).unwrap_err().code, FaultCode::RingOverrun);
        assert_eq!(feed.waiting(), 4, "a refused doorbell changes nothing");
        assert_eq!(feed.ring(u32::MAX).unwrap_err().code, FaultCode::RingOverrun, "behind the head");
    }

    /// Head and tail go on over 2^32, and slots follow them.
    #[test]
    fn counts_wrap() {
        let mut feed = feed(100);
        (feed.head, feed.tail) = (u32::MAX - 1, u32::MAX - 1);
        let mut memory = [0; 4 * RECORD];
        for (place, number) in [u32::MAX - 1, u32::MAX, 0].into_iter().enumerate() {
            record(&mut memory, number, place as u32 * 10, 1);
        }
        assert_eq!(feed.ring(1), Ok(()));
        assert_eq!(feed.waiting(), 3);
        feed.fetch(&memory, &mut Counters::default());
        let order = core::array::from_fn(|_| feed.take().unwrap().unwrap().p_addr);
        assert_eq!(order, [0, 10, 20]);
        assert_eq!(feed.head(), 1);
    }

    #[test]
    fn empty_lists_are_passed_over_and_counted() {
        let (mut feed, mut memory, mut counters) = (feed(100), [0; 4 * RECORD], Counters::default());
        record(&mut memory, 3, 7, 2);
        feed.ring(4).unwrap();
        feed.fetch(&memory, &mut counters);
        assert_eq!((counters.photons, counters.empty_cells), (4, 3));
        assert_eq!(feed.take().unwrap().map(|arrival| (arrival.p_addr, arrival.n)), Some((7, 2)));
        assert!(feed.take().unwrap().is_none());
    }

    /// The list may end with the table; one entry more is a fault at the record's address.
    #[test]
    fn lists_end_with_the_table() {
        for (p_addr, n, is_good) in
            [(8, 2, true), (9, 2, false), (10, 0, true), (11, 0, false), (u32::MAX, 2, false)]
        {
            let (mut feed, mut memory) = (feed(10), [0; 4 * RECORD]);
            record(&mut memory, 1, p_addr, n);
            feed.ring(2).unwrap();
            feed.fetch(&memory, &mut Counters::default());
            let fault = Fault { code: FaultCode::IndexRange, address: 4 * RECORD as u32 };
            assert_eq!(feed.take().err(), (!is_good).then_some(fault), "{p_addr} {n}");
        }
    }

    #[test]
    fn starves_until_the_flush() {
        let mut feed = feed(1);
        assert!(feed.starves(1) && !feed.starves(0) && !feed.is_dry());
        feed.ring(1).unwrap();
        feed.flush();
        assert!(!feed.starves(4) && !feed.is_dry(), "what is in the ring still comes");
        feed.fetch(&[0; 4 * RECORD], &mut Counters::default());
        assert!(feed.is_dry());
        assert_eq!(feed.ring(1), Ok(()), "the same again announces nothing");
        assert_eq!(feed.ring(2).unwrap_err().code, FaultCode::RingOverrun, "more after the flush");
    }
}
