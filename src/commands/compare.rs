//! `compare`: scenes on several machines.

use crate::draw::Drawn;
use crate::failure::{Failure, Outcome};
use crate::format::{count, duration, table};
use crate::measure::psnr;
use crate::picture::{self, FileFormat, Picture};
use crate::scene::{Scene, ScenesArgs};
use crate::target_args::{self, ALL_FORMATS, Os, ScreenArgs};
use crate::trial::{self, LIMIT, Trial};
use crate::{files, jobs, say, say_json};
use serde_json::{Value, json};
use slowlight_compiler::targets;
use slowlight_compiler::targets::{System, TARGETS, Target};
use std::path::{Path, PathBuf};

/// Pixels between two pictures.
const GAP: u32 = 4;

/// Options of `compare`.
#[derive(clap::Args, Debug)]
pub struct Args {
    #[command(flatten)]
    scenes: ScenesArgs,
    /// A machine, as in jack or 6502:c64; said again, more; all where none is named
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: Vec<&'static Target>,
    /// A format that reals are held in, as in log10, on machines that have it; said again, more;
    /// or all [default: each machine's first]
    #[arg(long, value_name = "F|all", value_parser = target_args::format_or_all)]
    format: Vec<String>,
    /// Jack's operating system, as for `run`
    #[arg(long, value_name = "OS")]
    os: Option<Os>,
    /// Rewrite nothing, neither for accuracy nor for speed: every formula as the scene has it
    #[arg(long)]
    as_written: bool,
    /// Only these rows of the picture, both ends included, as in 0..19
    #[arg(long, value_name = "A..B")]
    rows: Option<String>,
    /// Where to write the pictures side by side (.png): native, machine, difference; a line a machine
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print the table as JSON
    #[arg(long)]
    json: bool,
    /// Print the table as Markdown
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
    /// Give a machine up after so many cycles
    #[arg(long, value_name = "CYCLES", default_value_t = LIMIT)]
    limit: u64,
}

/// A row of the table.
struct Row<'a> {
    path: &'a Path,
    /// None where the scene itself is wrong.
    target: Option<&'static Target>,
    tried: Outcome<Trial>,
}

/// Runs them all; what cannot be run does not stop the others.
pub fn run(args: &Args) -> Outcome<()> {
    if let Some(output) = &args.output {
        if FileFormat::of(output)? != FileFormat::Png {
            let message = "pictures side by side are written as .png".to_owned();
            return Err(Failure::Usage(message));
        }
        files::may_write(output)?;
    }
    let rows = rows(args)?;
    let trials: Vec<&Trial> = rows.iter().filter_map(|r| r.tried.as_ref().ok()).collect();
    if let Some(output) = &args.output
        && !trials.is_empty()
    {
        files::write(output, &side_by_side(&trials)?)?;
    }
    let differs = |t: &&Trial| t.from_model.as_ref().is_some_and(|d| !d.is_empty());
    let differs = trials.iter().any(differs);
    if args.json {
        say_json(&rows.iter().map(Row::json).collect::<Vec<Value>>())?;
    } else if args.markdown {
        say(&markdown(&rows))?;
    } else if !trials.is_empty() || rows.len() > 1 {
        say(&aligned(&rows))?;
    }
    let mut status = None;
    for failure in rows.into_iter().filter_map(|r| r.tried.err()) {
        status.get_or_insert(failure.status());
        crate::diagnostics::report(&failure);
    }
    match status {
        _ if differs => Err(Failure::Differs),
        Some(status) => Err(Failure::Several(status)),
        None => Ok(()),
    }
}

/// Each scene on each target, several at the same time.
fn rows(args: &Args) -> Outcome<Vec<Row<'_>>> {
    let named = if args.target.is_empty() {
        TARGETS
    } else {
        args.target.as_slice()
    };
    let targets: Vec<&'static Target> = named.iter().flat_map(|t| in_formats(args, t)).collect();
    let open = |path| {
        let scene = Scene::open(path, &args.scenes.changes)?;
        scene.warn();
        Ok(scene)
    };
    let paths = &args.scenes.scenes;
    let scenes: Vec<Outcome<Scene>> = paths.iter().map(|path| open(path)).collect();
    let right = scenes.iter().flatten();
    let cases: Vec<(&Scene, &'static Target)> = right
        .flat_map(|scene| targets.iter().map(move |&target| (scene, target)))
        .collect();
    let mut tried = jobs::each(&cases, |(scene, target)| one(args, scene, target))?.into_iter();
    let mut rows = Vec::new();
    for (path, scene) in paths.iter().zip(scenes) {
        let row = |target, tried| Row {
            path,
            target,
            tried,
        };
        match scene {
            Ok(_) => {
                let each = targets.iter().zip(tried.by_ref());
                rows.extend(each.map(|(&target, tried)| row(Some(target), tried)));
            }
            Err(failure) => rows.push(row(None, Err(failure))),
        }
    }
    Ok(rows)
}

/// A machine in the formats that were asked for; in its usual one where it has none of them.
fn in_formats(args: &Args, target: &'static Target) -> Vec<&'static Target> {
    let wanted = |t: &&Target| {
        let named = |f: &String| f == t.runtime.format || f == ALL_FORMATS;
        args.format.iter().any(named)
    };
    let found: Vec<&'static Target> = targets::formats(target).filter(wanted).collect();
    if found.is_empty() {
        vec![target]
    } else {
        found
    }
}

fn one(args: &Args, scene: &Scene, target: &'static Target) -> Outcome<Trial> {
    let screen = ScreenArgs {
        rows: args.rows.clone(),
        format: Some(target.runtime.format.to_owned()),
        as_written: args.as_written,
        os: args.os.filter(|_| target.system == System::Hack),
        ..ScreenArgs::default()
    };
    let plan = screen.plan(scene, target, &[])?;
    let loaded = trial::build_for(&plan, screen.machine(target))?.loaded;
    trial::run(scene, plan, &[], loaded, args.limit)
}

const HEADS: [&str; 13] = [
    "scene", "target", "mode", "inks", "rows", "pixels", "format", "model", "native", "rmse",
    "PSNR", "cycles", "time",
];

const LEGEND: &str = "model, native: pixels whose ink differs; rmse, PSNR (dB): of shades; \
                      cycles and time: measured (docs/words.md)\n";

impl Row<'_> {
    fn name(&self) -> String {
        let stem = self.path.file_stem().unwrap_or_default();
        stem.to_string_lossy().into_owned()
    }

    fn target(&self) -> &'static str {
        self.target.map_or("", |t| t.name)
    }

    /// The cells, or only the first two and why there are no more.
    fn cells(&self) -> Result<Vec<String>, String> {
        let t = self.tried.as_ref().map_err(Failure::reason)?;
        let differing = |found: &Option<Vec<_>>| {
            found
                .as_ref()
                .map_or(String::new(), |f| count(f.len() as u64))
        };
        let rows = t.native.window.rows;
        Ok(vec![
            self.name(),
            self.target().to_owned(),
            t.plan.mode.name.to_owned(),
            t.plan.graph.image.palette.len().to_string(),
            format!("{}..{}", rows.0, rows.1),
            count(t.pixels()),
            t.plan.runtime.format.to_owned(),
            differing(&t.from_model),
            differing(&t.from_native),
            format!("{:.2e}", t.rmse),
            psnr(t.rmse).map_or("inf".to_owned(), |db| format!("{db:.1}")),
            count(t.run.cycles),
            duration(t.seconds()),
        ])
    }

    fn json(&self) -> Value {
        match &self.tried {
            Ok(trial) => json!(trial.report()),
            Err(failure) => json!({
                "scene": self.name(),
                "target": self.target.map(|t| t.name),
                "error": failure.reason(),
            }),
        }
    }
}

/// The table in columns; where a row has no figures, why.
fn aligned(rows: &[Row<'_>]) -> String {
    let widest = rows.iter().map(|r| r.target().len()).max().unwrap_or(0);
    let target = |name: &str| format!("{name:<widest$}");
    let mut reasons = vec![String::new()];
    let mut lines = vec![HEADS.map(str::to_owned).to_vec()];
    for row in rows {
        let (cells, reason) = match row.cells() {
            Ok(cells) => (cells, String::new()),
            Err(reason) => (vec![row.name(), row.target().to_owned()], reason),
        };
        lines.push(cells);
        reasons.push(reason);
    }
    for cell in lines.iter_mut().filter_map(|line| line.get_mut(1)) {
        *cell = target(cell);
    }
    let table = table(&lines);
    let each = table.lines().zip(reasons).map(|(line, reason)| {
        let gap = if reason.is_empty() { "" } else { "  " };
        format!("{line}{gap}{reason}\n")
    });
    each.collect::<String>() + LEGEND
}

/// The table as Markdown has it.
fn markdown(rows: &[Row<'_>]) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let mut out = line(&HEADS.map(str::to_owned));
    let rule = |k: usize| if k < 2 { "---" } else { "---:" }.to_owned();
    out += &line(&(0..HEADS.len()).map(rule).collect::<Vec<String>>());
    for row in rows {
        out += &match row.cells() {
            Ok(cells) => line(&cells),
            Err(reason) => {
                let mut cells = vec![
                    row.name(),
                    row.target().to_owned(),
                    reason.replace('|', "\\|"),
                ];
                cells.resize(HEADS.len(), String::new());
                line(&cells)
            }
        };
    }
    out + "\n" + LEGEND
}

/// A canvas of red, green and blue.
struct Canvas {
    width: u32,
    height: u32,
    data: Vec<u8>,
}

impl Canvas {
    fn put(&mut self, left: u32, top: u32, width: u32, colours: impl Iterator<Item = [u8; 3]>) {
        for (k, colour) in colours.enumerate() {
            let (x, y) = (left + k as u32 % width, top + k as u32 / width);
            let at = 3 * (y as usize * self.width as usize + x as usize);
            if x < self.width
                && let Some(pixel) = self.data.get_mut(at..at + 3)
            {
                pixel.copy_from_slice(&colour);
            }
        }
    }
}

/// For each trial a line: native, machine, and where they differ in white.
fn side_by_side(trials: &[&Trial]) -> Outcome<Vec<u8>> {
    let lines: Vec<(&Drawn, &Picture)> = trials
        .iter()
        .filter_map(|t| Some((&t.native, t.picture.as_ref()?)))
        .collect();
    let widest = lines.iter().map(|(_, p)| p.width).max().unwrap_or(1);
    let height: u32 = lines.iter().map(|(_, p)| p.height + GAP).sum();
    let (width, height) = (3 * widest + 2 * GAP, height.saturating_sub(GAP).max(1));
    let mut canvas = Canvas {
        width,
        height,
        data: vec![64; 3 * width as usize * height as usize],
    };
    let mut top = 0;
    for (native, machine) in lines {
        let ideal = native.picture();
        let unlike = ideal
            .inks
            .iter()
            .zip(&machine.inks)
            .map(|(a, b)| match a == b {
                true => [0; 3],
                false => [255; 3],
            });
        let step = widest + GAP;
        canvas.put(0, top, ideal.width, ideal.colours());
        canvas.put(step, top, machine.width, machine.colours());
        canvas.put(2 * step, top, machine.width, unlike);
        top += machine.height + GAP;
    }
    picture::png(canvas.width, canvas.height, None, &canvas.data)
}
