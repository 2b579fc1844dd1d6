//! Translates VM code to the machine code of the Hack computer.
//!
//! ```
//! use slowlight_vm::hack::{cpu::Cpu, translate::{Options, translate}, vm::Program};
//! let main = "function Sys.init 0
//!             push constant 6
//!             push constant 7
//!             call Main.sum 2
//!             pop static 0
//!             call Sys.halt 0
//!             return
//!             function Main.sum 0
//!             push argument 0
//!             push argument 1
//!             add
//!             return";
//! let program = Program::link(&[("Main.vm".to_owned(), main.to_owned())])?;
//! let translation = translate(&program, Options::default())?;
//! let mut cpu = Cpu::new(&translation.words).map_err(|fault| vec![fault])?;
//! cpu.run(1_000, &mut |_| true);
//! assert_eq!(cpu.peek(16), 13);
//! # Ok::<(), Vec<slowlight_vm::Fault>>(())
//! ```
//!
//! # How
//!
//! The linked program is followed from the function that it starts in; what is
//! not called is not translated. Within a block of commands the stack is a list
//! of expressions ([`expr`]), which are computed in D, in A, and where they are
//! stored ([`eval`]), so that most words never see the stack. Comparisons become
//! jumps ([`branch`]). Words that go through `temp 0` and `pointer 1` on the way
//! to an element of an array and are not read later are not written ([`live`]).
//! Functions that do not call themselves, directly or not, keep their words at
//! fixed addresses ([`frames`]); the others have the frames of the book. What only
//! answers a word is not called ([`getters`]).
//!
//! What is fast is short here, too, so there is little to choose. Where a program
//! does not fit the ROM, calls in methods are made shorter and slower ([`stubs`]).
//!
//! # What is the same as on the VM
//!
//! What a program leaves in statics, heap and screen, and what its functions
//! answer. Not the same are the words that only the translator knows of: the
//! stack where functions have no frame on it, temps and THAT where the program
//! does not read them again, R13 to R15, and words from the last static to 255,
//! which a program must not use by address. Words and addresses are not checked:
//! what is a fault on the VM does something here, and goes on.
//!
//! `Memory.peek` and `Memory.poke` need no function. Any other native function
//! of the VM has to be brought by the program, in Jack or in VM code.

mod branch;
mod calls;
mod code;
mod elements;
mod eval;
mod expr;
mod finish;
mod frames;
mod function;
mod getters;
mod graph;
mod live;
mod operand;
mod shared;
mod stubs;
#[cfg(test)]
mod tests;

use super::asm::{ROM_WORDS, overflow};
use super::vm::Program;
use super::vm::command::SP;
use super::vm::heights;
use crate::Fault;
use crate::hack::asm::instruction::{DEST_D, DEST_M, comp};
use code::Code;
use frames::{Frame, Frames};
use graph::Graph;
use live::Live;
use shared::Shared;
use stubs::Stubs;

/// No more than this many faults are reported.
const FAULTS: usize = 100;

/// How words of which nothing is known are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compare {
    /// As the VM does it.
    #[default]
    Words,
    /// By the sign of their difference: shorter and faster, and wrong where that
    /// does not fit into 16 bits. For programs that never compare such words.
    Differences,
}

/// Where functions keep their arguments and locals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Keep {
    /// At fixed addresses, if they do not call themselves.
    #[default]
    Cells,
    /// All on the stack, in the frames of the book.
    Frames,
}

/// Whether words of ROM or cycles count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Size {
    /// Cycles, unless the program does not fit the ROM.
    #[default]
    Fit,
    /// Cycles.
    Fast,
    /// Words.
    Small,
}

/// How to translate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// How words are compared.
    pub compare: Compare,
    /// Where functions keep their words.
    pub keep: Keep,
    /// What counts.
    pub size: Size,
}

/// A program in machine code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Translation {
    /// The image of the ROM.
    pub words: Vec<u16>,
    /// The same as assembly.
    pub assembly: String,
    /// How many functions there are, and how many of them have frames on the stack.
    pub functions: (usize, usize),
    /// Whether it is made small, and slower than it could be.
    pub small: bool,
}

/// Translates a program.
///
/// # Errors
/// Native functions that it calls and does not bring, stack heights that are
/// not the same on all ways to a command, and by how many words it does not fit
/// the ROM.
pub fn translate(program: &Program, options: Options) -> Result<Translation, Vec<Fault>> {
    let start = program.start;
    let Some(heights) = heights::prove(&program.commands, &program.functions, start) else {
        let message = "a function's stack is not equally high on all ways to a command, \
            or it reads more arguments than it is given: no compiler makes such code"
            .to_owned();
        return Err(vec![fault(message)]);
    };
    let graph = Graph::new(program, &heights);
    let live = Live::new(program, &heights, &graph.order);
    let stack = options.keep == Keep::Frames;
    let frames = Frames::new(program, &heights, &graph, &live, stack);
    let once = |small, stubs| {
        let mut code = Code::default();
        let shared = Shared::new(program, &heights, &graph, &live, &frames, &mut code);
        let shared = Shared {
            compare: options.compare,
            small,
            ..shared
        };
        whole(&shared, &graph, &frames, code, stubs)
    };
    let make = |small| {
        let (code, stubs) = once(small, Stubs::default())?;
        if !small {
            return Ok(code);
        }
        // The first time only counts what the second can use.
        once(small, stubs.counted()).map(|(code, _)| code)
    };
    let (mut code, mut small) = match options.size {
        Size::Small => (make(true)?, true),
        Size::Fast | Size::Fit => (make(false)?, false),
    };
    if options.size == Size::Fit && code.length() > ROM_WORDS {
        (code, small) = (make(true)?, true);
    }
    let addresses = finish::addresses(&code);
    let words = finish::words(&code, &addresses);
    if let Some(message) = overflow(words.len()) {
        return Err(vec![fault(message)]);
    }
    let on_stack = |index: &&usize| matches!(frames.of.get(**index), Some(Frame::Stack { .. }));
    Ok(Translation {
        words,
        assembly: finish::text(&code),
        functions: (
            graph.order.len(),
            graph.order.iter().filter(on_stack).count(),
        ),
        small,
    })
}

/// The code of a program.
fn whole(
    shared: &Shared,
    graph: &Graph,
    frames: &Frames,
    mut code: Code,
    mut stubs: Stubs,
) -> Result<(Code, Stubs), Vec<Fault>> {
    let mut faults = Vec::new();
    begin(&mut code, shared, frames.stack);
    // The first one called last: it follows the beginning.
    for index in graph.order.iter().rev() {
        if let Some(function) = shared.program.functions.get(*index)
            && let Err(message) =
                function::translate(shared, *index, function, &mut code, &mut stubs)
            && faults.len() < FAULTS
        {
            faults.push(fault(message));
        }
    }
    stubs.make(&mut code, |function| {
        let body = *shared.bodies.get(function)?;
        match frames.of.get(function)? {
            Frame::Cells(cells) => Some((cells, body)),
            Frame::Stack { .. } => None,
        }
    });
    for (label, pointers) in shared.leave.into_iter().zip([false, true]) {
        code.mark(label);
        calls::leave(&mut code, pointers);
    }
    code.mark(shared.halt);
    code.go(shared.halt);
    if faults.is_empty() {
        finish::tidy(&mut code);
        Ok((code, stubs))
    } else {
        Err(faults)
    }
}

/// Sets up the stack, as if the end of the program had called the first function.
fn begin(code: &mut Code, shared: &Shared, stack: u16) {
    let start = shared.program.start as usize;
    code.at(stack);
    code.compute(DEST_D, comp::A);
    code.at(SP);
    code.compute(DEST_M, comp::D);
    code.to(shared.halt);
    code.compute(DEST_D, comp::A);
    if let Some(label) = shared.entry(start, 0) {
        code.go(label);
    }
}

fn fault(message: String) -> Fault {
    Fault {
        message,
        file: None,
        line: None,
        column: None,
    }
}
