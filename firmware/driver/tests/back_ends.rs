//! Is a job the same over every bus: straight, over SPI, traced, and replayed from the trace?

mod common;

use std::cell::RefCell;
use std::convert::Infallible;

use common::{Fake, SIZES, evaluate_job, hit_points, layout, model, photons, update_job};
use embedded_hal::delay::DelayNs;
use embedded_hal::spi::{ErrorType, Operation, SpiDevice};
use lucerna_bus::{Bus, ModelBus, SharedSink, Spi, SpiFrame, TargetError, Traced, TracedDelay, replay_timed};
use lucerna_driver::{Deadline, Error, Lucerna};

const PLENTY: Deadline = Deadline::millis(100);
const PIXELS: [[f32; 3]; 2] = [[1.5, 3.0, 6.0], [5.5, 11.0, 22.0]];

fn job<B: Bus>(bus: B, delay: impl DelayNs) -> Result<[[f32; 3]; 2], Error<B::Error>> {
    let mut lucerna = Lucerna::probe(bus, delay)?;
    let layout = layout(SIZES);
    let mut pree = lucerna.pree()?;
    pree.write_hit_points(&layout, 0, &hit_points())?;
    pree.write_index(&layout, 0, &[0, 1, 2, 3])?;
    pree.zero_pixels(&layout)?;
    let mut stream = pree.update(&update_job(&layout))?;
    stream.push_all(&photons(50), PLENTY)?;
    stream.finish(PLENTY)?;
    pree.evaluate(&evaluate_job(&layout))?.wait(PLENTY)?;
    let mut pixels = [[0.0; 3]; 2];
    pree.read_pixels(&layout, 0, &mut pixels)?;
    pree.counters()?;
    Ok(pixels)
}

/// The device's end of the SPI, as on a board: frames in, accesses of the model out.
struct Bridge<'a>(ModelBus<'a, Fake>);

impl Bridge<'_> {
    fn answer(&mut self, sent: &[u8], answer: &mut [u8]) -> Result<(), TargetError> {
        const TURN_AROUND: usize = 3;
        let address = u32::from_be_bytes([sent[1], sent[2], sent[3], sent[4]]);
        let mut words: Vec<u32> =
            sent[5..].as_chunks().0.iter().map(|word| u32::from_be_bytes(*word)).collect();
        match sent[0] {
            frame if frame == SpiFrame::ReadRegister as u8 => words.push(self.0.read(address)?),
            frame if frame == SpiFrame::WriteRegister as u8 => self.0.write(address, words[0])?,
            frame if frame == SpiFrame::ReadMemory as u8 => {
                words.resize((answer.len() - SpiFrame::ANSWER_WITHIN) / 4, 0);
                self.0.read_block(address, &mut words)?;
            }
            frame if frame == SpiFrame::WriteMemory as u8 => self.0.write_block(address, &words)?,
            frame => panic!("no such frame: {frame:#x}"),
        }
        answer[TURN_AROUND] = SpiFrame::DONE;
        for (bytes, word) in answer[TURN_AROUND + 1..].as_chunks_mut().0.iter_mut().zip(words) {
            *bytes = word.to_be_bytes();
        }
        Ok(())
    }
}

impl ErrorType for Bridge<'_> {
    type Error = Infallible;
}

impl SpiDevice for Bridge<'_> {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Infallible> {
        let mut sent = Vec::new();
        for operation in operations {
            match operation {
                Operation::Write(bytes) => sent.extend_from_slice(bytes),
                Operation::Read(bytes) => {
                    bytes.fill(0);
                    if let Err(error) = self.answer(&sent, bytes) {
                        bytes[0] = error.into();
                    }
                }
                _ => panic!("a frame is written, then read"),
            }
        }
        Ok(())
    }
}

#[test]
fn over_spi_the_job_is_the_same() {
    let straight = model(|_| {});
    assert_eq!(job(straight.bus(), straight.delay()).unwrap(), PIXELS);
    let bridged = model(|_| {});
    assert_eq!(job(Spi::new(Bridge(bridged.bus())), bridged.delay()).unwrap(), PIXELS);
    let (straight, bridged) = (straight.into_inner(), bridged.into_inner());
    assert_eq!(straight.memory, bridged.memory);
    assert_eq!(straight.taken, bridged.taken);
}

#[test]
fn a_traced_job_is_replayed_to_the_clock() {
    let first = model(|_| {});
    let text = RefCell::new(String::new());
    let sink = SharedSink::new(&text);
    let pixels = job(Traced::new(first.bus(), sink), TracedDelay::new(first.delay(), sink)).unwrap();
    assert_eq!(pixels, PIXELS);
    let text = text.into_inner();
    assert!(text.starts_with("r 0 4c554352\nr 4 10001\n"), "{text}");

    let again = model(|_| {});
    let replayed = replay_timed(&text, &mut again.bus(), &mut again.delay()).unwrap();
    assert_eq!(replayed.accesses as usize, text.lines().filter(|line| !line.starts_with('d')).count());
    assert_eq!(again.elapsed(), first.elapsed());
    let (first, again) = (first.into_inner(), again.into_inner());
    assert_eq!((first.registers, first.memory), (again.registers, again.memory));

    // On a device of another speed, the first answer which differs is told.
    let slower = model(|fake| fake.pace = 50);
    let error = replay_timed(&text, &mut slower.bus(), &mut slower.delay()).unwrap_err();
    assert!(error.to_string().contains("0x13c reads"), "{error}");
}
