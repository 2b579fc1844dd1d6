//! Values while compiling: structure is known, scalars are nodes.

use super::projection::{Order, Pencil, Projection};
use super::{Found, Lower};
use crate::ir::extent::Extent;
use crate::ir::graph::{NodeId, TableId};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use slowlight_routine::Type;
use std::cell::{OnceCell, RefCell};
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

/// Work that waits, and how many works wait for each other in it at most.
pub(super) struct Lazy {
    pub(super) depth: usize,
    thunk: RefCell<Thunk>,
}

/// Works that may wait for each other: working them out, and dropping them,
/// follows the chain on the host's stack.
pub(super) const WAITING: usize = 64;

/// A value while compiling.
#[derive(Clone)]
pub(super) enum Val {
    /// A bool, int, real, angle or ink.
    Node(NodeId),
    /// What an `each` counts, in its local alone: it stands where it is named, as if written.
    Number(i32),
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
    /// A function from rows to a group's shapes.
    Rows(Rc<Instances>),
    /// At its first use.
    Lazy(Rc<Lazy>),
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

/// What is asked of shapes by a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Asked {
    /// Which one it meets first, and where.
    Nearest,
    /// Whether it meets one.
    Any,
}

/// Shapes that are alike but for numbers.
pub(super) struct Instances {
    /// Each by itself, and the first one's place among the scene's shapes.
    pub(super) shapes: Rc<[Rc<Shape>]>,
    pub(super) at: usize,
    /// Of each of a shape's scalars, where it is looked up; none where it is the first one's.
    pub(super) columns: Vec<Option<TableId>>,
    /// The same of the tag's.
    pub(super) tags: Vec<Option<TableId>>,
    /// Their boxes, where there are enough of them and all have one.
    pub(super) boxes: Option<Vec<Extent>>,
    /// The cells in which any ray finds them, made for the first that asks.
    pub(super) grid: OnceCell<Option<Grid>>,
    /// Those of the rays of a pencil.
    pub(super) views: RefCell<Views>,
}

/// Cells and what is in them.
pub(super) struct Grid {
    pub(super) whole: Extent,
    pub(super) side: [f64; 3],
    pub(super) along: [usize; 3],
    pub(super) lists: Lists,
}

/// Views by whose rays they are for, and in which order; none where one is worth nothing.
type Views = Vec<((Pencil, Order), Option<Rc<View>>)>;

/// Cells of a picture of shapes, from a point or along a direction.
pub(super) struct View {
    pub(super) by: Projection,
    pub(super) low: [f64; 2],
    pub(super) side: [f64; 2],
    pub(super) along: [usize; 2],
    /// How much of a direction into it is ahead at least.
    pub(super) least: f64,
    pub(super) lists: Lists,
    /// How far from the point that it is seen from each shape is at least: what is nearer comes
    /// first in lists.
    pub(super) near: Rc<Table>,
}

/// What is in each of some cells.
pub(super) struct Lists {
    /// Where each cell's list begins; the next one's begins where it ends.
    pub(super) first: Rc<Table>,
    pub(super) list: Rc<Table>,
    /// How many entries a cell has at most.
    pub(super) most: usize,
}

impl Lists {
    pub(super) fn values(&self) -> [Val; 2] {
        [&self.first, &self.list].map(|table| Val::Table(table.clone()))
    }
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
        Val::waiting(0, work)
    }

    /// Work that needs other work, which is `depth` deep.
    pub(super) fn waiting(depth: usize, work: Work) -> Val {
        let thunk = RefCell::new(Thunk::Todo(work));
        Val::Lazy(Rc::new(Lazy { depth, thunk }))
    }

    /// How many works wait for each other in it.
    pub(super) fn depth(&self) -> usize {
        match self {
            Val::Lazy(lazy) => lazy.depth + 1,
            _ => 0,
        }
    }
}

impl Lower<'_> {
    /// The value itself.
    pub(super) fn force(&mut self, value: Val) -> Found<Val> {
        let Val::Lazy(lazy) = value else {
            return Ok(value);
        };
        let cell = &lazy.thunk;
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
}
