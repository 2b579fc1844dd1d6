//! Comparisons of homogeneous values, held at powers of a length.

use super::{Made, Pass};
use crate::analysis::rate::Dependence;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use slowlight_routine::{Op, Type, Value};

/// By how much a bound is moved away, as a part of it, for what roundings do.
const MARGIN: f64 = 1e-6;

impl Pass<'_> {
    /// A comparison, its sides brought to one degree.
    pub(super) fn compared(
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
}
