//! Leaves out what nothing needs: a loop or table that no output reaches would
//! still have its number, and so change what is generated from the rest.

use crate::ir::graph::*;

/// The graph without unreached loops and tables; nodes keep their numbers.
pub(super) fn compact(mut graph: Graph) -> Graph {
    let reached = graph.reached();
    let mut loops = vec![false; graph.loops.len()];
    let mut tables = vec![false; graph.tables.len()];
    for (node, reached) in graph.nodes.iter().zip(&reached) {
        if *reached {
            if let Some(flag) = loop_of(node).and_then(|l| loops.get_mut(l.0 as usize)) {
                *flag = true;
            }
            if let Node::Lookup { table, .. } = node
                && let Some(flag) = tables.get_mut(table.0 as usize)
            {
                *flag = true;
            }
        }
    }
    let new_loops = renumber(&loops);
    let new_tables = renumber(&tables);
    for ((node, ty), reached) in graph.nodes.iter_mut().zip(&graph.types).zip(&reached) {
        let found = match node {
            Node::Carried { of, .. } | Node::Last { of, .. } | Node::Result { of, .. } => {
                let new = new_loops.get(of.0 as usize).copied().flatten();
                new.map(|n| *of = LoopId(n))
            }
            Node::Lookup { table, .. } => {
                let new = new_tables.get(table.0 as usize).copied().flatten();
                new.map(|n| *table = TableId(n))
            }
            _ => Some(()),
        };
        if found.is_none() || !reached {
            *node = Node::Undefined(*ty);
        }
    }
    graph
        .names
        .retain(|id, _| reached.get(id.0 as usize) == Some(&true));
    let mut kept = loops.iter();
    graph.loops.retain(|_| kept.next() == Some(&true));
    let mut kept = tables.iter();
    graph.tables.retain(|_| kept.next() == Some(&true));
    graph
}

fn loop_of(node: &Node) -> Option<LoopId> {
    match node {
        Node::Carried { of, .. } | Node::Last { of, .. } | Node::Result { of, .. } => Some(*of),
        _ => None,
    }
}

fn renumber(kept: &[bool]) -> Vec<Option<u32>> {
    let mut next = 0;
    kept.iter()
        .map(|&keep| {
            let number = keep.then_some(next);
            next += u32::from(keep);
            number
        })
        .collect()
}
