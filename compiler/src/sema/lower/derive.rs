//! What follows from a facet: the exact gradient, and the polynomial along a ray.
//!
//! A facet is lowered once with three *markers* for the point. The nodes
//! between the markers and the result are then read as a formula:
//! [`Lower::gradient`] differentiates it at a point, and [`Lower::polynomial`]
//! collects it in powers of the distance along a ray.

use super::value::{Shape, Val};
use super::{Found, Lower};
use crate::ir::graph::{Node, NodeId};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use slowlight_routine::{Op, Type};
use std::collections::BTreeSet;
use std::rc::Rc;

/// Where hits are told apart from what is so far off, or less, differences may stand for a gradient
/// which is none on the surface.
const NEAR: f64 = 1.0 / 256.0;

/// In so many times that: where it is a few last places, differences are noise, too.
const APART: f64 = 2.0;

/// How far apart they are at least. Where hits are told better, they stand for it only where one
/// is within such a part of the offset: there the surface is met to the last digits.
const EXACT: f64 = 1e-7;
const MET: f64 = 1e-3;

/// Three nodes that stand for a point's coordinates.
pub(super) type Markers = [NodeId; 3];

/// A facet's result in terms of the markers.
pub(super) struct Formula {
    pub(super) markers: Markers,
    pub(super) root: NodeId,
    /// Loops from this number on may run on the markers.
    pub(super) loops: u32,
}

/// Coefficients of 1, t and t^2; `None` is 0.
pub(super) type Coefficients = [Option<NodeId>; 3];

impl<'a> Lower<'a> {
    /// Nodes that nothing else is: the carried values of a loop that is never run.
    pub(super) fn markers(&mut self, span: Span) -> Markers {
        if let Some(markers) = self.markers {
            return markers;
        }
        let zero = self.real(0.0, span);
        let carried = ["p_x", "p_y", "p_z"].map(|name| (name.to_owned(), Type::Real, zero));
        let id = self.b.open_loop(1, &carried, span);
        self.loops = id.0 + 1;
        let markers = [0, 1, 2].map(|k| self.b.carried(id, k, span));
        self.markers = Some(markers);
        markers
    }

    /// A facet's result with markers for the point, if the shape has it.
    pub(super) fn formula(
        &mut self,
        shape: &Rc<Shape>,
        kind: FacetKind,
        span: Span,
    ) -> Found<Option<Formula>> {
        let markers = self.markers(span);
        let loops = self.loops;
        let point = Val::parts(markers.map(Val::Node).to_vec());
        match self.facet(shape, kind, point, span)? {
            Some(value) => Ok(Some(Formula {
                markers,
                root: self.node(value, &Ty::Real, span)?,
                loops,
            })),
            None => Ok(None),
        }
    }

    /// The nodes that a result needs, operands first; none where a loop is
    /// among them that the markers may run through.
    pub(super) fn needed(&self, formula: &Formula, roots: &[NodeId]) -> Option<BTreeSet<NodeId>> {
        let first = formula.markers.iter().min().copied();
        let mut seen = BTreeSet::new();
        let mut todo = roots.to_vec();
        while let Some(id) = todo.pop() {
            // What was made before the markers cannot depend on them.
            if Some(id) < first || !seen.insert(id) {
                continue;
            }
            let node = self.b.node(id);
            if let Node::Result { of, .. } = node
                && of.0 >= formula.loops
            {
                return None;
            }
            todo.extend(node.operands());
        }
        Some(seen)
    }

    /// The unit gradient of `f` or `dist` at a point, or what differences make of it.
    pub(super) fn derived_normal(
        &mut self,
        shape: &Rc<Shape>,
        p: Val,
        span: Span,
    ) -> Found<Option<Val>> {
        let (formula, is_distance) = match self.formula(shape, FacetKind::Implicit, span)? {
            Some(found) => (Some(found), false),
            None => (self.formula(shape, FacetKind::Dist, span)?, true),
        };
        let Some(formula) = formula else {
            return Ok(None);
        };
        if let Some(apart) = self.options.ways.differences {
            let sloped = self.sloped("sloped", (shape, p), apart.value(), span);
            return sloped.map(Some);
        }
        let offset = self.options.offset;
        // Formats that cannot tell points so near stop before the surface.
        let may_be = is_distance && self.is_met && offset <= NEAR;
        let singular = may_be && self.vanishes(&formula);
        if singular && offset >= EXACT {
            let apart = APART * offset;
            let sloped = self.sloped("sloped_distance", (shape, p), apart, span);
            return sloped.map(Some);
        }
        let Ok(point) = Markers::try_from(self.vector(p.clone(), 3, span)?) else {
            return Err(self.confused(span));
        };
        let gradient = self.gradient(&formula, &point, span)?;
        let gradient = Val::parts(gradient.map(Val::Node).to_vec());
        let normal = self.library("unit", Ty::Vector(3), vec![gradient], span)?;
        if !singular {
            return Ok(Some(normal));
        }
        // Exact, but where a hit has met the surface to the last digits.
        let Some(distance) = self.facet(shape, FacetKind::Dist, p.clone(), span)? else {
            return Err(self.confused(span));
        };
        let distance = self.node(distance, &Ty::Real, span)?;
        let distance = self.b.apply(Op::Abs, &[distance], span);
        let offset = self.real(MET * offset, span);
        let met = self.b.apply(Op::Less, &[distance, offset], span);
        let sloped = self.sloped("sloped_evenly", (shape, p), EXACT, span)?;
        let (near, far) = (self.vector(sloped, 3, span)?, self.vector(normal, 3, span)?);
        let parts = near.into_iter().zip(far);
        let parts = parts.map(|(near, far)| Val::Node(self.select(met, near, far, span)));
        Ok(Some(Val::parts(parts.collect())))
    }

    /// What a library function makes of differences so far apart in place of a gradient.
    fn sloped(
        &mut self,
        by: &'static str,
        (shape, p): (&Rc<Shape>, Val),
        apart: f64,
        span: Span,
    ) -> Found<Val> {
        let apart = Val::Node(self.real(apart, span));
        self.library(
            by,
            Ty::Shape,
            vec![Val::Shape(shape.clone()), p, apart],
            span,
        )
    }

    /// The hit of an implicit function of degree 2 at most along the ray.
    pub(super) fn derived_root(
        &mut self,
        shape: &Rc<Shape>,
        ray: &Val,
        span: Span,
    ) -> Found<Option<Val>> {
        let Some(formula) = self.formula(shape, FacetKind::Implicit, span)? else {
            return Ok(None);
        };
        let from = self.part(ray.clone(), 0, span)?;
        let dir = self.part(ray.clone(), 1, span)?;
        let (from, dir) = (self.vector(from, 3, span)?, self.vector(dir, 3, span)?);
        let Some([c, b, a]) = self.polynomial(&formula, &from, &dir, span)? else {
            return Ok(None);
        };
        let zero = self.real(0.0, span);
        let args = [a, b, c].map(|n| Val::Node(n.unwrap_or(zero))).to_vec();
        self.library("least_root", Ty::Real, args, span).map(Some)
    }

    /// Calls a function of the library that the compiler itself relies on.
    pub(super) fn library(
        &mut self,
        name: &str,
        first: Ty,
        args: Vec<Val>,
        span: Span,
    ) -> Found<Val> {
        let program = self.program;
        let found = program.functions.iter().find(|f| {
            let fits = f.params.first().is_some_and(|p| p.ty == first);
            f.library && f.name == name && fits && f.params.len() == args.len()
        });
        match found {
            Some(function) => self.expand(function, args, span),
            None => {
                let error = self.error(span, format!("the library has no function `{name}`"));
                Err(Box::new(error))
            }
        }
    }
}
