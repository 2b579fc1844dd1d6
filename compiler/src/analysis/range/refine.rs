//! Condition refinement (branch-sensitive ranges): what a condition's holding says of the values
//! that it compares, and of those that a comparison which it stands for would compare.

use super::Slack;
use crate::analysis::region::{Fact, implied};
use crate::ir::graph::*;
use slowlight_routine::{Op, Range};

/// How many steps from a value down to what it is made of are gone.
const DEEP: u32 = 8;

/// Ints up to this are reals in every format that holds them.
const EXACT: f64 = 16384.0;

/// The int that a value is a line in, and between which bounds it stays where the
/// value, which stayed within `held` before, stays between those of now. Nothing
/// where the value may have been cut to what its format holds.
fn below(graph: &Graph, now: &[Range], id: NodeId, held: Range) -> Option<(NodeId, Range)> {
    let Node::Apply(op, [a, b]) = graph.node(id) else {
        return None;
    };
    let number = |id: NodeId| graph.constant(id).map(slowlight_routine::Value::real);
    // As factor x + offset.
    let (of, factor, offset) = match (op, number(a), number(b)) {
        (Op::ToReal, None, _) => (a, 1.0, 0.0),
        (Op::IntAdd, None, Some(c)) => (a, 1.0, c),
        (Op::IntAdd, Some(c), None) => (b, 1.0, c),
        (Op::IntSub, None, Some(c)) => (a, 1.0, -c),
        (Op::IntSub, Some(c), None) => (b, -1.0, c),
        (Op::IntMul, None, Some(c)) if c != 0.0 => (a, c, 0.0),
        (Op::IntMul, Some(c), None) if c != 0.0 => (b, c, 0.0),
        (Op::IntNeg, None, _) => (a, -1.0, 0.0),
        _ => return None,
    };
    let x = now[of.0 as usize];
    let whole = |x: f64| {
        let y = factor * x + offset;
        held.lo <= y && y <= held.hi && y.abs() < f64::from(i32::MAX)
    };
    if !whole(x.lo) || !whole(x.hi) || op == Op::ToReal && x.magnitude() > EXACT {
        return None;
    }
    let range = now[id.0 as usize];
    let beside = |end: f64, by: f64| if range.nonzero && end == 0.0 { by } else { end };
    let [p, q] = [beside(range.lo, 1.0), beside(range.hi, -1.0)].map(|end| (end - offset) / factor);
    Some((of, Range::new(p.min(q).ceil(), p.max(q).floor())))
}

/// What conditions say, each looked into once: a walk through loops comes by it again and
/// again.
pub struct Conditions<'g> {
    graph: &'g Graph,
    /// By condition, where it does not hold and where it does.
    said: Vec<[Option<Box<Said>>; 2]>,
    /// Rows and columns, and what has one as a real.
    reals: Vec<(NodeId, NodeId)>,
}

/// What a condition's holding or not says.
struct Said {
    /// The comparisons that are decided by it, and whether they hold.
    compared: Vec<(Op, [NodeId; 2], bool)>,
    /// What values that are computed only then stay within.
    claimed: Vec<(NodeId, Range)>,
    /// All conditions that follow, and those of them that are choices.
    facts: Vec<Fact>,
    choices: Vec<Choice>,
}

impl Said {
    fn new(graph: &Graph, cond: NodeId, holds: bool) -> Said {
        let (mut compared, mut all) = (Vec::new(), Vec::new());
        let facts = implied(graph, cond, holds);
        for &(fact, holds) in &facts {
            match (graph.claims.get(&fact), graph.node(fact)) {
                (Some((op, args)), _) => {
                    compared.push((*op, *args, holds));
                    all.extend(claimed(graph, *op, *args, holds));
                }
                (_, Node::Apply(op, args)) => compared.push((op, args, holds)),
                _ => {}
            }
        }
        let choice = |&(id, holds): &Fact| match graph.node(id) {
            Node::Select { cond, yes, no } => Some(Choice {
                by: cond,
                yes,
                no,
                holds,
            }),
            _ => None,
        };
        Said {
            compared,
            claimed: all,
            choices: facts.iter().filter_map(choice).collect(),
            facts,
        }
    }
}

/// What a claimed comparison's holding or not says of what it compares with a constant.
fn claimed(graph: &Graph, op: Op, [a, b]: [NodeId; 2], holds: bool) -> Option<(NodeId, Range)> {
    let number = |id: NodeId| graph.constant(id).map(slowlight_routine::Value::real);
    // By how much ints on the two sides of a border differ.
    let strict = matches!(op, Op::IntLess) == holds;
    let step = if strict { 1.0 } else { 0.0 };
    let (below, above) = (f64::NEG_INFINITY, f64::INFINITY);
    match (number(a), number(b), holds) {
        (Some(c), None, true) => Some((b, Range::new(c + step, above))),
        (Some(c), None, false) => Some((b, Range::new(below, c - step))),
        (None, Some(c), true) => Some((a, Range::new(below, c - step))),
        (None, Some(c), false) => Some((a, Range::new(c + step, above))),
        _ => None,
    }
}

impl<'g> Conditions<'g> {
    /// Of a graph, none looked into yet.
    pub fn new(graph: &'g Graph) -> Conditions<'g> {
        let real = |id: NodeId| match graph.node(id) {
            Node::Apply(Op::ToReal, [of, _]) if matches!(graph.node(of), Node::Axis(_)) => {
                Some((of, id))
            }
            _ => None,
        };
        Conditions {
            graph,
            said: graph.ids().map(|_| [None, None]).collect(),
            reals: graph.ids().filter_map(real).collect(),
        }
    }

    fn said(&mut self, cond: NodeId, holds: bool) -> &Said {
        let said = &mut self.said[cond.0 as usize][usize::from(holds)];
        said.get_or_insert_with(|| Box::new(Said::new(self.graph, cond, holds)))
    }

    /// What a condition's holding or not says of values, by the comparisons that are
    /// claimed to be the same, also where they are computed only then.
    pub fn claimed(&mut self, cond: NodeId, holds: bool) -> &[(NodeId, Range)] {
        &self.said(cond, holds).claimed
    }

    /// All that follows from a condition's holding or not, and what of it are choices.
    pub(super) fn implied(&mut self, (cond, holds): Fact) -> (&[Fact], &[Choice]) {
        let said = self.said(cond, holds);
        (&said.facts, &said.choices)
    }

    /// Narrows `now` by a condition that holds or does not; what was there before is put
    /// behind what is `saved` already, in the order of change.
    pub fn refine(
        &mut self,
        known: Known,
        now: &mut [Range],
        saved: &mut Vec<(NodeId, Range)>,
        (cond, holds): Fact,
    ) {
        self.said(cond, holds);
        let Some(said) = &self.said[cond.0 as usize][usize::from(holds)] else {
            return;
        };
        let mut narrowing = Narrowing {
            graph: self.graph,
            slack: known.slack,
            shared: known.shared,
            reals: &self.reals,
            now,
            saved,
        };
        for &(op, args, holds) in &said.compared {
            narrowing.compared(op, args, holds);
        }
    }
}

/// Takes back what refining has narrowed, down to so many that were saved before.
pub fn restore(now: &mut [Range], saved: &mut Vec<(NodeId, Range)>, before: usize) {
    for (id, range) in saved.drain(before..).rev() {
        now[id.0 as usize] = range;
    }
}

/// What is known of the walk that comes by a condition.
#[derive(Clone, Copy)]
pub struct Known<'k> {
    /// How its machine departs from exact arithmetic.
    pub slack: &'k Slack,
    /// By node, whether calls of a subroutine share it.
    pub shared: &'k [Option<bool>],
}

/// Ranges while they are narrowed, and what they were.
pub(super) struct Narrowing<'n> {
    pub(super) graph: &'n Graph,
    pub(super) slack: &'n Slack,
    pub(super) shared: &'n [Option<bool>],
    reals: &'n [(NodeId, NodeId)],
    pub(super) now: &'n mut [Range],
    saved: &'n mut Vec<(NodeId, Range)>,
}

impl Narrowing<'_> {
    /// By a comparison that holds or does not.
    fn compared(&mut self, op: Op, [a, b]: [NodeId; 2], holds: bool) {
        let unit = if op.args().first() == Some(&slowlight_routine::Type::Int) {
            1.0
        } else {
            0.0
        };
        let (ra, rb) = (self.now[a.0 as usize], self.now[b.0 as usize]);
        match (op, holds) {
            (Op::Less | Op::IntLess, true) => {
                self.narrow(a, Range::new(f64::NEG_INFINITY, rb.hi - unit), unit == 0.0);
                self.narrow(b, Range::new(ra.lo + unit, f64::INFINITY), unit == 0.0);
            }
            (Op::Less | Op::IntLess, false) => {
                self.narrow(a, Range::new(rb.lo, f64::INFINITY), false);
                self.narrow(b, Range::new(f64::NEG_INFINITY, ra.hi), false);
            }
            (Op::LessEqual | Op::IntLessEqual, true) => {
                self.narrow(a, Range::new(f64::NEG_INFINITY, rb.hi), false);
                self.narrow(b, Range::new(ra.lo, f64::INFINITY), false);
            }
            (Op::LessEqual | Op::IntLessEqual, false) => {
                self.narrow(a, Range::new(rb.lo + unit, f64::INFINITY), unit == 0.0);
                self.narrow(b, Range::new(f64::NEG_INFINITY, ra.hi - unit), unit == 0.0);
            }
            (Op::Equal | Op::IntEqual, true) => {
                self.narrow(a, rb, false);
                self.narrow(b, ra, false);
            }
            (Op::Equal | Op::IntEqual, false) if rb.constant() == Some(0.0) => {
                let nonzero = Range {
                    nonzero: true,
                    ..Range::ALL
                };
                self.narrow(a, nonzero, false);
                self.unlike(unit, [a, b]);
            }
            (Op::IntEqual, false) => {
                self.unlike(unit, [a, b]);
                self.unlike(unit, [b, a]);
            }
            _ => {}
        }
    }

    /// An int is not what the other one is known to be: it is not the end of its range.
    fn unlike(&mut self, unit: f64, [id, other]: [NodeId; 2]) {
        let held = self.now[id.0 as usize];
        if unit == 0.0 || held.lo == held.hi {
            return;
        }
        match self.now[other.0 as usize].constant() {
            Some(end) if end == held.lo => {
                self.narrow(id, Range::new(end + unit, f64::INFINITY), false);
            }
            Some(end) if end == held.hi => {
                self.narrow(id, Range::new(f64::NEG_INFINITY, end - unit), false);
            }
            _ => {}
        }
    }

    pub(super) fn narrow(&mut self, id: NodeId, range: Range, strict: bool) {
        if self.graph.constant(id).is_some() {
            return;
        }
        let held = self.now[id.0 as usize];
        let mut met = held.meet(range);
        met.nonzero |= strict && (range.lo == 0.0 || range.hi == 0.0);
        self.put(id, met);
        if met.lo > held.lo || met.hi < held.hi {
            self.contracted(id);
        }
        // What it is a line in is narrowed with it, down to the row.
        let (mut of, mut before) = (id, held);
        for _ in 0..DEEP {
            let Some((inner, range)) = below(self.graph, self.now, of, before) else {
                break;
            };
            (of, before) = (inner, self.now[inner.0 as usize]);
            // A row or column as a real, where it is one that its format holds.
            for &(axis, real) in self.reals {
                let held = self.now[real.0 as usize];
                let same = held.lo <= before.lo && before.hi <= held.hi;
                if axis == inner && same && before.magnitude() <= EXACT {
                    self.put(real, held.meet(range));
                }
            }
            self.put(inner, before.meet(range));
        }
    }

    pub(super) fn put(&mut self, id: NodeId, range: Range) {
        let now = &mut self.now[id.0 as usize];
        self.saved.push((id, *now));
        *now = range;
    }
}

/// A condition that is known to hold, or not to, and of which one of two others decides.
#[derive(Clone, Copy)]
pub(super) struct Choice {
    pub(super) by: NodeId,
    pub(super) yes: NodeId,
    pub(super) no: NodeId,
    pub(super) holds: bool,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::build::Builder;
    use crate::source::Span;
    use slowlight_routine::Value;

    #[test]
    fn what_a_line_says_of_the_row_holds_for_the_row() {
        let at = Span::default();
        // y from 0 to 239, as an int and through a real.
        for real in [false, true] {
            let mut b = Builder::new();
            let y = b.axis(Axis::Y, at);
            let [by, from] = [-20, 2390].map(|n| b.constant(Value::Int(n), at));
            let product = b.apply(Op::IntMul, &[by, y], at);
            let sum = b.apply(Op::IntAdd, &[product, from], at);
            let (zero, sum, op) = match real {
                true => (
                    Value::Real(0.0),
                    b.apply(Op::ToReal, &[sum], at),
                    Op::LessEqual,
                ),
                false => (Value::Int(0), sum, Op::IntLessEqual),
            };
            let height = b.apply(Op::ToReal, &[y], at);
            let zero = b.constant(zero, at);
            let above = b.apply(op, &[zero, sum], at);
            let image = Image {
                block: (1, 1),
                width: 1,
                height: 240,
                palette: vec![[0; 3]; 2],
            };
            let graph = b.finish(image, y, None);
            let known = |id: NodeId| match id {
                id if id == y || id == height => Range::new(0.0, 239.0),
                id if id == product => Range::new(-4780.0, 0.0),
                _ => match graph.constant(id) {
                    Some(value) => Range::point(value.real()),
                    None => Range::new(-2390.0, 2390.0),
                },
            };
            let before: Vec<Range> = graph.ids().map(known).collect();
            for (holds, lo, hi) in [(true, 0.0, 119.0), (false, 120.0, 239.0)] {
                let mut now = before.clone();
                let mut saved = Vec::new();
                let known = Known {
                    slack: &Slack::exact(),
                    shared: &vec![None; graph.nodes.len()],
                };
                Conditions::new(&graph).refine(known, &mut now, &mut saved, (above, holds));
                assert_eq!(now[y.0 as usize], Range::new(lo, hi));
                assert_eq!(now[height.0 as usize], Range::new(lo, hi));
                restore(&mut now, &mut saved, 0);
                assert_eq!(now, before);
            }
        }
    }
}
