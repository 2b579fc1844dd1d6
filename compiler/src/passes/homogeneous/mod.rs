//! Homogeneous: directions are held at the length that they have anyway.
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
//! All of that is equal over the reals where r > 0, which the ranges must prove.
//! (Homogeneous coordinates: Möbius, Der barycentrische Calcul, 1827.)

use super::algebra::Whole;
use super::rate::{Dependence, Rates, rates};
use super::rebuild::{End, Rewrite, rebuild_by};
use crate::flow::build::Builder;
use crate::flow::graph::*;
use crate::range::Ranges;
use crate::source::Span;
use slowlight_routine::{Op, Range, Type, Value};
use std::collections::HashMap;

/// Degrees stay within this; what would leave it is brought to 0.
const DEGREES: i32 = 6;

/// The lengths that vectors of a graph are divided by: roots of what is proved
/// above 0, each of them the divisor of several values.
pub fn lengths(graph: &Graph, ranges: &Ranges) -> Vec<NodeId> {
    let rates = rates(graph);
    let reached = graph.reached();
    let mut divided: HashMap<NodeId, u32> = HashMap::new();
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
/// held at that length.
pub fn homogeneous(graph: &Graph, ranges: &Ranges, length: NodeId) -> Graph {
    let Node::Apply(Op::Sqrt, [square, _]) = graph.node(length) else {
        return graph.clone();
    };
    let divided = graph.ids().filter_map(|id| match graph.node(id) {
        Node::Apply(Op::Div, [v, r]) if r == length => Some(v),
        _ => None,
    });
    let whole = Whole::new(graph, ranges, &divided.collect::<Vec<_>>());
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
        held: HashMap::new(),
    };
    pass.learn();
    pass.count();
    pass.learn();
    rebuild_by(graph, &mut pass)
}

/// By how much a bound is moved away, as a part of it, for what roundings do.
const MARGIN: f64 = 1e-6;

/// A value in so many products may be a scalar that vectors are multiplied by.
const VECTOR: u32 = 3;

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
    held: HashMap<(NodeId, i32), NodeId>,
}

type Made<'m> = &'m [Option<NodeId>];

impl Pass<'_> {
    fn of(&self, id: NodeId) -> Degree {
        self.degrees.get(id.0 as usize).copied().flatten()
    }

    /// Finds every value's degree.
    fn learn(&mut self) {
        self.degrees.clear();
        for id in self.graph.ids() {
            let degree = self.degree(id);
            self.degrees.push(degree);
        }
    }

    /// Counts the products of values that are both of a degree.
    fn count(&mut self) {
        let reached = self.graph.reached();
        for id in self.graph.ids().filter(|id| reached[id.0 as usize]) {
            if let Node::Apply(Op::Mul, [a, b]) = self.graph.node(id)
                && self.even(a, b)
            {
                self.products[a.0 as usize] += 1;
                self.products[b.0 as usize] += 1;
            }
        }
    }

    /// Whether two different values are both of a degree, and their product of
    /// an even one.
    fn even(&self, a: NodeId, b: NodeId) -> bool {
        let of = |id| self.of(id).unwrap_or(0);
        a != b && of(a) != 0 && of(b) != 0 && (of(a) + of(b)) % 2 == 0
    }

    /// The degree at which a value comes cheapest, those before it known.
    fn degree(&self, id: NodeId) -> Degree {
        if self.graph.ty(id) != Type::Real {
            return Some(0);
        }
        if id == self.length {
            return Some(1);
        }
        let found = match self.graph.node(id) {
            Node::Const(c) if c.value().real() == 0.0 => return None,
            Node::Apply(op, [a, b]) => match op {
                Op::Mul if self.scalar(a, b).is_some() => 0,
                Op::Mul => self.of(a)? + self.of(b)?,
                Op::Div => self.of(a)? - self.of(b).unwrap_or(0),
                Op::Neg | Op::Abs => self.of(a)?,
                Op::Sqrt => self.of(a)?.div_euclid(2),
                Op::Add | Op::Sub | Op::Min | Op::Max => self.together(a, b)?,
                _ => 0,
            },
            Node::Select { yes, no, .. } => self.together(yes, no)?,
            Node::Carried { of, index } | Node::Last { of, index } => self.start(of, index),
            Node::Result { of, index } => self.result(of, index)?,
            _ => 0,
        };
        Some(if found.abs() > DEGREES { 0 } else { found })
    }

    /// The degree of what two values come together in.
    fn together(&self, a: NodeId, b: NodeId) -> Degree {
        match (self.of(a), self.of(b)) {
            (None, other) | (other, None) => other,
            (Some(x), Some(y)) if x == y => Some(x),
            // A root is brought to any degree without a root more.
            (Some(x), Some(y)) if (x - y) % 2 != 0 && self.pliant(a) != self.pliant(b) => {
                Some(if self.pliant(a) { y } else { x })
            }
            (Some(0), _) | (_, Some(0)) => Some(0),
            (Some(x), Some(y)) => Some(x.max(y)),
        }
    }

    /// The factor of a product that is worth bringing to another degree, so that
    /// the product is of degree 0, and the other one: what is multiplied by a vector.
    fn scalar(&self, a: NodeId, b: NodeId) -> Option<(NodeId, NodeId)> {
        if !self.even(a, b) {
            return None;
        }
        let products = |id: NodeId| self.products[id.0 as usize];
        let rank = |id: NodeId| (products(id), id);
        let (scalar, other) = match rank(a) > rank(b) {
            true => (a, b),
            false => (b, a),
        };
        (products(scalar) >= VECTOR).then_some((scalar, other))
    }

    fn pliant(&self, id: NodeId) -> bool {
        match self.graph.node(id) {
            Node::Apply(Op::Sqrt, _) => true,
            Node::Apply(Op::Neg, [a, _]) => self.pliant(a),
            _ => false,
        }
    }

    fn start(&self, of: LoopId, index: u32) -> i32 {
        let init = self.graph.loops.get(of.0 as usize);
        let init = init.and_then(|l| l.init.get(index as usize));
        init.and_then(|id| self.of(*id)).unwrap_or(0)
    }

    fn result(&self, of: LoopId, index: u32) -> Degree {
        let turns = self.graph.loops.get(of.0 as usize)?;
        let at = index as usize;
        self.together(*turns.done.get(at)?, *turns.otherwise.get(at)?)
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

    /// A comparison, its sides brought to one degree.
    fn compared(
        &mut self,
        b: &mut Builder,
        made: Made<'_>,
        op: Op,
        [x, y]: [NodeId; 2],
        span: Span,
    ) -> Option<NodeId> {
        let (dx, dy) = match (self.of(x), self.of(y)) {
            (Some(dx), Some(dy)) => (dx, dy),
            (dx, dy) => {
                let one = dx.or(dy).unwrap_or(0);
                (one, one)
            }
        };
        if let Some(found) = self.tabled(b, made, op, [x, y], span) {
            return Some(found);
        }
        let constant = |id| self.graph.constant(id).map(Value::real);
        let degree = match (constant(x), constant(y)) {
            (Some(c), None) if (dx - dy) % 2 != 0 => {
                return self.bounded(b, made, op, (c, true), (y, dy), span);
            }
            (None, Some(c)) if (dx - dy) % 2 != 0 => {
                return self.bounded(b, made, op, (c, false), (x, dx), span);
            }
            (Some(_), None) => dy,
            (None, Some(_)) => dx,
            _ if dx == dy => dx,
            _ if dx == 0 || dy == 0 => 0,
            _ => dx.max(dy),
        };
        let (x, y) = (self.at(b, made, x, degree)?, self.at(b, made, y, degree)?);
        Some(b.apply(op, &[x, y], span))
    }

    /// A comparison of a value at an odd degree, or of that and a constant, with an
    /// entry of a table: of squares with their signs, a|a|, the table's worked
    /// out beforehand.
    fn tabled(
        &mut self,
        b: &mut Builder,
        made: Made<'_>,
        op: Op,
        [x, y]: [NodeId; 2],
        span: Span,
    ) -> Option<NodeId> {
        let plain = |id: NodeId| made.get(id.0 as usize).copied().flatten();
        let looked = |id: NodeId| match self.graph.node(id) {
            Node::Lookup { table, column, row } => Some((table, column, row)),
            _ => None,
        };
        let (value, (table, column, row), first) = match (looked(x), looked(y)) {
            (None, Some(entry)) => (x, entry, true),
            (Some(entry), None) => (y, entry, false),
            _ => return None,
        };
        let carried = |d: &Dependence| matches!(d, Dependence::Loop(_) | Dependence::Last(_));
        if !self.rates.rate(value).iter().any(carried) {
            return None; // What algebra can look into.
        }
        let (value, more) = self.apart(value);
        let degree = self.of(value).filter(|degree| degree % 2 != 0)?;
        let cells = self.graph.tables.get(table.0 as usize)?;
        let square = |e: &Constant| {
            let rest = e.value().real() - more;
            Constant::new(Value::Real(rest * rest.abs()))
        };
        let table = b.table(Table {
            ty: Type::Real,
            entries: cells.entries.iter().map(square).collect(),
            ..cells.clone()
        });
        let entry = b.lookup(table, plain(column)?, plain(row)?, span);
        let value = plain(value)?;
        let square = self.square(b, made, value, degree, span)?;
        let pair = if first {
            [square, entry]
        } else {
            [entry, square]
        };
        Some(b.apply(op, &pair, span))
    }

    /// A value and what constant is added to it.
    fn apart(&self, id: NodeId) -> (NodeId, f64) {
        let constant = |id| self.graph.constant(id).map(Value::real);
        match self.graph.node(id) {
            Node::Apply(Op::Add, [a, b]) => match (constant(a), constant(b)) {
                (Some(c), None) => (b, c),
                (None, Some(c)) => (a, c),
                _ => (id, 0.0),
            },
            Node::Apply(Op::Sub, [a, b]) => (constant(b)).map_or((id, 0.0), |c| (a, -c)),
            _ => (id, 0.0),
        }
    }

    /// x|x| at degree 0 of a value that is held at a degree.
    fn square(
        &mut self,
        b: &mut Builder,
        made: Made<'_>,
        value: NodeId,
        degree: i32,
        span: Span,
    ) -> Option<NodeId> {
        let size = b.apply(Op::Abs, &[value], span);
        let square = b.apply(Op::Mul, &[value, size], span);
        self.power(b, made, square, 2 * degree, span)
    }

    /// A comparison with a constant at an odd degree: by what the length stays
    /// within where that decides, else of squares with their signs, a|a|.
    fn bounded(
        &mut self,
        b: &mut Builder,
        made: Made<'_>,
        op: Op,
        (constant, first): (f64, bool),
        (id, degree): (NodeId, i32),
        span: Span,
    ) -> Option<NodeId> {
        let plain = |id: NodeId| made.get(id.0 as usize).copied().flatten();
        let x = plain(id)?;
        let real = |b: &mut Builder, x: f64| b.constant(Value::Real(x), span);
        let pair = |x: NodeId, y: NodeId| if first { [x, y] } else { [y, x] };
        let square = self.square(b, made, x, degree, span)?;
        let limit = real(b, constant * constant.abs());
        let exact = b.apply(op, &pair(limit, square), span);
        if op == Op::Equal {
            return Some(exact);
        }
        let ends = [self.bounds.lo, self.bounds.hi].map(|r| constant * r.powi(-degree));
        // A little more, for what roundings do to them.
        let wide = MARGIN * ends[0].abs().max(ends[1].abs());
        let low = real(b, ends[0].min(ends[1]) - wide);
        let high = real(b, ends[0].max(ends[1]) + wide);
        let [sure, never] = match first {
            true => [[high, x], [x, low]],
            false => [[x, low], [high, x]],
        };
        let [sure, never] = [sure, never].map(|pair| b.apply(Op::Less, &pair, span));
        let [yes, no] = [true, false].map(|t| b.constant(Value::Bool(t), span));
        let rest = b.select(never, no, exact, span);
        Some(b.select(sure, yes, rest, span))
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
                        b.apply(op, &[scalar, plain(other)?], span)
                    }
                    Op::Mul if sum == own => b.apply(op, &[plain(x)?, plain(y)?], span),
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

impl Rewrite for Pass<'_> {
    fn node(
        &mut self,
        b: &mut Builder,
        made: Made<'_>,
        id: NodeId,
        _moved: Node,
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
                let Node::Carried { of, index } = _moved else {
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
            End::Output => 0,
        };
        self.at(b, made, id, degree)
    }
}
