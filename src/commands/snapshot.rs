//! `snapshot`: what scenes compile to, draw and cost, kept beside them.

use crate::failure::{Failure, Outcome};
use crate::scene::{Changes, Scene, ScenesArgs};
use crate::snapshot::{self, State};
use crate::target_args::{self, ScreenArgs};
use crate::trial::{self, LIMIT, Trial};
use crate::{files, jobs, say, say_json};
use serde_json::{Value, json};
use slowlight_compiler::target::{TARGETS, Target};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// Options of `snapshot`.
#[derive(clap::Args, Debug)]
pub struct Args {
    #[command(flatten)]
    scenes: ScenesArgs,
    /// A machine; where none is named, those of which there are snapshots
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: Vec<&'static Target>,
    /// Write the snapshots that are new or changed
    #[arg(long)]
    accept: bool,
    /// The screen's mode, where the machine has several (see `slowlight targets`)
    #[arg(long, value_name = "N")]
    mode: Option<String>,
    /// Only these rows of the picture, both ends included
    #[arg(long, value_name = "A..B")]
    rows: Option<String>,
    /// Print what was found as JSON
    #[arg(long)]
    json: bool,
    /// Give a machine up after so many cycles
    #[arg(long, value_name = "CYCLES", default_value_t = LIMIT)]
    limit: u64,
}

/// One scene on one target.
struct Case<'a> {
    path: &'a Path,
    target: &'static Target,
    kept: PathBuf,
}

/// What became of it.
struct Found {
    trial: Trial,
    state: State,
    written: bool,
}

impl Found {
    fn differs_from_model(&self) -> usize {
        self.trial.from_model.as_ref().map_or(0, Vec::len)
    }

    fn word(&self) -> &'static str {
        match (&self.state, self.written) {
            (State::Unchanged { .. }, _) => "unchanged",
            (State::Missing, false) => "missing",
            (State::Missing, true) => "new",
            (State::Changed { .. }, false) => "changed",
            (State::Changed { .. }, true) => "accepted",
        }
    }

    /// Whether it is for the user to look at.
    fn is_wrong(&self) -> bool {
        matches!(self.word(), "missing" | "changed") || self.differs_from_model() > 0
    }
}

/// Makes the snapshots anew, and compares them with the kept ones or writes them.
pub fn run(args: &Args) -> Outcome<()> {
    let cases = cases(args)?;
    let found = jobs::each(&cases, |case| case.look(args))?;
    if args.json {
        let all: Vec<Value> = cases.iter().zip(&found).map(|(c, f)| c.json(f)).collect();
        say_json(&json!({ "snapshots": all }));
    } else {
        let out = std::io::stdout();
        let colour = out.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
        for (case, found) in cases.iter().zip(&found) {
            if let Ok(found) = found {
                say(&case.text(found, colour));
            }
        }
    }
    conclude(args, &cases, found)
}

/// Each scene on each target.
fn cases(args: &Args) -> Outcome<Vec<Case<'_>>> {
    let mut cases = Vec::new();
    for path in &args.scenes.scenes {
        let case = |target: &'static Target| Case {
            path,
            target,
            kept: snapshot::path(path, target.name),
        };
        if !args.target.is_empty() {
            cases.extend(args.target.iter().copied().map(case));
            continue;
        }
        let kept = TARGETS
            .iter()
            .copied()
            .map(case)
            .filter(|c| c.kept.exists());
        let before = cases.len();
        cases.extend(kept);
        if cases.len() == before {
            let shown = path.display();
            return Err(Failure::Usage(format!(
                "{shown} has no snapshots yet; `slowlight snapshot {shown} --target T --accept` \
                 writes the first"
            )));
        }
    }
    Ok(cases)
}

impl Case<'_> {
    fn look(&self, args: &Args) -> Outcome<Found> {
        let scene = Scene::open(self.path, &args.scenes.changes)?;
        let screen = ScreenArgs {
            mode: args.mode.clone(),
            rows: args.rows.clone(),
            ..ScreenArgs::default()
        };
        let plan = screen.plan(&scene, self.target, &[])?;
        let built = trial::build(&plan)?;
        let trial = trial::run(&scene, plan, &[], built.loaded, args.limit)?;
        let options = options(&args.scenes.changes, &screen);
        let text = snapshot::text(self.path, &scene, &options, &built.sources, &trial);
        let state = snapshot::compare(&self.kept, &text)?;
        let written = args.accept && state != (State::Unchanged { edited: false });
        if written {
            let dir = self.kept.parent().unwrap_or(Path::new("."));
            std::fs::create_dir_all(dir)
                .map_err(|e| Failure::Wrong(format!("cannot make {}: {e}", dir.display())))?;
            files::write(&self.kept, text.as_bytes())?;
        }
        Ok(Found {
            trial,
            state,
            written,
        })
    }

    fn text(&self, found: &Found, colour: bool) -> String {
        let mut out = format!("{:<10} {}", found.word(), self.kept.display());
        match &found.state {
            State::Unchanged { edited: true } => out.push_str(" (the scene's text is another)\n"),
            State::Changed { difference, edited } => {
                out.push_str(match edited {
                    true => " (the scene was edited)\n",
                    false => " (the scene is as it was)\n",
                });
                out.push_str(&match colour {
                    true => snapshot::coloured(difference),
                    false => difference.clone(),
                });
            }
            _ => out.push('\n'),
        }
        out
    }

    fn json(&self, found: &Outcome<Found>) -> Value {
        let mut out = json!({
            "scene": self.path.display().to_string(),
            "target": self.target.name,
            "snapshot": self.kept.display().to_string(),
            "status": "failed",
            "difference": null,
            "error": null,
            "run": null,
        });
        match found {
            Ok(found) => {
                out["status"] = found.word().into();
                out["run"] = json!(found.trial.report());
                if let State::Changed { difference, .. } = &found.state {
                    out["difference"] = difference.as_str().into();
                }
            }
            Err(failure) => out["error"] = failure.reason().into(),
        }
        out
    }
}

/// The options that change what comes out, as on the command line.
fn options(changes: &Changes, screen: &ScreenArgs) -> String {
    let mut all = vec![changes.text()];
    let screen = [("--mode", &screen.mode), ("--rows", &screen.rows)];
    for (option, value) in screen {
        all.extend(value.as_ref().map(|v| format!("{option} {v}")));
    }
    all.retain(|text| !text.is_empty());
    all.join(" ")
}

/// Says what is wrong, and answers with the gravest of it: a change before a
/// scene that could not be compiled.
fn conclude(args: &Args, cases: &[Case<'_>], found: Vec<Outcome<Found>>) -> Outcome<()> {
    let count = |word: &str| {
        let good = found.iter().flatten();
        good.filter(|f| f.word() == word).count()
    };
    let (missing, changed, total) = (count("missing"), count("changed"), cases.len());
    let wrong = found.iter().flatten().any(Found::is_wrong);
    let mut failed = None;
    for (case, found) in cases.iter().zip(found) {
        match found {
            Ok(found) if found.differs_from_model() > 0 => eprintln!(
                "error: {}: machine and model differ in {} pixels",
                case.kept.display(),
                found.differs_from_model()
            ),
            Ok(_) => {}
            Err(failure) => {
                let status = failure.status();
                failure.report();
                failed.get_or_insert(status);
            }
        }
    }
    if missing + changed > 0 {
        let counts = [("changed", changed), ("missing", missing)];
        let counts = counts.into_iter().filter(|(_, n)| *n > 0);
        let counts: Vec<String> = counts.map(|(word, n)| format!("{n} {word}")).collect();
        eprintln!("error: of {total} snapshots, {}", counts.join(", "));
        eprintln!("help: `{}` writes them", accepting(args));
    }
    match failed {
        _ if wrong => Err(Failure::Differs),
        Some(status) => Err(Failure::Several(status)),
        None => Ok(()),
    }
}

/// The command that accepts what was found.
fn accepting(args: &Args) -> String {
    let mut words = vec!["slowlight snapshot".to_owned()];
    let scenes = args.scenes.scenes.iter();
    words.extend(scenes.map(|path| path.display().to_string()));
    words.extend(args.target.iter().map(|t| format!("--target {}", t.name)));
    let screen = ScreenArgs {
        mode: args.mode.clone(),
        rows: args.rows.clone(),
        ..ScreenArgs::default()
    };
    words.push(options(&args.scenes.changes, &screen));
    words.retain(|w| !w.is_empty());
    words.join(" ") + " --accept"
}
