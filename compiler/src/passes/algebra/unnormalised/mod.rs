//! Homogeneous coordinates for directions: they are held at the length that they have anyway.
//!
//! A normalised vector v/r, r = |v|, costs a root and three divisions, and most
//! of what is done with it does not care for its length: where a ray meets a
//! sphere, whether it does, how it is reflected. With n = r*r at hand, which
//! needs no root, every value x of degree k in that length is held as x' with
//! x = x' r^k: the direction is of degree -1 and held as v itself, what is
//! multiplied by it adds its degree, the root of a value halves it, and a
//! distance along the ray that is of degree 1 goes with the direction to a
//! point of degree 0. Sums and comparisons want terms of one degree, which one
//! of them is brought to: by n where the degrees differ by an even number, by r
//! itself where they do not; but for a root, whose own argument is brought to it
//! by n. A comparison with a constant looks first at what r stays within.
//!
//! A vector that a number makes whole is held as whole numbers: so is then much of
//! what is computed from it.
//!
//! All of that is equal over the reals where r > 0, which the ranges must prove,
//! but for quotients by 0: x/0 is the largest number at whatever length x is held.
//! (Homogeneous coordinates: Möbius, Der barycentrische Calcul, 1827.)

mod compare;
mod degrees;
#[cfg(test)]
mod tests;

use crate::analysis::range::Ranges;
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::{Number, Whole};
use crate::passes::rewrite::rebuild::{End, Rewrite, rebuild_by};
use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Range, Type, Value};

/// The lengths that vectors of a graph are divided by: roots of what is proved
/// above 0, each of them the divisor of several values.
pub fn lengths(graph: &Graph, ranges: &Ranges) -> Vec<NodeId> {
    let rates = rates(graph);
    let reached = graph.reached();
    let mut divided: FxHashMap<NodeId, u32> = FxHashMap::default();
    for id in graph.ids().filter(|id| reached[id.0 as usize]) {
        if let Node::Apply(Op::Div, [_, r]) = graph.node(id) {
            *divided.entry(r).or_default() += 1;
        }
    }
    let fits = |id: &NodeId| {
        let free = |d: &Dependence| !matches!(d, Dependence::Loop(_) | Dependence::Last(_));
        let above = ranges.args[id.0 as usize][0].lo > 0.0 && ranges.result[id.0 as usize].lo > 0.0;
        let root = matches!(graph.node(*id), Node::Apply(Op::Sqrt, _));
        let many = divided.get(id).is_some_and(|n| *n >= 2);
        root && many && above && rates.rate(*id).iter().all(free)
    };
    graph.ids().filter(fits).collect()
}

/// The graph with every value that depends on a vector divided by `length`
/// held at that length; and, where that is another graph, at one at which its products
/// with other vectors are whole, too.
pub fn unnormalised(
    graph: &Graph,
    ranges: &Ranges,
    length: NodeId,
) -> Option<(Graph, Option<Graph>)> {
    let Node::Apply(Op::Sqrt, [square, _]) = graph.node(length) else {
        return None;
    };
    let divided = graph.ids().filter_map(|id| match graph.node(id) {
        Node::Apply(Op::Div, [v, r]) if r == length => Some(v),
        _ => None,
    });
    let divided: Vec<NodeId> = divided.collect();
    let whole = Whole::new(graph, ranges, &divided);
    let held = |whole| held(graph, ranges, [length, square], whole);
    let first = held(whole.clone());
    Some((first, whole.with_products(length).map(held)))
}

/// The graph with what depends on a vector held at its length times a number.
fn held(graph: &Graph, ranges: &Ranges, of: [NodeId; 2], whole: Whole<'_>) -> Graph {
    let [length, square] = of;
    let by = whole.by;
    let bounds = ranges.result[length.0 as usize];
    let mut pass = Pass {
        graph,
        length,
        square,
        rates: rates(graph),
        whole,
        by,
        bounds: Range::new(bounds.lo * by, bounds.hi * by),
        degrees: Vec::with_capacity(graph.nodes.len()),
        products: vec![0; graph.nodes.len()],
        held: FxHashMap::default(),
    };
    pass.learn();
    pass.count();
    pass.learn();
    rebuild_by(graph, &mut pass)
}

/// A value's degree; none for 0, which is of every degree.
type Degree = Option<i32>;

struct Pass<'g> {
    graph: &'g Graph,
    length: NodeId,
    /// What the length is the root of.
    square: NodeId,
    rates: Rates,
    whole: Whole<'g>,
    /// What the vector is multiplied by, above 0: the length is so much greater.
    by: f64,
    /// Between which bounds the length stays, above 0.
    bounds: Range,
    degrees: Vec<Degree>,
    /// In how many products of two values of a degree each is.
    products: Vec<u32>,
    /// What holds an old value at a degree other than its own.
    held: FxHashMap<(NodeId, i32), NodeId>,
}

type Made<'m> = &'m [Option<NodeId>];

impl Pass<'_> {
    fn of(&self, id: NodeId) -> Degree {
        self.degrees.get(id.0 as usize).copied().flatten()
    }

    /// What holds an old value at a degree.
    fn at(&mut self, b: &mut Builder, made: Made<'_>, id: NodeId, degree: i32) -> Option<NodeId> {
        let plain = made.get(id.0 as usize).copied().flatten();
        let own = match self.graph.ty(id) {
            Type::Real => self.of(id),
            _ => return plain,
        };
        if own.is_none_or(|own| own == degree) {
            return plain;
        }
        if let Some(held) = self.held.get(&(id, degree)) {
            return Some(*held);
        }
        let node = self.brought(b, made, id, own?, degree)?;
        self.held.insert((id, degree), node);
        self.direct(b, id, node, degree);
        Some(node)
    }

    fn brought(
        &mut self,
        b: &mut Builder,
        made: Made<'_>,
        id: NodeId,
        own: i32,
        degree: i32,
    ) -> Option<NodeId> {
        let span = self.graph.span(id);
        match self.graph.node(id) {
            Node::Apply(Op::Sqrt, [x, _]) if id != self.length => {
                let x = self.at(b, made, x, 2 * degree)?;
                Some(b.apply(Op::Sqrt, &[x], span))
            }
            Node::Apply(Op::Neg, [x, _]) => {
                let x = self.at(b, made, x, degree)?;
                Some(b.apply(Op::Neg, &[x], span))
            }
            // A term is there at that degree: the other one is brought to it.
            Node::Apply(op @ (Op::Add | Op::Sub | Op::Min | Op::Max), [x, y])
                if self.of(x) == Some(degree) || self.of(y) == Some(degree) =>
            {
                let (x, y) = (self.at(b, made, x, degree)?, self.at(b, made, y, degree)?);
                Some(b.apply(op, &[x, y], span))
            }
            _ => {
                let plain = made.get(id.0 as usize).copied().flatten()?;
                self.power(b, made, plain, own - degree, span)
            }
        }
    }

    fn scaled(&self, b: &mut Builder, value: NodeId, by: f64, span: Span) -> NodeId {
        if by == 1.0 {
            return value;
        }
        let by = b.constant(Value::Real(by), span);
        b.apply(Op::Mul, &[value, by], span)
    }

    /// A value times a power of the length.
    fn power(
        &mut self,
        b: &mut Builder,
        made: Made<'_>,
        mut value: NodeId,
        power: i32,
        span: Span,
    ) -> Option<NodeId> {
        let square = made.get(self.square.0 as usize).copied().flatten()?;
        let square = self.scaled(b, square, self.by * self.by, span);
        let op = if power > 0 { Op::Mul } else { Op::Div };
        for _ in 0..power.abs() / 2 {
            value = b.apply(op, &[value, square], span);
        }
        if power % 2 != 0 {
            let root = b.apply(Op::Sqrt, &[square], span);
            value = b.apply(op, &[value, root], span);
        }
        Some(value)
    }

    /// Says how long a direction is that is held at a degree.
    fn direct(&self, b: &mut Builder, id: NodeId, node: NodeId, degree: i32) {
        if let Some(length) = self.graph.directions.get(&id) {
            let most = match degree < 0 {
                true => self.bounds.hi,
                false => self.bounds.lo,
            };
            b.direction(node, length * most.powi(-degree));
        }
    }

    /// A real value at its own degree.
    fn value(&mut self, b: &mut Builder, made: Made<'_>, id: NodeId, span: Span) -> Option<NodeId> {
        let own = self.of(id).unwrap_or(0);
        if id == self.length {
            return Some(b.constant(Value::Real(1.0 / self.by), span));
        }
        let plain = |id: NodeId| made.get(id.0 as usize).copied().flatten();
        Some(match self.graph.node(id) {
            Node::Apply(op, args) => {
                let [x, y] = args;
                let sum = self.of(x).unwrap_or(0) + self.of(y).unwrap_or(0);
                let difference = self.of(x).unwrap_or(0) - self.of(y).unwrap_or(0);
                match op {
                    Op::Div if y == self.length => self.whole.put(b, &plain, x, span)?,
                    Op::Mul if let Some((scalar, other)) = self.scalar(x, y) => {
                        let degree = own - self.of(other)?;
                        let scalar = self.at(b, made, scalar, degree)?;
                        product(b, scalar, plain(other)?, span)
                    }
                    Op::Mul if sum == own => product(b, plain(x)?, plain(y)?, span),
                    Op::Div if difference == own => b.apply(op, &[plain(x)?, plain(y)?], span),
                    Op::Sqrt => {
                        let x = self.at(b, made, x, 2 * own)?;
                        b.apply(op, &[x], span)
                    }
                    Op::Neg | Op::Abs => b.apply(op, &[plain(x)?], span),
                    Op::Add | Op::Sub | Op::Min | Op::Max => {
                        let (x, y) = (self.at(b, made, x, own)?, self.at(b, made, y, own)?);
                        b.apply(op, &[x, y], span)
                    }
                    _ => self.applied(b, made, op, args, span)?,
                }
            }
            Node::Select { cond, yes, no } => {
                let (yes, no) = (self.at(b, made, yes, own)?, self.at(b, made, no, own)?);
                b.select(plain(cond)?, yes, no, span)
            }
            _ => return None,
        })
    }

    /// An operation that knows nothing of degrees.
    fn applied(
        &mut self,
        b: &mut Builder,
        made: Made<'_>,
        op: Op,
        args: [NodeId; 2],
        span: Span,
    ) -> Option<NodeId> {
        let mut held = Vec::with_capacity(2);
        for id in &args[..op.arity()] {
            held.push(self.at(b, made, *id, 0)?);
        }
        Some(b.apply(op, &held, span))
    }
}

/// a b. A number times a quotient of another by a whole number is one quotient where
/// the numbers' product is whole: one rounding instead of two, and none where it
/// divides.
fn product(b: &mut Builder, x: NodeId, y: NodeId, span: Span) -> NodeId {
    let number = |b: &Builder, id| b.value(id).map(|v| Number::of(v.real()));
    for (factor, quotient) in [(x, y), (y, x)] {
        if let Node::Apply(Op::Div, [over, by]) = b.node(quotient)
            && matches!(b.node(by), Node::Apply(Op::ToReal, _))
            && let (Some(factor), Some(over)) = (number(b, factor), number(b, over))
            && let both @ Number::Exact(_, 1) = factor.mul(over)
        {
            let both = b.constant(Value::Real(both.real()), span);
            return b.apply(Op::Div, &[both, by], span);
        }
    }
    b.apply(Op::Mul, &[x, y], span)
}

impl Rewrite for Pass<'_> {
    fn node(
        &mut self,
        b: &mut Builder,
        made: Made<'_>,
        id: NodeId,
        moved: Node,
        span: Span,
    ) -> Option<NodeId> {
        match self.graph.node(id) {
            Node::Apply(op @ (Op::Less | Op::LessEqual | Op::Equal), args) => {
                self.compared(b, made, op, args, span)
            }
            Node::Apply(Op::Sign, [x, _]) => {
                let x = made.get(x.0 as usize).copied().flatten()?;
                Some(b.apply(Op::Sign, &[x], span))
            }
            Node::Apply(op, args) if self.graph.ty(id) != Type::Real => {
                self.applied(b, made, op, args, span)
            }
            Node::Apply(..) | Node::Select { .. } if self.graph.ty(id) == Type::Real => {
                let node = self.value(b, made, id, span)?;
                if let Some(degree) = self.of(id).filter(|degree| *degree != 0) {
                    self.direct(b, id, node, degree);
                }
                Some(node)
            }
            Node::Carried { .. } => {
                let degree = self.of(id).filter(|degree| *degree != 0)?;
                let Node::Carried { of, index } = moved else {
                    return None;
                };
                let node = b.carried(of, index, span);
                self.direct(b, id, node, degree);
                Some(node)
            }
            _ => None,
        }
    }

    fn end(&mut self, b: &mut Builder, made: Made<'_>, id: NodeId, end: End) -> Option<NodeId> {
        let degree = match end {
            End::Carried(of, index) => self.start(of, index),
            End::Result(of, index) => self.result(of, index).unwrap_or(0),
            End::Ink | End::Output => 0,
        };
        self.at(b, made, id, degree)
    }
}
