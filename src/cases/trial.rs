//! Trying every vector in every way asked for.

use super::file::{CaseFile, Overlay, Vector};
use super::format::{self, Arithmetic, Key};
use super::judge::{Got, Judge, Verdict};
use super::kernel::Kernel;
use super::lose;
use super::machine;
use super::watch;
use crate::failure::{Failure, Outcome};
use crate::interrupt;
use crate::progress::Progress;
use crate::scene::Precision;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::ir::graph::{Graph, Param, ParamId};
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::plan::{Goal, Plan};
use slowlight_compiler::planner::plan_as_written;
use slowlight_compiler::source::Diagnostic;
use slowlight_compiler::targets::{Target, default_mode};
use slowlight_routine::{Format, Type, Value};
use std::collections::{BTreeMap, btree_map};

/// A way to try a vector.
#[derive(Clone, Copy, Debug)]
pub enum Way {
    /// The native evaluation.
    Native,
    /// A target's format, in its model.
    Model(&'static Target),
    /// A target's machine.
    Machine(&'static Target),
}

impl Way {
    /// The arithmetic.
    pub fn arithmetic(self) -> Arithmetic {
        match self {
            Way::Native => Arithmetic::Native,
            Way::Model(target) | Way::Machine(target) => Arithmetic::of(target),
        }
    }

    /// The format's name.
    pub fn format(self) -> &'static str {
        match self {
            Way::Native => "f64",
            Way::Model(target) | Way::Machine(target) => target.runtime.format,
        }
    }

    /// What computes: `native`, `model`, or the machine.
    pub fn place(self) -> &'static str {
        match self {
            Way::Native => "native",
            Way::Model(_) => "model",
            Way::Machine(target) => target.name,
        }
    }

    fn precision(self) -> Precision {
        let own = match self {
            Way::Native => Precision::NATIVE,
            Way::Model(target) | Way::Machine(target) => Precision::of(target),
        };
        // By what steps end and rays begin has to be told apart in the bits that values have.
        Precision {
            epsilon: self.arithmetic().epsilon(),
            ..own
        }
    }
}

/// A vector tried in one way.
#[derive(Clone, Debug)]
pub struct Row {
    /// The vector's.
    pub id: String,
    /// Its family.
    pub family: String,
    /// How it was tried.
    pub way: Way,
    /// The result; none where the kernel cannot be compiled, or its machine failed.
    pub got: Got,
    /// Why there is no result.
    pub failure: Option<String>,
    /// The outputs' names.
    pub outputs: Vec<String>,
    /// How it was judged.
    pub verdict: Verdict,
}

/// What was tried.
#[derive(Debug, Default)]
pub struct Rows {
    /// In the order of ways, then of the file.
    pub rows: Vec<Row>,
    /// How many say nothing in their format.
    pub skipped: usize,
}

/// The native evaluation, the model of every format, and every machine; with
/// `one`, of the machines that share a format the first.
pub fn ways(targets: &[&'static Target], one: bool) -> Vec<Way> {
    let mut all = vec![Way::Native];
    let mut seen = Vec::new();
    for target in targets {
        let first = !seen.contains(&target.runtime.format);
        if first {
            seen.push(target.runtime.format);
            all.push(Way::Model(target));
        }
        if first || !one {
            all.push(Way::Machine(target));
        }
    }
    all
}

/// Whether a way's machine reports numbers: of those around a 6502 the plain one does, and
/// the others compute the same.
pub fn knows(way: Way) -> bool {
    !matches!(way.place(), "6502:bbc" | "6502:c64")
}

/// Tries every vector of a file in every way.
///
/// # Errors
/// Where the file does not fit together, or somebody interrupts.
pub fn run(file: &CaseFile, ways: &[Way], naive: bool) -> Outcome<Rows> {
    let mut kernels: BTreeMap<(&str, &str), Kernel> = BTreeMap::new();
    let progress = Progress::new("cases", (file.vectors.len() * ways.len()) as u64);
    let mut found = Rows::default();
    for &way in ways {
        let mut graphs: BTreeMap<(&str, &str, String), Prepared> = BTreeMap::new();
        for vector in &file.vectors {
            if interrupt::pressed() {
                return Err(Failure::Interrupted);
            }
            progress.step(1);
            let overlay = overlay(vector, way);
            if overlay.map_or(!is_usual(way), |o| o.reason.is_some()) {
                found.skipped += 1;
                continue;
            }
            let key = (vector.family(), vector.entry.as_str());
            let entry = file.families.get(key.0).and_then(|f| f.entry.get(key.1));
            let Some(entry) = entry else {
                let message = format!("{}: no family has the kernel `{}`", vector.id, vector.entry);
                return Err(Failure::Wrong(message));
            };
            let kernel = match kernels.entry(key) {
                btree_map::Entry::Occupied(found) => found.into_mut(),
                btree_map::Entry::Vacant(free) => {
                    free.insert(Kernel::new(key.1, entry, vector, naive)?)
                }
            };
            // Where points are planned, a plan is for what its params may be.
            let params = Some(&vector.params).filter(|_| way.arithmetic().is_planned());
            let said = params.map_or(String::new(), |params| format!("{params:?}"));
            let prepared = graphs
                .entry((key.0, key.1, said))
                .or_insert_with(|| Prepared::new(kernel, way, key.1, params));
            let (got, failure) = match prepared.run(kernel, vector, &entry.ints) {
                Ok(got) => (got, None),
                Err(Failure::Interrupted) => return Err(Failure::Interrupted),
                Err(why) => (Got::default(), Some(words(&why))),
            };
            let wanted = vector.wanted(overlay);
            let judge = Judge {
                arithmetic: way.arithmetic(),
                outputs: &entry.outputs,
                got: &got,
                wanted: &wanted,
            };
            let mut verdict = judge.verdict();
            verdict.passed &= failure.is_none();
            found.rows.push(Row {
                id: vector.id.clone(),
                family: vector.family().to_owned(),
                way,
                got,
                failure,
                outputs: entry.outputs.clone(),
                verdict,
            });
        }
    }
    Ok(found)
}

/// What a case has to say of a format's rounding.
fn overlay(vector: &Vector, way: Way) -> Option<&Overlay> {
    match way.arithmetic().key() {
        Key::Bits(bits) => vector.expected_by_bits.get(bits),
        Key::Quantum(quantum) => vector.expected_by_quantum.get(quantum),
        Key::Name => vector.expected_by_format.get(way.format()),
    }
}

/// Whether a vector as it stands says what is right where no input is rounded: formats by
/// their own names round nearly all of them, or have them in places that a file must give.
fn is_usual(way: Way) -> bool {
    way.arithmetic().key() != Key::Name
}

fn words(why: &Failure) -> String {
    match why {
        Failure::Scene(said) | Failure::Options(said) => {
            let all = said.diagnostics.iter().map(|d| d.message.as_str());
            all.collect::<Vec<_>>().join("; ")
        }
        Failure::Wrong(message) | Failure::Usage(message) => message.clone(),
        Failure::TooLarge(large) => large.text.clone(),
        Failure::Cases | Failure::Several(_) => "a case does not pass".to_owned(),
        Failure::Differs => "the machine differs from the model".to_owned(),
        Failure::Interrupted => "interrupted".to_owned(),
    }
}

/// A kernel compiled for one way, or why it cannot be.
enum Prepared {
    Native(Box<Graph>),
    Plan(Way, Box<Plan>),
    Not(String),
    /// The planner says that a param does not fit.
    Refused(String),
}

impl Prepared {
    fn new(
        kernel: &Kernel,
        way: Way,
        name: &str,
        params: Option<&BTreeMap<String, [f64; 3]>>,
    ) -> Prepared {
        let graph = match kernel.graph(way.precision(), way.arithmetic().is_fixed(), params) {
            Ok(graph) => graph,
            Err(why) => return Prepared::Not(words(&why)),
        };
        let target = match way {
            Way::Native => return Prepared::Native(Box::new(graph)),
            Way::Model(target) | Way::Machine(target) => target,
        };
        let Some(mode) = default_mode(target, 1, 1) else {
            return Prepared::Not(format!("{} has no screen", target.name));
        };
        let goal = Goal {
            name: name.to_owned(),
            mode,
            rows: None,
            plot: false,
        };
        // The kernels are judged, not what the compiler makes of them.
        match plan_as_written(&graph, target, &goal) {
            Ok(plan) => Prepared::Plan(way, Box::new(plan.plan)),
            Err(said) => {
                let all: Vec<&str> = said.iter().map(|d| d.message.as_str()).collect();
                // All else that a planner has to say is its own fault.
                let params = said.iter().all(|d| is_of_param(d, &graph, target));
                match way.arithmetic().is_planned() && params {
                    true => Prepared::Refused(all.join("; ")),
                    false => Prepared::Not(all.join("; ")),
                }
            }
        }
    }

    /// The format of its params that are reals.
    fn real(&self) -> Option<Format> {
        match self {
            Prepared::Plan(_, plan) => Some(plan.runtime.real),
            _ => None,
        }
    }

    /// The kernel's result for a vector's inputs.
    fn run(&mut self, kernel: &Kernel, vector: &Vector, ints: &[String]) -> Outcome<Got> {
        let arithmetic = match self {
            Prepared::Native(_) => Arithmetic::Native,
            Prepared::Plan(way, _) => way.arithmetic(),
            Prepared::Not(why) => return Err(Failure::Wrong(why.clone())),
            Prepared::Refused(why) => {
                return Ok(Got {
                    left: Some(why.clone()),
                    ..Got::default()
                });
            }
        };
        let mut inputs = Vec::new();
        for name in &kernel.inputs {
            let input = vector.inputs.get(name).map_or("", |i| &i.dec);
            let Ok(exact) = input.parse::<f64>() else {
                let message = format!("{}: `{input}` is no number", vector.id);
                return Err(Failure::Wrong(message));
            };
            let whole = ints.contains(name);
            let value = match self.real() {
                _ if whole => Some(exact),
                Some(Format::Scaled { bits }) => {
                    let [_, least, greatest] = vector.params.get(name).copied().unwrap_or_default();
                    format::placed(exact, least.abs().max(greatest.abs()), bits)
                }
                _ => arithmetic.round(exact),
            };
            match value {
                Some(x) if whole => inputs.push(Value::Int(x as i32)),
                Some(x) => inputs.push(Value::Real(x)),
                None => {
                    let left = Some(format!("{name} = {input} does not fit the format"));
                    return Ok(Got {
                        left,
                        ..Got::default()
                    });
                }
            }
        }
        match self {
            Prepared::Native(graph) => {
                set(graph, &inputs);
                let values = {
                    let mut native = Native::new(graph);
                    native.pixel(0, 0);
                    native.reports()
                };
                Ok(taken(kernel, &values, watch::native(graph)))
            }
            Prepared::Plan(way, plan) => {
                let (Way::Model(target) | Way::Machine(target)) = *way else {
                    return Err(Failure::Wrong("a plan has a target".to_owned()));
                };
                set(&mut plan.graph, &inputs);
                let format = plan.runtime.real;
                let ids = 0..plan.params.len() as u32;
                let places: Vec<Format> = ids.map(|k| plan.param_format(ParamId(k))).collect();
                for ((param, value), place) in plan.params.iter_mut().zip(&inputs).zip(places) {
                    machine::give(param, *value, format::bits(target, *value, place), target);
                }
                let mut model = ModelRun::new(plan);
                model.pixel(0, 0);
                let bits = model.reports();
                let reports = plan.graph.reports.iter();
                let decoded = reports.zip(&bits).map(|(&id, &bits)| {
                    let place = plan.format(id);
                    // A constant is read in its place.
                    let held = plan.graph.constant(id);
                    let bits = held.map_or(bits, |value| (plan.runtime.encode)(value, place));
                    (plan.runtime.decode)(bits, place)
                });
                let values: Vec<Value> = decoded.collect();
                if matches!(way, Way::Machine(_)) && machine::run(plan)? != values {
                    return Err(Failure::Differs);
                }
                let mut got = taken(kernel, &values, watch::plan(plan));
                got.values
                    .iter_mut()
                    .for_each(|x| *x = format::worth(format, *x));
                if got.left.is_none()
                    && let Some(lost) = lose::lost(plan)
                {
                    got.left = lost.first;
                    got.lossy = Some(Box::new(taken(kernel, &lost.reports, None)));
                }
                Ok(got)
            }
            Prepared::Not(why) | Prepared::Refused(why) => Err(Failure::Wrong(why.clone())),
        }
    }
}

/// Whether a diagnostic says that a param is beyond what a target's may be.
fn is_of_param(said: &Diagnostic, graph: &Graph, target: &Target) -> bool {
    let beyond = |p: &Param| {
        let ends = p.range.map_or(0.0, |range| range.magnitude());
        p.span == said.span && p.value.abs().max(ends) > target.runtime.param_most
    };
    graph.params.iter().any(beyond)
}

fn set(graph: &mut Graph, inputs: &[Value]) {
    for (param, value) in graph.params.iter_mut().zip(inputs) {
        debug_assert!(param.ty != Type::Bool);
        param.value = value.real();
    }
}

/// What was reported, as the kernel's result.
fn taken(kernel: &Kernel, values: &[Value], left: Option<String>) -> Got {
    let (there, values) = match (kernel.optional, values.split_first()) {
        (true, Some((there, rest))) => (there.truth(), rest),
        _ => (true, values),
    };
    Got {
        there,
        values: values.iter().map(|v| v.real()).collect(),
        left,
        lossy: None,
    }
}
