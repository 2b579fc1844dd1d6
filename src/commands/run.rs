//! `run`: build, run on the bundled machine, compare.

use crate::against::Reference;
use crate::auto_format::{self, Chosen};
use crate::colours;
use crate::failure::{Failure, Outcome};
use crate::format::{count, duration, table};
use crate::machine::{File, Loaded};
use crate::measure::{Difference, psnr};
use crate::moving::film::FilmFile;
use crate::moving::run::run as walked;
use crate::moving::{MovingArgs, few_to_follow, must_move};
use crate::picture::{Picture, PictureFile};
use crate::scene::{Precision, Scene, SceneArgs};
use crate::target_args::{self, HeapOf, ScreenArgs};
use crate::trial::{self, LIMIT, Trial};
use crate::{grow, inks, program, say, say_json, watch};
use serde::Serialize;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::{Target, formats};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// How many differing pixels are listed.
const LISTED: usize = 10;

/// Options of `run`.
#[derive(clap::Args, Clone, Debug)]
pub struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The machine, as in jack, bbc, 6502 or 6502:c64; `slowlight targets` lists all
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: &'static Target,
    #[command(flatten)]
    screen: ScreenArgs,
    /// Where to write the machine's picture (the rows asked for): .png, .pgm or .pbm; pictures
    /// that move: .gif or .png, animated
    #[arg(short, long, value_name = "FILE", conflicts_with = "no_plot")]
    output: Option<PathBuf>,
    /// Count the pixels unlike those of another picture, too: .png, .pgm or .pbm, as `-o` writes
    #[arg(long, value_name = "FILE", conflicts_with = "no_plot")]
    against: Vec<PathBuf>,
    /// Show the machine's picture in the terminal, as it grows where that can be shown
    #[arg(long, conflicts_with_all = ["no_plot", "json"])]
    show: bool,
    /// Run it again each time that the scene or a file that it uses is saved, until Ctrl-C
    #[arg(long, conflicts_with = "program")]
    watch: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Run the sources in this directory, an edited copy of what `build` wrote
    #[arg(long, value_name = "DIR")]
    program: Option<PathBuf>,
    /// Give up after so many cycles of the machine
    #[arg(long, value_name = "CYCLES", default_value_t = LIMIT)]
    limit: u64,
    /// Jack's heap: that of the system in VM emulators, or what the official system leaves as
    /// `.vm` files [default: built-in]
    #[arg(long, value_name = "SYSTEM")]
    heap: Option<HeapOf>,
    #[command(flatten)]
    moving: MovingArgs,
}

/// Runs it, and again whenever it is saved where that is asked for.
pub fn run(args: &Args) -> Outcome<()> {
    if !args.watch {
        return once(args);
    }
    let (scene, own) = (&args.scene, args.clone());
    watch::each_save(
        &scene.scene,
        &scene.changes,
        &(Arc::new(move || once(&own)) as watch::Work),
    )
}

/// Runs, reports, and fails where machine and model differ.
fn once(args: &Args) -> Outcome<()> {
    if let Some(pictures) = args.moving.pictures {
        return walk(args, pictures);
    }
    let output = PictureFile::named(args.output.as_deref())?;
    let others: Vec<Reference> = (args.against.iter())
        .map(|path| Reference::read(path))
        .collect::<Outcome<_>>()?;
    let scene = Scene::load(&args.screen.scene_args(&args.scene))?;
    scene.warn();
    let (plan, set, loaded) = prepare(args, &scene)?;
    inks::warn(&scene, &plan)?;
    colours::warn(&scene, plan.target);
    let trial = match args.show {
        true => grow::run(&scene, plan, &set, loaded, args.limit)?,
        false => trial::run(&scene, plan, &set, loaded, args.limit)?,
    };
    if let Some(picture) = &trial.picture {
        output.write(picture)?;
    }
    let counts: Vec<u64> = (others.iter())
        .map(|other| other.differing(&trial))
        .collect::<Outcome<_>>()?;
    let names = args.against.iter().map(|path| path.display().to_string());
    let found: Vec<(String, u64)> = names.zip(counts).collect();
    if args.json {
        let differs_from: BTreeMap<String, u64> = found.into_iter().collect();
        say_json(&Report {
            trial: trial.report(),
            differs_from,
        })?;
    } else {
        say(&report(&trial, &found))?;
    }
    match &trial.from_model {
        Some(differences) if !differences.is_empty() => Err(Failure::Differs),
        _ => Ok(()),
    }
}

/// Runs the pictures of a scene that moves.
fn walk(args: &Args, pictures: u32) -> Outcome<()> {
    let asked = [
        ("--program", args.program.is_some()),
        ("--against", !args.against.is_empty()),
        ("--no-plot", args.screen.no_plot),
        ("--show", args.show),
        ("--style toot", args.screen.is_toot()),
    ];
    if let Some((option, _)) = asked.iter().find(|(_, asked)| *asked) {
        let message = format!("{option} is of one picture: leave it or --pictures out");
        return Err(Failure::Usage(message));
    }
    few_to_follow(pictures)?;
    let output = FilmFile::named(args.output.as_deref())?;
    let hands = args.moving.hands()?;
    let scene = Scene::load(&args.scene)?.moving();
    let graph = scene.graph(None, Precision::NATIVE)?;
    must_move(&graph)?;
    args.moving.keys_are_asked_for(&graph)?;
    scene.warn();
    let machine = args.screen.machine(args.target);
    let machine = HeapOf::of(args.heap, args.screen.os, machine)?;
    let plan = auto_format::plan(&args.screen, &scene, args.target)?.said();
    colours::warn(&scene, plan.target);
    let loaded = trial::build_for(&plan, machine)?.loaded;
    let walk = walked(
        &scene,
        plan,
        (loaded, machine),
        (pictures, &hands),
        args.limit,
    )?;
    let drawn: Vec<Picture> = walk
        .pictures
        .iter()
        .map(|shown| shown.picture.clone())
        .collect();
    output.write(&drawn, args.moving.fps)?;
    if args.json {
        say_json(&walk.report(&scene.name))?;
    } else {
        say(&walk.text(&scene.name))?;
    }
    match walk.differs() {
        true => Err(Failure::Differs),
        false => Ok(()),
    }
}

/// What `--json` prints.
#[derive(Serialize)]
struct Report<'t> {
    #[serde(flatten)]
    trial: trial::Report<'t>,
    /// By file.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    differs_from: BTreeMap<String, u64>,
}

fn prepare(args: &Args, scene: &Scene) -> Outcome<(PlannedScene, program::Values, Loaded)> {
    let machine = args.screen.machine(args.target);
    let machine = HeapOf::of(args.heap, args.screen.os, machine)?;
    let chosen = auto_format::plan(&args.screen, scene, args.target)?;
    let Some(dir) = &args.program else {
        let plan = chosen.said();
        let loaded = trial::build_for(&plan, machine)?.loaded;
        return Ok((plan, Vec::new(), loaded));
    };
    let sources = program::read(dir, &scene.name, machine)?;
    let plan = of_program(args, scene, chosen, &sources)?;
    let unedited = slowlight_compiler::backend::emit(&plan);
    let set = program::values(&plan, &unedited, &sources)?;
    let rows = program::rows(&plan, &unedited, &sources)?;
    if let Some(asked) = &args.screen.rows
        && rows != plan.rows
    {
        let what = format!(
            "--rows {asked}: the program in {} draws rows",
            dir.display()
        );
        let (first, last) = rows;
        let out = "leave --rows out, or change its first and last row";
        return Err(Failure::Usage(format!("{what} {first}..{last}; {out}")));
    }
    let mut screen = args.screen.like(&plan);
    if plan.moved {
        screen.page = plan.page;
    }
    let mut plan = screen.plan(scene, args.target, &set)?;
    plan.rows = rows;
    Ok((plan, set, machine.at_page(screen.page).load(&sources)?))
}

/// The plan that a program was made by: it may have been built in another format than is chosen
/// unasked.
fn of_program(
    args: &Args,
    scene: &Scene,
    chosen: Chosen,
    sources: &[File],
) -> Outcome<PlannedScene> {
    if args.screen.format.is_some() || program::is_of(&chosen.plan, sources) {
        return Ok(chosen.said());
    }
    let format = chosen.plan.runtime.format;
    for target in formats(args.target).filter(|t| t.runtime.format != format) {
        let screen = args.screen.in_format_of(target);
        match screen.plan(scene, args.target, &[]) {
            Ok(plan) if program::is_of(&plan, sources) => return Ok(plan),
            Ok(_) | Err(Failure::TooLarge(_) | Failure::Wrong(_) | Failure::Scene(_)) => {}
            Err(other) => return Err(other),
        }
    }
    // More of it was edited than its parameters.
    Ok(chosen.said())
}

fn report(trial: &Trial, others: &[(String, u64)]) -> String {
    let plan = &trial.plan;
    let mode = match plan.mode.name {
        "" => String::new(),
        name => format!(" in mode {name}"),
    };
    let size = trial.native.window;
    let title = format!(
        "{} on {}{mode}: {} x {} pixels, {} inks, {}\n",
        trial.scene,
        plan.target.name,
        size.width(),
        size.height(),
        plan.graph.image.palette.len(),
        plan.runtime.format
    );
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut row = |what: &str, text: String| rows.push(vec![format!("  {what}"), text]);
    row("cycles", count(trial.run.cycles));
    if trial.pixels_run() > trial.pixels() {
        let run = count(trial.pixels_run());
        let why = match trial.plan.graph.refinement {
            Some(_) => "bands are computed whole",
            None => "errors come from all rows above",
        };
        row("pixels run", format!("{run}, as {why}"));
    }
    row("cycles a pixel", format!("{:.1}", trial.cycles_per_pixel()));
    if let Some(plot) = trial.run.plot_cycles {
        row("cycles of drawing", count(plot));
    }
    row("machine time", duration(trial.seconds()));
    if let Some(words) = trial.run.rom_words {
        row("ROM words", count(words));
        row(
            "VM commands",
            trial
                .run
                .vm_instructions
                .map_or("not counted".to_owned(), count),
        );
    }
    let sizes = trial.run.sizes;
    let parts = [
        ("code bytes", sizes.code),
        ("table bytes", sizes.tables),
        ("RAM bytes", sizes.ram),
    ];
    for (what, size) in parts {
        if let Some(size) = size {
            row(what, count(size));
        }
    }
    let counted = |found: &Option<Vec<Difference>>| match found {
        Some(list) => count(list.len() as u64),
        None => "not drawn".to_owned(),
    };
    if let Some(traced) = trial.modelled.traced {
        let share = 100.0 * traced as f64 / trial.pixels().max(1) as f64;
        row("pixels traced", format!("{} ({share:.0}%)", count(traced)));
    }
    row("differs from model", counted(&trial.from_model));
    row("differs from native", counted(&trial.from_native));
    for (file, pixels) in others {
        row(&format!("differs from {file}"), count(*pixels));
    }
    row("rmse of shades", format!("{:.3e}", trial.rmse));
    if let Some(db) = psnr(trial.rmse) {
        row("PSNR", format!("{db:.1} dB"));
    }
    let mut out = title + &table(&rows);
    out.push_str(&listed("model", &trial.from_model));
    out.push_str(&listed("native", &trial.from_native));
    out.push_str(LEGEND);
    out
}

/// What the rows mean.
const LEGEND: &str = "model: the program's own arithmetic on this computer (it should not differ); \
                      native: the scene in 64-bit floats; shades are from 0 to 1 (docs/words.md)\n";

/// The first pixels that differ.
fn listed(from: &str, found: &Option<Vec<Difference>>) -> String {
    let Some(found) = found.as_ref().filter(|f| !f.is_empty()) else {
        return String::new();
    };
    let shown: Vec<String> = found
        .iter()
        .take(LISTED)
        .map(|d| format!("({}, {}) {} not {}", d.place.0, d.place.1, d.is, d.should))
        .collect();
    let more = if found.len() > LISTED { ", ..." } else { "" };
    format!("  inks unlike the {from}'s: {}{more}\n", shown.join(", "))
}
