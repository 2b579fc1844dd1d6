//! Equivalence of statements for outlining: what statements of one shape have to agree in.

use super::step::Step;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::targets::Sizes;

/// What a statement, or the beginning or end of one, has to agree in, and what it refers to.
#[derive(Clone, Debug, Default)]
pub(super) struct Token {
    /// Kind, operation, types: as numbers.
    pub shape: [u32; 4],
    /// What is read.
    pub uses: Vec<NodeId>,
    /// The node that is written.
    pub def: Option<NodeId>,
    /// The loop whose carried value is written or saved one read.
    pub within: Option<LoopId>,
    /// The loop that begins here.
    pub opens: Option<LoopId>,
    /// Whether it runs whenever the statement that it belongs to does.
    pub sure: bool,
    /// What it takes in the program.
    pub bytes: u32,
}

/// What a statement itself reads, without those inside it.
pub(super) fn reads_of(graph: &Graph, step: &Step) -> Vec<NodeId> {
    match step {
        Step::Let(id) => graph.node(*id).operands().collect(),
        Step::Set {
            from: Origin::Node(id),
            ..
        } => vec![*id],
        Step::If { cond, .. } => vec![*cond],
        Step::Loop { again, .. } => vec![*again],
        Step::Set { .. } | Step::Call(_) => Vec::new(),
    }
}

/// A statement's first token.
pub(super) fn plain(graph: &Graph, step: &Step, sizes: &Sizes) -> Token {
    let mut token = Token {
        uses: reads_of(graph, step),
        sure: true,
        ..Token::default()
    };
    match *step {
        Step::Let(id) => {
            let (kind, what) = match graph.node(id) {
                Node::Apply(op, _) => (1, op as u32),
                Node::Lookup { table, .. } => (2, table.0),
                _ => (3, id.0),
            };
            token.shape = [kind, what, graph.ty(id) as u32, 0];
            token.def = Some(id);
        }
        Step::Set { place, from } => {
            let (kind, what, ty) = match place {
                Place::Node(id) => {
                    token.def = Some(id);
                    (4, 0, graph.ty(id))
                }
                Place::Carried(of, index) => {
                    token.within = Some(of);
                    (5, index, carried_type(graph, of, index))
                }
                Place::Scratch(of, index) => {
                    token.within = Some(of);
                    (6, index, carried_type(graph, of, index))
                }
            };
            let saved = match from {
                Origin::Node(_) => 0,
                Origin::Scratch(of, index) => {
                    token.within = Some(of);
                    index + 1
                }
            };
            token.shape = [kind, what, ty as u32, saved];
            token.bytes = sizes.copy_of(ty);
        }
        Step::If { .. } => {
            token.shape = [7, 0, 0, 0];
            token.bytes = sizes.test;
        }
        Step::Loop { of, .. } => {
            let max = graph.loops.get(of.0 as usize).map_or(1, |l| l.max);
            token.shape = [8, max, 0, 0];
            token.opens = Some(of);
            // It is read behind the body, where its own token stands.
            token.uses.clear();
            token.bytes = sizes.turns;
        }
        Step::Call(id) => {
            token.shape = [9, id.0, 0, 0];
            token.bytes = sizes.call;
        }
    }
    token
}

fn carried_type(graph: &Graph, of: LoopId, index: u32) -> slowlight_routine::Type {
    let found = graph.loops.get(of.0 as usize);
    let found = found.and_then(|l| l.types.get(index as usize));
    found.copied().unwrap_or(slowlight_routine::Type::Real)
}

/// Mixes a number into another (the finaliser of MurmurHash3).
pub(super) fn mix(into: u64, value: u64) -> u64 {
    let mut h = (into ^ value).wrapping_mul(0xff51_afd7_ed55_8ccd);
    h ^= h >> 33;
    h = h.wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    h ^ (h >> 29)
}
