//! Liveness over the graph: which values a pixel needs at all.

use crate::ir::graph::*;

/// Which nodes the ink and what is sent to later pixels need, carried values only where they are read. As long
/// as the graph's nodes.
pub fn needed(graph: &Graph) -> Vec<bool> {
    let mut seen = vec![false; graph.nodes.len()];
    let mut todo: Vec<NodeId> = graph.roots().collect();
    while let Some(id) = todo.pop() {
        let Some(flag) = seen.get_mut(id.0 as usize).filter(|flag| !**flag) else {
            continue;
        };
        *flag = true;
        let of_loop = |of: LoopId| graph.loops.get(of.0 as usize);
        let pick = |list: &[NodeId], index: u32| list.get(index as usize).copied();
        match graph.node(id) {
            Node::Result { of, index } => todo.extend(of_loop(of).into_iter().flat_map(|l| {
                [
                    Some(l.again),
                    pick(&l.done, index),
                    pick(&l.otherwise, index),
                ]
                .into_iter()
                .flatten()
            })),
            Node::Carried { of, index } | Node::Last { of, index } => {
                todo.extend(of_loop(of).into_iter().flat_map(|l| {
                    [pick(&l.init, index), pick(&l.next, index)]
                        .into_iter()
                        .flatten()
                }));
            }
            node => todo.extend(node.operands()),
        }
    }
    seen
}

/// Which carried values of a loop are read, by index, given what is [`needed`].
pub fn live_carried(graph: &Graph, needed: &[bool], of: LoopId) -> Vec<u32> {
    let mut live: Vec<u32> = graph
        .ids()
        .filter(|id| needed.get(id.0 as usize) == Some(&true))
        .filter_map(|id| match graph.node(id) {
            Node::Carried { of: l, index } | Node::Last { of: l, index } if l == of => Some(index),
            _ => None,
        })
        .collect();
    live.sort_unstable();
    live.dedup();
    live
}
