//! Canonical tokens of statements, by which runs are compared for outlining.

use super::forest::Forest;
use super::step::{BlockId, Step};
use super::token::{Token, plain, reads_of};
use crate::ir::graph::*;
use crate::targets::Sizes;
use slowlight_routine::Op;

impl Forest {
    /// Gives every statement its tokens, and counts who reads what.
    pub(super) fn describe(&mut self, graph: &Graph, bytes: &[u32], sizes: &Sizes) {
        for top in self.tops.clone() {
            self.describe_block(graph, bytes, sizes, top);
        }
        for block in 0..self.tokens.len() {
            for step in self.blocks[block].iter().flatten() {
                for id in reads_of(graph, step) {
                    self.reads[id.0 as usize] += 1;
                }
            }
        }
    }

    fn describe_block(&mut self, graph: &Graph, bytes: &[u32], sizes: &Sizes, block: BlockId) {
        for at in 0..self.blocks[block].len() {
            let mut tokens = Vec::new();
            for step in self.blocks[block][at].clone() {
                self.describe_step(graph, bytes, sizes, &step, &mut tokens);
            }
            self.tokens[block].push(tokens);
        }
    }

    fn describe_step(
        &mut self,
        graph: &Graph,
        bytes: &[u32],
        sizes: &Sizes,
        step: &Step,
        tokens: &mut Vec<Token>,
    ) {
        let mut token = plain(graph, step, sizes);
        if let Step::Let(id) = step {
            let routine = bytes.get(id.0 as usize).copied().unwrap_or(0);
            token.bytes = routine + sizes.operation;
            if compares_column(graph, *id) {
                token.bytes += sizes.ends;
            }
        }
        tokens.push(token);
        let mark = |kind: u32| Token {
            shape: [kind, 0, 0, 0],
            sure: true,
            ..Token::default()
        };
        let parts: Vec<(BlockId, bool)> = match *step {
            Step::If {
                arms: [yes, no], ..
            } => vec![(yes, false), (no, false)],
            Step::Loop {
                parts: [start, body, next, done, otherwise],
                ..
            } => vec![
                (start, true),
                (body, true),
                (next, false),
                (done, false),
                (otherwise, false),
            ],
            _ => return,
        };
        for (k, (part, sure)) in parts.into_iter().enumerate() {
            self.describe_block(graph, bytes, sizes, part);
            for token in self.tokens[part].iter().flatten() {
                tokens.push(Token {
                    sure: token.sure && sure,
                    ..token.clone()
                });
            }
            tokens.push(mark(100 + k as u32));
            if let (Step::Loop { again, .. }, 1) = (step, k) {
                tokens.push(Token {
                    uses: vec![*again],
                    ..mark(110)
                });
            }
        }
    }
}

/// Whether a run of columns may end at a comparison, where it stands in such a run.
fn compares_column(graph: &Graph, id: NodeId) -> bool {
    let column = |id: &NodeId| graph.node(*id) == Node::Axis(Axis::X);
    match graph.node(id) {
        Node::Apply(Op::IntLess | Op::IntLessEqual, args) => args.iter().any(column),
        _ => false,
    }
}
