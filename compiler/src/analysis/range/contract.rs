//! Backward propagation: what an operation's narrowed result says of its operands, and of
//! what these are made of (hull consistency by HC4-revise: Benhamou, Goualard, Granvilliers
//! and Puget, Revising hull and box consistency, ICLP 1999). A loop that ends where the sum
//! of some squares is above 4 carries no more than 2 in each of them.

use super::refine::Narrowing;
use crate::ir::graph::*;
use crate::ir::interval::interval;
use slowlight_routine::{Op, Range, Type};

/// How many steps from a result down to what it is made of are gone.
const DEEP: u32 = 8;

/// In tables of so many entries is looked at most.
const ENTRIES: usize = 4096;

/// No less than this is said of the size of a square: below, formats may take it for 0.
const SMALL: f64 = 1e-12;

impl Narrowing<'_> {
    /// Narrows what a real that was narrowed is made of.
    pub(super) fn contracted(&mut self, id: NodeId) {
        self.contract(id, DEEP);
    }

    fn contract(&mut self, id: NodeId, deep: u32) {
        let (op, operands) = match self.graph.node(id) {
            Node::Apply(op, operands) => (op, operands),
            Node::Lookup { table, column, row } => return self.found_at(id, table, [column, row]),
            _ => return,
        };
        if deep == 0 || op.result() != Type::Real || !self.slack.inverts() {
            return;
        }
        // What several calls compute may be another one's by now.
        if operands
            .iter()
            .any(|id| self.shared[id.0 as usize].is_some())
        {
            return;
        }
        let args = operands.map(|id| self.now[id.0 as usize]);
        let exact = self
            .slack
            .before(op, &args[..op.arity()], self.now[id.0 as usize]);
        let [a, b] = args;
        let [of_a, of_b] = match op {
            Op::Add if operands[0] == operands[1] => [halved(exact), None],
            Op::Add => [
                Some(interval(Op::Sub, [exact, b], false)),
                Some(interval(Op::Sub, [exact, a], false)),
            ],
            Op::Sub if operands[0] == operands[1] => [None, None],
            Op::Sub => [
                Some(interval(Op::Add, [exact, b], false)),
                Some(interval(Op::Sub, [a, exact], false)),
            ],
            Op::Neg => [Some(interval(Op::Neg, [exact, exact], false)), None],
            Op::Abs => [within(exact.hi), None],
            Op::Mul if operands[0] == operands[1] => [within(exact.hi.max(SMALL).sqrt()), None],
            Op::Mul => [quotient(exact, b), quotient(exact, a)],
            Op::Sqrt => {
                let most = (exact.hi >= 0.0).then(|| below(exact.hi * exact.hi));
                [most, None]
            }
            Op::Max => [Some(below(exact.hi)), Some(below(exact.hi))],
            Op::Min => [Some(above(exact.lo)), Some(above(exact.lo))],
            _ => [None, None],
        };
        for (operand, range) in [(operands[0], of_a), (operands[1], of_b)] {
            let Some(range) = range else { continue };
            if self.graph.constant(operand).is_some() {
                continue;
            }
            let held = self.now[operand.0 as usize];
            let met = held.meet(range);
            if met.lo > held.lo || met.hi < held.hi {
                self.put(operand, met);
                self.contract(operand, deep - 1);
            }
        }
    }
}

impl Narrowing<'_> {
    /// What an entry's being within narrowed bounds says of where it stands: no nearer to a
    /// table's end than the outermost of such entries.
    fn found_at(&mut self, id: NodeId, table: TableId, at: [NodeId; 2]) {
        let Some(table) = self.graph.tables.get(table.0 as usize) else {
            return;
        };
        // Reals are rounded, and those of some tables made by the program.
        let few = table.entries.len() <= ENTRIES;
        let shared = at.iter().any(|id| self.shared[id.0 as usize].is_some());
        if table.ty == Type::Real || !few || shared {
            return;
        }
        let held = self.now[id.0 as usize];
        let [columns, rows] = at.map(|id| self.now[id.0 as usize]);
        let fits = |at: &usize| {
            let entry = table.entries[*at].value().real();
            held.lo <= entry && entry <= held.hi
        };
        let all = table.within((columns.lo, columns.hi), (rows.lo, rows.hi));
        let width = table.width as usize;
        let mut bounds: Option<[Range; 2]> = None;
        for k in all.filter(fits) {
            let here = [k % width, k / width].map(|k| Range::point(k as f64));
            bounds = Some(match bounds {
                Some([a, b]) => [a.join(here[0]), b.join(here[1])],
                None => here,
            });
        }
        let Some(bounds) = bounds else { return };
        for ((id, size), found) in at.into_iter().zip([table.width, table.height]).zip(bounds) {
            // Who is beyond an end reads what stands there.
            let last = f64::from(size) - 1.0;
            let lo = if found.lo == 0.0 {
                f64::NEG_INFINITY
            } else {
                found.lo
            };
            let hi = if found.hi == last {
                f64::INFINITY
            } else {
                found.hi
            };
            self.narrow(id, Range::new(lo, hi), false);
        }
    }
}

fn below(most: f64) -> Range {
    Range::new(f64::NEG_INFINITY, most)
}

fn above(least: f64) -> Range {
    Range::new(least, f64::INFINITY)
}

/// What is no larger than so much.
fn within(size: f64) -> Option<Range> {
    (size >= 0.0).then(|| Range::new(-size, size))
}

fn halved(twice: Range) -> Option<Range> {
    Some(Range::new(twice.lo / 2.0, twice.hi / 2.0))
}

/// A factor of a product, by the other factor: where that is not near 0.
fn quotient(product: Range, by: Range) -> Option<Range> {
    (by.lo > SMALL || by.hi < -SMALL).then(|| interval(Op::Div, [product, by], false))
}
