//! Change of variable along a ray: its points by the distance to them.
//!
//! Where a ray meets a sphere the library says in two steps: from the point of the ray
//! nearest to the centre, which is o - b d for a ray that starts at o from there, by k along
//! the ray, half a chord. That is o + t d with t = k - b, the distance that is known anyway.
//! Both take three products; but where a comparison of polynomials tells whether the ray
//! meets the sphere at all, nobody else needs that nearest point.
//!
//! Over the reals both are the same. Roundings differ little: b d is as large as t d, and is
//! as far off. What is measured in small spheres' radii is left as it is.

use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use slowlight_routine::Op;

/// The graph with such points; nothing where there are none.
pub fn by_ray_parameter(graph: &Graph) -> Option<Graph> {
    let reached = graph.reached();
    let ids = || graph.ids().filter(|id| reached[id.0 as usize]);
    ids().find(|id| Way::of(graph, *id).is_some())?;
    Some(rebuild_old(graph, &mut |builder, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        if let Some(way) = Way::of(graph, id) {
            let [b, d, o] = [way.b, way.d, way.o].map(new);
            let (b, d, o) = (b?, d?, o?);
            let mut apply = |op, args: &[NodeId]| builder.apply(op, args, span);
            let minus = apply(Op::Neg, &[b]);
            let t = match way.k {
                Chord::Either { near, half } => {
                    let (near, half) = (new(near)?, new(half)?);
                    let [yes, no] = [Op::Sub, Op::Add].map(|op| apply(op, &[minus, half]));
                    builder.select(near, yes, no, span)
                }
                Chord::One(k) => apply(Op::Add, &[minus, new(k)?]),
            };
            let by = builder.apply(Op::Mul, &[d, t], span);
            return Some(from(builder, o, by, span));
        }
        // Back to where the way was measured from.
        let Node::Apply(Op::Add, [x, y]) = graph.node(id) else {
            return None;
        };
        [(x, y), (y, x)].into_iter().find_map(|(centre, way)| {
            Way::of(graph, way)?;
            match builder.node(new(way)?) {
                Node::Apply(Op::Sub, [point, of]) if of == new(centre)? => Some(point),
                _ => None,
            }
        })
    }))
}

/// A way from a place, which may be the difference of two: along it from the first of them.
fn from(b: &mut Builder, place: NodeId, by: NodeId, span: crate::source::Span) -> NodeId {
    match b.node(place) {
        Node::Apply(Op::Sub, [start, centre]) => {
            let point = b.apply(Op::Add, &[start, by], span);
            b.apply(Op::Sub, &[point, centre], span)
        }
        _ => b.apply(Op::Add, &[place, by], span),
    }
}

/// (o - b d) + k d.
struct Way {
    o: NodeId,
    b: NodeId,
    d: NodeId,
    k: Chord,
}

/// Half a chord, forwards or backwards.
enum Chord {
    /// Backwards where the nearer end is meant.
    Either {
        near: NodeId,
        half: NodeId,
    },
    One(NodeId),
}

impl Way {
    fn of(graph: &Graph, id: NodeId) -> Option<Way> {
        let Node::Apply(Op::Add, [x, y]) = graph.node(id) else {
            return None;
        };
        [(x, y), (y, x)]
            .into_iter()
            .find_map(|(nearest, further)| Way::matched(graph, nearest, further))
    }

    fn matched(graph: &Graph, nearest: NodeId, further: NodeId) -> Option<Way> {
        let (Node::Apply(Op::Sub, [o, back]), Node::Apply(Op::Mul, on)) =
            (graph.node(nearest), graph.node(further))
        else {
            return None;
        };
        let Node::Apply(Op::Mul, back) = graph.node(back) else {
            return None;
        };
        let turned = |[x, y]: [NodeId; 2]| [(x, y), (y, x)];
        let pairs = turned(back)
            .into_iter()
            .flat_map(|b| turned(on).into_iter().map(move |k| (b, k)));
        let same = |((_, d), (_, e)): &((NodeId, NodeId), (NodeId, NodeId))| d == e;
        let ((b, d), (k, _)) = pairs.into_iter().find(same)?;
        let k = chord(graph, k);
        Some(Way { o, b, d, k })
    }
}

fn chord(graph: &Graph, k: NodeId) -> Chord {
    match graph.node(k) {
        Node::Select { cond, yes, no } if graph.node(yes) == Node::Apply(Op::Neg, [no, no]) => {
            Chord::Either {
                near: cond,
                half: no,
            }
        }
        _ => Chord::One(k),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::analysis::verify::verify;
    use crate::eval::native::Native;
    use crate::source::Span;
    use slowlight_routine::{Type, Value};

    const AT: Span = Span {
        file: 0,
        start: 0,
        end: 0,
        within: None,
        effect: None,
    };

    /// A point on a ray in the two steps, of whole numbers so that no rounding differs; with
    /// half a chord of either sign where `either`.
    fn picture(either: bool) -> Graph {
        let mut b = Builder::new();
        let x = b.axis(Axis::X, AT);
        let y = b.axis(Axis::Y, AT);
        let [start, d] = [x, y].map(|axis| b.apply(Op::ToReal, &[axis], AT));
        let [centre, factor, half] = [3.0, 5.0, 7.0].map(|n| b.constant(Value::Real(n), AT));
        let half = b.apply(Op::Add, &[half, start], AT);
        let factor = b.apply(Op::Sub, &[factor, d], AT);
        let o = b.apply(Op::Sub, &[start, centre], AT);
        let back = b.apply(Op::Mul, &[factor, d], AT);
        let nearest = b.apply(Op::Sub, &[o, back], AT);
        let near = b.apply(Op::Less, &[d, start], AT);
        let minus = b.apply(Op::Neg, &[half], AT);
        let k = match either {
            true => b.select(near, minus, half, AT),
            false => half,
        };
        let on = b.apply(Op::Mul, &[k, d], AT);
        let way = b.apply(Op::Add, &[nearest, on], AT);
        let point = b.apply(Op::Add, &[centre, way], AT);
        let both = b.apply(Op::Mul, &[way, point], AT);
        let whole = b.apply(Op::Floor, &[both], AT);
        let mask = b.constant(Value::Int(255), AT);
        let ink = b.apply(Op::BitAnd, &[whole, mask], AT);
        assert_eq!(b.ty(ink), Type::Int);
        let image = Image {
            block: (1, 1),
            width: 23,
            height: 17,
            palette: vec![[0; 3]; 256],
        };
        b.finish(image, ink, None)
    }

    #[test]
    fn points_are_the_same_by_their_distance() {
        for either in [false, true] {
            let graph = picture(either);
            let made = by_ray_parameter(&graph).unwrap();
            verify(&made).unwrap();
            let products = |g: &Graph| {
                let reached = g.reached();
                let product = |id: &NodeId| matches!(g.node(*id), Node::Apply(Op::Mul, _));
                g.ids()
                    .filter(|id| reached[id.0 as usize] && product(id))
                    .count()
            };
            // The way back is gone.
            assert_eq!(products(&made) + 1, products(&graph), "{made}");
            let (mut before, mut after) = (Native::new(&graph), Native::new(&made));
            for y in 0..17 {
                for x in 0..23 {
                    assert_eq!(before.pixel(x, y), after.pixel(x, y), "{made}");
                }
            }
            assert!(by_ray_parameter(&made).is_none());
        }
    }
}
