//! The driver alone, over memory-mapped registers. In: a device at the addresses below. Out: a picture of 2×2 pixels in the
//! log. Cost: the driver's flash, which the size table holds to a budget.
//!
//! Under QEMU nothing is mapped there: the registers read 0, and the program ends with the driver's word on that.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("this is a Cortex-M program: add --target thumbv7em-none-eabihf --profile firmware");
    std::process::exit(2);
}

#[cfg(target_os = "none")]
mod program {
    use core::ptr::NonNull;

    use cortex_m::Peripherals;
    use cortex_m::delay::Delay;
    use lucerna_app::board::{failure, success};
    use lucerna_bus::{Mmio, MmioError};
    use lucerna_driver::{
        Deadline, Error, EvaluateJob, HitPoint, JobError, Layout, LayoutError, Lucerna, Photon, Policies,
        Sizes, UpdateJob,
    };

    /// The device's registers: an FPGA on an AN386's bus has its extra peripherals here.
    const REGISTERS: NonNull<u32> = NonNull::new(0x4002_8000 as *mut u32).unwrap();
    const REGISTER_BYTES: u32 = 0x1000;
    /// The device's memory: the AN386's PSRAM, which the device shares.
    const MEMORY: NonNull<u32> = NonNull::new(0x2100_0000 as *mut u32).unwrap();
    const MEMORY_BYTES: u32 = 16 << 20;
    /// The AN386's clock, in hertz.
    const CLOCK_HZ: u32 = 25_000_000;

    /// Pixels, hit points and photons: one of each for each.
    const PIXELS: usize = 4;
    const PATIENCE: Deadline = Deadline::millis(10);

    /// Why there is no picture.
    #[derive(defmt::Format)]
    enum Failure {
        Device(Error<MmioError>),
        Layout(LayoutError),
        Job(JobError),
    }

    impl From<Error<MmioError>> for Failure {
        fn from(error: Error<MmioError>) -> Self {
            Self::Device(error)
        }
    }

    impl From<LayoutError> for Failure {
        fn from(error: LayoutError) -> Self {
            Self::Layout(error)
        }
    }

    impl From<JobError> for Failure {
        fn from(error: JobError) -> Self {
            Self::Job(error)
        }
    }

    #[cortex_m_rt::entry]
    fn main() -> ! {
        // SAFETY: both windows are the device's, as mapped above, aligned, and nobody else's: `main` runs once.
        #[expect(unsafe_code, reason = "only the board knows where its device is")]
        let bus = unsafe { Mmio::new(REGISTERS, REGISTER_BYTES, MEMORY, MEMORY_BYTES) };
        let Some(peripherals) = Peripherals::take() else {
            failure(&["the program was started twice"]);
        };
        match Lucerna::probe(bus, Delay::new(peripherals.SYST, CLOCK_HZ)).map_err(Failure::from).and_then(run)
        {
            Ok(pixels) => {
                defmt::info!("pixels: {}", pixels);
                success()
            }
            Err(error) => {
                defmt::error!("{}", error);
                failure(&[
                    "no picture: nothing answers at 0x40028000 (QEMU has no device there), or the job failed; the defmt log on UART1 says which",
                ]);
            }
        }
    }

    /// Recovers the device if someone left it in the middle of a job, and runs ours; twice if the first fails.
    fn run(mut lucerna: Lucerna<Mmio, Delay>) -> Result<[[f32; 3]; PIXELS], Failure> {
        lucerna.recover()?;
        let pixels = match pass(&mut lucerna) {
            Err(Failure::Device(error)) => {
                defmt::warn!("once more: {}", error);
                lucerna.recover()?;
                pass(&mut lucerna)?
            }
            first => first?,
        };
        defmt::info!("{}", lucerna.counters()?);
        Ok(pixels)
    }

    fn pass(lucerna: &mut Lucerna<Mmio, Delay>) -> Result<[[f32; 3]; PIXELS], Failure> {
        let sizes = Sizes {
            hit_points: PIXELS as u32,
            index_entries: PIXELS as u32,
            pixels: PIXELS as u32,
            ring_entries: 64,
            normal_test: true,
        };
        let layout = Layout::packed(lucerna.capabilities(), sizes)?;
        let update = UpdateJob::new(&layout, 0.7, Policies::default())?;
        let evaluate = EvaluateJob::new(&layout, PIXELS as f32, Policies::default())?;
        lucerna.clear_counters()?;

        let mut pree = lucerna.pree()?;
        let position = |number: usize| [number as f32, 0.0, 0.0];
        let normal = [0.0, 1.0, 0.0];
        let hit_points: [HitPoint; PIXELS] = core::array::from_fn(|number| HitPoint {
            position: position(number),
            normal,
            colour: [0.75; 3],
            radius_squared: 0.25,
            pixel: number as u32,
            ..HitPoint::default()
        });
        let photons: [Photon; PIXELS] = core::array::from_fn(|number| Photon {
            position: position(number),
            normal,
            flux: [number as f32; 3],
            p_addr: number as u32,
            n: 1,
        });
        pree.write_hit_points(&layout, 0, &hit_points)?;
        pree.write_index(&layout, 0, &core::array::from_fn::<u32, PIXELS, _>(|number| number as u32))?;
        pree.zero_pixels(&layout)?;
        let mut stream = pree.update(&update)?;
        stream.push_all(&photons, PATIENCE)?;
        stream.finish(PATIENCE)?;
        pree.evaluate(&evaluate)?.wait(PATIENCE)?;
        let mut pixels = [[0.0; 3]; PIXELS];
        pree.read_pixels(&layout, 0, &mut pixels)?;
        Ok(pixels)
    }
}
