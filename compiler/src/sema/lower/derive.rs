//! What follows from a facet: the exact gradient, and the polynomial along a ray.
//!
//! A facet is lowered once with three *markers* for the point. The nodes
//! between the markers and the result are then read as a formula: [`Lower::gradient`]
//! differentiates it (forward, one component at a time), [`Lower::polynomial`]
//! collects it in powers of the distance along a ray, and
//! [`Lower::substitute`] puts a point in the markers' place.

use super::value::{Shape, Val};
use super::{Found, Lower};
use crate::flow::graph::{Node, NodeId};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use slowlight_routine::{Op, Type};
use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;

/// Three nodes that stand for a point's coordinates.
pub(super) type Markers = [NodeId; 3];

/// A facet's result in terms of the markers.
pub(super) struct Formula {
    pub(super) markers: Markers,
    pub(super) root: NodeId,
    /// Loops from this number on may run on the markers.
    loops: u32,
}

/// Coefficients of 1, t and t^2; `None` is 0.
pub(super) type Coefficients = [Option<NodeId>; 3];

impl<'a> Lower<'a> {
    /// Nodes that nothing else is: the carried values of a loop that is never run.
    fn markers(&mut self, span: Span) -> Markers {
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
    fn formula(
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

    /// The unit gradient of `f` or `dist` at a point.
    pub(super) fn derived_normal(
        &mut self,
        shape: &Rc<Shape>,
        p: Val,
        span: Span,
    ) -> Found<Option<Val>> {
        let formula = match self.formula(shape, FacetKind::Implicit, span)? {
            Some(found) => Some(found),
            None => self.formula(shape, FacetKind::Dist, span)?,
        };
        let Some(formula) = formula else {
            return Ok(None);
        };
        let Some(gradient) = self.gradient(&formula, span)? else {
            return Ok(None);
        };
        let point = self.vector(p, 3, span)?;
        let Ok(point) = Markers::try_from(point) else {
            return Err(self.confused(span));
        };
        let gradient = self.substitute(&formula, &gradient, &point, span)?;
        let gradient = Val::parts(gradient.into_iter().map(Val::Node).collect());
        self.library("unit", Ty::Vector(3), vec![gradient], span)
            .map(Some)
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

    /// The derivatives by the three markers; none where the formula has a loop.
    fn gradient(&mut self, formula: &Formula, span: Span) -> Found<Option<Vec<NodeId>>> {
        let Some(nodes) = self.needed(formula, &[formula.root]) else {
            return Ok(None);
        };
        let one = self.real(1.0, span);
        let zero = self.real(0.0, span);
        let mut found = Vec::new();
        for marker in formula.markers {
            let mut slopes: HashMap<NodeId, NodeId> = HashMap::from([(marker, one)]);
            for &id in &nodes {
                if let Some(slope) = self.slope(id, &slopes, span)? {
                    slopes.insert(id, slope);
                }
            }
            found.push(slopes.get(&formula.root).copied().unwrap_or(zero));
        }
        Ok(Some(found))
    }

    /// The slope of one node from those of its operands; none where it is 0.
    fn slope(
        &mut self,
        id: NodeId,
        slopes: &HashMap<NodeId, NodeId>,
        span: Span,
    ) -> Found<Option<NodeId>> {
        self.step(span)?;
        let span = self.at(span);
        if slopes.contains_key(&id) {
            return Ok(None);
        }
        let (op, [a, b]) = match self.b.node(id) {
            Node::Apply(op, args) => (op, args),
            Node::Select { cond, yes, no } => {
                let (y, n) = (slopes.get(&yes).copied(), slopes.get(&no).copied());
                if y.is_none() && n.is_none() {
                    return Ok(None);
                }
                let zero = self.real(0.0, span);
                let slope = self.select(cond, y.unwrap_or(zero), n.unwrap_or(zero), span);
                return Ok(Some(slope));
            }
            _ => return Ok(None),
        };
        let (da, db) = (slopes.get(&a).copied(), slopes.get(&b).copied());
        let db = if op.arity() > 1 { db } else { None };
        if da.is_none() && db.is_none() {
            return Ok(None);
        }
        Ok(self.rule(op, id, [a, b], [da, db], span))
    }

    /// The rule of differentiation of one operation: `value` is its result,
    /// `da` and `db` its operands' slopes (none: 0).
    fn rule(
        &mut self,
        op: Op,
        value: NodeId,
        [a, b]: [NodeId; 2],
        [da, db]: [Option<NodeId>; 2],
        span: Span,
    ) -> Option<NodeId> {
        let mut on = |op: Op, args: &[NodeId]| self.b.apply(op, args, span);
        match op {
            Op::Add | Op::Sub => match (da, db) {
                (Some(x), Some(y)) => Some(on(op, &[x, y])),
                (Some(x), None) => Some(x),
                (None, Some(y)) if op == Op::Add => Some(y),
                (None, y) => y.map(|y| on(Op::Neg, &[y])),
            },
            Op::Neg => da.map(|x| on(Op::Neg, &[x])),
            Op::Mul => {
                let x = da.map(|x| on(Op::Mul, &[x, b]));
                let y = db.map(|y| on(Op::Mul, &[a, y]));
                match (x, y) {
                    (Some(x), Some(y)) => Some(on(Op::Add, &[x, y])),
                    (x, y) => x.or(y),
                }
            }
            Op::Div => {
                let y = db.map(|y| on(Op::Mul, &[value, y]));
                let top = match (da, y) {
                    (Some(x), Some(y)) => Some(on(Op::Sub, &[x, y])),
                    (x, None) => x,
                    (None, y) => y.map(|y| on(Op::Neg, &[y])),
                };
                top.map(|top| on(Op::Div, &[top, b]))
            }
            Op::Sqrt => da.map(|x| {
                let twice = on(Op::Add, &[value, value]);
                on(Op::Div, &[x, twice])
            }),
            Op::Abs => da.map(|x| {
                let sign = on(Op::Sign, &[a]);
                let sign = on(Op::ToReal, &[sign]);
                on(Op::Mul, &[sign, x])
            }),
            Op::Min | Op::Max => {
                // As the operations choose: the second only where it is strictly beyond.
                let second = match op {
                    Op::Min => on(Op::Less, &[b, a]),
                    _ => on(Op::Less, &[a, b]),
                };
                let zero = self.real(0.0, span);
                let (x, y) = (da.unwrap_or(zero), db.unwrap_or(zero));
                Some(self.select(second, y, x, span))
            }
            Op::Sin => da.map(|x| {
                let cos = on(Op::Cos, &[a]);
                on(Op::Mul, &[cos, x])
            }),
            Op::Cos => da.map(|x| {
                let sin = on(Op::Sin, &[a]);
                let product = on(Op::Mul, &[sin, x]);
                on(Op::Neg, &[product])
            }),
            Op::Tan => da.map(|x| {
                let square = on(Op::Mul, &[value, value]);
                let product = on(Op::Mul, &[square, x]);
                on(Op::Add, &[x, product])
            }),
            Op::Asin | Op::Acos => da.map(|x| {
                let one = self.real(1.0, span);
                let mut on = |op: Op, args: &[NodeId]| self.b.apply(op, args, span);
                let square = on(Op::Mul, &[a, a]);
                let rest = on(Op::Sub, &[one, square]);
                let root = on(Op::Sqrt, &[rest]);
                let slope = on(Op::Div, &[x, root]);
                if op == Op::Asin {
                    slope
                } else {
                    on(Op::Neg, &[slope])
                }
            }),
            Op::Atan2 => {
                let x = da.map(|x| on(Op::Mul, &[x, b]));
                let y = db.map(|y| on(Op::Mul, &[a, y]));
                let top = match (x, y) {
                    (Some(x), Some(y)) => Some(on(Op::Sub, &[x, y])),
                    (x, None) => x,
                    (None, y) => y.map(|y| on(Op::Neg, &[y])),
                };
                let (aa, bb) = (on(Op::Mul, &[a, a]), on(Op::Mul, &[b, b]));
                let square = on(Op::Add, &[aa, bb]);
                top.map(|top| on(Op::Div, &[top, square]))
            }
            Op::Exp => da.map(|x| on(Op::Mul, &[value, x])),
            Op::Log => da.map(|x| on(Op::Div, &[x, a])),
            Op::Pow => {
                // a^b (b a'/a + b' log a)
                let x = da.map(|x| {
                    let product = on(Op::Mul, &[b, x]);
                    on(Op::Div, &[product, a])
                });
                let y = db.map(|y| {
                    let log = on(Op::Log, &[a]);
                    on(Op::Mul, &[y, log])
                });
                let sum = match (x, y) {
                    (Some(x), Some(y)) => Some(on(Op::Add, &[x, y])),
                    (x, y) => x.or(y),
                };
                sum.map(|sum| on(Op::Mul, &[value, sum]))
            }
            // a - b floor(a/b): the floor does not change but by leaps.
            Op::Mod => match db {
                None => da,
                Some(y) => {
                    let quotient = on(Op::Div, &[a, b]);
                    let whole = on(Op::Floor, &[quotient]);
                    let whole = on(Op::ToReal, &[whole]);
                    let part = on(Op::Mul, &[whole, y]);
                    Some(match da {
                        Some(x) => on(Op::Sub, &[x, part]),
                        None => on(Op::Neg, &[part]),
                    })
                }
            },
            // Ints and bools change by leaps only.
            _ => None,
        }
    }

    /// The nodes with a point in the markers' place.
    fn substitute(
        &mut self,
        formula: &Formula,
        roots: &[NodeId],
        point: &Markers,
        span: Span,
    ) -> Found<Vec<NodeId>> {
        let Some(nodes) = self.needed(formula, roots) else {
            return Err(self.confused(span));
        };
        let mut now: HashMap<NodeId, NodeId> = formula
            .markers
            .into_iter()
            .zip(point.iter().copied())
            .collect();
        for id in nodes {
            self.step(span)?;
            if now.contains_key(&id) {
                continue;
            }
            let span = self.at(span);
            let of = |id: NodeId| now.get(&id).copied().unwrap_or(id);
            let new = match self.b.node(id) {
                Node::Apply(op, [a, b]) => {
                    let args = [of(a), of(b)];
                    match args == [a, b] {
                        true => id,
                        false => self
                            .b
                            .apply(op, args.get(..op.arity()).unwrap_or(&args), span),
                    }
                }
                Node::Select { cond, yes, no } => {
                    let (cond, yes, no) = (of(cond), of(yes), of(no));
                    self.select(cond, yes, no, span)
                }
                Node::Lookup { table, column, row } => {
                    let (column, row) = (of(column), of(row));
                    self.b.lookup(table, column, row, span)
                }
                _ => id,
            };
            now.insert(id, new);
        }
        Ok(roots
            .iter()
            .map(|r| now.get(r).copied().unwrap_or(*r))
            .collect())
    }
}
