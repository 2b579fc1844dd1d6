//! Language invariants assumed by the range analysis: what is trusted of directions and of what
//! they are made of.

use super::Walk;
use crate::ir::graph::*;
use crate::ir::interval::interval;
use crate::ir::tree::Statement;
use slowlight_routine::{Op, Range};
use std::collections::BTreeSet;

/// Values whose squares are summed under a root: who asks for a length does not take it
/// for 1. The way from a sphere's centre to a point is a normal only where the point
/// lies on it, and may be the same value as what its distance is made of elsewhere.
fn measured(graph: &Graph) -> BTreeSet<NodeId> {
    let (mut all, mut arrays) = (BTreeSet::new(), false);
    for id in graph.ids() {
        let Node::Apply(Op::Sqrt | Op::ReciprocalRoot, [sum, _]) = graph.node(id) else {
            continue;
        };
        let (mut todo, mut seen) = (vec![sum], 0);
        while let Some(term) = todo.pop() {
            seen += 1;
            match graph.node(term) {
                Node::Apply(Op::Add, [a, b]) if seen < 2 * TERMS => todo.extend([a, b]),
                Node::Apply(Op::Mul, [a, b]) if a == b => {
                    all.insert(a);
                }
                Node::Tabulated(value) => {
                    todo.push(value);
                    arrays = true;
                }
                _ => {}
            }
        }
    }
    if arrays {
        let copy = |id: &&NodeId| all.iter().any(|of| is_copy(graph, *of, **id, COPY));
        let copies: Vec<NodeId> = graph.directions.keys().filter(copy).copied().collect();
        all.extend(copies);
    }
    all
}

/// The lengths of directions that are trusted, by node: of those whose lengths nobody asks
/// for.
pub(super) fn lengths(graph: &Graph) -> Vec<Option<f64>> {
    let mut lengths = vec![None; graph.nodes.len()];
    for (id, length) in &graph.directions {
        lengths[id.0 as usize] = Some(*length);
    }
    if !graph.directions.is_empty() {
        measured(graph)
            .iter()
            .for_each(|id| lengths[id.0 as usize] = None);
    }
    lengths
}

/// Whether a value of a column is what pixels have of it, out of its array or computed
/// again ([`crate::passes::loops::scalar_expansion`]).
fn is_copy(graph: &Graph, of: NodeId, id: NodeId, deep: u32) -> bool {
    let bare = |id: NodeId| match graph.node(id) {
        Node::Tabulated(value) => value,
        _ => id,
    };
    let [of, id] = [of, id].map(bare);
    of == id
        || match (graph.node(of), graph.node(id)) {
            (Node::Apply(op, a), Node::Apply(other, b)) if op == other && deep > 0 => {
                let mut pairs = a.into_iter().zip(b).take(op.arity());
                pairs.all(|(a, b)| is_copy(graph, a, b, deep - 1))
            }
            _ => false,
        }
}

/// How deep copies are compared.
const COPY: u32 = 6;

/// How many terms of a sum are looked at.
const TERMS: usize = 8;

impl Walk<'_> {
    /// A component of a direction whose range is unknown is trusted to be what
    /// the contract says, twice over for what roundings add.
    pub(super) fn trust(&self, id: NodeId, range: Range) -> Range {
        match (self.once.length(id), self.slack.direction) {
            (Some(length), Some(unit)) if range.magnitude() > 16.0 * length => {
                range.meet(Range::new(unit.lo * length, unit.hi * length))
            }
            _ => range,
        }
    }

    /// A term over the sum of two that are not negative is at most 1.
    ///
    /// A part of a vector over the vector's length is at most 1, twice over for what
    /// roundings add: a quotient by the root of a sum that has the dividend's square
    /// among terms of no negative. Where squares end at the greatest value that the
    /// format has, lengths end at its root. Where small values lose all their digits
    /// nothing is known.
    pub(super) fn part_of_length(&self, id: NodeId, exact: Range) -> Range {
        match self.graph.node(id) {
            Node::Apply(Op::Div, [part, whole]) if self.is_share(part, whole) => {
                exact.meet(Range::new(0.0, 1.0))
            }
            Node::Apply(Op::Sub, [whole, floor]) if self.is_floor(id, floor, whole) => {
                exact.meet(Range::new(0.0, 1.0))
            }
            Node::Apply(Op::Add, operands) => self.interpolated(id, operands, exact),
            _ if !self.slack.relative => exact,
            Node::Apply(Op::Div, [part, by]) => match self.over_length(part, by) {
                Some(most) => exact.meet(Range::new(-most, most)),
                None => self.multiple_over_factor((part, by), exact),
            },
            Node::Apply(Op::Mul, [a, b]) => {
                let shorter = self.shortened(a, b).or_else(|| self.shortened(b, a));
                shorter.map_or(exact, |shorter| exact.meet(shorter))
            }
            _ => exact,
        }
    }

    /// Whether a value is one of two terms of a sum, neither of which is negative.
    fn is_share(&self, part: NodeId, whole: NodeId) -> bool {
        let no_negative = |id: NodeId| self.read(id).lo >= 0.0;
        match self.graph.node(whole) {
            Node::Apply(Op::Add, [a, b]) => {
                (a == part || b == part) && no_negative(a) && no_negative(b)
            }
            _ => false,
        }
    }

    /// A part times c - d / length is c times the part less d times a part of a unit
    /// vector: what leads to the nearest point of a ring. For logarithms: elsewhere squares
    /// of small parts may be nothing, and what is divided by them anything.
    fn shortened(&self, by: NodeId, part: NodeId) -> Option<Range> {
        if self.slack.direction.is_some() {
            return None;
        }
        let Node::Apply(Op::Sub, [c, quotient]) = self.graph.node(by) else {
            return None;
        };
        let Node::Apply(Op::Div, [d, least]) = self.graph.node(quotient) else {
            return None;
        };
        let known = |id: NodeId| self.graph.constant(id).is_some();
        let length = match self.graph.node(least) {
            Node::Apply(Op::Max, [a, b]) if known(b) => a,
            Node::Apply(Op::Max, [b, a]) if known(b) => a,
            _ => least,
        };
        if !self.has_part(length, part) {
            return None;
        }
        let whole = interval(Op::Mul, [self.read(c), self.read(part)], false);
        let unit = self.read(d).magnitude() * self.most_of_length(part);
        Some(Range::new(whole.lo - unit, whole.hi + unit))
    }

    /// The most that a part over its length is.
    fn most_of_length(&self, part: NodeId) -> f64 {
        let longest = self.slack.most().sqrt();
        2.0 * (self.read(part).magnitude() / longest).max(1.0)
    }

    /// The most that a part of a vector over its length is, or a multiple of that: of what is
    /// cut at 0 by a sign, as in the gradient of a distance.
    fn over_length(&self, part: NodeId, length: NodeId) -> Option<f64> {
        if self.has_part(length, part) {
            return Some(self.most_of_length(part));
        }
        let Node::Apply(Op::Mul, [a, b]) = self.graph.node(part) else {
            return None;
        };
        let of = |part, by| {
            let has = self.has_part(length, part);
            has.then(|| self.most_of_length(part) * self.read(by).magnitude())
        };
        of(a, b).or_else(|| of(b, a))
    }

    /// Whether a value is the root of a sum that has the other's square among terms of no
    /// negative.
    fn has_part(&self, length: NodeId, part: NodeId) -> bool {
        let Node::Apply(Op::Sqrt, [sum, _]) = self.graph.node(length) else {
            return false;
        };
        let (mut squared, mut todo) = (false, vec![(sum, false)]);
        while let Some((term, in_array)) = todo.pop() {
            match self.graph.node(term) {
                Node::Apply(Op::Add, args) if todo.len() < TERMS => {
                    todo.extend(args.map(|term| (term, in_array)));
                }
                Node::Tabulated(value) => todo.push((value, true)),
                Node::Apply(Op::Mul, [a, b])
                    if in_array && a == b && is_copy(self.graph, a, part, COPY) =>
                {
                    squared = true;
                }
                _ if self.is_square(term, part) => squared = true,
                _ if self.read(term).lo >= 0.0 => {}
                _ => return false,
            }
        }
        squared
    }

    /// Whether a value is the square of another, be it by arms of a choice.
    fn is_square(&self, square: NodeId, of: NodeId) -> bool {
        match (self.graph.node(square), self.graph.node(of)) {
            (Node::Apply(Op::Mul, [a, b]), _) => a == b && a == of,
            (
                Node::Select { cond, yes, no },
                Node::Select {
                    cond: by,
                    yes: y,
                    no: n,
                },
            ) => cond == by && self.is_square(yes, y) && self.is_square(no, n),
            (Node::Const(square), Node::Const(of)) => {
                let root = of.value().real();
                square.value().real() == root * root
            }
            _ => false,
        }
    }

    /// A multiple over its factor is at most the other factor, twice over for what
    /// roundings add; or 1, where the product is less than the format tells from 0.
    fn multiple_over_factor(&self, (multiple, by): (NodeId, NodeId), exact: Range) -> Range {
        let bare = |id: NodeId| match self.graph.node(id) {
            Node::Apply(Op::Neg | Op::Abs, [a, _]) => a,
            _ => id,
        };
        let by = bare(by);
        let other = match self.graph.node(bare(multiple)) {
            Node::Apply(Op::Mul, [a, b]) if b == by => a,
            Node::Apply(Op::Mul, [a, b]) if a == by => b,
            _ => return exact,
        };
        let most = 2.0 * self.read(other).magnitude().max(1.0);
        exact.meet(Range::new(-most, most))
    }

    /// What a trusted direction was subtracted from is not far from what was
    /// subtracted: a point where a ray meets a sphere from its centre. Where both are
    /// computed under the same conditions only.
    pub(super) fn trust_back(&mut self, id: NodeId, before: &[Statement]) {
        if self.once.length(id).is_none() {
            return;
        }
        let Node::Apply(Op::Sub, [point, from]) = self.graph.node(id) else {
            return;
        };
        if !before.contains(&Statement::Let(point)) {
            return;
        }
        let args = [self.read(from), self.read(id)];
        let sum = interval(Op::Add, args, false);
        let near = self.slack.rounded(Op::Add, &args, sum);
        let at = point.0 as usize;
        self.now[at] = self.now[at].meet(near);
    }
}

#[cfg(test)]
mod tests {
    use crate::plan::Goal;
    use crate::planner::plan;
    use crate::scene;
    use crate::sema::Options;
    use crate::targets::{default_mode, find};
    use slowlight_routine::{Op, Range};

    /// The widest range of the results of an operation in a scene's plan for Jack.
    fn widest(source: &str, op: Op) -> Range {
        let options = Options {
            inks: Some(2),
            ..Options::default()
        };
        let graph = scene::check("test", source).lower(&options).expect(source);
        let target = find("jack").expect("a target");
        let mode = default_mode(target, 8, 8).expect("a mode");
        let goal = Goal {
            name: "test".to_owned(),
            mode,
            rows: None,
            plot: true,
        };
        let plan = plan(&graph, target, &goal).expect(source);
        let of = |id: &crate::ir::graph::NodeId| matches!(plan.graph.node(*id), crate::ir::graph::Node::Apply(o, _) if o == op);
        let all = plan.graph.ids().filter(of);
        let all = all.map(|id| plan.ranges.result[id.0 as usize]);
        all.reduce(Range::join).expect("one at least")
    }

    #[test]
    fn a_part_over_its_length_is_small_and_over_another_not() {
        let scene = |by: &str| {
            format!(
                "image 8 x 8 inks black, white; param p: vec3 = (1, 2, 3) in (-9, -9, -9) .. (9, 9, 9);
                 draw (x, y) = ink(if (p.x + x) / sqrt({by}) > 0.5 then 1 else 0);"
            )
        };
        let own = widest(&scene("(p.x + x) * (p.x + x) + p.y * p.y + y * y"), Op::Div);
        assert!(own.within(-2.1, 2.1), "{own:?}");
        let other = widest(&scene("(p.x - x) * (p.x - x) + p.y * p.y + y * y"), Op::Div);
        assert!(!other.within(-100.0, 100.0), "{other:?}");
    }

    #[test]
    fn what_has_its_length_asked_for_is_measured() {
        let source = "image 8 x 8 inks black, white;
            draw (x, y) = {
              let far = (x - 3, y + 0.5, 2.5);
              let near = (x + 7.5, y - 9, 1);
              ink(if length(far) > near.x * near.x + near.y * near.y then 1 else 0)
            };";
        let options = Options {
            inks: Some(2),
            ..Options::default()
        };
        let graph = scene::check("test", source)
            .lower(&options)
            .expect("a graph");
        // Two parts of the one vector, and none of the other's.
        assert_eq!(super::measured(&graph).len(), 2);
    }
}
