//! A report on its way to the host. In: a session. Out: its text on stdout, and a status. Cost: the session in both timings;
//! a semihosting call a piece of text.

use core::fmt::{self, Write};

use lucerna_bus::Timing;

use super::host::HostStream;
use super::{failure, success};
use crate::fixture::Fnv1a64;

/// Text on its way, digested.
pub struct Report<'a> {
    out: &'a mut dyn Write,
    digest: Fnv1a64,
}

impl Write for Report<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.digest = text.bytes().map(u32::from).fold(self.digest, Fnv1a64::with);
        self.out.write_str(text)
    }
}

/// Nobody listens.
struct Nowhere;

impl Write for Nowhere {
    fn write_str(&mut self, _: &str) -> fmt::Result {
        Ok(())
    }
}

/// Runs a session, which gives the clocks it took, on a fast device with the report on stdout, then clock by clock, which
/// must take as many clocks and give the same report.
pub fn both_timings(mut session: impl FnMut(Timing, &mut Report<'_>) -> u64) -> ! {
    let Some(mut stdout) = HostStream::stdout() else {
        failure(&["no stdout: enable semihosting"]);
    };
    let mut run = |timing, out: &mut dyn Write| {
        let mut report = Report { out, digest: Fnv1a64::EMPTY };
        let clocks = session(timing, &mut report);
        (clocks, report.digest)
    };
    let fast = run(Timing::Fast, &mut stdout);
    defmt::info!("fast: {=u64} clocks", fast.0);
    let tick = run(Timing::Tick, &mut Nowhere);
    defmt::info!("tick: {=u64} clocks", tick.0);
    if fast != tick {
        failure(&["clock by clock, the device took another time or reported otherwise"]);
    }
    let _ = writeln!(stdout, "clocks {}", fast.0);
    success()
}

/// Ends with status 1, and says why.
pub fn give_up(error: &dyn fmt::Display) -> ! {
    if let Some(mut stderr) = HostStream::stderr() {
        let _ = write!(stderr, "{error}");
    }
    failure(&[])
}
