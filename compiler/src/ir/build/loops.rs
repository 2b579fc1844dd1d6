//! Loops in a graph under construction.

use super::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use slowlight_routine::{Op, Type, Value};

impl Builder {
    /// Opens a loop with carried values; close it with [`Builder::close_loop`].
    pub fn open_loop(
        &mut self,
        max: u32,
        carried: &[(String, Type, NodeId)],
        span: Span,
    ) -> LoopId {
        let again = self.constant(Value::Bool(false), span);
        let init = carried
            .iter()
            .map(|&(_, ty, init)| match (ty, self.ty(init)) {
                (Type::Real, Type::Int) => self.apply(Op::ToReal, &[init], span),
                _ => init,
            })
            .collect();
        self.loops.push(Loop {
            max: max.clamp(1, 65535),
            names: carried.iter().map(|(name, ..)| name.clone()).collect(),
            types: carried.iter().map(|&(_, ty, _)| ty).collect(),
            init,
            again,
            next: Vec::new(),
            done: Vec::new(),
            otherwise: Vec::new(),
            span,
        });
        LoopId(u32::try_from(self.loops.len() - 1).unwrap_or(u32::MAX))
    }

    fn carried_type(&self, of: LoopId, index: u32) -> Type {
        let found = self
            .loops
            .get(of.0 as usize)
            .and_then(|l| l.types.get(index as usize));
        found.copied().unwrap_or(Type::Real)
    }

    /// A carried value, in the body.
    pub fn carried(&mut self, of: LoopId, index: u32, span: Span) -> NodeId {
        let ty = self.carried_type(of, index);
        self.add(Node::Carried { of, index }, ty, span)
    }

    /// What the last `next` gave, in the `else`.
    pub fn last(&mut self, of: LoopId, index: u32, span: Span) -> NodeId {
        let ty = self.carried_type(of, index);
        self.add(Node::Last { of, index }, ty, span)
    }

    /// Closes a loop: whether it goes on, the next carried values, its results
    /// when it ends by itself and when `max` turns have passed. Answers the
    /// results' nodes. `next`, `done` and `otherwise` are widened to the types
    /// of the carried values and of each other.
    pub fn close_loop(
        &mut self,
        of: LoopId,
        again: NodeId,
        next: &[NodeId],
        done: &[NodeId],
        otherwise: &[NodeId],
    ) -> Vec<NodeId> {
        let Some(at) = self.loops.get(of.0 as usize) else {
            return Vec::new();
        };
        let (types, span) = (at.types.clone(), at.span);
        let widen = |b: &mut Builder, id: NodeId, want: Type| match (want, b.ty(id)) {
            (Type::Real, Type::Int) => b.apply(Op::ToReal, &[id], span),
            _ => id,
        };
        let next: Vec<NodeId> = next
            .iter()
            .zip(&types)
            .map(|(&n, &ty)| widen(self, n, ty))
            .collect();
        let (mut ends, mut elses, mut results) = (Vec::new(), Vec::new(), Vec::new());
        for (index, (&d, &o)) in done.iter().zip(otherwise).enumerate() {
            let undefined = |b: &Builder, id| b.undefined_type(id);
            let ty = match (undefined(self, d), undefined(self, o)) {
                (true, _) => self.ty(o),
                (_, true) => self.ty(d),
                _ if self.ty(d) == Type::Real || self.ty(o) == Type::Real => Type::Real,
                _ => self.ty(d),
            };
            ends.push(widen(self, d, ty));
            elses.push(widen(self, o, ty));
            results.push((index as u32, ty));
        }
        if let Some(l) = self.loops.get_mut(of.0 as usize) {
            (l.again, l.next, l.done, l.otherwise) = (again, next, ends, elses);
        }
        results
            .into_iter()
            .map(|(index, ty)| self.add(Node::Result { of, index }, ty, span))
            .collect()
    }
}
