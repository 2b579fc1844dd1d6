//! Loop-invariant code motion by frequency: values that some turns of a loop need, in an arm or
//! on the way to another turn, and that no turn changes.
//!
//! What every turn computes stands before the loop in any case ([`crate::schedule::placement`]). What stands
//! in an arm is computed as often as pixels come there: more often than the loop is begun, it
//! is worth its place before the loop, though some pixels then compute it in vain. Every
//! operation is total, so that does no harm.
//! (Aho, Lam, Sethi and Ullman, Compilers, 2nd edition, 9.5; by a profile, as in Cai and Xue,
//! Optimal and efficient speculation-based partial redundancy elimination, CGO 2003.)

use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::graph::*;
use crate::ir::tree::*;
use std::collections::BTreeMap;

/// How many times as often as the loop begins a value must be computed: one that is kept
/// through it takes a variable, and is written to it.
const OFTENER: u64 = 5;
const THAN: u64 = 4;

/// How often a value was computed, and how often the loop began that it is hoisted out of.
#[derive(Clone, Copy, Debug)]
pub struct Hoist {
    /// As it stands.
    pub times: u64,
    /// Before the loop.
    pub begun: u64,
}

/// The values of a pixel that are worth hoisting, and out of which loops, given how often each
/// statement ran.
pub fn hoisted(
    graph: &Graph,
    pixel: &Block,
    ran: &dyn Fn(&Statement) -> u64,
) -> BTreeMap<(NodeId, LoopId), Hoist> {
    let mut finder = Finder {
        graph,
        rates: rates(graph),
        ran,
        around: Vec::new(),
        found: BTreeMap::new(),
    };
    finder.block(pixel);
    finder.found
}

struct Finder<'g> {
    graph: &'g Graph,
    rates: Rates,
    ran: &'g dyn Fn(&Statement) -> u64,
    /// The loops around, outermost first, and how often each was begun.
    around: Vec<(LoopId, u64)>,
    found: BTreeMap<(NodeId, LoopId), Hoist>,
}

impl Finder<'_> {
    fn block(&mut self, block: &Block) {
        for statement in block {
            let times = (self.ran)(statement);
            match statement {
                Statement::Let(id) => self.value(*id, times),
                Statement::If { yes, no, .. } => {
                    for set in yes.iter() {
                        if let Statement::Set {
                            place: Place::Node(id),
                            ..
                        } = set
                            && matches!(self.graph.node(*id), Node::Select { .. })
                        {
                            self.value(*id, times);
                        }
                    }
                    self.block(yes);
                    self.block(no);
                }
                Statement::Loop(turns) => self.turns(turns, times),
                Statement::Set { .. } | Statement::Call(_) => {}
            }
        }
    }

    fn turns(&mut self, turns: &Turns, times: u64) {
        let result =
            |id: &NodeId| matches!(self.graph.node(*id), Node::Result { of, .. } if of == turns.of);
        let results: Vec<NodeId> = self.graph.ids().filter(result).collect();
        results.into_iter().for_each(|id| self.value(id, times));
        self.block(&turns.start);
        self.around.push((turns.of, times));
        for block in [&turns.body, &turns.next, &turns.done] {
            self.block(block);
        }
        self.around.pop();
        self.block(&turns.otherwise);
    }

    /// A value that was computed so often.
    fn value(&mut self, id: NodeId, times: u64) {
        // What a loop's last turn gave changes with the loops around that one, of which its
        // rate knows nothing.
        if (self.rates.rate(id).iter()).any(|by| matches!(by, Dependence::Last(_))) {
            return;
        }
        for (of, begun) in self.around.iter().rev() {
            let changes = [Dependence::Loop(*of), Dependence::Last(*of)];
            let stays = !changes.into_iter().any(|by| self.rates.depends(id, by));
            if !stays || THAN * times <= OFTENER * begun {
                break;
            }
            let hoist = Hoist {
                times,
                begun: *begun,
            };
            self.found.insert((id, *of), hoist);
        }
    }
}
