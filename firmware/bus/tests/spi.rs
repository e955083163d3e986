//! Is the SPI framing what its table says, byte for byte, and does any allowed turn-around work?

use std::convert::Infallible;

use embedded_hal::spi::{ErrorKind, ErrorType, Operation, SpiDevice};
use embedded_hal_mock::eh1::spi::{Mock, Transaction};
use lucerna_bus::{Bus, Spi, SpiError, SpiFrame, TargetError};
use proptest::prelude::*;

/// One frame of the mock: what the host sends in each operation, then what it reads.
fn frame(sends: &[&[u8]], answer: &[u8]) -> Vec<Transaction<u8>> {
    let mut frame = vec![Transaction::transaction_start()];
    frame.extend(sends.iter().map(|bytes| Transaction::write_vec(bytes.to_vec())));
    frame.push(Transaction::read_vec(answer.to_vec()));
    frame.push(Transaction::transaction_end());
    frame
}

fn padded(answer: &[u8], length: usize) -> Vec<u8> {
    let mut bytes = answer.to_vec();
    bytes.resize(length, 0);
    bytes
}

#[test]
fn a_register_read_at_every_turn_around() {
    for turn_around in 0..SpiFrame::ANSWER_WITHIN {
        let mut answer = vec![if turn_around % 2 == 0 { 0xFF } else { 0x00 }; turn_around];
        answer.extend([0xA5, 0x4C, 0x55, 0x43, 0x52]);
        let answer = padded(&answer, 12);
        let mut mock = Mock::new(&frame(&[&[0x01, 0x00, 0x00, 0x01, 0x04]], &answer));
        assert_eq!(Spi::new(&mut mock).read(0x104), Ok(0x4C55_4352), "turn-around {turn_around}");
        mock.done();
    }
}

#[test]
fn a_register_write_is_acknowledged() {
    let sends: &[&[u8]] = &[&[0x02, 0x00, 0x00, 0x01, 0x00], &[0x01, 0x02, 0x03, 0x04]];
    let mut mock = Mock::new(&frame(sends, &[0, 0, 0xA5, 0, 0, 0, 0, 0]));
    assert_eq!(Spi::new(&mut mock).write(0x100, 0x0102_0304), Ok(()));
    mock.done();
}

#[test]
fn a_long_block_goes_in_frames_of_32_words() {
    let words: Vec<u32> = (0..40).map(|n| 0x0100_0000 + n).collect();
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_be_bytes()).collect();
    let ack = [0xA5, 0, 0, 0, 0, 0, 0, 0];
    let mut script = frame(&[&[0x04, 0x00, 0x00, 0x10, 0x00], &bytes[..128]], &ack);
    script.extend(frame(&[&[0x04, 0x00, 0x00, 0x10, 0x80], &bytes[128..]], &ack));
    let answer = |bytes: &[u8]| padded(&[&[0xFF, 0xA5], bytes].concat(), 8 + bytes.len());
    script.extend(frame(&[&[0x03, 0x00, 0x00, 0x10, 0x00]], &answer(&bytes[..128])));
    script.extend(frame(&[&[0x03, 0x00, 0x00, 0x10, 0x80]], &answer(&bytes[128..])));
    let mut mock = Mock::new(&script);
    let mut bus = Spi::new(&mut mock);
    assert_eq!(bus.write_block(0x1000, &words), Ok(()));
    let mut back = [0; 40];
    assert_eq!(bus.read_block(0x1000, &mut back), Ok(()));
    assert_eq!(back.to_vec(), words);
    mock.done();
}

#[test]
fn refusals_silence_and_noise_are_told_apart() {
    let answers: [(&[u8], SpiError<ErrorKind>); 5] = [
        (&[0, 0xE1], SpiError::Refused(TargetError::Unmapped)),
        (&[0xE2], SpiError::Refused(TargetError::Misaligned)),
        (&[0xFF, 0xFF, 0xE3], SpiError::Refused(TargetError::OutOfRange)),
        (&[], SpiError::Silent),
        (&[0, 0x5A], SpiError::Garbled),
    ];
    for (answer, error) in answers {
        let mut mock = Mock::new(&frame(&[&[0x01, 0, 0, 0, 0]], &padded(answer, 12)));
        assert_eq!(Spi::new(&mut mock).read(0), Err(error));
        mock.done();
    }
    // A status which comes one byte too late is silence, though the byte is there.
    let mut late = vec![0; SpiFrame::ANSWER_WITHIN];
    late.extend([0xA5, 0, 0, 0]);
    let mut mock = Mock::new(&frame(&[&[0x01, 0, 0, 0, 0]], &late));
    assert_eq!(Spi::new(&mut mock).read(0), Err(SpiError::Silent));
    mock.done();
}

/// The device's end of the wire: 64 registers, 64 words of memory, and a turn-around.
struct Slave {
    registers: [u32; 64],
    memory: [u32; 64],
    turn_around: usize,
    filler: u8,
}

impl Slave {
    /// What the device clocks out after `sent`.
    fn answer(&mut self, sent: &[u8]) -> Vec<u8> {
        let address = u32::from_be_bytes(sent[1..5].try_into().unwrap()) as usize / 4;
        let store = if sent[0] < 3 { &mut self.registers } else { &mut self.memory };
        let mut answer = vec![self.filler; self.turn_around];
        match store.get_mut(address..) {
            None => answer.push(TargetError::OutOfRange.into()),
            Some(words) if sent[0].is_multiple_of(2) => {
                for (word, bytes) in words.iter_mut().zip(sent[5..].as_chunks().0) {
                    *word = u32::from_be_bytes(*bytes);
                }
                answer.push(SpiFrame::DONE);
            }
            Some(words) => {
                answer.push(SpiFrame::DONE);
                answer.extend(words.iter().flat_map(|word| word.to_be_bytes()));
            }
        }
        answer
    }
}

impl ErrorType for Slave {
    type Error = Infallible;
}

impl SpiDevice for Slave {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Infallible> {
        let mut sent = Vec::new();
        for operation in operations {
            match operation {
                Operation::Write(bytes) => sent.extend_from_slice(bytes),
                Operation::Read(bytes) => {
                    let answer = self.answer(&sent);
                    bytes.fill(self.filler);
                    bytes.iter_mut().zip(answer).for_each(|(to, from)| *to = from);
                }
                _ => unreachable!("frames are written, then read"),
            }
        }
        Ok(())
    }
}

proptest! {
    #[test]
    fn what_is_written_is_read(
        words in prop::collection::vec(any::<u32>(), 0..64),
        register in 0u32..64,
        turn_around in 0..SpiFrame::ANSWER_WITHIN,
        filler in prop::sample::select(vec![0x00, 0xFF]),
    ) {
        let mut bus = Spi::new(Slave { registers: [0; 64], memory: [0; 64], turn_around, filler });
        bus.write_block(0, &words).unwrap();
        let mut back = vec![0; words.len()];
        bus.read_block(0, &mut back).unwrap();
        prop_assert_eq!(&back, &words);
        let value = words.first().copied().unwrap_or(0xA5A5_A5A5);
        bus.write(register * 4, value).unwrap();
        prop_assert_eq!(bus.read(register * 4), Ok(value));
        prop_assert_eq!(bus.read(260), Err(SpiError::Refused(TargetError::OutOfRange)));
    }
}
