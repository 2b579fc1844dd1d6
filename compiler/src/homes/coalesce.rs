//! Copy coalescing of nested selects: choices in choices that keep one home.
//!
//! A chain of conditions is a choice whose other arm is a choice again, and so
//! on: written down, each level ends in a copy to the level around. Where the
//! inner value is computed inside the arm, and read only to be copied at its
//! end, both may have one home: until the arm's end the outer value is not
//! there yet. Then the copy is none. A loop ends on one of two ways, too.

use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::Plan;
use rustc_hash::FxHashMap;

/// For each place that another's home serves: whose.
pub fn merged(plan: &Plan) -> FxHashMap<Place, Place> {
    // Programs that fit stay as they are.
    if !plan.is_outlined() {
        return FxHashMap::default();
    }
    let mut all = Accesses::default();
    for block in plan.tree.blocks() {
        all.count(plan, block);
    }
    let graph = &plan.graph;
    let read_behind = graph.roots().chain(graph.shade);
    read_behind.for_each(|id| all.read(id));
    let mut found = FxHashMap::default();
    for block in plan.tree.blocks() {
        walk(block, &mut |statement| {
            let (one, other) = match statement {
                Statement::If { yes, no, .. } => (yes, no),
                Statement::Loop(turns) => (&turns.done, &turns.otherwise),
                _ => return,
            };
            arm(plan, &all, one, other, &mut found);
            arm(plan, &all, other, one, &mut found);
        });
    }
    let last = |mut place: Place| {
        while let Some(&next) = found.get(&place) {
            place = next;
        }
        place
    };
    found.keys().map(|&place| (place, last(place))).collect()
}

/// The places that are set at the end of an arm, as they are of the other, from
/// what only this arm computes.
fn arm(
    plan: &Plan,
    all: &Accesses,
    arm: &Block,
    other: &Block,
    found: &mut FxHashMap<Place, Place>,
) {
    let ends = |block: &Block, outer: Place| {
        let sets = block.iter().filter(|s| sets_place(s, outer));
        sets.count() == 1
    };
    let mut inside: Option<Accesses> = None;
    for statement in arm {
        let Statement::Set {
            place: outer @ Place::Node(to),
            from: Origin::Node(from),
        } = *statement
        else {
            continue;
        };
        let inner = Place::Node(from);
        let node = plan.graph.node(to);
        let choice = matches!(node, Node::Select { .. } | Node::Result { .. });
        let computed = plan.place(from) == Some(inner);
        let alike = plan.place_format(inner) == plan.place_format(outer);
        let once = all.reads.get(&from) == Some(&1) && all.writes.get(&to) == Some(&2);
        if !choice || !computed || !alike || !once || !ends(arm, outer) || !ends(other, outer) {
            continue;
        }
        let here = inside.get_or_insert_with(|| {
            let mut here = Accesses::default();
            here.count(plan, arm);
            here
        });
        if here.writes.contains_key(&from) && here.writes.get(&from) == all.writes.get(&from) {
            found.insert(inner, outer);
        }
    }
}

fn sets_place(statement: &Statement, outer: Place) -> bool {
    matches!(statement, Statement::Set { place, .. } if *place == outer)
}

/// How often nodes' homes are read and written.
#[derive(Default)]
struct Accesses {
    reads: FxHashMap<NodeId, u32>,
    writes: FxHashMap<NodeId, u32>,
}

impl Accesses {
    fn read(&mut self, id: NodeId) {
        *self.reads.entry(id).or_default() += 1;
    }

    fn count(&mut self, plan: &Plan, block: &Block) {
        walk(block, &mut |statement| match statement {
            Statement::Let(id) => {
                *self.writes.entry(*id).or_default() += 1;
                plan.graph.node(*id).inputs().for_each(|id| self.read(id));
            }
            Statement::Set { place, from } => {
                if let Place::Node(id) = place {
                    *self.writes.entry(*id).or_default() += 1;
                }
                if let Origin::Node(id) = from {
                    self.read(*id);
                }
            }
            Statement::If { cond, .. } => self.read(*cond),
            Statement::Loop(turns) => self.read(turns.again),
            Statement::Call(_) => {}
        });
    }
}
