//! Logarithmic reals in statements: a variable for the logarithm, and one for the sign
//! where the ranges do not know it.

use super::Line;
use super::code::Code;
use super::expression::Expression;
use crate::ir::graph::*;
use crate::ir::tree::Place;
pub(super) use slowlight_routine::log::known_sign as known;
use slowlight_routine::log::model::Log;
use slowlight_routine::{Format, Routine, Value};
use slowlight_runtime_jack::{SUM, TERM};
use std::collections::BTreeSet;

impl Code<'_> {
    /// Whether reals are logarithms.
    pub fn logs(&self) -> bool {
        matches!(self.plan.runtime.real, Format::Log { .. })
    }

    /// The sign of a real where it is used.
    pub fn sign(&mut self, id: NodeId) -> Expression {
        if let Node::Const(c) = self.plan.graph.node(id) {
            let plus = Log::from_bits(self.plan.bits(c.value())).plus;
            return Expression::term(plus.to_string());
        }
        let range = self.plan.ranges.result.get(id.0 as usize);
        if let Some(plus) = range.and_then(|range| known(*range)) {
            return Expression::term(plus.to_string());
        }
        if let Some(other) = self.same_signs.get(&id) {
            return Expression::term(other.clone());
        }
        match self.plan.graph.node(id) {
            Node::Undefined(_) => return Expression::term("true"),
            Node::Lookup { table, .. } if !self.sign_is_looked_up(id, table) => {
                return Expression::term("true");
            }
            _ => {}
        }
        match self.plan.place(id) {
            Some(place) => {
                let home = self.names.home(place).to_owned();
                Expression::term(self.sign_of(&home))
            }
            None => {
                let name = self.read(id).text;
                Expression::term(self.sign_of(&name))
            }
        }
    }

    /// The variable for the sign of what a variable has the logarithm of.
    pub fn sign_of(&mut self, name: &str) -> String {
        let sign = self.names.sign(name);
        if self.known.insert(sign.clone()) {
            self.written.push((sign.clone(), Format::Bool));
        }
        sign
    }

    /// Sets a place to a real that is a node's, or one in a scratch home.
    pub fn set_log(&mut self, (place, home): (Place, &str), (id, from): (Option<NodeId>, &str)) {
        let sign = match id {
            Some(id) => self.sign(id).text,
            None => self.sign_of(from),
        };
        let range = match place {
            Place::Node(id) => self.plan.ranges.result.get(id.0 as usize),
            _ => None,
        };
        let known = range.is_some_and(|range| known(*range).is_some());
        self.copy_log(home, (from, &sign), known);
    }

    /// Copies a real.
    pub fn copy_log(&mut self, home: &str, (from, sign): (&str, &str), known: bool) {
        if from != home {
            self.line(format!("let {home} = {from};"));
        }
        let own = self.sign_of(home);
        if !known && own != sign {
            self.line(format!("let {own} = {sign};"));
        }
    }

    /// Writes a routine's statements: a line each, without signs that are known.
    pub fn log_statements(
        &mut self,
        id: NodeId,
        (routine, template): (&Routine, &str),
        args: [NodeId; 2],
    ) {
        let home = self.home(Place::of(&self.plan.graph, id), self.plan.format(id));
        let range = self.plan.ranges.result.get(id.0 as usize);
        let signed = range.is_none_or(|range| known(*range).is_none());
        let operands: Vec<Operand> = args
            .into_iter()
            .zip(routine.args)
            .map(|(arg, format)| self.operand(arg, *format))
            .collect();
        let template = match routine.name {
            // The table's first entry.
            "sum" | "minus_sum" | "add" if args[0] == args[1] => {
                "let {r} = {0} + 1024;\nlet {r+} = {0+};"
            }
            _ => template,
        };
        let mut said = format!(" // {home} = {}", self.meaning(id));
        for line in template.lines() {
            let sign = line.starts_with("let {r+} =");
            if sign && !signed {
                continue;
            }
            let mut text = filled(line, &operands);
            if text.contains("{r+}") {
                text = text.replace("{r+}", &self.sign_of(&home));
            }
            text = text.replace("{r}", &home);
            if sign {
                text = simplified(&text);
                let once = template.matches("let {r+} =").count() == 1;
                let other = once.then(|| self.same_sign(&text, args, &operands));
                if let Some(other) = other.flatten() {
                    self.same_signs.insert(id, other);
                    continue;
                }
            }
            let idle = text
                .strip_prefix("let ")
                .and_then(|rest| rest.strip_suffix(';')?.split_once(" = "))
                .is_some_and(|(to, from)| to == from);
            if idle {
                continue;
            }
            if !sign && text.starts_with("let ") {
                text += &std::mem::take(&mut said);
            }
            match (text.starts_with('}'), text.ends_with('{')) {
                (true, _) => self.close(&text),
                (_, true) => self.open(text),
                _ => self.line(text),
            }
        }
    }

    /// The operand's variable that is all there is to a sign, if one is: what has its own
    /// place, so that it stays as it is for as long as the result is read. Where values
    /// share variables, nothing does.
    fn same_sign(&self, text: &str, args: [NodeId; 2], operands: &[Operand]) -> Option<String> {
        let (_, sign) = text.strip_suffix(';')?.split_once(" = ")?;
        let own = |id: NodeId| {
            let node = self.plan.graph.node(id);
            let computed = matches!(
                node,
                Node::Apply(..) | Node::Select { .. } | Node::Lookup { .. }
            );
            computed && self.names.is_alone(Place::Node(id))
        };
        let is = |(id, operand): &(NodeId, &Operand)| operand.sign == sign && own(*id);
        let found = args.into_iter().zip(operands).find(is)?;
        (!matches!(sign, "true" | "false")).then(|| found.1.sign.clone())
    }

    /// Whether an entry of a table has a sign that must be read with it.
    pub fn sign_is_looked_up(&self, id: NodeId, table: TableId) -> bool {
        let range = self.plan.ranges.result.get(id.0 as usize);
        let unknown = range.is_none_or(|range| known(*range).is_none());
        let table = self.plan.graph.tables.get(table.0 as usize);
        unknown && table.is_some_and(has_signs)
    }

    fn operand(&mut self, id: NodeId, format: Format) -> Operand {
        let value = self.read(id);
        let sign = match format {
            Format::Log { .. } => self.sign(id).text,
            _ => String::new(),
        };
        Operand { value, sign }
    }
}

/// An argument: its logarithm (or its int), and its sign.
struct Operand {
    value: Expression,
    sign: String,
}

/// A line with its arguments; between a call's commas and parentheses these need no
/// parentheses of their own.
fn filled(line: &str, operands: &[Operand]) -> String {
    let mut text = line.to_owned();
    for (k, operand) in operands.iter().enumerate() {
        let sign = format!("{{{k}+}}");
        if let "true" | "false" = operand.sign.as_str() {
            let other = (operand.sign != "true").to_string();
            text = text.replace(&format!("~{sign}"), &other);
        }
        text = text.replace(&sign, &operand.sign);
        let hole = format!("{{{k}}}");
        while let Some(at) = text.find(&hole) {
            let (before, after) = (&text[..at], &text[at + hole.len()..]);
            let opens = before.ends_with('(') || before.ends_with(", ");
            let alone = opens && (after.starts_with(',') || after.starts_with(')'));
            let assigned = before.ends_with(" = ") && after.starts_with(';');
            let level = if alone || assigned { SUM } else { TERM };
            text = format!("{before}{}{after}", operand.value.at(level));
        }
    }
    text
}

/// An assignment of a sign, without what is known of it.
fn simplified(text: &str) -> String {
    let Some((head, rest)) = text.split_once(" = ") else {
        return text.to_owned();
    };
    let rest = rest.trim_end_matches(';');
    let not = |sign: &str| match sign {
        "true" => "false".to_owned(),
        "false" => "true".to_owned(),
        other => format!("~{other}"),
    };
    let simple = match rest.split_once(" = ") {
        Some((a, b)) if a == b => "true".to_owned(),
        Some(("true", other) | (other, "true")) => other.to_owned(),
        Some(("false", other) | (other, "false")) => not(other),
        Some(_) => format!("({rest})"),
        None => match rest.strip_prefix('~') {
            Some(sign) if !sign.starts_with('(') => not(sign),
            _ => rest.to_owned(),
        },
    };
    format!("{head} = {simple};")
}

/// Takes away assignments of signs that nothing reads.
pub(super) fn without_idle_signs(signs: &BTreeSet<String>, all: &mut [&mut Vec<Line>]) {
    loop {
        let mut read: BTreeSet<String> = BTreeSet::new();
        for line in all.iter().flat_map(|lines| lines.iter()) {
            let code = line.text.split("//").next().unwrap_or_default();
            let code = match code.strip_prefix("let ").and_then(|c| c.split_once(" = ")) {
                Some((to, from)) if signs.contains(to) => from,
                _ => code,
            };
            let words = code.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            read.extend(words.filter(|w| signs.contains(*w)).map(str::to_owned));
        }
        let idle = |line: &Line| {
            let to = line
                .text
                .strip_prefix("let ")
                .and_then(|c| c.split_once(" = "));
            to.is_some_and(|(to, _)| signs.contains(to) && !read.contains(to))
        };
        let mut some = false;
        for lines in all.iter_mut() {
            let before = lines.len();
            lines.retain(|line| !idle(line));
            some |= lines.len() < before;
        }
        if !some {
            return;
        }
    }
}

/// Whether a table has entries below 0, whose signs stand in an array beside it.
pub(super) fn has_signs(table: &Table) -> bool {
    let below = |value: Value| matches!(value, Value::Real(r) if r < 0.0);
    table.entries.iter().any(|entry| below(entry.value()))
}
