//! Values as text.

use super::Style;
use super::names::Names;
use super::pieces::{depth, short_length};
use super::text::{Fast, Text};
use super::text::{filled, turned};
use crate::ir::graph::*;
use crate::plan::Plan;
use rustc_hash::FxHashMap;
use slowlight_routine::{Form, Op, Range, Type, Value};
use slowlight_runtime_bbc::level::{OPERAND, PRODUCT, SUM};
use slowlight_runtime_bbc::literal;

/// Longer expressions are given a variable, so that lines stay short.
const LONGEST: usize = 100;
/// The same where lines are to be few.
const LONGEST_SHORT: usize = 150;
/// BASIC II's evaluator takes its room from the processor's stack of 256 bytes.
const DEEPEST: usize = 6;

/// A comparison of reals with the number that is the first of them written last:
/// BASIC II keeps a real that it has read first for longer than a number.
fn number_last(form: Form, op: Op, operands: &[Text]) -> Form {
    let is_number = |text: &Text| text.text.bytes().all(|b| b.is_ascii_digit());
    let turned = match op {
        Op::Less => "{1}>{0}",
        Op::LessEqual => "{1}>={0}",
        _ => return form,
    };
    match form {
        Form::Expression {
            template: "{0}<{1}" | "{0}<={1}",
            operands: needs,
            level,
        } if operands.first().is_some_and(is_number) => Form::Expression {
            template: turned,
            operands: needs,
            level,
        },
        _ => form,
    }
}

/// Writes the values of a plan.
pub struct Expressions<'p> {
    pub plan: &'p Plan,
    pub style: Style,
    pub names: Names,
    /// Values that are written where they are read.
    inline: FxHashMap<NodeId, Text>,
    /// Whether a table's index needs clamping.
    pub clamps: bool,
    /// The variable of what earlier pixels sent to this one.
    pub received: String,
    /// The variables of what neighbours left.
    pub neighbours: [String; 3],
    /// Values that must be assigned before what was computed last, since it reads them twice.
    pub before: Vec<(String, Text)>,
    /// Between which bounds arguments stay in the version being written, where
    /// that is better than what the ranges know.
    pub assumed: FxHashMap<NodeId, [Range; 2]>,
    /// Whether to call functions rather than to test.
    pub calls: bool,
}

impl<'p> Expressions<'p> {
    pub fn new(plan: &'p Plan) -> Expressions<'p> {
        Expressions {
            plan,
            style: Style::of(plan),
            names: Names::new(plan),
            inline: FxHashMap::default(),
            clamps: false,
            received: String::new(),
            neighbours: Default::default(),
            before: Vec::new(),
            assumed: FxHashMap::default(),
            calls: false,
        }
    }

    /// The value of a node that was computed before, or needs no computing.
    pub fn read(&mut self, id: NodeId) -> Text {
        if let Some(text) = self.inline.get(&id) {
            return text.clone();
        }
        let plan = self.plan;
        match (plan.graph.node(id), plan.place(id)) {
            (Node::Const(c), _) => self.constant(c.value()),
            (Node::Param(p), _) => match self.style {
                // What is held is read behind the picture alone.
                Style::Fast | Style::Lean if !plan.is_held(p) => {
                    Text::operand(self.names.copy(p.0 as usize))
                }
                _ => Text::operand(self.names.param(p.0 as usize)),
            },
            (Node::Axis(Axis::X | Axis::Run), _) => Text::operand("X%"),
            (Node::Axis(Axis::Y), _) => Text::operand("Y%"),
            (Node::Axis(Axis::Pass(_)), _) => Text::operand(&self.names.pass),
            (Node::Received, _) => Text::operand(&self.received),
            (Node::Neighbour(which), _) => Text::operand(&self.neighbours[which as usize]),
            (_, Some(place)) => Text::operand(self.names.home(place)),
            _ => Text::operand("0"),
        }
    }

    pub fn constant(&mut self, value: Value) -> Text {
        let listing = self.style == Style::Listing;
        let text = match value {
            Value::Bool(true) => return Text::operand("TRUE"),
            Value::Bool(false) => return Text::operand("FALSE"),
            // The least int has no literal of its own.
            Value::Int(i32::MIN) => "-2147483647-1".to_owned(),
            Value::Int(n) => n.to_string(),
            Value::Real(x) if self.style == Style::Toot => literal(x),
            Value::Real(x) => {
                let text = literal(x);
                let size = text.trim_start_matches('-');
                // A digit and its turn into a real take about as long as a variable, but for 1,
                // which is met everywhere: a sum or quotient with it 300 cycles more.
                let most = if listing { 3 } else { 1 };
                let long = size.len() > most || !listing && x < 0.0;
                let long = long || x == 1.0 && self.style == Style::Fast;
                if long || size.contains('.') || size.contains('E') {
                    return Text::operand(self.names.constant(&text));
                }
                text
            }
        };
        let level = match value {
            Value::Int(i32::MIN) => SUM,
            _ if text.starts_with('-') => PRODUCT,
            _ => OPERAND,
        };
        Text::new(text, level)
    }

    /// The expression that computes a node.
    pub fn compute(&mut self, id: NodeId) -> Text {
        match self.plan.graph.node(id) {
            Node::Apply(op, args) => self.apply(id, op, args),
            Node::Lookup { table, column, row } => self.lookup(id, table, [column, row]),
            Node::Tabulated(_) => Text::operand(format!("{}(X%)", self.names.column(id))),
            // As a row begins it; see [`super::ramp`].
            Node::Ramp { first, .. } => self.read(first),
            _ => self.read(id),
        }
    }

    fn apply(&mut self, id: NodeId, op: Op, args: [NodeId; 2]) -> Text {
        let Some(routine) = self.plan.routine(id) else {
            return Text::operand("0");
        };
        let Form::Expression { template, .. } = routine.form else {
            return Text::operand("0");
        };
        if template == "{0}" {
            return self.read(args[0]);
        }
        let args = &args[..op.arity()];
        let guard = self.few_tests(id, routine.name, args);
        let operands: Vec<Text> = args.iter().map(|arg| self.read(*arg)).collect();
        let form = number_last(routine.form, op, &operands);
        if self.style == Style::Toot
            && let Some(text) = turned(form, &operands)
        {
            return text;
        }
        let text = filled(form, &operands, false);
        let short = match &guard {
            Some(guard) => guard.form,
            None => form,
        };
        let tests = guard.iter().flat_map(|g| g.tests.iter());
        let below = guard.as_ref().and_then(|g| g.below);
        let fast = self.fast(&operands, tests, filled(short, &operands, true), below);
        match fast {
            // All is proved.
            Some(fast) if guard.is_some() && fast.tests.is_empty() => {
                Text::new(fast.text, fast.level)
            }
            fast if guard.is_some() || operands.iter().any(|o| o.fast.is_some()) => Text {
                fast: fast.map(|fast| {
                    // That the tests fail is known to be its own affair only where all are its own.
                    let own = operands.iter().all(|o| o.fast.is_none());
                    let otherwise = guard.as_ref().filter(|_| own).and_then(|g| g.otherwise);
                    Box::new(Fast { otherwise, ..fast })
                }),
                ..text
            },
            _ => text,
        }
    }

    /// What a place has received so far and what a pixel sends to it, added.
    pub fn gather(&mut self, so_far: &str, sent: NodeId) -> String {
        let sent = self.read(sent);
        match self.plan.gather().map(|routine| routine.form) {
            Some(Form::Expression {
                template, operands, ..
            }) => {
                let need = operands.get(1).copied().unwrap_or(OPERAND);
                let text = template.replace("{0}", so_far);
                text.replace("{1}", &sent.at(need))
            }
            _ => so_far.to_owned(),
        }
    }

    fn lookup(&mut self, id: NodeId, table: TableId, [column, row]: [NodeId; 2]) -> Text {
        let inside = self.plan.ranges.args[id.0 as usize];
        let Some(t) = self.plan.graph.tables.get(table.0 as usize) else {
            return Text::operand("0");
        };
        if let Some(text) = self.in_string(table, [column, row], inside) {
            return text;
        }
        let name = self.names.tables[table.0 as usize].clone();
        let (width, height) = (t.width, t.height);
        let mut indices = Vec::new();
        if width > 1 || height == 1 {
            indices.push(self.index(column, inside[0], width));
        }
        if height > 1 {
            indices.push(self.index(row, inside[1], height));
        }
        let list = |fast: bool| {
            let all: Vec<String> = indices
                .iter()
                .map(|i| if fast { i.fast_at(0) } else { i.text.clone() })
                .collect();
            Text::operand(format!("{name}({})", all.join(",")))
        };
        let fast = self.fast(&indices, [].iter(), list(true), None);
        Text {
            fast: fast.filter(|f| !f.tests.is_empty()).map(Box::new),
            ..list(false)
        }
    }

    /// An index, clamped unless its range proves it inside.
    pub(super) fn index(&mut self, id: NodeId, range: Range, length: u32) -> Text {
        let text = self.read(id);
        let last = f64::from(length - 1);
        if range.within(0.0, last) {
            return text;
        }
        self.clamps = true;
        let clamped = |text: &str| Text::operand(format!("FNindex({text},{last})"));
        if self.style != Style::Fast || self.calls || !self.simple(id) {
            return clamped(&text.text);
        }
        let text = self.read(id);
        let mut tests = Vec::new();
        if range.lo < 0.0 {
            tests.push(format!("{}>=0", text.text));
        }
        if range.hi > last {
            tests.push(format!("{}<={last}", text.text));
        }
        Text {
            fast: Some(Box::new(Fast {
                text: text.text.clone(),
                level: text.level,
                tests,
                below: Some(last + 1.0),
                otherwise: None,
            })),
            ..clamped(&text.text)
        }
    }

    /// How long a text will be in the program.
    pub fn length(&self, text: &str) -> usize {
        match self.style {
            Style::Listing => text.len(),
            _ => short_length(text),
        }
    }

    /// Whether a node that was just computed is to be written where it is read.
    pub fn fold(&mut self, id: NodeId, text: &Text) -> bool {
        let most = match self.style {
            Style::Listing => LONGEST,
            _ => LONGEST_SHORT,
        };
        let fold = self.plan.folded(id)
            && self.length(&text.text) <= most
            && depth(&text.text) <= DEEPEST
            // A condition is read as it stands.
            && (text.fast.is_none() || self.plan.graph.ty(id) != Type::Bool);
        if fold {
            self.inline.insert(id, text.clone());
        }
        fold
    }

    /// What is written where it is read, at this point.
    pub fn folds(&self) -> FxHashMap<NodeId, Text> {
        self.inline.clone()
    }

    /// Goes back to that point.
    pub fn set_folds(&mut self, folds: FxHashMap<NodeId, Text>) {
        self.inline = folds;
    }

    /// Takes back that a value is written where it is read; whether it was.
    pub fn unfold(&mut self, id: NodeId) -> bool {
        self.inline.remove(&id).is_some()
    }

    /// A condition, or its opposite.
    pub fn condition(&mut self, id: NodeId, holds: bool) -> String {
        let text = self.read(id);
        if holds {
            return self.truth(id).unwrap_or(text.text);
        }
        let opposite = [("<=", ">"), ("<", ">="), ("=", "<>")];
        if self.inline.contains_key(&id)
            && let Node::Apply(op, args) = self.plan.graph.node(id)
            && let Some(routine) = self.plan.routine(id)
            && let Form::Expression {
                template, operands, ..
            } = routine.form
            && op.arity() == 2
            && let Some((_, sign)) = opposite
                .iter()
                .find(|(from, _)| template == format!("{{0}}{from}{{1}}"))
        {
            let side = |e: &mut Self, k: usize| {
                let need = operands.get(k).copied().unwrap_or(OPERAND);
                e.read(args[k]).at(need)
            };
            let left = side(self, 0);
            let right = side(self, 1);
            return match number_last(routine.form, op, &[Text::operand(left.as_str())]) {
                Form::Expression { template, .. } if template.starts_with("{1}") => {
                    format!("{right}{}{left}", sign.replace('>', "<"))
                }
                _ => format!("{left}{sign}{right}"),
            };
        }
        match text.text.strip_prefix("NOT ") {
            Some(inner) if self.inline.contains_key(&id) => inner.to_owned(),
            _ => format!("NOT {}", text.at(OPERAND)),
        }
    }

    /// An int that is 0 or 1, where a condition asks whether it is 1.
    fn truth(&mut self, id: NodeId) -> Option<String> {
        let plan = self.plan;
        let Node::Apply(Op::IntLess, [zero, of]) = plan.graph.node(id) else {
            return None;
        };
        let known = plan.ranges.result.get(of.0 as usize)?.within(0.0, 1.0);
        let asks = known && plan.graph.constant(zero) == Some(Value::Int(0));
        (asks && self.inline.contains_key(&id)).then(|| self.read(of).text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_compared_last() {
        const LESS: Form = Form::Expression {
            template: "{0}<{1}",
            level: SUM,
            operands: &[SUM, SUM],
        };
        let turned = |first: &str, op| {
            let operands = [Text::operand(first), Text::operand("a")];
            filled(number_last(LESS, op, &operands), &operands, false).text
        };
        assert_eq!(turned("0", Op::Less), "a>0");
        assert_eq!(turned("b", Op::Less), "b<a");
        // Ints are as quick either way.
        assert_eq!(turned("0", Op::IntLess), "0<a");
    }
}
