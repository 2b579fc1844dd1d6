//! Instructions with labels, and what is known of A and D between them.
//!
//! The buffer leaves out instructions that would change nothing: `@x` where A
//! is x, `D=M` where D already is that word. So the code above it need not know
//! what the code before has left.

use super::frames::RESULT;
use crate::hack::asm::instruction::{COMPUTE, DEST_A, DEST_D, DEST_M, JMP, comp};
use crate::hack::vm::command::KEYBOARD;

/// A place in the code; an index of [`Code`]'s labels.
pub(super) type Label = usize;

/// An instruction, or a label for the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ins {
    /// `@value`
    At(u16),
    /// `@label`
    To(Label),
    /// A computation, as its word.
    Compute(u16),
    Mark(Label),
}

/// `0;JMP`
pub(super) const GO: u16 = COMPUTE | comp::ZERO << 6 | JMP;

/// Code as it is made.
#[derive(Default)]
pub(super) struct Code {
    pub ins: Vec<Ins>,
    /// The names of labels that have one.
    pub names: Vec<Option<String>>,
    /// What is in A, if that is known.
    a: Option<u16>,
    /// Addresses of words that D equals.
    held: Vec<u16>,
    /// What is in D, if that is known.
    d: Option<u16>,
    /// Nothing gets here, until the next label.
    dead: bool,
    /// Where [`RESULT`] was stored last, if nobody has read it since.
    unread: Option<usize>,
}

impl Code {
    /// A label without a name.
    pub fn label(&mut self) -> Label {
        self.names.push(None);
        self.names.len() - 1
    }

    /// A label with a name.
    pub fn named(&mut self, name: String) -> Label {
        let label = self.label();
        if let Some(slot) = self.names.get_mut(label) {
            *slot = Some(name);
        }
        label
    }

    /// How many instructions there are.
    pub fn length(&self) -> usize {
        let is_instruction = |ins: &&Ins| !matches!(ins, Ins::Mark(_));
        self.ins.iter().filter(is_instruction).count()
    }

    /// Places a label here.
    pub fn mark(&mut self, label: Label) {
        // A jump to what follows is none.
        let marks = self.ins.iter().rev();
        let marks = marks.take_while(|ins| matches!(ins, Ins::Mark(_))).count();
        let end = self.ins.len() - marks;
        let before = end.checked_sub(2).and_then(|at| self.ins.get(at..end));
        if before == Some(&[Ins::To(label), Ins::Compute(GO)]) {
            self.ins.drain(end - 2..end);
        }
        self.ins.push(Ins::Mark(label));
        self.forget();
        self.dead = false;
    }

    /// Nothing is known of A and D any more.
    pub fn forget(&mut self) {
        self.a = None;
        self.d = None;
        self.held.clear();
    }

    /// Whether D is known to be a constant.
    pub fn is_in_d(&self, constant: u16) -> bool {
        self.d == Some(constant)
    }

    /// Whether D is known to equal the word at an address.
    pub fn holds(&self, cell: u16) -> bool {
        self.held.contains(&cell)
    }

    /// Keeps D, a call's answer, in [`RESULT`], for as long as nobody asks for
    /// anything but D.
    pub fn keep_result(&mut self) {
        self.drop_unread();
        self.at(RESULT);
        self.unread = (!self.dead).then(|| self.ins.len() - 1);
        self.compute(DEST_M, comp::D);
    }

    /// Takes the last [`Code::keep_result`] back if it was for nothing. To be
    /// called where the answer is no longer wanted.
    pub fn drop_unread(&mut self) {
        if let Some(at) = self.unread.take() {
            self.ins.drain(at..at + 2);
        }
    }

    /// `@value`
    pub fn at(&mut self, value: u16) {
        if value == RESULT {
            self.unread = None;
        }
        if !self.dead && self.a != Some(value) {
            self.ins.push(Ins::At(value));
            self.a = Some(value);
        }
    }

    /// `@label`
    pub fn to(&mut self, label: Label) {
        if !self.dead {
            self.ins.push(Ins::To(label));
            self.a = None;
        }
    }

    /// A computation of seven bits to destinations.
    pub fn compute(&mut self, dest: u16, what: u16) {
        let known = self.a.is_some_and(|a| self.holds(a));
        if self.dead || (dest == DEST_D && what == comp::M && known) {
            return;
        }
        self.ins.push(Ins::Compute(COMPUTE | what << 6 | dest));
        let cell = self.a.filter(|cell| *cell != KEYBOARD);
        if dest & DEST_M != 0 {
            match cell {
                Some(cell) if what != comp::D => self.held.retain(|held| *held != cell),
                Some(_) => {}
                None => self.held.clear(),
            }
        }
        if dest & DEST_D != 0 {
            self.held.clear();
            self.d = match what {
                comp::ZERO => Some(0),
                comp::ONE => Some(1),
                comp::MINUS_ONE => Some(u16::MAX),
                comp::A => self.a,
                comp::NOT_A => self.a.map(|a| !a),
                _ => None,
            };
        }
        let copies = dest & DEST_M != 0 && (dest & DEST_D != 0 || what == comp::D);
        let loads = dest == DEST_D && what == comp::M;
        if let Some(cell) = cell
            && (copies || loads)
            && !self.held.contains(&cell)
        {
            self.held.push(cell);
        }
        if dest & DEST_A != 0 {
            self.a = None;
        }
    }

    /// Jumps to a label where a computation's result meets a condition.
    pub fn jump(&mut self, what: u16, condition: u16, label: Label) {
        if self.dead {
            return;
        }
        self.to(label);
        self.ins.push(Ins::Compute(COMPUTE | what << 6 | condition));
        self.dead = condition == JMP;
    }

    /// Jumps to a label.
    pub fn go(&mut self, label: Label) {
        self.jump(comp::ZERO, JMP, label);
    }

    /// Jumps to the address in A.
    pub fn go_to_a(&mut self) {
        if !self.dead {
            self.ins.push(Ins::Compute(GO));
            self.dead = true;
        }
    }

    /// Jumps where a computation to D meets a condition.
    pub fn jump_back(&mut self, what: u16, condition: u16, label: Label) {
        if !self.dead {
            self.to(label);
            self.ins
                .push(Ins::Compute(COMPUTE | what << 6 | DEST_D | condition));
            self.held.clear();
            self.d = None;
        }
    }
}
