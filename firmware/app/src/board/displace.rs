//! The displacement model in the image. In: room for the device. Out: the report on stdout, and a status. Cost: 64 KiB of RAM for
//! device memory, 4 KiB for the map, 14 KiB for the unit's state, and the job in both timings.

use lucerna_bus::Model;
use lucerna_device::DisplaceDevice;
use lucerna_displace::engine::{SizeError, Sizes};
use lucerna_softfloat::Format;

use super::failure;
use super::report::{both_timings, give_up};
use crate::displace::{self, MEMORY_WORDS, SessionError, scene};

/// Lines of each cache of [`Sizes::default`]: 16 KiB of 32 bytes a line.
const LINES: usize = 512;

/// A device of one instance.
pub type Device<F> = DisplaceDevice<F, 1, LINES, &'static mut [u32]>;

/// Draws the picture with a unit of format `F`, made in `room`, which is there if this is the first call.
pub fn main<F: Format>(room: Option<&mut Option<Device<F>>>) -> ! {
    let memory = cortex_m::singleton!(: [u32; MEMORY_WORDS] = [0; MEMORY_WORDS]);
    let heights = cortex_m::singleton!(: [u8; scene::TEXELS] = [0; scene::TEXELS]);
    let (Some(room), Some(memory), Some(heights)) = (room, memory, heights) else {
        failure(&["the model was started twice"]);
    };
    let device = match make(room, memory) {
        Ok(device) => device,
        Err(error) => give_up(&error),
    };
    defmt::info!("{=u32} rays to go", displace::SIZES.results);
    both_timings(|timing, report| {
        let model = Model::new(&mut *device).with_timing(timing);
        match displace::run(model.bus(), model.delay(), heights, report) {
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

/// The steps of its making are copies: they are off the stack again when the job runs.
#[inline(never)]
fn make<'a, F: Format>(
    room: &'a mut Option<Device<F>>,
    memory: &'static mut [u32],
) -> Result<&'a mut Device<F>, SizeError> {
    Ok(room.insert(Device::new(Sizes::default(), memory)?))
}
