//! Outlining: what is written down several times becomes a subroutine.
//!
//! A graph has every function and shape where it is used, and so have the
//! statements: fifty spheres are fifty times the same statements over other
//! values. That is what makes programs quick, where the machine can hold them.
//! This pass is for where it cannot.
//!
//! A *run* is some statements of a block, one after another. Two runs have one
//! shape if their operations, types and nested statements agree, and each reads
//! at the same places what it computed itself. What it reads from outside may
//! differ: what all runs read alike the subroutine reads too, the rest it is
//! given in homes of its own ([`Node::Slot`]), which each call sets. What a run
//! computes for others is copied out behind the call, to where it was before,
//! so nothing else changes.
//!
//! Of all shapes the one that saves most is taken first, then what is left of
//! the others; then all is looked at again, calls and subroutines included, so
//! that subroutines come to call others.
//!
//! **Invariant**: a call sets and copies only what is computed on every way to
//! it. What a run reads on some ways only must have been computed before it on
//! all, or there is no call: a home that was not written is never read.
//!
//! - `forest`: the statements with every block in one arena; `known`: what is known
//!   of their places; `token`: what statements have to agree in; `runs`: which
//!   runs have one shape; `make`: subroutines and calls.

mod describe;
mod forest;
mod known;
mod make;
mod runs;
mod step;
#[cfg(test)]
mod tests;
mod token;

use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::source::Span;
use crate::targets::Sizes;

/// What of a picture may become subroutines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// All of it.
    All,
    /// What is carried out seldom: once a picture, row or pass.
    Rows,
    /// That, and what is carried out once a run of columns.
    Runs,
}

/// How often all is looked at: each time subroutines may come to call others.
const ROUNDS: u32 = 6;

/// The graph and its statements with subroutines for what they have several
/// times, within an extent, until so many bytes are saved as `enough` says. `bytes` are those of
/// each node's routine; `name` says what the source calls what stands at a place. What does not get
/// smaller stays as it is.
pub fn outline(
    graph: &Graph,
    tree: Tree,
    bytes: &[u32],
    sizes: &Sizes,
    (extent, enough): (Extent, u64),
    name: &dyn Fn(Span) -> Option<String>,
) -> (Graph, Tree) {
    let (mut graph, mut tree) = (graph.clone(), tree);
    let mut bytes = bytes.to_vec();
    bytes.resize(graph.nodes.len(), 0);
    let mut sizes = *sizes;
    if extent != Extent::Runs {
        sizes.ends = 0;
    }
    let mut left = enough;
    for _ in 0..ROUNDS {
        let mut forest = forest::Forest::new(&graph, tree, &bytes, &sizes, extent);
        let mut maker = make::Maker {
            graph: &mut graph,
            bytes: &mut bytes,
            sizes: &sizes,
            name,
        };
        let made = make::replace(&mut forest, &mut maker, &mut left);
        tree = forest.into_tree();
        if made == 0 {
            break;
        }
    }
    (graph, tree)
}
