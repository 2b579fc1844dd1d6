//! Instancing: shapes of a scene that are alike but for numbers, as rows of a table.
//!
//! A scene's shapes that are made by one item from constants (or from the same values) become one
//! group, which stands where the first of them does; others may stand between as long as their
//! surfaces cannot be the same, for of such the later is seen (`coincide`). What a ray meets of it is found by a loop over the table, and by
//! cells where the shapes have boxes (`among`); what is asked of the nearest one alone, its normal
//! or its tag, is made from the row that it stands in.

use super::value::{Instances, Shape, Val};
use super::ways::{INSTANCES, Instancing};
use super::{Found, Lower};
use crate::ir::graph::{self, Constant, NodeId, TableId};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use slowlight_routine::Type;
use std::cell::{OnceCell, RefCell};
use std::rc::Rc;

/// A shape of a scene, or several of a kind.
#[derive(Clone)]
pub(super) enum Member {
    /// One, by its place among the scene's shapes.
    One(usize, Rc<Shape>),
    /// Several.
    Group(Rc<Instances>),
}

/// A shape's, or a tag's, scalars with their names.
type Scalars = Vec<(String, Type, NodeId)>;

/// What tells one group from another, and the scalars that differ in it.
struct Row {
    kinds: Vec<ShapeId>,
    scalars: Scalars,
}

impl<'a> Lower<'a> {
    /// A scene's shapes, those of a kind together.
    pub(super) fn members_of(&mut self, id: SceneId, span: Span) -> Found<Rc<[Member]>> {
        if let Some(found) = self.members.get(&id) {
            return Ok(found.clone());
        }
        let shapes = self.shapes_of(id, span)?;
        let mut rows = Vec::new();
        for shape in shapes.iter() {
            rows.push(self.row_of(shape, span)?);
        }
        let mut found = Vec::new();
        let mut taken = vec![false; shapes.len()];
        for at in 0..shapes.len() {
            if taken[at] {
                continue;
            }
            let alike = self.alike(&shapes, &rows, &taken, at, span)?;
            let tags = match alike.len() >= INSTANCES {
                true => self.tags_of(id, &alike, span)?,
                false => Vec::new(),
            };
            if tags.len() < INSTANCES {
                found.push(Member::One(at, shapes[at].clone()));
                continue;
            }
            let places = &alike[..tags.len()];
            for &k in places {
                taken[k] = true;
            }
            if self.options.ways.instancing == Instancing::Separate {
                let one = |&k: &usize| Member::One(k, shapes[k].clone());
                found.extend(places.iter().map(one));
                continue;
            }
            let of: Vec<&Row> = places.iter().filter_map(|&k| rows[k].as_ref()).collect();
            let of = of.into_iter().map(|row| &row.scalars).collect();
            let shapes: Vec<Rc<Shape>> = places.iter().map(|&k| shapes[k].clone()).collect();
            found.push(Member::Group(Rc::new(Instances {
                at,
                columns: self.columns_of(of),
                tags: self.columns_of(tags.iter().collect()),
                boxes: self.boxes_of(&shapes, span)?,
                shapes: shapes.into(),
                grid: OnceCell::new(),
                views: RefCell::default(),
            })));
        }
        let found: Rc<[Member]> = found.into();
        self.members.insert(id, found.clone());
        Ok(found)
    }

    /// The shapes that one table may hold with the one at a place, by their places: those of its
    /// kind behind it, as far as no other stands between whose surface may lie on theirs.
    fn alike(
        &mut self,
        shapes: &[Rc<Shape>],
        rows: &[Option<Row>],
        taken: &[bool],
        at: usize,
        span: Span,
    ) -> Found<Vec<usize>> {
        let mut found = vec![at];
        let Some(first) = &rows[at] else {
            return Ok(found);
        };
        for k in at + 1..shapes.len() {
            match &rows[k] {
                _ if taken[k] => {}
                Some(row) if self.are_alike(first, row) => found.push(k),
                _ if self.may_coincide(&shapes[at], &shapes[k])? => break,
                _ => {}
            }
        }
        if found.len() >= INSTANCES && !self.is_instance(&shapes[at], span)? {
            found.truncate(1);
        }
        Ok(found)
    }

    /// The tags of shapes of one kind, as far as they are alike.
    fn tags_of(&mut self, id: SceneId, places: &[usize], span: Span) -> Found<Vec<Scalars>> {
        let mut tags: Vec<Scalars> = Vec::new();
        for &k in places {
            match self.tag_scalars(id, k, span)? {
                Some(tag) if tags.first().is_none_or(|first| self.all_alike(first, &tag)) => {
                    tags.push(tag);
                }
                _ => break,
            }
        }
        Ok(tags)
    }

    /// Whether loops may stand for shapes of this kind: found by a formula, which says what its
    /// distance says; and not flat, as such leave out what a ray starts on.
    fn is_instance(&mut self, shape: &Rc<Shape>, span: Span) -> Found<bool> {
        Ok(!self.approached(shape)? && !self.flat(shape, span)?)
    }

    fn row_of(&mut self, shape: &Rc<Shape>, span: Span) -> Found<Option<Row>> {
        let mut row = Row {
            kinds: Vec::new(),
            scalars: Vec::new(),
        };
        let whole = self.read_row(shape, &mut row, span)?;
        Ok(whole.then_some(row))
    }

    /// Whether a shape is the library's, and all of its arguments are numbers or such shapes. In one
    /// of somebody's own a number that differs from row to row may be an exponent, or how often a
    /// loop turns, and is no constant any more.
    fn read_row(&mut self, shape: &Rc<Shape>, row: &mut Row, span: Span) -> Found<bool> {
        row.kinds.push(shape.id);
        let Some(item) = self.program.shapes.get(shape.id.0) else {
            return Err(self.confused(span));
        };
        if !item.library {
            return Ok(false);
        }
        for (arg, param) in shape.args.iter().zip(&item.params) {
            if param.ty.is_data() {
                let layout = self.layout(&param.ty, &param.name, span)?;
                let mut nodes = Vec::new();
                self.flatten(arg.clone(), &param.ty, &mut nodes, span)?;
                let named = layout.into_iter().zip(nodes);
                row.scalars
                    .extend(named.map(|((name, ty), node)| (name, ty, node)));
            } else if let Val::Shape(part) = self.force(arg.clone())? {
                if !self.read_row(&part, row, span)? {
                    return Ok(false);
                }
            } else {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The scalars of a shape's tag, at any point; none of a scene without tags.
    fn tag_scalars(&mut self, id: SceneId, at: usize, span: Span) -> Found<Option<Scalars>> {
        let Some(ty) = self.program.scenes.get(id.0).and_then(|s| s.tag.clone()) else {
            return Ok(Some(Vec::new()));
        };
        if !ty.is_data() {
            return Ok(None);
        }
        let claims = self.claims.len();
        let point = Val::parts(self.markers(span).map(Val::Node).to_vec());
        let value = self.tag_at(id, at, point, span)?;
        self.claims.truncate(claims);
        let layout = self.layout(&ty, "tag", span)?;
        let mut nodes = Vec::new();
        self.flatten(value, &ty, &mut nodes, span)?;
        let named = layout.into_iter().zip(nodes);
        Ok(Some(
            named.map(|((name, ty), node)| (name, ty, node)).collect(),
        ))
    }

    fn are_alike(&self, a: &Row, b: &Row) -> bool {
        a.kinds == b.kinds && self.all_alike(&a.scalars, &b.scalars)
    }

    /// Whether scalars are the same nodes or constants.
    fn all_alike(&self, a: &Scalars, b: &Scalars) -> bool {
        let is_constant = |node| self.b.value(node).is_some();
        let alike = |(a, b)| a == b || is_constant(a) && is_constant(b);
        a.len() == b.len() && a.iter().zip(b).map(|(a, b)| (a.2, b.2)).all(alike)
    }

    /// Tables of what differs from row to row.
    fn columns_of(&mut self, rows: Vec<&Scalars>) -> Vec<Option<TableId>> {
        let Some(first) = rows.first() else {
            return Vec::new();
        };
        let mut found = Vec::new();
        for (k, (name, ty, node)) in first.iter().enumerate() {
            let values = rows.iter().map(|row| self.b.value(row[k].2));
            let values: Option<Vec<Constant>> = values.map(|v| v.map(Constant::new)).collect();
            let differ = rows.iter().any(|row| row[k].2 != *node);
            found.push(values.filter(|_| differ).map(|entries| {
                self.b.table(graph::Table {
                    name: name.clone(),
                    width: entries.len() as u32,
                    height: 1,
                    ty: *ty,
                    entries,
                    seed: Vec::new(),
                })
            }));
        }
        found
    }

    /// The shape in a row.
    pub(super) fn instance(&mut self, of: &Instances, row: NodeId, span: Span) -> Found<Rc<Shape>> {
        let mut columns = of.columns.iter().copied();
        self.made_in(&of.shapes[0], &mut columns, row, span)
    }

    fn made_in(
        &mut self,
        like: &Rc<Shape>,
        columns: &mut impl Iterator<Item = Option<TableId>>,
        row: NodeId,
        span: Span,
    ) -> Found<Rc<Shape>> {
        let Some(item) = self.program.shapes.get(like.id.0) else {
            return Err(self.confused(span));
        };
        let mut args = Vec::new();
        for (arg, param) in like.args.iter().zip(&item.params) {
            args.push(match self.force(arg.clone())? {
                Val::Shape(part) => Val::Shape(self.made_in(&part, columns, row, span)?),
                value => self.looked_up(value, &param.ty, columns, row, span)?,
            });
        }
        Ok(Rc::new(Shape { id: like.id, args }))
    }

    /// A value whose scalars stand in tables, where they differ.
    fn looked_up(
        &mut self,
        like: Val,
        ty: &Ty,
        columns: &mut impl Iterator<Item = Option<TableId>>,
        row: NodeId,
        span: Span,
    ) -> Found<Val> {
        let mut nodes = Vec::new();
        self.flatten(like, ty, &mut nodes, span)?;
        let first = self.int(0, span);
        let here = self.at(span);
        for node in &mut nodes {
            if let Some(table) = columns.next().flatten() {
                *node = self.b.lookup(table, row, first, here);
            }
        }
        Ok(self.unflatten(ty, &mut nodes.into_iter()))
    }

    /// The tag of the shape in a row.
    pub(super) fn instance_tag(
        &mut self,
        id: SceneId,
        of: &Instances,
        row: NodeId,
        p: Val,
        span: Span,
    ) -> Found<Val> {
        let Some(ty) = self.program.scenes.get(id.0).and_then(|s| s.tag.clone()) else {
            return Err(self.confused(span));
        };
        let like = self.tag_at(id, of.at, p, span)?;
        let mut columns = of.tags.iter().copied();
        self.looked_up(like, &ty, &mut columns, row, span)
    }
}
