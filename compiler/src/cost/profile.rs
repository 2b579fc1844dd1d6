//! Execution profile: how often each value of a plan is computed at a pixel, found once by
//! running it, and by that about what a graph costs that was made from the plan's.
//!
//! A rewrite leaves most values what they were. Those have the counts that they had; what is
//! new is computed where it is needed, and no more often than what it is made of changes. So
//! the cost of a candidate is a sum over its nodes, without scheduling it or finding its ranges.
//! (Frequencies from a profile: Wall, Predicting program behavior using real or estimated
//! profiles, PLDI 1991.)

use super::meter::Meter;
use super::pixels::{Pixel, Pixels};
use crate::analysis::needed::needed;
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::ir::often;
use crate::ir::tree::*;
use crate::passes::loops::strip_mine::passes;
use crate::schedule::analysed::Known;
use crate::selection::routines::Chosen;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Overhead, Runtime, Type};

/// How often a run of columns is thought to begin, a pixel.
const RUNS: f64 = 0.1;

/// How often a plan's values are computed, and what graphs made of it cost.
pub(crate) struct Profile {
    runtime: &'static Runtime,
    /// What is known of each of the plan's values.
    known: Vec<Seen>,
    /// How often what depends on something changes.
    changes: FxHashMap<Dependence, f64>,
    /// How often each loop's turns run, their `next`, and either end.
    loops: Vec<[f64; 4]>,
    /// A usual routine's cycles.
    usual: FxHashMap<Op, u32>,
    /// What the plan's own graph costs, and how many values it computes.
    own: (f64, f64),
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
    /// Of a plan whose routines are chosen: at some pixels, or by guesses where too many
    /// statements run there.
    pub(crate) fn new(
        plan: &Known,
        runtime: &'static Runtime,
        routines: &Chosen,
        pixels: &Pixels,
    ) -> Profile {
        let (graph, tree) = (&plan.graph, &plan.tree);
        let meter = Meter::new(graph, |_: &Statement| 0.0);
        {
            let mut run = Run::within(graph, tree, &meter, pixels.patience + 1).alone();
            for &Pixel { x, y, weight } in &pixels.all {
                meter.weight.set(weight);
                run.pixel(x, y);
            }
        }
        let ran = !pixels.is_empty() && meter.ran.get() <= pixels.patience;
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
                let each = 1.0 / pixels.weight();
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
            own: (0.0, 0.0),
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
    pub(crate) fn own(&self) -> f64 {
        self.own.0
    }

    /// About what a graph costs a pixel, and how many values more it computes than the plan's,
    /// given what stands in it for each of the plan's values.
    pub(crate) fn cost(&self, graph: &Graph, made: &[Option<NodeId>]) -> (f64, f64) {
        let mut factors: Vec<Option<f64>> = vec![None; graph.nodes.len()];
        for (old, new) in self.known.iter().zip(made) {
            if let (Some(new), Some(_)) = (new, old.times) {
                let factor = &mut factors[new.0 as usize];
                *factor = Some(factor.map_or(old.factor, |f| f.min(old.factor)));
            }
        }
        let (cycles, values) = self.summed(graph, made, &mut |id, demand| {
            factors[id.0 as usize].map(|factor| factor * demand)
        });
        (cycles, values - self.own.1)
    }

    /// The same where it is said of values how often they are computed, given how often what
    /// uses them is.
    fn summed(
        &self,
        graph: &Graph,
        made: &[Option<NodeId>],
        times: &mut dyn FnMut(NodeId, f64) -> Option<f64>,
    ) -> (f64, f64) {
        let (needed, rates) = (needed(graph), rates(graph));
        let mut were = vec![Seen::default(); graph.nodes.len()];
        for (old, new) in self.known.iter().zip(made) {
            if let Some(new) = new {
                were[new.0 as usize] = *old;
            }
        }
        let mut demand = Demand::at_ends(graph, &self.loops);
        let (mut sum, mut values) = (0.0, 0.0);
        // Users stand behind what they use: a value's count is known when it is come to.
        for id in graph.ids().rev().filter(|id| needed[id.0 as usize]) {
            let at = id.0 as usize;
            let often = demand.often[at];
            let times = times(id, often).unwrap_or(often).min(self.most(&rates, id));
            let node = graph.node(id);
            match node {
                Node::Select { cond, yes, no } => {
                    let likely = were[cond.0 as usize].likely();
                    demand.add(cond, times, 1);
                    demand.add(yes, likely * times, 1);
                    demand.add(no, (1.0 - likely) * times, 1);
                }
                node => (node.operands()).for_each(|used| demand.add(used, times, 1)),
            }
            if let Node::Apply(op, _) = node {
                let cycles = were[at].cycles.unwrap_or_else(|| self.usually(op));
                let beside = self.beside(graph.ty(id), demand.uses[at]);
                sum += times * f64::from(cycles + beside);
                values += 1.0;
            }
        }
        (sum, values)
    }

    /// What it takes to keep a value and to read it so often; what is read once is written where
    /// that is.
    fn beside(&self, ty: Type, uses: u32) -> u32 {
        let kind = usize::from(ty == Type::Real);
        let Overhead { read, write, .. } = self.runtime.overhead;
        match uses {
            1 => 0,
            uses => write[kind] + uses * read[kind],
        }
    }

    /// How often a value changes.
    fn most(&self, rates: &Rates, id: NodeId) -> f64 {
        let change = |on: &Dependence| self.changes.get(on).copied().unwrap_or(1.0);
        rates.rate(id).iter().map(change).fold(0.0, f64::max)
    }

    fn usually(&self, op: Op) -> u32 {
        self.usual.get(&op).copied().unwrap_or_else(|| {
            let last = self.runtime.routines.iter().rfind(|r| r.op == op);
            last.map_or(0, |r| r.cycles)
        })
    }
}

/// How often values are asked for, as far as what uses them was looked at.
struct Demand {
    /// By what uses each of them oftenest.
    often: Vec<f64>,
    /// How many uses there are.
    uses: Vec<u32>,
}

impl Demand {
    /// What the picture asks for, and the ends of loops that run so often.
    fn at_ends(graph: &Graph, loops: &[[f64; 4]]) -> Demand {
        let mut demand = Demand {
            often: vec![0.0; graph.nodes.len()],
            uses: vec![0; graph.nodes.len()],
        };
        // What goes to another place is not written where it is read: it counts as two uses.
        for (k, l) in graph.loops.iter().enumerate() {
            let [turns, next, done, otherwise] = loops.get(k).copied().unwrap_or([1.0; 4]);
            demand.add(l.again, turns, 2);
            let lists = [
                (&l.init, done + otherwise),
                (&l.next, next),
                (&l.done, done),
                (&l.otherwise, otherwise),
            ];
            for (list, times) in lists {
                list.iter().for_each(|&root| demand.add(root, times, 2));
            }
        }
        graph.outputs().for_each(|root| demand.add(root, 1.0, 2));
        demand
    }

    fn add(&mut self, id: NodeId, times: f64, uses: u32) {
        let at = id.0 as usize;
        self.often[at] = self.often[at].max(times);
        self.uses[at] += uses;
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
