//! Tape for reverse accumulation: what was computed at pixels, kept so that what is asked of the
//! result can be followed back to every value that it was made of.

use crate::ir::graph::*;
use crate::wordlength::adjoint::{Asked, of_both, of_operand};
use slowlight_routine::{Op, Value};

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
    /// Where its operands stand, and what they were.
    from: [u32; 2],
    args: [f64; 2],
    value: Value,
}

/// All that was computed since the tape began.
pub struct Tape {
    entries: Vec<Entry>,
    /// What is asked of each, while it is followed back: nothing yet, or not any more.
    asked: Vec<Asked>,
    /// Which stand at the beginning: one for each node.
    leaves: u32,
}

impl Tape {
    /// With nothing but what needs no computing.
    pub fn new(graph: &Graph) -> Tape {
        let leaf = |of: NodeId| Entry {
            of,
            op: None,
            from: [NOWHERE; 2],
            args: [0.0; 2],
            value: Value::Int(0),
        };
        Tape {
            asked: vec![Asked::default(); graph.nodes.len()],
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
        let length = length.max(self.leaves as usize);
        self.entries.truncate(length);
        self.asked.truncate(length);
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
        self.asked.push(Asked::default());
        self.entries.push(Entry {
            of,
            op,
            from: from.map(|arg| arg.at),
            args: match op {
                Some(op) if op.arity() == 1 => [from[0].value.real(), 0.0],
                _ => from.map(|arg| arg.value.real()),
            },
            value,
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
        for root in roots {
            self.ask(root.at, Asked::whole(root.value.real()));
        }
        // What was computed last first, so that all is known that is asked of a value: whoever
        // asks stands behind it.
        for at in (0..self.entries.len()).rev() {
            if !self.asked[at].is_something() {
                continue;
            }
            let asked = std::mem::take(&mut self.asked[at]);
            let entry = &self.entries[at];
            tell(entry.of, entry.value, asked);
            if at < self.leaves as usize {
                continue;
            }
            let (from, args, value) = (entry.from, entry.args, entry.value.real());
            let Some(op) = entry.op else {
                self.ask(from[0], asked);
                continue;
            };
            let one = (op.arity() == 2 && from[0] == from[1] && from[0] != NOWHERE)
                .then(|| of_both(op, args[0], asked));
            if let Some(Some(asked)) = one {
                self.ask(from[0], asked);
                continue;
            }
            for (k, from) in from.into_iter().enumerate().take(op.arity()) {
                self.ask(from, of_operand(op, k, args, value, asked));
            }
        }
    }

    fn ask(&mut self, at: u32, asked: Asked) {
        if asked.is_something()
            && let Some(held) = self.asked.get_mut(at as usize)
        {
            *held = held.both(asked);
        }
    }
}
