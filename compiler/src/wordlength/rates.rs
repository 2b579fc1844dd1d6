//! Execution classes of statements: which are carried out once, once a row, and first at each
//! pixel.

use crate::ir::graph::*;
use crate::ir::tree::*;

/// The first statement that is carried out at each pixel.
pub(super) fn first_of_pixels(tree: &Tree) -> Option<*const Statement> {
    let blocks = [&tree.column, &tree.pass, &tree.segment, &tree.pixel];
    blocks.into_iter().flatten().next().map(std::ptr::from_ref)
}

/// How often a node's value is computed.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Often {
    Frame,
    Row,
    Pixel,
}

/// The same of each node.
pub(super) fn often(graph: &Graph, tree: &Tree) -> Vec<Often> {
    let mut all = vec![Often::Pixel; graph.nodes.len()];
    for (block, often) in [(&tree.row, Often::Row), (&tree.frame, Often::Frame)] {
        walk(block, &mut |statement| {
            if let Statement::Let(id) = statement {
                all[id.0 as usize] = often;
            }
        });
    }
    all
}
