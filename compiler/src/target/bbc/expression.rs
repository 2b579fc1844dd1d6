//! Values as text.

use super::names::Names;
use crate::flow::graph::*;
use crate::plan::Plan;
use slowlight_routine::{Form, Op, Value};
use slowlight_runtime_bbc::level::{OPERAND, SUM};
use slowlight_runtime_bbc::literal;
use std::collections::HashMap;

/// An expression and how tightly it binds.
#[derive(Clone, Debug)]
pub struct Text {
    pub text: String,
    pub level: u8,
}

impl Text {
    fn operand(text: impl Into<String>) -> Text {
        Text {
            text: text.into(),
            level: OPERAND,
        }
    }

    /// In brackets, if it binds less tightly than needed.
    fn at(&self, level: u8) -> String {
        if self.level < level {
            format!("({})", self.text)
        } else {
            self.text.clone()
        }
    }
}

/// Longer expressions are given a variable: lines stay short, and BASIC II's stack shallow.
const LONGEST: usize = 100;

/// Writes the values of a plan.
pub struct Expressions<'p> {
    pub plan: &'p Plan,
    pub names: Names,
    /// Values that are written where they are read.
    inline: HashMap<NodeId, Text>,
    /// Whether a table's index needs clamping.
    pub clamps: bool,
    /// The variable of what earlier pixels sent to this one.
    pub received: String,
}

impl<'p> Expressions<'p> {
    pub fn new(plan: &'p Plan) -> Expressions<'p> {
        Expressions {
            plan,
            names: Names::new(plan),
            inline: HashMap::new(),
            clamps: false,
            received: String::new(),
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
            (Node::Param(p), _) => Text::operand(self.names.param(p.0 as usize)),
            (Node::Axis(Axis::X), _) => Text::operand("X%"),
            (Node::Axis(Axis::Y), _) => Text::operand("Y%"),
            (Node::Received, _) => Text::operand(&self.received),
            (_, Some(place)) => Text::operand(self.names.home(place)),
            _ => Text::operand("0"),
        }
    }

    fn constant(&mut self, value: Value) -> Text {
        let text = match value {
            Value::Bool(true) => return Text::operand("TRUE"),
            Value::Bool(false) => return Text::operand("FALSE"),
            // The least int has no literal of its own.
            Value::Int(i32::MIN) => "-2147483647-1".to_owned(),
            Value::Int(n) => n.to_string(),
            Value::Real(x) => {
                let text = literal(x);
                let size = text.trim_start_matches('-');
                if size.len() > 3 || size.contains('.') || size.contains('E') {
                    return Text::operand(self.names.constant(&text));
                }
                text
            }
        };
        let level = if text.starts_with('-') { SUM } else { OPERAND };
        Text { text, level }
    }

    /// The expression that computes a node.
    pub fn compute(&mut self, id: NodeId) -> Text {
        match self.plan.graph.node(id) {
            Node::Apply(op, args) => self.apply(id, op, args),
            Node::Lookup { table, column, row } => self.lookup(table, column, row),
            _ => self.read(id),
        }
    }

    fn apply(&mut self, id: NodeId, op: Op, args: [NodeId; 2]) -> Text {
        let Some(routine) = self.plan.routine(id) else {
            return Text::operand("0");
        };
        let Form::Expression {
            template,
            level,
            operands,
        } = routine.form
        else {
            return Text::operand("0");
        };
        if template == "{0}" {
            return self.read(args[0]);
        }
        let mut text = template.to_owned();
        for (k, arg) in args.into_iter().take(op.arity()).enumerate() {
            let need = operands.get(k).copied().unwrap_or(OPERAND);
            let hole = format!("{{{k}}}");
            if text.contains(&hole) {
                let operand = self.read(arg).at(need);
                text = text.replace(&hole, &operand);
            }
        }
        Text { text, level }
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

    fn lookup(&mut self, table: TableId, column: NodeId, row: NodeId) -> Text {
        let Some(t) = self.plan.graph.tables.get(table.0 as usize) else {
            return Text::operand("0");
        };
        let name = self.names.tables[table.0 as usize].clone();
        let (width, height) = (t.width, t.height);
        let mut indices = Vec::new();
        if width > 1 || height == 1 {
            indices.push(self.index(column, width));
        }
        if height > 1 {
            indices.push(self.index(row, height));
        }
        Text::operand(format!("{name}({})", indices.join(",")))
    }

    /// An index, clamped unless its range proves it inside.
    fn index(&mut self, id: NodeId, length: u32) -> String {
        let text = self.read(id).text;
        let last = f64::from(length - 1);
        let range = self.plan.ranges.result.get(id.0 as usize);
        if range.is_some_and(|r| r.within(0.0, last)) {
            return text;
        }
        self.clamps = true;
        format!("FNindex({text},{last})")
    }

    /// Whether a node that was just computed is to be written where it is read.
    pub fn fold(&mut self, id: NodeId, text: &Text) -> bool {
        let fold = self.plan.folded(id) && text.text.len() <= LONGEST;
        if fold {
            self.inline.insert(id, text.clone());
        }
        fold
    }

    /// A condition, or its opposite.
    pub fn condition(&mut self, id: NodeId, holds: bool) -> String {
        let text = self.read(id);
        if holds {
            return text.text;
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
            return format!("{left}{sign}{right}");
        }
        match text.text.strip_prefix("NOT ") {
            Some(inner) if self.inline.contains_key(&id) => inner.to_owned(),
            _ => format!("NOT {}", text.at(OPERAND)),
        }
    }
}
