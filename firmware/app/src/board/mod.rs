//! What only a board has. In: nothing. Out: the log, the report, the exit, a clock to wait by. Cost: SysTick and UART1.
//!
//! The report is text through semihosting, which QEMU and a debug probe show as it is. The log is defmt frames on UART1:
//! `-monitor none -serial null -serial file:FILE` behind the runner's arguments keeps them, and `defmt-print -e ELF < FILE` reads them.

pub mod displace;
mod exit;
mod host;
mod log;
pub mod pree;
mod report;

pub use exit::{failure, success};
