//! Puts the workspace's `memory.x` where the linker looks, and names the linker scripts of the Cortex-M programs.

use std::path::Path;
use std::{env, fs};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let memory = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("../../memory.x");
    println!("cargo::rerun-if-changed={}", memory.display());
    println!("cargo::rerun-if-changed=build.rs");
    if env::var("CARGO_CFG_TARGET_OS")? != "none" {
        return Ok(());
    }
    let out = env::var("OUT_DIR")?;
    fs::copy(memory, Path::new(&out).join("memory.x"))?;
    println!("cargo::rustc-link-search={out}");
    // --nmagic: sections are not padded to pages, as there are none.
    for argument in ["--nmagic", "-Tlink.x", "-Tdefmt.x"] {
        println!("cargo::rustc-link-arg-bins={argument}");
    }
    Ok(())
}
