//! Outlining of a whole plan: the same scene with subroutines, for machines that cannot hold
//! everything where it is used.

use super::assemble::assemble;
use crate::analysis::range::{Slack, ranges};
use crate::ir::graph::{Graph, Node};
use crate::ir::tree::*;
use crate::plan::Plan;
use crate::schedule::locality::{by_first_use, down_to_runs};
use crate::schedule::outline::{Extent, Sizes, outline};
use crate::schedule::statements::schedule_together;
use crate::source::{Diagnostic, Span};

impl Plan {
    /// Whether it has subroutines.
    pub fn is_outlined(&self) -> bool {
        !self.tree.subroutines.is_empty()
    }

    /// Whether a pixel calls subroutines, not only what is done more seldom.
    pub fn calls_at_pixels(&self) -> bool {
        let mut calls = false;
        walk(&self.tree.pixel, &mut |statement| {
            calls |= matches!(statement, Statement::Call(_));
        });
        calls
    }

    /// Whether only what is done more seldom than pixels calls subroutines: the plan
    /// did not fit as it was.
    pub fn calls_seldom(&self) -> bool {
        self.is_outlined() && !self.calls_at_pixels()
    }

    /// The plan with [`crate::schedule::outline`]; `name` says what the source
    /// calls what stands at a place. Where bounds differ between the calls of a
    /// subroutine, its routines are right for all of them: a program with
    /// subroutines may take guarded routines where one without does not.
    ///
    /// # Errors
    /// Where an operation has no routine, as for [`super::plan`].
    pub fn outlined(&self, name: &dyn Fn(Span) -> Option<String>) -> Result<Plan, Vec<Diagnostic>> {
        // What is stepped along a run has its place before every pixel of it.
        let stepped = |node: &Node| matches!(node, Node::Stepped { .. });
        if self.graph.nodes.iter().any(stepped)
            && let Some(plain) = self.unstepped()
        {
            return plain.outlined(name);
        }
        let tree = schedule_together(&self.graph);
        let sizes = &self.target.sizes;
        let (graph, tree) = self.with_subroutines(tree, Extent::All, sizes, name);
        self.of(graph, tree)
    }

    /// The plan with subroutines for what is carried out seldom, once a row or pass,
    /// where that is shorter: calls take hardly any time there; with `runs` for what is
    /// carried out once a run of columns, too. None where there is no such thing.
    pub fn outlined_where_seldom(
        &self,
        runs: bool,
        name: &dyn Fn(Span) -> Option<String>,
    ) -> Option<Plan> {
        let mut tree = self.tree.clone();
        if runs {
            down_to_runs(&self.graph, &mut tree);
        }
        let mut blocks = vec![&mut tree.frame, &mut tree.row, &mut tree.pass];
        let extent = match runs {
            true => {
                blocks.push(&mut tree.segment);
                Extent::Runs
            }
            false => Extent::Rows,
        };
        for block in blocks {
            *block = by_first_use(&self.graph, std::mem::take(block));
        }
        let sizes = &self.target.sizes;
        let (graph, tree) = self.with_subroutines(tree, extent, sizes, name);
        let plan = self.of(graph, tree).ok()?;
        plan.is_outlined().then_some(plan)
    }

    /// Its graph and statements with subroutines, where statements take so much memory.
    pub(crate) fn with_subroutines(
        &self,
        tree: Tree,
        extent: Extent,
        sizes: &Sizes,
        name: &dyn Fn(Span) -> Option<String>,
    ) -> (Graph, Tree) {
        let bytes: Vec<u32> = (self.graph.ids())
            .map(|id| self.routine(id).map_or(0, |routine| routine.bytes))
            .collect();
        outline(&self.graph, tree, &bytes, sizes, extent, name)
    }

    /// The same scene and screen by other statements.
    pub(crate) fn of(&self, graph: Graph, tree: Tree) -> Result<Plan, Vec<Diagnostic>> {
        let found = ranges(&graph, &tree, &Slack::of(self.runtime));
        let goal = self.goal();
        let (params, origin) = (self.params.clone(), self.origin.clone());
        let mut plan = assemble(graph, tree, found, params, self.target, &goal, origin)?;
        (plan.work, plan.cut, plan.allowance) = (self.work, self.cut, self.allowance);
        plan.items = self.items.clone();
        (plan.listing, plan.page) = (self.listing, self.page);
        plan.undocumented = self.undocumented;
        plan.statics = self.statics;
        Ok(plan)
    }
}
