//! Forward substitution of single-use values: which may be written where they are read.

use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::Plan;
use crate::schedule::constant_runs::Still;
use crate::targets::Language;
use rustc_hash::FxHashMap;
use slowlight_routine::{Form, Op, Routine, Value};

/// How often an int may be read as a real where it is not kept as one: each time takes
/// a sixth of what keeping it takes.
const READS: u32 = 4;

/// For each node: whether it is computed by a `Let`, read exactly once, and
/// that by a later statement of the same block with nothing in between that
/// could change what it reads; more often where it is written as its operand is. An expression
/// that has an operand in several places reads it more than once.
pub fn folded(
    graph: &Graph,
    tree: &Tree,
    still: Option<&Still>,
    routines: &[Option<&'static Routine>],
) -> Vec<bool> {
    let mut uses = Uses {
        graph,
        routines,
        count: vec![0; graph.nodes.len()],
        reader: FxHashMap::default(),
        blocks: 0,
        home: FxHashMap::default(),
    };
    for block in tree.blocks() {
        let number = uses.block(block);
        if std::ptr::eq(block, &raw const tree.pixel) {
            uses.read(graph.ink, number);
            // What is left to others is read after the ink, and what is reported last of all.
            graph.left_to_others().for_each(|id| uses.read(id, 0));
            graph.reports.iter().for_each(|&id| uses.read(id, 0));
            still
                .into_iter()
                .flat_map(|still| still.reads(graph))
                .for_each(|id| uses.read(id, 0));
        }
    }
    let once = |id: NodeId| uses.is_read_at_home(id) && uses.count[id.0 as usize] == 1;
    // Its operand is a variable: it would be computed each time.
    let as_it_is = |id: NodeId| {
        let routine = routines.get(id.0 as usize).copied().flatten();
        let same = |r: &Routine| {
            matches!(
                r.form,
                Form::Expression {
                    template: "{0}",
                    ..
                }
            )
        };
        routine.is_some_and(same) && !graph.node(id).operands().any(once)
    };
    let fits = |id: NodeId| {
        let few = uses.count[id.0 as usize] <= READS;
        once(id) || few && uses.is_read_at_home(id) && as_it_is(id)
    };
    graph.ids().map(fits).collect()
}

struct Uses<'g> {
    graph: &'g Graph,
    routines: &'g [Option<&'static Routine>],
    count: Vec<u32>,
    /// The block that a node was read in; 0 where those are several, or where it must
    /// not be folded.
    reader: FxHashMap<NodeId, u32>,
    blocks: u32,
    /// The block that a node is computed in.
    home: FxHashMap<NodeId, u32>,
}

impl Uses<'_> {
    /// Whether all that reads a value stands in the block that computes it. What is
    /// stepped must be kept for the next pixel.
    fn is_read_at_home(&self, id: NodeId) -> bool {
        let home = self.home.get(&id);
        let stepped = matches!(self.graph.node(id), Node::Stepped { .. });
        !stepped && home.is_some() && home == self.reader.get(&id)
    }

    /// Operands that a routine's expression has in several places.
    fn read_again(&mut self, id: NodeId, block: u32) {
        let routine = self.routines.get(id.0 as usize).copied().flatten();
        let (Some(routine), Node::Apply(op, args)) = (routine, self.graph.node(id)) else {
            return;
        };
        for (k, arg) in args.into_iter().take(op.arity()).enumerate() {
            if routine.form.repeats(k) {
                self.read(arg, block);
            }
        }
    }

    fn read(&mut self, id: NodeId, block: u32) {
        self.count[id.0 as usize] += 1;
        let reader = self.reader.entry(id).or_insert(block);
        if *reader != block {
            *reader = 0;
        }
    }

    fn block(&mut self, block: &Block) -> u32 {
        self.blocks += 1;
        let number = self.blocks;
        // Several moves of carried values happen at once: what a later one
        // reads must have been computed before the first.
        let carried = |s: &&Statement| {
            matches!(
                s,
                Statement::Set {
                    place: Place::Carried(..),
                    ..
                }
            )
        };
        let moves = block.iter().filter(carried).count();
        for statement in block {
            match statement {
                Statement::Let(id) => {
                    self.home.insert(*id, number);
                    let stepped = match self.graph.node(*id) {
                        Node::Ramp { step, .. } => Some(step),
                        _ => None,
                    };
                    for operand in self.graph.node(*id).inputs() {
                        // A step is read again at the end of every pixel.
                        let here = if stepped == Some(operand) { 0 } else { number };
                        self.read(operand, here);
                    }
                    self.read_again(*id, number);
                }
                Statement::Set {
                    place,
                    from: Origin::Node(id),
                } => {
                    let several = matches!(place, Place::Carried(..)) && moves > 1;
                    self.read(*id, if several { 0 } else { number });
                }
                Statement::Set { .. } | Statement::Call(_) => {}
                Statement::If { cond, yes, no } => {
                    self.read(*cond, number);
                    self.block(yes);
                    self.block(no);
                }
                Statement::Loop(turns) => {
                    self.block(&turns.start);
                    let inner = self.block(&turns.body);
                    self.read(turns.again, inner);
                    self.block(&turns.next);
                    self.block(&turns.done);
                    self.block(&turns.otherwise);
                }
            }
        }
        number
    }
}

/// Whether a value has a variable even where it is read once: of a value and a number
/// the smaller is found by a test, which assigns. Jack has functions for it.
pub(super) fn is_kept(plan: &Plan, id: NodeId) -> bool {
    let Node::Apply(op, [_, number]) = plan.graph.node(id) else {
        return false;
    };
    if plan.target.system.language() == Language::Jack {
        return false;
    }
    match op {
        // In BASIC tests choose among its ways as well.
        Op::Atan2 => return plan.target.system.language() == Language::Basic,
        Op::Min | Op::Max | Op::IntMin | Op::IntMax => {}
        _ => return false,
    }
    // The least int has no literal of its own.
    let number = plan.graph.constant(number);
    number.is_some_and(|value| value != Value::Int(i32::MIN))
}
