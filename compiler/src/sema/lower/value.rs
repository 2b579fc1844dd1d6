//! Values while compiling: structure is known, scalars are nodes.

use super::{Found, Lower};
use crate::flow::graph::NodeId;
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use slowlight_routine::{Type, Value};
use std::cell::RefCell;
use std::rc::Rc;

/// The most scalars that one value may have.
const SCALARS: usize = 1024;

/// Work that is done at its first use.
pub(super) type Work = Box<dyn for<'a> FnOnce(&mut Lower<'a>) -> Found<Val>>;

/// A value that may not be worked out yet.
pub(super) enum Thunk {
    Todo(Work),
    Done(Val),
}

/// A value while compiling.
#[derive(Clone)]
pub(super) enum Val {
    /// A bool, int, real, angle or ink.
    Node(NodeId),
    /// A vector, ray, hit or record, part by part.
    Parts(Rc<[Val]>),
    /// A value that is there where `present` (a bool) holds.
    Optional {
        present: NodeId,
        value: Rc<Val>,
    },
    Table(Rc<Table>),
    Map(MapId),
    Function(Callee),
    Shape(Rc<Shape>),
    Scene(SceneId),
    /// At its first use.
    Lazy(Rc<RefCell<Thunk>>),
    /// What no path needs.
    Undefined,
}

/// A table of values of one type.
pub(super) struct Table {
    pub(super) name: String,
    pub(super) width: usize,
    pub(super) entries: Vec<Val>,
}

impl Table {
    pub(super) fn height(&self) -> usize {
        self.entries.len() / self.width.max(1)
    }
}

/// A shape and what it was made with.
pub(super) struct Shape {
    pub(super) id: ShapeId,
    pub(super) args: Vec<Val>,
}

/// The scalar that a type is, if it is one.
pub(super) fn scalar(ty: &Ty) -> Option<Type> {
    match ty {
        Ty::Bool => Some(Type::Bool),
        Ty::Int | Ty::Ink => Some(Type::Int),
        Ty::Real | Ty::Angle => Some(Type::Real),
        _ => None,
    }
}

impl Val {
    pub(super) fn parts(parts: Vec<Val>) -> Val {
        Val::Parts(parts.into())
    }

    pub(super) fn lazy(work: Work) -> Val {
        Val::Lazy(Rc::new(RefCell::new(Thunk::Todo(work))))
    }
}

impl Lower<'_> {
    /// The value itself.
    pub(super) fn force(&mut self, value: Val) -> Found<Val> {
        let Val::Lazy(cell) = value else {
            return Ok(value);
        };
        let thunk = std::mem::replace(&mut *cell.borrow_mut(), Thunk::Done(Val::Undefined));
        let value = match thunk {
            Thunk::Done(value) => value,
            Thunk::Todo(work) => {
                let value = work(self)?;
                self.force(value)?
            }
        };
        *cell.borrow_mut() = Thunk::Done(value.clone());
        Ok(value)
    }

    /// The node of a scalar.
    pub(super) fn node(&mut self, value: Val, ty: &Ty, span: Span) -> Found<NodeId> {
        match self.force(value)? {
            Val::Node(id) => Ok(id),
            Val::Undefined => Ok(self.b.undefined(scalar(ty).unwrap_or(Type::Real))),
            _ => Err(self.confused(span)),
        }
    }

    /// The parts of a vector, ray, hit or record.
    pub(super) fn part(&mut self, value: Val, at: usize, span: Span) -> Found<Val> {
        match self.force(value)? {
            Val::Parts(parts) => match parts.get(at) {
                Some(part) => self.force(part.clone()),
                None => Err(self.confused(span)),
            },
            Val::Undefined => Ok(Val::Undefined),
            _ => Err(self.confused(span)),
        }
    }

    /// The scalars of a vector.
    pub(super) fn vector(&mut self, value: Val, size: u8, span: Span) -> Found<Vec<NodeId>> {
        let value = self.force(value)?;
        (0..usize::from(size))
            .map(|k| {
                let part = self.part(value.clone(), k, span)?;
                self.node(part, &Ty::Real, span)
            })
            .collect()
    }

    /// The types of a structured type's parts, with their names.
    fn parts_of(&self, ty: &Ty) -> Vec<(String, Ty)> {
        let name = |names: &[&str], types: Vec<Ty>| {
            let names = names.iter().map(|n| (*n).to_owned());
            names.zip(types).collect::<Vec<_>>()
        };
        match ty {
            Ty::Vector(n) => name(
                &["x", "y", "z"][..usize::from(*n).min(3)],
                vec![Ty::Real; 3],
            ),
            Ty::Ray => name(&RAY_PARTS, vec![Ty::Vector(3); 2]),
            Ty::Hit(tag) => {
                let mut types = vec![Ty::Vector(3), Ty::Vector(3), Ty::Real];
                types.extend(tag.as_deref().cloned());
                name(&HIT_PARTS, types)
            }
            Ty::Record(id) => {
                let fields = self
                    .program
                    .records
                    .get(id.0)
                    .map_or(&[][..], |r| &r.fields);
                fields
                    .iter()
                    .map(|f| (f.name.clone(), f.ty.clone()))
                    .collect()
            }
            _ => Vec::new(),
        }
    }

    /// The names and types of a type's scalars: `r_dir_y`.
    pub(super) fn layout(&self, ty: &Ty, name: &str, span: Span) -> Found<Vec<(String, Type)>> {
        let mut found = Vec::new();
        self.layout_into(ty, name, &mut found, span)?;
        Ok(found)
    }

    fn layout_into(
        &self,
        ty: &Ty,
        name: &str,
        found: &mut Vec<(String, Type)>,
        span: Span,
    ) -> Found<()> {
        if found.len() > SCALARS {
            return Err(Box::new(self.error(span, "this value has too many parts")));
        }
        if let Some(scalar) = scalar(ty) {
            found.push((name.to_owned(), scalar));
        } else if let Ty::Optional(inner) = ty {
            found.push((format!("{name}_some"), Type::Bool));
            self.layout_into(inner, name, found, span)?;
        } else {
            for (part, ty) in self.parts_of(ty) {
                self.layout_into(&ty, &format!("{name}_{part}"), found, span)?;
            }
        }
        Ok(())
    }

    /// A value's scalars, in the order of [`Lower::layout`].
    pub(super) fn flatten(
        &mut self,
        value: Val,
        ty: &Ty,
        found: &mut Vec<NodeId>,
        span: Span,
    ) -> Found<()> {
        if found.len() > SCALARS {
            return Err(Box::new(self.error(span, "this value has too many parts")));
        }
        if scalar(ty).is_some() {
            let node = self.node(value, ty, span)?;
            found.push(node);
            return Ok(());
        }
        let value = self.force(value)?;
        if let Ty::Optional(inner) = ty {
            let (present, value) = match value {
                Val::Optional { present, value } => (present, (*value).clone()),
                Val::Undefined => (self.b.undefined(Type::Bool), Val::Undefined),
                _ => return Err(self.confused(span)),
            };
            found.push(present);
            return self.flatten(value, inner, found, span);
        }
        for (k, (_, ty)) in self.parts_of(ty).into_iter().enumerate() {
            let part = self.part(value.clone(), k, span)?;
            self.flatten(part, &ty, found, span)?;
        }
        Ok(())
    }

    /// The value that has the given scalars.
    pub(super) fn unflatten(&mut self, ty: &Ty, nodes: &mut impl Iterator<Item = NodeId>) -> Val {
        if scalar(ty).is_some() {
            return nodes.next().map_or(Val::Undefined, Val::Node);
        }
        if let Ty::Optional(inner) = ty {
            let Some(present) = nodes.next() else {
                return Val::Undefined;
            };
            let value = Rc::new(self.unflatten(inner, nodes));
            return Val::Optional { present, value };
        }
        let types = self.parts_of(ty);
        Val::parts(
            types
                .iter()
                .map(|(_, ty)| self.unflatten(ty, nodes))
                .collect(),
        )
    }

    /// Gives a value's scalars the name that the scene gives it.
    pub(super) fn name(&mut self, value: &Val, ty: &Ty, name: &str) {
        match value {
            Val::Node(id) => self.b.name(*id, name),
            Val::Parts(parts) => {
                for (part, (label, ty)) in parts.iter().zip(self.parts_of(ty)) {
                    self.name(part, &ty, &format!("{name}_{label}"));
                }
            }
            Val::Optional { present, value } => {
                self.b.name(*present, &format!("{name}_some"));
                if let Ty::Optional(inner) = ty {
                    self.name(value, inner, name);
                }
            }
            _ => {}
        }
    }

    /// Whether every scalar is known.
    pub(super) fn is_constant(&mut self, value: &Val) -> Found<bool> {
        Ok(match self.force(value.clone())? {
            Val::Node(id) => self.b.value(id).is_some(),
            Val::Parts(parts) => self.all_constant(&parts)?,
            Val::Table(table) => self.all_constant(&table.entries)?,
            Val::Shape(shape) => self.all_constant(&shape.args)?,
            Val::Optional { present, value } => {
                self.b.value(present).is_some() && self.is_constant(&value)?
            }
            _ => true,
        })
    }

    fn all_constant(&mut self, values: &[Val]) -> Found<bool> {
        for value in values {
            if !self.is_constant(value)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

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
                Val::lazy(Box::new(move |l: &mut Lower<'_>| {
                    let (yes, no) = (l.force(yes)?, l.force(no)?);
                    l.merge(condition, yes, no, span)
                }))
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
                self.b.apply(slowlight_routine::Op::Not, &[condition], span)
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
                Val::Node(self.apply(slowlight_routine::Op::ToReal, &[node], span)?)
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
