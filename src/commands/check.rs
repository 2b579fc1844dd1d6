//! `check`: diagnostics, without anything else; and how hard cases are passed.

use crate::cases::{self, Way};
use crate::failure::{Failure, Outcome, unknown};
use crate::scene::{Precision, Scene, SceneArgs};
use crate::{diagnostics, files, say, say_json};
use serde_json::json;
use slowlight_compiler::source::{Diagnostic, Sources};
use slowlight_compiler::target::{TARGETS, find};
use std::path::{Path, PathBuf};

/// Options of `check`.
#[derive(clap::Args, Debug)]
pub struct Args {
    #[command(flatten)]
    scene: Option<SceneArgs>,
    /// Print the diagnostics, or how the cases were passed, as JSON
    #[arg(long)]
    json: bool,
    /// Try the kernels on a file of hard cases instead: natively, in every
    /// format's model, and on every machine
    #[arg(long, value_name = "FILE.json", conflicts_with = "scene")]
    cases: Option<PathBuf>,
    /// Only so: native, model, or a target's name
    #[arg(long, value_name = "TARGET", requires = "cases")]
    target: Vec<String>,
    /// Only in a format: f64 or a target's
    #[arg(long, value_name = "FORMAT", requires = "cases")]
    format: Vec<String>,
    /// With the textbook's forms of the kernels
    #[arg(long, hide = true, requires = "cases")]
    naive: bool,
}

/// Checks a scene down to its graph, or the kernels on hard cases.
pub fn run(args: &Args) -> Outcome<()> {
    match (&args.cases, &args.scene) {
        (Some(path), _) => try_cases(args, path),
        (None, Some(of)) => check(args, of),
        (None, None) => {
            let message = "check needs a scene, or --cases with a file of hard cases";
            Err(Failure::Usage(message.to_owned()))
        }
    }
}

/// Tries a file of hard cases in the ways asked for.
fn try_cases(args: &Args, path: &Path) -> Outcome<()> {
    let text = files::read_text(path)?;
    let file = cases::parse(&path.display().to_string(), &text)?;
    let all = cases::ways(TARGETS, false);
    for name in &args.target {
        let known = all.iter().map(|w| w.place());
        if wanted(&all, name).next().is_none() {
            return Err(Failure::Usage(unknown("target", name, known)));
        }
    }
    for name in &args.format {
        if !all.iter().any(|w| w.format() == name) {
            let known = all.iter().map(|w| w.format());
            return Err(Failure::Usage(unknown("format", name, known)));
        }
    }
    let asked = |way: &Way| {
        let names = &args.target;
        let target = names.is_empty()
            || names
                .iter()
                .any(|n| wanted(&all, n).any(|w| w.place() == way.place()));
        target && (args.format.is_empty() || args.format.iter().any(|f| f == way.format()))
    };
    let ways = cases::ways(TARGETS, args.target.is_empty());
    let ways: Vec<Way> = ways.into_iter().filter(asked).collect();
    let found = cases::run(&file, &ways, args.naive)?;
    match args.json {
        true => say_json(&cases::table::to_json(&found)),
        false => say(&cases::table::text(&found)),
    }
    match found.rows.iter().all(|row| row.verdict.passed) {
        true => Ok(()),
        false => Err(Failure::Cases),
    }
}

/// The ways that a name means; a family's name alone means its first target.
fn wanted<'w>(all: &'w [Way], name: &'w str) -> impl Iterator<Item = &'w Way> {
    let full = find(name).map_or(name, |target| target.name);
    all.iter().filter(move |way| way.place() == full)
}

fn check(args: &Args, of: &SceneArgs) -> Outcome<()> {
    let checked = Scene::load(of).and_then(|scene| {
        scene.graph(None, Precision::NATIVE)?;
        Ok(scene)
    });
    match checked {
        Ok(scene) => {
            let said = &scene.checked.diagnostics;
            if args.json {
                tell(&scene.checked.sources, said);
            } else {
                scene.warn();
                say(&match said.len() {
                    0 => format!("{}: nothing to remark\n", of.scene.display()),
                    1 => format!("{}: 1 warning\n", of.scene.display()),
                    n => format!("{}: {n} warnings\n", of.scene.display()),
                });
            }
            Ok(())
        }
        Err(Failure::Scene(said)) => {
            if args.json {
                tell(&said.sources, &said.diagnostics);
            }
            Err(Failure::Scene(said))
        }
        Err(other) => Err(other),
    }
}

fn tell(sources: &Sources, said: &[Diagnostic]) {
    say_json(&json!({ "diagnostics": diagnostics::to_json(sources, said) }));
}
