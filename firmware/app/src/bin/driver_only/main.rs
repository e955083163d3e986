//! The driver alone, over memory-mapped registers. In: a device at the addresses below. Out: a picture of each of its units in
//! the log. Cost: the driver's flash, which the size table holds to a budget.
//!
//! Under QEMU nothing is mapped there: the registers read 0, and the program ends with the driver's word on that.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod displace;
#[cfg(target_os = "none")]
mod pree;

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
    use lucerna_driver::{Deadline, Error, JobError, LayoutError, Unit, displace};

    use crate::{displace as surface, pree};

    /// The device's registers: an FPGA on an AN386's bus has its extra peripherals here.
    const REGISTERS: NonNull<u32> = NonNull::new(0x4002_8000 as *mut u32).unwrap();
    const REGISTER_BYTES: u32 = 0x1000;
    /// The device's memory: the AN386's PSRAM, which the device shares.
    const MEMORY: NonNull<u32> = NonNull::new(0x2100_0000 as *mut u32).unwrap();
    const MEMORY_BYTES: u32 = 16 << 20;
    /// The AN386's clock, in hertz.
    const CLOCK_HZ: u32 = 25_000_000;

    pub type Lucerna = lucerna_driver::Lucerna<Mmio, Delay>;
    pub const PATIENCE: Deadline = Deadline::millis(10);

    /// Why there is no picture.
    #[derive(defmt::Format)]
    pub enum Failure {
        Device(Error<MmioError>),
        Layout(LayoutError),
        Job(JobError),
        DisplaceLayout(displace::LayoutError),
        DisplaceJob(displace::JobError),
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

    impl From<displace::LayoutError> for Failure {
        fn from(error: displace::LayoutError) -> Self {
            Self::DisplaceLayout(error)
        }
    }

    impl From<displace::JobError> for Failure {
        fn from(error: displace::JobError) -> Self {
            Self::DisplaceJob(error)
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
            Ok(()) => success(),
            Err(error) => {
                defmt::error!("{}", error);
                failure(&[
                    "no picture: nothing answers at 0x40028000 (QEMU has no device there), or the job failed; the defmt log on UART1 says which",
                ]);
            }
        }
    }

    /// Recovers the device if someone left it in the middle of a job, and runs a job on each unit it has.
    fn run(mut lucerna: Lucerna) -> Result<(), Failure> {
        lucerna.recover()?;
        if lucerna.capabilities().has(Unit::Pree) {
            insist(&mut lucerna, pree::picture)?;
        }
        if lucerna.capabilities().has(Unit::Displace) {
            insist(&mut lucerna, surface::picture)?;
        }
        Ok(())
    }

    /// Tries a job again if the device fails it.
    fn insist(lucerna: &mut Lucerna, job: fn(&mut Lucerna) -> Result<(), Failure>) -> Result<(), Failure> {
        match job(lucerna) {
            Err(Failure::Device(error)) => {
                defmt::warn!("once more: {}", error);
                lucerna.recover()?;
                job(lucerna)
            }
            first => first,
        }
    }
}
