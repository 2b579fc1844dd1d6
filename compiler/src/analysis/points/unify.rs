//! Unification of scales (union of live ranges that share a home): what values agree on that are
//! copied to one place.

use crate::ir::graph::*;
use slowlight_routine::Type;

/// Other homes that nodes share: a node's number there.
pub(crate) type Other = fn(&Node) -> Option<usize>;

/// Has all that is carried into a turn, comes out of a loop, or shares another home agree on
/// what `pick` takes of any two, and says what that is of each loop's values. `none` is what
/// `pick` never takes.
pub(crate) fn agreed<T: Copy>(
    graph: &Graph,
    own: &mut [T],
    (none, pick): (T, fn(T, T) -> T),
    (others, other): (usize, Other),
) -> Vec<Vec<T>> {
    let of_loop = |l: &Loop| vec![none; l.types.len()];
    let mut carried: Vec<Vec<T>> = graph.loops.iter().map(of_loop).collect();
    let mut homes = vec![none; others];
    for setting in [true, false] {
        for id in graph.ids().filter(|id| graph.ty(*id) == Type::Real) {
            let node = graph.node(id);
            let shared = match node {
                Node::Carried { of, index } | Node::Last { of, index } => {
                    (carried.get_mut(of.0 as usize)).and_then(|l| l.get_mut(index as usize))
                }
                _ => other(&node).and_then(|home| homes.get_mut(home)),
            };
            match (shared, own.get_mut(id.0 as usize)) {
                (Some(shared), Some(own)) if setting => *shared = pick(*shared, *own),
                (Some(shared), Some(own)) => *own = *shared,
                _ => {}
            }
        }
    }
    carried
}
