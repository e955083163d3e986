//! What crosses crates: helpers of the tests in `tests/`; in: seeds and shapes, out: devices, jobs and expected results; cost: small.
//!
//! What the device is held against ([`inorder`], [`schedule`]) is written from the decisions D1 to D14 and shares no code with
//! the units: its arithmetic is the host's, its scheduler a plain loop over list lengths.
//!
//! ```
//! use lucerna_tests::schedule::{Busy, aftso};
//!
//! // Eight lists of one entry, four PREUs: load four, dispatch, load four, dispatch.
//! assert_eq!(aftso(&[1; 8], 4, 1, Busy::Registered, |_, _, _| {}).cycles, 10);
//! ```

pub mod descriptor;
pub mod devices;
pub mod displaced;
pub mod inorder;
pub mod job;
pub mod random;
pub mod relief;
pub mod schedule;
pub mod workload;
