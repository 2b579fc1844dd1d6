//! Sums up to associativity, for matching: what meets in one, however far apart it is written.
//!
//! A sum is taken apart into its terms, through the operations that nothing
//! else needs. Constants in it are worked out with twice the precision of an
//! `f64` and rounded once.

use super::form::Out;
use super::site::{Known, LOST, may_cancel};
use crate::ir::graph::*;
use slowlight_routine::{Op, Type, Value};

/// A rewrite of a sum.
#[derive(Clone, Copy)]
pub struct SumRule {
    pub name: &'static str,
    /// The sum before and after, for readers.
    pub left: &'static str,
    pub right: &'static str,
    pub condition: &'static str,
    pub source: &'static str,
    /// Changes the sum; whether it did.
    apply: fn(&mut Sum, &Known<'_>) -> bool,
}

const HERBIE: &str = "Panchekha, Sanchez-Stern, Wilcox, Tatlock, Automatically Improving Accuracy for Floating Point Expressions (2015)";

/// Every rule on sums, in the order in which they are tried.
pub static SUMS: &[SumRule] = &[
    SumRule {
        name: "equal terms",
        left: "(x + y) - (x + z)",
        right: "y - z",
        condition: "fewer operations than before; or no more, and x has a known bound, above 16 times all that is left",
        source: HERBIE,
        apply: equal_terms,
    },
    SumRule {
        name: "shifted square against a constant",
        left: "(x + C)^2 - K + y",
        right: "x*(x + 2 C) + (C^2 - K) + y",
        condition: "|C^2 - K| < K/16, and |x| < |C|/4",
        source: HERBIE,
        apply: shifted_squares,
    },
    SumRule {
        name: "constants of a sum",
        left: "((x + C) + y) - K",
        right: "(x + y) + (C - K)",
        condition: "C exceeds 16 times what is left of it; no more operations than before",
        source: HERBIE,
        apply: constants,
    },
    SumRule {
        name: "common factor",
        left: "a*b - a*c",
        right: "a*(b - c)",
        condition: "a*b may be near a*c, and nothing else needs them",
        source: HERBIE,
        apply: common_factors,
    },
];

/// How many terms a sum may have.
const TERMS: usize = 32;

/// A number as a sum of two, the second a rounding of the first.
#[derive(Clone, Copy, Debug, Default)]
struct Double(f64, f64);

impl Double {
    fn add(self, x: f64) -> Double {
        let (sum, rest) = two_sum(self.0, x);
        let (sum, rest) = two_sum(sum, rest + self.1);
        Double(sum, rest)
    }

    fn add_square(self, x: f64, sign: f64) -> Double {
        let square = x * x;
        let rest = x.mul_add(x, -square);
        self.add(sign * square).add(sign * rest)
    }

    fn rounded(self) -> f64 {
        self.0 + self.1
    }
}

/// A sum and what its rounding leaves out, exactly (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// A term without its sign.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    Value(NodeId),
    /// x (x + by)
    Shifted {
        x: NodeId,
        by: f64,
    },
    /// factor (plus - minus)
    Common {
        factor: NodeId,
        plus: NodeId,
        minus: NodeId,
    },
}

/// A sum, taken apart.
#[derive(Clone, Debug, Default)]
struct Sum {
    /// Each term and whether it is subtracted.
    terms: Vec<(bool, Part)>,
    constant: Double,
    /// How many constants it had, and the greatest magnitude of one.
    constants: usize,
    largest: f64,
    /// How many operations are no longer needed without it.
    freed: usize,
}

/// What stands for a node that is a sum, if a rule changes it.
pub fn rewrite(known: &Known<'_>, id: NodeId, out: &mut Out<'_>) -> Option<(&'static str, NodeId)> {
    if !is_sum(known.graph, id) {
        return None;
    }
    let through = take_apart(known, id, true)?;
    for rule in SUMS {
        let mut sum = match rule.name {
            // What is written apart may be shared: look through that too.
            "equal terms" | "constants of a sum" => through.clone(),
            _ => take_apart(known, id, false)?,
        };
        if (rule.apply)(&mut sum, known) {
            return Some((rule.name, sum.put(out)?));
        }
    }
    None
}

/// Whether a node is a sum, difference or negative of reals.
pub fn is_sum(graph: &Graph, id: NodeId) -> bool {
    matches!(graph.node(id), Node::Apply(Op::Add | Op::Sub | Op::Neg, _))
}

/// The terms of a sum; `through` those that others need, too. Nothing where
/// there are too many.
fn take_apart(known: &Known<'_>, root: NodeId, through: bool) -> Option<Sum> {
    let graph = known.graph;
    let mut sum = Sum::default();
    // To do, last first: the node, its sign, and whether it is freed.
    let mut todo = vec![(root, false, true)];
    let mut seen = 0;
    while let Some((id, minus, free)) = todo.pop() {
        seen += 1;
        if seen > 2 * TERMS {
            return None;
        }
        match graph.node(id) {
            Node::Const(_) => {
                let value = graph.constant(id).map_or(0.0, Value::real);
                sum.constant = sum.constant.add(if minus { -value } else { value });
                sum.constants += 1;
                sum.largest = sum.largest.max(value.abs());
            }
            Node::Apply(op @ (Op::Add | Op::Sub | Op::Neg), [a, b]) if free || through => {
                sum.freed += usize::from(free);
                let below = |id| free && known.once(id);
                if op != Op::Neg {
                    todo.push((b, minus != (op == Op::Sub), below(b)));
                }
                todo.push((a, minus != (op == Op::Neg), below(a)));
            }
            _ => sum.terms.push((minus, Part::Value(id))),
        }
    }
    Some(sum)
}

impl Sum {
    /// How many operations it takes.
    fn cost(&self) -> usize {
        let shown = usize::from(self.constant.rounded() != 0.0);
        let negative = usize::from(self.terms.iter().all(|(minus, _)| *minus) && shown == 0);
        (self.terms.len() + shown).saturating_sub(1) + negative
    }

    /// Puts it into a graph: the terms in their order, a positive one first.
    fn put(&self, out: &mut Out<'_>) -> Option<NodeId> {
        let constant = self.constant.rounded();
        let mut terms = self.terms.clone();
        let first = terms.iter().position(|(minus, _)| !minus);
        let start = match first {
            Some(at) => {
                let (_, part) = terms.remove(at);
                Some(part.put(out)?)
            }
            None => None,
        };
        let mut made = match start {
            Some(made) => made,
            None => out.real(constant),
        };
        for (minus, part) in terms {
            let term = part.put(out)?;
            let op = if minus { Op::Sub } else { Op::Add };
            made = out.apply(op, &[made, term]);
        }
        if start.is_some() && constant != 0.0 {
            let op = if constant < 0.0 { Op::Sub } else { Op::Add };
            let size = out.real(constant.abs());
            made = out.apply(op, &[made, size]);
        }
        Some(made)
    }
}

impl Part {
    fn put(self, out: &mut Out<'_>) -> Option<NodeId> {
        match self {
            Part::Value(id) => (out.new)(id),
            Part::Shifted { x, by } => {
                let x = (out.new)(x)?;
                let by = out.real(by);
                let other = out.apply(Op::Add, &[x, by]);
                Some(out.apply(Op::Mul, &[x, other]))
            }
            Part::Common {
                factor,
                plus,
                minus,
            } => {
                let [factor, plus, minus] = [factor, plus, minus].map(|id| (out.new)(id));
                let (factor, plus, minus) = (factor?, plus?, minus?);
                let difference = out.apply(Op::Sub, &[plus, minus]);
                Some(out.apply(Op::Mul, &[factor, difference]))
            }
        }
    }
}

fn equal_terms(sum: &mut Sum, known: &Known<'_>) -> bool {
    let size = |part: Part| match part {
        Part::Value(id) => known.range(id).magnitude(),
        _ => f64::INFINITY,
    };
    let before = sum.terms.len();
    let (mut at, mut gone) = (0, 0.0_f64);
    while at < sum.terms.len() {
        let (minus, part) = sum.terms[at];
        let mut later = sum.terms.iter().skip(at + 1);
        match later.position(|t| *t == (!minus, part)) {
            Some(after) => {
                sum.terms.remove(at + 1 + after);
                sum.terms.remove(at);
                gone = gone.max(size(part));
            }
            None => at += 1,
        }
    }
    let rest = sum.terms.iter().map(|(_, part)| size(*part));
    let rest = rest.sum::<f64>() + sum.constant.rounded().abs();
    // What has no known bound says nothing of cancellation, and x - x loses nothing.
    let bounded = gone < known.most && rest > 0.0;
    let shorter = sum.terms.len() < before && sum.cost() < sum.freed;
    shorter || bounded && gone > LOST * rest && sum.cost() <= sum.freed
}

fn constants(sum: &mut Sum, _: &Known<'_>) -> bool {
    sum.largest > LOST * sum.constant.rounded().abs()
        && sum.constants > 1
        && sum.cost() <= sum.freed
}

/// What is shifted by a constant, and by how much.
fn shifted(graph: &Graph, id: NodeId) -> Option<(NodeId, f64)> {
    let Node::Apply(Op::Mul, [a, b]) = graph.node(id) else {
        return None;
    };
    let Node::Apply(op @ (Op::Add | Op::Sub), [x, y]) = graph.node(a) else {
        return None;
    };
    let value = |id| graph.constant(id).map(Value::real);
    match (a == b, op, value(x), value(y)) {
        (true, Op::Add, None, Some(c)) => Some((x, c)),
        (true, Op::Add, Some(c), None) => Some((y, c)),
        (true, Op::Sub, None, Some(c)) => Some((x, -c)),
        // (c - y)^2 = (y - c)^2
        (true, Op::Sub, Some(c), None) => Some((y, -c)),
        _ => None,
    }
}

fn shifted_squares(sum: &mut Sum, known: &Known<'_>) -> bool {
    let held = sum.constant.rounded();
    let mut total = sum.constant;
    let mut made = sum.terms.clone();
    let mut changed = false;
    for (minus, part) in &mut made {
        let Part::Value(id) = *part else { continue };
        let Some((x, c)) = shifted(known.graph, id) else {
            continue;
        };
        let against = (held < 0.0) != *minus && held != 0.0;
        let large = c * c * 64.0 > held.abs() && known.range(x).magnitude() * 4.0 < c.abs();
        if against && large {
            total = total.add_square(c, if *minus { -1.0 } else { 1.0 });
            *part = Part::Shifted { x, by: 2.0 * c };
            changed = true;
        }
    }
    if !changed || total.rounded().abs() * LOST >= held.abs() {
        return false;
    }
    (sum.terms, sum.constant) = (made, total);
    true
}

/// The factors of a term that is a product which nothing else needs.
fn factors(known: &Known<'_>, part: Part) -> Option<(NodeId, [NodeId; 2])> {
    let Part::Value(id) = part else { return None };
    match known.graph.node(id) {
        Node::Apply(Op::Mul, args) if known.once(id) => Some((id, args)),
        _ => None,
    }
}

/// The factor that two products share, and what is left of each.
fn shared(a: [NodeId; 2], b: [NodeId; 2]) -> Option<(NodeId, NodeId, NodeId)> {
    let [p, q] = a;
    let [r, s] = b;
    match () {
        _ if p == r => Some((p, q, s)),
        _ if p == s => Some((p, q, r)),
        _ if q == r => Some((q, p, s)),
        _ if q == s => Some((q, p, r)),
        _ => None,
    }
}

fn common_factors(sum: &mut Sum, known: &Known<'_>) -> bool {
    let mut changed = false;
    let mut at = 0;
    while at < sum.terms.len() {
        let (minus, part) = sum.terms[at];
        let found = factors(known, part).and_then(|(id, mine)| {
            let later = sum.terms.iter().enumerate().skip(at + 1);
            later.filter(|(_, (m, _))| *m != minus).find_map(|(k, t)| {
                let (other, theirs) = factors(known, t.1)?;
                let (factor, left, right) = shared(mine, theirs)?;
                may_cancel(known.range(id), known.range(other)).then_some((k, factor, left, right))
            })
        });
        if let Some((other, factor, left, right)) = found {
            let (plus, minus) = if minus { (right, left) } else { (left, right) };
            let common = Part::Common {
                factor,
                plus,
                minus,
            };
            sum.terms.remove(other);
            sum.terms[at] = (false, common);
            changed = true;
        }
        at += 1;
    }
    changed
}

/// Whether a node is only a part of a larger sum, which will be looked at whole.
pub fn inner(known: &Known<'_>, users: &[bool], id: NodeId) -> bool {
    let real = known.graph.ty(id) == Type::Real;
    real && known.once(id) && users.get(id.0 as usize) == Some(&true)
}
