//! Sines and cosines of arcs, by the addition theorems.
//!
//! The sine of an arc's multiple is a polynomial in the arc's own sine and cosine, and these are
//! what the arc was taken of, or a root of it: the angles that a fractal doubles, or the sector
//! that a spiral stair turns back, need neither the arc nor a series. What else is in the angle
//! must be constant, or hang on one int. (Abramowitz and Stegun, Handbook of mathematical
//! functions, 4.3.16, 4.3.17.)

use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use slowlight_routine::{Op, Value};

/// Up to which multiple: each doubling doubles what the arc's sine is off by.
const MOST: f64 = 16.0;

/// How far a multiple may be from a whole number: what decimals are off by.
const OFF: f64 = 1e-9;

/// How deep an angle is looked into.
const DEEP: u32 = 8;

/// The graph with such sines and cosines by products; nothing where it has none.
pub fn angle_addition(graph: &Graph) -> Option<Graph> {
    let mut found = false;
    let next = rebuild_old(graph, &mut |b, made, id, span| {
        let Node::Apply(op @ (Op::Sin | Op::Cos), [angle, _]) = graph.node(id) else {
            return None;
        };
        let turned = Turned::of(graph, angle)?;
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let mut out = Out { b, span };
        let put = out.of_angle(graph, &turned, &new)?;
        found = true;
        Some(if op == Op::Sin { put.sin } else { put.cos })
    });
    found.then_some(next)
}

/// An angle: so many times an arc, so many times an int, and a constant.
#[derive(Default)]
struct Turned {
    arc: Option<(NodeId, f64)>,
    int: Option<(NodeId, f64)>,
    more: f64,
}

impl Turned {
    fn of(graph: &Graph, angle: NodeId) -> Option<Turned> {
        let mut turned = Turned::default();
        turned.add(graph, angle, 1.0, DEEP)?;
        let (_, times) = turned.arc.as_mut()?;
        let whole = times.round();
        let fits = whole != 0.0 && whole.abs() <= MOST && (*times - whole).abs() <= OFF;
        *times = whole;
        fits.then_some(turned)
    }

    /// Adds so many times a value; nothing where there is more in it.
    fn add(&mut self, graph: &Graph, id: NodeId, times: f64, deep: u32) -> Option<()> {
        let deep = deep.checked_sub(1)?;
        let constant = |id: NodeId| graph.constant(id).map(Value::real);
        let one = |all: &mut Option<(NodeId, f64)>| {
            let (own, sum) = all.get_or_insert((id, 0.0));
            *sum += times;
            (*own == id).then_some(())
        };
        match graph.node(id) {
            Node::Const(constant) => self.more += times * constant.value().real(),
            Node::Apply(Op::Asin | Op::Acos | Op::Atan2, _) => one(&mut self.arc)?,
            Node::Apply(Op::ToReal, _) => one(&mut self.int)?,
            Node::Apply(op @ (Op::Add | Op::Sub), [a, b]) => {
                let sign = if op == Op::Sub { -1.0 } else { 1.0 };
                self.add(graph, a, times, deep)?;
                self.add(graph, b, sign * times, deep)?;
            }
            Node::Apply(Op::Neg, [a, _]) => self.add(graph, a, -times, deep)?,
            Node::Apply(Op::Mul, [a, b]) => match (constant(a), constant(b)) {
                (Some(by), _) => self.add(graph, b, times * by, deep)?,
                (_, Some(by)) => self.add(graph, a, times * by, deep)?,
                _ => return None,
            },
            Node::Apply(Op::Div, [a, b]) => {
                let by = constant(b).filter(|by| *by != 0.0)?;
                self.add(graph, a, times / by, deep)?;
            }
            _ => return None,
        }
        Some(())
    }
}

/// The cosine and the sine of an angle.
#[derive(Clone, Copy)]
struct Turn {
    cos: NodeId,
    sin: NodeId,
}

struct Out<'b> {
    b: &'b mut Builder,
    span: Span,
}

impl Out<'_> {
    fn real(&mut self, value: f64) -> NodeId {
        self.b.constant(Value::Real(value), self.span)
    }

    fn apply(&mut self, op: Op, args: &[NodeId]) -> NodeId {
        self.b.apply(op, args, self.span)
    }

    fn of_angle(
        &mut self,
        graph: &Graph,
        turned: &Turned,
        new: &dyn Fn(NodeId) -> Option<NodeId>,
    ) -> Option<Turn> {
        let (arc, times) = turned.arc?;
        let mut turn = self.of_arc(graph, arc, new)?;
        if times < 0.0 {
            turn.sin = self.apply(Op::Neg, &[turn.sin]);
        }
        let all = self.times(turn, times.abs() as u32);
        let mut more = self.real(turned.more);
        if let Some((int, times)) = turned.int {
            let times = self.real(times);
            let part = self.apply(Op::Mul, &[new(int)?, times]);
            more = self.apply(Op::Add, &[part, more]);
        } else if turned.more == 0.0 {
            return Some(all);
        }
        let [cos, sin] = [Op::Cos, Op::Sin].map(|op| self.apply(op, &[more]));
        Some(self.sum(all, Turn { cos, sin }))
    }

    /// The cosine and the sine of an arc.
    fn of_arc(
        &mut self,
        graph: &Graph,
        arc: NodeId,
        new: &dyn Fn(NodeId) -> Option<NodeId>,
    ) -> Option<Turn> {
        let Node::Apply(op, [first, second]) = graph.node(arc) else {
            return None;
        };
        let first = new(first)?;
        let one = self.real(1.0);
        if op == Op::Atan2 {
            let (y, x) = (first, new(second)?);
            let squares = [x, y].map(|a| self.apply(Op::Mul, &[a, a]));
            let sum = self.apply(Op::Add, &squares);
            let length = self.apply(Op::Sqrt, &[sum]);
            let [cos, sin] = [x, y].map(|a| self.apply(Op::Div, &[a, length]));
            // In no direction at all the arc is 0.
            let zero = self.real(0.0);
            let none = self.apply(Op::Equal, &[length, zero]);
            return Some(Turn {
                cos: self.b.select(none, one, cos, self.span),
                sin: self.b.select(none, zero, sin, self.span),
            });
        }
        let below = self.real(-1.0);
        let held = self.apply(Op::Max, &[first, below]);
        let held = self.apply(Op::Min, &[held, one]);
        let square = self.apply(Op::Mul, &[held, held]);
        let rest = self.apply(Op::Sub, &[one, square]);
        let other = self.apply(Op::Sqrt, &[rest]);
        let (cos, sin) = if op == Op::Acos {
            (held, other)
        } else {
            (other, held)
        };
        Some(Turn { cos, sin })
    }

    /// An angle so many times, once or more.
    fn times(&mut self, turn: Turn, times: u32) -> Turn {
        if times <= 1 {
            return turn;
        }
        let half = self.times(turn, times / 2);
        let [cos, sin] = [half.cos, half.sin].map(|a| self.apply(Op::Mul, &[a, a]));
        let both = self.apply(Op::Mul, &[half.sin, half.cos]);
        let twice = Turn {
            cos: self.apply(Op::Sub, &[cos, sin]),
            sin: self.apply(Op::Add, &[both, both]),
        };
        match times % 2 {
            0 => twice,
            _ => self.sum(twice, turn),
        }
    }

    fn sum(&mut self, a: Turn, b: Turn) -> Turn {
        let mut product = |a, b| self.b.apply(Op::Mul, &[a, b], self.span);
        let [cc, ss] = [product(a.cos, b.cos), product(a.sin, b.sin)];
        let [sc, cs] = [product(a.sin, b.cos), product(a.cos, b.sin)];
        Turn {
            cos: self.apply(Op::Sub, &[cc, ss]),
            sin: self.apply(Op::Add, &[sc, cs]),
        }
    }
}

#[cfg(test)]
#[path = "angle_addition_tests.rs"]
mod tests;
