//! Operators: which operands they take.

use super::{Checker, widen};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree::{self, BinaryOp, UnaryOp};

/// How an operator is written.
pub(crate) fn symbol(op: BinaryOp) -> &'static str {
    match op {
        BinaryOp::Or => "or",
        BinaryOp::And => "and",
        BinaryOp::Eq => "==",
        BinaryOp::Ne => "!=",
        BinaryOp::Lt => "<",
        BinaryOp::Le => "<=",
        BinaryOp::Gt => ">",
        BinaryOp::Ge => ">=",
        BinaryOp::Add => "+",
        BinaryOp::Sub => "-",
        BinaryOp::Mul => "*",
        BinaryOp::Div => "/",
        BinaryOp::Mod => "mod",
        BinaryOp::IntDiv => "div",
        BinaryOp::Pow => "^",
    }
}

impl Checker<'_> {
    pub(super) fn unary(&mut self, op: UnaryOp, of: &tree::Expr, span: Span) -> Expr {
        let value = self.expr(of, false);
        let ty = match (op, &value.ty) {
            (_, Ty::Error) => return Expr::error(span),
            (UnaryOp::Not, Ty::Bool) => Ty::Bool,
            (UnaryOp::Neg, ty @ (Ty::Int | Ty::Real | Ty::Angle | Ty::Vector(_))) => ty.clone(),
            (UnaryOp::Not, other) => {
                let message = format!("`not` wants a bool, not {}", self.a(other));
                let mut error = Diagnostic::error(value.span, message);
                error.help = self.conversion(other, &Ty::Bool);
                self.report(error);
                return Expr::error(span);
            }
            (UnaryOp::Neg, other) => {
                let message = format!("{} has no negative", self.a(other));
                self.error(value.span, message);
                return Expr::error(span);
            }
        };
        let kind = match value.kind {
            ExprKind::Int(i) => ExprKind::Int(i.saturating_neg()),
            ExprKind::Real(r) if op == UnaryOp::Neg => ExprKind::Real(-r),
            _ => ExprKind::Unary(op, Box::new(value)),
        };
        Expr { kind, ty, span }
    }

    pub(super) fn binary(
        &mut self,
        op: BinaryOp,
        left: &tree::Expr,
        right: &tree::Expr,
        span: Span,
    ) -> Expr {
        let a = self.expr(left, false);
        let b = self.expr(right, false);
        if a.ty == Ty::Error || b.ty == Ty::Error {
            return Expr::error(span);
        }
        let found = match op {
            BinaryOp::Or | BinaryOp::And => {
                (a.ty == Ty::Bool && b.ty == Ty::Bool).then_some((Ty::Bool, Ty::Bool, Ty::Bool))
            }
            BinaryOp::Eq | BinaryOp::Ne => comparison(&a.ty, &b.ty, true),
            BinaryOp::Lt | BinaryOp::Le | BinaryOp::Gt | BinaryOp::Ge => {
                comparison(&a.ty, &b.ty, false)
            }
            BinaryOp::Add | BinaryOp::Sub => same(&a.ty, &b.ty).map(|t| (t.clone(), t.clone(), t)),
            BinaryOp::Mul => product(&a.ty, &b.ty),
            BinaryOp::Div => quotient(&a.ty, &b.ty),
            BinaryOp::Mod => number(&a.ty, &b.ty).map(|t| (t.clone(), t.clone(), t)),
            BinaryOp::IntDiv => number(&a.ty, &b.ty).map(|t| (t.clone(), t, Ty::Int)),
            BinaryOp::Pow => power(&a.ty, &b),
        };
        let Some((left, right, ty)) = found else {
            self.no_operator(op, &a, &b, span);
            return Expr::error(span);
        };
        let kind = ExprKind::Binary(op, Box::new(widen(a, &left)), Box::new(widen(b, &right)));
        Expr { kind, ty, span }
    }

    fn no_operator(&mut self, op: BinaryOp, a: &Expr, b: &Expr, span: Span) {
        let symbol = symbol(op);
        let (left, right) = (self.a(&a.ty), self.a(&b.ty));
        let message = match op {
            BinaryOp::And | BinaryOp::Or => {
                format!("`{symbol}` joins bools, not {left} and {right}")
            }
            _ => format!(
                "there is no `{} {symbol} {}`",
                a.ty.show(&self.program),
                b.ty.show(&self.program)
            ),
        };
        let mut error = Diagnostic::error(span, message);
        let either = |f: fn(&Ty) -> bool| f(&a.ty) || f(&b.ty);
        error.help = match op {
            _ if either(|t| matches!(t, Ty::Optional(_))) => {
                Some("take the optional value apart first: `if let v = .. then .. else ..`".into())
            }
            BinaryOp::And | BinaryOp::Or if either(Ty::is_real) => {
                Some("a comparison is a bool: `a != 0`".into())
            }
            BinaryOp::Mul if matches!((&a.ty, &b.ty), (Ty::Vector(_), Ty::Vector(_))) => {
                Some("`dot(a, b)` and `cross(a, b)` multiply vectors".into())
            }
            BinaryOp::Add | BinaryOp::Sub
                if either(|t| matches!(t, Ty::Vector(_))) && either(Ty::is_real) =>
            {
                Some(format!(
                    "add a vector of as many components: `v {symbol} (1, 1, 1)`, or multiply: `v * 2`"
                ))
            }
            _ if either(|t| *t == Ty::Angle) && either(Ty::is_real) => {
                Some("angles carry a unit: `90deg`, `x * 1rad`".into())
            }
            _ if either(|t| *t == Ty::Ink) => {
                Some("compute with ints and make the ink at the end: `ink(i)`".into())
            }
            _ => None,
        };
        self.report(error);
    }
}

type Rule = Option<(Ty, Ty, Ty)>;

/// One number type for both.
fn number(a: &Ty, b: &Ty) -> Option<Ty> {
    (a.is_number() && b.is_number())
        .then(|| a.join(b))
        .flatten()
}

fn same(a: &Ty, b: &Ty) -> Option<Ty> {
    match (a, b) {
        (Ty::Vector(n), Ty::Vector(m)) if n == m => Some(a.clone()),
        _ => number(a, b),
    }
}

fn comparison(a: &Ty, b: &Ty, equality: bool) -> Rule {
    let ty = match (a, b) {
        (Ty::Bool, Ty::Bool) | (Ty::Ink, Ty::Ink) if equality => a.clone(),
        _ => number(a, b)?,
    };
    Some((ty.clone(), ty, Ty::Bool))
}

fn product(a: &Ty, b: &Ty) -> Rule {
    let triple = |a: &Ty, b: &Ty, c: &Ty| Some((a.clone(), b.clone(), c.clone()));
    match (a, b) {
        (Ty::Int, Ty::Int) => triple(a, b, a),
        (Ty::Vector(_) | Ty::Angle, b) if b.is_real() => triple(a, &Ty::Real, a),
        (a, Ty::Vector(_) | Ty::Angle) if a.is_real() => triple(&Ty::Real, b, b),
        (a, b) if a.is_real() && b.is_real() => triple(&Ty::Real, &Ty::Real, &Ty::Real),
        _ => None,
    }
}

fn quotient(a: &Ty, b: &Ty) -> Rule {
    let triple = |a: &Ty, b: &Ty, c: &Ty| Some((a.clone(), b.clone(), c.clone()));
    match (a, b) {
        (Ty::Vector(_) | Ty::Angle, b) if b.is_real() => triple(a, &Ty::Real, a),
        (Ty::Angle, Ty::Angle) => triple(a, b, &Ty::Real),
        (a, b) if a.is_real() && b.is_real() => triple(&Ty::Real, &Ty::Real, &Ty::Real),
        _ => None,
    }
}

/// An int to a whole power that is written out is an int; else real.
fn power(a: &Ty, b: &Expr) -> Rule {
    match (a, &b.ty, &b.kind) {
        (Ty::Int, Ty::Int, ExprKind::Int(n)) if *n >= 0 => Some((Ty::Int, Ty::Int, Ty::Int)),
        (a, Ty::Int, ExprKind::Int(_)) if a.is_real() => Some((Ty::Real, Ty::Int, Ty::Real)),
        (a, b, _) if a.is_real() && b.is_real() => Some((Ty::Real, Ty::Real, Ty::Real)),
        _ => None,
    }
}
