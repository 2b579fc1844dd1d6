//! Shapes: what their facets say, and what follows from them.
//!
//! A distance is an implicit function too, so `f` of a shape without one is its
//! `dist`; nothing else stands for anything else. A shape of the library made of
//! shapes, a union say, has an exact `hit` where those have; where one of them
//! has nothing but `dist`, so has the whole: one search instead of one in another.

use super::value::{Shape, Val};
use super::{Found, Lower, leaving};
use crate::ir::graph::NodeId;
use crate::sema::builtins::Builtin;
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use crate::syntax::tree::BinaryOp;
use slowlight_routine::Op;
use std::rc::Rc;

/// How far shapes that have nothing but `dist` are looked for.
pub(super) const REACH: f64 = 1000.0;

/// In how many steps roots of `f` are looked for within `bound`, unless the
/// shape says otherwise.
const STEPS: i32 = 32;

/// A unit roundoff up to which a point found along the ray will do: a sphere a
/// thousandth of its distance wide still has ten bits of a normal.
const AMPLE: f64 = 1.0 / 1_048_576.0;

/// What is known of the nearest hit of a shape.
#[derive(Clone)]
pub(super) struct Solution {
    /// Whether there is one: a bool.
    pub(super) present: NodeId,
    /// The distance along the ray.
    pub(super) t: NodeId,
    /// The point and the unit normal, where the shape's `hit` says them.
    known: Option<(Val, Val)>,
}

impl<'a> Lower<'a> {
    fn shape_name(&self, shape: &Shape) -> String {
        let found = self.program.shapes.get(shape.id.0);
        found.map_or_else(String::new, |s| s.name.clone())
    }

    /// A facet's value, if the shape has it.
    pub(super) fn facet(
        &mut self,
        shape: &Rc<Shape>,
        kind: FacetKind,
        arg: Val,
        span: Span,
    ) -> Found<Option<Val>> {
        self.facet_of(shape, kind, vec![arg], span)
    }

    fn has(&self, shape: &Shape, kind: FacetKind) -> bool {
        let found = self.program.shapes.get(shape.id.0);
        found.is_some_and(|s| s.facets.iter().any(|f| f.kind == kind))
    }

    pub(super) fn facet_of(
        &mut self,
        shape: &Rc<Shape>,
        kind: FacetKind,
        arg: Vec<Val>,
        span: Span,
    ) -> Found<Option<Val>> {
        let Some(item) = self.program.shapes.get(shape.id.0) else {
            return Err(self.confused(span));
        };
        let Some(facet) = item.facets.iter().find(|f| f.kind == kind) else {
            return Ok(None);
        };
        let mut args = shape.args.clone();
        args.extend(arg);
        let all_turns = std::mem::replace(&mut self.all_turns, false);
        let found = self.inside(item.library, span, |l| {
            l.enter(&facet.body, args, |l| {
                let value = l.expr(&facet.body.value)?;
                l.force(value)
            })
        });
        self.all_turns = all_turns;
        found.map(Some)
    }

    /// What a scene asks of a shape.
    pub(super) fn ask(
        &mut self,
        what: Builtin,
        shape: &Rc<Shape>,
        arg: Val,
        span: Span,
    ) -> Found<Val> {
        match what {
            Builtin::ShapeHit => self.shape_hit(shape, arg, span),
            Builtin::ShapeCrossing => self.crossing(shape, arg, span),
            Builtin::ShapeNormal => self.shape_normal(shape, arg, span),
            Builtin::ShapeDist => self.required(shape, FacetKind::Dist, arg, span),
            _ => self.required(shape, FacetKind::Implicit, arg, span),
        }
    }

    fn required(&mut self, shape: &Rc<Shape>, kind: FacetKind, arg: Val, span: Span) -> Found<Val> {
        if let Some(value) = self.facet(shape, kind, arg.clone(), span)? {
            return Ok(value);
        }
        if kind == FacetKind::Implicit
            && let Some(value) = self.facet(shape, FacetKind::Dist, arg, span)?
        {
            return Ok(value);
        }
        let (name, facet) = (self.shape_name(shape), kind.name());
        let error = self.error(span, format!("`{name}` has no `{facet}`"));
        Err(Box::new(
            error.help(format!("give the shape a facet `{facet}(p) = ..`")),
        ))
    }

    /// Whether a shape is found by its distance alone.
    pub(super) fn approached(&mut self, shape: &Rc<Shape>) -> Found<bool> {
        if !self.has(shape, FacetKind::Dist) {
            return Ok(false);
        }
        if !self.has(shape, FacetKind::Hit) && !self.has(shape, FacetKind::Implicit) {
            return Ok(true);
        }
        let item = self.program.shapes.get(shape.id.0);
        if !item.is_some_and(|s| s.library) {
            return Ok(false);
        }
        for part in &shape.args {
            if let Val::Shape(part) = self.force(part.clone())?
                && self.approached(&part)?
            {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether what a solution knows is worth a choice for each shape: where
    /// the format is short of digits, or nothing else tells the normal.
    fn wants_solution(&self, shape: &Shape) -> bool {
        let otherwise = [FacetKind::Normal, FacetKind::Implicit, FacetKind::Dist];
        self.options.epsilon > AMPLE || !otherwise.iter().any(|&kind| self.has(shape, kind))
    }

    /// The nearest hit along a ray; none, perhaps, where that is beyond `reach`.
    pub(super) fn solved(
        &mut self,
        shape: &Rc<Shape>,
        ray: Val,
        reach: Option<NodeId>,
        span: Span,
    ) -> Found<Solution> {
        let Val::Optional { present, value } = self.distance_along(shape, ray, reach, span)? else {
            return Err(self.confused(span));
        };
        let (t, known) = match (*value).clone() {
            Val::Parts(parts) => match &*parts {
                [point, normal, t, ..] => {
                    let known = Some((point.clone(), normal.clone()));
                    (t.clone(), known.filter(|_| self.wants_solution(shape)))
                }
                _ => return Err(self.confused(span)),
            },
            t => (t, None),
        };
        let t = self.node(t, &Ty::Real, span)?;
        Ok(Solution { present, t, known })
    }

    /// The distance along a ray: optional; a real, or a hit where the
    /// shape's own solution gives one. Steps along the ray end at `reach`: they only grow, so
    /// that whatever they found behind it would be farther.
    fn distance_along(
        &mut self,
        shape: &Rc<Shape>,
        ray: Val,
        reach: Option<NodeId>,
        span: Span,
    ) -> Found<Val> {
        let itself = Val::Shape(shape.clone());
        let bound = |l: &mut Self| l.facet_of(shape, FacetKind::Bound, Vec::new(), span);
        if self.approached(shape)? {
            let reach = reach.unwrap_or_else(|| self.real(f64::MAX, span));
            if let Some(bound) = bound(self)? {
                let args = vec![itself, ray, bound, Val::Node(reach)];
                return self.library("approach_in", Ty::Shape, args, span);
            }
            let most = self.real(REACH, span);
            let far = self.apply(Op::Min, &[reach, most], span)?;
            return match self.stretch_of(shape, &ray, far, span)? {
                None => {
                    let start = Val::Node(self.real(0.0, span));
                    let args = vec![itself, ray, start, Val::Node(far)];
                    self.library("approach", Ty::Shape, args, span)
                }
                Some(on) => {
                    let args = vec![itself, ray, Val::Node(on.near), Val::Node(on.far)];
                    self.library("approach_on", Ty::Shape, args, span)
                }
            };
        }
        if let Some(t) = self.facet(shape, FacetKind::Hit, ray.clone(), span)? {
            return Ok(t);
        }
        if let Some(t) = self.derived_root(shape, &ray, span)? {
            return Ok(t);
        }
        let steps = match self.facet_of(shape, FacetKind::Steps, Vec::new(), span)? {
            Some(steps) => steps,
            None => Val::Node(self.int(STEPS, span)),
        };
        if let Some(bound) = bound(self)? {
            return self.library(
                "search_in",
                Ty::Shape,
                vec![itself, ray, bound, steps],
                span,
            );
        }
        let Some(on) = self.stretch_across(shape, &ray, span)? else {
            let name = self.shape_name(shape);
            let error = self.error(span, format!("nothing says where to look for `{name}`"));
            return Err(Box::new(error.help(
                "give the shape a finite `bound = box(..);`, or its own `hit(r) = ..`",
            )));
        };
        let args = vec![itself, ray, Val::Node(on.near), Val::Node(on.far), steps];
        self.library("search_on", Ty::Shape, args, span)
    }

    /// The point of a hit: the solution's own, else that of the ray.
    pub(super) fn point_of(&mut self, found: &Solution, ray: &Val, span: Span) -> Found<Val> {
        match &found.known {
            Some((point, _)) => Ok(point.clone()),
            None => self.along(ray, Val::Node(found.t), span),
        }
    }

    /// The normal of a hit: the solution's own, else the shape's at the point.
    pub(super) fn normal_of(
        &mut self,
        shape: &Rc<Shape>,
        found: &Solution,
        point: Val,
        span: Span,
    ) -> Found<Val> {
        match &found.known {
            Some((_, normal)) => self.direction(normal.clone(), span),
            None => {
                let outer = std::mem::replace(&mut self.is_met, true);
                let normal = self.shape_normal(shape, point, span);
                self.is_met = outer;
                normal
            }
        }
    }

    pub(super) fn shape_normal(&mut self, shape: &Rc<Shape>, p: Val, span: Span) -> Found<Val> {
        if let Some(normal) = self.facet(shape, FacetKind::Normal, p.clone(), span)? {
            return self.direction(normal, span);
        }
        if let Some(normal) = self.derived_normal(shape, p, span)? {
            return self.direction(normal, span);
        }
        let name = self.shape_name(shape);
        let error = self.error(
            span,
            format!("`{name}` has only `hit`, and a normal is the gradient of `f` or `dist`"),
        );
        Err(Box::new(error.help(
            "give the shape a facet `normal(p) = ..`, of length 1, or `f(p)` beside `hit`",
        )))
    }

    /// A vector that has length 1 by contract: the ranges may trust that.
    pub(super) fn direction(&mut self, value: Val, span: Span) -> Found<Val> {
        let nodes = self.vector(value.clone(), 3, span)?;
        nodes
            .into_iter()
            .for_each(|node| self.b.direction(node, 1.0));
        Ok(value)
    }

    /// The point of a ray at a distance.
    pub(super) fn along(&mut self, ray: &Val, t: Val, span: Span) -> Found<Val> {
        let from = self.part(ray.clone(), 0, span)?;
        let dir = self.part(ray.clone(), 1, span)?;
        let (from, dir) = (self.vector(from, 3, span)?, self.vector(dir, 3, span)?);
        let t = self.node(t, &Ty::Real, span)?;
        let mut parts = Vec::new();
        for (from, dir) in from.into_iter().zip(dir) {
            let step = self.scalar(BinaryOp::Mul, &Ty::Real, dir, t, span)?;
            let sum = self.scalar(BinaryOp::Add, &Ty::Real, from, step, span)?;
            parts.push(Val::Node(sum));
        }
        Ok(Val::parts(parts))
    }

    /// A distance before which a ray meets no surface of a shape: what it says of that, or else
    /// where the ray hits it.
    fn crossing(&mut self, shape: &Rc<Shape>, ray: Val, span: Span) -> Found<Val> {
        if let Some(t) = self.facet(shape, FacetKind::Crossing, ray.clone(), span)? {
            return Ok(t);
        }
        let found = self.solved(shape, ray, None, span)?;
        Ok(Val::Optional {
            present: found.present,
            value: Rc::new(Val::Node(found.t)),
        })
    }

    /// A hit of a bare shape; its point and normal are worked out if used.
    fn shape_hit(&mut self, shape: &Rc<Shape>, ray: Val, span: Span) -> Found<Val> {
        let mut found = self.solved(shape, ray.clone(), None, span)?;
        if self.leaves(shape, &ray, span)? {
            found.present = self.bool(false, span);
        }
        self.b.name(found.t, "t");
        let (present, t) = (found.present, Val::Node(found.t));
        let solution = found.clone();
        let on = leaving::Surface::Bare(shape.clone());
        let point = self.later("point", move |l| {
            let point = l.point_of(&solution, &ray, span)?;
            l.lies_on(&point, on, span)?;
            Ok(point)
        });
        let (of, at) = (shape.clone(), point.clone());
        let normal = self.later_normal(move |l| l.normal_of(&of, &found, at, span), span);
        Ok(Val::Optional {
            present,
            value: Rc::new(Val::parts(vec![point, normal, t])),
        })
    }

    /// The vector `name`, worked out in this place of the source if used.
    pub(super) fn later(
        &self,
        name: &'static str,
        work: impl for<'b> FnOnce(&mut Lower<'b>) -> Found<Val> + 'static,
    ) -> Val {
        self.here(move |l| {
            let vector = work(l)?;
            l.name(&vector, &Ty::Vector(3), name);
            Ok(vector)
        })
    }

    /// The same of a hit's normal.
    pub(super) fn later_normal(
        &self,
        work: impl for<'b> FnOnce(&mut Lower<'b>) -> Found<Val> + 'static,
        span: Span,
    ) -> Val {
        self.later("normal", move |l| {
            let normal = work(l)?;
            let nodes = l.vector(normal.clone(), 3, span)?;
            l.normals.extend(nodes);
            Ok(normal)
        })
    }

    /// A value worked out in this place of the source if used.
    pub(super) fn here(
        &self,
        work: impl for<'b> FnOnce(&mut Lower<'b>) -> Found<Val> + 'static,
    ) -> Val {
        let place = self.place;
        Val::lazy(Box::new(move |l: &mut Lower<'_>| {
            let outer = std::mem::replace(&mut l.place, place);
            let value = work(l);
            l.place = outer;
            value
        }))
    }
}
