//! Jumps on conditions.

use super::Compare;
use super::code::Label;
use super::eval::{Eval, arithmetic};
use super::expr::Expr;
use crate::hack::asm::instruction::{DEST_D, JEQ, JGT, JLT, JMP, comp};
use crate::hack::vm::command::Binary;

/// The condition that holds where another does not.
fn inverse(condition: u16) -> u16 {
    JMP & !condition
}

impl Eval<'_> {
    /// Jumps to `target` if an expression is (`sense`) or is not true. What is not
    /// a truth value is true where it is not 0.
    pub fn branch(&mut self, e: &Expr, sense: bool, target: Label) {
        match e {
            Expr::Const(c) => {
                if (*c != 0) == sense {
                    self.code.go(target);
                }
            }
            Expr::Not(x) if x.is_bool() => self.branch(x, !sense, target),
            // !x is 0 where x is -1.
            Expr::Not(x) => {
                let next = Expr::binary(Binary::Add, (**x).clone(), Expr::Const(1));
                self.branch(&next, sense, target);
            }
            Expr::Binary(op @ (Binary::And | Binary::Or), x, y) if e.is_bool() => {
                // The sense in which one operand decides.
                let decides = *op == Binary::Or;
                if sense == decides {
                    self.branch(x, sense, target);
                    self.branch(y, sense, target);
                } else {
                    let skip = self.code.label();
                    self.branch(x, decides, skip);
                    self.branch(y, sense, target);
                    self.code.mark(skip);
                }
            }
            Expr::Binary(op @ (Binary::Eq | Binary::Lt | Binary::Gt), x, y) => {
                let condition = match op {
                    Binary::Eq => JEQ,
                    Binary::Lt => JLT,
                    _ => JGT,
                };
                let condition = if sense { condition } else { inverse(condition) };
                self.compare(x, y, condition, target);
            }
            e => {
                self.load(e);
                self.jump_on_d(if sense { inverse(JEQ) } else { JEQ }, target);
            }
        }
    }

    fn jump_on_d(&mut self, condition: u16, target: Label) {
        self.code.jump(comp::D, condition, target);
    }

    /// Jumps where x and y stand in a relation: the condition that x - y would meet
    /// if it had more bits.
    fn compare(&mut self, x: &Expr, y: &Expr, condition: u16, target: Label) {
        // Next to 0 one can compare with 0.
        let (x, condition) = match (y, condition) {
            (Expr::Const(0), condition) => (x, condition),
            (Expr::Const(1), JLT) => (x, JLT | JEQ),
            (Expr::Const(1), c) if c == inverse(JLT) => (x, JGT),
            (Expr::Const(u16::MAX), JGT) => (x, JGT | JEQ),
            (Expr::Const(u16::MAX), c) if c == inverse(JGT) => (x, JLT),
            _ => return self.compare_words(x, y, condition, target),
        };
        self.load(x);
        self.jump_on_d(condition, target);
    }

    fn compare_words(&mut self, x: &Expr, y: &Expr, condition: u16, target: Label) {
        let ((a, b), (c, d)) = (x.range(), y.range());
        let fits = a - d >= i32::from(i16::MIN) && b - c <= i32::from(i16::MAX);
        let equality = condition == JEQ || condition == inverse(JEQ);
        if fits || equality || self.compare == Compare::Differences {
            self.load(&Expr::binary(Binary::Sub, x.clone(), y.clone()));
            return self.jump_on_d(condition, target);
        }
        // Signs that differ decide.
        let skip = self.code.label();
        match y {
            Expr::Const(c) => self.compare_far_constant(x, *c, condition, target, skip),
            y => self.compare_unknown(x, y, condition, target, skip),
        }
        self.code.mark(skip);
    }

    /// A word against a constant other than 0.
    fn compare_far_constant(&mut self, x: &Expr, c: u16, condition: u16, to: Label, skip: Label) {
        let below = condition & JLT != 0;
        let negative = c.cast_signed() < 0;
        self.load(x);
        // x below 0 <= c, or x not below 0 > c.
        let (apart, holds) = if negative {
            (inverse(JLT), !below)
        } else {
            (JLT, below)
        };
        self.jump_on_d(apart, if holds { to } else { skip });
        if c > 0x8000 {
            self.code.at(c.wrapping_neg());
            self.code.compute(DEST_D, comp::D_PLUS_A);
        } else {
            self.code.operand(&Expr::Const(c), self.sp);
            self.code.compute(DEST_D, comp::D_MINUS_A);
        }
        self.jump_on_d(condition, to);
    }

    /// Two words of which nothing is known.
    fn compare_unknown(&mut self, x: &Expr, y: &Expr, condition: u16, to: Label, skip: Label) {
        let below = condition & JLT != 0;
        let (y, y_aside) = self.kept(y);
        let (x, x_aside) = self.kept(x);
        let (negative, same) = (self.code.label(), self.code.label());
        self.load(&x);
        self.jump_on_d(JLT, negative);
        self.load(&y);
        self.jump_on_d(JLT, if below { skip } else { to });
        self.code.mark(same);
        let first = self.code.operand(&x, self.sp);
        self.code
            .compute(DEST_D, arithmetic(Binary::Sub, first, true));
        self.jump_on_d(condition, to);
        self.code.go(skip);
        self.code.mark(negative);
        self.load(&y);
        self.jump_on_d(inverse(JLT), if below { to } else { skip });
        self.code.go(same);
        self.drop_kept(x_aside);
        self.drop_kept(y_aside);
    }
}
