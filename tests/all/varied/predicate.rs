//! When a varied case passes: predicates as files of cases have them, made from a recipe.

use super::case::Case;
use super::parse::Expr;
use super::run::{Run, Value};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;

/// What a recipe's predicate is made from.
pub struct Maker<'r> {
    /// Knows the inputs, the wanted outputs, and what the recipe calls by names.
    pub run: Run<'r>,
    pub present: bool,
    /// Last places that fixed point may be off.
    pub quanta: BTreeMap<String, f64>,
    /// Whether what is decided on the way is too close to call in the format.
    pub undecided: bool,
}

fn name(expr: &Expr) -> &str {
    match expr {
        Expr::Name(name) if name == "every" => "*",
        Expr::Name(name) => name,
        other => panic!("{other:?} is no name"),
    }
}

impl Maker<'_> {
    fn number(&mut self, expr: &Expr) -> f64 {
        match self.run.value(expr) {
            Value::Nothing => 0.0,
            value => value.number().near(),
        }
    }

    pub fn predicate(&mut self, expr: &Expr) -> Json {
        let (called, arguments) = match expr {
            Expr::Name(called) => (called.as_str(), &[][..]),
            Expr::Call(called, arguments) => (called.as_str(), &arguments[..]),
            Expr::Choice(parts) => {
                let truth = self.run.value(&parts[0]).truth();
                return self.predicate(&parts[if truth { 1 } else { 2 }]);
            }
            other => panic!("{other:?} is no predicate"),
        };
        let numbers = |maker: &mut Self, from: usize| -> Vec<f64> {
            let rest = arguments.get(from..).unwrap_or_default();
            rest.iter().map(|a| maker.number(a)).collect()
        };
        match called {
            "all" => {
                let of: Vec<Json> = arguments.iter().map(|a| self.predicate(a)).collect();
                json!({"kind": "all", "of": of})
            }
            "present" => json!({"kind": "present", "value": self.present}),
            "if_present" => {
                json!({"kind": "if_present", "predicate": self.predicate(&arguments[0])})
            }
            "decided" => {
                let [margin, k] = [0, 1].map(|n| self.number(&arguments[n]));
                let margin = if self.undecided { 0.0 } else { margin };
                let inner = self.predicate(&arguments[2]);
                json!({"kind": "decided", "margin": margin, "k": k, "predicate": inner})
            }
            "orthonormal" => json!({"kind": "orthonormal", "k": self.number(&arguments[0])}),
            "unit_vector" => {
                let Expr::List(outputs) = &arguments[0] else {
                    panic!("unit_vector is of several");
                };
                let outputs: Vec<&str> = outputs.iter().map(name).collect();
                json!({"kind": "unit_vector", "outputs": outputs, "k": self.number(&arguments[1])})
            }
            _ => {
                let output = name(&arguments[0]);
                let numbers = numbers(self, 1);
                let kq = self.quanta.get(output);
                match (called, &numbers[..]) {
                    ("rel", [k, cond]) => {
                        json!({"kind": "rel", "output": output, "k": k, "cond": cond, "kq": kq})
                    }
                    ("absolute", [k, scale, pow, slack]) => {
                        json!({"kind": "abs", "output": output, "k": k, "scale": scale, "pow": pow, "slack": slack, "kq": kq})
                    }
                    ("interval", [lo, hi, k, scale]) => {
                        json!({"kind": "interval", "output": output, "lo": lo, "hi": hi, "k": k, "scale": scale})
                    }
                    ("sign", [zero]) => {
                        json!({"kind": "sign", "output": output, "zero": *zero as i32})
                    }
                    // Ways that part at what is too close to call stay near each other.
                    ("equal", []) if self.undecided => {
                        json!({"kind": "near", "output": output, "by": 1})
                    }
                    ("equal", []) => json!({"kind": "equal", "output": output}),
                    _ => panic!("no predicate {called} of {numbers:?}"),
                }
            }
        }
    }
}

/// A predicate's numbers by what they bound; what refuses or always passes left out.
fn bounds(predicate: &Json, path: &str, found: &mut BTreeMap<String, f64>) {
    let kind = predicate["kind"].as_str().expect("a kind");
    let output = predicate["output"].as_str().unwrap_or_default();
    let path = match kind {
        "all" | "refuse_or" => path.to_owned(),
        _ => format!("{path}{kind} {output} "),
    };
    for (key, value) in predicate.as_object().expect("a predicate") {
        match (key.as_str(), value) {
            ("predicate", inner) => bounds(inner, &path, found),
            ("of", Json::Array(all)) => all.iter().for_each(|p| bounds(p, &path, found)),
            (_, Json::Number(number)) => {
                let number = number.as_f64().expect("a number");
                found.insert(format!("{path}{key}"), number);
            }
            _ => {}
        }
    }
}

/// Where a case computed again differs from the file's, or is wider.
pub fn differences(vector: &Json, case: &Case) -> Vec<String> {
    let id = vector["id"].as_str().expect("an id");
    let mut wrong = Vec::new();
    for (output, wanted) in vector["expected"].as_object().expect("outputs") {
        let got = &case.expected[output];
        let number = |value: &Json| match value {
            Json::String(text) => text.parse::<f64>().ok(),
            other => other.as_f64(),
        };
        let same = match (number(wanted), number(got)) {
            (Some(a), Some(b)) => (a - b).abs() <= 1e-14 * a.abs().max(1e-300),
            (None, None) => wanted == got,
            // Not prescribed.
            (None, Some(_)) => wanted.is_null(),
            (Some(_), None) => false,
        };
        if !same {
            wrong.push(format!("{id} {output}: {wanted} in the file, {got}"));
        }
    }
    let (mut file, mut ours) = (BTreeMap::new(), BTreeMap::new());
    bounds(&vector["predicate"], "", &mut file);
    bounds(&case.predicate, "", &mut ours);
    for (what, wanted) in &file {
        let Some(got) = ours.get(what) else {
            wrong.push(format!("{id}: no {what} {wanted}"));
            continue;
        };
        // Exponents that no format has, or all have, say the same.
        let end = |x: f64| if x < -128.0 { -1000.0 } else { x.max(-1000.0) };
        let beyond = |x: f64| x < -16.0 && x > -128.0;
        let near = (got - wanted).abs() <= 1e-6 * wanted.abs()
            || what == "lo" && (end(*got) == end(*wanted) || beyond(*got) && beyond(*wanted));
        let ok = match what.rsplit(' ').next() {
            _ if near => true,
            Some("scale" | "cond" | "kq") => got < wanted,
            Some("margin") => got > wanted,
            _ => false,
        };
        if !ok {
            wrong.push(format!("{id} {what}: {wanted} in the file, {got}"));
        }
    }
    wrong
}
