//! Outlining of a whole plan: the same scene with subroutines, for machines that cannot hold
//! everything where it is used.

use super::assemble::{Scheduled, assemble};
use super::planned::PlannedScene;
use crate::analysis::range::{Slack, ranges};
use crate::ir::graph::{Graph, Node};
use crate::ir::tree::*;
use crate::schedule::locality::{by_first_use, down_to_runs};
use crate::schedule::outline::{Extent, outline};
use crate::schedule::statements::schedule_together;
use crate::source::{Diagnostic, Span};
use crate::targets::Sizes;

impl PlannedScene {
    /// The plan with [`crate::schedule::outline`]; `name` says what the source
    /// calls what stands at a place. Where bounds differ between the calls of a
    /// subroutine, its routines are right for all of them: a program with
    /// subroutines may take guarded routines where one without does not.
    ///
    /// # Errors
    /// Where an operation has no routine, as for [`super::plan`].
    pub fn outlined(
        &self,
        name: &dyn Fn(Span) -> Option<String>,
    ) -> Result<PlannedScene, Vec<Diagnostic>> {
        self.outlined_until(u64::MAX, name)
    }

    /// The same until so many bytes are saved, about: what saves most comes first, so that few calls
    /// spare much.
    ///
    /// # Errors
    /// As for [`PlannedScene::outlined`].
    pub fn outlined_until(
        &self,
        enough: u64,
        name: &dyn Fn(Span) -> Option<String>,
    ) -> Result<PlannedScene, Vec<Diagnostic>> {
        // What is stepped along a run has its place before every pixel of it.
        let stepped = |node: &Node| matches!(node, Node::Stepped { .. });
        if self.graph.nodes.iter().any(stepped)
            && let Some(plain) = self.unstepped()
        {
            return plain.outlined_until(enough, name);
        }
        // Ranges of what is stepped behind the picture do not reach through subroutines.
        if self.graph.is_moving() {
            return Ok(self.clone());
        }
        let tree = schedule_together(&self.graph);
        let sizes = &self.target.sizes;
        let (graph, tree) = self.with_subroutines(tree, (Extent::All, enough), sizes, name);
        self.of(graph, tree)
    }

    /// The plan with subroutines for what is carried out seldom, once a row or pass,
    /// where that is shorter: calls take hardly any time there; with `runs` for what is
    /// carried out once a run of columns, too. None where there is no such thing.
    pub fn outlined_where_seldom(
        &self,
        runs: bool,
        name: &dyn Fn(Span) -> Option<String>,
    ) -> Option<PlannedScene> {
        if self.graph.is_moving() {
            return None;
        }
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
        let (graph, tree) = self.with_subroutines(tree, (extent, u64::MAX), sizes, name);
        let plan = self.of(graph, tree).ok()?;
        plan.is_outlined().then_some(plan)
    }

    /// Its graph and statements with subroutines, where statements take so much memory.
    pub(crate) fn with_subroutines(
        &self,
        tree: Tree,
        extent: (Extent, u64),
        sizes: &Sizes,
        name: &dyn Fn(Span) -> Option<String>,
    ) -> (Graph, Tree) {
        let bytes: Vec<u32> = (self.graph.ids())
            .map(|id| self.routine(id).map_or(0, |routine| routine.bytes))
            .collect();
        outline(&self.graph, tree, &bytes, sizes, extent, name)
    }

    /// The same scene and screen by other statements.
    pub(crate) fn of(&self, graph: Graph, tree: Tree) -> Result<PlannedScene, Vec<Diagnostic>> {
        let found = ranges(&graph, &tree, &Slack::of(self.runtime));
        let goal = self.goal();
        let scheduled = Scheduled {
            graph,
            tree,
            ranges: found,
        };
        let (params, looks) = (self.params.clone(), self.looks);
        let mut plan = assemble(scheduled, params, self.target, &goal, looks)?;
        plan.cut = self.cut;
        plan.items = self.items.clone();
        (plan.listing, plan.toot, plan.page) = (self.listing, self.toot, self.page);
        plan.undocumented = self.undocumented;
        plan.statics = self.statics;
        Ok(PlannedScene {
            plan,
            looked: looks,
            ..self.clone()
        })
    }
}
