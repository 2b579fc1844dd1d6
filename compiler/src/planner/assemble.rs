//! Instruction selection: a routine for each value of a graph that is scheduled, its points and
//! tables, and where values are kept.

use crate::analysis::range::Ranges;
use crate::homes::{names, single_use};
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::params::ParamPlan;
use crate::plan::placed;
use crate::plan::{Copies, Goal, Plan, table_init};
use crate::schedule::constant_runs::still;
use crate::schedule::step::sink;
use crate::selection::integer_roots::int_roots;
use crate::selection::reciprocal_roots::reciprocal_roots;
use crate::selection::routines;
use crate::source::Diagnostic;
use crate::targets::Target;
use crate::wordlength;
use slowlight_routine::{Op, Range, Routine, Runtime, scale};

/// Statements whose ranges are known.
pub(super) struct Scheduled {
    pub graph: Graph,
    pub tree: Tree,
    pub ranges: Ranges,
}

/// A plan of statements; to place points as many of them are run as `looks` says.
pub(super) fn assemble(
    scheduled: Scheduled,
    mut params: Vec<ParamPlan>,
    target: &'static Target,
    goal: &Goal,
    looks: u64,
) -> Result<Plan, Vec<Diagnostic>> {
    let runtime = target.runtime;
    let Scheduled {
        mut graph,
        mut tree,
        ranges: mut ranges_now,
    } = scheduled;
    if runtime.has(Op::IntRoot) {
        let most = scale::most(runtime.real.bits()) as f64;
        int_roots(&mut graph, &mut tree, &ranges_now, most);
    }
    if runtime.has(Op::ReciprocalRoot) {
        reciprocal_roots(&mut graph, &mut tree);
    }
    let mut tables = table_init::made(&graph, runtime);
    let mut points = None;
    if let Some((found, ranges)) = wordlength::pointed(&graph, &tree, runtime, looks) {
        wordlength::encode::hold(&graph, runtime, &found, &mut tables, &mut params);
        (points, ranges_now) = (Some(found), ranges);
    }
    let routines = routines::choose(&graph, &tree, &ranges_now, runtime, points.as_ref())?;
    sink(&graph, &mut tree);
    let gather = graph.diffusion.as_ref().and_then(|_| gathering(runtime));
    let runs = !tree.segment.is_empty();
    let still = runs.then(|| still(&graph)).flatten();
    let folded = single_use::folded(&graph, &tree, still.as_ref(), &routines);
    let (offset, columns, rows) = placed(&graph.image, &goal.mode);
    let rows = match goal.rows {
        Some((first, last)) => (first.clamp(rows.0, rows.1), last.clamp(rows.0, rows.1)),
        None => rows,
    };
    let homes = names::homes(&graph, &tree);
    Ok(Plan {
        name: goal.name.clone(),
        target,
        runtime,
        mode: goal.mode,
        offset,
        columns,
        rows,
        plot: goal.plot,
        tight: false,
        listing: false,
        toot: false,
        statics: false,
        items: Vec::new(),
        drawn: None,
        lean: false,
        copies: Copies::None,
        brief: false,
        scant: false,
        undocumented: false,
        page: None,
        moved: false,
        ranges: ranges_now,
        params,
        routines,
        points,
        tables,
        gather,
        folded,
        still,
        homes,
        graph,
        tree,
        cut: false,
    })
}

/// The addition that is right for all arguments: what a pixel receives has no
/// bounds that could be known beforehand.
fn gathering(runtime: &'static Runtime) -> Option<&'static Routine> {
    let all = Range::ALL;
    let fits = |r: &&Routine| r.op == Op::Add && (r.domain)(&[all, all], all);
    runtime.routines.iter().find(fits)
}
