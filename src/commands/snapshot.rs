//! `snapshot`: what scenes compile to, draw and cost, kept beside them.

use crate::auto_format;
use crate::failure::{Failure, Outcome};
use crate::given::{Given, quoted};
use crate::output::{self, remark};
use crate::scene::{Changes, Scene, is_standard_input};
use crate::snapshot::{self, State};
use crate::target_args::{self, ScreenArgs};
use crate::trial::{self, LIMIT, Trial};
use crate::{files, jobs, say, say_json};
use serde_json::{Value, json};
use slowlight_compiler::targets::{TARGETS, Target};
use std::path::{Path, PathBuf};

/// Options of `snapshot`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The scenes' files
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// A machine, as in jack or 6502:c64; said again, more; where none is named, those of which
    /// there are snapshots
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: Vec<&'static Target>,
    /// Write the snapshots that are new or changed
    #[arg(long)]
    accept: bool,
    #[command(flatten)]
    making: Given<Making>,
    /// Take no options from the kept snapshots: make them with those given here alone
    #[arg(long)]
    anew: bool,
    /// Print what was found as JSON
    #[arg(long)]
    json: bool,
    /// Give a machine up after so many cycles
    #[arg(long, value_name = "CYCLES", default_value_t = LIMIT)]
    limit: u64,
}

/// What a snapshot is made with: kept in it, and taken from it where none of these is given.
#[derive(clap::Args, Clone, Debug, Default)]
struct Making {
    #[command(flatten)]
    changes: Changes,
    #[command(flatten)]
    screen: ScreenArgs,
    /// Keep all that was generated, not only its digest and an excerpt
    #[arg(long)]
    full: bool,
}

/// One scene on one target.
struct Case<'a> {
    path: &'a Path,
    target: &'static Target,
    kept: PathBuf,
    /// The options that it is made with.
    making: Given<Making>,
    /// Those of the kept snapshot, where they are others.
    other: Option<String>,
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
        say_json(&json!({ "snapshots": all }))?;
    } else {
        let colour = output::coloured();
        for (case, found) in cases.iter().zip(&found) {
            if let Ok(found) = found {
                say(&case.text(found, colour))?;
            }
        }
    }
    conclude(args, &cases, found)
}

/// Each scene on each target.
fn cases(args: &Args) -> Outcome<Vec<Case<'_>>> {
    let mut cases = Vec::new();
    for path in &args.scenes {
        if is_standard_input(path) {
            let message = "snapshots are kept beside the scene: give its file, not standard input";
            return Err(Failure::Usage(message.to_owned()));
        }
        let kept = |target: &&'static Target| snapshot::path(path, target.name).exists();
        let targets: Vec<&'static Target> = match args.target.is_empty() {
            true => TARGETS.iter().copied().filter(kept).collect(),
            false => args.target.clone(),
        };
        for target in &targets {
            cases.push(case(args, path, target)?);
        }
        if targets.is_empty() {
            let shown = path.display();
            return Err(Failure::Usage(format!(
                "{shown} has no snapshots yet; `slowlight snapshot {shown} --target T --accept` \
                 writes the first"
            )));
        }
    }
    Ok(cases)
}

/// A scene on a target, with the options given or those that are kept.
fn case<'a>(args: &Args, path: &'a Path, target: &'static Target) -> Outcome<Case<'a>> {
    let kept = snapshot::path(path, target.name);
    let options = snapshot::kept_options(&kept)?;
    let given = &args.making;
    let (making, other) = match options {
        Some(options) if given.is_empty() && !args.anew => {
            let read = Given::read(&options).map_err(|why| {
                let shown = kept.display();
                Failure::Wrong(format!(
                    "{shown} was made with `{options}`: {why}; `--anew` makes it without"
                ))
            })?;
            (read, None)
        }
        Some(options) if options != given.text() => (given.clone(), Some(options)),
        _ => (given.clone(), None),
    };
    Ok(Case {
        path,
        target,
        kept,
        making,
        other,
    })
}

/// Options in words.
fn with(options: &str) -> String {
    match options {
        "" => "no options".to_owned(),
        options => format!("`{options}`"),
    }
}

impl Case<'_> {
    fn look(&self, args: &Args) -> Outcome<Found> {
        let making = &self.making.args;
        let changes = making.screen.changes(&making.changes);
        let scene = Scene::open(self.path, &changes)?;
        let plan = auto_format::plan(&making.screen, &scene, self.target)?.plan;
        let built = trial::build_for(&plan, making.screen.machine(plan.target))?;
        let trial = trial::run(&scene, plan, &[], built.loaded, args.limit)?;
        let made = snapshot::Made {
            text: &self.making.text(),
            full: making.full,
        };
        let text = snapshot::text(self.path, &scene, &made, &built.sources, &trial);
        let state = snapshot::compare(&self.kept, &text)?;
        let written = args.accept && state != (State::Unchanged { edited: false });
        if written {
            let dir = self.kept.parent().unwrap_or(Path::new("."));
            files::make(dir)?;
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
        if let Some(other) = &self.other {
            let (was, now) = (with(other), with(&self.making.text()));
            out.push_str(&format!(" (kept with {was}, now with {now})"));
        }
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
            "options": self.making.text(),
            "kept_options": self.other,
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
            Ok(found) if found.differs_from_model() > 0 => remark(&format!(
                "error: {}: machine and model differ in {} pixels",
                case.kept.display(),
                found.differs_from_model()
            )),
            Ok(_) => {}
            Err(failure) => {
                let status = failure.status();
                crate::diagnostics::report(&failure);
                failed.get_or_insert(status);
            }
        }
    }
    if missing + changed > 0 {
        let counts = [("changed", changed), ("missing", missing)];
        let counts = counts.into_iter().filter(|(_, n)| *n > 0);
        let counts: Vec<String> = counts.map(|(word, n)| format!("{n} {word}")).collect();
        remark(&format!(
            "error: of {total} snapshots, {}",
            counts.join(", ")
        ));
        remark(&format!("help: `{}` writes them", accepting(args)));
        if cases.iter().any(|case| case.other.is_some()) {
            remark(
                "help: without options on the command line snapshots are made with those that \
                 they are kept with",
            );
        }
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
    let scenes = args.scenes.iter();
    words.extend(scenes.map(|path| quoted(&path.display().to_string())));
    words.extend(args.target.iter().map(|t| format!("--target {}", t.name)));
    words.push(args.making.text());
    if args.anew {
        words.push("--anew".to_owned());
    }
    words.retain(|w| !w.is_empty());
    words.join(" ") + " --accept"
}
