//! Execution profile: how often each value of a plan is computed at a pixel, found once by
//! running it, and by that about what a graph costs that was made from the plan's.
//!
//! A rewrite leaves most values what they were. Those have the counts that they had; what is
//! new is computed where it is needed, and no more often than what it is made of changes. So
//! the cost of a candidate is a sum over its nodes, without scheduling it or finding its ranges.
//! (Frequencies from a profile: Wall, Predicting program behavior using real or estimated
//! profiles, PLDI 1991.)

use super::choose::Chosen;
use super::meter::Meter;
use super::settled::Known;
use crate::eval::run::Run;
use crate::flow::graph::*;
use crate::flow::often;
use crate::flow::tree::*;
use crate::passes::interlace::passes;
use crate::passes::needed::needed;
use crate::passes::rate::{Dependence, Rates, rates};
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Runtime, Type};

/// How often a run of columns is thought to begin, a pixel.
const RUNS: f64 = 0.1;

/// How often a plan's values are computed, and what graphs made of it cost.
pub(super) struct Profile {
    runtime: &'static Runtime,
    /// What is known of each of the plan's values.
    known: Vec<Seen>,
    /// How often what depends on something changes.
    changes: FxHashMap<Dependence, f64>,
    /// How often each loop's turns run, their `next`, and either end.
    loops: Vec<[f64; 4]>,
    /// A usual routine's cycles.
    usual: FxHashMap<Op, u32>,
    /// What the plan's own graph costs.
    own: f64,
}

/// What is known of a value of the plan.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    /// How often it is computed at a pixel.
    times: Option<f64>,
    /// The same of what uses it most: by how much oftener it is computed.
    factor: f64,
    /// Its routine's cycles.
    cycles: Option<u32>,
    /// How often a choice by it went either way.
    ways: [f64; 2],
}

impl Seen {
    fn likely(&self) -> f64 {
        let [yes, no] = self.ways;
        match yes + no > 0.0 {
            true => yes / (yes + no),
            false => 0.5,
        }
    }
}

impl Profile {
    /// Of a plan whose routines are chosen: at some pixels, if no more statements run; by
    /// guesses otherwise.
    pub(super) fn new(
        plan: &Known,
        runtime: &'static Runtime,
        routines: &Chosen,
        pixels: &[(i32, i32)],
        patience: u64,
    ) -> Profile {
        let (graph, tree) = (&plan.graph, &plan.tree);
        let meter = Meter::new(graph, |_: &Statement| 0.0);
        {
            let mut run = Run::within(graph, tree, &meter, patience + 1);
            for &(x, y) in pixels {
                run.pixel(x, y);
            }
        }
        let ran = !pixels.is_empty() && meter.ran.get() <= patience;
        let [width, height] = [graph.image.width, graph.image.height];
        let [width, height] = [width, height].map(|n| f64::from(n.max(1)));
        let passes = f64::from(passes(graph));
        let mut counts = Counts {
            known: vec![Seen::default(); graph.nodes.len()],
            loops: vec![[0.0; 4]; graph.loops.len()],
        };
        let around = [
            (&tree.frame, 0.0),
            (&tree.column, 1.0 / height),
            (&tree.row, 1.0 / width),
            (&tree.pass, passes / width),
            (&tree.segment, RUNS),
        ];
        for (block, times) in around {
            counts.guess(block, times);
        }
        match ran {
            true => {
                let each = 1.0 / pixels.len() as f64;
                let count = |s: &Statement| each * meter.count(s) as f64;
                counts.count(&tree.pixel, &count);
                for subroutine in &tree.subroutines {
                    counts.count(&subroutine.body, &count);
                }
            }
            false => counts.guess(&tree.pixel, 1.0),
        }
        let Counts { mut known, loops } = counts;
        let mut sums: FxHashMap<Op, (f64, f64)> = FxHashMap::default();
        for id in graph.ids() {
            let routine = routines.get(id.0 as usize).copied().flatten();
            known[id.0 as usize].cycles = routine.map(|r| r.cycles);
            if let (Node::Apply(op, _), Some(routine)) = (graph.node(id), routine) {
                let (sum, count) = sums.entry(op).or_default();
                *sum += f64::from(routine.cycles);
                *count += 1.0;
            }
        }
        let usual = sums.into_iter();
        let mut changes = changes(&known, &rates(graph));
        changes.insert(Dependence::Frame, 0.0);
        changes.insert(Dependence::Row, 1.0 / width);
        changes.insert(Dependence::Pass, passes / width);
        changes.insert(Dependence::Column, 1.0);
        let mut made = Profile {
            runtime,
            known: known.clone(),
            changes,
            loops,
            usual: usual.map(|(op, (sum, n))| (op, (sum / n) as u32)).collect(),
            own: 0.0,
        };
        let same: Vec<Option<NodeId>> = graph.ids().map(Some).collect();
        made.own = made.summed(graph, &same, &mut |id, demand| {
            let seen = &mut known[id.0 as usize];
            seen.factor = 1.0;
            let times = seen.times?;
            if demand > 0.0 {
                seen.factor = times / demand;
            }
            Some(times)
        });
        made.known = known;
        made
    }

    /// About what the plan's own graph costs a pixel.
    pub(super) fn own(&self) -> f64 {
        self.own
    }

    /// About what a graph costs a pixel, given what stands in it for each of the plan's values.
    pub(super) fn cost(&self, graph: &Graph, made: &[Option<NodeId>]) -> f64 {
        let mut factors: Vec<Option<f64>> = vec![None; graph.nodes.len()];
        for (old, new) in self.known.iter().zip(made) {
            if let (Some(new), Some(_)) = (new, old.times) {
                let factor = &mut factors[new.0 as usize];
                *factor = Some(factor.map_or(old.factor, |f| f.min(old.factor)));
            }
        }
        self.summed(graph, made, &mut |id, demand| {
            factors[id.0 as usize].map(|factor| factor * demand)
        })
    }

    /// The same where it is said of values how often they are computed, given how often what
    /// uses them is.
    fn summed(
        &self,
        graph: &Graph,
        made: &[Option<NodeId>],
        times: &mut dyn FnMut(NodeId, f64) -> Option<f64>,
    ) -> f64 {
        let (needed, rates) = (needed(graph), rates(graph));
        let mut were: Vec<Seen> = vec![Seen::default(); graph.nodes.len()];
        let mut loops: Vec<Option<usize>> = vec![None; graph.loops.len()];
        for ((old, new), k) in self.known.iter().zip(made).zip(0..) {
            let Some(new) = new else { continue };
            let _ = k;
            were[new.0 as usize] = *old;
        }
        for (k, l) in loops.iter_mut().enumerate() {
            *l = Some(k);
        }
        let mut often = vec![0.0f64; graph.nodes.len()];
        let mut uses = vec![0u32; graph.nodes.len()];
        for (l, of) in graph.loops.iter().zip(&loops) {
            let [turns, next, done, otherwise] = match of.and_then(|of| self.loops.get(of)) {
                Some(times) => *times,
                None => [1.0; 4],
            };
            let lists: [(&[NodeId], f64); 4] = [
                (std::slice::from_ref(&l.again), turns),
                (&l.next, next),
                (&l.done, done),
                (&l.otherwise, otherwise),
            ];
            let starts = l.init.iter().map(|root| (root, done + otherwise));
            let others = lists
                .iter()
                .flat_map(|(list, times)| list.iter().map(move |r| (r, *times)));
            for (root, times) in starts.chain(others) {
                uses[root.0 as usize] += 2;
                often[root.0 as usize] = often[root.0 as usize].max(times);
            }
        }
        for root in graph.outputs() {
            uses[root.0 as usize] += 2;
            often[root.0 as usize] = 1.0;
        }
        let mut sum = 0.0;
        // Users stand behind what they use: a value's count is known when it is come to.
        for id in graph.ids().rev().filter(|id| needed[id.0 as usize]) {
            let at = id.0 as usize;
            let node = graph.node(id);
            let most = self.most(&rates, id);
            let times = times(id, often[at]).unwrap_or(often[at]).min(most.max(0.0));
            for (k, used) in node.operands().enumerate() {
                let part = match node {
                    Node::Select { cond, .. } if k > 0 => {
                        let likely = were[cond.0 as usize].likely();
                        if k == 1 { likely } else { 1.0 - likely }
                    }
                    _ => 1.0,
                };
                uses[used.0 as usize] += 1;
                often[used.0 as usize] = often[used.0 as usize].max(part * times);
            }
            if let Node::Apply(op, _) = node {
                let cycles = were[at].cycles.unwrap_or_else(|| self.usually(op));
                let kind = usize::from(graph.ty(id) == Type::Real);
                let beside = match self.runtime.stepping {
                    Some(_) if uses[at] == 1 => 0,
                    Some(stepping) => stepping.write[kind] + uses[at] * stepping.read[kind],
                    None => self.runtime.statement,
                };
                sum += times * f64::from(cycles + beside);
            }
        }
        sum
    }

    /// How often a value changes.
    fn most(&self, rates: &Rates, id: NodeId) -> f64 {
        let change = |on: &Dependence| self.changes.get(on).copied().unwrap_or(1.0);
        rates.rate(id).iter().map(change).fold(0.0, f64::max)
    }

    fn usually(&self, op: Op) -> u32 {
        let of_op = |op: Op| move |r: &&slowlight_routine::Routine| r.op == op;
        self.usual.get(&op).copied().unwrap_or_else(|| {
            let last = self.runtime.routines.iter().filter(of_op(op)).next_back();
            last.map_or(0, |r| r.cycles)
        })
    }
}

/// How often what depends on something is computed, at most.
fn changes(known: &[Seen], rates: &Rates) -> FxHashMap<Dependence, f64> {
    let mut changes: FxHashMap<Dependence, f64> = FxHashMap::default();
    for (seen, id) in known.iter().zip((0..).map(NodeId)) {
        for on in rates.rate(id) {
            let most = changes.entry(*on).or_default();
            *most = most.max(seen.times.unwrap_or(0.0));
        }
    }
    changes
}

/// How often a tree's statements run.
struct Counts {
    known: Vec<Seen>,
    loops: Vec<[f64; 4]>,
}

impl Counts {
    fn note(&mut self, statement: &Statement, times: f64) {
        match statement {
            Statement::Let(id)
            | Statement::Set {
                place: Place::Node(id),
                ..
            } => *self.known[id.0 as usize].times.get_or_insert(0.0) += times,
            _ => {}
        }
    }

    fn ways(&mut self, cond: NodeId, [yes, no]: [f64; 2]) {
        let ways = &mut self.known[cond.0 as usize].ways;
        *ways = [ways[0] + yes, ways[1] + no];
    }

    fn turns(&mut self, of: LoopId, times: [f64; 4]) {
        let all = &mut self.loops[of.0 as usize];
        (0..4).for_each(|k| all[k] += times[k]);
    }

    fn count(&mut self, block: &Block, count: &dyn Fn(&Statement) -> f64) {
        walk(block, &mut |s| {
            let times = count(s);
            self.note(s, times);
            let of = |block: &Block| block.first().map(count);
            match s {
                Statement::If { cond, yes, no } => {
                    let yes = of(yes).unwrap_or_else(|| times - of(no).unwrap_or(times / 2.0));
                    self.ways(*cond, [yes, times - yes]);
                }
                Statement::Loop(turns) => {
                    let done = of(&turns.done).unwrap_or(0.0);
                    let otherwise = of(&turns.otherwise).unwrap_or(0.0);
                    let next = of(&turns.next).unwrap_or(0.0);
                    let all = of(&turns.body).unwrap_or(next + done);
                    self.turns(turns.of, [all, next, done, otherwise]);
                }
                _ => {}
            }
        });
    }

    fn guess(&mut self, block: &Block, times: f64) {
        for statement in block {
            self.note(statement, times);
            match statement {
                Statement::If { cond, yes, no } => {
                    let likely = times * often::likely(yes, no);
                    self.ways(*cond, [likely, times - likely]);
                    self.guess(yes, likely);
                    self.guess(no, times - likely);
                }
                Statement::Loop(turns) => {
                    let all = often::turns(turns).map(|(block, part)| (block, part * times));
                    self.turns(turns.of, [all[1].1, all[2].1, all[3].1, all[4].1]);
                    for (block, times) in all {
                        self.guess(block, times);
                    }
                }
                _ => {}
            }
        }
    }
}
