//! An update job taking photons. In: photons. Out: how many fitted into the ring. Cost: a block write and a
//! doorbell per 32 photons; RING_HEAD is only read when the known room does not suffice.
//!
//! Back-pressure: [`Stream::push`] takes what fits and says how much that was; [`Stream::push_all`] waits.

use embedded_hal::delay::DelayNs;
use embedded_hal_async::delay::DelayNs as AsyncDelayNs;
use embedded_hal_async::digital::Wait;
use lucerna_bus::Bus;
use lucerna_regs::ident::NumberFormat;
use lucerna_regs::{interrupts, pree};

use crate::deadline::Backoff;
use crate::interrupt::{Ended, watch};
use crate::layout::Buffer;
use crate::records::{PHOTON_NORMAL_WORDS, PHOTON_WORDS, Photon};
use crate::{Cause, Counters, Deadline, Error, Lucerna, Progress, Run, State, UpdateJob};

/// Photons in one block write: 1.5 KiB of stack.
pub const PUSH_BLOCK: usize = 32;

/// The event of room in the ring.
const SPACE: interrupts::Status = interrupts::Status::RESET.with_ring_space(true);

/// What wakes a stream that waits for room.
const WAKE: interrupts::Enable = interrupts::Enable::RESET.with_ring_space(true).with_error(true);

/// The driver's end of the ring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ring {
    pub(crate) base: u32,
    pub(crate) entries: u32,
    pub(crate) format: NumberFormat,
    pub(crate) normal_test: bool,
    /// Records waiting at which the ring-space interrupt is raised.
    pub(crate) low: u32,
    /// Records announced, modulo 2^32 as in RING_TAIL.
    pub(crate) tail: u32,
    /// Slots known to be free: never more than there are.
    pub(crate) free: u32,
    pub(crate) pushed: u64,
}

impl Ring {
    pub(crate) const fn new(job: &UpdateJob) -> Self {
        let layout = job.layout();
        let sizes = layout.sizes();
        Self {
            base: layout.region(Buffer::Ring).base(),
            entries: sizes.ring_entries,
            format: layout.format(),
            normal_test: sizes.normal_test,
            low: job.ring_low(),
            tail: 0,
            free: sizes.ring_entries,
            pushed: 0,
        }
    }

    const fn record_words(&self) -> usize {
        if self.normal_test { PHOTON_NORMAL_WORDS } else { PHOTON_WORDS }
    }

    /// The next slot, and how many follow it without a turn.
    const fn slot(&self) -> (u32, u32) {
        let slot = self.tail & (self.entries - 1);
        (slot, self.entries - slot)
    }

    const fn address(&self, slot: u32) -> u32 {
        self.base + slot * self.record_words() as u32 * 4
    }

    /// Room to wait for once the ring is full: a quarter, so that the head is read rarely and the device, with
    /// three quarters left, does not starve; no more than the ring-space interrupt announces.
    const fn worthwhile(&self) -> u32 {
        let quarter = self.entries.div_ceil(4);
        let announced = self.entries - self.low;
        if quarter < announced { quarter } else { announced }
    }

    /// Packs photons into a block; gives the words used.
    fn pack<'b>(
        &self,
        photons: &[Photon],
        block: &'b mut [u32; PUSH_BLOCK * PHOTON_NORMAL_WORDS],
    ) -> &'b [u32] {
        if self.normal_test {
            let (records, _) = block.as_chunks_mut::<PHOTON_NORMAL_WORDS>();
            for (record, photon) in records.iter_mut().zip(photons) {
                *record = photon.pack_normal(self.format);
            }
        } else {
            let (records, _) = block.as_chunks_mut::<PHOTON_WORDS>();
            for (record, photon) in records.iter_mut().zip(photons) {
                *record = photon.pack(self.format);
            }
        }
        block.get(..photons.len() * self.record_words()).unwrap_or(block)
    }
}

/// A running update job which takes photons until it is flushed.
///
/// If it is dropped, the job runs on without an end: nothing else can be started ([`Cause::NotReady`]) until
/// [`Pree::resume`](crate::Pree::resume) takes it up again, or [`Lucerna::recover`] gives it up.
#[derive(Debug)]
#[must_use = "dropped, the job runs on and the next start fails with NotReady: finish, flush or abort it"]
pub struct Stream<'a, B, D> {
    device: &'a mut Lucerna<B, D>,
    ring: Ring,
}

impl<'a, B: Bus, D: DelayNs> Stream<'a, B, D> {
    pub(crate) const fn new(device: &'a mut Lucerna<B, D>, ring: Ring) -> Self {
        Self { device, ring }
    }

    /// Puts as many photons as there is room for into the ring, from the front, without waiting; says how many.
    ///
    /// After an error, [`pushed`](Self::pushed) tells how many the device has been given in all.
    pub fn push(&mut self, photons: &[Photon]) -> Result<usize, Error<B::Error>> {
        self.device.expect(State::Running)?;
        if (self.ring.free as usize) < photons.len() {
            self.refresh()?;
        }
        let room = photons.len().min(self.ring.free as usize);
        if room == 0 && !photons.is_empty() {
            // A job that has ended in an error takes no more: better say so than "full".
            self.device.poll()?;
        }
        let (mut rest, _) = photons.split_at(room);
        let mut block = [0; PUSH_BLOCK * PHOTON_NORMAL_WORDS];
        while !rest.is_empty() {
            let (slot, straight) = self.ring.slot();
            let (now, later) = rest.split_at(rest.len().min(PUSH_BLOCK).min(straight as usize));
            self.device.store(self.ring.address(slot), self.ring.pack(now, &mut block))?;
            let tail = self.ring.tail.wrapping_add(now.len() as u32);
            self.device.command(pree::RING_TAIL, tail)?;
            self.ring.tail = tail;
            self.ring.free -= now.len() as u32;
            self.ring.pushed += now.len() as u64;
            rest = later;
        }
        Ok(room)
    }

    /// Puts all photons into the ring and waits for room as often as needed, `deadline` in all. Once the ring is
    /// full it waits until a quarter is free: the crate's front page says how large to make it.
    ///
    /// After an error, [`pushed`](Self::pushed) tells how many the device has been given in all.
    pub fn push_all(&mut self, photons: &[Photon], deadline: Deadline) -> Result<(), Error<B::Error>> {
        let mut backoff = Backoff::new(deadline);
        let mut rest = self.push_front(photons)?;
        while !rest.is_empty() {
            backoff.restart();
            while self.ring.free < self.ring.worthwhile() {
                let Some(pause) = backoff.next() else {
                    return Err(self.device.error(Cause::Timeout));
                };
                self.device.delay.delay_us(pause);
                self.look()?;
            }
            rest = self.push_front(rest)?;
        }
        Ok(())
    }

    /// As [`push_all`](Self::push_all), woken by the ring-space interrupt. `delay` bounds each wait for room by
    /// `deadline`; a lost interrupt only makes it slower, as the ring is looked at every ten milliseconds.
    ///
    /// The future may be dropped: what [`pushed`](Self::pushed) tells is in the ring.
    pub async fn push_all_on(
        &mut self,
        photons: &[Photon],
        irq: &mut impl Wait,
        delay: &mut impl AsyncDelayNs,
        deadline: Deadline,
    ) -> Result<(), Error<B::Error>> {
        let mut rest = self.push_front(photons)?;
        while !rest.is_empty() {
            self.room_on(irq, delay, deadline).await?;
            rest = self.push_front(rest)?;
        }
        Ok(())
    }

    /// Waits for room by the line; it is enabled only meanwhile.
    async fn room_on(
        &mut self,
        irq: &mut impl Wait,
        delay: &mut impl AsyncDelayNs,
        deadline: Deadline,
    ) -> Result<(), Error<B::Error>> {
        self.device.adjust(interrupts::STATUS, SPACE.bits())?;
        self.device.adjust(interrupts::ENABLE, WAKE.bits())?;
        // Only now that the old event is cleared: room made from here on raises the line.
        self.look()?;
        let enough = self.ring.free >= self.ring.worthwhile();
        let result = if enough { Ok(()) } else { watch(irq, delay, deadline, |_| self.roomy()).await };
        let disabled = self.device.adjust(interrupts::ENABLE, 0);
        match result {
            Ok(()) => disabled,
            Err(Ended::Look(error)) => Err(error),
            Err(Ended::Pin) => Err(self.device.error(Cause::Pin)),
            Err(Ended::Deadline) => Err(self.device.error(Cause::Timeout)),
        }
    }

    /// A look that ends the wait when there is room worth a visit.
    fn roomy(&mut self) -> Result<Option<()>, Error<B::Error>> {
        self.look()?;
        Ok((self.ring.free >= self.ring.worthwhile()).then_some(()))
    }

    fn push_front<'p>(&mut self, photons: &'p [Photon]) -> Result<&'p [Photon], Error<B::Error>> {
        let accepted = self.push(photons)?;
        Ok(photons.split_at(accepted).1)
    }

    /// Looks for room, and for an error if there is no more than before.
    fn look(&mut self) -> Result<(), Error<B::Error>> {
        let before = self.ring.free;
        self.refresh()?;
        if self.ring.free == before {
            self.device.poll()?;
        }
        Ok(())
    }

    /// Asks the device how much it has taken. The head only moves forward, and never past the tail.
    fn refresh(&mut self) -> Result<(), Error<B::Error>> {
        let head = self.device.read(pree::RING_HEAD)?;
        let waiting = self.ring.tail.wrapping_sub(head);
        let known = self.ring.entries - self.ring.free;
        if waiting > known {
            return Err(self.device.overrun(head, self.ring.tail));
        }
        self.ring.free = self.ring.entries - waiting;
        Ok(())
    }

    /// Photons the device has been given so far.
    pub const fn pushed(&self) -> u64 {
        self.ring.pushed
    }

    /// Slots known to be free, without asking the device: at least so many photons can be pushed.
    pub const fn room(&self) -> usize {
        self.ring.free as usize
    }

    /// One look for an error; the job cannot be done before it is flushed.
    pub fn poll(&mut self) -> Result<(), Error<B::Error>> {
        self.device.poll().map(|_: Progress| ())
    }

    /// No more photons come: the device works off the ring and its buffer (D2), then is done.
    pub fn flush(self) -> Result<Run<'a, B, D>, Error<B::Error>> {
        self.device.expect(State::Running)?;
        self.device.command(pree::CONTROL, pree::Control::RESET.with_flush(true).bits())?;
        Ok(Run::new(self.device))
    }

    /// Flushes, and waits until all is written back.
    pub fn finish(self, deadline: Deadline) -> Result<(), Error<B::Error>> {
        self.flush()?.wait(deadline)
    }

    /// See [`Lucerna::counters`]; the job runs on.
    pub fn counters(&mut self) -> Result<Counters, Error<B::Error>> {
        self.device.counters()
    }

    /// Gives the job up. See [`Lucerna::recover`].
    pub fn abort(self) -> Result<(), Error<B::Error>> {
        self.device.recover()
    }
}

#[cfg(test)]
mod tests {
    use lucerna_bus::{Access, Scripted};

    use super::*;
    use crate::{Capabilities, Layout, Policies, Sizes};

    struct NoDelay;

    impl DelayNs for NoDelay {
        fn delay_ns(&mut self, _: u32) {}
    }

    /// Two billion photons later: the free-running counts turn over, and the slots go on.
    #[test]
    fn the_counts_turn_over_at_2_to_the_32() {
        let device = Capabilities {
            version: (1, 1),
            preus: 4,
            format: NumberFormat::F32,
            buffer_entries: 4,
            units: 1,
            update_stages: 10,
            evaluate_stages: 12,
            operand_latency: 0,
            memory_bytes: 4096,
            displace: None,
        };
        let sizes = Sizes { hit_points: 1, index_entries: 1, pixels: 1, ring_entries: 8, normal_test: false };
        let layout = Layout::packed(&device, sizes).unwrap();
        let job = UpdateJob::new(&layout, 0.5, Policies::default()).unwrap();
        let base = layout.region(Buffer::Ring).base();

        let photon = Photon { p_addr: 7, ..Photon::default() };
        let record = [0, 0, 0, 0, 0, 0, 7, 0];
        let (two, three) = (record.repeat(2), record.repeat(3));
        let script = [
            Access::Read(0x000, 0x4C55_4352),
            Access::Read(0x004, 0x0001_0001),
            Access::Read(0x008, 0x0001_4004),
            Access::Read(0x00C, 0x0000_0C0A),
            Access::Read(0x010, 4096),
            Access::Read(0x108, 1),
            // Slots 6 and 7, then 0 to 2.
            Access::WriteBlock(base + 6 * 32, &two),
            Access::Write(0x140, 0),
            Access::WriteBlock(base, &three),
            Access::Write(0x140, 3),
            // All but the last one taken.
            Access::Read(0x13C, 2),
        ];
        let mut bus = Scripted::new(&script);
        let mut device = Lucerna::probe(&mut bus, NoDelay).unwrap();
        assert_eq!(device.state(), State::Running);
        let ring = Ring { tail: u32::MAX - 1, ..Ring::new(&job) };
        let mut stream = Stream::new(&mut device, ring);
        assert_eq!(stream.push(&[photon; 5]), Ok(5));
        assert_eq!(stream.room(), 3);
        stream.refresh().unwrap();
        assert_eq!(stream.room(), 7);
        bus.finish().unwrap();
    }
}
