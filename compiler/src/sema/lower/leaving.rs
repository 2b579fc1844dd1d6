//! Secondary rays: a flat surface never meets a ray that starts on it.
//!
//! The point of a hit is off its surface by a rounding, and a low sun's ray from there may
//! meet the surface again after any distance, whatever offset along the ray is asked for. Where
//! the ray starts at a hit's point itself, it is known which shape that lies on, and a shape
//! whose `f` is of degree 1 along every ray has no other root: it is left out (the test by the
//! primitive just hit; Haines, Günther and Akenine-Möller, Ray Tracing Gems, ch. 7).

use super::value::{Shape, Val};
use super::{Found, Lower};
use crate::ir::graph::NodeId;
use crate::sema::program::{FacetKind, SceneId};
use crate::source::Span;
use std::rc::Rc;

/// What the point of a hit lies on.
pub(super) enum Surface {
    /// One of a scene's shapes: the last whose condition holds.
    Of(SceneId, Vec<NodeId>),
    /// A shape by itself.
    Bare(Rc<Shape>),
}

impl Lower<'_> {
    /// Notes what the point of a hit lies on.
    pub(super) fn lies_on(&mut self, point: &Val, on: Surface, span: Span) -> Found<()> {
        let nodes = self.vector(point.clone(), 3, span)?;
        self.surfaces.insert(nodes, on);
        Ok(())
    }

    /// Whether a ray starts on a scene's shape and never meets it again: a bool; none where
    /// nothing is known of that.
    pub(super) fn leaves_one_of(
        &mut self,
        scene: SceneId,
        at: usize,
        shape: &Rc<Shape>,
        ray: &Val,
        span: Span,
    ) -> Found<Option<NodeId>> {
        let from = self.start(ray, span)?;
        let wins = match self.surfaces.get(&from) {
            Some(Surface::Of(of, wins)) if *of == scene => wins.clone(),
            _ => return Ok(None),
        };
        if !self.flat(shape, span)? {
            return Ok(None);
        }
        let Some((&mine, later)) = wins.get(at..).and_then(<[NodeId]>::split_first) else {
            return Ok(None);
        };
        let no = self.bool(false, span);
        let last = later
            .iter()
            .fold(mine, |so_far, &win| self.select(win, no, so_far, span));
        Ok(Some(last))
    }

    /// Whether a ray starts on this very shape and never meets it again.
    pub(super) fn leaves(&mut self, shape: &Rc<Shape>, ray: &Val, span: Span) -> Found<bool> {
        let from = self.start(ray, span)?;
        let on = match self.surfaces.get(&from) {
            Some(Surface::Bare(on)) => on.clone(),
            _ => return Ok(false),
        };
        let one = Val::Shape(on);
        Ok(self.same(&one, &Val::Shape(shape.clone()))? && self.flat(shape, span)?)
    }

    fn start(&mut self, ray: &Val, span: Span) -> Found<Vec<NodeId>> {
        let from = self.part(ray.clone(), 0, span)?;
        self.vector(from, 3, span)
    }

    /// Whether `f` of a shape is of degree 1 at most along every ray.
    pub(super) fn flat(&mut self, shape: &Rc<Shape>, span: Span) -> Found<bool> {
        let Some(formula) = self.formula(shape, FacetKind::Implicit, span)? else {
            return Ok(false);
        };
        let any = formula.markers;
        let along = self.polynomial(&formula, &any, &any, span)?;
        Ok(matches!(along, Some([_, _, None])))
    }

    /// Whether two values are one, by their nodes.
    fn same(&mut self, a: &Val, b: &Val) -> Found<bool> {
        let (a, b) = (self.force(a.clone())?, self.force(b.clone())?);
        match (&a, &b) {
            (Val::Node(a), Val::Node(b)) => Ok(a == b),
            (Val::Parts(a), Val::Parts(b)) => self.all_same(a, b),
            (Val::Shape(a), Val::Shape(b)) => {
                Ok(Rc::ptr_eq(a, b) || a.id == b.id && self.all_same(&a.args, &b.args)?)
            }
            (Val::Table(a), Val::Table(b)) => Ok(Rc::ptr_eq(a, b)),
            _ => Ok(false),
        }
    }

    fn all_same(&mut self, a: &[Val], b: &[Val]) -> Found<bool> {
        if a.len() != b.len() {
            return Ok(false);
        }
        for (a, b) in a.iter().zip(b) {
            if !self.same(a, b)? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
