//! Operators over scalars and vectors.

use super::value::Val;
use super::{Found, Lower};
use crate::ir::graph::NodeId;
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use crate::syntax::tree::{BinaryOp, UnaryOp};
use slowlight_routine::{Op, Value};

/// Powers that are multiplied out.
const POWERS: f64 = 64.0;

impl<'a> Lower<'a> {
    pub(super) fn unary(&mut self, op: UnaryOp, of: &'a Expr, span: Span) -> Found<Val> {
        let value = self.expr(of)?;
        match (op, &of.ty) {
            (UnaryOp::Neg, Ty::Vector(n)) => {
                let parts = self.vector(value, *n, span)?.into_iter();
                let parts: Found<Vec<Val>> = parts
                    .map(|p| Ok(Val::Node(self.apply(Op::Neg, &[p], span)?)))
                    .collect();
                Ok(Val::parts(parts?))
            }
            (op, ty) => {
                let node = self.node(value, ty, span)?;
                let op = match (op, ty) {
                    (UnaryOp::Not, _) => Op::Not,
                    (UnaryOp::Neg, Ty::Int) => Op::IntNeg,
                    (UnaryOp::Neg, _) => Op::Neg,
                };
                Ok(Val::Node(self.apply(op, &[node], span)?))
            }
        }
    }

    pub(super) fn binary(
        &mut self,
        op: BinaryOp,
        left: &'a Expr,
        right: &'a Expr,
        span: Span,
    ) -> Found<Val> {
        let a = self.expr(left)?;
        if let BinaryOp::And | BinaryOp::Or = op {
            let a = self.node(a, &Ty::Bool, span)?;
            let short = op == BinaryOp::Or;
            if let Some(known) = self.b.value(a)
                && known.truth() == short
            {
                return Ok(Val::Node(a));
            }
            let b = self.expr(right)?;
            let b = self.node(b, &Ty::Bool, span)?;
            let known = self.bool(short, span);
            let (yes, no) = if short { (known, b) } else { (b, known) };
            return Ok(Val::Node(self.select(a, yes, no, span)));
        }
        let b = self.expr(right)?;
        match (&left.ty, &right.ty) {
            (Ty::Vector(n), Ty::Vector(_)) => {
                let (a, b) = (self.vector(a, *n, span)?, self.vector(b, *n, span)?);
                self.each(op, a.into_iter().zip(b), span)
            }
            (Ty::Vector(n), other) => {
                let b = self.node(b, other, span)?;
                let a = self.vector(a, *n, span)?;
                self.each(op, a.into_iter().map(|a| (a, b)), span)
            }
            (other, Ty::Vector(n)) => {
                let a = self.node(a, other, span)?;
                let b = self.vector(b, *n, span)?;
                self.each(op, b.into_iter().map(|b| (a, b)), span)
            }
            (ta, tb) => {
                let (a, b) = (self.node(a, ta, span)?, self.node(b, tb, span)?);
                Ok(Val::Node(match op {
                    BinaryOp::Pow => self.power(ta, a, tb, b, span)?,
                    op => self.scalar(op, ta, a, b, span)?,
                }))
            }
        }
    }

    fn each(
        &mut self,
        op: BinaryOp,
        pairs: impl Iterator<Item = (NodeId, NodeId)>,
        span: Span,
    ) -> Found<Val> {
        let parts: Found<Vec<Val>> = pairs
            .map(|(a, b)| Ok(Val::Node(self.scalar(op, &Ty::Real, a, b, span)?)))
            .collect();
        Ok(Val::parts(parts?))
    }

    /// An operation; a constant outside its domain is an error.
    pub(super) fn apply(&mut self, op: Op, args: &[NodeId], span: Span) -> Found<NodeId> {
        self.step(span)?;
        let values: Vec<Option<Value>> = args.iter().map(|&a| self.b.value(a)).collect();
        let first = values.first().copied().flatten().map(Value::real);
        let last = values.last().copied().flatten().map(Value::real);
        let wrong = match op {
            Op::Div | Op::Mod | Op::IntDiv | Op::IntMod => {
                (last == Some(0.0)).then_some("this divides by zero")
            }
            Op::Sqrt => first
                .filter(|&a| a < 0.0)
                .map(|_| "this is the square root of a negative"),
            Op::Log => first
                .filter(|&a| a <= 0.0)
                .map(|_| "this is the logarithm of 0 or less"),
            Op::Asin | Op::Acos => {
                (first.filter(|&a| a.abs() > 1.0)).map(|_| "no angle has this sine or cosine")
            }
            Op::Pow => match (first, last) {
                (Some(a), Some(b)) if a < 0.0 && b.fract() != 0.0 => {
                    Some("this is a negative to a power that is not whole")
                }
                (Some(0.0), Some(b)) if b < 0.0 => Some("this divides by zero"),
                _ => None,
            },
            _ => None,
        };
        if let Some(wrong) = wrong {
            return Err(Box::new(self.error(span, wrong).help(op_domain(op))));
        }
        let span = self.at(span);
        Ok(self.b.apply(op, args, span))
    }

    /// An operator on two scalars of one type.
    pub(super) fn scalar(
        &mut self,
        op: BinaryOp,
        ty: &Ty,
        a: NodeId,
        b: NodeId,
        span: Span,
    ) -> Found<NodeId> {
        let int = matches!(ty, Ty::Int | Ty::Ink);
        let pick = |i: Op, r: Op| if int { i } else { r };
        let less = pick(Op::IntLess, Op::Less);
        let at_most = pick(Op::IntLessEqual, Op::LessEqual);
        match op {
            BinaryOp::Add => self.apply(pick(Op::IntAdd, Op::Add), &[a, b], span),
            BinaryOp::Sub => self.apply(pick(Op::IntSub, Op::Sub), &[a, b], span),
            BinaryOp::Mul => self.apply(pick(Op::IntMul, Op::Mul), &[a, b], span),
            BinaryOp::Div => self.apply(Op::Div, &[a, b], span),
            BinaryOp::Mod => self.apply(pick(Op::IntMod, Op::Mod), &[a, b], span),
            BinaryOp::IntDiv if int => self.apply(Op::IntDiv, &[a, b], span),
            BinaryOp::IntDiv => {
                let quotient = self.apply(Op::Div, &[a, b], span)?;
                self.apply(Op::Floor, &[quotient], span)
            }
            BinaryOp::Lt => self.apply(less, &[a, b], span),
            BinaryOp::Gt => self.apply(less, &[b, a], span),
            BinaryOp::Le => self.apply(at_most, &[a, b], span),
            BinaryOp::Ge => self.apply(at_most, &[b, a], span),
            BinaryOp::Eq if *ty == Ty::Bool => {
                let not = self.apply(Op::Not, &[b], span)?;
                Ok(self.select(a, b, not, span))
            }
            BinaryOp::Eq => self.apply(pick(Op::IntEqual, Op::Equal), &[a, b], span),
            BinaryOp::Ne => {
                let equal = self.scalar(BinaryOp::Eq, ty, a, b, span)?;
                self.apply(Op::Not, &[equal], span)
            }
            BinaryOp::And | BinaryOp::Or | BinaryOp::Pow => Err(self.confused(span)),
        }
    }

    /// A power: whole ones are multiplied out, by squares.
    fn power(&mut self, ta: &Ty, a: NodeId, tb: &Ty, b: NodeId, span: Span) -> Found<NodeId> {
        let known = self.b.value(b).map(|v| v.real());
        let int = *ta == Ty::Int && *tb == Ty::Int;
        let whole = known.filter(|n| n.fract() == 0.0 && (int || n.abs() <= POWERS));
        let Some(n) = whole else {
            let b = match tb {
                Ty::Int => self.apply(Op::ToReal, &[b], span)?,
                _ => b,
            };
            return self.apply(Op::Pow, &[a, b], span);
        };
        let (mul, one) = match int {
            true => (Op::IntMul, self.int(1, span)),
            false => (Op::Mul, self.real(1.0, span)),
        };
        let mut rest = n.abs() as u32;
        let mut square = a;
        let mut product: Option<NodeId> = None;
        while rest > 0 {
            if rest & 1 == 1 {
                product = Some(match product {
                    Some(p) => self.apply(mul, &[p, square], span)?,
                    None => square,
                });
            }
            rest >>= 1;
            if rest > 0 {
                square = self.apply(mul, &[square, square], span)?;
            }
        }
        let product = product.unwrap_or(one);
        if n < 0.0 {
            return self.apply(Op::Div, &[one, product], span);
        }
        Ok(product)
    }
}

/// The way out where an operation's arguments are outside its domain.
pub(super) fn op_domain(op: Op) -> &'static str {
    match op {
        Op::Sqrt => "bound it: `sqrt(max(v, 0))`",
        Op::Log => "bound it: `log(max(v, least))` with a `least` above 0",
        Op::Asin | Op::Acos => "bound it: `clamp(v, -1, 1)`",
        Op::Pow => "bound the base: `max(v, least) ^ p`",
        _ => "divide by something else, or say what stands there: `if d == 0 then .. else n / d`",
    }
}
