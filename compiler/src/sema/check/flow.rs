//! Conditions, loops and blocks.

use super::call::count;
use super::literal::whole;
use super::{Checker, LOOPS, OpenLoop, widen};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree;

impl Checker<'_> {
    pub(super) fn condition(
        &mut self,
        binding: Option<&tree::Name>,
        condition: &tree::Expr,
        yes: &tree::Expr,
        no: &tree::Expr,
        tail: bool,
        span: Span,
    ) -> Expr {
        let test = self.expr(condition, false);
        let scope = self.cx.scopes.len();
        let (test, local) = match binding {
            None => (self.coerce(test, &Ty::Bool, "a condition"), None),
            Some(name) => {
                let inner = match &test.ty {
                    Ty::Optional(inner) => (**inner).clone(),
                    Ty::Error => Ty::Error,
                    other => {
                        let message = format!(
                            "`if let` takes an optional value apart, not {}",
                            self.a(other)
                        );
                        self.error(test.span, message);
                        Ty::Error
                    }
                };
                let inner = if inner == Ty::Never { Ty::Error } else { inner };
                (test, Some(self.local(&name.text, inner)))
            }
        };
        let yes = self.expr(yes, tail);
        self.cx.scopes.truncate(scope);
        let no = self.expr(no, tail);
        let Some(ty) = yes.ty.join(&no.ty) else {
            let message = format!(
                "`then` gives {}, `else` gives {}",
                self.a(&yes.ty),
                self.a(&no.ty)
            );
            let error = Diagnostic::error(no.span, message);
            self.report(error.also(yes.span, format!("this is {}", self.a(&yes.ty))));
            return Expr::error(span);
        };
        let condition = Box::new(test);
        let yes = Box::new(widen(yes, &ty));
        let no = Box::new(widen(no, &ty));
        let kind = match local {
            Some(local) => ExprKind::IfLet {
                local,
                condition,
                yes,
                no,
            },
            None => ExprKind::If { condition, yes, no },
        };
        Expr { kind, ty, span }
    }

    pub(super) fn block(
        &mut self,
        statements: &[tree::Statement],
        result: &tree::Expr,
        tail: bool,
        span: Span,
    ) -> Expr {
        let scope = self.cx.scopes.len();
        let mut found = Vec::new();
        for statement in statements {
            match statement {
                tree::Statement::Let { claim, name, value } => {
                    let value = self.expr(value, false);
                    let ty = match &value.ty {
                        Ty::Optional(inner) if **inner == Ty::Never => {
                            let error = Diagnostic::error(value.span, "`none` alone has no type");
                            self.report(
                                error.help("let it stand beside a value: `if c then v else none`"),
                            );
                            Ty::Error
                        }
                        other => other.clone(),
                    };
                    let local = self.local(&name.text, ty);
                    found.push(Statement::Let {
                        claim: *claim,
                        local,
                        value,
                    });
                }
                tree::Statement::Spread { value, to, span } => {
                    self.spread(value, to, *span, &mut found)
                }
            }
        }
        let result = Box::new(self.expr(result, tail));
        self.cx.scopes.truncate(scope);
        let ty = result.ty.clone();
        let kind = ExprKind::Block {
            statements: found,
            result,
        };
        Expr { kind, ty, span }
    }

    /// `spread e to { (1, 0): 7/16, .. };`: to pixels that the scan has yet to
    /// reach, left to right and top to bottom.
    fn spread(
        &mut self,
        value: &tree::Expr,
        to: &[(tree::Expr, tree::Expr)],
        span: Span,
        found: &mut Vec<Statement>,
    ) {
        if !self.cx.dither {
            let error = Diagnostic::error(span, "`spread` stands only in a dither");
            self.report(
                error.help("move it into `dither name(v: real, x: int, y: int) -> ink = { .. };`"),
            );
        }
        let value = self.expr(value, false);
        let value = self.coerce(value, &Ty::Real, "what is spread");
        let mut shares = Vec::new();
        for (offset, weight) in to {
            let weight = self.expr(weight, false);
            let weight = self.coerce(weight, &Ty::Real, "a weight");
            let tree::ExprKind::Tuple(parts) = &offset.kind else {
                self.error(offset.span, "an offset is two whole numbers, `(1, 0)`");
                continue;
            };
            let numbers: Option<Vec<f64>> = parts.iter().map(whole).collect();
            match numbers.as_deref() {
                Some(&[dx, dy])
                    if dx.abs() <= 8.0 && (0.0..=8.0).contains(&dy) && (dy > 0.0 || dx > 0.0) =>
                {
                    shares.push((dx as i32, dy as i32, weight));
                }
                Some(&[dx, dy]) if dy < 0.0 || (dy == 0.0 && dx <= 0.0) => {
                    let message = format!("`spread` to ({dx}, {dy}): that pixel is already drawn");
                    let error = Diagnostic::error(offset.span, message);
                    self.report(error.help("the scan runs left to right and top to bottom"));
                }
                Some([_, _]) => self.error(offset.span, "an offset reaches at most 8 pixels"),
                _ => self.error(offset.span, "an offset is two whole numbers, `(1, 0)`"),
            }
        }
        found.push(Statement::Spread {
            value,
            to: shares,
            span,
        });
    }

    pub(super) fn next(&mut self, values: &[tree::Expr], tail: bool, span: Span) -> Expr {
        let mut found: Vec<Expr> = values.iter().map(|v| self.expr(v, false)).collect();
        let make = |values| Expr {
            kind: ExprKind::Next(values),
            ty: Ty::Never,
            span,
        };
        if !tail || self.cx.loops.is_empty() {
            let error = match self.cx.loops.is_empty() {
                true => Diagnostic::error(span, "`next` stands outside a loop")
                    .help("its place is in a loop's braces: `loop (i = 0) max 9 { .. next(i + 1) .. } else i`"),
                false => Diagnostic::error(span, "`next` is not the last thing that its loop's body does")
                    .help("its place is where the body ends: after `then`, `else`, or at the end of a block"),
            };
            self.report(error);
            return Expr::error(span);
        }
        let at = self.cx.loops.len() - 1;
        let wanted = self.cx.loops[at].types.len();
        if wanted != found.len() {
            let message = format!(
                "this `loop` carries {}, `next` gives {}",
                count(wanted, "value"),
                found.len()
            );
            self.error(span, message);
            return Expr::error(span);
        }
        for (k, value) in found.iter_mut().enumerate() {
            let ty = self.cx.loops[at].joined[k].clone();
            match ty.join(&value.ty) {
                Some(joined) => {
                    if value.ty.fits(&self.cx.loops[at].types[k]) {
                        let want = self.cx.loops[at].types[k].clone();
                        *value = widen(value.clone(), &want);
                    }
                    self.cx.loops[at].joined[k] = joined;
                }
                None => {
                    let name = self.cx.loops[at].names[k].clone();
                    let message = format!(
                        "`{name}` is {}, `next` gives {}",
                        self.a(&ty),
                        self.a(&value.ty)
                    );
                    self.error(value.span, message);
                    *value = Expr::error(value.span);
                }
            }
        }
        make(found)
    }

    pub(super) fn loop_(
        &mut self,
        carried: &[(tree::Name, tree::Expr)],
        max: &tree::Expr,
        body: &tree::Expr,
        otherwise: &tree::Expr,
        span: Span,
    ) -> Expr {
        if self.cx.nest >= LOOPS {
            self.error(span, format!("loops nest at most {LOOPS} deep"));
            return Expr::error(span);
        }
        self.cx.nest += 1;
        let found = self.loop_inside(carried, max, body, otherwise, span);
        self.cx.nest -= 1;
        found
    }

    fn loop_inside(
        &mut self,
        carried: &[(tree::Name, tree::Expr)],
        max: &tree::Expr,
        body: &tree::Expr,
        otherwise: &tree::Expr,
        span: Span,
    ) -> Expr {
        let mut inits = Vec::new();
        let mut types = Vec::new();
        for (k, (name, tree)) in carried.iter().enumerate() {
            if let Some((first, _)) = carried[..k]
                .iter()
                .take(64)
                .find(|(n, _)| n.text == name.text)
            {
                let message = format!("two carried values are called `{}`", name.text);
                let error = Diagnostic::error(name.span, message);
                self.report(error.also(first.span, "the first is here"));
            }
            let init = self.expr(tree, false);
            let ty = match init.ty.is_data() {
                true => init.ty.clone(),
                false => {
                    let message = format!("a loop cannot carry {}", self.a(&init.ty));
                    let error = Diagnostic::error(init.span, message);
                    self.report(
                        error.help("carry the numbers that it is made of, and make it in the loop"),
                    );
                    Ty::Error
                }
            };
            types.push(ty);
            inits.push(init);
        }
        let max = self.expr(max, false);
        let max = self.coerce(max, &Ty::Int, "a loop's `max`");
        let mark = (
            self.diagnostics.len(),
            self.cx.locals.len(),
            self.mentions.len(),
        );
        let scope = self.cx.scopes.len();
        let mut locals = Vec::new();
        let mut value = Expr::error(span);
        // Each round but the last widens a type, and a type widens twice at most.
        for _ in 0..2 * carried.len() + 1 {
            self.diagnostics.truncate(mark.0);
            self.cx.locals.truncate(mark.1);
            self.mentions.truncate(mark.2);
            self.cx.scopes.truncate(scope);
            locals = carried
                .iter()
                .zip(&types)
                .map(|((name, _), ty)| self.local(&name.text, ty.clone()))
                .collect();
            self.cx.loops.push(OpenLoop {
                names: carried.iter().map(|(n, _)| n.text.clone()).collect(),
                types: types.clone(),
                joined: types.clone(),
            });
            value = self.expr(body, true);
            let joined = self.cx.loops.pop().map_or(Vec::new(), |l| l.joined);
            // What is wrong in one round would not be said of a value that is wrong itself.
            let right = |(now, before): (Ty, &Ty)| match now {
                Ty::Error => before.clone(),
                _ => now,
            };
            let joined: Vec<Ty> = joined.into_iter().zip(&types).map(right).collect();
            if joined == types {
                break;
            }
            types = joined;
        }
        let outer = std::mem::take(&mut self.cx.loops);
        let otherwise = self.expr(otherwise, false);
        self.cx.loops = outer;
        self.cx.scopes.truncate(scope);
        let Some(ty) = value.ty.join(&otherwise.ty) else {
            let message = format!(
                "the loop gives {}, its `else` {}",
                self.a(&value.ty),
                self.a(&otherwise.ty)
            );
            let error = Diagnostic::error(otherwise.span, message);
            self.report(error.also(value.span, format!("this is {}", self.a(&value.ty))));
            return Expr::error(span);
        };
        if !ty.is_data() {
            let message = format!("a loop cannot give {}", self.a(&ty));
            self.error(span, message);
            return Expr::error(span);
        }
        let inits = inits.into_iter().zip(&types);
        let inits = inits.map(|(init, ty)| match init.ty.fits(ty) {
            true => widen(init, ty),
            false => Expr::error(init.span),
        });
        let kind = ExprKind::Loop {
            carried: locals.into_iter().zip(inits).collect(),
            max: Box::new(max),
            body: Box::new(widen(value, &ty)),
            otherwise: Box::new(widen(otherwise, &ty)),
        };
        Expr { kind, ty, span }
    }
}
