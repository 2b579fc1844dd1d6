//! Choices between values, and widenings of them, scalar by scalar.

use super::value::{Table, Val, WAITING};
use super::{Found, Lower};
use crate::ir::graph::NodeId;
use crate::sema::ty::Ty;
use crate::source::Span;
use slowlight_routine::{Op, Value};
use std::rc::Rc;

impl Lower<'_> {
    /// `yes` where `condition` holds, else `no`.
    pub(super) fn merge(&mut self, condition: NodeId, yes: Val, no: Val, span: Span) -> Found<Val> {
        self.step(span)?;
        if let Some(known) = self.b.value(condition) {
            return Ok(if known.truth() { yes } else { no });
        }
        Ok(match (yes, no) {
            (Val::Undefined, other) | (other, Val::Undefined) => other,
            (Val::Lazy(a), Val::Lazy(b)) if Rc::ptr_eq(&a, &b) => Val::Lazy(a),
            (yes @ Val::Lazy(_), no) | (yes, no @ Val::Lazy(_)) => {
                let depth = yes.depth().max(no.depth());
                if depth > WAITING {
                    let (yes, no) = (self.force(yes)?, self.force(no)?);
                    return self.merge(condition, yes, no, span);
                }
                let work = Box::new(move |l: &mut Lower<'_>| {
                    let (yes, no) = (l.force(yes)?, l.force(no)?);
                    l.merge(condition, yes, no, span)
                });
                Val::waiting(depth, work)
            }
            (Val::Node(a), Val::Node(b)) => Val::Node(self.select(condition, a, b, span)),
            (Val::Parts(a), Val::Parts(b)) => {
                let pairs = a.iter().cloned().zip(b.iter().cloned());
                let merged: Found<Vec<Val>> = pairs
                    .map(|(a, b)| self.merge(condition, a, b, span))
                    .collect();
                Val::parts(merged?)
            }
            (
                Val::Optional {
                    present: p,
                    value: a,
                },
                Val::Optional {
                    present: q,
                    value: b,
                },
            ) => Val::Optional {
                present: self.select(condition, p, q, span),
                value: Rc::new(self.merge(condition, (*a).clone(), (*b).clone(), span)?),
            },
            (Val::Table(a), Val::Table(b)) if Rc::ptr_eq(&a, &b) => Val::Table(a),
            (Val::Shape(a), Val::Shape(b)) if Rc::ptr_eq(&a, &b) => Val::Shape(a),
            (Val::Map(a), Val::Map(b)) if a == b => Val::Map(a),
            (Val::Rows(a), Val::Rows(b)) if Rc::ptr_eq(&a, &b) => Val::Rows(a),
            (Val::Scene(a), Val::Scene(b)) if a == b => Val::Scene(a),
            (Val::Function(a), Val::Function(b)) if a == b => Val::Function(a),
            _ => {
                let error = self.error(
                    span,
                    "which table, shape or function this is must be known when compiling",
                );
                return Err(Box::new(error.help("choose between their results instead")));
            }
        })
    }

    /// A choice between scalars. `c ? true : false` is `c`.
    pub(super) fn select(
        &mut self,
        condition: NodeId,
        yes: NodeId,
        no: NodeId,
        span: Span,
    ) -> NodeId {
        let span = self.at(span);
        match (self.b.value(yes), self.b.value(no)) {
            (Some(Value::Bool(true)), Some(Value::Bool(false))) => condition,
            (Some(Value::Bool(false)), Some(Value::Bool(true))) => {
                self.b.apply(Op::Not, &[condition], span)
            }
            _ => self.b.select(condition, yes, no, span),
        }
    }

    /// The widening of a value from one type to another.
    pub(super) fn convert(&mut self, value: Val, from: &Ty, to: &Ty, span: Span) -> Found<Val> {
        if from == to {
            return Ok(value);
        }
        let yes = Value::Bool(true);
        Ok(match (from, to) {
            (Ty::Int, Ty::Real) => {
                let node = self.node(value, from, span)?;
                Val::Node(self.apply(Op::ToReal, &[node], span)?)
            }
            (Ty::Optional(a), Ty::Optional(b)) => match self.force(value)? {
                Val::Optional { present, value } => Val::Optional {
                    present,
                    value: Rc::new(match **a == Ty::Never {
                        true => Val::Undefined,
                        false => self.convert((*value).clone(), a, b, span)?,
                    }),
                },
                other => other,
            },
            (_, Ty::Optional(inner)) => Val::Optional {
                present: self.b.constant(yes, self.at(span)),
                value: Rc::new(self.convert(value, from, inner, span)?),
            },
            (Ty::Table(a), Ty::Table(b)) => match self.force(value)? {
                Val::Table(table) => {
                    let entries = table.entries.iter().cloned();
                    let entries: Found<Vec<Val>> =
                        entries.map(|e| self.convert(e, a, b, span)).collect();
                    Val::Table(Rc::new(Table {
                        name: table.name.clone(),
                        width: table.width,
                        entries: entries?,
                    }))
                }
                other => other,
            },
            (Ty::Hit(Some(a)), Ty::Hit(Some(b))) => match self.force(value)? {
                Val::Parts(parts) => {
                    let mut parts = parts.to_vec();
                    if let Some(tag) = parts.get_mut(3) {
                        *tag = self.convert(tag.clone(), a, b, span)?;
                    }
                    Val::parts(parts)
                }
                other => other,
            },
            _ => value,
        })
    }
}
