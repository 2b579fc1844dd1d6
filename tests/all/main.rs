//! One integration-test binary: a file a subject.

mod bbc;
mod cli;
mod cli_run;
mod cli_wrong;
mod house;
mod jack;
mod mos6502;
mod snapshots;
mod whole;
mod wrong;
