//! Strength reduction of comparisons: a root that is only compared is compared by its square.
//!
//! sqrt(u) < c is u < c² where c is not below 0, and so with the other comparisons; two roots
//! compare as what they are of. |sqrt(u) - c| < k is u between two squares. A root takes as
//! long as several products, and c² is mostly known: c is a constant, or a row's. Roots that are
//! read by others, too, are [`crate::passes::algebra::root_of_choice`]'s, where that pays.
//!
//! Of what a root is of, its value below 0 counts as 0; where c may be 0 the ranges must prove
//! that it is none.

use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::algebra::root_of_choice::MOST;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use slowlight_routine::{Op, Range, Value};

/// The graph with squares compared; nothing where no root is compared alone.
pub fn square_comparisons(graph: &Graph, ranges: &Ranges) -> Option<Graph> {
    let site = Site {
        graph,
        ranges,
        uses: uses(graph),
    };
    let alone = site.compared_alone();
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let test = site.test(id)?;
        let mut roots = test.roots().into_iter().flatten();
        if !roots.all(|root| alone[root.0 as usize]) {
            return None;
        }
        done = true;
        test.squared(builder, &new, span)
    });
    done.then_some(next)
}

/// By whom each value is read: how often in all.
pub(crate) fn uses(graph: &Graph) -> Vec<u32> {
    let mut uses = vec![0; graph.nodes.len()];
    let mut read = |id: NodeId| uses[id.0 as usize] += 1;
    for id in graph.ids() {
        graph.node(id).operands().for_each(&mut read);
    }
    graph.loops.iter().flat_map(Loop::roots).for_each(&mut read);
    graph.outputs().for_each(&mut read);
    uses
}

type New<'n> = &'n dyn Fn(NodeId) -> Option<NodeId>;

/// What a root is compared with.
#[derive(Clone, Copy)]
enum With {
    /// Another value, not below 0.
    Value(NodeId),
    /// Another root, of this.
    Root { root: NodeId, of: NodeId },
    /// How far it is from a value that is further from 0: whether it is nearer than that.
    Around { center: NodeId, reach: NodeId },
}

/// A comparison of a root.
#[derive(Clone, Copy)]
struct Test {
    op: Op,
    root: NodeId,
    of: NodeId,
    with: With,
    /// Whether the root stands first.
    first: bool,
}

struct Site<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    uses: Vec<u32>,
}

impl Site<'_> {
    /// Which roots nothing reads but comparisons that need no root.
    fn compared_alone(&self) -> Vec<bool> {
        let mut left = self.uses.clone();
        for id in self.graph.ids() {
            for root in self.test(id).iter().flat_map(Test::roots).flatten() {
                left[root.0 as usize] -= 1;
            }
        }
        let is_root = |id: NodeId| matches!(self.graph.node(id), Node::Apply(Op::Sqrt, _));
        let alone = |id: NodeId| is_root(id) && left[id.0 as usize] == 0;
        self.graph.ids().map(alone).collect()
    }

    fn range(&self, id: NodeId) -> Range {
        match self.graph.constant(id) {
            Some(value) => Range::point(value.real()),
            None => (self.ranges.result.get(id.0 as usize).copied()).unwrap_or(Range::ALL),
        }
    }

    fn root(&self, id: NodeId) -> Option<NodeId> {
        match self.graph.node(id) {
            Node::Apply(Op::Sqrt, [of, _]) => Some(of),
            _ => None,
        }
    }

    /// The comparison of a root that a node is, if it may be one of squares.
    fn test(&self, id: NodeId) -> Option<Test> {
        let Node::Apply(op @ (Op::Less | Op::LessEqual), sides) = self.graph.node(id) else {
            return None;
        };
        if let Some(test) = self.around(op, sides) {
            return Some(test);
        }
        let k = (0..2).find(|k| self.root(sides[*k]).is_some())?;
        let (root, other) = (sides[k], sides[1 - k]);
        let of = self.root(root)?;
        let from_0 = self.range(of).lo >= 0.0;
        let with = match self.root(other) {
            Some(that) if from_0 && self.range(that).lo >= 0.0 && root != other => With::Root {
                root: other,
                of: that,
            },
            Some(_) => return None,
            None => {
                let range = self.range(other);
                let above = range.lo > 0.0 || range.lo == 0.0 && from_0;
                (above && range.hi <= MOST).then_some(With::Value(other))?
            }
        };
        Some(Test {
            op,
            root,
            of,
            with,
            first: k == 0,
        })
    }

    /// Whether a root is nearer to a value than so much.
    fn around(&self, op: Op, [far, reach]: [NodeId; 2]) -> Option<Test> {
        let Node::Apply(Op::Abs, [less, _]) = self.graph.node(far) else {
            return None;
        };
        let Node::Apply(Op::Sub, sides) = self.graph.node(less) else {
            return None;
        };
        let alone = |id: NodeId| self.uses[id.0 as usize] == 1;
        let k = (0..2).find(|k| self.root(sides[*k]).is_some())?;
        let (root, center) = (sides[k], sides[1 - k]);
        let of = self.root(root)?;
        let (c, r) = (self.range(center), self.range(reach));
        let further = c.lo > r.hi && r.lo >= 0.0 && c.hi + r.hi <= MOST;
        let fits = alone(far) && alone(less) && further && self.root(center).is_none();
        fits.then_some(Test {
            op,
            root,
            of,
            with: With::Around { center, reach },
            first: true,
        })
    }
}

impl Test {
    fn roots(&self) -> [Option<NodeId>; 2] {
        match self.with {
            With::Root { root, .. } => [Some(self.root), Some(root)],
            _ => [Some(self.root), None],
        }
    }

    /// The same of squares.
    fn squared(&self, b: &mut Builder, new: New<'_>, span: Span) -> Option<NodeId> {
        let of = new(self.of)?;
        let square = |b: &mut Builder, id: NodeId| b.apply(Op::Mul, &[id, id], span);
        let ordered = |b: &mut Builder, other: NodeId| {
            let args = if self.first { [of, other] } else { [other, of] };
            b.apply(self.op, &args, span)
        };
        Some(match self.with {
            With::Root { of, .. } => {
                let other = new(of)?;
                ordered(b, other)
            }
            With::Value(value) => {
                let value = new(value)?;
                let limit = square(b, value);
                ordered(b, limit)
            }
            With::Around { center, reach } => {
                let (center, reach) = (new(center)?, new(reach)?);
                let [least, most] = [Op::Sub, Op::Add].map(|op| {
                    let end = b.apply(op, &[center, reach], span);
                    square(b, end)
                });
                let below = b.apply(self.op, &[of, most], span);
                let above = b.apply(self.op, &[least, of], span);
                let no = b.constant(Value::Bool(false), span);
                b.select(below, above, no, span)
            }
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::analysis::verify::verify;
    use crate::eval::native::Native;
    use crate::planner::context::Context;
    use crate::scene;
    use crate::sema::Options;
    use crate::targets::find;

    fn roots(graph: &Graph) -> usize {
        let reached = graph.reached();
        let root = |id: &NodeId| matches!(graph.node(*id), Node::Apply(Op::Sqrt, _));
        graph
            .ids()
            .filter(|id| reached[id.0 as usize] && root(id))
            .count()
    }

    /// How many roots are left of those that a picture has, whose pixels stay as they are.
    fn left(ink: &str) -> usize {
        let source = format!(
            "image 32 x 16 inks black, white;
             param r: real = 6 in 1 .. 9;
             param s: real = 0 in -1 .. 1;
             draw (x, y) = {{
               let d = length((x - 15.5, y - 7.5));
               let e = length((x - 11.5, y - 3.5));
               {ink}
             }};"
        );
        let scene = scene::check("test", &source);
        assert!(scene.is_right(), "{source}: {:?}", scene.diagnostics);
        let graph = scene.lower(&Options::default()).unwrap();
        let runtime = find("bbc:micro").unwrap().runtime;
        let plain = Context::new(graph.clone(), runtime).simplified(&graph);
        let Some(made) = square_comparisons(&plain.graph, &plain.ranges) else {
            return roots(&plain.graph);
        };
        verify(&made).unwrap();
        let (mut before, mut after) = (Native::new(&plain.graph), Native::new(&made));
        for (x, y) in (0..16).flat_map(|y| (0..32).map(move |x| (x, y))) {
            let inks = [&mut before, &mut after].map(|graph| graph.pixel(x, y).ink);
            assert_eq!(inks[0], inks[1], "{ink} at {x}, {y}");
        }
        roots(&made)
    }

    #[test]
    fn roots_that_are_only_compared_are_none() {
        for test in [
            "d < 5.2",
            "d <= r",
            "5.2 < d",
            "r <= d",
            "d < e",
            "abs(d - 5.2) < 0.7",
        ] {
            assert_eq!(left(&format!("ink(if {test} then 1 else 0)")), 0, "{test}");
        }
    }

    #[test]
    fn other_roots_stay() {
        for (ink, roots) in [
            // What it is compared with may be below 0.
            ("ink(if d < s then 1 else 0)", 1),
            ("ink(if abs(d - 1) < r then 1 else 0)", 1),
            // It is read, too.
            (
                "threshold(if d < r then d / 10 else 0, bayer(2)[x mod 2, y mod 2])",
                1,
            ),
        ] {
            assert_eq!(left(ink), roots, "{ink}");
        }
    }
}
