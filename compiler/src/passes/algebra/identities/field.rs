//! Identity testing by evaluation in a finite field (Schwartz-Zippel): two formulas for one value
//! agree there.
//!
//! A value that is made of others by + - * / and roots is an algebraic function of
//! them. Two such functions that agree at points drawn at random from a field of
//! 2^61 - 1 elements are the same, but for a chance of about their degree in
//! 2^61 at each point (Schwartz, Fast Probabilistic Algorithms for Verification
//! of Polynomial Identities, 1980). Nothing is rounded there, so what agrees over
//! the reals agrees, and a root is either element with that square, by a coin:
//! what would need its sign is not found.

use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::{Forms, Number, Turns};
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::{Op, Range, Type};

/// The field has so many elements: a Mersenne prime, 3 of 4.
const PRIME: u64 = (1 << 61) - 1;

/// At how many points values are looked at.
pub const POINTS: usize = 8;

/// How many conditions a formula may hang on: it is looked at for all ways that
/// they may go.
const CONDITIONS: usize = 10;

/// A value at all the points.
pub type Print = [u64; POINTS];

/// How many roots are known to be such; others are values of which nothing is known.
const ROOTS: usize = 6;

/// How often other points are drawn where an argument has no root.
const TRIES: u64 = 1 << (ROOTS + 4);

pub fn add(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= PRIME { sum - PRIME } else { sum }
}

pub fn sub(a: u64, b: u64) -> u64 {
    add(a, PRIME - b)
}

pub fn mul(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    let (low, high) = (product as u64 & PRIME, (product >> 61) as u64);
    add(low, high)
}

fn power(mut x: u64, mut n: u64) -> u64 {
    let mut made = 1;
    while n > 0 {
        if n & 1 == 1 {
            made = mul(made, x);
        }
        x = mul(x, x);
        n >>= 1;
    }
    made
}

/// 1 / x; 0 for 0.
pub fn inverse(x: u64) -> u64 {
    power(x, PRIME - 2)
}

/// The inverses of many elements, 0 for 0 (Montgomery's trick: one inversion).
pub fn inverses(all: &mut [u64]) {
    let mut before = Vec::with_capacity(all.len());
    let mut product = 1;
    for x in all.iter() {
        before.push(product);
        product = if *x == 0 { product } else { mul(product, *x) };
    }
    let mut rest = inverse(product);
    for (x, before) in all.iter_mut().zip(before).rev() {
        if *x != 0 {
            let own = mul(rest, before);
            rest = mul(rest, *x);
            *x = own;
        }
    }
}

/// An element with a square, if there is one.
fn root(square: u64) -> Option<u64> {
    let x = power(square, (PRIME + 1) / 4);
    (mul(x, x) == square).then_some(x)
}

/// A whole number.
pub fn whole(n: i128) -> u64 {
    n.rem_euclid(i128::from(PRIME)) as u64
}

/// The fraction n/d with small n and d that an element is, if it is one
/// (Wang, A p-adic Algorithm for Univariate Partial Fractions, 1981).
pub fn fraction(x: u64) -> Option<(i64, i64)> {
    const SMALL: i128 = 1 << 24;
    let (mut a, mut b) = (i128::from(PRIME), i128::from(x));
    let (mut s, mut t) = (0i128, 1i128);
    while b > SMALL {
        let q = a / b;
        (a, b) = (b, a - q * b);
        (s, t) = (t, s - q * t);
    }
    let (n, d) = if t < 0 { (-b, -t) } else { (b, t) };
    (0 < d && d <= SMALL).then_some((n as i64, d as i64))
}

/// Elements drawn at random, the same for the same key (SplitMix64: Steele,
/// Lea and Flood, Fast Splittable Pseudorandom Number Generators, 2014).
fn drawn(key: u64) -> u64 {
    let mut z = key.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)) % PRIME
}

/// Values at a point.
pub type Values<'v> = &'v dyn Fn(NodeId) -> u64;

/// A graph's values in the field.
pub struct Field<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    forms: &'g Forms<'g>,
    roots: Vec<NodeId>,
    /// What constants are there; 0 for other nodes.
    constants: Vec<u64>,
    /// Conditions and signs that go with another sign: what is chosen by one, and what
    /// has the other for a factor, are of one side.
    turns: Turns,
}

impl<'g> Field<'g> {
    pub fn new(graph: &'g Graph, ranges: &'g Ranges, forms: &'g Forms<'g>) -> Field<'g> {
        let constant = |id| graph.constant(id).map_or(0, |c| element(c.real()));
        let all: Vec<NodeId> = graph.ids().collect();
        let mut field = Field {
            graph,
            ranges,
            forms,
            roots: Vec::new(),
            constants: graph.ids().map(constant).collect(),
            turns: forms.turns(),
        };
        // The root of one value and that of three times it are never both there.
        for root in roots(graph, ranges) {
            field.roots.push(root);
            let found = (0..TRIES).any(|key| field.at(key, &all, &Forced::default()).is_some());
            if !found {
                field.roots.pop();
            }
        }
        field
    }

    /// Each real and int value at the points; nothing for bools, and nothing at all
    /// where no points were found at which the roots are there.
    pub fn prints(&self) -> Option<Vec<Option<Print>>> {
        let mut all = vec![Some([0; POINTS]); self.graph.nodes.len()];
        let ids: Vec<NodeId> = self.graph.ids().collect();
        let mut key = 1;
        for point in 0..POINTS {
            let found = (0..TRIES).find_map(|_| {
                key += 1;
                self.at(key, &ids, &Forced::default())
            })?;
            for (print, value) in all.iter_mut().zip(found) {
                match (print.as_mut(), value) {
                    (Some(print), Some(value)) => print[point] = value,
                    _ => *print = None,
                }
            }
        }
        Some(all)
    }

    /// Whether what `holds` says of values holds whichever way the conditions go
    /// that some values hang on, and whichever signs their roots have.
    pub fn always(&self, of: &[NodeId], holds: &dyn Fn(Values<'_>) -> bool) -> bool {
        let mut cone: FxHashSet<NodeId> = FxHashSet::default();
        let mut todo = of.to_vec();
        let mut conditions = Vec::new();
        while let Some(id) = todo.pop() {
            if !cone.insert(id) {
                continue;
            }
            match self.graph.node(id) {
                Node::Select { cond, yes, no } => {
                    conditions.push(self.turned(cond).0);
                    todo.extend([yes, no]);
                }
                Node::Apply(Op::Sign | Op::IntSign, _) => conditions.push(self.turned(id).0),
                node => {
                    conditions.extend(self.roots.contains(&id).then_some(id));
                    todo.extend(node.operands());
                }
            }
        }
        conditions.sort_unstable();
        conditions.dedup();
        if conditions.len() > CONDITIONS {
            return false;
        }
        let mut cone: Vec<NodeId> = cone.into_iter().collect();
        cone.sort_unstable();
        let one = |ways: u64| {
            let way = |k: usize| ways >> k & 1 == 1;
            let forced = (0..)
                .zip(&conditions)
                .map(|(k, id)| (*id, way(k)))
                .collect();
            let key = TRIES * POINTS as u64 + (ways + 2) * TRIES;
            let mut keys = key..key + TRIES;
            let found = keys.find_map(|key| self.at(key, &cone, &forced));
            let of = |values: &[Option<u64>], id: NodeId| values[id.0 as usize].unwrap_or(0);
            found.is_some_and(|values| holds(&|id| of(&values, id)))
        };
        (0..1 << conditions.len()).all(one)
    }
}

/// A constant's element.
fn element(x: f64) -> u64 {
    match Number::of(x) {
        Number::Exact(n, 1) => whole(n),
        Number::Exact(n, d) => mul(whole(n), inverse(whole(d))),
        Number::Near(x) => drawn(x.to_bits()),
    }
}

/// Which ways conditions go that are not left to a coin.
type Forced = FxHashMap<NodeId, bool>;

/// Which way a condition, a sign or a root's sign goes at a point.
fn coin(key: u64, forced: &Forced, id: NodeId) -> bool {
    match forced.get(&id) {
        Some(way) => *way,
        None => drawn(drawn(key) ^ 0x5bd1_e995 ^ u64::from(id.0)) & 1 == 1,
    }
}

/// Square roots of what is never below 0.
fn roots(graph: &Graph, ranges: &Ranges) -> Vec<NodeId> {
    let reached = graph.reached();
    let fits = |id: &NodeId| {
        let at = id.0 as usize;
        reached[at]
            && matches!(graph.node(*id), Node::Apply(Op::Sqrt, _))
            && ranges.args.get(at).is_some_and(|a| a[0].lo >= 0.0)
    };
    graph.ids().filter(fits).take(ROOTS).collect()
}

impl Field<'_> {
    /// The values of some nodes, in their order, at a point drawn by a key, conditions going
    /// as they are `forced` to; nothing where a root is not there.
    fn at(&self, key: u64, ids: &[NodeId], forced: &Forced) -> Option<Vec<Option<u64>>> {
        let mut values: Vec<Option<u64>> = vec![None; self.graph.nodes.len()];
        for &id in ids {
            let any = || drawn(drawn(key) ^ u64::from(id.0));
            let value = match self.graph.ty(id) {
                Type::Bool => None,
                _ => Some(match self.known(&values, forced, key, id) {
                    Some(Known::Value(value)) => value,
                    Some(Known::Root(square)) => {
                        let root = root(square)?;
                        if coin(key, forced, id) {
                            root
                        } else {
                            sub(0, root)
                        }
                    }
                    None => any(),
                }),
            };
            values[id.0 as usize] = value;
        }
        Some(values)
    }

    /// What a value is by those before it, if anything is known of it.
    fn known(
        &self,
        values: &[Option<u64>],
        forced: &Forced,
        key: u64,
        id: NodeId,
    ) -> Option<Known> {
        let of = |id: NodeId| values.get(id.0 as usize).copied().flatten();
        let coin = |id: NodeId| coin(key, forced, id);
        let value = match self.graph.node(id) {
            Node::Const(_) => self.constants.get(id.0 as usize).copied()?,
            Node::Select { cond, yes, no } => {
                let (cond, turned) = self.turned(cond);
                of(if coin(cond) != turned { yes } else { no })?
            }
            Node::Apply(Op::Sign | Op::IntSign, _) if self.is_unit(id) => {
                let (sign, turned) = self.turned(id);
                if coin(sign) != turned { 1 } else { whole(-1) }
            }
            Node::Apply(Op::Sqrt, [x, _]) if self.roots.contains(&id) => {
                return of(x).map(Known::Root);
            }
            Node::Apply(op, [a, b]) => self.applied(id, op, of(a)?, of(b)?)?,
            _ => return None,
        };
        Some(Known::Value(value))
    }

    /// Whether a sign is never 0.
    fn is_unit(&self, id: NodeId) -> bool {
        let two = self.forms.two(id.0);
        two.is_some_and(|two| (two.low, two.high) == (-1, 1))
    }

    /// What tells how a condition without its negations goes, or a sign, and whether it
    /// goes the other way.
    fn turned(&self, mut cond: NodeId) -> (NodeId, bool) {
        let mut turned = false;
        while let Node::Apply(Op::Not, [inner, _]) = self.graph.node(cond) {
            (cond, turned) = (inner, !turned);
        }
        match self.turns.get(&cond) {
            Some((sign, other)) => (*sign, turned != *other),
            None => (cond, turned),
        }
    }

    fn applied(&self, id: NodeId, op: Op, a: u64, b: u64) -> Option<u64> {
        let at = id.0 as usize;
        let exact = |r: Option<&Range>| r.is_some_and(|r| r.within(-2e9, 2e9));
        let ints = matches!(op, Op::IntAdd | Op::IntSub | Op::IntMul | Op::IntNeg);
        if ints && !exact(self.ranges.exact.get(at)) {
            return None;
        }
        match op {
            Op::ToReal => Some(a),
            Op::Add | Op::IntAdd => Some(add(a, b)),
            Op::Sub | Op::IntSub => Some(sub(a, b)),
            Op::Mul | Op::IntMul => Some(mul(a, b)),
            Op::Neg | Op::IntNeg => Some(sub(0, a)),
            Op::Div if self.ranges.args.get(at)?[1].nonzero => Some(mul(a, inverse(b))),
            _ => None,
        }
    }
}

/// What is known of a value: what it is, or what its square is.
enum Known {
    Value(u64),
    Root(u64),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_have_inverses_roots_and_fractions() {
        for key in 1..200 {
            let x = drawn(key);
            assert_eq!(mul(x, inverse(x)), 1);
            let r = root(mul(x, x)).expect("a square has a root");
            assert!(r == x || add(r, x) == 0);
        }
        for (n, d) in [(1, 3), (-22, 7), (0, 1), (-4, 1), (1_000_003, 999)] {
            assert_eq!(
                fraction(mul(whole(n), inverse(whole(d)))),
                Some((n as i64, d as i64))
            );
        }
        let mut all = [2, 0, 7];
        inverses(&mut all);
        assert_eq!(all, [inverse(2), 0, inverse(7)]);
    }
}
