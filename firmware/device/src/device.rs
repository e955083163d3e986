//! The wiring; in: accesses and clocks, out: words and the interrupt line; cost: the units' own.

use lucerna_bus::{Target, TargetError};
use lucerna_displace::engine::{SizeError, Sizes};
use lucerna_regs::ident;
use lucerna_softfloat::Format;

use crate::block::{Absent, Block, Identity};
use crate::displace::DisplaceBlock;
use crate::pree::PreeBlock;
use crate::shared::Shared;

/// A device: memory `M`, a radiance estimation engine `P` and a displacement unit `D`, either of which may be [`Absent`].
#[derive(Clone, Debug)]
pub struct Device<M, P, D> {
    shared: Shared,
    pree: P,
    displace: D,
    memory: M,
}

/// A device with one PREE of `N` PREUs of format `F`.
pub type PreeDevice<F, const N: usize, M> = Device<M, PreeBlock<F, N>, Absent>;

/// A device with a displacement unit of format `F`: up to `U` instances with caches of up to `L` lines.
pub type DisplaceDevice<F, const U: usize, const L: usize, M> = Device<M, Absent, DisplaceBlock<F, U, L>>;

/// A device with both units, of one format.
pub type FullDevice<F, const N: usize, const U: usize, const L: usize, M> =
    Device<M, PreeBlock<F, N>, DisplaceBlock<F, U, L>>;

impl<F: Format, const N: usize, M> PreeDevice<F, N, M> {
    /// A device after reset, around its memory. Only the first 2^30 - 1 words of it can be addressed.
    pub fn new(memory: M) -> Self {
        Self { shared: Shared::default(), pree: PreeBlock::new(), displace: Absent, memory }
    }
}

impl<F: Format, const U: usize, const L: usize, M> DisplaceDevice<F, U, L, M> {
    /// A device after reset, around its memory. Only the first 2^30 - 1 words of it can be addressed.
    ///
    /// # Errors
    /// Sizes that the unit cannot have.
    pub fn new(sizes: Sizes, memory: M) -> Result<Self, SizeError> {
        Ok(Self { shared: Shared::default(), pree: Absent, displace: DisplaceBlock::new(sizes)?, memory })
    }
}

impl<F: Format, const N: usize, const U: usize, const L: usize, M> FullDevice<F, N, U, L, M> {
    /// A device after reset, around its memory. Only the first 2^30 - 1 words of it can be addressed.
    ///
    /// # Errors
    /// Sizes that the displacement unit cannot have.
    pub fn new(sizes: Sizes, memory: M) -> Result<Self, SizeError> {
        let displace = DisplaceBlock::new(sizes)?;
        Ok(Self { shared: Shared::default(), pree: PreeBlock::new(), displace, memory })
    }
}

impl<M: AsRef<[u32]>, P: Block, D: Block> Device<M, P, D> {
    /// The memory, as it is.
    pub fn memory(&self) -> &[u32] {
        self.memory.as_ref()
    }

    fn memory_bytes(&self) -> u32 {
        u32::try_from(self.memory.as_ref().len()).map_or(u32::MAX / 4, |words| words.min(u32::MAX / 4)) * 4
    }

    /// The words `first..first + count` of the memory as indices, if they are there.
    fn span(&self, address: u32, count: usize) -> Result<core::ops::Range<usize>, TargetError> {
        if !address.is_multiple_of(4) {
            return Err(TargetError::Misaligned);
        }
        let first = (address / 4) as usize;
        let end = first.checked_add(count).ok_or(TargetError::OutOfRange)?;
        if end > (self.memory_bytes() / 4) as usize { Err(TargetError::OutOfRange) } else { Ok(first..end) }
    }

    /// The block `ident`: constants of the build.
    fn identify(&self, offset: u32) -> Option<u32> {
        let mut identity = Identity::NOBODY;
        self.pree.identify(&mut identity);
        self.displace.identify(&mut identity);
        Some(match offset {
            ident::ID => ident::ID_RESET,
            ident::VERSION => ident::Version::RESET.bits(),
            ident::CAPABILITIES => identity.capabilities.bits(),
            ident::PIPELINE => identity.pipeline.bits(),
            ident::MEMORY_BYTES => self.memory_bytes(),
            _ => return None,
        })
    }
}

impl<M: AsRef<[u32]> + AsMut<[u32]>, P: Block, D: Block> Target for Device<M, P, D> {
    fn read(&mut self, offset: u32) -> Result<u32, TargetError> {
        if !offset.is_multiple_of(4) {
            return Err(TargetError::Misaligned);
        }
        let word = self.shared.read(offset).or_else(|| self.pree.read(offset));
        let word = word.or_else(|| self.displace.read(offset)).or_else(|| self.identify(offset));
        word.ok_or(TargetError::Unmapped)
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError> {
        if !offset.is_multiple_of(4) {
            return Err(TargetError::Misaligned);
        }
        if self.shared.write(offset, value).is_some() {
            return Ok(());
        }
        let windows = self.shared.windows(self.memory_bytes());
        let raised = self.pree.write(offset, value, &windows);
        match raised.or_else(|| self.displace.write(offset, value, &windows)) {
            Some(raised) => self.shared.raise(raised),
            None if self.identify(offset).is_some() => {}
            None => return Err(TargetError::Unmapped),
        }
        Ok(())
    }

    fn load(&self, address: u32, words: &mut [u32]) -> Result<(), TargetError> {
        let span = self.span(address, words.len())?;
        words.copy_from_slice(&self.memory.as_ref()[span]);
        Ok(())
    }

    fn store(&mut self, address: u32, words: &[u32]) -> Result<(), TargetError> {
        let span = self.span(address, words.len())?;
        self.memory.as_mut()[span].copy_from_slice(words);
        Ok(())
    }

    fn tick(&mut self) {
        let memory = self.memory.as_mut();
        self.shared.raise(self.pree.tick(memory));
        self.shared.raise(self.displace.tick(memory));
    }

    /// A unit that runs alone goes as fast as it can, and the idle one costs nothing. Two at once go clock by clock, since
    /// nothing keeps their buffers apart.
    fn advance(&mut self, mut cycles: u64) {
        while cycles > 0 {
            let memory = self.memory.as_mut();
            let (used, raised) = match (self.pree.is_running(), self.displace.is_running()) {
                (true, true) => {
                    self.tick();
                    cycles -= 1;
                    continue;
                }
                (true, false) => self.pree.advance(memory, cycles),
                (false, true) => self.displace.advance(memory, cycles),
                (false, false) => return,
            };
            self.shared.raise(raised);
            cycles -= used;
        }
    }

    fn interrupt(&self) -> bool {
        self.shared.interrupt()
    }
}

#[cfg(test)]
mod tests {
    use super::Device;
    use crate::block::{Block, Identity};
    use crate::shared::Shared;
    use lucerna_bus::Target;
    use lucerna_fabric::window::Windows;
    use lucerna_regs::interrupts::Status;
    use lucerna_regs::window;

    /// Runs for so many cycles, signs the memory in each of them, and knows how it was clocked.
    #[derive(Clone)]
    struct Clocked {
        signature: u32,
        left: u64,
        ticks: u64,
        advances: u64,
    }

    impl Clocked {
        fn cycle(&mut self, memory: &mut [u32]) -> Status {
            if self.left == 0 {
                return Status::RESET;
            }
            memory[0] = memory[0].wrapping_mul(31).wrapping_add(self.signature);
            self.left -= 1;
            Status::from_bits(if self.left == 0 { self.signature } else { 0 })
        }
    }

    impl Block for Clocked {
        fn identify(&self, _: &mut Identity) {}
        fn read(&self, _: u32) -> Option<u32> {
            None
        }
        fn write(&mut self, _: u32, _: u32, _: &Windows<{ window::COUNT }>) -> Option<Status> {
            None
        }
        fn is_running(&self) -> bool {
            self.left > 0
        }
        fn tick(&mut self, memory: &mut [u32]) -> Status {
            self.ticks += 1;
            self.cycle(memory)
        }
        fn advance(&mut self, memory: &mut [u32], cycles: u64) -> (u64, Status) {
            self.advances += 1;
            let used = cycles.min(self.left);
            (used, (0..used).map(|_| self.cycle(memory)).last().unwrap_or_default())
        }
    }

    fn device(left: [u64; 2]) -> Device<[u32; 1], Clocked, Clocked> {
        let [pree, displace] = [(1, left[0]), (2, left[1])].map(|(signature, left)| Clocked {
            signature,
            left,
            ticks: 0,
            advances: 0,
        });
        Device { shared: Shared::default(), pree, displace, memory: [0] }
    }

    #[test]
    fn advance_is_that_many_ticks() {
        for left in [[0, 0], [5, 0], [0, 5], [5, 5], [5, 9], [9, 5], [1, 100]] {
            for cycles in 0..20 {
                let (mut fast, mut slow) = (device(left), device(left));
                fast.advance(cycles);
                (0..cycles).for_each(|_| slow.tick());
                assert_eq!(fast.memory, slow.memory, "{left:?} after {cycles}");
                assert_eq!(
                    (fast.pree.left, fast.displace.left, fast.shared.status()),
                    (slow.pree.left, slow.displace.left, slow.shared.status()),
                    "{left:?} after {cycles}"
                );
            }
        }
    }

    /// Clock by clock only while both run.
    #[test]
    fn a_unit_alone_goes_as_fast_as_it_can() {
        let mut both = device([4, 1000]);
        both.advance(u64::MAX);
        assert_eq!((both.pree.ticks, both.pree.advances), (4, 0));
        assert_eq!((both.displace.ticks, both.displace.advances), (4, 1));
        both.advance(u64::MAX);
        assert_eq!(both.displace.advances, 1, "nobody at work: nothing to do");
    }
}
