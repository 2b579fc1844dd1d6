//! Between two pictures: the keys, and the states' next values.

use super::code::Code;
use super::names::Names;
use super::pieces::{Piece, pieces};
use super::text::Text;
use crate::ir::graph::*;
use crate::plan::Plan;
use crate::targets::System;
use slowlight_routine::Type;

/// A button's key, as INKEY of the negative number knows it: the arrows, and space.
pub fn key(button: Button) -> u8 {
    match button {
        Button::Left => 26,
        Button::Right => 122,
        Button::Up => 58,
        Button::Down => 42,
        Button::Fire => 99,
    }
}

/// What stands behind a picture that moves; the screen is cleared where the next picture leaves
/// out what is ink 0.
pub fn between(plan: &Plan, code: &mut Code<'_>, clears: bool) {
    code.frame = None;
    let buttons: Vec<(ParamId, Button)> = plan.graph.buttons().collect();
    for (id, button) in &buttons {
        let name = code.values.names.param(id.0 as usize).to_owned();
        code.statement(format!("{name}=-INKEY(-{})", key(*button)));
    }
    // Keys that are held are typed as well, again and again; a Micro whose buffer is full beeps.
    if plan.target.system == System::BbcBasic && !buttons.is_empty() {
        code.line("*FX21");
    }
    // Looks once, whatever is asked for: who runs the program sees that a picture is drawn.
    if buttons.is_empty() {
        code.statement(format!("I%=INKEY(-{})", key(Button::Fire)));
    }
    code.block(&plan.tree.step);
    let names: Vec<String> = (plan.graph.steps())
        .map(|(state, _)| code.values.names.param(state.0 as usize).to_owned())
        .collect();
    let mut then = Vec::new();
    for (at, (state, next)) in plan.graph.steps().enumerate() {
        let text = code.values.read(next);
        code.assign_before();
        // Of a state that has its next value by then, it is the one before that is meant.
        let (changed, own) = names.split_at(at);
        let Some(home) = own.first().cloned() else {
            continue;
        };
        let text = match mentions(&text, changed) {
            true => {
                let kept = kept(plan, &mut code.values.names, state);
                code.assign(&kept, &text);
                Text::operand(kept)
            }
            false => text,
        };
        then.push((home, text));
    }
    for (home, text) in then {
        code.assign(&home, &text);
    }
    let copies: Vec<String> = (plan.graph.steps())
        .filter_map(|(state, _)| code.values.names.copied(state.0 as usize))
        .collect();
    for copied in copies {
        code.statement(copied);
    }
    if clears {
        code.statement("CLG");
    }
}

/// A variable for a state's next value.
fn kept(plan: &Plan, names: &mut Names, state: ParamId) -> String {
    let param = plan.graph.params.get(state.0 as usize);
    let suffix = match param.map(|param| param.ty) {
        Some(Type::Real) => "",
        _ => "%",
    };
    names.unique("next", suffix)
}

/// Whether an expression reads one of some variables.
fn mentions(text: &Text, names: &[String]) -> bool {
    let fast = text.fast.iter();
    let parts = fast.flat_map(|fast| fast.tests.iter().map(String::as_str).chain([&*fast.text]));
    let mut parts = parts.chain([&*text.text]);
    parts.any(|part| {
        let mut pieces = pieces(part).into_iter();
        pieces.any(|piece| matches!(piece, Piece::Name(name) if names.iter().any(|n| n == name)))
    })
}

/// Where a program has a state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Held {
    /// Which state.
    pub state: ParamId,
    /// The variable's name.
    pub name: String,
}

/// Where the program has its states, in their order.
pub fn held(plan: &Plan) -> Vec<Held> {
    let names = Names::new(plan);
    let of = |state: ParamId| Held {
        state,
        name: names.param(state.0 as usize).to_owned(),
    };
    plan.graph.steps().map(|(state, _)| of(state)).collect()
}
