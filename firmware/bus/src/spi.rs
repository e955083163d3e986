//! A device behind SPI. In: offsets, addresses, words. Out: words, or what went wrong on the wire. Cost: one
//! transaction a register or per 32 words of a block; 13 bytes of overhead each.
//!
//! A frame is one transaction (chip select low to high), most significant bit and byte first, SPI mode 0:
//!
//! | bytes | from | meaning |
//! |---|---|---|
//! | 1 | host | command, [`SpiFrame`] |
//! | 4 | host | byte offset or address, big-endian |
//! | 4 × words | host | writes only: the words, big-endian |
//! | 0 … 7 | device | turn-around: 0x00 or 0xFF while the device is busy |
//! | 1 | device | status: 0xA5 done, 0xE1 unmapped, 0xE2 misaligned, 0xE3 out of range |
//! | 4 × words | device | reads only, after 0xA5: the words, big-endian |
//!
//! The turn-around may be any length up to seven bytes and may differ from frame to frame: the host clocks
//! enough bytes for the longest and looks for the status. The bytes beyond a short answer mean nothing, so
//! reading must have no side effects in the device (none of Lucerna's registers has any).

use core::fmt;

use embedded_hal::spi::{Operation, SpiDevice};

use crate::{Bus, TargetError};

/// The command byte of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum SpiFrame {
    /// Read a register.
    ReadRegister = 0x01,
    /// Write a register.
    WriteRegister = 0x02,
    /// Read device memory.
    ReadMemory = 0x03,
    /// Write device memory.
    WriteMemory = 0x04,
}

impl SpiFrame {
    /// The status byte of a frame that was carried out.
    pub const DONE: u8 = 0xA5;
    /// Bytes the device may take, status included, before its answer.
    pub const ANSWER_WITHIN: usize = 8;
    /// Words of a block in one frame; longer blocks take several.
    pub const WORDS: usize = 32;
    /// Bytes of command and address.
    pub const HEADER: usize = 5;
}

/// The status byte by which a device refuses a frame.
impl From<TargetError> for u8 {
    fn from(error: TargetError) -> u8 {
        match error {
            TargetError::Unmapped => 0xE1,
            TargetError::Misaligned => 0xE2,
            TargetError::OutOfRange => 0xE3,
        }
    }
}

/// A device behind an [`SpiDevice`], by the frames of this module's first table.
#[derive(Debug)]
pub struct Spi<D>(D);

impl<D: SpiDevice> Spi<D> {
    /// A bus over `device`, which owns the chip select.
    pub const fn new(device: D) -> Self {
        Self(device)
    }

    /// The SPI device.
    pub fn into_inner(self) -> D {
        self.0
    }

    fn header(frame: SpiFrame, address: u32) -> [u8; SpiFrame::HEADER] {
        let [a, b, c, d] = address.to_be_bytes();
        [frame as u8, a, b, c, d]
    }

    /// Up to [`SpiFrame::WORDS`] words in one transaction.
    fn fetch(&mut self, frame: SpiFrame, address: u32, words: &mut [u32]) -> Result<(), SpiError<D::Error>> {
        let mut answer = [0; SpiFrame::ANSWER_WITHIN + 4 * SpiFrame::WORDS];
        let length = SpiFrame::ANSWER_WITHIN + 4 * words.len();
        let (answer, _) = answer.split_at_mut_checked(length).ok_or(SpiError::Garbled)?;
        let header = Self::header(frame, address);
        self.0
            .transaction(&mut [Operation::Write(&header), Operation::Read(answer)])
            .map_err(SpiError::Wire)?;
        let bytes = after_status(answer)?;
        for (word, bytes) in words.iter_mut().zip(bytes.as_chunks().0) {
            *word = u32::from_be_bytes(*bytes);
        }
        Ok(())
    }

    /// Up to [`SpiFrame::WORDS`] words in one transaction.
    fn send(&mut self, frame: SpiFrame, address: u32, words: &[u32]) -> Result<(), SpiError<D::Error>> {
        let mut data = [0; 4 * SpiFrame::WORDS];
        let (data, _) = data.split_at_mut_checked(4 * words.len()).ok_or(SpiError::Garbled)?;
        for (bytes, word) in data.as_chunks_mut().0.iter_mut().zip(words) {
            *bytes = word.to_be_bytes();
        }
        let header = Self::header(frame, address);
        let mut answer = [0; SpiFrame::ANSWER_WITHIN];
        self.0
            .transaction(&mut [
                Operation::Write(&header),
                Operation::Write(data),
                Operation::Read(&mut answer),
            ])
            .map_err(SpiError::Wire)?;
        after_status(&answer).map(|_| ())
    }
}

/// What follows the status byte, which must come within the turn-around.
fn after_status<E>(answer: &[u8]) -> Result<&[u8], SpiError<E>> {
    let within = answer.iter().take(SpiFrame::ANSWER_WITHIN);
    let Some(at) = within.clone().position(|byte| !matches!(byte, 0x00 | 0xFF)) else {
        return Err(SpiError::Silent);
    };
    let (status, rest) = answer.split_at_checked(at + 1).ok_or(SpiError::Silent)?;
    match status.last() {
        Some(&SpiFrame::DONE) => Ok(rest),
        Some(0xE1) => Err(SpiError::Refused(TargetError::Unmapped)),
        Some(0xE2) => Err(SpiError::Refused(TargetError::Misaligned)),
        Some(0xE3) => Err(SpiError::Refused(TargetError::OutOfRange)),
        _ => Err(SpiError::Garbled),
    }
}

impl<D: SpiDevice> Bus for Spi<D>
where
    D::Error: Copy,
{
    type Error = SpiError<D::Error>;

    fn read(&mut self, offset: u32) -> Result<u32, Self::Error> {
        let mut word = [0];
        self.fetch(SpiFrame::ReadRegister, offset, &mut word)?;
        Ok(word[0])
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), Self::Error> {
        self.send(SpiFrame::WriteRegister, offset, &[value])
    }

    fn read_block(&mut self, mut address: u32, words: &mut [u32]) -> Result<(), Self::Error> {
        for chunk in words.chunks_mut(SpiFrame::WORDS) {
            self.fetch(SpiFrame::ReadMemory, address, chunk)?;
            address = address.wrapping_add(4 * chunk.len() as u32);
        }
        Ok(())
    }

    fn write_block(&mut self, mut address: u32, words: &[u32]) -> Result<(), Self::Error> {
        for chunk in words.chunks(SpiFrame::WORDS) {
            self.send(SpiFrame::WriteMemory, address, chunk)?;
            address = address.wrapping_add(4 * chunk.len() as u32);
        }
        Ok(())
    }
}

/// Why an access over SPI failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum SpiError<E> {
    /// The SPI controller or chip select failed.
    Wire(E),
    /// No status byte within the turn-around.
    Silent,
    /// A status byte that no device sends.
    Garbled,
    /// The device refused the frame.
    Refused(TargetError),
}

impl<E: fmt::Debug> fmt::Display for SpiError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Wire(error) => write!(f, "the SPI controller failed: {error:?}"),
            Self::Silent => f.write_str("no answer: check power, chip select and MISO, or lower the clock"),
            Self::Garbled => {
                f.write_str("the answer is no status byte: check mode 0, wiring, or lower the clock")
            }
            Self::Refused(error) => error.fmt(f),
        }
    }
}

impl<E: fmt::Debug> core::error::Error for SpiError<E> {}
