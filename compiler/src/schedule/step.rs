//! Sinking of the states' next values behind the picture, which does not need them: what a
//! player holds is looked at when the picture is drawn.
//!
//! ```text
//! frame: let %8 = sin %1; let %9 = iadd %3 %4     frame: let %8 = sin %1
//! pixel: ...                                 =>   pixel: ...
//!                                                 step:  let %9 = iadd %3 %4
//! ```

use crate::ir::graph::*;
use crate::ir::tree::*;

/// Moves statements that no pixel needs to the tree's last block, in a graph that moves; there
/// are no subroutines in it ([`crate::planner`]'s outlining leaves it).
pub fn sink(graph: &Graph, tree: &mut Tree) {
    if !graph.is_moving() {
        return;
    }
    let mut drawn = graph.clone();
    drawn.reports.clear();
    let needed = drawn.reached();
    let mut step = Block::new();
    for block in tree.blocks_mut() {
        let (kept, sunk) = parted(graph, &needed, std::mem::take(block));
        *block = kept;
        step.extend(sunk);
    }
    tree.step = step;
}

/// What pixels need of a block, and the rest.
fn parted(graph: &Graph, needed: &[bool], block: Block) -> (Block, Block) {
    let is_needed = |id: NodeId| needed.get(id.0 as usize) == Some(&true);
    let (mut kept, mut sunk) = (Block::new(), Block::new());
    for statement in block {
        let stays = match &statement {
            Statement::Let(id)
            | Statement::Set {
                place: Place::Node(id),
                ..
            } => is_needed(*id),
            Statement::Set { .. } | Statement::Call(_) => true,
            Statement::Loop(turns) => graph.ids().any(|id| {
                is_needed(id) && matches!(graph.node(id), Node::Result { of, .. } if of == turns.of)
            }),
            Statement::If { .. } => false,
        };
        match statement {
            Statement::If { cond, yes, no } => {
                let [(yes, later_yes), (no, later_no)] =
                    [yes, no].map(|arm| parted(graph, needed, arm));
                let arms = [(yes, no, &mut kept), (later_yes, later_no, &mut sunk)];
                for (yes, no, block) in arms {
                    if !yes.is_empty() || !no.is_empty() {
                        block.push(Statement::If { cond, yes, no });
                    }
                }
            }
            statement if stays => kept.push(statement),
            statement => sunk.push(statement),
        }
    }
    (kept, sunk)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::check;
    use crate::schedule::statements::{missing, schedule};
    use crate::sema::Options;

    #[test]
    fn what_hangs_on_hands_stands_behind_the_picture() {
        let text = "image 8 x 4 inks black, white;
            state at: real = 2 in 0 .. 8 -> if input.fire > 0 then loop (a = at) max 3 {
                if a > 7 then 0 else next(a + sqrt(at)) } else at / 2 else at + input.x * sqrt(at);
            state up: int = 1 in 0 .. 3 -> up + input.y;
            draw (x, y) = ink(if x > sqrt(at) and y > up then 1 else 0);";
        let scene = check("test", text);
        assert!(scene.is_right(), "{:?}", scene.diagnostics);
        let options = Options {
            moves: true,
            ..Options::default()
        };
        let graph = scene.lower(&options).expect("a graph");
        assert_eq!(graph.steps().count(), 2);
        assert_eq!(graph.buttons().count(), 5);
        let mut tree = schedule(&graph);
        assert!(tree.step.is_empty());
        sink(&graph, &mut tree);
        assert!(!tree.step.is_empty());
        assert_eq!(missing(&graph, &tree), None);
        let hands: Vec<NodeId> = (graph.ids())
            .filter(|id| {
                let Node::Param(p) = graph.node(*id) else {
                    return false;
                };
                graph.buttons().any(|(button, _)| button == p)
            })
            .collect();
        let mut on_hands = vec![false; graph.nodes.len()];
        for id in graph.ids() {
            let through = graph.refers(id).any(|of| on_hands[of.0 as usize]);
            on_hands[id.0 as usize] = hands.contains(&id) || through;
        }
        for block in tree.outer().into_iter().take(6) {
            walk(block, &mut |statement| {
                if let Statement::Let(id) = statement {
                    assert!(!on_hands[id.0 as usize], "{id}");
                }
            });
        }
    }
}
