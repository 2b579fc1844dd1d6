//! Monotone functions after choices: the least of some roots is the root of the least, and what is
//! chosen of some roots the root of what is chosen. One root is left of many, or none where
//! nothing but a comparison asks: with another root, or with what no pixel has to square.

use crate::analysis::range::Ranges;
use crate::analysis::rate::{Rates, rates};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use slowlight_routine::{Op, Runtime, Type, Value};

/// Squares of what is greater are left to roots: formats of few bits have no room for them.
pub const MOST: f64 = 1000.0;

/// The graph with roots behind choices; nothing where none is chosen.
pub fn root_of_choice(graph: &Graph, ranges: &Ranges, _: &Runtime) -> Option<Graph> {
    let mut site = Site {
        graph,
        ranges,
        squares: vec![None; graph.nodes.len()],
        rates: rates(graph),
    };
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let made = site.chosen(builder, &new, id, span)?;
        done = true;
        Some(made)
    });
    done.then_some(next)
}

type New<'n> = &'n dyn Fn(NodeId) -> Option<NodeId>;

struct Site<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    /// Of old values that are roots, what of.
    squares: Vec<Option<NodeId>>,
    rates: Rates,
}

impl Site<'_> {
    /// What a value is the root of; what no pixel computes is one if another is.
    fn square(&self, b: &mut Builder, new: New<'_>, id: NodeId, span: Span) -> Option<NodeId> {
        match (self.graph.constant(id), self.squares[id.0 as usize]) {
            (Some(Value::Real(real)), _) if (0.0..=MOST).contains(&real) => {
                Some(b.constant(Value::Real(real * real), span))
            }
            (None, None) => {
                let range = self.ranges.result.get(id.0 as usize)?;
                let fits = self.rates.is_still(id) && range.within(0.0, MOST);
                let now = new(id).filter(|_| fits)?;
                Some(b.apply(Op::Mul, &[now, now], span))
            }
            (_, square) => square,
        }
    }

    /// A choice among roots as the root of one, a comparison of roots as one of squares.
    fn chosen(&mut self, b: &mut Builder, new: New<'_>, id: NodeId, span: Span) -> Option<NodeId> {
        let node = self.graph.node(id);
        if let Node::Apply(Op::Sqrt, [of, _]) = node {
            let range = self.ranges.result.get(of.0 as usize)?;
            self.squares[id.0 as usize] = new(of).filter(|_| range.lo >= 0.0);
            return None;
        }
        let sides = match node {
            Node::Select { yes, no, .. } if self.graph.ty(id) == Type::Real => [yes, no],
            Node::Apply(Op::Min | Op::Max | Op::Less | Op::LessEqual, sides) => sides,
            _ => return None,
        };
        if sides[0] == sides[1] || sides.iter().all(|id| self.squares[id.0 as usize].is_none()) {
            return None;
        }
        let one = self.square(b, new, sides[0], span)?;
        let other = self.square(b, new, sides[1], span)?;
        let square = match node {
            Node::Select { cond, .. } => b.select(new(cond)?, one, other, span),
            Node::Apply(op @ (Op::Less | Op::LessEqual), _) => {
                return Some(b.apply(op, &[one, other], span));
            }
            Node::Apply(op, _) => b.apply(op, &[one, other], span),
            _ => return None,
        };
        self.squares[id.0 as usize] = Some(square);
        Some(b.apply(Op::Sqrt, &[square], span))
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

    #[test]
    fn one_root_is_left_of_the_least_of_some() {
        let source = "image 32 x 16 inks black, white;
             draw (x, y) = {
               let d = length((x - 15.5, y - 7.5));
               let e = length((x - 11.5, y - 3.5));
               let f = length((x - 20, y - 5));
               let near = min(if d < e then d else e, min(f, 9));
               threshold(near / 10, bayer(4)[x mod 4, y mod 4])
             };";
        let scene = scene::check("test", source);
        let graph = scene.lower(&Options::default()).unwrap();
        let runtime = find("bbc:micro").unwrap().runtime;
        let plain = Context::new(graph.clone(), runtime).simplified(&graph);
        let made = root_of_choice(&plain.graph, &plain.ranges, runtime).unwrap();
        verify(&made).unwrap();
        let reached = made.reached();
        let root = |id: &NodeId| matches!(made.node(*id), Node::Apply(Op::Sqrt, _));
        let roots = made.ids().filter(|id| reached[id.0 as usize] && root(id));
        assert_eq!(roots.count(), 1, "{made}");
        let (mut before, mut after) = (Native::new(&plain.graph), Native::new(&made));
        for (x, y) in (0..16).flat_map(|y| (0..32).map(move |x| (x, y))) {
            let inks = [&mut before, &mut after].map(|graph| graph.pixel(x, y).ink);
            assert_eq!(inks[0], inks[1], "at {x}, {y}");
        }
    }
}
