//! The displacement model of one instance in f32 behind the driver. In: nothing. Out: capabilities, counters, digests and
//! pictures on stdout. Cost: see the size table.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    use lucerna_app::board::displace::{Device, main};
    use lucerna_softfloat::F32;

    main(cortex_m::singleton!(: Option<Device<F32>> = None))
}

#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("this is a Cortex-M program: add --target thumbv7em-none-eabihf --profile firmware");
    std::process::exit(2);
}
