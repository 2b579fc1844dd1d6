//! A case computed from its inputs: what is wanted, and when a result passes.

use super::big::Big;
use super::parse::{Expr, Statement, body, expression};
use super::predicate::Maker;
use super::run::{Random, Run, Value};
use serde_json::{Map, Value as Json, json};
use slowlight::cases::format::Arithmetic;
use slowlight_routine::Format;
use std::collections::BTreeMap;

/// More operations than this are not moved one by one: fixed point is not judged there.
const MOST_MOVED: usize = 300;

/// Inputs, as f64 has them.
pub type Inputs = BTreeMap<String, f64>;

/// A kernel, with its formula and how it varies.
pub struct Kernel {
    stable: Vec<Statement>,
    outputs: Vec<String>,
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

    fn values(&self, inputs: &Inputs) -> BTreeMap<String, Value> {
        let value = |(name, x): (&String, &f64)| {
            let value = Value::Number(Big::new(*x), self.ints.contains(name));
            (name.clone(), value)
        };
        inputs.iter().map(value).collect()
    }

    /// A vector of the same kind.
    pub fn varied(&self, vector: &Json, time: u64, random: &mut Random) -> Json {
        let inputs = self.inputs(vector);
        let mut run = Run::new(self.values(&inputs));
        run.random = Some(random);
        run.body(&self.vary);
        let new = |name: &String| (name.clone(), run.names[name].number().near());
        let inputs: Inputs = inputs.keys().map(new).collect();
        let case = self.case(&inputs);
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
        for (key, name, format) in [
            ("expected_by_bits", "14", float),
            ("expected_by_bits", "32", Format::Real40),
            ("expected_by_quantum", "16.16", fixed),
        ] {
            if let Some(overlay) = self.overlay(&inputs, Arithmetic::Of(format)) {
                made[key][name] = overlay;
            }
        }
        made
    }

    /// The case of the inputs as a format has them, where they differ.
    fn overlay(&self, inputs: &Inputs, format: Arithmetic) -> Option<Json> {
        let round = |(name, x): (&String, &f64)| match self.ints.contains(name) {
            true => Some((name.clone(), *x)),
            false => Some((name.clone(), format.round(*x)?)),
        };
        let rounded: Option<Inputs> = inputs.iter().map(round).collect();
        let Some(rounded) = rounded else {
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
        let case = self.case(&rounded);
        Some(json!({"expected": case.expected, "predicate": case.predicate}))
    }

    /// The results of the stable formula, with such a roundoff; one of its operations
    /// may be moved.
    fn results(
        &self,
        names: BTreeMap<String, Value>,
        u: Option<i32>,
        moved: Option<(usize, Big)>,
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
    pub fn case(&self, inputs: &Inputs) -> Case {
        let values = self.values(inputs);
        let (results, _) = self.results(values.clone(), self.u, None);
        let (rounded, run) = self.results(values.clone(), Some(-53), None);
        let (hi, lo) = run.seen.unwrap_or((0, 0));
        let mut maker = Maker {
            run: Run::new(values.clone()),
            present: !matches!(results[0], Value::Nothing),
            quanta: self.quanta(&values, &rounded, run.operations),
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

    /// By output, in last places, how far fixed point may be off: the sum of what every
    /// operation moves it by when its own result moves by one, half of that more, and one
    /// for its own. Not where there are very many.
    fn quanta(
        &self,
        values: &BTreeMap<String, Value>,
        results: &[Value],
        operations: usize,
    ) -> BTreeMap<String, f64> {
        let mut sums = vec![0f64; self.outputs.len()];
        if operations > MOST_MOVED {
            return BTreeMap::new();
        }
        for quantum in [Big::power(-8), Big::power(-16)] {
            let mut sum = vec![0.0; sums.len()];
            for operation in 0..operations {
                let mut most = vec![0f64; sums.len()];
                for by in [quantum.clone(), quantum.negated()] {
                    let moved = self.moved(values, operation, by);
                    for (k, (there, here)) in moved.iter().zip(results).enumerate() {
                        if let (Value::Number(a, false), Value::Number(b, false)) = (there, here) {
                            let part = a.minus(b).magnitude().over(&quantum).near();
                            most[k] = most[k].max(part);
                        }
                    }
                }
                sum.iter_mut()
                    .zip(most)
                    .for_each(|(sum, most)| *sum += most);
            }
            let both = sums.iter_mut().zip(sum);
            both.for_each(|(greater, sum)| *greater = greater.max(sum));
        }
        let all = self.outputs.iter().cloned().zip(sums);
        all.map(|(name, sum)| (name, (1.5 * sum + 1.0).ceil()))
            .collect()
    }

    /// The results where an operation's is moved; none where another then has no meaning.
    fn moved(&self, values: &BTreeMap<String, Value>, operation: usize, by: Big) -> Vec<Value> {
        let (results, run) = self.results(values.clone(), Some(-53), Some((operation, by)));
        if run.senseless { Vec::new() } else { results }
    }
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
