//! A kernel as a scene: its inputs are params, so that nothing is folded, and
//! its results are what the graph reports.
//!
//! The kernels themselves are a library in the scene language,
//! `kernels/`, which calls the prelude wherever the prelude has the
//! thing. There `case_NAME` is the kernel NAME of a file; a result of several
//! parts is the record `NAME_result`, and a list of cells one record of them.

use super::file::{Argument, Entry, Vector};
use crate::failure::{Failure, Outcome};
use crate::scene::{Precision, wrong};
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::scene::{self, Scene};
use slowlight_compiler::sema::Options;
use slowlight_routine::Range;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The kernels by stable forms, and those by the textbook's.
const STABLE: &str = include_str!("kernels/stable.scn");
const NAIVE: &str = include_str!("kernels/naive.scn");

/// The greatest magnitude that a fixed-point param may be said to have.
const FIXED_MOST: f64 = 32767.0;

/// A kernel ready to be lowered for any format.
pub struct Kernel {
    scene: Scene,
    /// Whether its result may be absent.
    pub optional: bool,
    /// Its inputs' names, in the params' order.
    pub inputs: Vec<String>,
}

/// What a signature says.
struct Signature<'s> {
    name: &'s str,
    params: Vec<&'s str>,
    result: String,
    optional: bool,
}

fn signature(sig: &str) -> Option<Signature<'_>> {
    let (name, rest) = sig.split_once('(')?;
    let (params, result) = rest.split_once(") ->")?;
    let params = params.split(',').map(|p| {
        let (name, _) = p.split_once(':')?;
        Some(name.trim())
    });
    let result = result.trim();
    let (result, optional) = match result.strip_suffix('?') {
        Some(rest) => (rest, true),
        None => (result, false),
    };
    // `t: real`, `vec3`, `(a: real, b: int)`, `cells: [(int, int)]`.
    let bare = result.split_once(':').map_or(result, |(_, ty)| ty.trim());
    let result = match result.starts_with('(') || bare.starts_with('[') {
        true => format!("{name}_result"),
        false => bare.to_owned(),
    };
    Some(Signature {
        name,
        params: params.collect::<Option<Vec<_>>>()?,
        result,
        optional,
    })
}

/// A scalar argument in the scene: a decimal, or an input with its sign.
fn scalar(text: &str, inputs: &[String]) -> Option<String> {
    if let Ok(number) = text.parse::<f64>() {
        return number.is_finite().then(|| format!("{number:?}"));
    }
    let (sign, name) = match text.strip_prefix('-') {
        Some(name) => ("-", name),
        None => ("", text),
    };
    let known = inputs.iter().any(|i| i == name);
    known.then(|| format!("{sign}in_{name}"))
}

fn argument(argument: &Argument, inputs: &[String]) -> Option<String> {
    match argument {
        Argument::One(text) => {
            let whole = text.parse::<i32>().ok().map(|i| i.to_string());
            whole.or_else(|| scalar(text, inputs))
        }
        Argument::Many(parts) => {
            let parts: Option<Vec<String>> = parts.iter().map(|p| scalar(p, inputs)).collect();
            Some(format!("({})", parts?.join(", ")))
        }
    }
}

/// The scene's text.
fn text(entry: &Entry, inputs: &[String]) -> Option<(String, bool)> {
    let identifier = |name: &String| {
        !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
    };
    let sig = signature(&entry.sig)?;
    let args = sig.params.iter().map(|p| {
        let found = entry.args.get(*p)?;
        argument(found, inputs)
    });
    let args: Vec<String> = args.collect::<Option<_>>()?;
    if !inputs.iter().all(identifier) {
        return None;
    }
    let mut text = "use \"kernels.scn\";\nimage 1 x 1 inks black, white;\n".to_owned();
    for input in inputs {
        let ty = match entry.ints.contains(input) {
            true => "int",
            false => "real",
        };
        writeln!(text, "param in_{input}: {ty} = 0;").ok()?;
    }
    let question = if sig.optional { "?" } else { "" };
    let (name, result) = (sig.name, sig.result);
    writeln!(
        text,
        "fn report() -> {result}{question} = case_{name}({});",
        args.join(", ")
    )
    .ok()?;
    writeln!(text, "draw (x, y) = ink(0);").ok()?;
    Some((text, sig.optional))
}

impl Kernel {
    /// The kernel of an entry; `naive` takes the textbook's form of it.
    ///
    /// # Errors
    /// Where the entry is of no known form, or there is no such kernel.
    pub fn new(name: &str, entry: &Entry, vector: &Vector, naive: bool) -> Outcome<Kernel> {
        let inputs: Vec<String> = vector.inputs.keys().cloned().collect();
        let Some((text, optional)) = text(entry, &inputs) else {
            let message = format!(
                "`{name}`: its signature `{}` or arguments are of no known form",
                entry.sig
            );
            return Err(Failure::Wrong(message));
        };
        let kernels = if naive { NAIVE } else { STABLE };
        let mut read = |_: &str, _: &str| Ok(("kernels.scn".to_owned(), kernels.to_owned()));
        let scene = scene::load(&format!("{name}.scn"), &text, None, &mut read);
        match scene.is_right() {
            true => Ok(Kernel {
                scene,
                optional,
                inputs,
            }),
            false => Err(wrong(scene.sources, scene.diagnostics)),
        }
    }

    /// Its graph in a format; in fixed point its inputs may be anything that fits, or what
    /// `params` say (the usual value, the least, the greatest).
    ///
    /// # Errors
    /// Where it does not compile.
    pub fn graph(
        &self,
        precision: Precision,
        fixed: bool,
        params: Option<&BTreeMap<String, [f64; 3]>>,
    ) -> Outcome<Graph> {
        let options = Options {
            offset: precision.offset,
            epsilon: precision.epsilon,
            floats: precision.floats,
            mantissas: precision.mantissas,
            report: Some("report".to_owned()),
            ..Options::default()
        };
        let found = self.scene.lower(&options);
        let mut graph = found.map_err(|said| wrong(self.scene.sources.clone(), said))?;
        if fixed {
            for param in &mut graph.params {
                param.range = Some(Range::new(-FIXED_MOST, FIXED_MOST));
            }
        }
        if let Some(params) = params {
            for (param, name) in graph.params.iter_mut().zip(&self.inputs) {
                let Some([usual, least, greatest]) = params.get(name) else {
                    let message = format!("nobody says how large `{name}` may become");
                    return Err(Failure::Wrong(message));
                };
                (param.value, param.usual) = (*usual, *usual);
                param.range = Some(Range::new(*least, *greatest));
            }
        }
        Ok(graph)
    }
}
