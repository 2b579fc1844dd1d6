//! Which statements are carried out once, once a row, and first at each pixel.

use crate::flow::graph::*;
use crate::flow::tree::*;
use std::collections::HashSet;

/// The first statement that is carried out at each pixel.
pub(super) fn first_of_pixels(tree: &Tree) -> Option<*const Statement> {
    let blocks = [&tree.column, &tree.pass, &tree.segment, &tree.pixel];
    blocks.into_iter().flatten().next().map(std::ptr::from_ref)
}

/// What is computed once, and what once a row.
pub(super) struct Early {
    pub frame: HashSet<NodeId>,
    pub row: HashSet<NodeId>,
}

pub(super) fn early(tree: &Tree) -> Early {
    let of = |block: &Block| {
        let mut all = HashSet::new();
        walk(block, &mut |statement| {
            if let Statement::Let(id) = statement {
                all.insert(*id);
            }
        });
        all
    };
    Early {
        frame: of(&tree.frame),
        row: of(&tree.row),
    }
}
