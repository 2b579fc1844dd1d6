//! `check`: diagnostics, and where a scene is numerically fragile in the
//! targets' formats; and how hard cases are passed.

use crate::cases::{self, Way};
use crate::colours;
use crate::draw::Window;
use crate::failure::{Failure, Outcome, unknown};
use crate::precise::{self, Fared};
use crate::scene::{Changes, Precision, Scene};
use crate::target_args::{ScreenArgs, target};
use crate::together::together;
use crate::{diagnostics, files, inks, say, say_json};
use serde_json::json;
use slowlight_compiler::report::domain;
use slowlight_compiler::source::Diagnostic;
use slowlight_compiler::targets::{TARGETS, Target, find, formats, in_all_formats};
use std::path::{Path, PathBuf};

/// Options of `check`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The scene's file; - is standard input
    scene: Option<PathBuf>,
    #[command(flatten)]
    changes: Changes,
    /// Print the diagnostics, or how the cases were passed, as JSON
    #[arg(long)]
    json: bool,
    /// Instead of a scene, try the library's formulas on a file of hard cases: natively, in
    /// every format's model, and on every machine (docs/hard-cases.md)
    #[arg(long, value_name = "FILE.json", conflicts_with = "scene")]
    cases: Option<PathBuf>,
    /// Only for a machine, as in jack or 6502 [default: one for each format]; with --cases also
    /// native and model
    #[arg(short, long, value_name = "TARGET")]
    target: Vec<String>,
    /// Only in a format, as in log10; with --cases also f64
    #[arg(long, value_name = "FORMAT")]
    format: Vec<String>,
    /// Only what is wrong with the scene itself, without looking at any machine's format
    #[arg(long, conflicts_with_all = ["cases", "target", "format"])]
    quick: bool,
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
    let every: Vec<&'static Target> = in_all_formats().collect();
    let mut all = cases::ways(&every, false);
    all.retain(|way| cases::knows(*way));
    for name in &args.target {
        let known = all.iter().map(|w| w.place());
        if wanted(&all, name).next().is_none() {
            return Err(Failure::Usage(unknown("target", name, known)));
        }
    }
    for name in &args.format {
        if !all.iter().any(|w| w.format() == name) {
            let mut known: Vec<&str> = all.iter().map(|w| w.format()).collect();
            known.dedup();
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
    // The usual formats, unless others are asked for.
    let targets = if args.format.is_empty() {
        TARGETS
    } else {
        &every
    };
    let mut ways = cases::ways(targets, args.target.is_empty());
    ways.retain(|way| cases::knows(*way));
    let ways: Vec<Way> = ways.into_iter().filter(asked).collect();
    let found = cases::run(&file, &ways, args.naive)?;
    if found.rows.is_empty() && found.skipped > 0 {
        let message = "the file says of no vector what is right there (`expected_by_format`)";
        return Err(Failure::Wrong(message.to_owned()));
    }
    match args.json {
        true => say_json(&cases::table::to_json(&found)),
        false => say(&cases::table::text(&found)),
    }?;
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

/// The targets whose formats a scene is looked at in.
fn targets(args: &Args) -> Outcome<Vec<&'static Target>> {
    if args.quick {
        return Ok(Vec::new());
    }
    let named = args.target.iter().map(|n| target(n));
    let named: Vec<&'static Target> = named.collect::<Result<_, _>>().map_err(Failure::Usage)?;
    let usual = args.format.is_empty();
    let all = match (named.is_empty(), usual) {
        (true, true) => precise::formats(TARGETS.iter().copied()),
        (true, false) => precise::formats(in_all_formats()),
        (false, true) => named,
        (false, false) => named.into_iter().flat_map(formats).collect(),
    };
    for name in &args.format {
        if !all.iter().any(|t| t.runtime.format == name) {
            let known = all.iter().map(|t| t.runtime.format);
            return Err(Failure::Usage(unknown("format", name, known)));
        }
    }
    let wanted =
        |t: &&Target| args.format.is_empty() || args.format.iter().any(|f| f == t.runtime.format);
    Ok(all.into_iter().filter(wanted).collect())
}

fn check(args: &Args, of: &Path) -> Outcome<()> {
    let targets = targets(args)?;
    let checked = Scene::open(of, &args.changes).and_then(|scene| {
        let graph = scene.graph(None, Precision::NATIVE)?;
        let zero = domain::warnings(&graph, &scene.checked.sources);
        let beyond = inks::warnings(&scene, &screens(&scene, &targets)?, whole(&scene))?;
        let fared = precise::look(&scene, &targets)?;
        let mut said = zero;
        said.extend(beyond);
        said.extend(domain::clamped(&graph, &scene.checked.sources));
        let narrow = targets.iter().find(|t| t.runtime.int.bits() < 32);
        said.extend(narrow.and_then(|t| domain::int_warning(&graph, &scene.checked.sources, t)));
        // Of machines that are asked for: most scenes are not for all.
        if !args.target.is_empty() {
            said.extend(colours::warnings(&scene, &targets));
        }
        Ok((scene, said, fared))
    });
    match checked {
        Ok((scene, said, fared)) => report(args, of, &scene, &said, &fared),
        Err(failure) => {
            if let (true, Failure::Scene(said) | Failure::Options(said)) = (args.json, &failure) {
                let found = diagnostics::to_json(&said.sources, &said.diagnostics);
                say_json(&json!({ "diagnostics": found }))?;
            }
            Err(failure)
        }
    }
}

fn whole(scene: &Scene) -> Window {
    let (width, height) = scene.size();
    Window::whole(width, height)
}

/// The screens of some targets in their best modes, and the picture's own inks.
fn screens(scene: &Scene, targets: &[&'static Target]) -> Outcome<Vec<inks::Screen>> {
    let own = ("the picture".to_owned(), None);
    let mut all = vec![own];
    for target in targets {
        let mode = ScreenArgs::default().mode(target, scene)?;
        all.push((target.name.to_owned(), Some(mode.inks)));
    }
    Ok(all)
}

fn report(
    args: &Args,
    of: &Path,
    scene: &Scene,
    more: &[Diagnostic],
    fared: &[Fared],
) -> Outcome<()> {
    let sources = &scene.checked.sources;
    let weak = fared.iter().flat_map(|f| &f.said);
    let said: Vec<Diagnostic> = scene
        .checked
        .diagnostics
        .iter()
        .chain(more)
        .chain(weak)
        .cloned()
        .collect();
    let said = together(said);
    if args.json {
        let found = diagnostics::to_json(sources, &said);
        return say_json(&json!({ "diagnostics": found, "formats": precise::to_json(fared) }));
    }
    if !said.is_empty() {
        diagnostics::print(sources, &said);
    }
    let unseen = precise::unseen(fared);
    let remarks = match (said.len(), &unseen) {
        (0, None) => Some("nothing to remark".to_owned()),
        (0, Some(_)) => None,
        (1, _) => Some("1 warning".to_owned()),
        (n, _) => Some(format!("{n} warnings")),
    };
    let remarks: Vec<String> = remarks.into_iter().chain(unseen).collect();
    say(&format!("{}: {}\n", of.display(), remarks.join("; ")))?;
    match fared.is_empty() {
        true => Ok(()),
        false => say(&precise::text(fared)),
    }
}
