//! A case computed from its inputs: what is wanted, and when a result passes.

use super::big::Big;
use super::moves::{Moves, Rule};
use super::parse::{Expr, Statement, body, expression};
use super::predicate::Maker;
use super::run::{Move, Random, Run, Value};
use serde_json::{Map, Value as Json, json};
use slowlight::cases::format::{Arithmetic, placed};
use slowlight_routine::Format;
use std::collections::BTreeMap;

/// Formats whose points the plan places: their names, the bits of their params, and those
/// of the values that no pixel needs more of.
const PLANNED: [(&str, u8, u8); 4] = [
    ("fixed12", 16, 8),
    ("fixed16", 16, 16),
    ("fixed20", 24, 16),
    ("fixed24", 24, 24),
];

/// Inputs, as f64 has them.
pub type Inputs = BTreeMap<String, f64>;

/// A kernel, with its formula and how it varies.
pub struct Kernel {
    stable: Vec<Statement>,
    pub(super) outputs: Vec<String>,
    ints: Vec<String>,
    vary: Vec<Statement>,
    lets: Vec<Statement>,
    /// An output and an input: `slope` is how the one moves with the other.
    slope: Option<(usize, String)>,
    predicate: Expr,
    /// 2^u is the roundoff of an exact run: with none, thresholds that are a format's own
    /// vanish. Where steps end by them there has to be one.
    u: Option<i32>,
}

/// What a case comes to.
pub struct Case {
    pub expected: Map<String, Json>,
    pub predicate: Json,
}

fn lines(value: &Json) -> Vec<&str> {
    let all = value.as_array().into_iter().flatten();
    all.map(|line| line.as_str().expect("a line")).collect()
}

fn names(value: &Json) -> Vec<String> {
    lines(value).into_iter().map(str::to_owned).collect()
}

/// Every kernel of the file.
pub fn kernels(file: &Json) -> BTreeMap<String, Kernel> {
    let varied: Json = serde_json::from_str(include_str!("../../varied_cases.json")).expect("JSON");
    let varied = varied.as_object().expect("kernels");
    let one = |(key, recipe): (&String, &Json)| {
        let (family, entry) = key.split_once('/').expect("family/entry");
        let entry = &file["families"][family]["entry"][entry];
        let outputs = names(&entry["outputs"]);
        let slope = recipe["slope"].as_array().map(|pair| {
            let [output, input] = [&pair[0], &pair[1]].map(|n| n.as_str().expect("a name"));
            let place = outputs.iter().position(|o| o == output);
            (place.expect("an output"), input.to_owned())
        });
        let kernel = Kernel {
            stable: body(lines(&entry["stable"])),
            outputs,
            ints: names(&entry["ints"]),
            vary: body(lines(&recipe["vary"])),
            lets: body(lines(&recipe["let"])),
            slope,
            u: recipe["u"].as_i64().map(|u| u as i32),
            predicate: expression(recipe["predicate"].as_str().expect("a predicate")),
        };
        (key.clone(), kernel)
    };
    varied.iter().map(one).collect()
}

/// An exact decimal: inputs are short binary fractions.
fn decimal(x: f64) -> String {
    format!("{x}")
}

impl Kernel {
    /// By which a vector's kernel is found.
    pub fn key(vector: &Json) -> String {
        let id = vector["id"].as_str().expect("an id");
        let (family, _) = id.split_once('/').expect("family/tag");
        format!("{family}/{}", vector["entry"].as_str().expect("an entry"))
    }

    pub fn inputs(&self, vector: &Json) -> Inputs {
        let inputs = vector["inputs"].as_object().expect("inputs").iter();
        let number = |input: &Json| {
            let text = input["dec"].as_str().expect("a decimal");
            text.parse().expect("a number")
        };
        inputs.map(|(n, i)| (n.clone(), number(i))).collect()
    }

    pub(super) fn values(&self, inputs: &Inputs) -> BTreeMap<String, Value> {
        let value = |(name, x): (&String, &f64)| {
            let value = Value::Number(Big::new(*x), self.ints.contains(name));
            (name.clone(), value)
        };
        inputs.iter().map(value).collect()
    }

    /// Inputs of the same kind.
    pub fn others(&self, vector: &Json, random: &mut Random) -> Inputs {
        let inputs = self.inputs(vector);
        let mut run = Run::new(self.values(&inputs));
        run.random = Some(random);
        run.body(&self.vary);
        let new = |name: &String| (name.clone(), run.names[name].number().near());
        inputs.keys().map(new).collect()
    }

    /// One of several vectors of the same kind as the file's.
    pub fn varied(&self, vector: &Json, time: usize, all: &[Inputs]) -> Json {
        let inputs = &all[time];
        let case = self.case(inputs, &Rule::Fixed);
        let written = inputs.iter();
        let written: Map<String, Json> = written
            .map(|(name, x)| (name.clone(), json!({"dec": decimal(*x)})))
            .collect();
        let mut made = json!({
            "id": format!("{}_{time}", vector["id"].as_str().expect("an id")),
            "entry": vector["entry"],
            "inputs": written,
            "expected": case.expected,
            "predicate": case.predicate,
        });
        let fixed = Format::Fixed { bits: 32, frac: 16 };
        let float = Format::Float316 { rounded: false };
        for (key, name, format, rule) in [
            ("expected_by_bits", "14", float, Rule::Nothing),
            ("expected_by_bits", "32", Format::Real40, Rule::Nothing),
            ("expected_by_quantum", "16.16", fixed, Rule::Fixed),
        ] {
            if let Some(overlay) = self.overlay(inputs, Arithmetic::Of(format), &rule) {
                made[key][name] = overlay;
            }
        }
        let own = &mut made["expected_by_format"];
        // What does not fit is refused aloud.
        let log = Arithmetic::Of(slowlight_routine::log::LOG);
        own["log10"] = self.among(
            inputs,
            |x, _| log.round(x),
            &Rule::Logarithms(log.epsilon()),
        );
        let (params, places) = (self.params(all), self.places(all));
        for (name, wide, narrow) in PLANNED {
            let round = |x: f64, name: &str| {
                let [_, least, greatest] = params[name];
                placed(x, least.abs().max(greatest.abs()), wide)
            };
            own[name] = self.among(inputs, round, &Rule::Places(&places, narrow));
        }
        made["params"] = json!(params);
        made
    }

    /// What params would be said to be that have the inputs of all these cases: the usual
    /// value, the least and the greatest.
    fn params(&self, all: &[Inputs]) -> BTreeMap<String, [f64; 3]> {
        let of = |name: &String| {
            let values = all.iter().map(|inputs| inputs[name]);
            let least = values.clone().fold(f64::INFINITY, f64::min);
            let greatest = values.fold(f64::NEG_INFINITY, f64::max);
            (name.clone(), [all[0][name], least, greatest])
        };
        all[0].keys().map(of).collect()
    }

    /// The inputs as a format has them; none where one does not fit.
    fn rounded(&self, inputs: &Inputs, round: impl Fn(f64, &str) -> Option<f64>) -> Option<Inputs> {
        let one = |(name, x): (&String, &f64)| match self.ints.contains(name) {
            true => Some((name.clone(), *x)),
            false => Some((name.clone(), round(*x, name)?)),
        };
        inputs.iter().map(one).collect()
    }

    /// The case of the inputs as a format by its own name has them. What does not fit there
    /// is refused, as the case itself allows.
    fn among(
        &self,
        inputs: &Inputs,
        round: impl Fn(f64, &str) -> Option<f64>,
        rule: &Rule,
    ) -> Json {
        match self.rounded(inputs, round) {
            Some(rounded) => overlaid(self.case(&rounded, rule)),
            None => json!({}),
        }
    }

    /// The case of the inputs as a format has them, where they differ.
    fn overlay(&self, inputs: &Inputs, format: Arithmetic, rule: &Rule) -> Option<Json> {
        let Some(rounded) = self.rounded(inputs, |x, _| format.round(x)) else {
            // A float that cannot hold an input has to say so.
            return format.is_fixed().then(|| json!({"reason": "range"}));
        };
        if rounded == *inputs {
            return None;
        }
        let lost = |(name, x): (&String, &f64)| *x == 0.0 && inputs[name] != 0.0;
        if rounded.iter().any(lost) {
            return Some(json!({"reason": "zero"}));
        }
        Some(overlaid(self.case(&rounded, rule)))
    }

    /// The results of the stable formula, with such a roundoff; one of its operations
    /// may be moved.
    pub(super) fn results(
        &self,
        names: BTreeMap<String, Value>,
        u: Option<i32>,
        moved: Option<Move>,
    ) -> (Vec<Value>, Run<'static>) {
        let mut run = Run::new(names);
        run.names.insert(
            "u".to_owned(),
            Value::real(u.map_or(Big::new(0.0), Big::power)),
        );
        run.moved = moved;
        let mut results = run.body(&self.stable).list();
        if let [Value::Nothing] = results[..] {
            results = vec![Value::Nothing; self.outputs.len()];
        }
        if self.outputs.len() == 1 && results.len() > 1 {
            results = vec![Value::List(results)];
        }
        (results, run)
    }

    /// What is wanted of these inputs.
    pub fn case(&self, inputs: &Inputs, rule: &Rule) -> Case {
        let values = self.values(inputs);
        let (results, _) = self.results(values.clone(), self.u, None);
        let (rounded, run) = self.results(values.clone(), Some(-53), None);
        let (hi, lo) = run.seen.unwrap_or((0, 0));
        let lo = match rule {
            // Without a 0, what stands for it is the least number.
            Rule::Logarithms(_) if run.zero => i32::MIN,
            _ => lo,
        };
        let moves = Moves {
            kernel: self,
            values: &values,
            results: &rounded,
            trail: &run.trail,
        };
        let mut maker = Maker {
            run: Run::new(values.clone()),
            present: !matches!(results[0], Value::Nothing),
            quanta: moves.quanta(rule),
            undecided: moves.undecided(rule),
        };
        for (name, value) in self.outputs.iter().zip(&results) {
            maker.run.names.insert(name.clone(), value.clone());
        }
        if let Some((output, input)) = &self.slope {
            let slope = self.slope(&values, *output, input);
            maker
                .run
                .names
                .insert("slope".to_owned(), Value::real(slope));
        }
        maker.run.body(&self.lets);
        let inner = maker.predicate(&self.predicate);
        let expected = self
            .outputs
            .iter()
            .cloned()
            .zip(results.iter().map(written));
        Case {
            expected: expected.collect(),
            predicate: json!({"kind": "refuse_or", "hi": hi + 1, "lo": lo, "predicate": inner}),
        }
    }

    /// How an output moves with an input.
    fn slope(&self, values: &BTreeMap<String, Value>, output: usize, input: &str) -> Big {
        let step = Big::power(-60);
        let at = |by: &Big| {
            let mut names = values.clone();
            let moved = names[input].number().plus(by);
            names.insert(input.to_owned(), Value::real(moved));
            self.results(names, self.u, None).0[output].number().clone()
        };
        let difference = at(&step).minus(&at(&step.negated()));
        difference.over(&step.times(&Big::new(2.0)))
    }
}

fn overlaid(case: Case) -> Json {
    json!({"expected": case.expected, "predicate": case.predicate})
}

/// A result as a file of cases writes it.
fn written(value: &Value) -> Json {
    match value {
        Value::Number(x, true) => json!(x.near() as i64),
        Value::Number(x, false) => json!(x.digits()),
        Value::List(all) => all.iter().map(written).collect(),
        _ => Json::Null,
    }
}
