//! Do the crates know only what they may? Dependencies by `cargo metadata`, the rest by the sources.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Of each crate of the workspace, the crates of the workspace that it names (not for its own tests).
fn dependencies() -> BTreeMap<String, BTreeSet<String>> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--offline", "--format-version", "1"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let packages = metadata["packages"].as_array().unwrap();
    let name = |value: &Value| value["name"].as_str().unwrap().to_owned();
    let members: BTreeSet<String> = packages.iter().map(name).collect();
    packages
        .iter()
        .map(|package| {
            let named = package["dependencies"].as_array().unwrap().iter();
            let named = named.filter(|dependency| dependency["kind"] != "dev").map(name);
            (name(package), named.filter(|dependency| members.contains(dependency)).collect())
        })
        .collect()
}

/// Everything a crate reaches.
fn reach(of: &str, dependencies: &BTreeMap<String, BTreeSet<String>>) -> BTreeSet<String> {
    let mut reached = BTreeSet::new();
    let mut next = vec![of.to_owned()];
    while let Some(name) = next.pop() {
        next.extend(dependencies[&name].iter().filter(|other| reached.insert((*other).clone())).cloned());
    }
    reached
}

#[test]
fn crates_know_what_the_plan_lets_them() {
    let dependencies = dependencies();
    let plan = [
        ("lucerna-softfloat", &[][..]),
        ("lucerna-regs", &[]),
        ("lucerna-bus", &[]),
        ("lucerna-fabric", &["lucerna-softfloat"]),
        ("lucerna-pree", &["lucerna-softfloat", "lucerna-fabric"]),
        ("lucerna-displace", &["lucerna-softfloat", "lucerna-fabric"]),
        (
            "lucerna-device",
            &[
                "lucerna-regs",
                "lucerna-bus",
                "lucerna-fabric",
                "lucerna-pree",
                "lucerna-displace",
                "lucerna-softfloat",
            ],
        ),
        ("lucerna-driver", &["lucerna-bus", "lucerna-regs", "lucerna-softfloat"]),
    ];
    for (name, allowed) in plan {
        let allowed: BTreeSet<String> = allowed.iter().map(|name| (*name).to_owned()).collect();
        let beyond: Vec<_> = dependencies[name].difference(&allowed).collect();
        assert!(beyond.is_empty(), "{name} knows {beyond:?}");
    }
}

#[test]
fn driver_and_device_never_meet() {
    let dependencies = dependencies();
    assert!(!reach("lucerna-driver", &dependencies).contains("lucerna-device"));
    for unit in ["lucerna-pree", "lucerna-displace", "lucerna-fabric"] {
        assert!(!reach("lucerna-driver", &dependencies).contains(unit), "the driver knows {unit}");
    }
    assert!(!reach("lucerna-device", &dependencies).contains("lucerna-driver"));
    let shared: Vec<_> = reach("lucerna-driver", &dependencies)
        .intersection(&reach("lucerna-device", &dependencies))
        .cloned()
        .collect();
    assert_eq!(shared, ["lucerna-bus", "lucerna-regs", "lucerna-softfloat"]);
}

/// All Rust sources below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
        let path = entry.unwrap().path();
        if path.is_dir() {
            if path.file_name().is_some_and(|name| name != "target") {
                files.extend(sources(&path));
            }
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

/// The words of a source, comments and texts left out (well enough for these questions).
fn words(path: &Path) -> BTreeSet<String> {
    let text = fs::read_to_string(path).unwrap();
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    let code: String =
        code.map(|line| line.split('"').step_by(2).collect::<Vec<_>>().join(" ") + "\n").collect();
    code.split(|c: char| !(c.is_alphanumeric() || c == '_')).map(str::to_owned).collect()
}

#[test]
fn unsafe_is_where_pointers_are() {
    let allowed = ["firmware/bus/src", "firmware/bus/tests", "firmware/app/src"];
    let allowed = allowed.map(|folder| root().join(folder));
    let mut found = 0;
    for folder in ["firmware", "hostsim", "tests"] {
        for path in sources(&root().join(folder)) {
            if words(&path).contains("unsafe") {
                found += 1;
                assert!(
                    allowed.iter().any(|folder| path.starts_with(folder)),
                    "{} has `unsafe`",
                    path.display()
                );
            }
        }
    }
    assert!(found > 0, "memory-mapped access needs it: this test looks at the wrong files");
}

/// The unit's own front page and the bus's register access must not be the only ones who say so.
#[test]
fn firmware_libraries_are_no_std() {
    for name in ["softfloat", "fabric", "regs", "bus", "pree", "displace", "device", "driver"] {
        let folder = root().join("firmware").join(name).join("src");
        let text = fs::read_to_string(folder.join("lib.rs")).unwrap();
        assert!(text.contains("no_std"), "{name} is not `no_std`");
        for path in sources(&folder) {
            assert!(!words(&path).contains("alloc"), "{} allocates", path.display());
        }
    }
}

/// What judges the units shares nothing with them, nor with what is proven against them.
#[test]
fn oracles_share_nothing_with_what_they_judge() {
    let folder = root().join("hostsim/src/oracle");
    let files = sources(&folder);
    assert!(files.len() >= 8);
    for path in files {
        let words = words(&path);
        for theirs in [
            "lucerna_pree",
            "lucerna_displace",
            "lucerna_softfloat",
            "lucerna_fabric",
            "lucerna_device",
            "lucerna_driver",
            "lucerna_regs",
            "lucerna_bus",
            "HostF32",
            "HostF24",
            "HostF64",
            "accelerate",
            "displace",
            "format",
        ] {
            let own_text =
                theirs == "format" && !fs::read_to_string(&path).unwrap().contains("crate::format");
            assert!(own_text || !words.contains(theirs), "{} uses {theirs}", path.display());
        }
    }
    // Nor do this crate's own.
    for file in ["inorder.rs", "schedule.rs", "descriptor.rs"] {
        let words = words(&root().join("tests/src").join(file));
        for theirs in [
            "lucerna_pree",
            "lucerna_displace",
            "lucerna_softfloat",
            "lucerna_fabric",
            "lucerna_device",
            "HostF32",
            "HostF24",
        ] {
            assert!(!words.contains(theirs), "{file} uses {theirs}");
        }
    }
}

/// Nothing of the repository speaks of one machine.
#[test]
fn sources_name_no_place_of_their_own() {
    for folder in ["firmware", "hostsim", "tests"] {
        for path in sources(&root().join(folder)) {
            let text = fs::read_to_string(&path).unwrap();
            for place in [concat!("/", "work/"), concat!("/", "tmp/"), concat!("../", "shared")] {
                assert!(!text.contains(place), "{} names {place}", path.display());
            }
        }
    }
}
