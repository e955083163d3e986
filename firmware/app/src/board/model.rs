//! The device model in the image. In: the fixture in flash. Out: the report on stdout, and a status. Cost: 80 KiB of RAM for
//! device memory, and the job in both timings.

use core::fmt::{self, Write};

use lucerna_bus::{Model, Timing};
use lucerna_device::Device;
use lucerna_softfloat::Format;

use super::host::HostStream;
use super::{failure, success};
use crate::fixture::{Fixture, Fnv1a64};
use crate::session::{self, MEMORY_WORDS, SessionError};

const FILE: &[u8] = include_bytes!("../../../../fixtures/cornell-balls-20x15.lcn");
/// An array of its own name, so that the size table can tell it from the program's constants.
static JOB: [u8; FILE.len()] = *FILE.first_chunk().unwrap();

/// Text on its way, digested.
struct Report<'a> {
    out: &'a mut dyn Write,
    digest: Fnv1a64,
}

impl Write for Report<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.digest = text.bytes().map(u32::from).fold(self.digest, Fnv1a64::with);
        self.out.write_str(text)
    }
}

/// Nobody listens.
struct Nowhere;

impl Write for Nowhere {
    fn write_str(&mut self, _: &str) -> fmt::Result {
        Ok(())
    }
}

/// Runs the fixture on a device of 4 PREUs of format `F`: fast, with the report on stdout, then clock by clock, which must
/// take as many clocks and give the same report.
pub fn main<F: Format>() -> ! {
    let Some(memory) = cortex_m::singleton!(: [u32; MEMORY_WORDS] = [0; MEMORY_WORDS]) else {
        failure(&["the model was started twice"]);
    };
    // What the compiler knew of the job, it would build into the program.
    let fixture = match Fixture::new(core::hint::black_box(&JOB)) {
        Ok(fixture) => fixture,
        Err(error) => give_up(&error),
    };
    let Some(mut stdout) = HostStream::stdout() else {
        failure(&["no stdout: enable semihosting"]);
    };
    defmt::info!("{=u32} photons to go", fixture.header().photons);
    let fast = session::<F>(memory, Timing::Fast, &fixture, &mut stdout);
    defmt::info!("fast: {=u64} clocks", fast.1);
    let tick = session::<F>(memory, Timing::Tick, &fixture, &mut Nowhere);
    defmt::info!("tick: {=u64} clocks", tick.1);
    if fast != tick {
        failure(&["clock by clock, the device took another time or reported otherwise"]);
    }
    let _ = writeln!(stdout, "clocks {}", fast.1);
    success()
}

/// The engine's state is 6 KiB, and every step of its making is a copy: they are off the stack again when the job runs.
#[inline(never)]
fn model<F: Format>(memory: &mut [u32], timing: Timing) -> Model<Device<F, 4, &mut [u32]>> {
    Model::new(Device::new(memory)).with_timing(timing)
}

/// The report's digest, and the clocks it took.
fn session<F: Format>(
    memory: &mut [u32],
    timing: Timing,
    fixture: &Fixture<'_>,
    out: &mut dyn Write,
) -> (u64, u64) {
    let model = model::<F>(memory, timing);
    let mut report = Report { out, digest: Fnv1a64::EMPTY };
    match session::run(model.bus(), model.delay(), fixture, &mut report) {
        Ok(()) => (report.digest.value(), model.elapsed()),
        Err(error) => {
            if let SessionError::Device(error) = error {
                defmt::error!("{}", error);
            }
            give_up(&error)
        }
    }
}

fn give_up(error: &dyn fmt::Display) -> ! {
    if let Some(mut stderr) = HostStream::stderr() {
        let _ = write!(stderr, "{error}");
    }
    failure(&[])
}
