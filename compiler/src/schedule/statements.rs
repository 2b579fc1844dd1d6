//! Scheduling: from the placement of values to statements in order.
//!
//! Each region becomes a block. What stands in a region, directly or inside
//! its arms and loops, is cut into units: a value to compute, a select to
//! assign, a loop to run, or a value that an arm computes for a later reader
//! under an implied condition. Units wait for the units that they read from;
//! selects on one condition that are ready together share one `If`.

mod search;

use crate::analysis::needed::{live_carried, needed};
use crate::analysis::region::*;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::schedule::parallel_copy::moves;
use crate::schedule::placement::{place, place_in_segments, place_near};
use crate::schedule::toposort::{Order, Queue, Unit};

/// The statements that draw a graph's picture.
pub fn schedule(graph: &Graph) -> Tree {
    schedule_by(graph, Order::Ready, false).0
}

/// What [`schedule`] or [`schedule_in_segments`] gives, and how many values were met on the
/// way: what it took.
pub fn schedule_counted(graph: &Graph, segments: bool) -> (Tree, u64) {
    schedule_by(graph, Order::Ready, segments)
}

/// The same for machines that go through a row in runs of columns: what depends
/// on the column through comparisons with what the row knows is computed once a run.
pub fn schedule_in_segments(graph: &Graph) -> Tree {
    schedule_by(graph, Order::Ready, true).0
}

/// The same for machines short of memory: cheap values stay where they are used,
/// and the statements of a block are as near to their order in the graph as may be. There what makes a shape stands together, so that the same shape
/// elsewhere has the same run of statements.
pub fn schedule_together(graph: &Graph) -> Tree {
    schedule_by(graph, Order::Graph, false).0
}

fn schedule_by(graph: &Graph, order: Order, segments: bool) -> (Tree, u64) {
    let regions = match order {
        Order::Ready if segments => place_in_segments(graph),
        Order::Ready => place(graph),
        Order::Graph => place_near(graph),
    };
    let needed = needed(graph);
    let mut results = vec![Vec::new(); graph.loops.len()];
    for id in graph.ids().filter(|id| needed[id.0 as usize]) {
        if let Node::Result { of, index } = graph.node(id) {
            results[of.0 as usize].push((id, index as usize));
        }
    }
    let loops = (0..graph.loops.len() as u32).map(LoopId);
    let mut emitter = Emitter {
        graph,
        order,
        live: loops.map(|of| live_carried(graph, &needed, of)).collect(),
        results,
        emitted: vec![false; graph.nodes.len()],
        loops_done: vec![false; graph.loops.len()],
        seen: vec![0; graph.nodes.len()],
        met: vec![(0, None); regions.regions.len()],
        stamp: 0,
        visits: 0,
        regions,
    };
    let roots: Vec<NodeId> = graph.roots().collect();
    let tabulated: Vec<(NodeId, NodeId)> = graph
        .ids()
        .filter(|id| needed[id.0 as usize])
        .filter_map(|id| match graph.node(id) {
            Node::Tabulated(value) => Some((id, value)),
            _ => None,
        })
        .collect();
    let values: Vec<NodeId> = tabulated.iter().map(|(_, value)| *value).collect();
    let frame = emitter.block(FRAME, &roots, &[ROW, COLUMN]);
    let mut column = emitter.block(COLUMN, &values, &[]);
    column.extend(tabulated.iter().map(|&(id, value)| Statement::Set {
        place: Place::Node(id),
        from: Origin::Node(value),
    }));
    let tree = Tree {
        frame,
        column,
        row: emitter.block(ROW, &roots, &[PASS]),
        pass: emitter.block(PASS, &roots, &[SEGMENT]),
        segment: emitter.block(SEGMENT, &roots, &[PIXEL]),
        pixel: emitter.block(PIXEL, &roots, &[]),
        step: Block::new(),
        subroutines: Vec::new(),
    };
    (tree, emitter.visits)
}

/// A needed value that a tree does not compute; none in a tree from [`schedule`].
pub fn missing(graph: &Graph, tree: &Tree) -> Option<NodeId> {
    let mut written = vec![false; graph.nodes.len()];
    for block in tree.outer() {
        walk(block, &mut |statement| match statement {
            Statement::Let(id)
            | Statement::Set {
                place: Place::Node(id),
                ..
            } => {
                written[id.0 as usize] = true;
            }
            _ => {}
        });
    }
    let needed = needed(graph);
    graph.ids().find(|id| {
        let computed = matches!(
            graph.node(*id),
            Node::Apply(..)
                | Node::Select { .. }
                | Node::Lookup { .. }
                | Node::Ramp { .. }
                | Node::Stepped { .. }
                | Node::Tabulated(_)
                | Node::Result { .. }
        );
        computed && needed[id.0 as usize] && !written[id.0 as usize]
    })
}

struct Emitter<'g> {
    graph: &'g Graph,
    order: Order,
    regions: Regions,
    /// For each loop, the carried values that are read, by index.
    live: Vec<Vec<u32>>,
    /// For each loop, its needed results: node and index.
    results: Vec<Vec<(NodeId, usize)>>,
    emitted: Vec<bool>,
    loops_done: Vec<bool>,
    /// When each node was last met by a search.
    seen: Vec<u32>,
    /// The same for regions, with the child of the search's region that holds each.
    met: Vec<(u32, Option<RegionId>)>,
    stamp: u32,
    /// How many values searches have met.
    visits: u64,
}

impl Emitter<'_> {
    /// The statements of a region that lead to `roots`; what stands in the
    /// child regions `open` is looked through, not emitted.
    fn block(&mut self, region: RegionId, roots: &[NodeId], open: &[RegionId]) -> Block {
        let mut queue = Queue::new(self.order);
        let mut todo: Vec<Unit> = self.search(region, roots, open).into_iter().collect();
        while let Some(unit) = todo.pop() {
            if !queue.holds(unit) {
                let reads = self.reads(region, unit);
                todo.extend(reads.iter().copied());
                queue.add(unit, self.first_node(unit), self.condition(unit), reads);
            }
        }
        let mut block = Block::new();
        loop {
            let step = queue.take();
            if step.is_empty() {
                return block;
            }
            self.emit(region, &step, &mut block);
        }
    }

    /// The node by which a unit has its place in the graph's order.
    fn first_node(&self, unit: Unit) -> NodeId {
        match unit {
            Unit::Compute(id) | Unit::Choose(id) | Unit::Inside(id, _) => id,
            Unit::Loop(of) => {
                let results = self.results.get(of.0 as usize).into_iter().flatten();
                results.map(|(id, _)| *id).min().unwrap_or(NodeId(0))
            }
        }
    }

    /// The condition that a unit stands under.
    fn condition(&self, unit: Unit) -> Option<NodeId> {
        match unit {
            Unit::Choose(id) => match self.graph.node(id) {
                Node::Select { cond, .. } => Some(cond),
                _ => None,
            },
            Unit::Inside(_, arm) => match self.regions.get(arm).kind {
                RegionKind::Arm { cond, .. } => Some(cond),
                _ => None,
            },
            Unit::Compute(_) | Unit::Loop(_) => None,
        }
    }

    fn emit(&mut self, region: RegionId, step: &[Unit], block: &mut Block) {
        match step.first() {
            Some(&Unit::Compute(id)) => {
                self.emitted[id.0 as usize] = true;
                block.push(Statement::Let(id));
            }
            Some(&Unit::Loop(of)) => {
                let statement = self.emit_loop(region, of);
                block.push(statement);
            }
            Some(&unit) => {
                if let Some(cond) = self.condition(unit) {
                    let [yes, no] = [true, false].map(|holds| self.arm(region, cond, holds, step));
                    if !yes.is_empty() || !no.is_empty() {
                        block.push(Statement::If { cond, yes, no });
                    }
                }
            }
            None => {}
        }
    }

    /// One arm of an `If` that computes a group of units.
    fn arm(&mut self, region: RegionId, cond: NodeId, holds: bool, group: &[Unit]) -> Block {
        let arm = self.regions.child(region, RegionKind::Arm { cond, holds });
        let (mut roots, mut sets) = (Vec::new(), Vec::new());
        for &unit in group {
            match unit {
                Unit::Choose(id) => {
                    if let Node::Select { yes, no, .. } = self.graph.node(id) {
                        let value = if holds { yes } else { no };
                        roots.push(value);
                        sets.push(Statement::Set {
                            place: Place::Node(id),
                            from: Origin::Node(value),
                        });
                        self.emitted[id.0 as usize] = true;
                    }
                }
                Unit::Inside(id, inside) if Some(inside) == arm => roots.push(id),
                _ => {}
            }
        }
        let mut block = arm.map_or(Block::new(), |arm| self.block(arm, &roots, &[]));
        block.extend(sets);
        block
    }

    fn emit_loop(&mut self, region: RegionId, of: LoopId) -> Statement {
        let graph = self.graph;
        let found = &graph.loops[of.0 as usize];
        self.loops_done[of.0 as usize] = true;
        let live = self.live[of.0 as usize].clone();
        let results = self.results[of.0 as usize].clone();
        let kinds = [RegionKind::Body(of), RegionKind::Otherwise(of)];
        let [body, otherwise] =
            kinds.map(|kind| self.regions.child(region, kind).unwrap_or(region));
        let kinds = [RegionKind::Next(of), RegionKind::Done(of)];
        let [next, done] = kinds.map(|kind| self.regions.child(body, kind).unwrap_or(body));
        let nexts: Vec<NodeId> = live.iter().map(|&k| found.next[k as usize]).collect();
        let dones: Vec<NodeId> = results.iter().map(|&(_, k)| found.done[k]).collect();
        let elses: Vec<NodeId> = results.iter().map(|&(_, k)| found.otherwise[k]).collect();
        let set = |place, value| Statement::Set {
            place,
            from: Origin::Node(value),
        };
        let start = live
            .iter()
            .map(|&k| set(Place::Carried(of, k), found.init[k as usize]))
            .collect();
        let ends: Vec<NodeId> = [found.again]
            .iter()
            .chain(&nexts)
            .chain(&dones)
            .copied()
            .collect();
        let body = self.block(body, &ends, &[next, done]);
        let mut next = self.block(next, &nexts, &[]);
        next.extend(moves(graph, of, &live));
        let mut done = self.block(done, &dones, &[]);
        let mut otherwise = self.block(otherwise, &elses, &[]);
        for &(id, k) in &results {
            self.emitted[id.0 as usize] = true;
            done.push(set(Place::Node(id), found.done[k]));
            otherwise.push(set(Place::Node(id), found.otherwise[k]));
        }
        Statement::Loop(Box::new(Turns {
            of,
            start,
            body,
            again: found.again,
            next,
            done,
            otherwise,
        }))
    }
}
