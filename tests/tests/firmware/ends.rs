//! How programs end that cannot do their job, and what they take.

use hostsim::size;

use crate::board::{images, options, patched, run};

#[test]
fn the_driver_alone_says_when_there_is_no_device() {
    let ended = run("driver_only", &images().join("driver_only"));
    assert_eq!(
        (ended.status, &*ended.stdout, &*ended.stderr),
        (
            1,
            "",
            "no picture: nothing answers at 0x40028000 (QEMU has no device there), or the job failed; the defmt log on UART1 says which\n"
        )
    );
    let [line] = &*ended.log else { panic!("{:?}", ended.log) };
    assert!(line.starts_with("error Device(Error { cause: WrongDevice { id: 0 }"), "{line}");
}

#[test]
fn a_damaged_job_ends_with_a_reason() {
    let elf = patched("damaged", "pree_f32", "lucerna_app::board::pree::JOB", b"LCNK");
    let ended = run("damaged", &elf);
    assert_eq!((ended.status, &*ended.stdout), (1, ""));
    assert_eq!(ended.stderr, "not a Lucerna job: write one with `hostsim fixture`\n");
}

#[test]
fn a_hard_fault_ends_with_a_reason() {
    let undefined = 0xde00u16.to_le_bytes();
    let ended = run("fault", &patched("fault", "pree_f32", "main", &undefined));
    assert_eq!((ended.status, &*ended.stdout), (1, ""));
    assert!(ended.stderr.starts_with("hard fault at 0x"), "{}", ended.stderr);
    assert!(ended.log[0].starts_with("error hard fault at 0x"), "{:?}", ended.log);
}

#[test]
fn sizes_are_within_their_budgets() {
    images();
    let report = size::run(&options()).unwrap_or_else(|error| panic!("{error}"));
    println!("{report}");
    assert!(report.is_within_budgets(), "{report}");
    for image in &report.images {
        let flash: u64 = image.crates.values().map(|share| share.flash).sum();
        assert_eq!(flash, image.total.flash, "every byte of {} is somebody's", image.name);
    }
}
