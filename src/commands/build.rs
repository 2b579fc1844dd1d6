//! `build`: sources ready for the real machine, or a stage on the way there.

use crate::auto_format;
use crate::colours;
use crate::failure::{Failure, Outcome};
use crate::forecast::{self, Forecast, forecast};
use crate::format::{count, duration, table};
use crate::labels::{self, Labels};
use crate::listing::listing;
use crate::machine::{File, Sizes};
use crate::need::{Need, need_beside};
use crate::scene::{Precision, Scene, SceneArgs};
use crate::target_args::{self, Os, ScreenArgs, Style};
use crate::trial::{self, mode_json};
use crate::{files, inks, say, say_json, toot, vcs, worst};
use clap::ValueEnum;
use serde_json::json;
use slowlight_compiler::analysis::rate::rates;
use slowlight_compiler::backend::mos6502::document;
use slowlight_compiler::backend::mos6502::syntax::Syntax;
use slowlight_compiler::backend::{self, Document};
use slowlight_compiler::plan::print::{ranges_text, rates_text};
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::planner::pass_manager::Pipeline;
use slowlight_compiler::planner::pipeline::PASSES;
use slowlight_compiler::syntax::print;
use slowlight_compiler::targets::{System, Target};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Options of `build`.
#[derive(clap::Args, Debug)]
pub struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The machine, as in jack, bbc, 6502 or 6502:c64; `slowlight targets` lists all
    #[arg(short, long, value_name = "T", value_parser = target_args::target,
          required_unless_present = "emit")]
    target: Option<&'static Target>,
    #[command(flatten)]
    screen: ScreenArgs,
    /// The assembler that the 6502's source is for: ca65, 64tass, acme, dasm, beebasm
    /// or xa [default: ca65]
    #[arg(long, value_name = "SYNTAX", value_parser = target_args::syntax)]
    syntax: Option<&'static Syntax>,
    /// Files of names beside the program, by which an emulator's debugger shows its labels and
    /// the scene's lines
    #[arg(long, value_enum, value_name = "FORM", value_delimiter = ',')]
    labels: Vec<Labels>,
    /// The directory to write to
    #[arg(short, long, value_name = "DIR", default_value = ".")]
    output: PathBuf,
    /// Print a stage instead of writing files
    #[arg(long, value_name = "STAGE")]
    emit: Option<Stage>,
    /// Of a scene that moves, the first picture alone
    #[arg(long)]
    still: bool,
    /// Say how many cycles a program for the plain 6502 takes at most, whatever its params
    /// and what is held, found without running it
    #[arg(long, conflicts_with = "emit")]
    worst: bool,
    /// Print what was written as JSON
    #[arg(long, conflicts_with = "emit")]
    json: bool,
}

/// A stage of compilation.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// What the lexer makes of the text
    Tokens,
    /// What the parser makes of the tokens
    Tree,
    /// The scene with every name and type known
    Program,
    /// Scalar operations
    Graph,
    /// How often each value changes
    Rates,
    /// Between which bounds each value stays on the target
    Ranges,
    /// The planner's passes in their order; with a target, what each was good for
    Passes,
    /// Which routine computes each value, when, and where it is kept
    Plan,
    /// The generated sources
    Text,
}

/// Builds.
pub fn run(args: &Args) -> Outcome<()> {
    let scene = Scene::load(&args.screen.scene_args(&args.scene))?;
    let scene = args.screen.moving(scene, args.still);
    if let Some(stage) = args.emit {
        return say(&emit(args, &scene, stage)?);
    }
    let target = target(args)?;
    let machine = args.screen.machine(target);
    for form in &args.labels {
        form.check(target, args.screen.os == Some(Os::Jack))?;
    }
    // Its lines are those of the source as ca65 reads it.
    if args.labels.contains(&Labels::Ca65) && args.syntax.is_some_and(|s| s.name != "ca65") {
        let message = "--labels ca65 names lines of ca65's source: leave --syntax out";
        return Err(Failure::Usage(message.to_owned()));
    }
    if args.worst {
        worst::check(target)?;
    }
    files::may_hold(&args.output)?;
    scene.warn();
    let plan = auto_format::plan(&args.screen, &scene, target)?.said();
    inks::warn(&scene, &plan)?;
    colours::warn(&scene, plan.target);
    let mut more = match args.screen.style {
        Some(Style::Listing) if target_args::is_6502(plan.target) => vec![listing(&scene, &plan)?],
        _ => Vec::new(),
    };
    let text = backend::emit(&plan);
    more.extend(labels::files(
        &args.labels,
        &scene,
        (&plan, &text),
        machine,
    )?);
    let written = write(
        (&plan, &text),
        &args.screen,
        (args.syntax, &more),
        &args.output,
    )?;
    let forecast = match plan.graph.is_moving() {
        _ if plan.target.columns_only => {
            Forecast::Not("`run --pictures` says how many a second there are".to_owned())
        }
        true => {
            // Its first picture.
            let mut still = plan.clone();
            still.graph.reports.clear();
            forecast((&still, &backend::emit(&still)), machine)?
        }
        false => forecast((&plan, &text), machine)?,
    };
    let seconds = |cycles: f64| cycles / forecast::hertz(&plan, machine);
    let worst = args.worst.then(|| worst::worst(&plan, &text));
    let sizes = written.sizes;
    let post = toot::posted(&plan, &text);
    toot::warn(post, forecast.cycles().map(seconds));
    if args.json {
        let files: Vec<_> = written
            .files
            .iter()
            .map(|(path, bytes)| json!({"path": path.display().to_string(), "bytes": bytes}))
            .collect();
        let mut said = json!({
            "scene": scene.name,
            "target": plan.target.name,
            "mode": mode_json(plan.mode.name),
            "format": plan.runtime.format,
            "files": files,
            "code_bytes": sizes.code,
            "table_bytes": sizes.tables,
            "ram_bytes": sizes.ram,
            "heap": heap_json(&written),
            "work": plan.work(),
            "priced": priced(&plan).round(),
            "passes": passes_json(&plan),
            "cycles": forecast.cycles().map(f64::round),
            "machine_seconds": forecast.cycles().map(seconds),
            "rows_run": match forecast {
                Forecast::Rows(_, rows) => Some(rows),
                Forecast::Whole(_) | Forecast::Not(_) => None,
            },
        });
        said["post_characters"] = json!(post);
        if let Some(worst) = worst {
            said["worst_cycles"] = json!(worst.ok());
        }
        return say_json(&said);
    }
    say(&(written.text() + &toot::said(post)))?;
    say(&match &forecast {
        Forecast::Whole(cycles) => {
            let moves = plan.graph.is_moving();
            let each = if moves { "a picture " } else { "" };
            format!("{} {each}on the machine\n", duration(seconds(*cycles)))
        }
        Forecast::Rows(cycles, rows) => format!(
            "about {} on the machine, by {rows} of its {} rows (`run` runs all)\n",
            duration(seconds(*cycles)),
            plan.rows.1 - plan.rows.0 + 1
        ),
        Forecast::Not(why) => format!("its time is not known: {why}\n"),
    })?;
    if vcs::is_cartridge(&plan) {
        say(&vcs::text(&plan)?)?;
    }
    match worst {
        Some(worst) => say(&worst::text(&plan, worst, seconds)),
        None => Ok(()),
    }
}

/// The files of a program that were written.
pub struct Written {
    /// Where, and how long in bytes.
    files: Vec<(PathBuf, usize)>,
    sizes: Sizes,
    /// What a Jack program takes of the heap.
    heap: Option<Need>,
}

impl Written {
    /// As a table.
    pub fn text(&self) -> String {
        let size = |bytes: u64| format!("{} bytes", count(bytes));
        let mut rows: Vec<Vec<String>> = (self.files.iter())
            .map(|(path, bytes)| vec![path.display().to_string(), size(*bytes as u64)])
            .collect();
        let parts = [
            ("code", self.sizes.code),
            ("tables", self.sizes.tables),
            ("RAM", self.sizes.ram),
        ];
        for (what, bytes) in parts {
            if let Some(bytes) = bytes {
                rows.push(vec![what.to_owned(), size(bytes)]);
            }
        }
        let mut text = table(&rows);
        if let Some(heap) = self.heap.as_ref().and_then(Need::heap) {
            let part = |(name, words): &(&str, u64)| format!("{name} {}", count(*words));
            let parts: Vec<String> = heap.parts.iter().map(part).collect();
            text.push_str(&format!(
                "heap: {} words with headers ({}); {}\n",
                count(heap.words),
                parts.join(", "),
                heap.systems
            ));
        }
        text
    }
}

/// Writes a plan's program, whose text is known, to a directory, ready for the real machine, in
/// some syntax, and more files beside it.
///
/// # Errors
/// Where the machine's tools refuse it, or a file cannot be written.
pub fn write(
    (plan, text): (&PlannedScene, &[Document]),
    screen: &ScreenArgs,
    (syntax, more): (Option<&'static Syntax>, &[File]),
    dir: &Path,
) -> Outcome<Written> {
    let mut built = trial::build_written(text, plan, screen.machine(plan.target))?;
    if syntax.is_some() {
        let documents = documents(syntax, plan);
        let files = documents.iter().map(|d| File::text(&d.name, &d.text));
        built.sources = files.collect();
    }
    files::make(dir)?;
    let written: Vec<(PathBuf, &[u8])> = built
        .files()
        .chain(more)
        .map(|f| (dir.join(&f.name), f.bytes.as_slice()))
        .collect();
    let list: Vec<(&Path, &[u8])> = written.iter().map(|(p, b)| (p.as_path(), *b)).collect();
    files::write_all(&list)?;
    Ok(Written {
        files: written
            .iter()
            .map(|(path, bytes)| (path.clone(), bytes.len()))
            .collect(),
        heap: match plan.target.system {
            System::Hack => Some(need_beside(plan, &built.loaded.system)),
            _ => None,
        },
        sizes: built.loaded.sizes,
    })
}

/// A Jack program's heap as JSON; null for others.
fn heap_json(written: &Written) -> serde_json::Value {
    let Some(heap) = written.heap.as_ref().and_then(Need::heap) else {
        return serde_json::Value::Null;
    };
    let parts: BTreeMap<&str, u64> = heap.parts.iter().copied().collect();
    json!({
        "words": heap.words,
        "parts": parts,
        "largest": heap.largest,
        "systems": heap.systems,
    })
}

/// What a program takes by its plan's price, in cycles: its pixels, with what draws them, and
/// what makes it ready.
fn priced(plan: &PlannedScene) -> f64 {
    let drawing = if plan.plot { plan.target.drawing } else { 0 };
    let pixel = plan.cycles_a_pixel() + f64::from(drawing);
    let all = pixel * pixels(plan) + backend::starts(plan) as f64;
    all / (1.0 - plan.target.stolen)
}

/// How many pixels a plan's program computes.
fn pixels(plan: &PlannedScene) -> f64 {
    let ((left, right), (top, bottom)) = (plan.columns, plan.rows);
    f64::from(right - left + 1) * f64::from(bottom - top + 1)
}

/// What the passes that ran were good for, as JSON.
fn passes_json(plan: &PlannedScene) -> serde_json::Value {
    let pipeline = plan.pipeline();
    let ran = PASSES.iter().filter_map(|pass| {
        let count = pipeline.count(*pass);
        let json = json!({"runs": count.runs, "kept": count.kept, "work": count.work});
        (count.runs > 0).then(|| (pass.about().0.to_owned(), json))
    });
    ran.collect::<serde_json::Map<_, _>>().into()
}

fn target(args: &Args) -> Outcome<&'static Target> {
    let target = args.target.ok_or_else(|| {
        Failure::Usage("this stage depends on the machine: say --target".to_owned())
    })?;
    if args.syntax.is_some() && !target_args::is_6502(target) {
        let message = format!("--syntax is the 6502's; {} has none", target.name);
        return Err(Failure::Usage(message));
    }
    Ok(target)
}

/// The sources, in the syntax that was asked for.
fn documents(syntax: Option<&'static Syntax>, plan: &PlannedScene) -> Vec<Document> {
    match syntax {
        Some(syntax) => vec![document(plan, syntax)],
        None => slowlight_compiler::backend::emit(plan),
    }
}

/// The plan of a stage, which may be looked at also where its program does not fit.
fn plan(args: &Args, scene: &Scene) -> Outcome<PlannedScene> {
    let target = target(args)?;
    match auto_format::plan(&args.screen, scene, target) {
        Err(Failure::TooLarge(_)) => args.screen.draft(scene, target),
        plan => Ok(plan?.said()),
    }
}

fn emit(args: &Args, scene: &Scene, stage: Stage) -> Outcome<String> {
    let file = scene.checked.sources.files.first();
    let text = file.map_or("", |f| f.text.as_str());
    let graph = || match args.target {
        Some(target) => {
            let mode = args.screen.mode(target, scene)?;
            scene.graph(Some(mode.inks), Precision::of(target))
        }
        None => scene.graph(None, Precision::NATIVE),
    };
    Ok(match stage {
        Stage::Tokens => print::tokens(text),
        Stage::Tree => print::tree(&slowlight_compiler::syntax::parse(text, 0).0),
        Stage::Program => scene.checked.program.to_string(),
        Stage::Graph => graph()?.to_string(),
        Stage::Rates => {
            let graph = graph()?;
            rates_text(&graph, &rates(&graph))
        }
        Stage::Ranges => {
            let plan = plan(args, scene)?;
            ranges_text(&plan.graph, &plan.ranges)
        }
        Stage::Passes => match args.target {
            Some(_) => plan(args, scene)?.pipeline().text(),
            None => Pipeline::default().text(),
        },
        Stage::Plan => plan(args, scene)?.to_string(),
        Stage::Text => {
            let plan = plan(args, scene)?;
            let documents = documents(args.syntax, &plan);
            let many = documents.len() > 1;
            let mut out = String::new();
            for document in documents {
                if many {
                    out.push_str(&format!("==> {} <==\n", document.name));
                }
                out.push_str(&document.text);
            }
            out
        }
    })
}
