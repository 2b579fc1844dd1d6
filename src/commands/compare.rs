//! `compare`: one scene on several machines.

use crate::draw::Drawn;
use crate::failure::{Failure, Outcome};
use crate::format::{count, duration, table};
use crate::picture::{self, FileFormat, Picture};
use crate::scene::{Scene, SceneArgs};
use crate::target_args::{self, ScreenArgs};
use crate::trial::{self, LIMIT, Report, Trial};
use crate::{files, say, say_json};
use slowlight_compiler::target::{TARGETS, Target};
use std::path::PathBuf;

/// Pixels between two pictures.
const GAP: u32 = 4;

/// Options of `compare`.
#[derive(clap::Args, Debug)]
pub struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// A machine; all where none is named
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: Vec<&'static Target>,
    /// Only these rows of the picture, both ends included
    #[arg(long, value_name = "A..B")]
    rows: Option<String>,
    /// Where to write the pictures side by side (.png): native, machine, difference; a line a machine
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print the table as JSON
    #[arg(long)]
    json: bool,
    /// Give a machine up after so many cycles
    #[arg(long, value_name = "CYCLES", default_value_t = LIMIT)]
    limit: u64,
}

/// Runs them all.
pub fn run(args: &Args) -> Outcome<()> {
    if let Some(output) = &args.output
        && FileFormat::of(output)? != FileFormat::Png
    {
        let message = "pictures side by side are written as .png".to_owned();
        return Err(Failure::Usage(message));
    }
    let scene = Scene::load(&args.scene)?;
    scene.warn();
    let targets = if args.target.is_empty() {
        TARGETS
    } else {
        args.target.as_slice()
    };
    let screen = ScreenArgs {
        rows: args.rows.clone(),
        ..ScreenArgs::default()
    };
    let mut trials = Vec::new();
    for target in targets {
        let plan = screen.plan(&scene, target, &[])?;
        let loaded = trial::build(&plan)?.loaded;
        trials.push(trial::run(&scene, plan, &[], loaded, args.limit)?);
    }
    if let Some(output) = &args.output {
        files::write(output, &side_by_side(&trials)?)?;
    }
    if args.json {
        let all: Vec<Report<'_>> = trials.iter().map(Trial::report).collect();
        say_json(&all);
    } else {
        say(&report(&trials));
    }
    let differs = |t: &Trial| t.from_model.as_ref().is_some_and(|d| !d.is_empty());
    if trials.iter().any(differs) {
        return Err(Failure::Differs);
    }
    Ok(())
}

fn report(trials: &[Trial]) -> String {
    let heads = [
        "target", "mode", "inks", "pixels", "format", "model", "native", "rmse", "cycles", "time",
    ];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for t in trials {
        let differing = |found: &Option<Vec<_>>| {
            found
                .as_ref()
                .map_or(String::new(), |f| count(f.len() as u64))
        };
        rows.push(vec![
            t.plan.target.name.to_owned(),
            t.plan.mode.name.to_owned(),
            t.plan.graph.image.palette.len().to_string(),
            count(t.pixels()),
            t.plan.runtime.format.to_owned(),
            differing(&t.from_model),
            differing(&t.from_native),
            format!("{:.2e}", t.rmse),
            count(t.run.cycles),
            duration(t.seconds()),
        ]);
    }
    let legend =
        "model, native: pixels whose ink differs; rmse: of shades; cycles and time: measured\n";
    table(&rows) + legend
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
fn side_by_side(trials: &[Trial]) -> Outcome<Vec<u8>> {
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
