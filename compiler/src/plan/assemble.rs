//! Instruction selection: a routine for each value of a graph that is scheduled, its points and
//! tables, and where values are kept.

use super::made::Rewriting;
use super::params::ParamPlan;
use super::workshop::Workshop;
use super::{Copies, Goal, Plan, SEARCH, choose, fold_uses, names, points, recipes};
use crate::flow::graph::*;
use crate::flow::tree::*;
use crate::passes::int_roots::int_roots;
use crate::passes::reciprocal_roots::reciprocal_roots;
use crate::passes::still::still;
use crate::range::Ranges;
use crate::source::Diagnostic;
use crate::target::{Mode, Target};
use slowlight_routine::{Op, Range, Routine, Runtime, scale};
use std::sync::Arc;

/// A plan of statements whose ranges are known.
pub(super) fn assemble(
    mut graph: Graph,
    mut tree: Tree,
    mut ranges_now: Ranges,
    mut params: Vec<ParamPlan>,
    target: &'static Target,
    goal: &Goal,
    origin: (Arc<Workshop>, Rewriting),
) -> Result<Plan, Vec<Diagnostic>> {
    let runtime = target.runtime;
    if runtime.has(Op::IntRoot) {
        let most = scale::most(runtime.real.bits()) as f64;
        int_roots(&mut graph, &mut tree, &ranges_now, most);
    }
    if runtime.has(Op::ReciprocalRoot) {
        reciprocal_roots(&mut graph, &mut tree);
    }
    let mut tables = recipes::made(&graph, runtime);
    let mut points = None;
    let looks = match origin.0.draft {
        true => points::sample::DRAFT,
        false => points::sample::PATIENCE,
    };
    if let Some((found, ranges)) = points::pointed(&graph, &tree, runtime, looks) {
        points::held::hold(&graph, runtime, &found, &mut tables, &mut params);
        (points, ranges_now) = (Some(found), ranges);
    }
    let routines = choose::choose(&graph, &tree, &ranges_now, runtime, points.as_ref())?;
    let gather = graph.diffusion.as_ref().and_then(|_| gathering(runtime));
    let runs = !tree.segment.is_empty();
    let still = runs.then(|| still(&graph)).flatten();
    let folded = fold_uses::folded(&graph, &tree, still.as_ref(), &routines);
    let (offset, columns, rows) = frame(&graph.image, &goal.mode);
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
        statics: false,
        items: Vec::new(),
        drawn: None,
        lean: false,
        copies: Copies::None,
        brief: false,
        scant: false,
        undocumented: false,
        page: None,
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
        work: 0,
        cut: false,
        allowance: SEARCH,
        origin,
    })
}

/// The addition that is right for all arguments: what a pixel receives has no
/// bounds that could be known beforehand.
fn gathering(runtime: &'static Runtime) -> Option<&'static Routine> {
    let all = Range::ALL;
    let fits = |r: &&Routine| r.op == Op::Add && (r.domain)(&[all, all], all);
    runtime.routines.iter().find(fits)
}

/// Where the picture stands on the screen, and which of it is seen: centred
/// where the screen is larger, cropped where it is smaller.
pub(super) fn frame(image: &Image, mode: &Mode) -> ((i32, i32), (u32, u32), (u32, u32)) {
    let axis = |count: u32, block: u32, screen: u32| {
        let (count, block, screen) = (i64::from(count), i64::from(block), i64::from(screen));
        let offset = (screen - count * block).div_euclid(2);
        // Whole blocks only.
        let first = (-offset).max(0).div_euclid(block) + i64::from((-offset).max(0) % block > 0);
        let last = ((screen - offset).div_euclid(block) - 1).min(count - 1);
        (offset as i32, (first as u32, last.max(first) as u32))
    };
    let (left, columns) = axis(image.width, image.block.0, mode.width);
    let (top, rows) = axis(image.height, image.block.1, mode.height);
    ((left, top), columns, rows)
}
