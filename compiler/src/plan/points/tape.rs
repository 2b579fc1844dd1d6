//! What was computed at pixels, kept so that what is asked of the result can be followed
//! back to every value that it was made of.

use super::asks::{Asked, of_both, of_operand};
use crate::flow::graph::*;
use slowlight_routine::{Op, Value};
use std::collections::BinaryHeap;

/// A value, and where on the tape it stands.
#[derive(Clone, Copy)]
pub struct Traced {
    pub value: Value,
    /// [`NOWHERE`] for what nothing was computed for.
    pub at: u32,
}

/// Where constants, columns and rows stand.
pub const NOWHERE: u32 = u32::MAX;

/// How much one pixel's values may take of the tape: what is computed after that is not
/// followed back.
const MOST: usize = 4_000_000;

/// One value that was computed or copied, or a node that needs no computing.
struct Entry {
    of: NodeId,
    /// None for copies.
    op: Option<Op>,
    from: [Traced; 2],
    value: Value,
    asked: Asked,
    /// Whether it waits to be followed further.
    waits: bool,
}

/// All that was computed since the tape began.
pub struct Tape {
    entries: Vec<Entry>,
    /// Which stand at the beginning: one for each node.
    leaves: u32,
}

impl Tape {
    /// With nothing but what needs no computing.
    pub fn new(graph: &Graph) -> Tape {
        let leaf = |of: NodeId| Entry {
            of,
            op: None,
            from: [Traced {
                value: Value::Int(0),
                at: NOWHERE,
            }; 2],
            value: Value::Int(0),
            asked: Asked::default(),
            waits: false,
        };
        Tape {
            entries: graph.ids().map(leaf).collect(),
            leaves: graph.nodes.len() as u32,
        }
    }

    /// How much stands on it.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Takes away what was computed since it had that length, once all that was asked of it
    /// has been followed.
    pub fn back_to(&mut self, length: usize) {
        self.entries.truncate(length.max(self.leaves as usize));
    }

    /// A value as a node's that needs no computing; as it is where it was computed.
    fn leaf(&mut self, of: NodeId, traced: Traced) -> Traced {
        match self.entries.get_mut(of.0 as usize) {
            Some(leaf) if traced.at == NOWHERE => {
                leaf.value = traced.value;
                Traced { at: of.0, ..traced }
            }
            _ => traced,
        }
    }

    /// An operation's result.
    pub fn computed(&mut self, graph: &Graph, id: NodeId, op: Op, args: &[Traced]) -> Traced {
        let of = match graph.node(id) {
            Node::Apply(_, of) => of,
            _ => [id; 2],
        };
        let leaf = |tape: &mut Tape, k: usize| {
            let arg = args.get(k).or(args.first()).copied();
            let arg = arg.unwrap_or(Traced {
                value: Value::Int(0),
                at: NOWHERE,
            });
            tape.leaf(of[k], arg)
        };
        let from = [leaf(self, 0), leaf(self, 1)];
        let values = from.map(|arg| arg.value);
        let value = op.eval(&values[..op.arity()]);
        self.push(id, Some(op), from, value)
    }

    /// What a place holds that is given a value; `of` is a node that reads it.
    pub fn copied(&mut self, of: NodeId, from: NodeId, traced: Traced) -> Traced {
        let traced = self.leaf(from, traced);
        self.push(of, None, [traced; 2], traced.value)
    }

    fn push(&mut self, of: NodeId, op: Option<Op>, from: [Traced; 2], value: Value) -> Traced {
        if self.entries.len() >= MOST {
            return Traced { value, at: NOWHERE };
        }
        let at = self.entries.len() as u32;
        self.entries.push(Entry {
            of,
            op,
            from,
            value,
            asked: Asked::default(),
            waits: false,
        });
        Traced { value, at }
    }

    /// The node whose value stands somewhere.
    pub fn node(&self, traced: Traced) -> Option<NodeId> {
        self.entries.get(traced.at as usize).map(|entry| entry.of)
    }

    /// Follows what is asked of some values back to all that they were made of, and tells
    /// of each with its node.
    pub fn follow(
        &mut self,
        roots: impl Iterator<Item = Traced>,
        tell: &mut impl FnMut(NodeId, Value, Asked),
    ) {
        let mut waiting = BinaryHeap::new();
        for root in roots {
            self.ask(root, Asked::whole(root.value.real()), &mut waiting);
        }
        // What was computed last first, so that all is known that is asked of a value.
        while let Some(at) = waiting.pop() {
            let Some(entry) = self.entries.get_mut(at as usize) else {
                continue;
            };
            let asked = std::mem::take(&mut entry.asked);
            entry.waits = false;
            tell(entry.of, entry.value, asked);
            let (op, from, value) = (entry.op, entry.from, entry.value);
            if at < self.leaves {
                continue;
            }
            let Some(op) = op else {
                self.ask(from[0], asked, &mut waiting);
                continue;
            };
            let one = (op.arity() == 2 && from[0].at == from[1].at && from[0].at != NOWHERE)
                .then(|| of_both(op, from[0].value.real(), asked));
            if let Some(Some(asked)) = one {
                self.ask(from[0], asked, &mut waiting);
                continue;
            }
            let values = from.map(|arg| arg.value);
            for (k, arg) in from.into_iter().enumerate().take(op.arity()) {
                let asked = of_operand(op, k, &values[..op.arity()], value, asked);
                self.ask(arg, asked, &mut waiting);
            }
        }
    }

    fn ask(&mut self, of: Traced, asked: Asked, waiting: &mut BinaryHeap<u32>) {
        if let Some(entry) = self.entries.get_mut(of.at as usize)
            && asked.is_something()
        {
            entry.asked = entry.asked.both(asked);
            if !std::mem::replace(&mut entry.waits, true) {
                waiting.push(of.at);
            }
        }
    }
}
