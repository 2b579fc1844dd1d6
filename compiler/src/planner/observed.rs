//! Specialisation by observation: what no pixel of a picture needs is left out of a plan in
//! which nothing is left to change.
//!
//! The profile is exact: the model runs every pixel that the program will draw. Guards whose
//! tests hold at all of them, ways that none takes, limits of loops that none comes to and
//! bounds that bind nowhere go; what only they needed goes with them (dead code elimination).
//! Nothing is computed beforehand: each pixel is computed as before, by fewer statements. The
//! plan that comes out is run as well, and is taken only where its inks are the same.

mod needed;
mod seen;

use crate::homes::{names, single_use};
use crate::ir::graph::{Graph, Node, NodeId};
use crate::ir::tree::{Block, Origin, Statement, Tree};
use crate::plan::Plan;
use crate::planner::PlannedScene;
use rayon::prelude::*;
use seen::{Seen, Way};
use slowlight_runtime_bbc::{RUNTIME, guards};

/// How many statements may run to observe a picture: five times what a BBC Micro carries out in
/// the three hours of the bot, in which a statement takes about 2,500 cycles.
const STATEMENTS: u64 = 50_000_000;

/// Into how many parts a picture is cut, for threads to take.
const SHARES: usize = 16;

impl PlannedScene {
    /// The same plan with what none of its pixels needs left out, for a program whose params
    /// cannot be changed; none where that takes too long to find out.
    pub fn observed(&self) -> Option<PlannedScene> {
        if !self.params.is_empty() || self.graph.is_moving() {
            return None;
        }
        let (seen, inks) = observe(&self.plan)?;
        // First with values that are always one of their operands left out, then without.
        [true, false].into_iter().find_map(|equal| {
            let mut made = self.clone();
            spare(&mut made.plan, &self.tree, &seen, equal);
            let (of_made, same) = observe(&made.plan)?;
            (of_made.unset == 0 && same == inks).then_some(made)
        })
    }
}

/// What all pixels do, and their inks.
fn observe(plan: &Plan) -> Option<(Seen, Vec<u8>)> {
    let (top, bottom) = plan.computed_rows();
    let rows: Vec<u32> = (top..=bottom).collect();
    let shares = match plan.graph.is_in_order() {
        true => 1,
        false => SHARES.min(rows.len().max(1)),
    };
    let most = STATEMENTS / shares as u64;
    let share = rows.len().div_ceil(shares).max(1);
    let parts: Option<Vec<(Seen, Vec<u8>)>> = (rows.par_chunks(share))
        .map(|rows| Seen::of(plan, rows, most))
        .collect();
    let mut parts = parts?.into_iter();
    let (mut seen, mut inks) = parts.next()?;
    for (other, more) in parts {
        seen.add(&other);
        inks.extend(more);
    }
    Some((seen, inks))
}

/// Leaves out of a plan what was not seen to be needed of the tree that was observed.
fn spare(plan: &mut Plan, tree: &Tree, seen: &Seen, equal: bool) {
    let pairs = tree.blocks().zip(plan.tree.blocks_mut());
    pairs.for_each(|(from, to)| *to = taken(from, seen));
    for (at, one) in plan.graph.loops.iter_mut().enumerate() {
        if seen.turns.get(at).is_some_and(|turns| *turns < one.max) {
            one.max = u32::MAX;
        }
    }
    drop_otherwise(&plan.graph, &mut plan.tree);
    for id in plan.graph.ids() {
        cheaper(plan, seen, id);
        tighten(plan, seen, id);
    }
    if equal {
        substitute(plan, seen);
    }
    needed::keep(&plan.graph, &mut plan.tree, plan.still.as_ref());
    plan.folded = single_use::folded(&plan.graph, &plan.tree, plan.still.as_ref(), &plan.routines);
    plan.homes = names::homes(&plan.graph, &plan.tree);
}

/// A block's statements that some pixel carries out.
fn taken(block: &[Statement], seen: &Seen) -> Block {
    let mut out = Block::new();
    for statement in block {
        match statement {
            Statement::If { cond, yes, no } => match seen.way(statement) {
                Way::Never => {}
                Way::Yes => out.extend(taken(yes, seen)),
                Way::No => out.extend(taken(no, seen)),
                Way::Both => out.push(Statement::If {
                    cond: *cond,
                    yes: taken(yes, seen),
                    no: taken(no, seen),
                }),
            },
            Statement::Loop(turns) => {
                if seen.way(statement) == Way::Never {
                    continue;
                }
                let mut turns = turns.clone();
                for block in turns.blocks_mut() {
                    *block = Block::new();
                }
                let Statement::Loop(before) = statement else {
                    continue;
                };
                let blocks = turns.blocks_mut().into_iter().zip(before.blocks());
                blocks.for_each(|(to, from)| *to = taken(from, seen));
                out.push(Statement::Loop(turns));
            }
            other => out.push(other.clone()),
        }
    }
    out
}

/// Leaves out what loops do at a limit that none comes to.
fn drop_otherwise(graph: &Graph, tree: &mut Tree) {
    fn within(graph: &Graph, block: &mut Block) {
        for statement in block {
            match statement {
                Statement::If { yes, no, .. } => {
                    within(graph, yes);
                    within(graph, no);
                }
                Statement::Loop(turns) => {
                    let endless = graph.loops.get(turns.of.0 as usize);
                    if endless.is_some_and(|l| l.max == u32::MAX) {
                        turns.otherwise.clear();
                    }
                    for block in turns.blocks_mut() {
                        within(graph, block);
                    }
                }
                _ => {}
            }
        }
    }
    tree.blocks_mut().for_each(|block| within(graph, block));
}

/// Takes the routine whose tests held wherever the node was computed.
fn cheaper(plan: &mut Plan, seen: &Seen, id: NodeId) {
    let at = id.0 as usize;
    if seen.fails.get(at) != Some(&false) || seen.computed.get(at) != Some(&true) {
        return;
    }
    let name = plan.routine(id).map_or("", |routine| routine.name);
    let cheap = guards::guard(name).map(|guard| guard.cheap);
    let found = RUNTIME.routines.iter().find(|r| Some(r.name) == cheap);
    if let (Some(found), Some(slot)) = (found, plan.routines.get_mut(at)) {
        *slot = Some(found);
    }
}

/// Bounds a table's indices by what they were seen to be.
fn tighten(plan: &mut Plan, seen: &Seen, id: NodeId) {
    let Node::Lookup { column, row, .. } = plan.graph.node(id) else {
        return;
    };
    let Some(args) = plan.ranges.args.get_mut(id.0 as usize) else {
        return;
    };
    for (range, index) in args.iter_mut().zip([column, row]) {
        if let Some((lo, hi)) = seen.ints.get(index.0 as usize).copied().flatten() {
            range.lo = range.lo.max(f64::from(lo));
            range.hi = range.hi.min(f64::from(hi));
        }
    }
}

/// Reads operands in place of values that were always the same as they.
fn substitute(plan: &mut Plan, seen: &Seen) {
    let graph = &plan.graph;
    let mut of: Vec<NodeId> = graph.ids().collect();
    for id in graph.ids() {
        let at = id.0 as usize;
        if seen.computed.get(at) != Some(&true) {
            continue;
        }
        let same = seen.same.get(at).copied().unwrap_or([false; 2]);
        // What a loop carries is another value in the next turn.
        let stays = |id: &NodeId| {
            let node = graph.node(*id);
            let kept = matches!(node, Node::Apply(..) | Node::Lookup { .. } | Node::Axis(_));
            kept || matches!(
                node,
                Node::Select { .. } | Node::Result { .. } | Node::Const(_)
            )
        };
        let operands = graph.node(id).operands().zip(same);
        let found = operands.filter(|(_, same)| *same).map(|(id, _)| id);
        let mut fits = found.filter(|arg| stays(arg) && plan.format(*arg) == plan.format(id));
        if let Some(arg) = fits.next() {
            of[at] = of.get(arg.0 as usize).copied().unwrap_or(arg);
        }
    }
    let now = |id: NodeId| of.get(id.0 as usize).copied().unwrap_or(id);
    let nodes = plan.graph.nodes.iter_mut();
    nodes.for_each(|node| *node = node.with(now));
    plan.graph.ink = now(plan.graph.ink);
    fn within(block: &mut Block, now: &dyn Fn(NodeId) -> NodeId) {
        for statement in block {
            match statement {
                Statement::Set {
                    from: Origin::Node(id),
                    ..
                } => *id = now(*id),
                Statement::If { cond, yes, no } => {
                    *cond = now(*cond);
                    within(yes, now);
                    within(no, now);
                }
                Statement::Loop(turns) => {
                    turns.again = now(turns.again);
                    for block in turns.blocks_mut() {
                        within(block, now);
                    }
                }
                _ => {}
            }
        }
    }
    plan.tree.blocks_mut().for_each(|block| within(block, &now));
}
