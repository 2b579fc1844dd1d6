//! Expressions to D or A, and stores.

use super::Compare;
use super::code::Code;
use super::expr::Expr;
use super::operand::{Operand, is_one, near, near_address, pick};
use crate::hack::asm::instruction::{DEST_A, DEST_D, DEST_M, comp};
use crate::hack::vm::command::{Binary, SP};

/// Kept for stores to words far from what a pointer holds.
const FAR: u16 = 13;

/// Makes code for expressions.
pub(super) struct Eval<'c> {
    pub code: &'c mut Code,
    /// By how much SP stands above the function's lowest stack word.
    pub sp: i32,
    /// Cells that hold what is put aside within one expression.
    pub scratch: &'c [u16],
    /// Height above which the stack is free for what finds no cell.
    pub peak: u16,
    pub compare: Compare,
    /// How much is put aside.
    aside: usize,
}

impl<'c> Eval<'c> {
    pub fn new(code: &'c mut Code, scratch: &'c [u16], peak: u16, compare: Compare) -> Self {
        Eval {
            code,
            sp: 0,
            scratch,
            peak,
            compare,
            aside: 0,
        }
    }

    fn near(&self, e: &Expr) -> Option<u32> {
        near(e, self.sp)
    }

    fn operand(&mut self, e: &Expr) -> Operand {
        self.code.operand(e, self.sp)
    }

    /// The value of an expression to D.
    pub fn load(&mut self, e: &Expr) {
        self.load_to(e, DEST_D);
    }

    /// The value of an expression to `dest`: D or A. The other is lost.
    fn load_to(&mut self, e: &Expr, dest: u16) {
        match e {
            Expr::Const(c) => self.constant(*c, dest),
            Expr::Cell(cell) if dest == DEST_D && self.code.holds(*cell) => {}
            Expr::Cell(_) => {
                self.code.address(e, self.sp);
                self.code.compute(dest, comp::M);
            }
            Expr::Field { .. } | Expr::Stacked(_) => {
                self.load_address(e);
                self.code.compute(dest, comp::M);
            }
            Expr::At(address) => {
                if self.near(e).is_some() {
                    self.code.address(e, self.sp);
                } else {
                    self.load_to(address, DEST_A);
                }
                self.code.compute(dest, comp::M);
            }
            _ if e.is_bool() => {
                self.load_bool(e);
                if dest == DEST_A {
                    self.code.compute(DEST_A, comp::D);
                }
            }
            Expr::Neg(x) => self.unary(x, dest, [comp::NEG_D, comp::NEG_A, comp::NEG_M]),
            Expr::Not(x) => self.unary(x, dest, [comp::NOT_D, comp::NOT_A, comp::NOT_M]),
            Expr::Binary(op, x, y) => self.binary(*op, x, y, dest),
        }
    }

    fn constant(&mut self, c: u16, dest: u16) {
        match c {
            c if dest == DEST_D && self.code.is_in_d(c) => {}
            0 => self.code.compute(dest, comp::ZERO),
            1 => self.code.compute(dest, comp::ONE),
            u16::MAX => self.code.compute(dest, comp::MINUS_ONE),
            0x8000.. => {
                self.code.at(!c);
                self.code.compute(dest, comp::NOT_A);
            }
            c => {
                self.code.at(c);
                if dest == DEST_D {
                    self.code.compute(dest, comp::A);
                }
            }
        }
    }

    /// The address of a field or a stack word to A; D may be lost.
    fn load_address(&mut self, e: &Expr) {
        let (base, offset) = match e {
            Expr::Field { base, offset } => (*base, i32::from(*offset)),
            Expr::Stacked(height) => (SP, i32::from(*height) - self.sp),
            _ => return self.code.address(e, self.sp),
        };
        if offset.unsigned_abs() <= 3 {
            return self.code.address(e, self.sp);
        }
        self.code.at(offset.unsigned_abs() as u16);
        self.code.compute(DEST_D, comp::A);
        self.code.at(base);
        let sum = if offset > 0 {
            comp::D_PLUS_M
        } else {
            comp::M_MINUS_D
        };
        self.code.compute(DEST_A, sum);
    }

    fn unary(&mut self, x: &Expr, dest: u16, comps: [u16; 3]) {
        let [of_d, of_a, of_m] = comps;
        if self.near(x).is_some() {
            let x = self.operand(x);
            self.code.compute(dest, pick(x, of_a, of_m));
        } else {
            self.load(x);
            self.code.compute(dest, of_d);
        }
    }

    fn binary(&mut self, op: Binary, x: &Expr, y: &Expr, dest: u16) {
        if let (Binary::Add, Some(k)) = (op, is_one(y)) {
            let up = k > 0;
            let chosen = |plus, minus| if up { plus } else { minus };
            return self.unary(
                x,
                dest,
                [
                    chosen(comp::D_PLUS_1, comp::D_MINUS_1),
                    chosen(comp::A_PLUS_1, comp::A_MINUS_1),
                    chosen(comp::M_PLUS_1, comp::M_MINUS_1),
                ],
            );
        }
        if let (Binary::Add, Expr::Const(c @ 0x8001..)) = (op, y) {
            self.load(x);
            self.code.at(c.wrapping_neg());
            return self.code.compute(dest, comp::D_MINUS_A);
        }
        let turned = match (self.near(x), self.near(y)) {
            (Some(_), Some(_)) => matches!(y, Expr::Cell(cell) if self.code.holds(*cell)),
            (Some(_), None) => true,
            (None, Some(_)) => false,
            (None, None) => return self.both(op, x, y, dest),
        };
        let (first, second) = if turned { (y, x) } else { (x, y) };
        self.load(first);
        let operand = self.operand(second);
        self.code.compute(dest, arithmetic(op, operand, turned));
    }

    /// An operation on two words both of which need D.
    fn both(&mut self, op: Binary, x: &Expr, y: &Expr, dest: u16) {
        self.load(y);
        let aside = self.put_aside();
        self.load(x);
        let operand = self.operand(&aside);
        self.code.compute(dest, arithmetic(op, operand, false));
        self.aside -= 1;
    }

    /// Puts D aside; whoever does so counts `aside` down again.
    fn put_aside(&mut self) -> Expr {
        let place = match self.scratch.get(self.aside) {
            Some(cell) => Expr::Cell(*cell),
            None => {
                let more = (self.aside - self.scratch.len()) as u16;
                Expr::Stacked(self.peak.saturating_add(more))
            }
        };
        self.aside += 1;
        self.d_to(&place);
        place
    }

    /// The value of a comparison, or of what is made of several, to D: 0 or -1.
    fn load_bool(&mut self, e: &Expr) {
        let (holds, end) = (self.code.label(), self.code.label());
        self.branch(e, true, holds);
        self.code.compute(DEST_D, comp::ZERO);
        self.code.go(end);
        self.code.mark(holds);
        self.code.compute(DEST_D, comp::MINUS_ONE);
        self.code.mark(end);
    }

    /// Keeps an operand that is used twice: itself where it is near, else a copy.
    /// The second answer says that `aside` is to be counted down.
    pub(super) fn kept(&mut self, e: &Expr) -> (Expr, bool) {
        if self.near(e).is_some_and(|length| length <= 3) {
            return (e.clone(), false);
        }
        self.load(e);
        (self.put_aside(), true)
    }

    pub(super) fn drop_kept(&mut self, was_put_aside: bool) {
        self.aside -= usize::from(was_put_aside);
    }

    /// Stores D.
    pub fn d_to(&mut self, to: &Expr) {
        if near_address(to, self.sp).is_some() {
            self.code.address(to, self.sp);
            self.code.compute(DEST_M, comp::D);
            return;
        }
        // D + address, and each back from the sum.
        let value = Expr::Cell(FAR);
        self.code.address(&value, self.sp);
        self.code.compute(DEST_M, comp::D);
        self.load_far_address(to);
        self.store_at_d(&value);
    }

    /// The address of a place that is not near to D.
    fn load_far_address(&mut self, to: &Expr) {
        match to {
            Expr::At(address) => self.load(address),
            place => {
                self.load_address(place);
                self.code.compute(DEST_D, comp::A);
            }
        }
    }

    /// Stores what is near at the address in D.
    fn store_at_d(&mut self, value: &Expr) {
        let operand = self.operand(value);
        self.code
            .compute(DEST_D, pick(operand, comp::D_PLUS_A, comp::D_PLUS_M));
        self.code
            .compute(DEST_A, pick(operand, comp::D_MINUS_A, comp::D_MINUS_M));
        self.code.compute(DEST_M, comp::D_MINUS_A);
    }

    /// Stores the value of an expression.
    pub fn store(&mut self, to: &Expr, value: &Expr) {
        if to == value {
            return;
        }
        let is_near = near_address(to, self.sp).is_some();
        if let Expr::Const(c @ (0 | 1 | u16::MAX)) = value {
            match to {
                _ if is_near => self.code.address(to, self.sp),
                Expr::At(address) => self.load_to(address, DEST_A),
                place => self.load_address(place),
            }
            let what = match c {
                0 => comp::ZERO,
                1 => comp::ONE,
                _ => comp::MINUS_ONE,
            };
            return self.code.compute(DEST_M, what);
        }
        if is_near {
            if !self.in_place(to, value) {
                self.load(value);
                self.d_to(to);
            }
        } else if self.near(value).is_some() {
            self.load_far_address(to);
            self.store_at_d(value);
        } else {
            self.load_far_address(to);
            let aside = self.put_aside();
            self.load(value);
            self.code.address(&aside, self.sp);
            self.code.compute(DEST_A, comp::M);
            self.code.compute(DEST_M, comp::D);
            self.aside -= 1;
        }
    }

    /// Changes a word where it is, if that is what is to be stored there.
    fn in_place(&mut self, to: &Expr, value: &Expr) -> bool {
        const HERE: u16 = DEST_M | DEST_D;
        let what = match value {
            Expr::Neg(x) if **x == *to => comp::NEG_M,
            Expr::Not(x) if **x == *to => comp::NOT_M,
            Expr::Binary(op, x, y) if **x == *to => match (op, is_one(y)) {
                (Binary::Eq | Binary::Gt | Binary::Lt, _) => return false,
                (Binary::Add, Some(1)) => comp::M_PLUS_1,
                (Binary::Add, Some(_)) => comp::M_MINUS_1,
                _ => {
                    self.load(y);
                    arithmetic(*op, Operand::M, true)
                }
            },
            Expr::Binary(op, x, y) if **y == *to => match op {
                Binary::Eq | Binary::Gt | Binary::Lt => return false,
                _ => {
                    self.load(x);
                    arithmetic(*op, Operand::M, false)
                }
            },
            _ => return false,
        };
        self.code.address(to, self.sp);
        self.code.compute(HERE, what);
        true
    }
}

/// The computation of an operation on D and an operand; `turned` says that the
/// operand comes first. Comparisons are none: they subtract.
pub(super) fn arithmetic(op: Binary, operand: Operand, turned: bool) -> u16 {
    match op {
        Binary::Add => pick(operand, comp::D_PLUS_A, comp::D_PLUS_M),
        Binary::And => pick(operand, comp::D_AND_A, comp::D_AND_M),
        Binary::Or => pick(operand, comp::D_OR_A, comp::D_OR_M),
        _ if turned => pick(operand, comp::A_MINUS_D, comp::M_MINUS_D),
        _ => pick(operand, comp::D_MINUS_A, comp::D_MINUS_M),
    }
}
