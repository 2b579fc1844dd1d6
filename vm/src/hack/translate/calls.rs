//! Calls and returns: D holds the return address on the way there and the
//! answer on the way back. SP is on both ways where the arguments begin, or
//! would.
//!
//! A function whose words are in cells keeps the return address there. The
//! others make the frame of the book: arguments, return address, LCL, ARG, THIS,
//! THAT, locals; when they call something, LCL, ARG and SP are what the book
//! says. With [`super::Keep::Cells`] the words for THIS and THAT are not written
//! by a function that does not set these.

use super::code::{Code, Label};
use super::expr::Expr;
use super::frames::{Frame, RESULT};
use super::function::{Body, Entry};
use super::stubs::far_offset;
use crate::hack::asm::instruction::{DEST_A, DEST_D, DEST_M, JGT, comp};
use crate::hack::vm::command::{ARG, CONSTANTS, Command, FRAME, LCL, SP, THAT, THIS};

/// Kept by a return for the answer and for the way back.
const ANSWER: u16 = 13;
const BACK: u16 = 15;

/// More locals than this are made zero in a loop.
const IN_A_ROW: u16 = 6;

/// Goes to a function and comes back with its answer in D.
pub(super) fn call(code: &mut Code, function: Label) {
    let back = code.label();
    code.to(back);
    code.compute(DEST_D, comp::A);
    code.go(function);
    code.mark(back);
}

/// Whether a frame on the stack keeps THIS and THAT.
fn has_pointers(frame: Option<&Frame>) -> bool {
    matches!(frame, Some(Frame::Stack { pointers: true }))
}

/// Pushes D to the word behind the one that SP points to.
fn push_on(code: &mut Code) {
    code.at(SP);
    code.compute(DEST_A | DEST_M, comp::M_PLUS_1);
    code.compute(DEST_M, comp::D);
}

/// Makes a frame on the stack, of a function called with so many arguments.
/// D holds the return address. Leaves SP at the first local.
fn frame(code: &mut Code, arguments: u16, pointers: bool) {
    code.at(SP);
    match arguments {
        0 => code.compute(DEST_A, comp::M),
        1..=6 => {
            for _ in 1..arguments {
                code.compute(DEST_M, comp::M_PLUS_1);
            }
            code.compute(DEST_A | DEST_M, comp::M_PLUS_1);
        }
        _ => {
            code.at(BACK);
            code.compute(DEST_M, comp::D);
            code.at(arguments);
            code.compute(DEST_D, comp::A);
            code.at(SP);
            code.compute(DEST_M, comp::D_PLUS_M);
            code.at(BACK);
            code.compute(DEST_D, comp::M);
            code.at(SP);
            code.compute(DEST_A, comp::M);
        }
    }
    code.compute(DEST_M, comp::D);
    for cell in [LCL, ARG]
        .iter()
        .chain([THIS, THAT].iter().filter(|_| pointers))
    {
        code.at(*cell);
        code.compute(DEST_D, comp::M);
        push_on(code);
    }
    if pointers {
        code.compute(DEST_D, comp::A_PLUS_1);
    } else {
        code.compute(DEST_D, comp::A);
        code.at(FRAME - 2);
        code.compute(DEST_D, comp::D_PLUS_A);
    }
    code.at(LCL);
    code.compute(DEST_M, comp::D);
    code.at(SP);
    code.compute(DEST_M, comp::D);
    code.at(FRAME.saturating_add(arguments).min(0x7fff));
    code.compute(DEST_D, comp::D_MINUS_A);
    code.at(ARG);
    code.compute(DEST_M, comp::D);
}

/// Where functions with a frame on the stack return, the answer in D.
pub(super) fn leave(code: &mut Code, pointers: bool) {
    code.at(ANSWER);
    code.compute(DEST_M, comp::D);
    code.at(ARG);
    code.compute(DEST_D, comp::M);
    code.at(SP);
    code.compute(DEST_M, comp::D);
    let restore = |code: &mut Code, back, cell| {
        code.at(LCL);
        code.compute(DEST_A | DEST_M, back);
        code.compute(DEST_D, comp::M);
        code.at(cell);
        code.compute(DEST_M, comp::D);
    };
    if pointers {
        for cell in [THAT, THIS, ARG] {
            restore(code, comp::M_MINUS_1, cell);
        }
    } else {
        code.at(FRAME - 2);
        code.compute(DEST_D, comp::A);
        restore(code, comp::M_MINUS_D, ARG);
    }
    code.at(LCL);
    code.compute(DEST_A, comp::M_MINUS_1);
    code.compute(DEST_A, comp::A_MINUS_1);
    code.compute(DEST_D, comp::M);
    code.at(BACK);
    code.compute(DEST_M, comp::D);
    code.at(LCL);
    code.compute(DEST_A, comp::M_MINUS_1);
    code.compute(DEST_D, comp::M);
    code.at(LCL);
    code.compute(DEST_M, comp::D);
    code.at(ANSWER);
    code.compute(DEST_D, comp::M);
    code.at(BACK);
    code.compute(DEST_A, comp::M);
    code.go_to_a();
}

impl Body<'_, '_, '_> {
    /// Calls a function with the words on top; answers the next command.
    ///
    /// # Errors
    /// There is no such function.
    pub(super) fn call(&mut self, at: u32, callee: usize, arguments: u16) -> Result<u32, String> {
        if let Some(Entry { e, depth }) = self.looked_at(callee, arguments) {
            self.push(e, depth);
            return Ok(at + 1);
        }
        let below = self.stack.len().saturating_sub(usize::from(arguments));
        // Constants stay what they are, and so do the function's own cells.
        let own = self.cells().cloned();
        let keep = |e: &Expr| match e {
            Expr::Const(_) => true,
            Expr::Cell(cell) => own.as_ref().is_some_and(|own| own.has(*cell)),
            _ => false,
        };
        self.flush(below, &keep);
        let bottom = if self.cells().is_some() {
            0
        } else {
            self.set_sp(below as i32);
            below as u16
        };
        let given: Vec<Entry> = self.stack.drain(below..).collect();
        let Some(label) = self.shared.entry(callee, arguments) else {
            return Err(format!("{} calls nothing", self.function.name));
        };
        let to = match self.shared.frames.get(callee) {
            Some(Frame::Cells(cells)) => cells.arguments.as_slice(),
            _ => &[],
        };
        let own_this = own.as_ref().map(|own| own.this);
        let number = |entry: &Entry| far_offset(&entry.e, own_this?);
        let mut stub = None;
        if let (Some(this), true) = (own_this, self.shared.small) {
            let far = to.iter().zip(&given);
            let far = far.filter(|(_, entry)| number(entry).is_some());
            let far = far.map(|(cell, _)| *cell).collect();
            stub = self.stubs.of(callee, this, far, self.eval.code);
        }
        for (k, entry) in given.into_iter().enumerate() {
            let number = number(&entry).filter(|_| stub.is_some());
            match to.get(k) {
                Some(cell) => {
                    let given = number.map_or(entry.e, Expr::Const);
                    self.eval.store(&Expr::Cell(*cell), &given);
                }
                None => {
                    let place = Expr::Stacked(bottom + k as u16);
                    self.eval.store(&place, &entry.e);
                }
            }
        }
        call(self.eval.code, stub.unwrap_or(label));
        Ok(self.take_result(at + 1))
    }

    /// What a call has left in D goes where the next command wants it; answers the
    /// next command but that.
    fn take_result(&mut self, at: u32) -> u32 {
        let result = Expr::Cell(RESULT);
        let next = self.at(at).filter(|_| !self.labels.contains_key(&at));
        if let Some(Command::Pop(place)) = next {
            if place.base == CONSTANTS && !self.shared.live.is_read(at, place.offset) {
                return at + 1;
            }
            let to = self.place(place);
            let harmed = self.stack.iter().any(|e| e.e.is_changed_by(to.as_store()));
            if !harmed {
                self.eval.d_to(&to);
                return at + 1;
            }
        }
        if next == Some(Command::Return) {
            self.leave_d();
            self.stack.clear();
            return at + 1;
        }
        self.eval.code.keep_result();
        self.push(result, 1);
        at
    }

    /// The start of a function.
    pub(super) fn enter(&mut self) {
        let labels = self.shared.entries.get(self.index);
        let labels = labels.cloned().unwrap_or_default();
        match self.shared.frames.get(self.index) {
            Some(Frame::Cells(cells)) => {
                for (_, label) in labels {
                    self.eval.code.mark(label);
                }
                self.eval.code.at(cells.back);
                self.eval.code.compute(DEST_M, comp::D);
                let body = self.shared.bodies.get(self.index);
                if let Some(body) = body.filter(|_| self.shared.small) {
                    self.eval.code.mark(*body);
                }
                for (k, cell) in (0..).zip(&cells.locals) {
                    if self.shared.live.reads_first(self.index, k) {
                        self.eval.store(&Expr::Cell(*cell), &Expr::Const(0));
                    }
                }
            }
            frame_on_stack => {
                let pointers = has_pointers(frame_on_stack);
                let body = self.eval.code.label();
                for (arguments, label) in labels {
                    self.eval.code.mark(label);
                    frame(self.eval.code, arguments, pointers);
                    self.eval.code.go(body);
                }
                self.eval.code.mark(body);
                self.make_locals();
            }
        }
    }

    /// Takes room for locals on the stack, and makes those zero that are read first.
    fn make_locals(&mut self) {
        let locals = self.function.locals;
        let first: Vec<u16> = (0..locals.min(64))
            .filter(|k| self.shared.live.reads_first(self.index, *k))
            .collect();
        // From here on heights count from behind the locals.
        if first.len() <= usize::from(IN_A_ROW) && locals < 64 {
            for k in first {
                let local = Expr::Field {
                    base: LCL,
                    offset: k,
                };
                self.eval.store(&local, &Expr::Const(0));
            }
            self.set_sp(i32::from(locals));
        } else {
            let code = &mut *self.eval.code;
            code.at(locals);
            code.compute(DEST_D, comp::A);
            let again = code.label();
            code.mark(again);
            code.at(SP);
            code.compute(DEST_A | DEST_M, comp::M_PLUS_1);
            code.compute(DEST_A, comp::A_MINUS_1);
            code.compute(DEST_M, comp::ZERO);
            code.jump_back(comp::D_MINUS_1, JGT, again);
        }
        self.eval.sp = 0;
    }

    /// The end of a function, with its answer.
    pub(super) fn leave(&mut self, answer: &Expr) {
        self.eval.load(answer);
        self.leave_d();
    }

    /// The end of a function, its answer in D.
    pub(super) fn leave_d(&mut self) {
        let Some(cells) = self.cells() else {
            let frame = self.shared.frames.get(self.index);
            let [short, full] = self.shared.leave;
            let leave = if has_pointers(frame) { full } else { short };
            return self.eval.code.go(leave);
        };
        let back = cells.back;
        self.eval.code.at(back);
        self.eval.code.compute(DEST_A, comp::M);
        self.eval.code.go_to_a();
    }
}
