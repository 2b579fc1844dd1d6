//! Vector-norm facts: the lengths of multiples of unit vectors are known.
//!
//! The way from a hit back to the eye is the ray's direction times a distance; over its
//! length it is that direction, turned round. A vector of length 1 is known by how it
//! was made: each of three values over the root of the sum of their squares. The length
//! of k times it is |k|, and a part of that over |k| is the part of the vector, with the
//! sign of k. Exact arithmetic, fewer roundings, and a root and three quotients less.

use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use slowlight_routine::Op;
use std::collections::{BTreeMap, BTreeSet};

/// A root of three squares, and what is squared.
type Length = [NodeId; 3];

/// The graph with such lengths and parts; nothing where there are none.
pub fn unit_vectors(graph: &Graph, ranges: &Ranges) -> Option<Graph> {
    // The parts of what has no length are nothing over nothing.
    let some = |id: &NodeId| ranges.result.get(id.0 as usize).is_some_and(|r| r.lo > 0.0);
    let lengths: BTreeMap<NodeId, Length> = graph
        .ids()
        .filter_map(|id| Some((id, length(&|id| graph.node(id), id)?)))
        .collect();
    let known: BTreeSet<NodeId> = lengths.keys().copied().filter(some).collect();
    let find = Find {
        graph,
        lengths,
        known,
    };
    let multiples: BTreeMap<NodeId, NodeId> = (find.lengths.iter())
        .filter_map(|(id, parts)| Some((*id, find.factor(parts)?)))
        .collect();
    if multiples.is_empty() {
        return None;
    }
    Some(rebuild_old(graph, &mut |builder, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        if let Some(&k) = multiples.get(&id) {
            return Some(builder.apply(Op::Abs, &[new(k)?], span));
        }
        let Node::Apply(Op::Div, [part, by]) = graph.node(id) else {
            return None;
        };
        let k = *multiples.get(&by)?;
        let Multiple { unit, minus, .. } = find.multiple(part, |m| m.k == k)?;
        let range = ranges.result.get(k.0 as usize)?;
        let turned = match (range.lo > 0.0, range.hi < 0.0) {
            (true, _) => minus,
            (_, true) => !minus,
            _ => return None,
        };
        let unit = new(unit)?;
        Some(match turned {
            true => builder.apply(Op::Neg, &[unit], span),
            false => unit,
        })
    }))
}

/// A part of a unit vector times a factor, or its negative.
#[derive(Clone, Copy)]
struct Multiple {
    unit: NodeId,
    k: NodeId,
    minus: bool,
}

struct Find<'g> {
    graph: &'g Graph,
    lengths: BTreeMap<NodeId, Length>,
    /// Those that are more than 0.
    known: BTreeSet<NodeId>,
}

impl Find<'_> {
    /// The factor by which all three parts are those of one unit vector.
    fn factor(&self, parts: &Length) -> Option<NodeId> {
        let first = parts.first()?;
        self.multiples(*first).into_iter().find_map(|one| {
            let of = self.vector(one.unit)?;
            let all: Option<Vec<NodeId>> = parts
                .iter()
                .map(|part| {
                    Some(
                        self.multiple(*part, |m| m.k == one.k && self.vector(m.unit) == Some(of))?
                            .unit,
                    )
                })
                .collect();
            let mut all = all?;
            all.sort_unstable();
            all.dedup();
            (all.len() == 3).then_some(one.k)
        })
    }

    fn multiple(&self, id: NodeId, right: impl Fn(&Multiple) -> bool) -> Option<Multiple> {
        self.multiples(id).into_iter().find(right)
    }

    /// What a value is a multiple of.
    fn multiples(&self, id: NodeId) -> Vec<Multiple> {
        match self.graph.node(id) {
            Node::Apply(Op::Neg, [a, _]) => {
                let turned = |m: Multiple| Multiple {
                    minus: !m.minus,
                    ..m
                };
                self.multiples(a).into_iter().map(turned).collect()
            }
            Node::Apply(Op::Mul, [a, b]) => {
                let of = |unit, k| {
                    self.vector(unit)?;
                    Some(Multiple {
                        unit,
                        k,
                        minus: false,
                    })
                };
                [of(a, b), of(b, a)].into_iter().flatten().collect()
            }
            _ => Vec::new(),
        }
    }

    /// The length by which a part of a unit vector was divided.
    fn vector(&self, id: NodeId) -> Option<NodeId> {
        let Node::Apply(Op::Div, [part, by]) = self.graph.node(id) else {
            return None;
        };
        let right = self.known.contains(&by) && self.lengths.get(&by)?.contains(&part);
        right.then_some(by)
    }
}

/// What is squared under a root of three squares; they must be three values.
fn length(node: &dyn Fn(NodeId) -> Node, id: NodeId) -> Option<Length> {
    let Node::Apply(Op::Sqrt, [sum, _]) = node(id) else {
        return None;
    };
    let (mut squared, mut todo) = (Vec::new(), vec![sum]);
    while let Some(term) = todo.pop() {
        match node(term) {
            Node::Apply(Op::Add, [a, b]) if squared.len() < 3 => todo.extend([a, b]),
            Node::Apply(Op::Mul, [a, b]) if a == b => squared.push(a),
            _ => return None,
        }
    }
    squared.sort_unstable();
    squared.dedup();
    squared.try_into().ok()
}

/// Whether values, or their negatives, are the parts of one vector over its length.
pub fn are_parts_of_unit(node: &dyn Fn(NodeId) -> Node, values: &[NodeId]) -> bool {
    let quotient = |id: NodeId| match node(id) {
        Node::Apply(Op::Neg, [of, _]) => node(of),
        of => of,
    };
    let parts: Option<Vec<(NodeId, NodeId)>> = (values.iter())
        .map(|id| match quotient(*id) {
            Node::Apply(Op::Div, [part, by]) => Some((by, part)),
            _ => None,
        })
        .collect();
    let Some((mut parts, by)) = parts.and_then(|parts| Some((parts.clone(), parts.first()?.0)))
    else {
        return false;
    };
    parts.sort_unstable();
    length(node, by).is_some_and(|of| parts == of.map(|part| (by, part)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::range::{Slack, ranges};
    use crate::eval::drawn::{grid, picture};
    use crate::passes::simplify::fold::fold;
    use crate::scene;
    use crate::schedule::statements::schedule;
    use crate::sema::Options;
    use slowlight_runtime_jack::F316;

    fn lowered(t: &str, way: &str) -> Graph {
        let source = format!(
            "image 8 x 8 inks black, white; param p: vec3 = (1, 2, 3) in (0, 1, -3) .. (4, 5, 6);
             draw (x, y) = {{
               let d = unit((x - 4, y - 3.3, p.x - 9));
               let t = {t};
               let b = unit({way});
               ink(if b.x + 0.7 * b.y > 0.1 then 1 else 0)
             }};"
        );
        let options = Options {
            inks: Some(2),
            ..Options::default()
        };
        fold(
            &scene::check("test", &source)
                .lower(&options)
                .expect(&source),
        )
    }

    fn count(graph: &Graph, op: Op) -> usize {
        let reached = graph.reached();
        let of = |id: &NodeId| matches!(graph.node(*id), Node::Apply(o, _) if o == op);
        let all = graph.ids().filter(|id| reached[id.0 as usize]);
        all.filter(of).count()
    }

    #[test]
    fn the_way_back_along_a_ray_is_its_direction() {
        for (t, way, roots, quotients) in [
            ("p.y", "-(t * d)", 1, 2),
            ("-p.y", "t * d", 1, 2),
            // Of unknown sign: the length is known, the direction is not.
            ("p.z", "t * d", 1, 4),
            ("p.y", "(0.25, 0, 0) - t * d", 2, 5),
            ("p.y", "(t * d.x, t * d.y, p.z * d.z)", 2, 5),
            ("p.y", "(t * d.x, t * d.y, t * d.y)", 2, 4),
        ] {
            let graph = lowered(t, way);
            assert_eq!(count(&graph, Op::Sqrt), 2, "{t}, {way}");
            let tree = schedule(&graph);
            let ranges = ranges(&graph, &tree, &Slack::of(&F316));
            let found = unit_vectors(&graph, &ranges);
            assert_eq!(found.is_some(), roots < 2, "{t}, {way}");
            let next = found.map_or(graph.clone(), |next| fold(&next));
            let counts = (count(&next, Op::Sqrt), count(&next, Op::Div));
            assert_eq!(counts, (roots, quotients), "{t}, {way}");
            let places = grid(8, 8, 1);
            let plain = picture(&graph, &tree, &places);
            assert_eq!(
                picture(&next, &schedule(&next), &places),
                plain,
                "{t}, {way}"
            );
        }
    }
}
