//! Parameter block: params as a program writes them, and what a machine cannot write.

use crate::ir::graph::{Graph, Param};
use crate::source::Diagnostic;
use slowlight_routine::{Bits, Format, Runtime, Type, Value};

/// How the parameter block of the generated source writes a param's scalar.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamPlan {
    /// Its name there: `eye_y`.
    pub label: String,
    /// `None`: written as a decimal; `Some(d)`: as an integer, the value times 10^d.
    pub digits: Option<u8>,
    /// The value as written.
    pub text: String,
    /// The range as written, least and greatest; none where the scene gives none.
    pub range: Option<(String, String)>,
    /// What the program makes of it.
    pub bits: Bits,
    /// The value that `text` stands for.
    pub value: f64,
}

/// All params in the graph's order, or what is wrong with them on this machine.
// A diagnostic is large; it is made once, where the scene is wrong.
#[allow(clippy::result_large_err)]
pub(crate) fn params(graph: &Graph, runtime: &Runtime) -> Result<Vec<ParamPlan>, Vec<Diagnostic>> {
    let wrong = |p| ranged(p, runtime).and_then(|()| small(p, runtime)).err();
    let said: Vec<Diagnostic> = graph.params.iter().filter_map(wrong).collect();
    if said.is_empty() {
        Ok(graph.params.iter().map(|p| param(p, runtime)).collect())
    } else {
        Err(said)
    }
}

/// Fixed point needs to know how large a value may become.
// A diagnostic is large; it is made once, where the scene is wrong.
#[allow(clippy::result_large_err)]
fn ranged(p: &Param, runtime: &Runtime) -> Result<(), Diagnostic> {
    let limited = runtime.real.is_fixed();
    if !limited || p.ty != Type::Real || p.range.is_some() {
        return Ok(());
    }
    let message = format!(
        "`{}` has no range, and {} is a fixed-point format",
        p.name, runtime.format
    );
    Err(Diagnostic::error(p.span, message)
        .label("how large may it become?")
        .help("say it: `param ... = value in least .. greatest;`, or make a constant of it by --freeze"))
}

/// The value and the range must be numbers that the source can write, or
/// machine and scene would differ in silence.
// A diagnostic is large; it is made once, where the scene is wrong.
#[allow(clippy::result_large_err)]
fn small(p: &Param, runtime: &Runtime) -> Result<(), Diagnostic> {
    let most = match (p.ty, runtime.int) {
        (Type::Real, _) => runtime.param_most,
        // Without the least, which has no literal in most languages.
        (Type::Int, Format::Int { bits }) => 2f64.powi(i32::from(bits) - 1) - 1.0,
        _ => return Ok(()),
    };
    let ends = p.range.map_or([0.0; 2], |r| [r.lo, r.hi]);
    let beyond = |x: &f64| x.is_nan() || x.abs() > most;
    let (what, far) = match (Some(p.value).filter(beyond), ends.into_iter().find(beyond)) {
        (Some(value), _) => ("is", value),
        (None, Some(end)) => ("may become", end),
        (None, None) => return Ok(()),
    };
    let label = match p.component {
        "" => p.name.clone(),
        part => format!("{}.{part}", p.name),
    };
    let message = format!(
        "`{label}` {what} {}, and {} params go from -{} to {} only",
        decimal(far),
        runtime.name,
        decimal(most),
        decimal(most)
    );
    Err(Diagnostic::error(p.span, message)
        .label("too large for this target")
        .help("make it smaller (another unit, a narrower range), or make a constant of it by --freeze"))
}

fn param(p: &Param, runtime: &Runtime) -> ParamPlan {
    let digits = match p.ty {
        Type::Real => {
            let ends = p.range.map_or(0.0, |r| r.magnitude());
            (runtime.param_digits)(p.value.abs().max(ends), p.range.is_some())
        }
        _ => Some(0),
    };
    let scale = 10f64.powi(i32::from(digits.unwrap_or(0)));
    let whole = |x: f64| (x * scale).round() as i64;
    let (text, bits, value) = match (digits, p.ty) {
        (Some(d), Type::Real) => {
            let n = whole(p.value);
            (n.to_string(), (runtime.param_bits)(n, d), n as f64 / scale)
        }
        (_, Type::Real) => {
            let bits = (runtime.encode)(Value::Real(p.value), runtime.real);
            (decimal(p.value), bits, p.value)
        }
        _ => {
            let value = if p.ty == Type::Int {
                Value::Int(p.value as i32)
            } else {
                Value::Bool(p.value != 0.0)
            };
            let bits = (runtime.encode)(value, runtime.format_of(p.ty));
            ((p.value as i64).to_string(), bits, p.value)
        }
    };
    let written = |x: f64| {
        if digits.is_some() {
            whole(x).to_string()
        } else {
            decimal(x)
        }
    };
    let range = p.range.map(|r| (written(r.lo), written(r.hi)));
    ParamPlan {
        label: p.label(),
        digits,
        text,
        range,
        bits,
        value,
    }
}

/// A decimal with up to ten digits, as BASIC reads it.
fn decimal(x: f64) -> String {
    let plain = format!("{x}");
    if plain.bytes().filter(u8::is_ascii_digit).count() <= 10 {
        return plain;
    }
    let short = format!("{x:.9e}");
    match short.parse::<f64>() {
        Ok(y) if (1e-3..1e9).contains(&y.abs()) => format!("{y}"),
        _ => short.replace('e', "E"),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::scene::check;
    use crate::sema::Options;
    use crate::targets::find;

    fn planned(target: &str, param: &str, set: Option<f64>) -> Result<ParamPlan, Vec<Diagnostic>> {
        let text = format!(
            "image 8 x 4 inks black, white; param p: {param}; draw (x, y) = ink(floor(p));"
        );
        let scene = check("test", &text);
        assert!(scene.is_right(), "{:?}", scene.diagnostics);
        let options = Options {
            set: set.map(|v| ("p".to_owned(), vec![v])).into_iter().collect(),
            ..Options::default()
        };
        let graph = scene.lower(&options).unwrap();
        params(&graph, find(target).unwrap().runtime).map(|mut all| all.remove(0))
    }

    #[test]
    fn the_value_counts_as_the_range_does() {
        for (param, set, digits, text) in [
            ("real = 0.785", None, 3, "785"),
            ("real = 33.5", None, 2, "3350"),
            ("real = 100", None, 2, "10000"),
            ("real = -20000.4", None, 0, "-20000"),
            ("real = 0.785", Some(-400.0), 1, "-4000"),
            ("real = 1 in -3 .. 3", None, 4, "10000"),
            ("real = 1 in -3 .. 300", None, 2, "100"),
        ] {
            let plan = planned("jack", param, set).unwrap();
            assert_eq!(
                (plan.digits, plan.text.as_str()),
                (Some(digits), text),
                "{param}"
            );
            let value = set.unwrap_or(plan.value);
            assert!((plan.value - value).abs() < 1e-9, "{param}");
        }
    }

    #[test]
    fn what_cannot_be_written_is_refused() {
        for (target, param, set, part) in [
            (
                "jack",
                "real = 40000",
                None,
                "`p` is 40000, and jack params go from -32767 to 32767",
            ),
            ("jack", "real = 1", Some(-33000.0), "`p` is -33000"),
            (
                "jack",
                "real = 1 in 0 .. 100000",
                None,
                "`p` may become 100000",
            ),
            ("jack", "int = 70000", None, "`p` is 70000"),
            (
                "jack",
                "int = 7 in -32768 .. 9",
                None,
                "`p` may become -32768",
            ),
            (
                "6502:plain",
                "real = 1 in 0 .. 40000",
                None,
                "`p` may become 40000",
            ),
            ("6502:plain", "real = 1", None, "has no range"),
            ("bbc:micro", "real = 1", Some(1e39), "`p` is 1"),
        ] {
            let said = planned(target, param, set).unwrap_err();
            assert_eq!(said.len(), 1);
            assert!(said[0].message.contains(part), "{}", said[0].message);
            assert!(said[0].help.is_some());
            assert!(said[0].span.start > 0);
        }
        for (target, param) in [
            ("bbc:micro", "real = 40000"),
            ("bbc:micro", "int = 70000"),
            ("6502:plain", "int = 70000"),
            ("6502:plain", "real = 30000 in 0 .. 32767"),
        ] {
            assert!(planned(target, param, None).is_ok(), "{target} {param}");
        }
    }
}
