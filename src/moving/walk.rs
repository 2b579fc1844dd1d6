//! The native run of a scene that moves: its pictures and states, in f64.

use super::few_enough;
use super::hands::Hands;
use super::sweep::Sweep;
use crate::draw::{Window, native};
use crate::failure::Outcome;
use crate::picture::Picture;
use crate::progress::Progress;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::ir::graph::{Graph, Param, ParamId};
use slowlight_routine::Type;

/// What a state's value is called: `place.x`.
pub fn label(param: &Param) -> String {
    match param.component {
        "" => param.name.clone(),
        part => format!("{}.{part}", param.name),
    }
}

/// Gives states' their values.
pub fn set(graph: &mut Graph, values: &[(ParamId, f64)]) {
    for (id, value) in values {
        if let Some(param) = graph.params.get_mut(id.0 as usize) {
            param.value = *value;
        }
    }
}

/// The states' values, by name.
pub fn states(graph: &Graph) -> Vec<(String, f64)> {
    let states = graph.steps().map(|(id, _)| id);
    let params = states.filter_map(|id| graph.params.get(id.0 as usize));
    params.map(|p| (label(p), p.value)).collect()
}

/// The states in the next picture; no pixel is drawn for them.
pub fn next(graph: &Graph) -> Vec<(ParamId, f64)> {
    let mut native = Native::new(graph);
    let values = native.reports();
    let steps = graph.steps().zip(values);
    steps
        .map(|((id, node), value)| {
            let value = match graph.ty(node) {
                Type::Real => value.real(),
                Type::Int => f64::from(value.int()),
                Type::Bool => f64::from(u8::from(value.truth())),
            };
            (id, value)
        })
        .collect()
}

/// A picture of a walk, and the states that it was drawn with.
pub struct Step {
    /// The picture.
    pub picture: Picture,
    /// The states, by name.
    pub states: Vec<(String, f64)>,
}

/// The pictures of a walk, natively.
///
/// # Errors
/// Where these are more pixels than are kept, and an interruption.
pub fn walk(
    graph: &Graph,
    window: Window,
    pictures: u32,
    hands: &Hands,
    sweeps: &[Sweep],
) -> Outcome<Vec<Step>> {
    few_enough(window, pictures)?;
    let progress = Progress::new("pictures", u64::from(pictures));
    let mut graph = graph.clone();
    let mut found = Vec::new();
    for picture in 0..pictures {
        for sweep in sweeps {
            sweep.give(picture, pictures, &mut graph);
        }
        found.push(Step {
            picture: native(&graph, window)?.picture(),
            states: states(&graph),
        });
        hands.give(picture, &mut graph);
        let values = next(&graph);
        set(&mut graph, &values);
        progress.step(1);
    }
    Ok(found)
}
