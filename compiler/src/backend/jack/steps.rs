//! Between two pictures: the keys, and the states' next values.

use super::code::Code;
use super::expression::Expression;
use super::frame::declared_names;
use super::{Line, Subroutine, Text, line, subroutine};
use crate::ir::graph::*;
use crate::plan::Plan;
use slowlight_routine::{Format, Type};

/// The key of a button: the arrows, and space.
fn key(button: Button) -> u8 {
    match button {
        Button::Left => 130,
        Button::Up => 131,
        Button::Right => 132,
        Button::Down => 133,
        Button::Fire => 32,
    }
}

/// The methods of a picture that moves; none of one that does not.
pub(super) fn moves(code: &mut Code) -> Vec<Subroutine> {
    let plan = code.plan;
    if !plan.graph.is_moving() {
        return Vec::new();
    }
    let step = step(code);
    let mut show = code.make_columns_once();
    if code.object.values().next().is_some() {
        show.push(line("do takeParameters();"));
    }
    let mut text = Text::default();
    text.open("while (true) {");
    for call in ["drawPicture", "readKeys", "takeStep"] {
        text.line(format!("do {call}();"));
    }
    text.close("}");
    show.append(&mut text.lines);
    vec![
        subroutine("Picture after picture.", "method void showPictures()", show),
        subroutine(
            "What is held now: the arrow keys and space.",
            "method void readKeys()",
            keys(code),
        ),
        subroutine(
            "The states in the next picture, all of them as they are in this one.",
            "method void takeStep()",
            step,
        ),
    ]
}

/// Looks once, whatever is asked for: who runs the program sees that a picture is drawn.
fn keys(code: &Code) -> Vec<Line> {
    let mut text = Text::default();
    text.line("var int key;");
    text.line("let key = Keyboard.keyPressed();");
    for (id, button) in code.plan.graph.buttons() {
        let Some(name) = code.names.params.get(id.0 as usize) else {
            continue;
        };
        let key = key(button);
        text.line(format!("let {name} = 0; // {}", button.name()));
        text.line(format!("if (key = {key}) {{ let {name} = 1; }}"));
    }
    text.lines
}

/// Computes next values, and gives them to the states.
fn step(code: &mut Code) -> Vec<Line> {
    let plan = code.plan;
    let mut lines = code.body(&plan.tree.step);
    let mut late = Vec::new();
    for (state, next) in plan.graph.steps() {
        // A state that another is given is kept before it changes.
        let (now, then) = match plan.graph.node(next) {
            Node::Param(other) if other == state => continue,
            Node::Param(_) => code.kept(state, next),
            _ => (Vec::new(), code.given(state, next)),
        };
        lines.extend(now);
        late.extend(then);
    }
    lines.extend(late);
    lines
}

impl Code<'_> {
    /// A variable for the object that two others change places by.
    pub fn spare(&mut self) -> String {
        let name = match &self.spare {
            Some(name) => return name.clone(),
            None => self.names.fresh("spare"),
        };
        self.known.insert(name.clone());
        self.written.push((name.clone(), self.plan.runtime.real));
        self.spare = Some(name.clone());
        name
    }

    /// The lines that give a state its next value.
    fn given(&mut self, state: ParamId, next: NodeId) -> Vec<Line> {
        let plan = self.plan;
        let Some(label) = self.names.params.get(state.0 as usize).cloned() else {
            return Vec::new();
        };
        match plan.graph.ty(next) {
            Type::Real => {}
            Type::Int => {
                let value = self.read(next).text;
                return vec![line(&format!("let {label} = {value};"))];
            }
            Type::Bool => {
                let value = self.read(next).text;
                return vec![
                    line(&format!("let {label} = 0;")),
                    line(&format!("if ({value}) {{ let {label} = 1; }}")),
                ];
            }
        }
        let home = self.object.param(plan, &mut self.names, state).text;
        self.copied_real(&home, plan.param_format(state), next)
    }

    /// A real copied to a variable of some format.
    fn copied_real(&mut self, home: &str, format: Format, from: NodeId) -> Vec<Line> {
        if let (Some(points), Format::Fixed { frac, .. }) = (self.points(), format) {
            let value = self.read_at(points, from, frac).text;
            return vec![line(&format!("let {home} = {value};"))];
        }
        let value = self.read(from).text;
        if self.logs() {
            let sign = self.sign(from).text;
            let own = self.sign_of(home);
            return vec![
                line(&format!("let {home} = {value};")),
                line(&format!("let {own} = {sign};")),
            ];
        }
        self.needs.insert("Float.copy");
        vec![line(&format!("do {home}.copy({value});"))]
    }

    /// The same by way of a variable: the lines that fill it, and those that give the state
    /// what is in it.
    fn kept(&mut self, state: ParamId, from: NodeId) -> (Vec<Line>, Vec<Line>) {
        let plan = self.plan;
        let label = self.names.params.get(state.0 as usize);
        let Some(label) = label.cloned() else {
            return Default::default();
        };
        let name = self.names.fresh(&format!("{label}_next"));
        let format = plan.param_format(state);
        self.written.push((name.clone(), format));
        self.known.insert(name.clone());
        match plan.graph.ty(from) {
            Type::Real => {
                let now = self.copied_real(&name, format, from);
                let home = self.object.param(plan, &mut self.names, state).text;
                let mut then = Vec::new();
                if self.logs() {
                    let (own, sign) = (self.sign_of(&home), self.sign_of(&name));
                    then.push(line(&format!("let {own} = {sign};")));
                }
                then.push(line(&match format.is_object() {
                    true => format!("do {home}.copy({name});"),
                    false => format!("let {home} = {name};"),
                }));
                (now, then)
            }
            ty => {
                let Expression { text, .. } = self.read(from);
                let now = vec![line(&format!("let {name} = {text};"))];
                let then = match ty {
                    Type::Bool => vec![
                        line(&format!("let {label} = 0;")),
                        line(&format!("if ({name}) {{ let {label} = 1; }}")),
                    ],
                    _ => vec![line(&format!("let {label} = {name};"))],
                };
                (now, then)
            }
        }
    }
}

/// Where a state is in the scene's object: which of its words, and of a logarithm which says
/// whether it is above 0; none where it is known to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Held {
    /// Which state.
    pub state: ParamId,
    /// The word, from 0.
    pub word: usize,
    /// The word of the sign.
    pub sign: Option<usize>,
}

/// Where the program has its states, in their order. What nothing reads is nowhere.
pub fn held(plan: &Plan) -> Vec<Held> {
    let (code, fields, read) = declared_names(plan);
    let at = |name: &str| fields.iter().position(|field| field == name);
    let mut found = Vec::new();
    for (state, next) in plan.graph.steps() {
        let label = code.names.params.get(state.0 as usize);
        let name = match plan.graph.ty(next) {
            Type::Real => {
                let mut values = code.object.values();
                values
                    .find(|(p, _)| *p == state.0)
                    .map(|(_, name)| name.to_owned())
            }
            _ => label.cloned(),
        };
        let Some(name) = name else { continue };
        if let Some(word) = at(&name) {
            let sign = format!("{name}_plus");
            let sign = at(&sign).filter(|_| code.logs() && read(&sign));
            found.push(Held { state, word, sign });
        }
    }
    found
}
