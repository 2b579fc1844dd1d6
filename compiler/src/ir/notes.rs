//! Annotations: what is noted about values while a graph is built; none of it is computed.

use super::build::Builder;
use super::graph::*;
use slowlight_routine::{Op, Type};
use std::sync::Arc;

impl Builder {
    /// Remembers what the scene calls a value; the first name stays.
    pub fn name(&mut self, id: NodeId, name: &str) {
        self.name_as(id, || name.into());
    }

    /// The same where the name is there already.
    pub fn name_as(&mut self, id: NodeId, name: impl FnOnce() -> Arc<str>) {
        if !matches!(
            self.node(id),
            Node::Const(_) | Node::Undefined(_) | Node::Param(_)
        ) {
            self.names.entry(id).or_insert_with(name);
        }
    }

    /// Says that a node is a component of a vector of that length by contract;
    /// what was said first stays.
    pub fn direction(&mut self, id: NodeId, length: f64) {
        if self.ty(id) == Type::Real && self.value(id).is_none() {
            self.directions.entry(id).or_insert(length);
        }
    }

    /// Says that a bool is the same as a comparison.
    pub fn claim(&mut self, id: NodeId, op: Op, args: [NodeId; 2]) {
        if self.value(id).is_none() {
            self.claims.insert(id, (op, args));
        }
    }

    /// Counts a call of an effect.
    pub fn effect(&mut self, name: &str) {
        match self.effects.iter_mut().find(|e| e.name == name) {
            Some(found) => found.calls += 1,
            None => self.effects.push(EffectUse {
                name: name.to_owned(),
                calls: 1,
            }),
        }
    }
}
