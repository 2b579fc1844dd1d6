//! Structural hashing of forms: a number that two forms have alike if they are built alike.
//!
//! Forms are judged at hundreds of samples, and the same ones again and again, each time in a
//! graph of its own with other forms beside them. What such a form comes to hangs on its
//! operations, its constants and what of the old graph it reads, so that is what its number is
//! made of.

use super::New;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use rustc_hash::{FxHashMap, FxHasher};
use std::hash::{Hash, Hasher};

/// How deep forms are followed.
const DEEP: u32 = 200;

/// Numbers of what is built in the place of an old graph's values.
pub struct Keys<'b> {
    builder: &'b Builder,
    known: FxHashMap<NodeId, u64>,
}

impl<'b> Keys<'b> {
    /// For what is made of some values of an old graph, which stand for themselves.
    pub fn new(builder: &'b Builder, new: New<'_>, shared: &[NodeId]) -> Keys<'b> {
        let number = |old: &NodeId| Some((new(*old)?, hash(&(1_u8, old))));
        Keys {
            builder,
            known: shared.iter().filter_map(number).collect(),
        }
    }

    /// The number of a form; nothing where it reads a table by itself, or is too deep.
    pub fn of(&mut self, id: NodeId) -> Option<u64> {
        self.at(id, 0)
    }

    fn at(&mut self, id: NodeId, deep: u32) -> Option<u64> {
        if let Some(known) = self.known.get(&id) {
            return Some(*known);
        }
        let node = self.builder.node(id);
        if deep > DEEP || matches!(node, Node::Lookup { .. }) {
            return None;
        }
        let mut hasher = FxHasher::default();
        node.with(|_| NodeId(0)).hash(&mut hasher);
        for operand in node.operands() {
            self.at(operand, deep + 1)?.hash(&mut hasher);
        }
        let made = hasher.finish();
        self.known.insert(id, made);
        Some(made)
    }
}

fn hash(of: &impl Hash) -> u64 {
    let mut hasher = FxHasher::default();
    of.hash(&mut hasher);
    hasher.finish()
}

/// The tables' entries and ints that an old value is made of: what is the same in its forms.
pub fn shared(graph: &Graph, of: NodeId) -> Vec<NodeId> {
    let mut seen = vec![false; of.0 as usize + 1];
    let (mut all, mut todo) = (Vec::new(), vec![of]);
    while let Some(id) = todo.pop() {
        let Some(seen) = seen.get_mut(id.0 as usize).filter(|seen| !**seen) else {
            continue;
        };
        *seen = true;
        let node = graph.node(id);
        let int = graph.ty(id) == slowlight_routine::Type::Int;
        if matches!(node, Node::Lookup { .. }) || int {
            all.push(id);
        }
        todo.extend(node.operands());
    }
    all
}

/// How many values near another are the same in its forms, where these are judged by their
/// operands.
const NEAR: usize = 64;

/// The values that an old value is made of, those first that it is made of directly: so many.
pub fn near(graph: &Graph, of: NodeId) -> Vec<NodeId> {
    let mut all = vec![of];
    let mut at = 0;
    while let Some(&id) = all.get(at).filter(|_| all.len() < NEAR) {
        for operand in graph.node(id).operands() {
            if !all.contains(&operand) {
                all.push(operand);
            }
        }
        at += 1;
    }
    all.split_off(1)
}
