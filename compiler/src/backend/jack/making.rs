//! What fills the scene's object before anything is drawn.

use super::Line;
use super::code::Code;
use super::expression::{Expression, constant, int};
use super::logs::has_signs;
use super::{Subroutine, line, subroutine};
use crate::plan::ParamPlan;
use slowlight_routine::log::model::Log;
use slowlight_routine::{Bits, Form, Format, Op, Type, Value};
use slowlight_runtime_jack::{model, words};

/// The methods that make constants, Floats and tables, and read the params.
pub(super) fn making(code: &mut Code) -> Vec<Subroutine> {
    let plan = code.plan;
    let mut all = Vec::new();

    let mut taking = Vec::new();
    let values: Vec<(usize, String)> = code
        .object
        .values()
        .map(|(p, name)| (p as usize, name.to_owned()))
        .collect();
    for (at, value) in &values {
        let (Some(label), Some(param)) =
            (code.names.params.get(*at).cloned(), plan.params.get(*at))
        else {
            continue;
        };
        if let Some(points) = code.points() {
            taking.push(code.take_fixed(points, (value, &label), (*at, param)));
            continue;
        }
        if code.logs() {
            taking.extend(take_log(code, (value, &label), param));
            continue;
        }
        if param.digits.is_none() {
            // Given by its bits, which no scaled int can say.
            code.needs.insert("Float.constant");
            let constant = real_constant(param.bits, plan.runtime.real);
            taking.push(line(&format!("let {value} = {constant};")));
            continue;
        }
        taking.push(line(&format!("do {value}.fromInt({label});")));
        code.needs.insert("Float.fromInt");
        if let Some(digits) = param.digits.filter(|d| *d > 0) {
            let unit = 10f64.powi(i32::from(digits));
            let bits = plan.bits(Value::Real(unit));
            let scale = code.object.constant(&mut code.names, bits, unit);
            let said = format!("{value} = {label} / {unit}");
            let quotient = divided(code, value, &scale);
            taking.push(line(&format!("do {quotient}; // {said}")));
        }
    }

    let constants = code.object.constants().iter().map(|c| {
        let (name, value) = (&c.name, c.value);
        let constant = real_constant(c.bits, plan.runtime.real);
        line(&format!("let {name} = {constant}; // {value}"))
    });
    let constants: Vec<Line> = constants.collect();
    if !constants.is_empty() {
        code.needs.insert("Float.constant");
    }
    let floats = code.written.iter().filter(|(_, f)| f.is_object());
    let floats = floats.map(|(name, _)| name.clone());
    // What is an int needs no making.
    let values = values
        .iter()
        .filter(|_| !code.real_is_int())
        .map(|v| v.1.clone());
    let floats: Vec<String> = values.chain(floats).collect();
    let made = floats
        .iter()
        .map(|name| line(&format!("let {name} = Float.new();")));
    let made: Vec<Line> = made.collect();
    if !made.is_empty() {
        code.needs.insert("Float");
    }
    if let Some(spread) = code.spread.clone() {
        all.push(spread.making(code));
    }
    all.extend(code.refined.iter().map(|refined| refined.making()));
    let tables = tables(code);
    for (name, about, lines) in [
        (
            "makeConstants",
            "Floats that never change: sign, exponent, mantissa.",
            constants,
        ),
        ("makeValues", "A Float for each value.", made),
        ("makeTables", "The scene's tables.", tables),
    ] {
        if !lines.is_empty() {
            let body = code.divided(lines, name);
            all.push(subroutine(about, format!("method void {name}()"), body));
        }
    }
    if !taking.is_empty() {
        let about = "The parameters as reals.";
        let body = code.divided(taking, "takeParameters");
        all.push(subroutine(about, "method void takeParameters()", body));
    }
    all
}

/// What makes an object of a real's bits.
fn real_constant(bits: Bits, real: Format) -> String {
    let words = words(bits, real).into_iter().map(|word| word.to_string());
    format!("Float.constant({})", words.collect::<Vec<_>>().join(", "))
}

/// What divides a real in place, as the runtime's own routine for quotients does.
fn divided(code: &mut Code, value: &str, by: &str) -> String {
    let mut routines = code.plan.runtime.routines.iter();
    let Some(div) = routines.find(|r| r.op == Op::Div) else {
        return String::new();
    };
    code.needs.extend(div.needs);
    match div.form {
        Form::Statement(template) | Form::Expression { template, .. } => template
            .replace("{r}", value)
            .replace("{0}", value)
            .replace("{1}", by),
    }
}

/// A param's logarithm and sign, from its whole number.
fn take_log(code: &mut Code, (value, label): (&str, &str), param: &ParamPlan) -> Vec<Line> {
    let plus = code.sign_of(value);
    let Some(digits) = param.digits else {
        // Given by its bits.
        let log = Log::from_bits(param.bits);
        return vec![
            line(&format!("let {value} = {};", int(log.log).text)),
            line(&format!("let {plus} = {};", log.plus)),
        ];
    };
    code.needs.extend(["Log.fromInt", "Log.clamp"]);
    let unit = 10i32.saturating_pow(u32::from(digits));
    let log = Log::from_int(unit).log;
    vec![
        line(&format!(
            "let {value} = Log.clamp(Log.fromInt({label}) - {log}); // {label} / {unit}"
        )),
        line(&format!("let {plus} = ~({label} < 0);")),
    ]
}

fn tables(code: &mut Code) -> Vec<Line> {
    let plan = code.plan;
    let mut lines = Vec::new();
    let all: Vec<_> = code
        .names
        .tables()
        .map(|(id, name)| (id, name.to_owned()))
        .collect();
    for (id, name) in all {
        let Some(table) = plan.graph.tables.get(id.0 as usize) else {
            continue;
        };
        let signs = (code.logs() && has_signs(table)).then(|| format!("{name}_plus"));
        for name in [Some(&name), signs.as_ref()].into_iter().flatten() {
            let length = table.entries.len();
            lines.push(line(&format!("let {name} = Array.new({length});")));
        }
        for (at, entry) in table.entries.iter().enumerate() {
            let value = entry.value();
            let bits = match code.points() {
                Some(_) => plan.entry(id, at),
                None => plan.bits(value),
            };
            let text = match (plan.runtime.decode)(bits, plan.runtime.format_of(table.ty)) {
                Value::Int(i) => int(i),
                Value::Bool(b) => Expression::term(b.to_string()),
                Value::Real(_) if code.logs() => constant(bits),
                Value::Real(_) if code.points().is_some() => int(model::int(bits)),
                Value::Real(_) => {
                    code.needs.insert("Float.constant");
                    Expression::term(real_constant(bits, plan.runtime.real))
                }
            };
            let said = match table.ty {
                Type::Real => format!(" // {}", value.real()),
                _ => String::new(),
            };
            lines.push(line(&format!("let {name}[{at}] = {};{said}", text.text)));
            if let Some(signs) = &signs {
                let plus = value.real() >= 0.0;
                lines.push(line(&format!("let {signs}[{at}] = {plus};")));
            }
        }
    }
    lines
}
