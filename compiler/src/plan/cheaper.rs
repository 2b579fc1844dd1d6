//! Which rewrites for speed are worth it on a machine, and in what order.
//!
//! The ink is found by comparisons, the first turn of a loop is copied before
//! it, algebra looks at all of it, comparisons with thresholds included. What is
//! kept of that is what makes the whole plan cheaper: its statements are added up
//! with the cycles of the routines that the ranges then allow, for a pixel of
//! which nothing is known. A formula that is cheaper by itself may cost more than
//! it saves where others needed its parts, or where the ranges cannot see its
//! sign and it needs a guard.

use super::choose::choose;
use super::settled::{Settled, settle};
use crate::flow::graph::*;
use crate::flow::tree::*;
use crate::passes::algebra::{Cheaper, algebra, spans};
use crate::passes::demand::bounds_segment;
use crate::passes::peel::peel;
use crate::passes::rate::rates;
use crate::passes::squares::squares;
use crate::passes::threshold::threshold;
use crate::range::{Ranges, Slack};
use slowlight_routine::{Routine, Runtime};

/// How many nodes of a loop's body are copied at most.
const BODY: usize = 160;

/// By how much a copy of a loop's body must make the plan cheaper.
const COPY: f64 = 0.9;

/// By how much algebra must make the plan cheaper: what a statement costs beside
/// its routines is not known so well.
const FORMS: f64 = 0.9;

/// By how much spans must.
const SPANS: f64 = 0.99;

/// What part of the plan's cycles a statement more must save, for its memory;
/// three entries of a table take as much. Where there is plenty, and where
/// there was not enough.
const MEMORY: [f64; 2] = [0.0002, 0.0025];

/// How many nodes a graph may have to be looked at by algebra, and how many may
/// be scheduled again to find out which forms pay.
const NODES: usize = 1000;
const PATIENCE: usize = 10_000;

/// A graph that gives the same picture in fewer cycles; `thrifty` with memory.
pub fn cheaper(plain: Settled, slack: &Slack, runtime: &'static Runtime, thrifty: bool) -> Settled {
    let site = Site {
        slack,
        runtime,
        memory: MEMORY[usize::from(thrifty)],
    };
    let mut best = site.rewritten(&plain).unwrap_or(plain.clone());
    for k in 0..plain.graph.loops.len() {
        if let Some(peeled) = peel(&plain.graph, LoopId(k as u32), BODY) {
            let peeled = settle(&peeled, slack);
            if let Some(found) = site.rewritten(&peeled)
                && site.cost(&found) < COPY * site.cost(&best)
            {
                best = found;
            }
        }
    }
    best
}

/// A pass that puts something in the place of nodes that may be replaced.
type Pass = fn(&Graph, &Ranges, &Runtime, &dyn Fn(NodeId) -> bool) -> Option<Cheaper>;

struct Site<'s> {
    slack: &'s Slack,
    runtime: &'static Runtime,
    memory: f64,
}

impl Site<'_> {
    /// A plan with thresholds and algebra, as far as they make it cheaper;
    /// nothing where they do not.
    fn rewritten(&self, plain: &Settled) -> Option<Settled> {
        let compared = threshold(&plain.graph, &plain.ranges, self.runtime)
            .map(|next| settle(&next, self.slack))
            .filter(|next| self.cost(next) < self.cost(plain));
        let base = compared.as_ref().unwrap_or(plain);
        let found = self.sited(base, FORMS, algebra).or(compared);
        let base = found.as_ref().unwrap_or(plain);
        let shared = squares(&base.graph, &base.ranges)
            .map(|next| settle(&next, self.slack))
            .filter(|next| self.cost(next) < self.cost(base));
        let found = shared.or(found);
        let base = found.as_ref().unwrap_or(plain);
        self.sited(base, SPANS, spans).or(found)
    }

    /// A plan with what a pass puts at the sites where that pays.
    fn sited(&self, plain: &Settled, part: f64, pass: Pass) -> Option<Settled> {
        if plain.graph.nodes.len() > NODES {
            return None;
        }
        let mut best: Option<Settled> = None;
        let mut limit = part * self.cost(plain);
        let mut without: Vec<NodeId> = Vec::new();
        let sites = self.with(plain, pass, &without)?.1;
        let patient = sites.len() * plain.graph.nodes.len() < PATIENCE;
        let comparisons = |id: &NodeId| plain.graph.ty(*id) == slowlight_routine::Type::Bool;
        // All of them, the comparisons alone, then each left out in turn.
        let rest = sites.iter().copied().filter(|id| !comparisons(id));
        let mut tries: Vec<Vec<NodeId>> = vec![Vec::new(), rest.collect()];
        if patient {
            tries.extend(sites.iter().map(|id| vec![*id]));
        }
        for leave in tries {
            let all = without.iter().chain(&leave).copied().collect::<Vec<_>>();
            let Some((next, _)) = self.with(plain, pass, &all) else {
                continue;
            };
            let cost = self.cost(&next);
            if cost < limit {
                (limit, without) = (cost, all);
                best = Some(next);
            }
        }
        best
    }

    /// The plan with a pass everywhere but at some nodes, and where it was.
    fn with(
        &self,
        plain: &Settled,
        pass: Pass,
        without: &[NodeId],
    ) -> Option<(Settled, Vec<NodeId>)> {
        let may = |id: NodeId| !without.contains(&id);
        let found = pass(&plain.graph, &plain.ranges, self.runtime, &may)?;
        Some((settle(&found.graph, self.slack), found.sites))
    }

    /// Cycles for a pixel of which nothing is known, and something for memory.
    fn cost(&self, plan: &Settled) -> f64 {
        let Ok(routines) = choose(&plan.graph, &plan.tree, &plan.ranges, self.runtime) else {
            return f64::INFINITY;
        };
        let step = f64::from(self.runtime.statement);
        let weigh = Weigh {
            own: &|statement| match statement {
                Statement::Let(id) => step + self.computing(plan, &routines, *id),
                _ => step,
            },
        };
        let width = f64::from(plan.graph.image.width.max(1));
        let tree = &plan.tree;
        let runs = 1.0 + bounds(plan) as f64;
        let cycles = weigh.block(&tree.row) / width
            + weigh.block(&tree.segment) * runs / width
            + weigh.block(&tree.pixel);
        cycles * (1.0 + self.memory * memory(plan))
    }
}

impl Site<'_> {
    /// What computing a node costs, its operands not.
    fn computing(&self, plan: &Settled, routines: &[Option<&'static Routine>], id: NodeId) -> f64 {
        if let Node::Lookup { table, .. } = plan.graph.node(id) {
            let table = plan.graph.tables.get(table.0 as usize);
            let flat = table.is_some_and(|t| t.width == 1 || t.height == 1);
            return f64::from(self.runtime.index) * if flat { 1.0 } else { 2.0 };
        }
        let routine = routines.get(id.0 as usize).copied().flatten();
        routine.map_or(0.0, |r| f64::from(r.cycles))
    }
}

/// How many comparisons may end a run of columns.
pub(super) fn bounds(plan: &Settled) -> usize {
    let mut bounds = 0;
    let rates = rates(&plan.graph);
    walk(&plan.tree.segment, &mut |s| {
        if let Statement::Let(id) = s {
            bounds += usize::from(bounds_segment(&plan.graph, &rates, *id));
        }
    });
    bounds
}

/// Memory in statements.
fn memory(plan: &Settled) -> f64 {
    let mut statements = 0;
    for block in plan.tree.outer() {
        walk(block, &mut |_| statements += 1);
    }
    let entries = plan.graph.tables.iter().map(|t| match t.seed.is_empty() {
        true => t.entries.len() as f64 / 3.0,
        // The array, and how it is worked out.
        false => t.entries.len() as f64 / 4.0 + 3.0,
    });
    f64::from(statements) + entries.sum::<f64>()
}

/// Adds up statements as often as they are likely to be carried out.
pub(super) struct Weigh<'w> {
    /// What a statement costs, those in it not.
    pub own: &'w dyn Fn(&Statement) -> f64,
}

/// How likely a loop is thought to go on after a turn, and to be entered at all
/// where that is a choice: rays mostly meet what is far.
const ON: f64 = 0.25;

impl Weigh<'_> {
    pub fn block(&self, block: &Block) -> f64 {
        block.iter().map(|s| self.one(s)).sum()
    }

    fn one(&self, statement: &Statement) -> f64 {
        match statement {
            Statement::Let(_) | Statement::Call(_) | Statement::Set { .. } => (self.own)(statement),
            Statement::If { yes, no, .. } => {
                let likely = match (loops(yes), loops(no)) {
                    (true, false) => ON,
                    (false, true) => 1.0 - ON,
                    _ => 0.5,
                };
                (self.own)(statement) + likely * self.block(yes) + (1.0 - likely) * self.block(no)
            }
            Statement::Loop(turns) => {
                let turns_on = self.block(&turns.body) + ON * self.block(&turns.next);
                self.block(&turns.start) + turns_on / (1.0 - ON) + self.block(&turns.done)
            }
        }
    }
}

/// Whether a block has a loop in it.
fn loops(block: &Block) -> bool {
    let mut found = false;
    walk(block, &mut |s| found |= matches!(s, Statement::Loop(_)));
    found
}
