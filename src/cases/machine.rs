//! A vector on a machine: the inputs' bits go into the generated program, the
//! bits of what it reports come out.
//!
//! A param of a generated program is a decimal or a scaled integer, which cannot
//! say every value. Here each is given exactly ([`give`]), and the program's
//! check of its range is left out. How a program reports is its target's affair:
//! BASIC writes a file, Jack prints, the 6502 draws bytes.

use crate::failure::{Failure, Outcome};
use crate::machine::{MachineRun, complaint};
use crate::trial::build;
use slowlight_compiler::plan::{ParamPlan, Plan};
use slowlight_compiler::targets::{Language, Target};
use slowlight_routine::{Bits, Format, Type, Value};

/// Cycles after which a run is given up: a hang, which is a failure.
const LIMIT: u64 = 20_000_000_000;

/// Gives a param its bits, in a target's source.
pub fn give(param: &mut ParamPlan, value: Value, bits: Bits, target: &Target) {
    let format = target.runtime.real;
    let assembly = target.system.language() == Language::Assembly;
    param.bits = bits;
    param.range = None;
    match (format, value) {
        // The exponent goes beside what is written.
        (Format::Real40, Value::Real(_)) if assembly => {
            param.digits = None;
            param.text = (bits as u32 as i32).to_string();
        }
        (Format::Real40, Value::Real(x)) => param.text = product(x),
        (Format::Fixed { .. } | Format::Scaled { .. }, Value::Real(_)) => {
            param.digits = None;
            param.text = (bits as i64).to_string();
        }
        (Format::Log { .. }, Value::Real(_)) => {
            param.digits = None;
            param.text = bits.to_string();
        }
        (real, Value::Real(_)) if real.is_object() => {
            param.digits = None;
            param.text = "0".to_owned();
        }
        _ => param.text = value.int().to_string(),
    }
}

/// A real of 32 bits as BASIC works it out exactly: a whole number below 2^32,
/// which it reads exactly, times or over powers of two.
fn product(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let (mut m, mut power) = (x.abs(), 0i32);
    while m.fract() != 0.0 {
        m *= 2.0;
        power -= 1;
    }
    while m >= 4_294_967_296.0 {
        m /= 2.0;
        power += 1;
    }
    let sign = if x < 0.0 { "-" } else { "" };
    let by = if power < 0 { "/" } else { "*" };
    let mut text = format!("{sign}{m}");
    let mut left = power.abs();
    while left > 0 {
        let now = left.min(30);
        text.push_str(&format!("{by}2^{now}"));
        left -= now;
    }
    text
}

/// What the plan's program reports on its machine.
///
/// # Errors
/// Where its machine refuses it, or it does not end, or reports something odd.
pub fn run(plan: &Plan) -> Outcome<Vec<Value>> {
    let mut built = build(plan)?;
    let run = built.loaded.run(LIMIT, &mut |_| {})?;
    if let Some(wrong) = complaint(&run, LIMIT) {
        return Err(Failure::Wrong(format!("{}: {wrong}", plan.target.name)));
    }
    let formats: Vec<Format> = plan
        .graph
        .reports
        .iter()
        .map(|&id| plan.format(id))
        .collect();
    let found = match plan.runtime.real {
        _ if plan.target.system.language() == Language::Assembly => {
            from_screen(&run, &formats, plan)
        }
        Format::Real40 => from_file(&run, &formats, plan),
        _ => from_text(&run, &formats, plan),
    };
    found.ok_or_else(|| {
        let message = format!("{}: the program's report is incomplete", plan.target.name);
        Failure::Wrong(message)
    })
}

/// BASIC's records: a byte for the type, then the value, last byte first.
fn from_file(run: &MachineRun, formats: &[Format], plan: &Plan) -> Option<Vec<Value>> {
    let mut rest = run.files.get("REPORTS")?.as_slice();
    let mut take = |count: usize| {
        let (head, tail) = rest.split_at_checked(count)?;
        rest = tail;
        Some(head)
    };
    let mut values = Vec::new();
    for format in formats {
        let number = match take(1)? {
            [0x40] => {
                let bytes: [u8; 4] = take(4)?.try_into().ok()?;
                f64::from(i32::from_be_bytes(bytes))
            }
            [0xFF] => {
                let bytes = take(5)?.iter().rev();
                let bits = bytes.fold(0, |bits, &b| bits << 8 | Bits::from(b));
                (plan.runtime.decode)(bits, Format::Real40).real()
            }
            _ => return None,
        };
        values.push(typed(number, format.scalar()));
    }
    Some(values)
}

fn typed(number: f64, ty: Type) -> Value {
    match ty {
        Type::Real => Value::Real(number),
        Type::Int => Value::Int(number as i32),
        Type::Bool => Value::Bool(number != 0.0),
    }
}

/// Jack's lines: a number, or a Float's three or four, or a logarithm after 1 for a negative.
fn from_text(run: &MachineRun, formats: &[Format], plan: &Plan) -> Option<Vec<Value>> {
    let text = String::from_utf8_lossy(&run.output);
    let mut numbers = text.split_whitespace().map(str::parse::<i32>);
    let mut next = || numbers.next()?.ok();
    let mut values = Vec::new();
    for format in formats {
        values.push(match format {
            real if real.is_object() => {
                let mut words = 0..real.words();
                let bits = words.try_fold(0, |bits, _| {
                    let word = next()? as u16;
                    Some(bits << 16 | Bits::from(word))
                })?;
                (plan.runtime.decode)(bits, *real)
            }
            Format::Log { .. } => {
                let (minus, log) = (next()?, next()?);
                let bits = Bits::from(log as u16) | Bits::from(minus != 0) << 16;
                (plan.runtime.decode)(bits, *format)
            }
            Format::Fixed { .. } => {
                let bits = i64::from(next()?) as Bits;
                (plan.runtime.decode)(bits, *format)
            }
            _ => typed(f64::from(next()?), format.scalar()),
        });
    }
    Some(values)
}

/// The 6502's pixels: four bytes a value, of a float five, low byte first.
fn from_screen(run: &MachineRun, formats: &[Format], plan: &Plan) -> Option<Vec<Value>> {
    let mut rest = run.screen.as_ref()?.pixels.as_slice();
    let mut values = Vec::new();
    for format in formats {
        let (upper, count) = match format {
            Format::Real40 => (0, 5),
            _ => (32, 4),
        };
        let (bytes, others) = rest.split_at_checked(count)?;
        rest = others;
        let bits = bytes
            .iter()
            .rev()
            .fold(0, |bits, &b| bits << 8 | Bits::from(b));
        // Sign-extended, where it is.
        let bits = (bits as i64) << upper >> upper;
        values.push((plan.runtime.decode)(bits as Bits, *format));
    }
    Some(values)
}

#[cfg(test)]
mod tests {
    use super::product;

    #[test]
    fn reals_are_written_exactly() {
        for (x, text) in [
            (0.0, "0"),
            (-3.0, "-3"),
            (0.75, "3/2^2"),
            (1.0 + 0.5f64.powi(31), "2147483649/2^30/2^1"),
            (2f64.powi(70), "2147483648*2^30*2^9"),
        ] {
            assert_eq!(product(x), text);
        }
    }
}
