//! A bus which fails on purpose. In: accesses and a plan. Out: the inner bus's answers, or an injected fault.
//! Cost: a count and a comparison an access.

use core::fmt;

use crate::Bus;

/// Which accesses fail. Accesses are counted from 0, of all four kinds together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Fault {
    /// None.
    #[default]
    Never,
    /// The access with this number.
    Nth(u64),
    /// Every access whose number plus one is a multiple of this (0: none).
    Every(u64),
    /// All accesses from this number on, as from a cable pulled out.
    From(u64),
    /// Register reads and writes at this offset.
    Offset(u32),
    /// Blocks which begin at this address.
    Block(u32),
}

/// When a fault strikes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Moment {
    /// The device never sees the access.
    #[default]
    Before,
    /// The device has acted, but its answer is lost.
    After,
}

/// Wraps a bus and fails the accesses of a plan.
#[derive(Clone, Debug)]
pub struct Faulty<B> {
    bus: B,
    fault: Fault,
    moment: Moment,
    accesses: u64,
    injected: u64,
}

/// Where an access goes, as the plan sees it.
enum Place {
    Register(u32),
    Memory(u32),
}

impl<B: Bus> Faulty<B> {
    /// A bus that fails `fault`, before the device sees it.
    pub const fn new(bus: B, fault: Fault) -> Self {
        Self { bus, fault, moment: Moment::Before, accesses: 0, injected: 0 }
    }

    /// Chooses whether the device sees a failed access.
    pub const fn at(mut self, moment: Moment) -> Self {
        self.moment = moment;
        self
    }

    /// Another plan from here on; the count goes on.
    pub const fn plan(&mut self, fault: Fault) {
        self.fault = fault;
    }

    /// Accesses so far, failed ones included.
    pub const fn accesses(&self) -> u64 {
        self.accesses
    }

    /// Faults injected so far.
    pub const fn injected(&self) -> u64 {
        self.injected
    }

    /// The wrapped bus.
    pub fn into_inner(self) -> B {
        self.bus
    }

    fn access<R>(
        &mut self,
        place: Place,
        act: impl FnOnce(&mut B) -> Result<R, B::Error>,
    ) -> Result<R, FaultyError<B::Error>> {
        let number = self.accesses;
        self.accesses += 1;
        let strikes = match (self.fault, place) {
            (Fault::Never, _) => false,
            (Fault::Nth(n), _) => number == n,
            (Fault::Every(k), _) => k != 0 && (number + 1).is_multiple_of(k),
            (Fault::From(n), _) => number >= n,
            (Fault::Offset(offset), Place::Register(at)) => at == offset,
            (Fault::Block(address), Place::Memory(at)) => at == address,
            (Fault::Offset(_) | Fault::Block(_), _) => false,
        };
        if strikes {
            self.injected += 1;
            if self.moment == Moment::After {
                // The device's own error, if any, is lost with the answer.
                let _ = act(&mut self.bus);
            }
            return Err(FaultyError::Injected);
        }
        act(&mut self.bus).map_err(FaultyError::Bus)
    }
}

impl<B: Bus> Bus for Faulty<B> {
    type Error = FaultyError<B::Error>;

    fn read(&mut self, offset: u32) -> Result<u32, Self::Error> {
        self.access(Place::Register(offset), |bus| bus.read(offset))
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), Self::Error> {
        self.access(Place::Register(offset), |bus| bus.write(offset, value))
    }

    fn read_block(&mut self, address: u32, words: &mut [u32]) -> Result<(), Self::Error> {
        self.access(Place::Memory(address), |bus| bus.read_block(address, words))
    }

    fn write_block(&mut self, address: u32, words: &[u32]) -> Result<(), Self::Error> {
        self.access(Place::Memory(address), |bus| bus.write_block(address, words))
    }
}

/// Why an access of a [`Faulty`] bus failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FaultyError<E> {
    /// The plan said so.
    Injected,
    /// The wrapped bus failed by itself.
    Bus(E),
}

impl<E: fmt::Display> fmt::Display for FaultyError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Injected => f.write_str("a fault was injected here: recover, as from any bus fault"),
            Self::Bus(error) => error.fmt(f),
        }
    }
}

impl<E: fmt::Debug + fmt::Display> core::error::Error for FaultyError<E> {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::target::ram::Ram;
    use crate::{Model, TargetError};

    /// Which of ten register writes fail.
    fn failed(fault: Fault, moment: Moment) -> (Vec<usize>, Vec<u32>) {
        let model = Model::new(Ram::default());
        let mut bus = Faulty::new(model.bus(), fault).at(moment);
        let failed = (0..8).filter(|n| bus.write(*n as u32 * 4, *n as u32 + 1).is_err()).collect();
        assert_eq!(bus.accesses(), 8);
        (failed, model.inspect(|ram| ram.registers.to_vec()))
    }

    #[test]
    fn plans_fail_what_they_say_and_nothing_else() {
        let numbers = |fault| failed(fault, Moment::Before).0;
        assert_eq!(numbers(Fault::Never), []);
        assert_eq!(numbers(Fault::Nth(3)), [3]);
        assert_eq!(numbers(Fault::Every(3)), [2, 5]);
        assert_eq!(numbers(Fault::Every(0)), []);
        assert_eq!(numbers(Fault::From(6)), [6, 7]);
        assert_eq!(numbers(Fault::Offset(20)), [5]);
        assert_eq!(numbers(Fault::Block(20)), []);
    }

    #[test]
    fn the_moment_decides_what_the_device_sees() {
        assert_eq!(failed(Fault::Nth(3), Moment::Before).1, [1, 2, 3, 0, 5, 6, 7, 8]);
        assert_eq!(failed(Fault::Nth(3), Moment::After).1, [1, 2, 3, 4, 5, 6, 7, 8]);
    }

    #[test]
    fn blocks_are_accesses_and_inner_errors_pass() {
        let model = Model::new(Ram::default());
        let mut bus = Faulty::new(model.bus(), Fault::Block(8));
        assert_eq!(bus.write_block(4, &[1, 2]), Ok(()));
        assert_eq!(bus.write_block(8, &[1, 2]), Err(FaultyError::Injected));
        assert_eq!(bus.read_block(8, &mut [0]), Err(FaultyError::Injected));
        assert_eq!(bus.read(8), Ok(0), "a register at the block's address is another place");
        assert_eq!(bus.read(1), Err(FaultyError::Bus(TargetError::Misaligned)));
        bus.plan(Fault::Never);
        assert_eq!(bus.read_block(8, &mut [0]), Ok(()));
        assert_eq!((bus.accesses(), bus.injected()), (6, 2));
    }
}
