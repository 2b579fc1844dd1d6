//! `tune`: what accuracy costs in time, as a frontier to choose from.

use super::build::{self, Written};
use crate::draw::Window;
use crate::failure::{Failure, Outcome};
use crate::files;
use crate::interrupt;
use crate::output::remark;
use crate::scene::{Scene, SceneArgs};
use crate::target_args::{self, Os, ScreenArgs};
use crate::trial::LIMIT;
use crate::tune::cache::Cache;
use crate::tune::choice::{Base, Choice};
use crate::tune::effort::Effort;
use crate::tune::explore::{Found, explore};
use crate::tune::goal::{self, Goals, Measure};
use crate::tune::marks::{self, Mark};
use crate::tune::page::page;
use crate::tune::plot::svg;
use crate::tune::point::{Natives, Point, encoded};
use crate::tune::rows::Look;
use crate::tune::search::{SETTINGS, Search};
use crate::tune::tell::Told;
use crate::{say, say_json};
use slowlight_compiler::targets::Target;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

/// Options of `tune`.
#[derive(clap::Args, Debug)]
pub struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The machine, as in jack, bbc, 6502 or 6502:c64; `slowlight targets` lists all
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: &'static Target,
    /// The screen's mode, where the machine has several (see `slowlight targets`)
    #[arg(long, value_name = "N")]
    mode: Option<String>,
    /// Jack's operating system, as for `run`
    #[arg(long, value_name = "OS")]
    os: Option<Os>,
    /// Where programs begin on a BBC Micro, as for `run`
    #[arg(long, value_name = "PAGE", value_parser = target_args::page)]
    page: Option<u16>,
    /// Build the most accurate program that takes no longer on the machine: 90s, 20m, 1h30m
    #[arg(long, value_name = "TIME", value_parser = goal::time)]
    within: Option<f64>,
    /// Build the quickest program that is off by no more: 0.5% or 0.005
    #[arg(long, value_name = "E", value_parser = target_args::share)]
    error: Option<f64>,
    /// Build one whose code, tables and memory take no more bytes: 8K
    #[arg(long, value_name = "BYTES", value_parser = goal::bytes)]
    memory: Option<u64>,
    /// The error that decides
    #[arg(long, value_enum, value_name = "MEASURE", default_value_t)]
    measure: Measure,
    /// The directory to write the program that was chosen to
    #[arg(short, long, value_name = "DIR", default_value = ".")]
    output: PathBuf,
    /// Write a page (HTML) that shows the ways that are worth choosing, their pictures and how to
    /// get them
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write the plot of time against error alone
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Another program in the plot: 'the original=9h45m,0.47%'; beside those that the scene
    /// names in remarks, as `// mark jack: the original = 1234567 cycles, 0.47%`
    #[arg(long, value_name = "NAME=TIME,ERROR", value_parser = marks::mark)]
    mark: Vec<Mark>,
    /// Print all points as JSON
    #[arg(long)]
    json: bool,
    /// Print all points as comma-separated values
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Keep params changeable: do not try to work them out beforehand (`--freeze all`)
    #[arg(long)]
    live: bool,
    /// How many settings (of blocks, turns of loops and so on) are tried in each format
    #[arg(long, value_name = "N", default_value_t = SETTINGS, value_parser = clap::value_parser!(u16).range(1..=200))]
    settings: u16,
    /// How much work to do: so many times the usual, which takes a minute on two processors
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    effort: u16,
    /// Measure everything anew, and keep nothing for the next time
    #[arg(long)]
    no_cache: bool,
    /// Give a choice up after so many cycles of the machine
    #[arg(long, value_name = "CYCLES", default_value_t = LIMIT)]
    limit: u64,
}

impl Args {
    fn goals(&self) -> Goals {
        Goals {
            within: self.within,
            error: self.error,
            memory: self.memory,
        }
    }
}

/// Searches, tells, and builds what was asked for.
pub fn run(args: &Args) -> Outcome<()> {
    files::may_write_each([args.html.as_ref(), args.svg.as_ref()])?;
    if args.goals().any() {
        files::may_hold(&args.output)?;
    }
    let base = base(args);
    let scene = Scene::open(&base.path, &base.changes)?;
    let mut marks = marks::of_scene(&scene, &base)?;
    marks.extend_from_slice(&args.mark);
    let found = Arc::new(Mutex::new(Found::default()));
    let search = Search {
        base: base.clone(),
        measure: args.measure,
        live: args.live,
        smaller: args.memory.is_some(),
        settings: usize::from(args.settings),
        limit: args.limit,
        // It takes as long again, and only these tell it.
        by_line: args.json || args.html.is_some(),
        effort: Effort::times(args.effort),
        cache: match args.no_cache {
            true => Cache::none(),
            false => Cache::of_user(),
        },
    };
    {
        // Planning does not look at whether Ctrl-C was pressed.
        let (found, base, measure) = (found.clone(), base.clone(), args.measure);
        let form = Form::of(args);
        interrupt::last_words(move || {
            // Before anything was measured there is nothing to tell.
            if let Ok(found) = found.lock()
                && !found.points.is_empty()
            {
                // The process ends with the status of an interruption, whatever comes of it.
                let _ = form.say(&Told::new(&base, measure, &found), None);
            }
        });
    }
    scene.warn();
    let mut hear = |choice: &Choice, look: &Look, whole: bool| search.tell(choice, look, whole);
    let searched = explore(&search, scene, &found, &mut hear);
    interrupt::quietly();
    let mut found = found.lock().map(|f| f.clone()).unwrap_or_default();
    // Threads find them in any order.
    found.failed.sort();
    match searched {
        Ok(()) => {}
        Err(Failure::Interrupted) if !found.points.is_empty() => {
            Form::of(args).say(&Told::new(&base, args.measure, &found), None)?;
            return Err(Failure::Interrupted);
        }
        Err(other) => return Err(other),
    }
    let mut told = Told::new(&base, args.measure, &found);
    told.marks = marks;
    tell(args, &told)
}

fn base(args: &Args) -> Base {
    Base {
        path: args.scene.scene.clone(),
        changes: args.scene.changes.clone(),
        target: args.target,
        screen: ScreenArgs {
            mode: args.mode.clone(),
            os: args.os,
            page: args.page,
            ..ScreenArgs::default()
        },
    }
}

/// How what was found is printed.
#[derive(Clone, Copy)]
enum Form {
    Json,
    Csv,
    Text,
}

impl Form {
    fn of(args: &Args) -> Form {
        match (args.json, args.csv) {
            (true, _) => Form::Json,
            (_, true) => Form::Csv,
            _ => Form::Text,
        }
    }

    fn say(self, told: &Told<'_>, chosen: Option<&Point>) -> Outcome<()> {
        match self {
            Form::Json => say_json(&told.json(chosen)),
            Form::Csv => say(&told.csv()),
            Form::Text => say(&format!("{}\n\n{}", told.sentence(), told.table())),
        }
    }
}

/// Tells what was found, and builds what was asked for.
fn tell(args: &Args, told: &Told<'_>) -> Outcome<()> {
    if let Some(path) = &args.html {
        let scene = Scene::open(&told.base.path, &told.base.changes)?;
        let inks = told.base.screen.mode(args.target, &scene)?.inks;
        let (width, height) = scene.size();
        let native = Natives::default().of(&scene, inks, Window::whole(width, height))?;
        files::write(path, page(told, &encoded(&native)?).as_bytes())?;
    }
    if let Some(path) = &args.svg {
        files::write(path, (svg(told) + "\n").as_bytes())?;
    }
    let goals = args.goals();
    let chosen = goals
        .any()
        .then(|| goals.choose(&told.points, args.measure));
    let best: Option<&Point> = chosen.as_ref().and_then(|c| c.as_ref().ok()).copied();
    Form::of(args).say(told, best)?;
    if let Some(found) = chosen {
        let point = found?;
        let written = build(args, told, point)?;
        if !args.json && !args.csv {
            let command = told.base.command(&point.choice, "build");
            say(&format!("\nchosen: {command}\n{}", written.text()))?;
        }
    }
    let wrong = (told.points.iter()).filter(|p| p.measured.differs_from_model > 0);
    let wrong = wrong.inspect(|point| {
        remark(&format!(
            "error: {} pixels of `{}` are not the model's: a fault of slowlight's, not of the scene's",
            point.measured.differs_from_model,
            told.base.command(&point.choice, "run"),
        ));
    });
    match wrong.count() > 0 {
        true => Err(Failure::Differs),
        false if told.points.is_empty() => Err(Failure::Wrong(first_reason(told))),
        false => Ok(()),
    }
}

/// Why nothing can be had.
fn first_reason(told: &Told<'_>) -> String {
    let first = told.found.failed.first();
    first.map_or("nothing was tried".to_owned(), |(_, why)| why.clone())
}

/// Writes the program of a point.
fn build(args: &Args, told: &Told<'_>, point: &Point) -> Outcome<Written> {
    let choice = &point.choice;
    let scene = Scene::open(&told.base.path, &told.base.changes(choice.frozen))?;
    let screen = told.base.screen(choice);
    let plan = screen.plan(&scene, args.target, &[])?;
    let text = slowlight_compiler::backend::emit(&plan);
    build::write((&plan, &text), &screen, (None, &[]), &args.output)
}
