//! Parallel copies: assignments that are made all at once, in some order.

use crate::ir::graph::*;
use crate::ir::tree::*;
use std::collections::BTreeSet;

/// Sets a loop's carried values to their next ones, all at once: a value that
/// another move still reads is saved first.
pub fn moves(graph: &Graph, of: LoopId, live: &[u32]) -> Block {
    let found = &graph.loops[of.0 as usize];
    let next_of = |k: u32| found.next[k as usize];
    let read = |id| match graph.node(id) {
        Node::Carried { of: l, index } if l == of => Some(index),
        _ => None,
    };
    let mut left: Vec<u32> = live
        .iter()
        .copied()
        .filter(|&k| read(next_of(k)) != Some(k))
        .collect();
    let (mut block, mut saved) = (Block::new(), BTreeSet::new());
    while !left.is_empty() {
        let free = |k: &u32| {
            !left
                .iter()
                .any(|&other| other != *k && !saved.contains(k) && read(next_of(other)) == Some(*k))
        };
        match left.iter().copied().find(free) {
            Some(k) => {
                left.retain(|&other| other != k);
                let from = match read(next_of(k)) {
                    Some(source) if saved.contains(&source) => Origin::Scratch(of, source),
                    _ => Origin::Node(next_of(k)),
                };
                block.push(Statement::Set {
                    place: Place::Carried(of, k),
                    from,
                });
            }
            None => {
                let k = left[0];
                saved.insert(k);
                let Some(carried) = graph.ids().find(|&id| read(id) == Some(k)) else {
                    break;
                };
                let from = Origin::Node(carried);
                block.push(Statement::Set {
                    place: Place::Scratch(of, k),
                    from,
                });
            }
        }
    }
    block
}
