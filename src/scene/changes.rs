//! What the command line changes about a scene: params' values, what is folded, which
//! effects are left out.

use super::Precision;
use crate::failure::{Failure, Outcome, unknown};
use clap::Args;
use slowlight_compiler::sema::{self, Freeze, FunctionKind, Options, Program};
use slowlight_compiler::source::Diagnostic;
use std::path::PathBuf;

/// What is changed about a scene.
#[derive(Args, Clone, Debug, Default)]
pub struct Changes {
    /// Give a param another value, a state another start: eye=0.35,0.25,3.6 or heading=45deg
    #[arg(long, value_name = "PARAM=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// Work a param (or a state of a still picture) out beforehand, so that it costs no time but
    /// cannot be changed in the program: its name, or all
    #[arg(long, value_name = "PARAM|all")]
    pub freeze: Vec<String>,
    /// Leave an effect of the scene out: each call of it comes to its `else`
    #[arg(long, value_name = "EFFECT")]
    pub without: Vec<String>,
    /// Use this directory's *.scn as the library
    #[arg(long, value_name = "DIR", hide = true)]
    pub prelude: Option<PathBuf>,
}

impl Changes {
    /// As they are written on the command line; empty where nothing is changed.
    pub fn text(&self) -> String {
        let all = [
            ("--set", &self.set),
            ("--freeze", &self.freeze),
            ("--without", &self.without),
        ];
        let each = all.into_iter().flat_map(|(option, values)| {
            let one = move |value: &String| format!("{option} {value}");
            values.iter().map(one)
        });
        each.collect::<Vec<String>>().join(" ")
    }
}

/// What a program is lowered with.
///
/// # Errors
/// Where it has no such param or effect, or a value is none.
pub(super) fn options(args: &Changes, program: &Program) -> Outcome<Options> {
    let params = || program.params.iter().map(|p| p.name.as_str());
    let known = |name: &str| {
        if params().any(|p| p == name) {
            return Ok(());
        }
        let names: Vec<&str> = params().collect();
        let message = unknown(program.declared(), name, names.iter().copied());
        Err(Failure::Usage(message))
    };
    let mut set = Vec::new();
    for text in &args.set {
        let (name, values) = text
            .split_once('=')
            .ok_or_else(|| Failure::Usage(format!("--set {text}: write param=value")))?;
        known(name.trim())?;
        let values: Option<Vec<f64>> = values.split(',').map(scalar).collect();
        let values = values.ok_or_else(|| {
            let form = "numbers with commas between, angles in deg, turn or rad";
            Failure::Usage(format!("--set {text}: the value must be {form}"))
        })?;
        set.push((name.trim().to_owned(), values));
    }
    let mut names = args.freeze.iter().filter(|name| *name != "all");
    names.try_for_each(|name| known(name))?;
    let freeze = if args.freeze.iter().any(|f| f == "all") {
        Freeze::All
    } else if args.freeze.is_empty() {
        Freeze::Nothing
    } else {
        Freeze::Some(args.freeze.clone())
    };
    let effects: Vec<&str> = program
        .functions
        .iter()
        .filter(|f| matches!(f.kind, FunctionKind::Effect { .. }))
        .map(|f| f.name.as_str())
        .collect();
    for name in &args.without {
        if !effects.contains(&name.as_str()) {
            let message = unknown("effect", name, effects.iter().copied());
            return Err(Failure::Usage(message));
        }
    }
    Ok(Options {
        set,
        freeze,
        without: args.without.clone(),
        offset: Precision::NATIVE.offset,
        ..Options::default()
    })
}

/// Whether params can have the values that they are set to.
///
/// # Errors
/// What is wrong with the values; not with the params themselves, which is the scene's
/// affair.
pub(super) fn settable(program: &Program, options: &Options) -> Result<(), Vec<Diagnostic>> {
    let as_they_are = Options {
        set: Vec::new(),
        ..options.clone()
    };
    match sema::params(program, &as_they_are) {
        Ok(()) => sema::params(program, options),
        Err(_) => Ok(()),
    }
}

/// A number, `true`, `false`, or an angle with its unit, in radians.
fn scalar(text: &str) -> Option<f64> {
    let text = text.trim();
    let units = [
        ("deg", std::f64::consts::PI / 180.0),
        ("turn", std::f64::consts::TAU),
        ("rad", 1.0),
        ("", 1.0),
    ];
    match text {
        "true" => return Some(1.0),
        "false" => return Some(0.0),
        _ => {}
    }
    units.iter().find_map(|(unit, size)| {
        let number: f64 = text.strip_suffix(unit)?.trim_end().parse().ok()?;
        number.is_finite().then_some(number * size)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scalars_have_units() {
        assert_eq!(scalar(" -0.5"), Some(-0.5));
        assert_eq!(scalar("0.5turn"), Some(std::f64::consts::PI));
        assert_eq!(scalar("180 deg"), Some(std::f64::consts::PI));
        for wrong in ["", "nan", "inf", "1m", "1,2", "--1"] {
            assert_eq!(scalar(wrong), None, "{wrong}");
        }
    }
}
