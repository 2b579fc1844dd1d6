//! For tests of what passes make of [`Graph::claims`].

use crate::analysis::rate::{Dependence, rates};
use crate::eval::arithmetic::Exact;
use crate::eval::drawn::grid;
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::schedule::statements::schedule;
use slowlight_routine::Value;

/// The graph, everything that is made of two values claimed to be what it is.
pub fn claiming(graph: &Graph) -> Graph {
    let made = graph.ids().filter_map(|id| match graph.node(id) {
        Node::Apply(op, args) if op.arity() == 2 => Some((id, (op, args))),
        _ => None,
    });
    Graph {
        claims: made.collect(),
        ..graph.clone()
    }
}

/// Asserts that the claims hold at every pixel where all that they are about is
/// computed; answers how many were looked at. What a loop carries is left out:
/// its values after the pixel may be of different turns.
pub fn hold_claims(graph: &Graph, seed: u64) -> usize {
    let rates = rates(graph);
    let free = |id: NodeId| {
        let turn = |d: &Dependence| matches!(d, Dependence::Loop(_) | Dependence::Last(_));
        !rates.rate(id).iter().any(turn)
    };
    let tree = schedule(graph);
    let mut run = Run::new(graph, &tree, Exact(graph));
    let mut held = 0;
    for (x, y) in grid(7, 5, 1) {
        run.pixel(x, y);
        for (id, (op, args)) in &graph.claims {
            let [a, b] = *args;
            let known = |id: NodeId| match graph.node(id) {
                Node::Axis(Axis::X) => Some(Value::Int(x)),
                Node::Axis(Axis::Y) => Some(Value::Int(y)),
                // It is kept as it is in the first column.
                Node::Ramp { .. } => None,
                _ => run.last(id).filter(|_| free(id)).map(Value::from),
            };
            if let (Some(is), Some(a), Some(b)) = (known(*id), known(a), known(b)) {
                assert_eq!(is, op.eval(&[a, b]), "seed {seed}: {id} at {x}, {y}");
                held += 1;
            }
        }
    }
    held
}
