//! Unswitching: inks that depend on the pixel through one bool alone are chosen by it.
//!
//! Where the floor is chequered, which of two tiles a pixel shows decides in the
//! middle of comparisons that the run of columns knows otherwise. Any function of
//! a bool is a choice between the two that it is where the bool holds and where it
//! does not (Shannon's expansion); each of these is known before the run's first
//! pixel. It copies the choices, so it is for the plan to find out whether it pays.

use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::schedule::segment::Known;
use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Type, Value};

/// What a value depends on beside what its run knows.
#[derive(Clone, Copy, PartialEq)]
enum Depends {
    Nothing,
    /// One such bool.
    On(NodeId),
    /// More than that.
    Other,
}

impl Depends {
    fn and(self, other: Depends) -> Depends {
        match (self, other) {
            (Depends::Nothing, one) | (one, Depends::Nothing) => one,
            (a, b) if a == b => a,
            _ => Depends::Other,
        }
    }
}

/// The graph with such values chosen by their bools; nothing where there are none.
pub fn unswitch(graph: &Graph) -> Option<Graph> {
    let known = Known::of(graph);
    let mut depends = Vec::with_capacity(graph.nodes.len());
    for id in graph.ids() {
        let at = |id: NodeId| -> Depends { depends[id.0 as usize] };
        let found = match graph.node(id) {
            _ if known.before(id) => Depends::Nothing,
            _ if known.stepped(id) => Depends::On(id),
            Node::Select { cond, yes, no } => at(cond).and(at(yes)).and(at(no)),
            Node::Apply(Op::Not, [a, _]) => at(a),
            _ => Depends::Other,
        };
        depends.push(found);
    }
    let chosen = |id: NodeId| match graph.node(id) {
        Node::Select { cond, yes, no } => {
            known.stepped(cond) && known.before(yes) && known.before(no)
        }
        _ => false,
    };
    let mut some = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let Depends::On(cond) = depends[id.0 as usize] else {
            return None;
        };
        let fits = matches!(graph.node(id), Node::Select { .. }) && graph.ty(id) == Type::Int;
        if !fits || chosen(id) {
            return None;
        }
        let mut arm = |holds: bool| {
            Arm {
                graph,
                made,
                known: &known,
                cond,
                holds,
                done: FxHashMap::default(),
            }
            .put(builder, id, span)
        };
        let (yes, no) = (arm(true)?, arm(false)?);
        some = true;
        let cond = made[cond.0 as usize]?;
        Some(builder.select(cond, yes, no, span))
    });
    some.then_some(next)
}

/// What values are where a bool holds, or does not.
struct Arm<'a, 'g> {
    known: &'a Known<'g>,
    graph: &'g Graph,
    made: &'a [Option<NodeId>],
    cond: NodeId,
    holds: bool,
    done: FxHashMap<NodeId, NodeId>,
}

impl Arm<'_, '_> {
    fn put(&mut self, builder: &mut Builder, id: NodeId, span: Span) -> Option<NodeId> {
        if id == self.cond {
            return Some(builder.constant(Value::Bool(self.holds), span));
        }
        if self.known.before(id) {
            return self.made[id.0 as usize];
        }
        if let Some(&done) = self.done.get(&id) {
            return Some(done);
        }
        let put = match self.graph.node(id) {
            Node::Select { cond, yes, no } => {
                let cond = self.put(builder, cond, span)?;
                // What is never chosen is not put.
                match builder.value(cond).map(Value::truth) {
                    Some(true) => self.put(builder, yes, span)?,
                    Some(false) => self.put(builder, no, span)?,
                    None => {
                        let (yes, no) =
                            (self.put(builder, yes, span)?, self.put(builder, no, span)?);
                        builder.select(cond, yes, no, span)
                    }
                }
            }
            Node::Apply(op, [a, _]) => {
                let a = self.put(builder, a, span)?;
                builder.apply(op, &[a], span)
            }
            _ => return None,
        };
        self.done.insert(id, put);
        Some(put)
    }
}
