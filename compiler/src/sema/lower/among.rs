//! What a ray meets of a group of alike shapes: by the cells of its pencil's view, by those of
//! space, by a loop over all, or by code for each.

use super::projection::Order;
use super::value::{Asked, Grid, Instances, Val};
use super::ways::Instancing;
use super::{Found, Lower};
use crate::ir::graph::NodeId;
use crate::sema::ty::Ty;
use crate::source::Span;
use crate::syntax::tree::BinaryOp;
use std::rc::Rc;

/// The nearest hit of a group: whether there is one, how far along the ray, and the shape's row.
pub(super) struct Met {
    pub(super) present: NodeId,
    pub(super) t: NodeId,
    pub(super) row: NodeId,
}

/// What is asked of a group: by which ray, and how far away at most.
#[derive(Clone, Copy)]
struct Question<'q> {
    of: &'q Rc<Instances>,
    asked: Asked,
    ray: &'q Val,
    far: NodeId,
    span: Span,
}

impl Lower<'_> {
    /// The nearest hit of a group that is not beyond `far`, and the row of the shape that is hit.
    pub(super) fn nearest_instance(
        &mut self,
        of: &Rc<Instances>,
        ray: &Val,
        far: NodeId,
        span: Span,
    ) -> Found<Met> {
        let met = self.among(Question {
            of,
            asked: Asked::Nearest,
            ray,
            far,
            span,
        })?;
        let t = self.part(met.clone(), 0, span)?;
        let t = self.node(t, &Ty::Real, span)?;
        let row = self.part(met, 1, span)?;
        let row = self.node(row, &Ty::Int, span)?;
        let none = self.int(0, span);
        let present = self.scalar(BinaryOp::Ge, &Ty::Int, row, none, span)?;
        Ok(Met { present, t, row })
    }

    /// Whether one of a group is hit nearer than `far`.
    pub(super) fn any_instance(
        &mut self,
        of: &Rc<Instances>,
        ray: &Val,
        far: NodeId,
        span: Span,
    ) -> Found<NodeId> {
        let any = self.among(Question {
            of,
            asked: Asked::Any,
            ray,
            far,
            span,
        })?;
        self.node(any, &Ty::Bool, span)
    }

    /// What is found of a group by a ray: by the cells of its pencil's view, by those of space, or
    /// one by one.
    fn among(&mut self, ask: Question<'_>) -> Found<Val> {
        let Some(seen) = self.view_of(ask.of, ask.ray, ask.asked, ask.span)? else {
            return self.among_all(ask);
        };
        let lists = &seen.view.lists;
        let mut args = lists.values().to_vec();
        args.push(Val::Node(self.int(lists.most as i32, ask.span)));
        let is_sorted = seen.order == Order::Nearest;
        args.extend(is_sorted.then(|| Val::Table(seen.view.near.clone())));
        args.push(seen.cell);
        let how = if is_sorted { "seen" } else { "along" };
        let found = self.found_by(ask, how, args)?;
        match seen.when {
            Some(when) => {
                let other = self.among_all(ask)?;
                self.merge(when, found, other, ask.span)
            }
            None => Ok(found),
        }
    }

    /// The same of any ray.
    fn among_all(&mut self, ask: Question<'_>) -> Found<Val> {
        if self.options.ways.instancing == Instancing::Seen {
            return self.one_by_one(ask);
        }
        let (how, args) = match self.grid_in(ask.of, ask.span)? {
            Some(grid) => ("in", self.grid_values(grid, ask.span).to_vec()),
            None => {
                let count = self.int(ask.of.shapes.len() as i32, ask.span);
                ("of", vec![Val::Node(count)])
            }
        };
        self.found_by(ask, how, args)
    }

    /// The same by code for each shape.
    fn one_by_one(&mut self, ask: Question<'_>) -> Found<Val> {
        let Question { ray, far, span, .. } = ask;
        let (mut t, mut row) = (far, self.int(-1, span));
        let (yes, no) = (self.bool(true, span), self.bool(false, span));
        let mut hits = Vec::new();
        let is_any = ask.asked == Asked::Any;
        for (k, shape) in (0..).zip(ask.of.shapes.iter()) {
            let found = self.solved(shape, ray.clone(), Some(t), span)?;
            let near = if is_any { BinaryOp::Lt } else { BinaryOp::Le };
            let near = self.scalar(near, &Ty::Real, found.t, t, span)?;
            let win = self.select(found.present, near, no, span);
            if is_any {
                hits.push(win);
                continue;
            }
            t = self.select(win, found.t, t, span);
            let k = self.int(k, span);
            row = self.select(win, k, row, span);
        }
        let hits = hits.into_iter().rev();
        let any = hits.fold(no, |any, hit| self.select(hit, yes, any, span));
        Ok(match is_any {
            true => Val::Node(any),
            false => Val::parts(vec![Val::Node(t), Val::Node(row)]),
        })
    }

    /// The same by the library's function for this way.
    fn found_by(&mut self, ask: Question<'_>, how: &str, args: Vec<Val>) -> Found<Val> {
        let mut all = vec![Val::Rows(ask.of.clone())];
        all.extend(args);
        all.extend([ask.ray.clone(), Val::Node(ask.far)]);
        let what = match ask.asked {
            Asked::Nearest => "nearest",
            Asked::Any => "any",
        };
        let first = Ty::Function(vec![Ty::Int], Box::new(Ty::Shape));
        let outer = std::mem::replace(&mut self.all_turns, true);
        let found = self.library(&format!("{what}_{how}"), first, all, ask.span);
        self.all_turns = outer;
        found
    }

    /// A group's grid, made for the first ray that asks.
    fn grid_in<'i>(&mut self, of: &'i Instances, span: Span) -> Found<Option<&'i Grid>> {
        if of.grid.get().is_none() {
            let grid = match &of.boxes {
                Some(boxes) => self.grid_of(&of.shapes, boxes, span)?,
                None => None,
            };
            // Nobody else makes it meanwhile.
            let _ = of.grid.set(grid);
        }
        Ok(of.grid.get().and_then(Option::as_ref))
    }
}
