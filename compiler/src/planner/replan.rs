//! Replanning: other plans of the scene that a plan is of, for less memory or another question.

use super::made::{Candidate, candidate};
use super::pass_manager::Pipeline;
use super::planned::{PlannedScene, Rewriting};
use crate::cost::size_budget::SizeBudget;
use crate::fuel::Fuel;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::planner::context::Context;
use crate::planner::search::stepped::Steps;
use crate::targets::Lean;
use std::sync::Arc;

impl PlannedScene {
    /// What searching for it took, in units of [`crate::fuel::Fuel`].
    pub fn work(&self) -> u64 {
        self.work
    }

    /// What ran the passes for it and for other plans of its scene.
    pub fn pipeline(&self) -> &Pipeline {
        &self.cx.pipeline
    }

    /// Cycles a pixel, as plans of one scene are compared by where memory is no matter:
    /// routines where pixels run, what begins rows, passes and runs, and no drawing.
    pub fn cycles_a_pixel(&self) -> f64 {
        let known = self.cx.scheduled(self.graph.clone());
        self.cx.price(SizeBudget::default()).cycles_known(&known)
    }

    /// The same plan; those that are made from it have so many units of fuel each.
    #[must_use]
    pub fn allowed(&self, units: u64) -> PlannedScene {
        PlannedScene {
            allowance: units,
            ..self.clone()
        }
    }

    /// A plan of the same scene that computes the shade at every pixel, where
    /// this one does not: the dither may need less than the shade, and a
    /// picture's error is measured on shades. None where this plan will do.
    pub fn shaded(&self) -> Option<PlannedScene> {
        let shade = self.graph.shade?;
        let always = |b: &Block| b.iter().any(|s| writes(s, shade));
        let tree = &self.tree;
        let gone = matches!(self.graph.node(shade), Node::Undefined(_));
        if !gone && (self.place(shade).is_none() || tree.outer().into_iter().any(always)) {
            return None;
        }
        let mut graph = Graph::clone(&self.cx.origin);
        graph.reports.extend(graph.shade);
        let mut cx = Context::new(graph, self.runtime);
        cx.tables = self.target.columns_only;
        cx.pipeline = Pipeline::without(self.pipeline().without);
        let mut plan = self.again(&Arc::new(cx), self.rewriting)?;
        if self.calls_at_pixels() {
            plan = plan.outlined(&|_| None).ok()?;
        }
        Some(plan)
    }

    /// Whether it is slower than another of the same scene and target would be that had more
    /// memory.
    pub fn is_made_small(&self) -> bool {
        let plenty = matches!(self.rewriting, Rewriting::Fast { budget, .. } if budget.is_plenty());
        !plenty || self.tight || self.calls_at_pixels()
    }

    /// Whether there is a plan that spends less memory on speed.
    pub fn may_be_smaller(&self) -> bool {
        matches!(self.rewriting, Rewriting::Fast { .. })
    }

    /// A plan of the same scene with its formulas as the scene has them, but for what makes them
    /// stable: the simplest and about the smallest. None where this one has them so.
    pub fn stable(&self) -> Option<PlannedScene> {
        let fast = matches!(self.rewriting, Rewriting::Fast { .. });
        fast.then(|| self.again(&self.cx, Rewriting::Stable))
            .flatten()
    }

    /// In how many steps plans may spend less and less memory on speed; 1 where
    /// this one spends none.
    pub fn thrifts(&self) -> usize {
        match self.rewriting {
            Rewriting::Fast { .. } => SizeBudget::COUNT,
            _ => 1,
        }
    }

    /// What the passes make of the same scene by one of those steps, counted from 0.
    pub fn thriftier(&self, step: usize) -> Option<Candidate> {
        let budget = SizeBudget::step(step)?;
        if !self.may_be_smaller() {
            return None;
        }
        let steps = Steps::All;
        self.candidate(&self.cx, Rewriting::Fast { budget, steps })
    }

    /// The same plan with less that is stepped from column to column, which takes
    /// a little less memory. None where nothing is.
    pub fn unstepped(&self) -> Option<PlannedScene> {
        let Rewriting::Fast { budget, steps } = self.rewriting else {
            return None;
        };
        let ramp = |node: &Node| matches!(node, Node::Ramp { .. } | Node::Stepped { .. });
        let steps = match steps {
            Steps::All => Steps::Runs,
            Steps::Runs | Steps::None => Steps::None,
        };
        let less = Rewriting::Fast { budget, steps };
        let stepped = self.graph.nodes.iter().any(ramp);
        stepped.then(|| self.again(&self.cx, less)).flatten()
    }

    fn again(&self, cx: &Arc<Context>, rewriting: Rewriting) -> Option<PlannedScene> {
        self.completed(self.candidate(cx, rewriting)?)
    }

    fn candidate(&self, cx: &Arc<Context>, rewriting: Rewriting) -> Option<Candidate> {
        let fuel = Fuel::new(self.allowance);
        candidate(cx, self.target, &self.goal(), (rewriting, fuel)).ok()
    }

    /// The plan of a candidate, for the same screen and written in the same way.
    pub fn completed(&self, candidate: Candidate) -> Option<PlannedScene> {
        let mut plan = candidate
            .assembled(self.target, &self.goal(), self.looks)
            .ok()?;
        plan.looks = self.looks;
        plan.params = self.params.clone();
        plan.hold();
        plan.items = self.items.clone();
        plan.drawn = self.drawn;
        (plan.listing, plan.toot, plan.page) = (self.listing, self.toot, self.page);
        plan.undocumented = self.undocumented;
        plan.statics = self.statics;
        plan.lean = self.lean && self.target.lean == Lean::Calls;
        Some(plan)
    }
}

/// Whether a statement is the one that gives a node its value.
fn writes(statement: &Statement, node: NodeId) -> bool {
    match statement {
        Statement::Let(id) => *id == node,
        Statement::Set { place, .. } => *place == Place::Node(node),
        _ => false,
    }
}
