//! Error diffusion: what pixels send to later ones waits in arrays of Floats,
//! one for each row that a share reaches ([`crate::plan::ErrorRows`]).

use super::code::Code;
use super::error_names::Spread;
use super::{Line, Text};
use super::{Subroutine, subroutine};
use crate::ir::graph::NodeId;
use slowlight_routine::{Form, Value};
use slowlight_runtime_jack::TERM;

impl Spread {
    /// The element for a column `dx` to the right, `dy` rows down.
    fn element(&self, x: &str, dx: i64, dy: usize) -> String {
        let row = self.ring.get(dy).map_or("", String::as_str);
        match i64::from(self.rows.left) + dx {
            0 => format!("{row}[{x}]"),
            right @ 1.. => format!("{row}[{x} + {right}]"),
            left => format!("{row}[{x} - {}]", left.unsigned_abs()),
        }
    }

    /// Takes what a pixel has received.
    pub fn receive(&self, code: &mut Code, x: &str, text: &mut Text) {
        let here = self.element(x, 0, 0);
        if code.logs() {
            let own = code.sign_of(&self.received);
            for line in unpacked(&here, &self.received, &own) {
                text.line(line);
            }
            return;
        }
        text.line(format!("let {} = {here};", self.received));
    }

    /// Sends a pixel's shares, and leaves 0 where it stood.
    pub fn send(&self, code: &mut Code, x: &str) -> Vec<Line> {
        let plan = code.plan;
        let mut text = Text::default();
        let gather = plan.gather().map(|routine| routine.form);
        let sum = self.sum.clone();
        for share in &self.rows.shares {
            let down = usize::try_from(share.dy).unwrap_or(0);
            let there = self.element(x, i64::from(share.dx), down);
            text.span = Some(plan.graph.span(share.node));
            if let Some(points) = code.points() {
                let line = code.gather_fixed(points, &there, share.node);
                text.line(line);
                continue;
            }
            if code.logs() {
                let template = match gather {
                    Some(Form::Statement(template)) => template,
                    _ => "",
                };
                for line in gathered(code, template, (&sum, &there), share.node) {
                    text.line(line);
                }
                continue;
            }
            text.line(format!("let {sum} = {there};"));
            if let Some(Form::Statement(template)) = gather {
                let sent = code.read(share.node).text;
                let call = template.replace("{r}", &sum).replace("{0}", &sum);
                text.line(format!("do {};", call.replace("{1}", &sent)));
            }
        }
        if code.real_is_int() {
            let here = self.element(x, 0, 0);
            text.line(format!("let {here} = 0;"));
            return text.lines;
        }
        let zero = code.constant(Value::Real(0.0)).text;
        code.needs.insert("Float.copy");
        text.line(format!("do {}.copy({zero});", self.received));
        text.lines
    }

    /// The row that is done becomes the furthest one.
    pub fn turn(&self, text: &mut Text) {
        let [first, .., done] = self.ring.as_slice() else {
            return;
        };
        if self.rows.rows < 2 {
            return;
        }
        text.line(format!("let {done} = {first};"));
        for pair in self.ring.windows(2) {
            if let [to, from] = pair {
                text.line(format!("let {to} = {from};"));
            }
        }
    }

    /// The method that makes the rows.
    pub fn making(&self, code: &mut Code) -> Subroutine {
        let length = self.rows.length();
        let [x, _] = code.names.axes.clone();
        let empty = match code.logs() {
            true => "0",
            false if code.real_is_int() => "0",
            false => "Float.new()",
        };
        if !code.real_is_int() {
            code.needs.insert("Float");
        }
        let mut text = Text::default();
        let rows = || self.ring.iter().take(self.rows.rows as usize);
        for row in rows() {
            text.line(format!("let {row} = Array.new({length});"));
        }
        text.line(format!("let {x} = 0;"));
        text.open(format!("while ({x} < {length}) {{"));
        for row in rows() {
            text.line(format!("let {row}[{x}] = {empty};"));
        }
        text.line(format!("let {x} = {x} + 1;"));
        text.close("}");
        let about = "What pixels send to later ones: a row each.";
        subroutine(about, "method void makeErrors()", text.lines)
    }
}

/// What a logarithm and its sign are read from: one word, how far it is above the
/// least, which is 0, or one less than minus that where it is negative.
fn unpacked(word: &str, log: &str, plus: &str) -> Vec<String> {
    vec![
        format!("let {log} = {word};"),
        format!("let {plus} = ~({log} < 0);"),
        format!("if ({plus}) {{ let {log} = {log} - {ABOVE}; }}"),
        format!("else {{ let {log} = (-{}) - {log}; }}", ABOVE + 1),
    ]
}

/// The same, written.
fn packed(word: &str, log: &str, plus: &str) -> Vec<String> {
    vec![
        format!("if ({plus}) {{ let {word} = {log} + {ABOVE}; }}"),
        format!("else {{ let {word} = (-{}) - {log}; }}", ABOVE + 1),
    ]
}

/// What the least logarithm is below 0.
const ABOVE: i32 = -slowlight_routine::log::model::LEAST;

/// Adds a share to what another pixel has received, both as logarithms.
fn gathered(
    code: &mut Code,
    template: &str,
    (sum, there): (&str, &str),
    share: NodeId,
) -> Vec<String> {
    let (sent, plus, own) = (
        code.read(share).at(TERM),
        code.sign(share).text,
        code.sign_of(sum),
    );
    let fill = |line: &str| {
        let line = line.replace("{r+}", &own).replace("{r}", sum);
        let line = line.replace("{0+}", &own).replace("{0}", sum);
        line.replace("{1+}", &plus).replace("{1}", &sent)
    };
    let mut lines = unpacked(there, sum, &own);
    lines.extend(template.lines().map(fill));
    lines.extend(packed(there, sum, &own));
    lines
}
