//! Strength reduction in loops: polynomials in a value that changes from turn to turn, by their
//! coefficients, which do not (Horner's rule).
//!
//! A point on a ray is o + t d, and what turns it, scales it, or takes its distance from a
//! centre squared, is a polynomial in t of the first or second degree:
//! ```text
//! |o + t d - c|^2   is   (t (d . d) + 2 (o - c) . d) t + |o - c|^2
//! ```
//! Only t is another one at each turn of a march or a search; so one or two products are left
//! of a turned point's four or a square's three. The coefficients stand before the loop, where
//! placement puts them. Which values are put so is decided together: what several
//! need, the point itself, say, goes only where all of them do.
//!
//! Over the reals both are the same. A polynomial of the first degree has terms about as large
//! as those that it comes from, which is tested. The terms of a square cancel where the value is
//! small: unless the format's roundings of its greatest term are below [`SOUND`], it is put so
//! only along a direction of length 1, by completing the square: measured from the point that is
//! nearest to the centre, where no terms cancel but those that the point's own places have, too:
//! ```text
//! |o + t d - c|^2   is   (t + u)^2 + |o - c - u d|^2   where   u = (o - c) . d
//! ```
//! Where steps are equal, [`differences`] goes further, to sums; those of a march are not.

mod coefficients;
pub mod differences;

use crate::analysis::range::Ranges;
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::passes::simplify::unit_vectors::are_parts_of_unit;
use coefficients::Build;
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::{Op, Runtime, Type};

/// What roundings may come to, beside terms that are greater than their sum.
pub(super) const SOUND: f64 = 1.0 / 1_048_576.0;

/// How many times the greatest value on the way a term may be.
const LARGER: f64 = 4.0;

/// How long a chain of operations is looked through.
const DEEP: u32 = 64;

/// How many turns a loop is taken to make, if it may: what is computed before it is to pay.
const TURNS: u32 = 8;

/// How many values are weighed one by one.
const MANY: usize = 100;

/// The graph with such polynomials; nothing where there are none that pay.
pub fn polynomials(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Option<Graph> {
    let found = Loops::new(graph, ranges, runtime);
    let put: FxHashSet<NodeId> = (found.candidates().into_values())
        .flat_map(|candidates| found.worth(candidates))
        .collect();
    if put.is_empty() {
        return None;
    }
    let mut known = FxHashMap::default();
    Some(rebuild_old(graph, &mut |builder, made, id, span| {
        let atom = put.contains(&id).then(|| found.of(id))??.atom?;
        let mut build = Build {
            loops: &found,
            builder,
            made,
            known: &mut known,
            span,
        };
        let coefficients = build.coefficients(id)?;
        match found.completes_square(id) {
            true => build.completed_square(coefficients, atom),
            false => build.horner(coefficients, atom),
        }
    }))
}

/// A value of a loop's body as a polynomial.
#[derive(Clone, Copy)]
struct Polynomial {
    /// The value that it is one in; nothing where it is the same at each turn.
    atom: Option<NodeId>,
    degree: usize,
    /// What its coefficients' magnitudes are at most, the constant one first.
    sizes: [f64; 3],
    /// The greatest magnitude of a value on the way.
    most: f64,
    deep: u32,
    slopes: Slopes,
}

/// What the atom is multiplied by, where that is a value of the graph: of a value of the first
/// degree, or of each of up to three whose squares make one of the second, as far as they are
/// known.
type Slopes = [Option<NodeId>; 3];

const NO_SLOPES: Slopes = [None; 3];

/// The values of loops as polynomials.
struct Loops<'g> {
    graph: &'g Graph,
    runtime: &'g Runtime,
    /// The innermost loop whose turns change each value.
    homes: Vec<Option<LoopId>>,
    rates: Rates,
    /// Each value that is no atom.
    known: Vec<Option<Polynomial>>,
    users: Vec<Vec<NodeId>>,
    ranges: &'g Ranges,
}

impl<'g> Loops<'g> {
    fn new(graph: &'g Graph, ranges: &'g Ranges, runtime: &'g Runtime) -> Loops<'g> {
        let rates = rates(graph);
        let mut loops = Loops {
            graph,
            runtime,
            homes: homes(graph, &rates),
            rates,
            known: Vec::with_capacity(graph.nodes.len()),
            users: vec![Vec::new(); graph.nodes.len()],
            ranges,
        };
        let reached = graph.reached();
        for id in graph.ids() {
            loops.known.push(loops.polynomial(id));
            if reached[id.0 as usize] {
                for of in graph.references(id) {
                    loops.users[of.0 as usize].push(id);
                }
            }
        }
        loops
    }

    fn home(&self, id: NodeId) -> Option<LoopId> {
        self.homes[id.0 as usize]
    }

    fn of(&self, id: NodeId) -> Option<Polynomial> {
        self.known.get(id.0 as usize).copied().flatten()
    }

    fn size(&self, id: NodeId) -> f64 {
        let range = self.ranges.result.get(id.0 as usize);
        range.map_or(f64::INFINITY, |range| range.magnitude())
    }

    /// An operand in a loop: what is no polynomial in another value is one in itself.
    fn operand(&self, of: LoopId, id: NodeId) -> Polynomial {
        let size = self.size(id);
        let inside = self.home(id) == Some(of);
        match self.of(id) {
            Some(polynomial) if inside => polynomial,
            _ if inside => Polynomial {
                atom: Some(id),
                degree: 1,
                sizes: [0.0, 1.0, 0.0],
                most: size,
                deep: 0,
                slopes: NO_SLOPES,
            },
            _ => Polynomial {
                atom: None,
                degree: 0,
                sizes: [size, 0.0, 0.0],
                most: size,
                deep: 0,
                slopes: NO_SLOPES,
            },
        }
    }

    /// A value as a polynomial in another one. One that is only moved from the other is taken
    /// for a value of its own.
    fn polynomial(&self, id: NodeId) -> Option<Polynomial> {
        let of = self.home(id)?;
        let Node::Apply(op, [a, b]) = self.graph.node(id) else {
            return None;
        };
        if self.graph.ty(id) != Type::Real {
            return None;
        }
        let x = self.operand(of, a);
        let y = match op {
            Op::Neg => x,
            Op::Add | Op::Sub | Op::Mul | Op::Div => self.operand(of, b),
            _ => return None,
        };
        let atom = match (x.atom, y.atom) {
            (Some(x), Some(y)) if x != y => return None,
            (x, y) => x.or(y)?,
        };
        let (degree, sizes) = match op {
            Op::Neg => (x.degree, x.sizes),
            Op::Mul => (x.degree + y.degree, products(x.sizes, y.sizes)),
            // As many times as great as the quotient is.
            Op::Div if y.degree == 0 => {
                let part = self.size(id) / self.size(a).max(f64::MIN_POSITIVE);
                (x.degree, x.sizes.map(|size| size * part))
            }
            Op::Div => return None,
            _ => (
                x.degree.max(y.degree),
                [0, 1, 2].map(|k| x.sizes[k] + y.sizes[k]),
            ),
        };
        let moved = matches!(op, Op::Add | Op::Sub)
            && [(a, y), (b, x)]
                .iter()
                .any(|(id, other)| *id == atom && other.degree == 0);
        let deep = x.deep.max(y.deep) + 1;
        (degree <= 2 && deep <= DEEP && !moved).then_some(Polynomial {
            atom: Some(atom),
            degree,
            sizes,
            most: x.most.max(y.most).max(self.size(id)),
            deep,
            slopes: slopes(op, [a, b], [&x, &y]),
        })
    }

    /// By loop, the values that something else than a polynomial needs, which may be put by
    /// Horner's rule.
    fn candidates(&self) -> FxHashMap<LoopId, Vec<NodeId>> {
        self.candidates_by(|id, polynomial| self.is_sound(polynomial) || self.completes_square(id))
    }

    /// The same of those that something else may be made of.
    fn candidates_by(
        &self,
        may_be: impl Fn(NodeId, &Polynomial) -> bool,
    ) -> FxHashMap<LoopId, Vec<NodeId>> {
        let mut all: FxHashMap<LoopId, Vec<NodeId>> = FxHashMap::default();
        for id in self.graph.ids() {
            let Some((home, polynomial)) = self.home(id).zip(self.of(id)) else {
                continue;
            };
            let ends = |user: &NodeId| {
                let same = self.of(*user).filter(|of| of.atom == polynomial.atom);
                same.is_none_or(|of| !may_be(*user, &of))
            };
            let used = self.users[id.0 as usize].iter().any(ends)
                || self.graph.roots().any(|root| root == id);
            if used && may_be(id, &polynomial) {
                all.entry(home).or_default().push(id);
            }
        }
        all
    }

    /// The greatest magnitude of one of a polynomial's terms.
    fn greatest_term(&self, of: &Polynomial) -> f64 {
        let at = of.atom.map_or(f64::INFINITY, |atom| self.size(atom));
        let [low, linear, square] = of.sizes;
        low.max(linear * at).max(square * at * at)
    }

    /// Whether the terms may be rounded by themselves.
    fn is_sound(&self, of: &Polynomial) -> bool {
        let most = self.greatest_term(of);
        match of.degree {
            2 => most * self.runtime.real.epsilon() <= SOUND,
            _ => most <= LARGER * of.most && of.most.is_finite(),
        }
    }

    /// Whether a value is a sum of squares along a direction of length 1, whose terms may not be
    /// rounded by themselves.
    fn completes_square(&self, id: NodeId) -> bool {
        let Some(of) = self.of(id).filter(|of| of.degree == 2) else {
            return false;
        };
        let slopes: Vec<NodeId> = of.slopes.into_iter().flatten().collect();
        !self.is_sound(&of)
            && slopes.len() == 3
            && are_parts_of_unit(&|id| self.graph.node(id), &slopes)
    }

    fn cycles(&self, op: Op) -> f64 {
        let routine = self.runtime.usual(op);
        routine.map_or(0.0, |routine| f64::from(routine.cycles))
    }

    /// What a value takes at a turn by Horner's rule, in cycles.
    fn by_horner(&self, id: NodeId, degree: usize) -> f64 {
        let [times, sum] = [Op::Mul, Op::Add].map(|op| self.cycles(op));
        match self.home(id).filter(|_| self.completes_square(id)) {
            Some(home) => {
                let turns = self.graph.loops[home.0 as usize].max.clamp(1, TURNS);
                times + 2.0 * sum + (9.0 * times + 7.0 * sum) / f64::from(turns)
            }
            None => degree as f64 * (times + sum),
        }
    }

    /// What the values of a loop's turn save that take so many cycles then.
    fn gain(&self, put: &[NodeId], takes: &dyn Fn(NodeId, usize) -> f64) -> f64 {
        let mut gone: FxHashSet<NodeId> = FxHashSet::default();
        let mut gain = 0.0;
        let Some((home, last)) = put.first().and_then(|id| self.home(*id)).zip(put.last()) else {
            return 0.0;
        };
        for id in (0..=last.0).rev().map(NodeId) {
            let Some(polynomial) = self.of(id).filter(|_| self.home(id) == Some(home)) else {
                continue;
            };
            let is_put = put.contains(&id);
            let users = &self.users[id.0 as usize];
            if is_put || (!users.is_empty() && users.iter().all(|user| gone.contains(user))) {
                gone.insert(id);
                if let Node::Apply(op, _) = self.graph.node(id) {
                    gain += self.cycles(op);
                }
            }
            if is_put {
                gain -= takes(id, polynomial.degree);
            }
        }
        gain
    }

    /// Those of a loop's candidates that together are worth it by Horner's rule.
    fn worth(&self, put: Vec<NodeId>) -> Vec<NodeId> {
        self.worth_by(put, |id, degree| self.by_horner(id, degree))
    }

    /// The same where each takes so many cycles.
    fn worth_by(&self, mut put: Vec<NodeId>, takes: impl Fn(NodeId, usize) -> f64) -> Vec<NodeId> {
        let mut gain = self.gain(&put, &takes);
        if put.len() <= MANY {
            for id in put.clone() {
                let without: Vec<NodeId> = put.iter().copied().filter(|of| *of != id).collect();
                let other = self.gain(&without, &takes);
                if other >= gain {
                    (gain, put) = (other, without);
                }
            }
        }
        match gain > 0.0 {
            true => put,
            false => Vec::new(),
        }
    }
}

/// The innermost loop whose turns change each value.
fn homes(graph: &Graph, rates: &Rates) -> Vec<Option<LoopId>> {
    // A loop within another one carries its values later.
    let mut carries: FxHashMap<LoopId, NodeId> = FxHashMap::default();
    for id in graph.ids() {
        if let Node::Carried { of, .. } = graph.node(id) {
            carries.entry(of).or_insert(id);
        }
    }
    let home = |id| {
        let loops = rates.rate(id).iter().filter_map(|by| match by {
            Dependence::Loop(of) => Some(*of),
            _ => None,
        });
        loops.max_by_key(|of| carries.get(of).copied())
    };
    graph.ids().map(home).collect()
}

/// The slopes of a result, of two operands and what they are as polynomials.
fn slopes(op: Op, [a, b]: [NodeId; 2], [x, y]: [&Polynomial; 2]) -> Slopes {
    let some = |of: &Polynomial| of.slopes.into_iter().flatten();
    let known = |of: &Polynomial| some(of).count();
    match (op, x.degree, y.degree) {
        (Op::Neg, 1, _) | (Op::Add | Op::Sub, _, 0) => x.slopes,
        (Op::Add, 0, _) | (Op::Sub, 0, 1) => y.slopes,
        (Op::Mul, 1, 0) if x.atom == Some(a) => [Some(b), None, None],
        (Op::Mul, 0, 1) if y.atom == Some(b) => [Some(a), None, None],
        (Op::Mul, 1, 1) if a == b => x.slopes,
        (Op::Add, 2, 2) if known(x) > 0 && known(y) > 0 && known(x) + known(y) <= 3 => {
            let mut all = some(x).chain(some(y));
            [all.next(), all.next(), all.next()]
        }
        _ => NO_SLOPES,
    }
}

fn products(x: [f64; 3], y: [f64; 3]) -> [f64; 3] {
    let times = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
    [
        times(x[0], y[0]),
        times(x[0], y[1]) + times(x[1], y[0]),
        times(x[0], y[2]) + times(x[1], y[1]) + times(x[2], y[0]),
    ]
}

#[cfg(test)]
mod tests;
