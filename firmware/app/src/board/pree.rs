//! The PREE model in the image. In: the fixture in flash. Out: the report on stdout, and a status. Cost: 80 KiB of RAM for
//! device memory, and the job in both timings.

use lucerna_bus::{Model, Timing};
use lucerna_device::PreeDevice;
use lucerna_softfloat::Format;

use super::failure;
use super::report::{both_timings, give_up};
use crate::fixture::Fixture;
use crate::session::{self, MEMORY_WORDS, SessionError};

const FILE: &[u8] = include_bytes!("../../../../fixtures/cornell-balls-20x15.lcn");
/// An array of its own name, so that the size table can tell it from the program's constants.
static JOB: [u8; FILE.len()] = *FILE.first_chunk().unwrap();

/// Runs the fixture on a device of 4 PREUs of format `F`.
pub fn main<F: Format>() -> ! {
    let Some(memory) = cortex_m::singleton!(: [u32; MEMORY_WORDS] = [0; MEMORY_WORDS]) else {
        failure(&["the model was started twice"]);
    };
    // What the compiler knew of the job, it would build into the program.
    let fixture = match Fixture::new(core::hint::black_box(&JOB)) {
        Ok(fixture) => fixture,
        Err(error) => give_up(&error),
    };
    defmt::info!("{=u32} photons to go", fixture.header().photons);
    both_timings(|timing, report| {
        let model = model::<F>(memory, timing);
        match session::run(model.bus(), model.delay(), &fixture, report) {
            Ok(()) => model.elapsed(),
            Err(error) => {
                if let SessionError::Device(error) = error {
                    defmt::error!("{}", error);
                }
                give_up(&error)
            }
        }
    })
}

/// The engine's state is 6 KiB, and every step of its making is a copy: they are off the stack again when the job runs.
#[inline(never)]
fn model<F: Format>(memory: &mut [u32], timing: Timing) -> Model<PreeDevice<F, 4, &mut [u32]>> {
    Model::new(PreeDevice::new(memory)).with_timing(timing)
}
