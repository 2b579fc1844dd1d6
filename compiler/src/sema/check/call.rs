//! Calls: which function, and which argument is which.

use super::names::Entity;
use super::{Checker, widen};
use crate::sema::builtins::Builtin;
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree;

/// A parameter as a call sees it: its name, type, and whether it may be left out.
struct Slot {
    name: String,
    ty: Ty,
    optional: bool,
}

/// An argument: its name, if it is named, and its value.
struct Given {
    name: Option<tree::Name>,
    value: Expr,
}

/// What a call may mean.
struct Fitting {
    /// Whether the first argument has exactly its type.
    exact: bool,
    entity: Entity,
    slots: Vec<Slot>,
    /// The argument of each slot.
    places: Vec<Option<usize>>,
}

/// Why a call does not fit.
struct Misfit {
    diagnostic: Diagnostic,
    /// The more arguments fitted before, the more likely it was meant.
    fitted: usize,
}

impl Checker<'_> {
    pub(super) fn call(
        &mut self,
        name: &tree::Name,
        receiver: Option<&tree::Expr>,
        args: &[tree::Argument],
        span: Span,
    ) -> Expr {
        let mut given = Vec::new();
        if let Some(receiver) = receiver {
            let value = self.expr(receiver, false);
            given.push(Given { name: None, value });
        }
        for argument in args {
            let value = self.expr(&argument.value, false);
            let name = argument.name.clone();
            given.push(Given { name, value });
        }
        if receiver.is_none()
            && let Some(id) = self.find_local(&name.text)
            && let Ty::Function(..) = self.cx.locals[id.0].ty
        {
            return self.call_local(id, name, given, span);
        }
        let entities = self.entities(&name.text);
        let candidates: Vec<Entity> = entities.into_iter().filter(|e| e.callable()).collect();
        if candidates.is_empty() {
            self.unknown_call(&name.text, name.span);
            return Expr::error(span);
        }
        self.choose(name, &candidates, given, span)
    }

    /// The first candidate whose first argument has exactly its type, else the
    /// first that fits, else the error of the one that comes nearest.
    fn choose(
        &mut self,
        name: &tree::Name,
        candidates: &[Entity],
        given: Vec<Given>,
        span: Span,
    ) -> Expr {
        let mut fitting: Option<Fitting> = None;
        let mut misfit: Option<Misfit> = None;
        for &candidate in candidates {
            let slots = self.slots(candidate);
            match self.fit(name, &slots, &given, span) {
                Ok(places) => {
                    let first = places.first().copied().flatten().and_then(|k| given.get(k));
                    let exact = match (first, slots.first()) {
                        (Some(first), Some(slot)) => first.value.ty == slot.ty,
                        _ => true,
                    };
                    if fitting.as_ref().is_none_or(|f| exact && !f.exact) {
                        fitting = Some(Fitting {
                            exact,
                            entity: candidate,
                            slots,
                            places,
                        });
                    }
                }
                Err(found) => {
                    if misfit.as_ref().is_none_or(|m| found.fitted > m.fitted) {
                        misfit = Some(found);
                    }
                }
            }
        }
        let Some(Fitting {
            entity,
            slots,
            places,
            ..
        }) = fitting
        else {
            let known = given.iter().all(|g| g.value.ty != Ty::Error);
            if let Some(misfit) = misfit
                && known
            {
                let several = self.first_wrong(name, candidates, &given);
                self.report(match several {
                    Some(error) if misfit.fitted == 0 => error,
                    _ => misfit.diagnostic,
                });
            }
            return Expr::error(span);
        };
        self.mention(entity, name.span);
        let mut values: Vec<Option<Expr>> = given.into_iter().map(|g| Some(g.value)).collect();
        let args: Vec<Option<Expr>> = places
            .iter()
            .zip(&slots)
            .map(|(place, slot)| {
                let value = place.and_then(|k| values.get_mut(k)?.take());
                value.map(|v| widen(v, &slot.ty))
            })
            .collect();
        self.finish_call(entity, args, span)
    }

    /// Where a name has several meanings and the first argument fits none.
    fn first_wrong(
        &self,
        name: &tree::Name,
        candidates: &[Entity],
        given: &[Given],
    ) -> Option<Diagnostic> {
        let first = given.first().filter(|g| g.name.is_none())?;
        let mut types: Vec<Ty> = Vec::new();
        for &candidate in candidates {
            let ty = self.slots(candidate).first()?.ty.clone();
            if first.value.ty.fits(&ty) {
                return None;
            }
            if !types.contains(&ty) {
                types.push(ty);
            }
        }
        if types.len() < 2 {
            return None;
        }
        let shown: Vec<String> = types.iter().take(6).map(|t| self.a(t)).collect();
        let message = format!(
            "`{}` begins with {}; this is {}",
            name.text,
            shown.join(" or "),
            self.a(&first.value.ty)
        );
        let mut error = Diagnostic::error(first.value.span, message);
        error.help = (types.last()).and_then(|to| self.conversion(&first.value.ty, to));
        Some(error)
    }

    /// Whether `base.name(..)` might be meant.
    pub(super) fn is_method(&self, name: &str, base: &Ty) -> bool {
        let entities = self.entities(name).into_iter();
        let mut callable = entities.filter(|e| e.callable());
        callable.any(|e| self.slots(e).first().is_some_and(|s| base.fits(&s.ty)))
    }

    fn slots(&self, entity: Entity) -> Vec<Slot> {
        match entity {
            Entity::Builtin(k) => {
                let params = self.signatures.get(k).map_or(&[][..], |s| &s.params);
                let slot = |p: &crate::sema::builtins::Param| Slot {
                    name: p.0.to_owned(),
                    ty: p.1.clone(),
                    optional: p.2,
                };
                params.iter().map(slot).collect()
            }
            other => self
                .params_of(other)
                .iter()
                .map(|p| Slot {
                    name: p.name.clone(),
                    ty: p.ty.clone(),

                    optional: p.optional,
                })
                .collect(),
        }
    }

    fn finish_call(&mut self, entity: Entity, args: Vec<Option<Expr>>, span: Span) -> Expr {
        let (callee, ty) = match entity {
            Entity::Function(id) => {
                let result = self.program.functions[id.0].result.clone();
                (Callee::Function(id), result)
            }
            Entity::Shape(id) => (Callee::Shape(id), Ty::Shape),
            Entity::Record(id) => (Callee::Record(id), Ty::Record(id)),
            Entity::Builtin(k) => {
                let Some(signature) = self.signatures.get(k) else {
                    return Expr::error(span);
                };
                let tag = match args.first() {
                    Some(Some(Expr {
                        kind,
                        ty: Ty::Scene(tag),
                        ..
                    })) => match kind {
                        ExprKind::Convert(inner) => match &inner.ty {
                            Ty::Scene(tag) => tag.clone(),
                            _ => None,
                        },
                        _ => tag.clone(),
                    },
                    _ => None,
                };
                let builtin = signature.builtin;
                let ty = match builtin {
                    Builtin::Trace | Builtin::March => Ty::Hit(tag).optional(),
                    Builtin::SceneTag => match tag {
                        Some(tag) => *tag,
                        None => {
                            let error = Diagnostic::error(span, "this scene has no known tags");
                            self.report(
                                error.help("name the scene here, and give its shapes tags"),
                            );
                            Ty::Error
                        }
                    },
                    _ => signature.result.clone(),
                };
                (Callee::Builtin(builtin), ty)
            }
            _ => return Expr::error(span),
        };
        let kind = ExprKind::Call { callee, args };
        Expr { kind, ty, span }
    }

    fn call_local(
        &mut self,
        id: LocalId,
        name: &tree::Name,
        given: Vec<Given>,
        span: Span,
    ) -> Expr {
        let Ty::Function(params, result) = self.cx.locals[id.0].ty.clone() else {
            return Expr::error(span);
        };
        let slots: Vec<Slot> = params
            .into_iter()
            .map(|ty| Slot {
                name: String::new(),
                ty,
                optional: false,
            })
            .collect();
        if let Err(misfit) = self.fit(name, &slots, &given, span) {
            self.report(misfit.diagnostic);
            return Expr::error(span);
        }
        let args = given.into_iter().zip(&slots);
        let args = args
            .map(|(g, slot)| Some(widen(g.value, &slot.ty)))
            .collect();
        let callee = Callee::Local(id);
        Expr {
            kind: ExprKind::Call { callee, args },
            ty: *result,
            span,
        }
    }

    /// Which argument goes to which parameter.
    // A diagnostic is large; it is made once, where the scene is wrong.
    #[allow(clippy::result_large_err)]
    fn fit(
        &self,
        name: &tree::Name,
        slots: &[Slot],
        given: &[Given],
        span: Span,
    ) -> Result<Vec<Option<usize>>, Misfit> {
        let callee = &name.text;
        let mut places: Vec<Option<usize>> = vec![None; slots.len()];
        let mut fitted = 0;
        let mut named = false;
        for (k, argument) in given.iter().enumerate() {
            let misfit = |diagnostic| Misfit { diagnostic, fitted };
            let slot = match &argument.name {
                None if named => {
                    let message = "this argument has no name, but stands after one that has";
                    return Err(misfit(Diagnostic::error(argument.value.span, message)));
                }
                None if k < slots.len() => k,
                None => {
                    let message = format!(
                        "`{callee}` takes {}, here are {}",
                        count(slots.len(), "argument"),
                        given.len()
                    );
                    let error = Diagnostic::error(argument.value.span, message);
                    return Err(misfit(error.help(form(callee, slots))));
                }
                Some(label) => {
                    named = true;
                    let Some(at) = slots.iter().position(|s| s.name == label.text) else {
                        let message = format!("`{callee}` has no argument `{}`", label.text);
                        let mut error = Diagnostic::error(label.span, message);
                        let names = slots.iter().map(|s| s.name.as_str());
                        error.help = self
                            .among(&label.text, names)
                            .or_else(|| Some(form(callee, slots)));
                        return Err(misfit(error));
                    };
                    at
                }
            };
            if places[slot].is_some() {
                let message = format!("`{}` is given twice", slots[slot].name);
                return Err(misfit(Diagnostic::error(argument.value.span, message)));
            }
            let (have, want) = (&argument.value.ty, &slots[slot].ty);
            if !have.fits(want) {
                let which = match slots[slot].name.as_str() {
                    "" => format!("argument {} of `{callee}`", slot + 1),
                    "self" => format!("what `{callee}` is called on"),
                    label => format!("`{label}` of `{callee}`"),
                };
                let message = format!("{which} is {}; this is {}", self.a(want), self.a(have));
                let mut error = Diagnostic::error(argument.value.span, message);
                error.help = self.conversion(have, want);
                return Err(misfit(error));
            }
            places[slot] = Some(k);
            fitted += 1;
        }
        for (slot, place) in slots.iter().zip(&places) {
            if place.is_none() && !slot.optional {
                let message = match slot.name.as_str() {
                    "" => format!(
                        "`{callee}` takes {}, here are {}",
                        count(slots.len(), "argument"),
                        given.len()
                    ),
                    label => format!("`{callee}` lacks its argument `{label}`"),
                };
                let diagnostic = Diagnostic::error(span, message).help(form(callee, slots));
                return Err(Misfit { diagnostic, fitted });
            }
        }
        Ok(places)
    }
}

/// `1 argument`, `2 arguments`.
pub(super) fn count(n: usize, what: &str) -> String {
    match n {
        1 => format!("1 {what}"),
        n => format!("{n} {what}s"),
    }
}

/// `1 entry`, `2 entries`.
pub(super) fn entries(n: usize) -> String {
    match n {
        1 => "1 entry".into(),
        n => format!("{n} entries"),
    }
}

/// How a call is written.
fn form(callee: &str, slots: &[Slot]) -> String {
    let names: Vec<&str> = slots
        .iter()
        .map(|s| s.name.as_str())
        .filter(|n| !n.is_empty())
        .collect();
    match names.split_first() {
        Some((&"self", rest)) => format!("write `a.{callee}({})`", rest.join(", ")),
        _ if names.is_empty() => format!("write `{callee}(..)`"),
        _ => format!("write `{callee}({})`", names.join(", ")),
    }
}
