//! Interval semantics of fixed-point scales: what reading and rounding at scales does to ranges.

use super::Points;
use crate::analysis::region::implied;
use crate::ir::graph::*;
use crate::ir::tree::Place;
use slowlight_routine::scale::{self, most};
use slowlight_routine::{Op, Range, Type};

impl Points {
    /// The last place at a scale.
    pub(crate) fn unit(scale: i8) -> f64 {
        (-f64::from(scale)).exp2()
    }

    /// A range in the bits of a scale, widened by so many units of it.
    fn held(&self, range: Range, (scale, width): (i8, u8), units: f64) -> Range {
        let unit = Points::unit(scale);
        let end = most(width) as f64 * unit;
        let cut = |x: f64| x.clamp(-end, end);
        let off = units * unit;
        let made = Range::new(cut(range.lo - off), cut(range.hi + off));
        Range {
            nonzero: made.nonzero || units == 0.0 && range.nonzero,
            ..made
        }
    }

    /// What is held at one scale, read at another.
    fn moved_range(&self, range: Range, from: i8, to: (i8, u8)) -> Range {
        if to.0 >= from {
            return self.held(range, to, 0.0);
        }
        // The nearest, be it the one or the other where it is between two.
        let unit = Points::unit(to.0);
        let lo = (range.lo / unit - 0.5).ceil() * unit;
        let hi = (range.hi / unit + 0.5).floor() * unit;
        self.held(Range::new(lo, hi), to, 0.0)
    }

    /// An operand's range as it is read.
    pub fn operand(&self, graph: &Graph, id: NodeId, k: usize, range: Range) -> Range {
        let Node::Apply(op, args) = graph.node(id) else {
            return range;
        };
        let to = self.scales(id).args[k.min(1)];
        let wide = (to, self.widths.operands(id));
        match (graph.constant(args[k.min(1)]), op.args().get(k)) {
            (Some(value), Some(Type::Real)) => {
                let units = (value.real() / Points::unit(to)).round();
                self.held(Range::point(units * Points::unit(to)), wide, 0.0)
            }
            (_, Some(Type::Real)) => self.moved_range(range, self.own(args[k.min(1)]), wide),
            (_, Some(Type::Int)) if op == Op::ToReal => self.moved_range(range, 0, wide),
            _ => range,
        }
    }

    /// A real that the program has, as a node's value.
    pub fn nearest(&self, id: NodeId, real: f64) -> Range {
        let unit = Points::unit(self.own(id));
        self.rounded(id, Range::point((real / unit).round() * unit), 0.0)
    }

    /// What a real has that may be so many last places off.
    pub fn rounded(&self, id: NodeId, exact: Range, units: f64) -> Range {
        self.held(exact, (self.own(id), self.widths.value(id)), units)
    }

    /// What a place has that is given a value.
    pub fn copied(&self, graph: &Graph, place: Place, from: NodeId, range: Range) -> Range {
        let to = (self.place(place), self.widths.place(place));
        if graph.ty(from) != Type::Real {
            return range;
        }
        match graph.constant(from) {
            // The nearest.
            Some(_) => self.held(range, to, 0.5),
            None => self.moved_range(range, self.own(from), to),
        }
    }

    /// How far what a condition says of reals may be off, since it compares what was
    /// rounded.
    pub fn doubt(&self, graph: &Graph, cond: NodeId, holds: bool) -> f64 {
        let facts = implied(graph, cond, holds);
        let of = |(fact, _): &(NodeId, bool)| match graph.node(*fact) {
            Node::Apply(op @ (Op::Less | Op::LessEqual | Op::Equal), args) => {
                let scale = self.scales(*fact).args[0];
                let exact = |id: NodeId| match graph.constant(id) {
                    Some(value) => (value.real() / Points::unit(scale)).fract() == 0.0,
                    None => self.own(id) <= scale,
                };
                match args[..op.arity()].iter().all(|id| exact(*id)) {
                    true => 0.0,
                    false => Points::unit(scale),
                }
            }
            _ => 0.0,
        };
        facts.iter().map(of).fold(0.0, f64::max)
    }

    /// An operation's ranges as routines see them whose values have scales
    /// ([`slowlight_routine::scale`]).
    pub fn in_units(
        &self,
        id: NodeId,
        op: Op,
        args: &[Range],
        exact: Range,
    ) -> (Vec<Range>, Range) {
        let scales = self.scales(id);
        let args = args.iter().zip(op.args()).zip(scales.args);
        let units = |((range, ty), at): ((&Range, &Type), i8)| match (ty, op) {
            (Type::Real, _) | (_, Op::ToReal) => scale::in_units(*range, at),
            _ => *range,
        };
        let mut args: Vec<Range> = args.map(units).collect();
        args.push(Range::point(f64::from(scales.number(op))));
        let exact = match op.result() {
            Type::Real => scale::in_units(exact, scales.result),
            _ => exact,
        };
        (args, exact)
    }
}
