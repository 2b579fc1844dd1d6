//! Bounding volumes derived from distances: rays are followed only where they are within them.
//!
//! Outside of its shape's box a distance is proved to be above 0 ([`extent`]), so nothing can be
//! hit there: a ray that misses the box is not followed, one that meets it begins where it enters
//! and ends where it leaves (slabs; Kay and Kajiya, Ray Tracing Complex Scenes, SIGGRAPH 1986). A
//! box may be open: ground is below a plane, a field of columns below its tops. Params are
//! anywhere in their ranges. A march that meets the box makes all of its steps, since they decide
//! where it stops; it believes what a scene says in `bound`, too.

#[cfg(test)]
use super::Options;
use super::derive::Formula;
use super::value::{Shape, Val};
use super::{Found, Lower};
use crate::ir::enclosure::Enclosure;
use crate::ir::extent::{Extent, extent};
use crate::ir::graph::NodeId;
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use crate::syntax::tree::BinaryOp;
use slowlight_routine::Op;
use std::rc::Rc;

/// How many nodes are evaluated at most: for a shape's box, which no more than a quarter of what
/// is left is spent for, and for all of a lowering.
const WORK: u64 = 1_500_000;
pub(super) const ALL_WORK: u64 = 10_000_000;

/// A shape's surface is where its distance is below this, at least; and that far outside of
/// their boxes rays begin.
const LEVEL: f64 = 1.0 / 1024.0;

/// By what part of their width boxes are made larger, for the roundings of rays.
const ROOM: f64 = 1.0 / 1024.0;

/// A stretch of a ray: from where to where; none of it where it ends before it begins.
#[derive(Clone, Copy)]
pub(super) struct Stretch {
    pub(super) near: NodeId,
    pub(super) far: NodeId,
}

/// The boxes of all shapes of all scenes of a program that was checked without errors.
#[cfg(test)]
pub fn extents(program: &Program, options: &Options) -> Found<Vec<Option<Extent>>> {
    let mut found = Vec::new();
    let Some(image) = &program.image else {
        return Ok(found);
    };
    let mut lower = Lower::new(program, options, image);
    lower.declare_params(&mut Vec::new());
    for (k, scene) in program.scenes.iter().enumerate() {
        for shape in lower.shapes_of(SceneId(k), scene.span)? {
            found.push(lower.derived(&shape, 0.0, scene.span)?);
        }
    }
    Ok(found)
}

impl Lower<'_> {
    /// A box outside of which a shape's distance, or else its `f`, is above `level`, by what is
    /// derived and by what the scene says; none where not one of its faces is known, or nobody
    /// wants to know.
    pub(super) fn extent_of(
        &mut self,
        shape: &Rc<Shape>,
        level: f64,
        span: Span,
    ) -> Found<Option<Extent>> {
        if self.options.ways.unbounded {
            return Ok(None);
        }
        let derived = self.derived(shape, level, span)?;
        let said = match self.bound_of(shape, span)? {
            Some(bound) => self.derived(&bound, level, span)?,
            None => None,
        };
        Ok(match (derived, said) {
            (Some(derived), Some(said)) => Some(derived.meet(said)),
            (derived, said) => derived.or(said),
        })
    }

    /// What is above 0 outside of a shape: its distance, or else its `f`.
    pub(super) fn outside_of(&mut self, shape: &Rc<Shape>, span: Span) -> Option<Formula> {
        // A shape made of shapes may have a facet that those do not.
        let mut of = |kind| self.formula(shape, kind, span).ok().flatten();
        of(FacetKind::Dist).or_else(|| of(FacetKind::Implicit))
    }

    fn derived(&mut self, shape: &Rc<Shape>, level: f64, span: Span) -> Found<Option<Extent>> {
        let level = self.level(level);
        let Some(formula) = self.outside_of(shape, span) else {
            return Ok(None);
        };
        let key = (formula.root, level.to_bits());
        let found = match self.extents.get(&key) {
            Some(found) => *found,
            None => {
                let work = WORK.min(self.extent_work / 4);
                let mut enclosure = Enclosure::new(&self.b, formula.markers, formula.root, work);
                let found = extent(&mut enclosure, level);
                self.extent_work -= work - enclosure.left();
                self.extents.insert(key, found);
                found
            }
        };
        Ok((found != Extent::ALL).then_some(found))
    }

    fn bound_of(&mut self, shape: &Rc<Shape>, span: Span) -> Found<Option<Rc<Shape>>> {
        match self.facet_of(shape, FacetKind::Bound, Vec::new(), span)? {
            Some(Val::Shape(bound)) => Ok(Some(bound)),
            _ => Ok(None),
        }
    }

    pub(super) fn level(&self, asked: f64) -> f64 {
        asked.max(2.0 * self.options.offset).max(LEVEL)
    }

    /// Where a ray is within a box of a level, or that far outside.
    fn within(&mut self, of: Extent, level: f64, ray: &Val, span: Span) -> Found<Stretch> {
        let of = of.grown(ROOM, self.level(level));
        let from = self.part(ray.clone(), 0, span)?;
        let dir = self.part(ray.clone(), 1, span)?;
        let (from, dir) = (self.vector(from, 3, span)?, self.vector(dir, 3, span)?);
        let mut found: Option<Stretch> = None;
        for (k, (from, dir)) in from.into_iter().zip(dir).enumerate() {
            let Some(here) = self.between((of.low[k], of.high[k]), from, dir, span)? else {
                continue;
            };
            found = Some(match found {
                Some(so_far) => self.meet_stretches(so_far, here, span)?,
                None => here,
            });
        }
        found.ok_or_else(|| self.confused(span))
    }

    /// Where one coordinate of a ray is between two faces; none if both are at infinity.
    fn between(
        &mut self,
        (low, high): (f64, f64),
        from: NodeId,
        dir: NodeId,
        span: Span,
    ) -> Found<Option<Stretch>> {
        let (name, gap, more) = match (low.is_finite(), high.is_finite()) {
            (false, false) => return Ok(None),
            (true, true) => {
                let (low, high) = (self.real(low, span), self.real(high, span));
                let low = self.scalar(BinaryOp::Sub, &Ty::Real, low, from, span)?;
                let high = self.scalar(BinaryOp::Sub, &Ty::Real, high, from, span)?;
                ("between_faces", low, vec![high, dir])
            }
            (false, true) => {
                let high = self.real(high, span);
                let gap = self.scalar(BinaryOp::Sub, &Ty::Real, high, from, span)?;
                ("before_face", gap, vec![dir])
            }
            (true, false) => {
                let low = self.real(low, span);
                let gap = self.scalar(BinaryOp::Sub, &Ty::Real, from, low, span)?;
                ("before_face", gap, vec![self.apply(Op::Neg, &[dir], span)?])
            }
        };
        let is_along = self.b.value(dir).is_some_and(|dir| dir.real() == 0.0);
        let (name, args) = match (is_along, &more[..]) {
            (false, _) => (name, [vec![gap], more].concat()),
            (true, &[high, _]) => {
                let zero = self.real(0.0, span);
                let is_above = self.scalar(BinaryOp::Le, &Ty::Real, gap, zero, span)?;
                let is_below = self.scalar(BinaryOp::Le, &Ty::Real, zero, high, span)?;
                let no = self.bool(false, span);
                let inside = self.select(is_above, is_below, no, span);
                ("along_faces", vec![inside])
            }
            (true, _) => {
                let zero = self.real(0.0, span);
                let inside = self.scalar(BinaryOp::Le, &Ty::Real, zero, gap, span)?;
                ("along_faces", vec![inside])
            }
        };
        let args = args.into_iter().map(Val::Node).collect();
        let chord = self.library(name, if is_along { Ty::Bool } else { Ty::Real }, args, span)?;
        let near = self.part(chord.clone(), 0, span)?;
        let far = self.part(chord, 1, span)?;
        Ok(Some(Stretch {
            near: self.node(near, &Ty::Real, span)?,
            far: self.node(far, &Ty::Real, span)?,
        }))
    }

    fn meet_stretches(&mut self, a: Stretch, b: Stretch, span: Span) -> Found<Stretch> {
        Ok(Stretch {
            near: self.apply(Op::Max, &[a.near, b.near], span)?,
            far: self.apply(Op::Min, &[a.far, b.far], span)?,
        })
    }

    /// Where a ray ahead of it, as far as `far`, may meet a shape that is found by its distance
    /// alone; none where nothing is known of that.
    pub(super) fn stretch_of(
        &mut self,
        shape: &Rc<Shape>,
        ray: &Val,
        far: NodeId,
        span: Span,
    ) -> Found<Option<Stretch>> {
        let Some(of) = self.extent_of(shape, 0.0, span)? else {
            return Ok(None);
        };
        let within = self.within(of, 0.0, ray, span)?;
        self.ahead(within, far, span).map(Some)
    }

    /// Where a ray ahead of it is in a shape's box; none where that is open.
    pub(super) fn stretch_across(
        &mut self,
        shape: &Rc<Shape>,
        ray: &Val,
        span: Span,
    ) -> Found<Option<Stretch>> {
        let of = self.derived(shape, 0.0, span)?;
        let Some(of) = of.filter(Extent::is_finite) else {
            return Ok(None);
        };
        let far = self.real(f64::MAX, span);
        let within = self.within(of, 0.0, ray, span)?;
        self.ahead(within, far, span).map(Some)
    }

    fn ahead(&mut self, of: Stretch, far: NodeId, span: Span) -> Found<Stretch> {
        let near = self.real(0.0, span);
        self.meet_stretches(of, Stretch { near, far }, span)
    }

    /// The same of any of a scene's shapes, where distances below `level` are hits; none where
    /// one of them has no end: most rays that are sent there meet it.
    pub(super) fn stretch_of_any(
        &mut self,
        shapes: &[Rc<Shape>],
        level: f64,
        (ray, far): (&Val, NodeId),
        span: Span,
    ) -> Found<Option<Stretch>> {
        let mut all: Option<Extent> = None;
        for shape in shapes {
            match self.extent_of(shape, level, span)? {
                Some(of) if of.is_finite() => all = Some(all.map_or(of, |all| all.join(of))),
                _ => return Ok(None),
            }
        }
        let Some(all) = all else {
            return Ok(None);
        };
        let within = self.within(all, level, ray, span)?;
        self.ahead(within, far, span).map(Some)
    }
}
