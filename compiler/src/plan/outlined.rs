//! The plan of the same scene with subroutines, for machines that cannot hold
//! everything where it is used.

use super::made::assemble;
use super::{Goal, Plan};
use crate::flow::graph::Node;
use crate::passes::outline::outline;
use crate::passes::schedule::schedule_together;
use crate::range::{Slack, ranges};
use crate::source::{Diagnostic, Span};

impl Plan {
    /// Whether it has subroutines.
    pub fn is_outlined(&self) -> bool {
        !self.tree.subroutines.is_empty()
    }

    /// The plan with [`crate::passes::outline`]; `name` says what the source
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
        let bytes: Vec<u32> = (self.graph.ids())
            .map(|id| self.routine(id).map_or(0, |routine| routine.bytes))
            .collect();
        let tree = schedule_together(&self.graph);
        let (graph, tree) = outline(&self.graph, tree, &bytes, &self.target.sizes, name);
        let found = ranges(&graph, &tree, &Slack::of(self.runtime));
        let goal = Goal {
            name: self.name.clone(),
            mode: self.mode,
            rows: Some(self.rows),
            plot: self.plot,
        };
        let (params, origin) = (self.params.clone(), self.origin.clone());
        assemble(graph, tree, found, params, self.target, &goal, origin)
    }
}
