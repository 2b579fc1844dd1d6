//! A function's commands to code, a block at a time.
//!
//! Within a block the stack is a list of expressions. They are evaluated where
//! a word is stored, asked for, or passed on; what is left at the end of a
//! block, which Jack never does, is written to the stack.

use super::code::{Code, Label};
use super::eval::Eval;
use super::expr::{Expr, fixed};
use super::frames::{Cells, Frame};
use super::shared::Shared;
use super::stubs::Stubs;
use crate::hack::asm::instruction::{DEST_D, DEST_M, comp};
use crate::hack::vm::command::{ARG, CONSTANTS, Command, LCL, Place, SP, THAT, THIS};
use crate::hack::vm::heights::UNREACHED;
use crate::hack::vm::link::Function;
use crate::hack::vm::os::Native;
use std::collections::HashMap;

/// How deep an expression may be before it is evaluated.
const DEEPEST: u32 = 48;

/// A stack entry, and how deep its expression is.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub e: Expr,
    pub depth: u32,
}

/// A function as it is translated.
pub(super) struct Body<'s, 'p, 'c> {
    pub shared: &'s Shared<'p>,
    pub index: usize,
    pub function: &'p Function,
    pub eval: Eval<'c>,
    pub stubs: &'c mut Stubs,
    pub stack: Vec<Entry>,
    /// Labels of commands that are jumped to.
    pub labels: HashMap<u32, Label>,
}

/// Translates a function.
///
/// # Errors
/// What it calls that is not there.
pub(super) fn translate(
    shared: &Shared,
    index: usize,
    function: &Function,
    code: &mut Code,
    stubs: &mut Stubs,
) -> Result<(), String> {
    let peak = shared.heights.peaks.get(index).copied().unwrap_or(0);
    let mut labels = HashMap::new();
    for at in function.start..function.end {
        if let Some(Command::Goto(to) | Command::IfGoto(to)) =
            shared.program.commands.get(at as usize)
        {
            labels.entry(*to).or_insert_with(|| code.label());
        }
    }
    let mut body = Body {
        shared,
        index,
        function,
        eval: Eval::new(code, shared.scratch, peak, shared.compare),
        stubs,
        stack: Vec::new(),
        labels,
    };
    body.enter();
    let mut at = function.start + 1;
    while at <= function.end {
        at = body.command(at)?;
    }
    body.eval.code.drop_unread();
    Ok(())
}

impl Body<'_, '_, '_> {
    pub(super) fn cells(&self) -> Option<&Cells> {
        match self.shared.frames.get(self.index) {
            Some(Frame::Cells(cells)) => Some(cells),
            _ => None,
        }
    }

    fn height(&self, at: u32) -> u16 {
        let known = self.shared.heights.at.get(at as usize);
        known.copied().unwrap_or(UNREACHED)
    }

    pub(super) fn at(&self, at: u32) -> Option<Command> {
        self.shared.program.commands.get(at as usize).copied()
    }

    /// Translates a command, or several at once; answers the next.
    fn command(&mut self, at: u32) -> Result<u32, String> {
        let height = self.height(at);
        if height == UNREACHED {
            return Ok(at + 1);
        }
        if let Some(label) = self.labels.get(&at).copied() {
            // What comes before may be a jump, and then nothing is left to write.
            self.settle(height);
            self.eval.code.mark(label);
            self.start_block(height);
        } else if self.stack.len() != usize::from(height) {
            // Behind a jump, where only dead code would have led.
            self.start_block(height);
        }
        let Some(command) = self.at(at) else {
            return Ok(at + 1);
        };
        match command {
            Command::Push(place) => {
                let e = self.place(place);
                self.push(e, 1);
            }
            Command::Pop(place) => return Ok(self.pop_to(at, place)),
            Command::Binary(op) => {
                let y = self.pop();
                let x = self.pop();
                let depth = x.depth.max(y.depth) + 1;
                self.push(Expr::binary(op, x.e, y.e), depth);
            }
            Command::Neg => {
                let x = self.pop();
                self.push(Expr::neg(x.e), x.depth + 1);
            }
            Command::Not => {
                let x = self.pop();
                self.push(Expr::not(x.e), x.depth + 1);
            }
            Command::Goto(to) => {
                self.settle(self.height(to));
                self.go(to);
                self.stack.clear();
            }
            Command::IfGoto(to) => return Ok(self.if_goto(at, to)),
            Command::Call {
                function,
                arguments,
                ..
            } => return self.call(at, function as usize, arguments),
            Command::Native(native) => return self.native(at, native),
            Command::Return => {
                let value = self.pop();
                self.leave(&value.e);
                self.stack.clear();
            }
            Command::FunctionEnd => {
                self.eval.code.go(self.shared.halt);
                self.stack.clear();
            }
            Command::Function { .. } => {}
        }
        Ok(at + 1)
    }

    /// The stack at the start of a block: words that lie there.
    fn start_block(&mut self, height: u16) {
        let word = |h| Entry {
            e: self.slot(h),
            depth: 1,
        };
        self.stack = (0..height).map(word).collect();
        if self.cells().is_none() {
            self.eval.sp = i32::from(height);
        }
    }

    pub(super) fn push(&mut self, e: Expr, depth: u32) {
        self.stack.push(Entry { e, depth });
        if depth > DEEPEST {
            self.flush(self.stack.len(), &|_| false);
        }
    }

    pub(super) fn pop(&mut self) -> Entry {
        // Never empty where heights are proved.
        let zero = Entry {
            e: Expr::Const(0),
            depth: 1,
        };
        self.stack.pop().unwrap_or(zero)
    }

    /// Writes entries below `end` to their places on the stack, but those to keep.
    pub(super) fn flush(&mut self, end: usize, keep: &dyn Fn(&Expr) -> bool) {
        for (height, k) in (0..).zip(0..end.min(self.stack.len())) {
            let place = self.slot(height);
            if let Some(entry) = self.stack.get_mut(k)
                && entry.e != place
                && !keep(&entry.e)
            {
                let e = std::mem::replace(&mut entry.e, place.clone());
                entry.depth = 1;
                self.eval.store(&place, &e);
            }
        }
    }

    /// Writes all entries to the stack, and sets SP, which stays where it is where
    /// the stack is in cells.
    fn settle(&mut self, height: u16) {
        self.flush(self.stack.len(), &|_| false);
        if self.cells().is_none() {
            self.set_sp(i32::from(height));
        }
    }

    /// Where the stack's word at a height is.
    fn slot(&self, height: u16) -> Expr {
        let cells = self.cells().map(|cells| cells.stack.as_slice());
        let cell = cells.and_then(|cells| cells.get(usize::from(height)));
        cell.map_or(Expr::Stacked(height), |cell| Expr::Cell(*cell))
    }

    /// Moves SP to a height; D may be lost.
    pub(super) fn set_sp(&mut self, height: i32) {
        let up = height - self.eval.sp;
        self.eval.sp = height;
        let code = &mut *self.eval.code;
        match up {
            0 => {}
            -3..=3 => {
                let what = if up > 0 {
                    comp::M_PLUS_1
                } else {
                    comp::M_MINUS_1
                };
                code.at(SP);
                for _ in 0..up.unsigned_abs() {
                    code.compute(DEST_M, what);
                }
            }
            _ => {
                code.at(up.unsigned_abs() as u16);
                code.compute(DEST_D, comp::A);
                code.at(SP);
                let what = if up > 0 {
                    comp::D_PLUS_M
                } else {
                    comp::M_MINUS_D
                };
                code.compute(DEST_M, what);
            }
        }
    }

    /// An operand's expression.
    pub(super) fn place(&self, place: Place) -> Expr {
        let field = |base| Expr::Field {
            base,
            offset: place.offset,
        };
        let Some(cells) = self.cells() else {
            return match place.base {
                CONSTANTS => fixed(place.offset),
                base => field(base),
            };
        };
        let cell = |cells: &[u16], base| {
            let cell = cells.get(usize::from(place.offset));
            cell.map_or(field(base), |cell| Expr::Cell(*cell))
        };
        match place.base {
            CONSTANTS if place.offset == THIS => Expr::Cell(cells.this),
            CONSTANTS if place.offset == THAT => Expr::Cell(cells.that),
            CONSTANTS => fixed(place.offset),
            LCL => cell(&cells.locals, LCL),
            ARG => cell(&cells.arguments, ARG),
            THIS => field(cells.this),
            _ => field(cells.that),
        }
    }

    pub(super) fn go(&mut self, to: u32) {
        if let Some(label) = self.labels.get(&to) {
            self.eval.code.go(*label);
        }
    }

    /// A conditional jump; answers the next command. A jump around a jump, as
    /// the official compiler makes it for `if`, is one.
    fn if_goto(&mut self, at: u32, to: u32) -> u32 {
        let test = self.pop();
        self.settle(self.height(at + 1));
        let around = match self.at(at + 1) {
            Some(Command::Goto(other))
                if to == at + 2 && other != at + 1 && !self.labels.contains_key(&(at + 1)) =>
            {
                Some(other)
            }
            _ => None,
        };
        let (target, sense) = match around {
            Some(other) => (other, false),
            None => (to, true),
        };
        if let Some(label) = self.labels.get(&target).copied() {
            self.eval.branch(&test.e, sense, label);
        }
        at + 1 + u32::from(around.is_some())
    }

    fn native(&mut self, at: u32, native: Native) -> Result<u32, String> {
        match native {
            Native::Halt => {
                self.eval.code.go(self.shared.halt);
                self.push(Expr::Const(0), 1);
            }
            Native::Peek => {
                let address = self.pop();
                self.push(Expr::at(address.e), address.depth + 1);
            }
            Native::Poke => {
                let value = self.pop();
                let address = self.pop();
                self.store(&Expr::at(address.e), &value.e);
                self.push(Expr::Const(0), 1);
            }
            native => {
                return Err(format!(
                    "{} calls {}, which the program would have to bring: only the VM has it by itself",
                    self.function.name,
                    native.name()
                ));
            }
        }
        Ok(at + 1)
    }
}
