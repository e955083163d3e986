//! A bus that expects an exact list of accesses. In: the list with its answers. Out: the answers, or the first
//! access which differs. Cost: a comparison an access; nothing is allocated.
//!
//! After the first divergence every access fails: what follows a wrong access means nothing.

use core::fmt;

use crate::Bus;

/// An access a script expects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access<'a> {
    /// A register read at this offset, answered with this value.
    Read(u32, u32),
    /// A register write at this offset, of this value.
    Write(u32, u32),
    /// A block read at this address, as long as, and answered with, these words.
    ReadBlock(u32, &'a [u32]),
    /// A block write at this address, of these words.
    WriteBlock(u32, &'a [u32]),
    /// A register read at this offset, refused.
    FailRead(u32),
    /// A register write at this offset, of this value, refused.
    FailWrite(u32, u32),
}

/// The access that was made where a script diverged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Found {
    /// The script was not finished: nothing more was accessed.
    Nothing,
    /// A register read.
    Read {
        /// Its byte offset.
        offset: u32,
    },
    /// A register write.
    Write {
        /// Its byte offset.
        offset: u32,
        /// The value written.
        value: u32,
    },
    /// A block read.
    ReadBlock {
        /// Its byte address.
        address: u32,
        /// Its length in words.
        words: usize,
    },
    /// A block write.
    WriteBlock {
        /// Its byte address.
        address: u32,
        /// Its length in words.
        words: usize,
        /// Index and value of the first word that differs, or of the first word when the place differs.
        differs: Option<(usize, u32)>,
    },
}

/// Where an access differed from the script.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Divergence<'a> {
    /// The access's number, from 0.
    pub position: usize,
    /// What the script expects there; `None` after its end.
    pub expected: Option<Access<'a>>,
    /// What was accessed.
    pub found: Found,
}

impl fmt::Display for Divergence<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "access {}: expected ", self.position)?;
        match self.expected {
            Some(access) => write!(f, "{access:x?}")?,
            None => f.write_str("no more accesses")?,
        }
        match self.found {
            Found::Nothing => f.write_str(", but the accesses end here"),
            found => write!(f, ", found {found:x?}"),
        }
    }
}

impl core::error::Error for Divergence<'_> {}

/// A bus that follows a list of accesses.
#[derive(Clone, Debug)]
pub struct Scripted<'a> {
    script: &'a [Access<'a>],
    position: usize,
    divergence: Option<Divergence<'a>>,
}

impl<'a> Scripted<'a> {
    /// Expects exactly the accesses of `script`, in order.
    pub const fn new(script: &'a [Access<'a>]) -> Self {
        Self { script, position: 0, divergence: None }
    }

    /// The first divergence so far.
    pub const fn divergence(&self) -> Option<Divergence<'a>> {
        self.divergence
    }

    /// Accesses that went as the script says.
    pub const fn position(&self) -> usize {
        self.position
    }

    /// Whether all of the script, and nothing else, was accessed; call it at a test's end.
    pub fn finish(&self) -> Result<(), Divergence<'a>> {
        match (self.divergence, self.script.get(self.position)) {
            (Some(divergence), _) => Err(divergence),
            (None, Some(next)) => {
                Err(Divergence { position: self.position, expected: Some(*next), found: Found::Nothing })
            }
            (None, None) => Ok(()),
        }
    }

    /// Takes the next access of the script if `matches` likes it, else notes the divergence.
    fn next<R>(
        &mut self,
        found: Found,
        matches: impl FnOnce(Access<'a>) -> Option<Result<R, ScriptError>>,
    ) -> Result<R, ScriptError> {
        if self.divergence.is_some() {
            return Err(ScriptError::Diverged);
        }
        let expected = self.script.get(self.position).copied();
        if let Some(answer) = expected.and_then(matches) {
            self.position += 1;
            return answer;
        }
        self.divergence = Some(Divergence { position: self.position, expected, found });
        Err(ScriptError::Diverged)
    }
}

impl Bus for Scripted<'_> {
    type Error = ScriptError;

    fn read(&mut self, offset: u32) -> Result<u32, ScriptError> {
        self.next(Found::Read { offset }, |expected| match expected {
            Access::Read(at, value) if at == offset => Some(Ok(value)),
            Access::FailRead(at) if at == offset => Some(Err(ScriptError::Refused)),
            _ => None,
        })
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), ScriptError> {
        self.next(Found::Write { offset, value }, |expected| match expected {
            Access::Write(at, wants) if (at, wants) == (offset, value) => Some(Ok(())),
            Access::FailWrite(at, wants) if (at, wants) == (offset, value) => Some(Err(ScriptError::Refused)),
            _ => None,
        })
    }

    fn read_block(&mut self, address: u32, words: &mut [u32]) -> Result<(), ScriptError> {
        let found = Found::ReadBlock { address, words: words.len() };
        self.next(found, |expected| match expected {
            Access::ReadBlock(at, answer) if at == address && answer.len() == words.len() => {
                words.copy_from_slice(answer);
                Some(Ok(()))
            }
            _ => None,
        })
    }

    fn write_block(&mut self, address: u32, words: &[u32]) -> Result<(), ScriptError> {
        let index = match self.script.get(self.position) {
            Some(Access::WriteBlock(at, wants)) if *at == address => {
                (0..words.len()).find(|index| wants.get(*index) != words.get(*index))
            }
            _ => Some(0),
        };
        let differs = index.and_then(|index| words.get(index).map(|word| (index, *word)));
        let found = Found::WriteBlock { address, words: words.len(), differs };
        self.next(found, |expected| match expected {
            Access::WriteBlock(at, wants) if at == address && wants == words => Some(Ok(())),
            _ => None,
        })
    }
}

/// Why an access of a [`Scripted`] bus failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ScriptError {
    /// The script says this access is refused.
    Refused,
    /// This access, or an earlier one, is not in the script; see [`Scripted::finish`].
    Diverged,
}

impl fmt::Display for ScriptError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Refused => "the script refuses this access: recover, as from any bus fault",
            Self::Diverged => "the accesses left the script: `finish` tells where",
        })
    }
}

impl core::error::Error for ScriptError {}

#[cfg(test)]
mod tests {
    use super::*;

    const SCRIPT: &[Access<'static>] = &[
        Access::Read(0, 7),
        Access::Write(4, 1),
        Access::WriteBlock(0x100, &[1, 2, 3]),
        Access::ReadBlock(0x100, &[4, 5]),
        Access::FailRead(8),
        Access::FailWrite(8, 2),
    ];

    #[test]
    fn a_followed_script_answers_and_finishes() {
        let mut bus = Scripted::new(SCRIPT);
        assert_eq!(bus.read(0), Ok(7));
        assert_eq!(bus.write(4, 1), Ok(()));
        assert_eq!(bus.write_block(0x100, &[1, 2, 3]), Ok(()));
        let mut words = [0; 2];
        assert_eq!(bus.read_block(0x100, &mut words), Ok(()));
        assert_eq!(words, [4, 5]);
        assert_eq!(bus.read(8), Err(ScriptError::Refused));
        assert_eq!(bus.write(8, 2), Err(ScriptError::Refused));
        assert_eq!(bus.finish(), Ok(()));
        assert_eq!(bus.read(0), Err(ScriptError::Diverged), "one access too many");
        let divergence = bus.finish().unwrap_err();
        assert_eq!((divergence.position, divergence.expected), (6, None));
    }

    #[test]
    fn the_first_divergence_is_kept_and_ends_everything() {
        let mut bus = Scripted::new(SCRIPT);
        bus.read(0).unwrap();
        assert_eq!(bus.write(4, 2), Err(ScriptError::Diverged));
        assert_eq!(bus.write(4, 1), Err(ScriptError::Diverged), "too late");
        let expected = Divergence {
            position: 1,
            expected: Some(Access::Write(4, 1)),
            found: Found::Write { offset: 4, value: 2 },
        };
        assert_eq!(bus.finish(), Err(expected));
        assert_eq!(bus.position(), 1);
        let text = "access 1: expected Write(4, 1), found Write { offset: 4, value: 2 }";
        assert_eq!(expected.to_string(), text);
    }

    #[test]
    fn a_block_tells_its_first_differing_word() {
        let mut bus = Scripted::new(&SCRIPT[2..]);
        assert!(bus.write_block(0x100, &[1, 9, 3]).is_err());
        let found = bus.finish().unwrap_err().found;
        assert_eq!(found, Found::WriteBlock { address: 0x100, words: 3, differs: Some((1, 9)) });
        let mut bus = Scripted::new(&SCRIPT[2..]);
        assert!(bus.write_block(0x100, &[1, 2]).is_err(), "too short");
    }

    #[test]
    fn an_unfinished_script_is_a_divergence() {
        let mut bus = Scripted::new(SCRIPT);
        bus.read(0).unwrap();
        let divergence = bus.finish().unwrap_err();
        assert_eq!(divergence.found, Found::Nothing);
        assert_eq!(divergence.to_string(), "access 1: expected Write(4, 1), but the accesses end here");
    }
}
