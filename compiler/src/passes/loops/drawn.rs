//! What tests of loops' passes look at: a scene's graph, its shades, and the products of a turn.
#![allow(clippy::unwrap_used)]

use crate::analysis::rate::{Dependence, rates};
use crate::eval::native::Native;
use crate::ir::graph::*;
use crate::planner::context::Context;
use crate::scene;
use crate::schedule::analysed::Analysed;
use crate::sema::Options;
use slowlight_routine::{Op, Runtime};

/// A scene of 24 by 16 pixels, as passes have it.
pub(in crate::passes) fn analysed(source: &str, runtime: &'static Runtime) -> Analysed {
    let checked = scene::check("test", source);
    assert!(checked.is_right(), "{source}: {:?}", checked.diagnostics);
    let graph = checked.lower(&Options::default()).unwrap();
    Context::new(graph.clone(), runtime).simplified(&graph)
}

/// Products of reals at each turn.
pub(in crate::passes) fn products(graph: &Graph) -> usize {
    let (reached, rates) = (graph.reached(), rates(graph));
    let counts = |id: &NodeId| {
        let mut by = rates.rate(*id).iter();
        let in_loop = by.any(|by| matches!(by, Dependence::Loop(_)));
        let is_product = matches!(graph.node(*id), Node::Apply(Op::Mul, _));
        reached[id.0 as usize] && in_loop && is_product
    };
    graph.ids().filter(counts).count()
}

/// All of its shades, natively.
pub(in crate::passes) fn shades(graph: &Graph) -> Vec<f64> {
    let mut native = Native::new(graph);
    let places = (0..16).flat_map(|y| (0..24).map(move |x| (x, y)));
    places.map(|(x, y)| native.pixel(x, y).shade).collect()
}
