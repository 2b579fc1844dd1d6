//! The graph of a scene as a target is to run it: whether shapes that are alike are found by
//! cells, in a table, or by code each, is decided by what plans without a search are said to take.

use super::{ScreenArgs, Tables};
use crate::estimate;
use crate::failure::{Failure, Outcome};
use crate::moving;
use crate::need;
use crate::scene::{Limits, Precision, Scene};
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::passes::simplify::function_tables::has_function_tables;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::planner::pipeline::Pass;
use slowlight_compiler::planner::{PlannedScene, plan_among};
use slowlight_compiler::sema::{INSTANCES, Instancing, Ways};
use slowlight_compiler::targets::Target;
use std::cell::Cell;

/// Of how many shapes a scene may be for each to be code of its own, where it could be otherwise.
const MOST: usize = 40;

/// By how much a search makes code for each shape quicker than it makes loops over tables: where
/// shapes stand is no constant there.
const SEARCHED: f64 = 1.25;

/// How large a plan's program may be, in parts of its room, for one of its smaller forms to fit.
const FULL: f64 = 1.25;

/// What takes less memory, and longer.
const LESS: [Instancing; 3] = [
    Instancing::FewerCells,
    Instancing::FewCells,
    Instancing::Rows,
];

impl ScreenArgs {
    /// What of the scene is done with less, or otherwise.
    pub fn limits(&self) -> Limits {
        Limits {
            turns: self.max_turns,
            steps: self.max_steps,
            ways: self
                .passes
                .ways(self.ways.ways(), self.as_written, self.instancing),
        }
    }

    /// What `plan` makes of these options; where its program does not fit, with less memory for
    /// how shapes are found, and where it had to be made small for its machine, with that if it is
    /// quicker. `plan` says how shapes are found in the plans that it makes.
    ///
    /// # Errors
    /// Where none does, that of the first.
    pub(super) fn smaller(
        &self,
        scene: &Scene,
        plan: impl Fn(&ScreenArgs, &dyn Fn(Instancing)) -> Outcome<PlannedScene>,
    ) -> Outcome<PlannedScene> {
        // The way with most memory for them among the first plans, one for each mode: each took
        // what takes less where the rest was too large, so only what is beyond it is another plan.
        let most = Cell::new(Instancing::Separate);
        let first = plan(self, &|taken| {
            most.set(most.get().min(match taken {
                // Which is asked for only where all are looked at.
                Instancing::Seen => self.limits().ways.instancing,
                taken => taken,
            }));
        });
        let is_small = match &first {
            Ok(plan) => plan.is_made_small(),
            Err(failure) => matches!(failure, Failure::TooLarge(_)),
        };
        if !is_small || scene.shapes() < INSTANCES {
            return first;
        }
        let less = LESS.into_iter().filter(|less| *less > most.get());
        let mut others = less.map(|less| {
            let less = ScreenArgs {
                instancing: less,
                ..self.clone()
            };
            plan(&less, &|_| {})
        });
        let Ok(fits) = first else {
            return others.find(Result::is_ok).unwrap_or(first);
        };
        match others.next() {
            Some(Ok(other)) if estimate::cycles(&other) < estimate::cycles(&fits) => Ok(other),
            _ => Ok(fits),
        }
    }

    /// The same options, with a plan's format asked for.
    pub fn in_format_of(&self, target: &Target) -> ScreenArgs {
        ScreenArgs {
            format: Some(target.runtime.format.to_owned()),
            tables: self.tables.or(Some(Tables::Yes)),
            ..self.clone()
        }
    }

    /// The same options, with a plan's format, and tables of functions where that has some.
    pub fn like(&self, plan: &PlannedScene) -> ScreenArgs {
        let tables = match has_function_tables(&plan.graph) {
            true => Tables::Yes,
            false => Tables::No,
        };
        ScreenArgs {
            tables: Some(tables),
            ..self.in_format_of(plan.target)
        }
    }

    /// The same without one of the planner's passes.
    #[must_use]
    pub fn without(&self, pass: Pass) -> ScreenArgs {
        ScreenArgs {
            passes: self.passes.clone().without(pass),
            ..self.clone()
        }
    }

    /// The graph of a scene, and how its shapes are found.
    ///
    /// # Errors
    /// Where it does not compile.
    pub(super) fn lowered(
        &self,
        scene: &Scene,
        target: &'static Target,
        goal: &Goal,
        set: &[(String, Vec<f64>)],
    ) -> Outcome<(Graph, Instancing)> {
        let (graph, taken) = self.of_ways(scene, target, goal, set)?;
        match moving::refused(&graph, target, self.refine.is_some()) {
            Some(refused) => Err(scene.wrong(vec![refused])),
            None => Ok((graph, taken)),
        }
    }

    fn of_ways(
        &self,
        scene: &Scene,
        target: &'static Target,
        goal: &Goal,
        set: &[(String, Vec<f64>)],
    ) -> Outcome<(Graph, Instancing)> {
        let limits = self.limits();
        let most = scene.shapes();
        let lower = |instancing, set: &[(String, Vec<f64>)]| {
            let ways = Ways {
                instancing,
                ..limits.ways
            };
            let limits = Limits { ways, ..limits };
            scene.graph_within(Some(goal.mode.inks), Precision::of(target), set, limits)
        };
        let asked = limits.ways.instancing;
        let taking = |taken| Ok((lower(taken, set)?, taken));
        if asked == Instancing::Separate || most < INSTANCES {
            return taking(asked);
        }
        // An edited program is that of the scene as it is.
        let by = |instancing| lower(instancing, &[]);
        let (first, separate) = (by(asked)?, by(Instancing::Separate)?);
        // None are alike: they take as much by any way.
        if size(&separate) == size(&first) {
            return Ok((lower(asked, set)?, Instancing::Separate));
        }
        let whole = Goal {
            rows: None,
            ..goal.clone()
        };
        // Nothing where the program is larger than what the machine has for it. Which values may
        // be narrow takes longest to find, and as much in all of them.
        let takes = |graph: &Graph| {
            let plan = plan_among(graph, target, &whole, (0, 0), self.passes.left_out());
            let plan = plan.ok().filter(fits)?;
            Some(estimate::cycles(&plan))
        };
        let mut best = (takes(&first), asked);
        for less in LESS {
            if best.0.is_none() && less > asked {
                best = (takes(&by(less)?), less);
            }
        }
        if most <= MOST {
            // Of less memory there is no such way.
            if asked == Instancing::Cells {
                let seen = by(Instancing::Seen)?;
                if [&first, &separate]
                    .iter()
                    .all(|other| size(other) != size(&seen))
                {
                    let cycles = takes(&seen);
                    best = least(best, (cycles, Instancing::Seen));
                }
            }
            let cycles = takes(&separate).map(|cycles| cycles / SEARCHED);
            best = least(best, (cycles, Instancing::Separate));
        }
        taking(best.1)
    }
}

/// The way that takes less, of those that fit.
fn least(a: (Option<f64>, Instancing), b: (Option<f64>, Instancing)) -> (Option<f64>, Instancing) {
    match (a.0, b.0) {
        (Some(one), Some(other)) if one <= other => a,
        (_, Some(_)) => b,
        _ => a,
    }
}

/// How many nodes and tables a graph needs.
fn size(graph: &Graph) -> (usize, usize) {
    let needed = graph.reached().into_iter().filter(|&reached| reached);
    (needed.count(), graph.tables.len())
}

/// Whether a plan's program is so small, as it is, that it may fit in the end.
fn fits(plan: &PlannedScene) -> bool {
    match (need::first(plan), need::room(plan)) {
        (Ok(Some(need)), Some(room)) => need.total() as f64 <= FULL * room as f64,
        _ => true,
    }
}
