//! What the page is told: the state of everything, as one object.

use super::run::{MOST, Run};
use serde::Serialize;
use std::collections::BTreeMap;

/// Everything but the text and the pictures' pixels, which are asked for apart.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Shown {
    /// The scene's text: who changed it last, and how often it was.
    pub text: Text,
    /// The scene's file.
    pub file: File,
    /// What was chosen.
    pub chosen: Chosen,
    /// The native picture.
    pub native: Native,
    /// What is said about the text.
    pub problems: Problems,
    /// The params of the last text that was right.
    pub params: Vec<Param>,
    /// The machines that stand beside each other; as many as may.
    pub panels: [Panel; MOST],
    /// What the scene's lines cost, once somebody asked.
    pub costs: Costs,
    /// What was built last.
    pub built: Option<Built>,
}

impl Shown {
    /// Another program was built, or was not.
    pub fn build(&mut self, target: &'static str, files: Vec<String>, wrong: Option<String>) {
        self.built = Some(Built {
            target,
            count: self.built.as_ref().map_or(1, |built| built.count + 1),
            files,
            wrong,
        });
    }
}

/// The text's state.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Text {
    /// Goes up with each change of the text.
    pub revision: u64,
    /// The page that changed it, or `file`.
    pub by: String,
}

/// The file's state.
#[derive(Clone, Debug, Default, Serialize)]
pub struct File {
    /// As it was named.
    pub name: String,
    /// Where programs are built.
    pub directory: String,
    /// Whether it holds the text.
    pub saved: bool,
    /// Whether another text was written to it, while the page's was not saved.
    pub elsewhere: bool,
    /// What went wrong with it last.
    pub wrong: Option<String>,
}

/// What was chosen on the page.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Chosen {
    /// Goes up with text and values.
    pub serial: u64,
    /// Values of params that are not the text's, in the language's units (radians).
    pub set: BTreeMap<String, Vec<f64>>,
    /// The machines.
    pub runs: Vec<ChosenRun>,
}

/// A machine that was chosen.
#[derive(Clone, Debug, Default, Serialize)]
pub struct ChosenRun {
    /// Goes up with whatever it hangs on.
    pub serial: u64,
    /// The machine.
    pub target: &'static str,
    /// The format, if one was asked for.
    pub format: Option<String>,
    /// The mode, if one was asked for.
    pub mode: Option<String>,
    /// Other options, as the command line has them.
    pub options: String,
}

impl From<&Run> for ChosenRun {
    fn from(run: &Run) -> ChosenRun {
        ChosenRun {
            serial: run.serial,
            target: run.target.name,
            format: run.format.clone(),
            mode: run.mode.clone(),
            options: run.options.clone(),
        }
    }
}

/// What is shown of a machine.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Panel {
    /// Its run.
    pub machine: Machine,
    /// What is worth choosing there, once somebody asked.
    pub frontier: Frontier,
    /// What was asked for and has not had its turn.
    pub waits: Waits,
}

/// What waits for its turn, beside runs and searches.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Waits {
    /// To count what lines cost.
    pub costs: bool,
    /// To write the program.
    pub build: bool,
}

/// How far a picture is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// Nothing was begun.
    #[default]
    Idle,
    /// Native: the text is being read, or only a coarse picture is there.
    Coarse,
    /// The program is being planned.
    Planning,
    /// The machine runs.
    Running,
    /// The figures are there; the model is still to be compared.
    Comparing,
    /// Each line's cycles are being counted.
    Counting,
    /// The program is being written.
    Building,
    /// All is there.
    Done,
    /// Something is wrong, and said.
    Wrong,
    /// Somebody stopped it.
    Stopped,
}

/// The native picture's state.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Native {
    /// Whose wish it is.
    pub serial: u64,
    /// How far it is.
    pub stage: Stage,
    /// The picture that can be asked for; 0 for none.
    pub picture: u64,
    /// The image's columns and rows.
    pub size: (u32, u32),
    /// Milliseconds from the wish to the first picture, and to the whole one.
    pub first_ms: Option<u64>,
    /// The same of the whole one.
    pub whole_ms: Option<u64>,
    /// What went wrong.
    pub wrong: Option<String>,
}

/// What is said about the text.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Problems {
    /// Of which wish.
    pub serial: u64,
    /// Each, with its place.
    pub list: Vec<Problem>,
    /// All as the terminal shows them.
    pub text: String,
}

/// Something that is said about the text.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Problem {
    /// `error` or `warning`.
    pub severity: &'static str,
    /// What is said.
    pub message: String,
    /// The file, where it is another than the scene's own.
    pub file: Option<String>,
    /// From 1.
    pub line: usize,
    /// From 1, in characters.
    pub column: usize,
    /// Where it begins in the scene's text, in UTF-16.
    pub from: usize,
    /// And ends.
    pub to: usize,
}

/// A param.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Param {
    /// Its name.
    pub name: String,
    /// `bool`, `int` or `real`.
    pub kind: &'static str,
    /// What an angle is written in: `deg`, `turn` or `rad`; empty for others.
    pub unit: &'static str,
    /// How much of the language's own unit that is.
    pub scale: f64,
    /// One part for a scalar, else as many as the vector has.
    pub parts: Vec<Part>,
    /// Where its value is written in the scene's text, in UTF-16; none where it is in another.
    pub place: Option<(usize, usize)>,
}

/// A component of a param.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Part {
    /// `x`, `y`, `z`, or empty.
    pub name: &'static str,
    /// The text's value.
    pub value: f64,
    /// The range, where there is one.
    pub range: Option<(f64, f64)>,
}

/// The machine's state.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Machine {
    /// Whose run it is.
    pub serial: u64,
    /// How far it is.
    pub stage: Stage,
    /// The picture that can be asked for; 0 for none.
    pub picture: u64,
    /// Whether a picture of what is unlike can be asked for.
    pub difference: bool,
    /// Columns and rows.
    pub size: (u32, u32),
    /// Rows that the program has come past.
    pub rows: u64,
    /// Machines that run now: 0 or 1.
    pub at_work: u32,
    /// What it counts by.
    pub unit: &'static str,
    /// Its cycles so far.
    pub cycles: u64,
    /// Its own seconds so far.
    pub seconds: f64,
    /// What is known of the plan.
    pub plan: Option<Planned>,
    /// Bytes of code, tables and memory beside; what is not known is null.
    pub bytes: [Option<u64>; 3],
    /// Pixels of the picture.
    pub pixels: u64,
    /// Those unlike the native ones in the same inks.
    pub unlike_native: Option<u64>,
    /// Those unlike the model's, which should be none.
    pub unlike_model: Option<u64>,
    /// What went wrong.
    pub wrong: Option<String>,
}

impl Machine {
    /// Of another run, of which nothing is known yet; the last picture stays until there is
    /// another.
    #[must_use]
    pub fn begun(&self, serial: u64, stage: Stage) -> Machine {
        Machine {
            serial,
            stage,
            picture: self.picture,
            size: self.size,
            ..Machine::default()
        }
    }
}

/// What is known of a plan.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Planned {
    /// The machine's name.
    pub target: &'static str,
    /// How reals are held.
    pub format: &'static str,
    /// The screen's mode.
    pub mode: &'static str,
    /// Inks of the picture there.
    pub inks: usize,
    /// The share of pixels that is expected to be wrong, where a format was chosen by it.
    pub expected: Option<f64>,
    /// The share that may be.
    pub goal: Option<f64>,
}

/// What accuracy costs in time.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Frontier {
    /// Of which run.
    pub serial: u64,
    /// How far the search is: `running` until it ends.
    pub stage: Stage,
    /// Whether a search is still to begin.
    pub waits: bool,
    /// Whether text, values or mode are others now.
    pub stale: bool,
    /// What is worth choosing so far, from the quickest to the slowest.
    pub points: Vec<Dot>,
    /// Ways that were run whole so far.
    pub measured: usize,
    /// Ways that there are.
    pub tried: usize,
    /// Why there is none.
    pub wrong: Option<String>,
}

/// A way that is worth choosing, and what was measured of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Dot {
    /// How reals are held.
    pub format: String,
    /// Its other options, as the command line has them.
    pub options: String,
    /// The machine's time.
    pub seconds: f64,
    /// The machine's cycles.
    pub cycles: u64,
    /// The share of pixels whose ink is not the native one.
    pub error: f64,
    /// How many these are.
    pub unlike_native: u64,
    /// Pixels unlike the model's: none, or something is broken.
    pub unlike_model: u64,
    /// Bytes of code, tables and memory beside.
    pub memory: u64,
    /// The screen's mode.
    pub mode: String,
}

/// What lines cost.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Costs {
    /// On which machine.
    pub panel: usize,
    /// Of which run.
    pub serial: u64,
    /// Goes up with each; 0 where there are none.
    pub count: u64,
    /// Why there is none.
    pub wrong: Option<String>,
}

/// What was built.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Built {
    /// For which machine.
    pub target: &'static str,
    /// Goes up with each.
    pub count: u64,
    /// The files' names in the scene's directory.
    pub files: Vec<String>,
    /// Why there are none.
    pub wrong: Option<String>,
}
