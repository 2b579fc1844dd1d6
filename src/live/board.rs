//! What a worker is given and where it shows what it has found: the desk of a server, or a
//! page by itself.

use super::run::{MOST, Run};
use super::shown::Shown;
use std::collections::BTreeMap;
use std::sync::Arc;
use web_time::Instant;

/// Where what was found is shown.
pub trait Board {
    /// Changes what is shown.
    fn show(&self, change: impl FnOnce(&mut Shown, &mut Pictures));

    /// The same on behalf of a wish, unless a newer one has come.
    fn show_of(&self, serial: u64, change: impl FnOnce(&mut Shown, &mut Pictures));

    /// The same on behalf of a run.
    fn show_run(&self, run: &Run, change: impl FnOnce(&mut Shown, &mut Pictures));
}

/// What is wanted.
#[derive(Clone, Debug)]
pub struct Wish {
    /// Goes up with text and values, which the native picture hangs on.
    pub serial: u64,
    /// When anything of it was changed last.
    pub at: Instant,
    /// The scene's text.
    pub text: Arc<str>,
    /// Values of params that are not the text's.
    pub set: BTreeMap<String, Vec<f64>>,
    /// The machines, one or two.
    pub runs: Vec<Run>,
}

/// What a machine can be asked to do beside running.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// Run the program.
    Run,
    /// Count what each line takes.
    Costs,
    /// Write the program's files.
    Build,
    /// Search for what accuracy costs in time.
    Tune,
}

/// What is asked for apart from the state: pictures, as PNGs.
#[derive(Clone, Default)]
pub struct Pictures {
    /// The native one.
    pub native: Arc<Vec<u8>>,
    /// Each machine's, and where it is unlike the native one.
    pub machines: [Views; MOST],
    /// What `explain --json` prints.
    pub costs: Arc<Vec<u8>>,
}

/// The pictures of a machine.
#[derive(Clone, Default)]
pub struct Views {
    /// Its own.
    pub machine: Arc<Vec<u8>>,
    /// Where it is unlike the native one.
    pub difference: Arc<Vec<u8>>,
}
