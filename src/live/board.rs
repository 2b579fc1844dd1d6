//! What a worker is given and where it shows what it has found: the desk of a server, or a
//! page by itself.

use super::shown::Shown;
use slowlight_compiler::targets::Target;
use std::collections::BTreeMap;
use std::sync::Arc;
use web_time::Instant;

/// Where what was found is shown.
pub trait Board {
    /// Changes what is shown.
    fn show(&self, change: impl FnOnce(&mut Shown, &mut Pictures));

    /// The same on behalf of a wish, unless a newer one has come.
    fn show_of(&self, serial: u64, change: impl FnOnce(&mut Shown, &mut Pictures));
}

/// What is wanted.
#[derive(Clone, Debug)]
pub struct Wish {
    /// Goes up with each.
    pub serial: u64,
    /// When it came.
    pub at: Instant,
    /// The scene's text.
    pub text: Arc<str>,
    /// Values of params that are not the text's.
    pub set: BTreeMap<String, Vec<f64>>,
    /// The machine.
    pub target: &'static Target,
    /// The format, if one is asked for.
    pub format: Option<String>,
    /// The mode, if one is asked for.
    pub mode: Option<String>,
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
}

/// What is asked for apart from the state: pictures, as PNGs.
#[derive(Clone, Default)]
pub struct Pictures {
    /// The native one.
    pub native: Arc<Vec<u8>>,
    /// The machine's.
    pub machine: Arc<Vec<u8>>,
    /// Where they are unlike.
    pub difference: Arc<Vec<u8>>,
    /// What `explain --json` prints.
    pub costs: Arc<Vec<u8>>,
}
