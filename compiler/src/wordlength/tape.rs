//! Tape for reverse accumulation: what was computed at pixels, kept so that what is asked of the
//! result can be followed back to every value that it was made of.

use crate::eval::arithmetic::{Tagged, computed};
use crate::ir::graph::*;
use crate::wordlength::adjoint::{Asked, of_both, of_operand};
use slowlight_routine::{Op, Type};
use std::num::NonZeroU64;

/// A value, and where on the tape it stands: two words, as a [`Tagged`] is.
#[derive(Clone, Copy)]
pub struct Traced {
    bits: u64,
    /// Where it stands, then its type.
    at: NonZeroU64,
}

/// Where constants, columns and rows stand.
const NOWHERE: u32 = u32::MAX;

impl Traced {
    #[inline]
    fn new(tagged: Tagged, at: u32) -> Traced {
        let (ty, bits) = tagged.parts();
        let ty = match ty {
            Type::Bool => 1,
            Type::Int => 3,
            Type::Real => 5,
        };
        // The last bit is always set.
        Traced {
            bits,
            at: NonZeroU64::MIN | u64::from(at) << 3 | ty,
        }
    }

    /// A value that nothing was computed for.
    #[inline]
    pub fn nowhere(tagged: Tagged) -> Traced {
        Traced::new(tagged, NOWHERE)
    }

    /// The value.
    #[inline]
    pub fn tagged(self) -> Tagged {
        let ty = match self.at.get() & 7 {
            1 => Type::Bool,
            3 => Type::Int,
            _ => Type::Real,
        };
        Tagged::of(ty, self.bits)
    }

    #[inline]
    fn at(self) -> u32 {
        (self.at.get() >> 3) as u32
    }
}

/// How much one pixel's values may take of the tape: what is computed after that is not
/// followed back.
const MOST: usize = 4_000_000;

/// One value that was computed or copied, or a node that needs no computing.
struct Entry {
    of: NodeId,
    /// None for copies.
    op: Option<Op>,
    is_real: bool,
    /// Where its operands stand, and what they were.
    from: [u32; 2],
    args: [f64; 2],
    value: f64,
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
            is_real: false,
            value: 0.0,
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
    #[inline]
    fn leaf(&mut self, of: NodeId, traced: Traced) -> Traced {
        match self.entries.get_mut(of.0 as usize) {
            Some(leaf) if traced.at() == NOWHERE => {
                let tagged = traced.tagged();
                (leaf.value, leaf.is_real) = (tagged.real(), tagged.ty() == Type::Real);
                Traced::new(tagged, of.0)
            }
            _ => traced,
        }
    }

    /// An operation's result; what it is of are its operands' nodes, and what they are.
    #[inline]
    pub fn computed(&mut self, id: NodeId, op: Op, of: [NodeId; 2], args: [Traced; 2]) -> Traced {
        let from = [self.leaf(of[0], args[0]), self.leaf(of[1], args[1])];
        let tagged = from.map(Traced::tagged);
        let result = computed(op, &tagged[..op.arity()]);
        let args = match op.arity() {
            1 => [tagged[0].real(), 0.0],
            _ => tagged.map(Tagged::real),
        };
        self.push(id, Some(op), (from.map(Traced::at), args), result)
    }

    /// What a place holds that is given a value; `of` is a node that reads it.
    pub fn copied(&mut self, of: NodeId, from: NodeId, traced: Traced) -> Traced {
        let traced = self.leaf(from, traced);
        let tagged = traced.tagged();
        self.push(of, None, ([traced.at(); 2], [tagged.real(); 2]), tagged)
    }

    #[inline]
    fn push(
        &mut self,
        of: NodeId,
        op: Option<Op>,
        (from, args): ([u32; 2], [f64; 2]),
        tagged: Tagged,
    ) -> Traced {
        if self.entries.len() >= MOST {
            return Traced::nowhere(tagged);
        }
        let at = self.entries.len() as u32;
        self.asked.push(Asked::default());
        self.entries.push(Entry {
            of,
            op,
            is_real: tagged.ty() == Type::Real,
            from,
            args,
            value: tagged.real(),
        });
        Traced::new(tagged, at)
    }

    /// The node whose value stands somewhere.
    pub fn node(&self, traced: Traced) -> Option<NodeId> {
        self.entries.get(traced.at() as usize).map(|entry| entry.of)
    }

    /// Follows what is asked of some values back to all that they were made of, and tells
    /// of each that is a real with its node.
    pub fn follow(
        &mut self,
        roots: impl Iterator<Item = Traced>,
        tell: &mut impl FnMut(NodeId, f64, Asked),
    ) {
        for root in roots {
            self.ask(root.at(), Asked::whole(root.tagged().real()));
        }
        // What was computed last first, so that all is known that is asked of a value: whoever
        // asks stands behind it.
        for at in (0..self.entries.len()).rev() {
            if !self.asked[at].is_something() {
                continue;
            }
            let asked = std::mem::take(&mut self.asked[at]);
            let entry = &self.entries[at];
            if entry.is_real {
                tell(entry.of, entry.value, asked);
            }
            if at < self.leaves as usize {
                continue;
            }
            let (from, args, value) = (entry.from, entry.args, entry.value);
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
