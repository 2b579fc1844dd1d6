//! Compiled form of a graph for the native evaluation: for each node what to do and where its
//! lanes are, for each thing that changes what is then to be forgotten.

use super::lanes::Count;
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::graph::*;
use crate::ir::ramp;
use slowlight_routine::{Op, Type};

/// Where a value comes from: its node, for what is known of it, and its slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source {
    pub node: u32,
    pub slot: u32,
}

/// How a node's lanes are computed.
#[derive(Clone, Copy, Debug)]
pub enum Task {
    /// They are there: constants, params, the pixel's place, carried values.
    Given,
    Apply {
        op: Op,
        args: [Source; 2],
    },
    Select {
        cond: Source,
        yes: Source,
        no: Source,
    },
    Lookup {
        table: u32,
        column: Source,
        row: Source,
    },
    /// By its number in [`Plan::ramps`].
    Ramp(u32),
    /// A result of a loop: where it is done, and where its turns are used up.
    Result {
        of: u32,
        done: Source,
        otherwise: Source,
    },
}

/// A node.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    pub task: Task,
    pub ty: Type,
    pub slot: u32,
    /// Whether it has one value for all pixels of a row: computed in lane 0,
    /// and spread from there.
    pub uniform: bool,
}

/// Moves a carried value; `via` where another move would overwrite its source first.
#[derive(Clone, Copy, Debug)]
pub struct Move {
    pub ty: Type,
    pub from: u32,
    pub via: Option<u32>,
    pub to: u32,
}

/// A loop.
#[derive(Clone, Debug)]
pub struct Turns {
    pub max: u32,
    pub again: Source,
    pub init: Vec<u32>,
    pub next: Vec<u32>,
    /// From the start values and from the next ones to the carried.
    pub start: Vec<Move>,
    pub shift: Vec<Move>,
    pub uniform: bool,
}

/// A ramp: what its value depends on ([`ramp::coefficients`]).
pub struct Ramp {
    pub parts: Vec<Source>,
    pub stride: i32,
}

/// A graph made ready.
pub struct Plan {
    /// Every node, and one more: what stands for operands that a right graph
    /// does not have. Its type is never asked for, and its slot is 0 in every type.
    pub steps: Vec<Step>,
    pub loops: Vec<Turns>,
    pub ramps: Vec<Ramp>,
    pub count: Count,
    /// Where the pixel's column and row go.
    pub axes: Vec<(Axis, u32)>,
    /// Where what the pixel has received goes.
    pub received: Vec<u32>,
    /// Where what its neighbours left goes.
    pub neighbours: Vec<(Neighbour, u32)>,
    /// The sets of things that values depend on, by thing ([`number`]).
    members: Vec<Vec<u32>>,
    /// What depends on each set: nodes, and loops by [`Plan::ran`].
    dependents: Vec<Vec<u32>>,
}

/// A dependence's number.
fn number(d: Dependence) -> usize {
    match d {
        Dependence::Frame => 0,
        Dependence::Row => 1,
        Dependence::Column | Dependence::Pass => 2,
        Dependence::Loop(l) => 3 + 2 * l.0 as usize,
        Dependence::Last(l) => 4 + 2 * l.0 as usize,
    }
}

impl Plan {
    /// Prepares a graph that [`crate::analysis::verify`] accepts.
    pub fn new(graph: &Graph) -> Plan {
        let rates = rates(graph);
        let sets = loop_sets(graph, &rates);
        let varying = varying(&rates, &sets);
        let mut maker = Maker {
            graph,
            count: Count::default(),
            carried: Vec::new(),
            ramps: Vec::new(),
            slots: Vec::with_capacity(graph.nodes.len()),
        };
        maker.slots();
        let steps = graph.ids().map(|id| Step {
            task: maker.task(id),
            ty: graph.ty(id),
            slot: maker.slots[id.0 as usize],
            uniform: !varying[rates.set(id).0 as usize],
        });
        let nothing = Step {
            task: Task::Given,
            ty: Type::Real,
            slot: 0,
            uniform: true,
        };
        let steps: Vec<Step> = steps.chain([nothing]).collect();
        let loops = (0..graph.loops.len())
            .map(|at| maker.turns(at, !varying[sets[at] as usize]))
            .collect();
        let mut plan = Plan {
            members: vec![Vec::new(); 3 + 2 * graph.loops.len()],
            dependents: vec![Vec::new(); rates.sets.len()],
            count: maker.count,
            ramps: maker.ramps,
            axes: Vec::new(),
            received: Vec::new(),
            neighbours: Vec::new(),
            steps,
            loops,
        };
        // Slot 0 is what no output reaches.
        for (id, step) in graph.ids().zip(&plan.steps).filter(|(_, s)| s.slot != 0) {
            match graph.node(id) {
                Node::Axis(axis) => plan.axes.push((axis, step.slot)),
                Node::Received => plan.received.push(step.slot),
                Node::Neighbour(which) => plan.neighbours.push((which, step.slot)),
                _ => {}
            }
        }
        for (k, set) in rates.sets.iter().enumerate() {
            for &d in set {
                plan.members[number(d)].push(k as u32);
            }
        }
        for id in graph.ids() {
            if !matches!(plan.steps[id.0 as usize].task, Task::Given) {
                plan.dependents[rates.set(id).0 as usize].push(id.0);
            }
        }
        for (of, &set) in sets.iter().enumerate() {
            let ran = plan.ran(of as u32) as u32;
            plan.dependents[set as usize].push(ran);
        }
        plan
    }

    /// Where it is noted in which lanes a loop has been run: behind the nodes.
    pub fn ran(&self, of: u32) -> usize {
        self.steps.len() + of as usize
    }

    /// What has to be forgotten where something changes.
    pub fn dependents(&self, on: Dependence) -> impl Iterator<Item = u32> + '_ {
        let sets = self.members[number(on)].iter();
        sets.flat_map(|&set| self.dependents[set as usize].iter().copied())
    }
}

/// For each loop, the set of things that its results depend on.
fn loop_sets(graph: &Graph, rates: &Rates) -> Vec<u32> {
    let mut sets = vec![0; graph.loops.len()];
    for id in graph.ids() {
        if let Node::Result { of, .. } = graph.node(id)
            && let Some(set) = sets.get_mut(of.0 as usize)
        {
            *set = rates.set(id).0;
        }
    }
    sets
}

/// Which sets' values differ from pixel to pixel of a row: the column's, and
/// those of loops whose results do.
fn varying(rates: &Rates, loop_sets: &[u32]) -> Vec<bool> {
    let mut varying = vec![false; rates.sets.len()];
    loop {
        let differs = |d: &Dependence| match d {
            Dependence::Column | Dependence::Pass => true,
            Dependence::Loop(l) | Dependence::Last(l) => {
                let set = loop_sets.get(l.0 as usize);
                set.is_some_and(|&set| varying[set as usize])
            }
            _ => false,
        };
        let found: Vec<bool> = (rates.sets.iter())
            .map(|set| set.iter().any(differs))
            .collect();
        if found == varying {
            return varying;
        }
        varying = found;
    }
}

struct Maker<'g> {
    graph: &'g Graph,
    count: Count,
    /// The slots of each loop's carried values.
    carried: Vec<Vec<u32>>,
    ramps: Vec<Ramp>,
    slots: Vec<u32>,
}

impl Maker<'_> {
    /// Gives out the slots: first those that stand for nothing, then carried
    /// values, then nodes, so that operands stand before what uses them.
    fn slots(&mut self) {
        for ty in [Type::Bool, Type::Int, Type::Real] {
            self.count.add(ty);
        }
        for found in &self.graph.loops {
            let slots = found.types.iter().map(|&ty| self.count.add(ty));
            self.carried.push(slots.collect());
        }
        let reached = self.graph.reached();
        for id in self.graph.ids() {
            let ty = self.graph.ty(id);
            let slot = match self.graph.node(id) {
                _ if !reached[id.0 as usize] => 0,
                Node::Carried { of, index } | Node::Last { of, index } => {
                    self.carried_slot(of, index, ty).unwrap_or(0)
                }
                Node::Undefined(_) => 0,
                _ => self.count.add(ty),
            };
            self.slots.push(slot);
        }
    }

    fn carried_slot(&self, of: LoopId, index: u32, ty: Type) -> Option<u32> {
        let (of, index) = (of.0 as usize, index as usize);
        let kept = self.graph.loops.get(of)?.types.get(index)?;
        let slot = self.carried.get(of)?.get(index)?;
        (*kept == ty).then_some(*slot)
    }

    /// Where an operand of some type comes from.
    fn source(&self, id: NodeId, ty: Type) -> Source {
        match self.slots.get(id.0 as usize) {
            Some(&slot) if self.graph.ty(id) == ty => Source { node: id.0, slot },
            _ => self.nothing(),
        }
    }

    fn nothing(&self) -> Source {
        Source {
            node: self.slots.len() as u32,
            slot: 0,
        }
    }

    fn task(&mut self, id: NodeId) -> Task {
        let ty = self.graph.ty(id);
        match self.graph.node(id) {
            Node::Apply(op, [a, b]) if op.result() == ty => {
                let types = op.args();
                let first = types.first().copied().unwrap_or(Type::Bool);
                let a = self.source(a, first);
                let b = types.get(1).map_or(a, |&ty| self.source(b, ty));
                Task::Apply { op, args: [a, b] }
            }
            Node::Select { cond, yes, no } => Task::Select {
                cond: self.source(cond, Type::Bool),
                yes: self.source(yes, ty),
                no: self.source(no, ty),
            },
            Node::Lookup { table, column, row } => Task::Lookup {
                table: table.0,
                column: self.source(column, Type::Int),
                row: self.source(row, Type::Int),
            },
            // Both arms of a choice, whatever is asked.
            Node::Tabulated(value) => Task::Select {
                cond: self.nothing(),
                yes: self.source(value, ty),
                no: self.source(value, ty),
            },
            Node::Stepped { first, step } => Task::Apply {
                op: Op::IntAdd,
                args: [first, step].map(|id| self.source(id, Type::Int)),
            },
            Node::Ramp { .. } => {
                let parts = ramp::coefficients(self.graph, id).into_iter();
                let parts = parts.map(|part| self.source(part, Type::Int)).collect();
                let stride = ramp::stride(self.graph, id) as i32;
                self.ramps.push(Ramp { parts, stride });
                Task::Ramp(self.ramps.len() as u32 - 1)
            }
            Node::Result { of, index } if (of.0 as usize) < self.graph.loops.len() => {
                let found = &self.graph.loops[of.0 as usize];
                let source = |list: &[NodeId]| {
                    let node = list.get(index as usize);
                    node.map_or(self.nothing(), |&node| self.source(node, ty))
                };
                Task::Result {
                    of: of.0,
                    done: source(&found.done),
                    otherwise: source(&found.otherwise),
                }
            }
            _ => Task::Given,
        }
    }

    fn turns(&mut self, at: usize, uniform: bool) -> Turns {
        let found = &self.graph.loops[at];
        Turns {
            max: found.max,
            again: self.source(found.again, Type::Bool),
            init: found.init.iter().map(|n| n.0).collect(),
            next: found.next.iter().map(|n| n.0).collect(),
            start: self.moves(at, &found.init),
            shift: self.moves(at, &found.next),
            uniform,
        }
    }

    /// The moves that make some values a loop's carried ones, all at once.
    fn moves(&mut self, at: usize, values: &[NodeId]) -> Vec<Move> {
        let mut moves = Vec::new();
        let targets = self.carried[at].clone();
        for ((&id, &ty), &to) in values.iter().zip(&self.graph.loops[at].types).zip(&targets) {
            let from = self.source(id, ty).slot;
            // Another of this loop's carried values.
            let own = matches!(self.graph.node(id), Node::Carried { of, .. } | Node::Last { of, .. }
                if of.0 as usize == at);
            if from != to {
                let via = own.then(|| self.count.add(ty));
                moves.push(Move { ty, from, via, to });
            }
        }
        moves
    }
}
