//! Error diffusion: a dither whose result is the pixel's ink may send a part of
//! its error to later pixels.
//!
//! `spread` stands where it is carried out once for each pixel: in the blocks
//! that a dither ends in, where `draw` ends in that dither, at the pixel's own
//! (x, y). The dither's shade is then its argument and what earlier pixels sent.

use super::value::Val;
use super::{Found, Lower};
use crate::ir::graph::{Axis, Node, NodeId, Share};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use slowlight_routine::Op;

/// The spread that an expression ends with, if any: the first one in the blocks
/// and arms that end it.
fn found(e: &Expr) -> Option<Span> {
    match &e.kind {
        ExprKind::Block { statements, result } => {
            let own = statements.iter().find_map(|s| match s {
                Statement::Spread { span, .. } => Some(*span),
                Statement::Let { .. } => None,
            });
            own.or_else(|| found(result))
        }
        ExprKind::If { yes, no, .. } => found(yes).or_else(|| found(no)),
        _ => None,
    }
}

impl<'a> Lower<'a> {
    /// A call whose result is the pixel's ink.
    pub(super) fn pixel_ink(
        &mut self,
        function: &'a Function,
        mut args: Vec<Val>,
        span: Span,
    ) -> Found<Val> {
        if function.kind != FunctionKind::Dither {
            return self.expand(function, args, span);
        }
        if let Some(spread) = found(&function.body.value) {
            self.check_spread(&args, spread, span)?;
            if let Some(shade) = args.first().cloned() {
                let given = self.node(shade, &Ty::Real, span)?;
                let at = self.at(span);
                let received = self.b.received(at);
                let sum = self.apply(Op::Add, &[given, received], span)?;
                if let Some(first) = args.first_mut() {
                    *first = Val::Node(sum);
                }
            }
        }
        for (arg, param) in args.iter().zip(&function.params) {
            self.name(arg, &param.ty, &param.name);
        }
        self.inside(function.library, span, |l| {
            l.enter(&function.body, args, |l| {
                let value = l.ends(&function.body.value)?;
                l.force(value)
            })
        })
    }

    /// Whether a dither that spreads may be called here and with these arguments.
    fn check_spread(&mut self, args: &[Val], spread: Span, call: Span) -> Found<()> {
        if self.choices > 0 {
            let error = self.error(spread, "`spread` in a dither that only some pixels use");
            let error = error.also(call, "called under a condition here");
            let help = "choose the shade by `if`, and dither it once, at the end of `draw`";
            return Err(Box::new(error.help(help)));
        }
        for (k, axis, name) in [(1, Axis::X, "x"), (2, Axis::Y, "y")] {
            let value = args.get(k).cloned().unwrap_or(Val::Undefined);
            let node = self.node(value, &Ty::Int, call)?;
            if self.b.node(node) != Node::Axis(axis) {
                let message =
                    format!("a dither that spreads its error has the pixel's own `{name}`");
                let error = self.error(call, message).also(spread, "it spreads here");
                return Err(Box::new(
                    error.help("pass the `x` and `y` of `draw` as they are"),
                ));
            }
        }
        Ok(())
    }

    /// A dither's body, through the blocks and calls that it ends in.
    fn ends(&mut self, e: &'a Expr) -> Found<Val> {
        self.step(e.span)?;
        match &e.kind {
            ExprKind::Block { statements, result } => {
                for statement in statements {
                    match statement {
                        Statement::Spread { value, to, span } => self.spread(value, to, *span)?,
                        other => self.statement(other)?,
                    }
                }
                self.ends(result)
            }
            ExprKind::If { condition, yes, no } if found(e).is_some() => {
                let test = self.expr(condition)?;
                let test = self.node(test, &Ty::Bool, condition.span)?;
                match self.b.value(test) {
                    Some(known) => self.ends(if known.truth() { yes } else { no }),
                    None => {
                        let spread = found(e).unwrap_or(e.span);
                        let error = self.error(spread, "`spread` under a condition");
                        let help = "spread where the dither ends: `spread if .. then .. else 0 to { .. };`";
                        Err(Box::new(error.help(help)))
                    }
                }
            }
            ExprKind::Call {
                callee: Callee::Function(id),
                args,
            } => match self.program.functions.get(id.0) {
                Some(function) => {
                    let values = self.arguments(&function.params, args, e.span)?;
                    self.pixel_ink(function, values, e.span)
                }
                None => Err(self.confused(e.span)),
            },
            _ => self.expr(e),
        }
    }

    /// `spread value to { (dx, dy): weight, .. };`
    fn spread(&mut self, value: &'a Expr, to: &'a [(i32, i32, Expr)], span: Span) -> Found<()> {
        let error = self.expr(value)?;
        let error = self.node(error, &Ty::Real, value.span)?;
        let mut shares: Vec<Share> = Vec::new();
        for (dx, dy, weight) in to {
            let by = self.expr(weight)?;
            let by = self.node(by, &Ty::Real, weight.span)?;
            if self.b.value(by).is_none() {
                let error = self.error(weight.span, "a weight must be constant");
                return Err(Box::new(error.help("multiply what is spread instead")));
            }
            let node: NodeId = self.apply(Op::Mul, &[error, by], weight.span)?;
            shares.push(Share {
                dx: *dx,
                dy: *dy,
                node,
            });
        }
        let span = self.at(span);
        self.b.spread(&shares, span);
        Ok(())
    }

    /// A spread that is met elsewhere.
    pub(super) fn misplaced_spread(&self, span: Span) -> Box<Diagnostic> {
        let message = "`spread` stands only where its dither's result is the pixel's ink";
        Box::new(self.error(span, message).help(
            "let `draw` end in the dither's call, and the dither's own block hold the `spread`",
        ))
    }
}
