//! The PREE model of 4 PREUs in f32 behind the driver. In: the fixture. Out: capabilities, counters, digests and pictures on
//! stdout. Cost: see the size table.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    lucerna_app::board::pree::main::<lucerna_softfloat::F32>()
}

#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("this is a Cortex-M program: add --target thumbv7em-none-eabihf --profile firmware");
    std::process::exit(2);
}
