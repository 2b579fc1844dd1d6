//! Euclidean norms whose squares leave the format: the vector is scaled by a power of
//! two first (Blue 1978), where the ranges of its components ask for it.
//!
//! In 16.16 the square of 182 is beyond the greatest real, and that of 1/256 is the last
//! place. Where all vectors are so short, they are all scaled, so that the longest one's
//! squares just fit. Where some may be too long, the others would lose their digits by that:
//! there the sum of squares decides, which saturates. Lengths that are not in danger are left
//! alone, and so are long vectors of which hardly a bound is known, as in loops.

use super::form::Out;
use super::site::Known;
use crate::ir::graph::*;
use slowlight_routine::Op;

const NAME: &str = "length of a scaled vector";

/// Below this many times the format's least positive real, a square has lost bits that
/// matter in the length: a vector a quarter as long has 8 of them left.
const COARSE: f64 = 4096.0;

/// A vector may be as long as the format's greatest real over this: what is longer comes
/// from ranges that were given up.
const BOUNDED: f64 = 8.0;

/// The most components of a vector.
const COMPONENTS: usize = 4;

/// A root or a component divided by it, of a vector that is scaled where it has to be.
pub fn rewrite(known: &Known<'_>, id: NodeId, out: &mut Out<'_>) -> Option<(&'static str, NodeId)> {
    let (usual, scaled, long) = match known.graph.node(id) {
        Node::Apply(Op::Sqrt, [sum, _]) => {
            let vector = Scaled::of(known, id)?;
            let sum = (out.new)(sum)?;
            let (length, back) = (vector.length(out)?, out.real(1.0 / vector.by));
            let usual = out.apply(Op::Sqrt, &[sum]);
            (usual, out.apply(Op::Mul, &[length, back]), vector.long)
        }
        Node::Apply(Op::Div, [component, root]) => {
            let vector = Scaled::of(known, root)?;
            let one = vector.find(known, component)?;
            let (one, length) = (vector.component(one, out)?, vector.length(out)?);
            let Node::Apply(Op::Sqrt, [sum, _]) = known.graph.node(root) else {
                return None;
            };
            let sum = (out.new)(sum)?;
            let usual = out.apply(Op::Sqrt, &[sum]);
            let component = (out.new)(component)?;
            let usual = out.apply(Op::Div, &[component, usual]);
            (usual, out.apply(Op::Div, &[one, length]), vector.long)
        }
        _ => return None,
    };
    let put = match long {
        None => scaled,
        Some(sum) => {
            let (sum, most) = ((out.new)(sum)?, out.real(known.most / 2.0));
            let fits = out.apply(Op::Less, &[sum, most]);
            out.builder.select(fits, usual, scaled, out.span)
        }
    };
    Some((NAME, put))
}

/// A component of a vector: a value, or the square of a constant.
#[derive(Clone, Copy)]
enum Component {
    Value(NodeId),
    Square(f64),
}

/// A vector that is to be multiplied by a power of two.
struct Scaled {
    components: Vec<Component>,
    by: f64,
    /// The sum of its squares, where that tells whether the vector is too long.
    long: Option<NodeId>,
}

impl Scaled {
    fn of(known: &Known<'_>, root: NodeId) -> Option<Scaled> {
        let Node::Apply(Op::Sqrt, [sum, _]) = known.graph.node(root) else {
            return None;
        };
        let mut components = Vec::new();
        squares(known.graph, sum, &mut components)?;
        let sizes = components.iter().map(|component| match component {
            Component::Value(id) => known.range(*id).magnitude(),
            Component::Square(square) => square.sqrt(),
        });
        let longest = sizes.fold(0.0, f64::max);
        // Where no end is near, none is met.
        if known.least == 0.0 || longest == 0.0 || longest >= known.most / BOUNDED {
            return None;
        }
        let overflows = known.argument(root).hi >= 0.9 * known.most;
        let vanishes = longest * longest < COARSE * known.least;
        // Some room for what roundings add.
        let fits = 0.9 * (known.most / components.len() as f64).sqrt();
        (overflows || vanishes).then_some(Scaled {
            components,
            by: (fits / longest).log2().floor().exp2(),
            long: overflows.then_some(sum),
        })
    }

    /// Which of the components a value is.
    fn find(&self, known: &Known<'_>, value: NodeId) -> Option<Component> {
        if let Some(constant) = known.graph.constant(value) {
            let constant = constant.real();
            let sign = if constant < 0.0 { -1.0 } else { 1.0 };
            return Some(Component::Square(sign * constant * constant));
        }
        let is = |component: &&Component| matches!(component, Component::Value(id) if *id == value);
        self.components.iter().find(is).copied()
    }

    /// A component, scaled.
    fn component(&self, one: Component, out: &mut Out<'_>) -> Option<NodeId> {
        Some(match one {
            Component::Value(id) => {
                let (id, by) = ((out.new)(id)?, out.real(self.by));
                out.apply(Op::Mul, &[id, by])
            }
            Component::Square(square) => out.real(square.abs().sqrt().copysign(square) * self.by),
        })
    }

    /// The scaled vector's length.
    fn length(&self, out: &mut Out<'_>) -> Option<NodeId> {
        let mut sum = None;
        for &one in &self.components {
            let scaled = self.component(one, out)?;
            let square = out.apply(Op::Mul, &[scaled, scaled]);
            sum = Some(match sum {
                None => square,
                Some(sum) => out.apply(Op::Add, &[sum, square]),
            });
        }
        Some(out.apply(Op::Sqrt, &[sum?]))
    }
}

/// The components whose squares a sum is of, at least one of them no constant.
fn squares(graph: &Graph, sum: NodeId, found: &mut Vec<Component>) -> Option<()> {
    let mut todo = vec![sum];
    while let Some(id) = todo.pop() {
        match graph.node(id) {
            Node::Apply(Op::Add, [a, b]) => todo.extend([b, a]),
            Node::Apply(Op::Mul, [a, b]) if a == b => found.push(Component::Value(a)),
            Node::Const(_) => {
                let square = graph.constant(id)?.real();
                if square < 0.0 {
                    return None;
                }
                found.push(Component::Square(square));
            }
            _ => return None,
        }
        if found.len() > COMPONENTS {
            return None;
        }
    }
    let value = |one: &Component| matches!(one, Component::Value(_));
    found.iter().any(value).then_some(())
}
