//! BBC BASIC II and the machines around it.
//!
//! A program is tokenised ([`tokenise`]), decoded once into statements over resolved names
//! (`decode`), and run by walking small expression trees (`exec`, `eval`). Reals are the
//! machine's 40 bits ([`slowlight_isa::real40`]), integers its 32; errors carry its numbers,
//! messages and lines.
//!
//! - **Cycles** are BASIC II's at 2 MHz, from what was measured on the genuine ROM: a part that
//!   the text decides (`cost`), a part for the values that are met (`work`), and the constant
//!   share of interrupts; drawing in the operating system is also counted apart.
//! - **Memory** is the machine's: the program at PAGE, variables above it in their sizes and
//!   order, the stack below HIMEM; what does not fit is "No room". On the Micro the screen is
//!   in the same 64K, so that pokes draw.
//! - **Left out**: the assembler, USR and CALL (reaching one is an error that says where machine
//!   code runs), sound, programs that change their own lines.
//! - **Keys** are a script's, and lines of INPUT standard input's as well, where a program is
//!   [played](Machine::play); else GET sees RETURN, and INPUT the lines of
//!   [`Machine::type_lines`], then empty ones.
//! - **Dialects**: `Agon` and `BasicV` have their screens and their integers (which become
//!   reals instead of wrapping), but Micro's 40-bit arithmetic; Brandy's reals are doubles, and
//!   the Agon's 40 bits round otherwise.

mod arithmetic;
mod arrays;
mod ast;
mod calls;
mod code;
pub(crate) mod cost;
mod cursor;
mod data;
mod decode;
mod display;
mod error;
mod eval;
mod exec;
mod expressions;
mod files;
mod font;
mod functions;
mod input;
mod io;
pub(crate) mod keyboard;
mod loops;
mod modes;
mod names;
mod numeric;
mod pixels;
mod plot;
mod profile;
mod program;
mod raster;
mod state;
mod statements;
mod strings;
mod text;
mod tokenise;
mod trace;
mod values;
mod work;

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};

use slowlight_isa::real40::Real40;

use crate::keys::Keyboard;
use crate::{Charges, Fault, Roles, Screen, Stop, Watch};
use data::DataPointer;
use error::Error;
use profile::Profile;
pub use profile::{LineCost, StatementPlace};
use state::State;
pub use tokenise::{detokenise, tokenise};

/// PI, as the ROM has it.
const PI: Real40 = Real40::from_bits(0x82_490f_daa2);
/// 180/PI to the nearest, and PI/180 truncated, as the ROM's results show them to be.
const DEGREES: Real40 = Real40::from_bits(0x86_652e_e0d3);
const RADIANS: Real40 = Real40::from_bits(0x7b_0efa_3512);

/// Whose BASIC.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dialect {
    /// BBC Micro, BASIC II, OS 1.20.
    #[default]
    Micro,
    /// Agon Light, BBC BASIC (Z80).
    Agon,
    /// Matrix Brandy and others with BASIC V.
    BasicV,
}

/// A machine's make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Config {
    /// Whose BASIC and screen.
    pub dialect: Dialect,
    /// Where programs start: &1900 with a disc, &E00 without.
    pub page: u16,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            dialect: Dialect::Micro,
            page: 0x1900,
        }
    }
}

/// What a run leaves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// Why it ended.
    pub stop: Stop,
    /// Cycles of 2 MHz, drawing included.
    pub cycles: u64,
    /// Those of them spent in drawing: the operating system's plotting, and statements that
    /// write to the screen's memory. To choose and clear a mode is not drawing.
    pub plot_cycles: u64,
    /// The picture; no pixels in a text mode.
    pub screen: Screen,
    /// What was printed, without control codes but line feeds.
    pub text: String,
    /// The files, by name.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Bytes of the tokenised program.
    pub program_bytes: usize,
    /// The most bytes that variables and stack took together.
    pub ram_bytes: usize,
    /// The fewest bytes that were left free between them.
    pub free_bytes: usize,
}

/// Bytes of a tokenised line beside its text: 13, its number, its length.
const LINE_HEAD: u32 = 4;

/// A machine with a program in it.
pub struct Machine {
    config: Config,
    program: Vec<u8>,
    files: BTreeMap<String, Vec<u8>>,
    typed: VecDeque<Vec<u8>>,
}

impl Machine {
    /// An empty machine.
    pub fn new(config: Config) -> Self {
        Self {
            config,
            program: vec![0x0d, 0xff],
            files: BTreeMap::new(),
            typed: VecDeque::new(),
        }
    }

    /// Tokenises and loads program text.
    pub fn load_text(&mut self, text: &str) -> Result<(), Fault> {
        self.program = tokenise(text, self.config.dialect)?;
        Ok(())
    }

    /// Loads a tokenised program. Bytes after its end stay part of it, as on the machine.
    pub fn load_tokenised(&mut self, bytes: &[u8]) -> Result<(), Fault> {
        tokenise::lines(bytes)?;
        self.program = bytes.to_vec();
        Ok(())
    }

    /// Gives the program a file to read.
    pub fn add_file(&mut self, name: &str, bytes: Vec<u8>) {
        self.files.insert(name.to_owned(), bytes);
    }

    /// Lines for the program's INPUTs, one after the other; after them come empty ones.
    pub fn type_lines<T: AsRef<[u8]>>(&mut self, lines: impl IntoIterator<Item = T>) {
        self.typed
            .extend(lines.into_iter().map(|l| l.as_ref().to_vec()));
    }

    /// Bytes of the tokenised program.
    pub fn program_bytes(&self) -> usize {
        self.program.len()
    }

    /// Bytes that the entries of all variables, functions and procedures take that the program
    /// names, arrays' elements and the contents of strings left out.
    pub fn entry_bytes(&self) -> usize {
        let mut names = names::Names::new();
        if let Ok(lines) = tokenise::lines(&self.program) {
            decode::decode(&lines, self.config.dialect, &mut names);
        }
        names.all_bytes() as usize
    }

    /// Bytes from PAGE to HIMEM in a mode, for a program, its variables and its stack. `None`
    /// where the machine has no such mode.
    pub fn memory(&self, mode: u8) -> Option<usize> {
        let found = modes::find(self.config.dialect, mode)?;
        Some(found.himem.saturating_sub(u32::from(self.config.page)) as usize)
    }

    /// Runs the program from its first line on a fresh machine.
    ///
    /// Stops after `cycle_limit` cycles; `watch` is asked about every ten million.
    pub fn run(&self, cycle_limit: u64, watch: Watch<'_>) -> Run {
        self.run_from(&mut State::new(self.config), cycle_limit, watch)
            .0
    }

    /// Runs the program as [`Machine::run`] does, with a keyboard, whose frames are of 40,000
    /// cycles and whose calls are GET and INKEY.
    pub fn play(&self, keyboard: Keyboard, limit: u64, watch: Watch<'_>) -> (Run, Keyboard) {
        let mut state = State::new(self.config);
        let spare = keyboard.clone();
        state.keyboard = Some(keyboard);
        let (run, _) = self.run_from(&mut state, limit, watch);
        (run, state.keyboard.unwrap_or(spare))
    }

    /// Runs the program as [`Machine::run`] does, and counts what each of its lines takes.
    pub fn profile(&self, cycle_limit: u64, watch: Watch<'_>) -> (Run, Vec<LineCost>) {
        let (run, charges) = self.charges(cycle_limit, Roles::routines(&|_| false), watch);
        let lines = tokenise::lines(&self.program).unwrap_or_default();
        let mut costs: Vec<LineCost> = lines
            .iter()
            .map(|line| LineCost {
                line: line.number,
                times: 0,
                cycles: 0,
            })
            .collect();
        let statements = self.statements();
        for charge in charges.places {
            let Some(place) = statements.get(charge.place as usize) else {
                continue;
            };
            if let Some(cost) = costs.get_mut(place.line as usize) {
                cost.cycles += charge.cycles;
                if place.statement == 0 {
                    cost.times = charge.times;
                }
            }
        }
        (run, costs)
    }

    /// The same by statements ([`Machine::statements`]), where routines' are charged to the
    /// statements that call them. The charges add up to the run's cycles.
    pub fn charges(&self, cycle_limit: u64, roles: Roles<'_>, watch: Watch<'_>) -> (Run, Charges) {
        let mut state = State::new(self.config);
        let count = self.statements().len();
        state.profile = Some(Box::new(Profile::new(count, roles)));
        let (run, charges) = self.run_from(&mut state, cycle_limit, watch);
        // Each has its share of the interrupts, so that all add up to the run.
        (run, charges.shared(0, cost::with_interrupts))
    }

    /// The program's statements, in its order.
    pub fn statements(&self) -> Vec<StatementPlace> {
        let lines = tokenise::lines(&self.program).unwrap_or_default();
        let program = decode::decode(&lines, self.config.dialect, &mut names::Names::new());
        let place = |(k, statement): (usize, &program::Statement)| {
            let next = program.statements.get(k + 1);
            let next = next.filter(|next| next.line == statement.line);
            let text = lines
                .get(statement.line as usize)
                .map_or(0, |l| l.text.len());
            let end = next.map_or(text as u32, |next| next.at);
            let head = if statement.statement == 0 {
                LINE_HEAD
            } else {
                0
            };
            StatementPlace {
                line: statement.line,
                statement: statement.statement,
                bytes: end.saturating_sub(statement.at) + head,
            }
        };
        program.statements.iter().enumerate().map(place).collect()
    }

    fn run_from(&self, state: &mut State, cycle_limit: u64, watch: Watch<'_>) -> (Run, Charges) {
        state.files.contents = self.files.clone();
        state.typed = self.typed.clone();
        let stop = self.run_in(state, cycle_limit, watch);
        let charges = match state.profile.take() {
            Some(profile) => profile.finish(state.cycles),
            None => Charges::default(),
        };
        let room = state.himem.saturating_sub(state.top) as usize;
        let free = state.least_free as usize;
        let run = Run {
            stop,
            cycles: cost::with_interrupts(state.cycles),
            plot_cycles: cost::with_interrupts(state.plot_cycles),
            screen: state.display.screen(&state.mem),
            text: state.text.iter().map(|c| char::from(*c)).collect(),
            files: std::mem::take(&mut state.files.contents),
            program_bytes: self.program.len(),
            ram_bytes: room.saturating_sub(free),
            free_bytes: free,
        };
        (run, charges)
    }

    fn run_in(&self, state: &mut State, limit: u64, watch: Watch<'_>) -> Stop {
        let fault = |message: &str| {
            Stop::Fault(Fault {
                message: message.to_owned(),
                file: None,
                line: None,
                column: None,
            })
        };
        let lines = match tokenise::lines(&self.program) {
            Ok(lines) => lines,
            Err(f) => return Stop::Fault(f),
        };
        if state.place_program(&self.program).is_err() {
            return fault("No room: the program is longer than the memory from PAGE to HIMEM");
        }
        let program = decode::decode(&lines, self.config.dialect, &mut state.names);
        state.fit_names();
        let code = code::Code {
            program: &program,
            watch: RefCell::new(watch),
            limit: cost::without_interrupts(limit),
        };
        let mut start = 0;
        loop {
            let Err(error) = state.run_ops(&code, start) else {
                return Stop::Ended;
            };
            if error == Error::Halt {
                if let Some(mut stop) = state.stop.take() {
                    if let Stop::Fault(fault) = &mut stop {
                        fault.line = state.note_error(&program, error).map(u32::from);
                    }
                    return stop;
                }
                // RUN.
                start = 0;
                continue;
            }
            let number = state.note_error(&program, error);
            match state.on_error {
                Some(handler) if error != Error::Stop => {
                    state.unwind();
                    state.data = DataPointer::default();
                    state.trace = 0;
                    start = handler;
                }
                _ => {
                    let (_, message) = error.number_and_message();
                    return Stop::Fault(Fault {
                        message: message.to_owned(),
                        file: None,
                        line: number.map(u32::from),
                        column: None,
                    });
                }
            }
        }
    }
}

impl State {
    /// Sets ERR and ERL; answers the line's number.
    fn note_error(&mut self, program: &program::Program, error: Error) -> Option<u16> {
        let line = program
            .ops
            .get(self.op as usize)
            .and_then(|op| program.lines.get(op.line as usize))
            .map(|l| l.number);
        self.err = error.number_and_message().0;
        self.erl = line.unwrap_or(0);
        self.error = error;
        line
    }

    fn last_error(&self) -> (u8, &'static str) {
        self.error.number_and_message()
    }
}

#[cfg(test)]
mod tests;
