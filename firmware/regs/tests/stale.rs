//! Is what is committed what the SystemRDL gives? In: generated.manifest, the files it names. Cost: milliseconds, no Python.
//!
//! This compares digests only. `regenerate --check` runs the whole generation again and compares every byte.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const REMEDY: &str = "run firmware/regs/regenerate and commit what it writes";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn fnv1a64(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xCBF2_9CE4_8422_2325, |digest, &byte| (digest ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3))
}

/// Kind, digest and path of every line of the manifest.
fn manifest() -> Vec<(String, u64, String)> {
    let text = std::fs::read_to_string(root().join("firmware/regs/generated.manifest")).expect(REMEDY);
    text.lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| {
            let mut words = line.splitn(3, ' ');
            let mut next = || words.next().expect("three words a line").to_owned();
            (next(), u64::from_str_radix(&next(), 16).expect("a hexadecimal digest"), next())
        })
        .collect()
}

/// All files under a folder of the repository, as the manifest names them.
fn files(folder: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for entry in std::fs::read_dir(root().join(folder)).expect(folder) {
        let entry = entry.expect(folder);
        let path = format!("{folder}/{}", entry.file_name().to_str().expect("a readable file name"));
        if entry.file_type().expect(folder).is_dir() {
            found.extend(files(&path));
        } else if !path.ends_with(".pyc") {
            found.insert(path);
        }
    }
    found
}

fn named(kind: &str) -> BTreeSet<String> {
    manifest().into_iter().filter(|line| line.0 == kind).map(|line| line.2).collect()
}

#[test]
fn digest_is_fnv_1a() {
    assert_eq!(fnv1a64(b""), 0xCBF2_9CE4_8422_2325);
    assert_eq!(fnv1a64(b"foobar"), 0x8594_4171_F739_67E8);
}

#[test]
fn nothing_has_changed_since_the_map_was_generated() {
    let lines = manifest();
    assert!(lines.len() > 10, "the manifest is cut off: {REMEDY}");
    for (kind, digest, path) in lines {
        let bytes = std::fs::read(root().join(&path)).unwrap_or_else(|e| panic!("{path}: {e}: {REMEDY}"));
        let story = if kind == "source" { "edited without regenerating" } else { "edited by hand" };
        assert_eq!(fnv1a64(&bytes), digest, "{path} was {story}: {REMEDY}");
    }
}

#[test]
fn no_source_and_no_output_is_missing_from_the_manifest() {
    let mut sources = files("firmware/regs/rdl");
    sources.extend(files("firmware/regs/tools"));
    sources.insert("firmware/regs/regenerate".to_owned());
    assert_eq!(sources, named("source"), "{REMEDY}");

    let mut outputs = files("firmware/regs/src/generated");
    for folder in ["firmware/regs/svd", "firmware/regs/include", "docs/registers"] {
        outputs.extend(files(folder));
    }
    assert_eq!(outputs, named("output"), "{REMEDY}");
}
