//! Where each function keeps its arguments, locals and pointers.
//!
//! A function that is never called while it runs needs one place for them: words
//! of fixed addresses, as cheap as statics. They lie where the program has no
//! statics, above those of all functions that it calls, so two functions share
//! words where neither runs within the other. Recursive functions, and those for
//! which there is no room, have the frames of the book on the stack.

use super::graph::Graph;
use super::live::Live;
use crate::hack::vm::command::{ARG, CONSTANTS, Command, Place, STACK, STATIC, TEMP, THAT, THIS};
use crate::hack::vm::heights::{Heights, UNREACHED};
use crate::hack::vm::link::{Function, Program};

/// Kept for what a call has answered.
pub(super) const RESULT: u16 = 14;
/// The most words that the stack begins later by.
const TAKEN: u16 = 512;
/// Cells at most to put words aside within expressions.
const SCRATCH: usize = 16;
/// Always there to put a word aside.
const ASIDE: u16 = 15;

/// Where a function's words are.
#[derive(Clone, Debug)]
pub(super) enum Frame {
    Cells(Cells),
    /// On the stack, as in the book; its words for THIS and THAT are left as they
    /// are where the function does not change those.
    Stack {
        /// Whether it does.
        pointers: bool,
    },
}

/// The cells of a function's words.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    /// The return address.
    pub back: u16,
    pub arguments: Vec<u16>,
    pub locals: Vec<u16>,
    /// What lies on the stack at jumps and calls.
    pub stack: Vec<u16>,
    pub this: u16,
    pub that: u16,
}

impl Cells {
    /// Gives out free cells, as many as a function needs; `None` if there are not.
    fn new(
        program: &Program,
        function: &Function,
        arguments: u16,
        waiting: u16,
        free: &mut dyn Iterator<Item = u16>,
    ) -> Option<Cells> {
        let mut several = |count: u16| -> Option<Vec<u16>> {
            let cells: Vec<u16> = free.take(usize::from(count)).collect();
            (cells.len() == usize::from(count)).then_some(cells)
        };
        let arguments = several(arguments)?;
        let locals = several(function.locals)?;
        let stack = several(waiting)?;
        let back = free.next()?;
        let own_this = is_method(program, function);
        let first = arguments.first().copied().filter(|_| own_this);
        let mut pointer = |which| {
            if let (THIS, Some(first)) = (which, first) {
                Some(first)
            } else if uses(program, function, which) {
                free.next()
            } else {
                Some(which)
            }
        };
        Some(Cells {
            back,
            arguments,
            locals,
            stack,
            this: pointer(THIS)?,
            that: pointer(THAT)?,
        })
    }

    /// Whether a cell is one of them.
    pub fn has(&self, cell: u16) -> bool {
        let own = |cells: &[u16]| cells.contains(&cell);
        own(&self.arguments) || own(&self.locals)
    }
}

/// The frames of a program's functions.
pub(super) struct Frames {
    /// For each function.
    pub of: Vec<Frame>,
    /// What is left, for what is put aside within expressions.
    pub scratch: Vec<u16>,
    /// Where the stack begins.
    pub stack: u16,
}

impl Frames {
    /// `stack` asks for frames on the stack for all functions.
    pub fn new(
        program: &Program,
        heights: &Heights,
        graph: &Graph,
        live: &Live,
        stack: bool,
    ) -> Frames {
        let free = free_cells(program, graph);
        // A function that reads its caller's pointers wants them where all have them.
        let stack = stack || graph.order.iter().any(|f| live.pointers(*f) != 0);
        let frame = |function: &Function| Frame::Stack {
            pointers: stack || sets_pointers(program, function),
        };
        let mut of: Vec<Frame> = program.functions.iter().map(frame).collect();
        let mut ends = vec![0; program.functions.len()];
        let mut most = 0;
        for index in &graph.order {
            let callees = graph.callees.get(*index).into_iter().flatten();
            let below = callees.filter_map(|c| ends.get(*c)).copied().max();
            let below = below.unwrap_or(0);
            let Some(function) = program.functions.get(*index) else {
                continue;
            };
            let arguments = match graph.arguments.get(*index).map(Vec::as_slice) {
                Some([]) | None => Some(0),
                Some([one]) => Some(*one),
                Some(_) => None,
            };
            let mut end = below;
            if let Some(arguments) = arguments
                && !stack
                && !graph.recursive.get(*index).is_none_or(|r| *r)
            {
                let mut rest = free.iter().copied().skip(below);
                let waiting = waiting(program, heights, function);
                let cells = Cells::new(program, function, arguments, waiting, &mut rest);
                if let (Some(cells), Some(frame)) = (cells, of.get_mut(*index)) {
                    end = free.len() - rest.count();
                    *frame = Frame::Cells(cells);
                }
            }
            if let Some(slot) = ends.get_mut(*index) {
                *slot = end;
            }
            most = most.max(end);
        }
        let mut scratch = vec![ASIDE];
        let left = free.iter().skip(most).filter(|cell| **cell < STACK);
        scratch.extend(left.take(SCRATCH));
        let last = free.get(most.wrapping_sub(1)).copied().unwrap_or(0);
        Frames {
            of,
            scratch,
            stack: STACK.max(last + 1),
        }
    }
}

/// Whether a function's THIS is its first argument all the time, as in the methods
/// of Jack: set at once, and neither of them changed.
fn is_method(program: &Program, function: &Function) -> bool {
    let this = Place::fixed(THIS);
    let first = Place {
        base: ARG,
        offset: 0,
    };
    let commands = program.commands.get(function.range()).unwrap_or(&[]);
    let pops = |place| {
        let pops = commands.iter().filter(|c| **c == Command::Pop(place));
        pops.count()
    };
    let starts = [Command::Push(first), Command::Pop(this)];
    commands.get(1..3) == Some(&starts) && pops(this) == 1 && pops(first) == 0
}

/// Whether a function sets THIS or THAT.
fn sets_pointers(program: &Program, function: &Function) -> bool {
    let commands = program.commands.get(function.range()).unwrap_or(&[]);
    let pointers = [THIS, THAT].map(|which| Command::Pop(Place::fixed(which)));
    commands.iter().any(|command| pointers.contains(command))
}

/// Whether a function names a pointer or what it points to.
fn uses(program: &Program, function: &Function, pointer: u16) -> bool {
    let commands = program.commands.get(function.range()).unwrap_or(&[]);
    commands.iter().any(|command| match command {
        Command::Push(place) | Command::Pop(place) => {
            place.base == pointer || (place.base == CONSTANTS && place.offset == pointer)
        }
        _ => false,
    })
}

/// How many words wait on the stack at a function's jumps, labels and calls.
fn waiting(program: &Program, heights: &Heights, function: &Function) -> u16 {
    let commands = program.commands.get(function.range()).unwrap_or(&[]);
    let known = heights.at.get(function.range()).unwrap_or(&[]);
    let both = commands.iter().zip(known);
    let waiting = both.filter(|(_, height)| **height != UNREACHED);
    let waiting = waiting.map(|(command, height)| match command {
        Command::Call { arguments, .. } => height.saturating_sub(*arguments),
        Command::Goto(_) => *height,
        Command::IfGoto(_) => height.saturating_sub(1),
        _ => 0,
    });
    waiting.max().unwrap_or(0)
}

/// Words that the program does not name: temps, what is left by the statics, and
/// the beginning of the stack.
fn free_cells(program: &Program, graph: &Graph) -> Vec<u16> {
    let mut used = [false; 8];
    for index in &graph.order {
        let Some(function) = program.functions.get(*index) else {
            continue;
        };
        for command in program.commands.get(function.range()).unwrap_or(&[]) {
            if let Command::Push(place) | Command::Pop(place) = command
                && place.base == CONSTANTS
                && let Some(temp) = place.offset.checked_sub(TEMP)
                && let Some(used) = used.get_mut(usize::from(temp))
            {
                *used = true;
            }
        }
    }
    let temps = (TEMP..).zip(used).filter(|(_, used)| !used);
    let statics = STATIC + program.statics()..STACK + TAKEN;
    temps.map(|(cell, _)| cell).chain(statics).collect()
}
