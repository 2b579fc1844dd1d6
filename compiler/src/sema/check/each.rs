//! `each`: what it counts, and `union each k in 0 .. 9 { .. }`.

use super::literal::whole;
use super::{Checker, widen};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree;

/// What the locals of two that are joined are called: nothing that can be written.
const TWO: [&str; 2] = ["each's left", "each's right"];

impl Checker<'_> {
    /// The ends of what is counted, as `check` finds them.
    pub(super) fn bounds<T>(
        &mut self,
        counter: &tree::Counter,
        mut check: impl FnMut(&mut Self, &tree::Expr, &str) -> T,
    ) -> (T, T) {
        if let (Some(low), Some(high)) = (whole(&counter.low), whole(&counter.high))
            && low > high
        {
            let span = counter.low.span.to(counter.high.span);
            let message = format!("`each` counts upwards: from {low} to {high} there is nothing");
            let help = format!("write `{high} .. {low}`");
            self.report(Diagnostic::error(span, message).help(help));
        }
        let what = "a bound of `each`";
        let low = check(self, &counter.low, what);
        (low, check(self, &counter.high, what))
    }

    /// Reports a counter that hides another.
    pub(super) fn hides(&mut self, name: &tree::Name, counters: &[(String, Span)]) {
        if let Some((_, first)) = counters.iter().find(|(outer, _)| *outer == name.text) {
            let message = format!("an `each` around this one counts `{}`, too", name.text);
            let error = Diagnostic::error(name.span, message).also(*first, "here");
            self.report(error.help("choose another name"));
        }
    }

    /// `union each k in 0 .. 9 { .. }`
    pub(super) fn each(&mut self, tree: &tree::Each, span: Span) -> Expr {
        let counter = &tree.counter;
        let (low, high) = self.bounds(counter, |c, bound, what| {
            let value = c.expr(bound, false);
            c.coerce(value, &Ty::Int, what)
        });
        let around = self.cx.counters.clone();
        self.hides(&counter.name, &around);
        let scope = self.cx.scopes.len();
        let local = self.local(&counter.name.text, Ty::Int);
        let place = (counter.name.text.clone(), counter.name.span);
        self.cx.counters.push(place);
        let body = self.expr(&tree.body, false);
        self.cx.counters.pop();
        self.cx.scopes.truncate(scope);
        // What is joined may be wider than what is made: reals of ints.
        let mut ty = body.ty.clone();
        for _ in 0..2 {
            if ty == Ty::Error {
                break;
            }
            let (left, right, join) = self.join(tree, &ty, body.span, span);
            if join.ty == Ty::Error {
                break;
            }
            if join.ty.fits(&ty) {
                let kind = ExprKind::Each(Box::new(Each {
                    counter: local,
                    low,
                    high,
                    body: widen(body, &ty),
                    left,
                    right,
                    join: widen(join, &ty),
                }));
                return Expr { kind, ty, span };
            }
            match ty.join(&join.ty) {
                Some(joined) => ty = joined,
                None => {
                    let name = &tree.name.text;
                    let (made, given) = (self.a(&ty), self.a(&join.ty));
                    let message = format!("`{name}` of {made} and {made} gives {given}");
                    let error = Diagnostic::error(tree.name.span, message);
                    self.report(error.help("`each` joins two of a kind to one of that kind"));
                    break;
                }
            }
        }
        Expr::error(span)
    }

    /// Two of a type, and the call that joins them.
    fn join(
        &mut self,
        tree: &tree::Each,
        ty: &Ty,
        made: Span,
        span: Span,
    ) -> (LocalId, LocalId, Expr) {
        let scope = self.cx.scopes.len();
        let [left, right] = TWO.map(|name| self.local(name, ty.clone()));
        let two = TWO.map(|name| tree::Argument {
            name: None,
            value: tree::Expr {
                kind: tree::ExprKind::Name(name.into()),
                span: made,
            },
        });
        let args: Vec<tree::Argument> = two.into_iter().chain(tree.args.iter().cloned()).collect();
        let said = self.diagnostics.len();
        let join = self.call(&tree.name, None, &args, span);
        let name = &tree.name.text;
        for error in self.diagnostics.iter_mut().skip(said) {
            if error
                .message
                .starts_with(&format!("`{name}` lacks its argument"))
            {
                let help = "what it takes beside the two stands behind its name";
                let counter = &tree.counter.name.text;
                error.help = Some(format!("{help}: `{name}(..) each {counter} in ..`"));
            }
        }
        self.cx.scopes.truncate(scope);
        (left, right, join)
    }
}
