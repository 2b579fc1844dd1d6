//! What the statements of a pixel read.

use crate::analysis::region::Fact;
use crate::ir::graph::{Axis, Node, NodeId};
use crate::ir::tree::*;
use crate::plan::Plan;
use crate::schedule::constant_runs::Still;

/// What some statements mention, with what is written where it is read.
pub struct Reads<'p> {
    plan: &'p Plan,
    /// What is known of a condition there.
    known: Option<Fact>,
    read: Vec<bool>,
}

/// What is read by a pixel that is in no run of known inks.
pub fn pixel(plan: &Plan) -> Reads<'_> {
    let mut reads = Reads::none(plan);
    // Runs of known inks are drawn apart where runs of columns are.
    let still = plan
        .still
        .as_ref()
        .filter(|_| !plan.tree.segment.is_empty());
    reads.known = still.and_then(Still::otherwise);
    reads.block(&plan.tree.pixel);
    reads.value(plan.graph.ink);
    plan.graph.left_to_others().for_each(|id| reads.value(id));
    reads
}

/// What is read where runs of columns begin.
pub fn segment(plan: &Plan) -> Reads<'_> {
    let mut reads = Reads::none(plan);
    reads.block(&plan.tree.segment);
    reads
}

impl<'p> Reads<'p> {
    fn none(plan: &'p Plan) -> Reads<'p> {
        Reads {
            plan,
            known: None,
            read: vec![false; plan.graph.nodes.len()],
        }
    }

    /// Whether a value is read.
    pub fn read(&self, id: NodeId) -> bool {
        self.read.get(id.0 as usize).is_some_and(|read| *read)
    }

    /// Whether the column is.
    pub fn column(&self) -> bool {
        let graph = &self.plan.graph;
        let column = |id: &NodeId| {
            matches!(
                graph.node(*id),
                Node::Axis(Axis::X | Axis::Run) | Node::Tabulated(_)
            )
        };
        graph
            .ids()
            .filter(|id| self.read(*id))
            .any(|id| column(&id))
    }

    fn value(&mut self, id: NodeId) {
        let Some(read) = self.read.get_mut(id.0 as usize) else {
            return;
        };
        if !std::mem::replace(read, true) && self.plan.folded(id) {
            self.operands(id);
        }
    }

    fn operands(&mut self, id: NodeId) {
        let plan = self.plan;
        let operands = plan.graph.node(id).inputs();
        operands.for_each(|operand| self.value(operand));
    }

    fn block(&mut self, block: &'p [Statement]) {
        for statement in block {
            match statement {
                Statement::Let(id) => self.operands(*id),
                Statement::Set {
                    from: Origin::Node(id),
                    ..
                } => self.value(*id),
                Statement::Set { .. } => {}
                Statement::If { cond, yes, no } => match self.known {
                    Some((of, holds)) if of == *cond => self.block(if holds { yes } else { no }),
                    _ => {
                        self.value(*cond);
                        self.block(yes);
                        self.block(no);
                    }
                },
                Statement::Loop(turns) => {
                    self.value(turns.again);
                    turns
                        .blocks()
                        .into_iter()
                        .for_each(|block| self.block(block));
                }
                Statement::Call(id) => self.block(self.plan.tree.body(*id)),
            }
        }
    }
}
