//! `effects`: what each effect of a scene and of the library costs, and what it adds.

use crate::effects::{Called, Effects, Found, Known, Row, look, quantiles};
use crate::explain::terminal::percent;
use crate::explain::{size_unit, unit};
use crate::failure::{Failure, Outcome};
use crate::format::{count, table};
use crate::scene::{Scene, SceneArgs};
use crate::sheet::{self, Line};
use crate::target_args::{self, ScreenArgs};
use crate::trial::LIMIT;
use crate::{files, say, say_json};
use serde_json::{Value, json};
use slowlight_compiler::targets::Target;
use std::path::PathBuf;

/// Options of `effects`.
#[derive(clap::Args, Debug)]
pub struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The machine, as in jack, bbc, 6502 or 6502:c64; `slowlight targets` lists all
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: &'static Target,
    #[command(flatten)]
    screen: ScreenArgs,
    /// Write the table as a picture, with bars for the time
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Give up after so many cycles of the machine
    #[arg(long, value_name = "CYCLES", default_value_t = LIMIT)]
    limit: u64,
}

/// Looks and reports; fails where the machine and its model differ.
pub fn run(args: &Args) -> Outcome<()> {
    files::may_write_each([args.svg.as_ref()])?;
    let scene = Scene::load(&args.screen.scene_args(&args.scene))?;
    scene.warn();
    let found = look(&scene, args.target, &args.screen, args.limit)?;
    if let Some(path) = &args.svg {
        files::write(path, svg(&found).as_bytes())?;
    }
    match args.json {
        true => say_json(&report(&found)),
        false => say(&text(&found)),
    }?;
    match &found.whole.from_model {
        Some(differences) if !differences.is_empty() => Err(Failure::Differs),
        _ => Ok(()),
    }
}

/// A part of all cycles.
fn share(found: &Effects, cycles: i64) -> f64 {
    cycles as f64 / found.whole.run.cycles.max(1) as f64
}

fn report(found: &Effects) -> Value {
    let run = &found.counted.run;
    let mut whole = serde_json::to_value(found.whole.report()).unwrap_or(Value::Null);
    if let Some(whole) = whole.as_object_mut() {
        // The rows say it better.
        whole.remove("effects");
    }
    json!({
        "run": whole,
        "unit": unit(run),
        "size_unit": size_unit(run),
        "watched": found.watched,
        "known_before_shade": found.known,
        "effects": found.rows.iter().map(|row| row_json(found, row)).collect::<Vec<Value>>(),
    })
}

fn row_json(found: &Effects, row: &Row) -> Value {
    let nothing = Called::nothing();
    let (called, digests) = match &row.found {
        Found::Called(called) => (called.as_ref(), Value::Null),
        Found::Absent([with, without]) => {
            let equal = with.is_some() && with == without;
            let digests = json!({ "with": with, "without": without, "equal": equal });
            (&nothing, digests)
        }
    };
    let told = |values: &[u64]| {
        let [median, p99] = quantiles(values);
        json!({ "median": median, "p99": p99 })
    };
    let [code, tables, variables] = called.sizes;
    let turns = called.turns;
    json!({
        "name": row.effect.name,
        "library": row.effect.library,
        "calls": row.effect.calls,
        "code_bytes": code,
        "table_bytes": tables,
        "variable_bytes": variables,
        "cycles": called.cycles,
        "share": share(found, called.cycles),
        "own": {
            "cycles": called.own.cycles,
            "share": share(found, i64::try_from(called.own.cycles).unwrap_or(i64::MAX)),
            "size": called.own.size,
        },
        "pixel_cycles": called.pixels.as_ref().map(|pixels| counted(pixels, told(pixels))),
        "pixel_cycles_modelled": told(&called.seen.cycles),
        "ran": called.seen.ran as f64 / found.watched.max(1) as f64,
        "turns": {
            "begun": turns.begun,
            "mean": turns.turns as f64 / turns.begun.max(1) as f64,
            "most": turns.most,
            "limit": turns.limit,
        },
        "loss": called.loss,
        "digests": digests,
    })
}

/// What the machine counted at pixels: also at how many, and in all.
fn counted(pixels: &[u64], mut told: Value) -> Value {
    told["at"] = json!(pixels.iter().filter(|n| **n > 0).count());
    told["total"] = json!(pixels.iter().sum::<u64>());
    told
}

fn text(found: &Effects) -> String {
    let proofs = proofs(found);
    format!(
        "{}\n\n{}\n{}{proofs}\n{}\n",
        head(found),
        rows(found),
        known(found),
        notes(found)
    )
}

/// The table as a picture: bars are what less time it would take without an effect.
fn svg(found: &Effects) -> String {
    let mut lines = vec![Line::plain(&head(found)), Line::plain("")];
    let bars = found.rows.iter().map(|row| match &row.found {
        Found::Called(called) => share(found, called.cycles),
        Found::Absent(_) => 0.0,
    });
    let bars = std::iter::once(None).chain(bars.map(Some));
    let table = rows(found);
    lines.extend(table.lines().zip(bars).map(|(text, bar)| Line {
        text: text.to_owned(),
        bar,
    }));
    lines.push(Line::plain(""));
    let below = known(found) + &notes(found);
    lines.extend(below.lines().map(Line::plain));
    sheet::svg(&head(found), &lines, 0)
}

fn head(found: &Effects) -> String {
    let plan = &found.whole.plan;
    let run = &found.counted.run;
    format!(
        "{} on {}, {}: {} pixels, {} {}",
        found.whole.scene,
        plan.target.name,
        plan.runtime.format,
        count(found.whole.pixels()),
        count(found.whole.run.cycles),
        unit(run)
    )
}

/// The table.
fn rows(found: &Effects) -> String {
    let titles = [
        "effect",
        "calls",
        "code",
        "tables",
        "variables",
        "cycles",
        "time",
        "own",
        "median",
        "p99",
        "ran",
        "turns",
        "psnr",
        "pixels",
    ];
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    rows.extend(found.rows.iter().map(|row| cells(found, row)));
    table(&rows)
}

/// That what is not called costs nothing.
fn proofs(found: &Effects) -> String {
    let mut proofs = String::new();
    for row in &found.rows {
        if let Found::Absent([with, without]) = &row.found {
            let name = &row.effect.name;
            proofs.push_str(&match (with, without) {
                (Some(with), Some(without)) if with == without => {
                    format!("{name} costs nothing: {with} with and without it\n")
                }
                (Some(with), Some(without)) => {
                    format!("{name} costs something: {with}, {without}\n")
                }
                _ => format!("{name} is needed by what is not called\n"),
            });
        }
    }
    proofs
}

/// What the columns are.
fn notes(found: &Effects) -> String {
    let by = match found.counted.stretches {
        Some(_) => "as the machine counts them",
        None => "by the routines' means, since this program does not part its pixels",
    };
    format!(
        "code, tables, variables: {} less without it; cycles, time: less without it; own: the share of \
         its own lines;\nmedian, p99: cycles of its own at a pixel, {by}; ran: the \
         share of pixels that need it,\nturns: its loops' mean and limit, both over {} pixels; psnr, \
         pixels: the picture without it",
        size_unit_of_sizes(found),
        count(found.watched as u64)
    )
}

/// What is saved where the ink is known before the shade is.
fn known(found: &Effects) -> String {
    let Known {
        cycles_saved,
        inks_changed,
    } = found.known;
    if cycles_saved == 0 {
        return "where the ink is known before the whole shade, nothing is saved\n".to_owned();
    }
    let whole = found.whole.run.cycles.saturating_add_signed(cycles_saved);
    let changed = match inks_changed {
        Some(0) => String::new(),
        Some(n) => format!("; {n} inks are rounded to others"),
        None => String::new(),
    };
    if cycles_saved < 0 {
        return format!(
            "where the ink is known before the whole shade, nothing is saved here: every shade in \
             full would take {} cycles less{changed}\n",
            count(cycles_saved.unsigned_abs())
        );
    }
    format!(
        "where the ink is known before the whole shade, {} of {} cycles are saved ({}){changed}\n",
        signed(cycles_saved),
        count(whole),
        percent(cycles_saved as f64 / whole.max(1) as f64)
    )
}

/// A difference, with its digits in threes.
fn signed(n: i64) -> String {
    let digits = count(n.unsigned_abs());
    if n < 0 { format!("-{digits}") } else { digits }
}

fn size_unit_of_sizes(found: &Effects) -> &'static str {
    match found.whole.run.sizes.code {
        Some(_) => "bytes",
        None => "bytes (code is not counted here)",
    }
}

fn cells(found: &Effects, row: &Row) -> Vec<String> {
    let nothing = Called::nothing();
    let name = match row.effect.library {
        true => format!("{} (library)", row.effect.name),
        false => row.effect.name.clone(),
    };
    let called = match &row.found {
        Found::Called(called) => called.as_ref(),
        Found::Absent(_) => &nothing,
    };
    let [median, p99] = quantiles(called.pixels.as_ref().unwrap_or(&called.seen.cycles));
    let turns = called.turns;
    let mut cells = vec![name, count(u64::from(row.effect.calls))];
    cells.extend(called.sizes.map(|size| size.map_or("-".to_owned(), signed)));
    cells.extend([
        signed(called.cycles),
        percent(share(found, called.cycles)),
        percent(share(
            found,
            i64::try_from(called.own.cycles).unwrap_or(i64::MAX),
        )),
        count(median),
        count(p99),
        percent(called.seen.ran as f64 / found.watched.max(1) as f64),
        match turns.begun {
            0 => "0".to_owned(),
            begun => format!(
                "{:.1} of {}",
                turns.turns as f64 / begun as f64,
                turns.limit
            ),
        },
        called
            .loss
            .psnr()
            .map_or("0".to_owned(), |db| format!("{db:.1} dB")),
        called
            .loss
            .pixels()
            .map_or("-".to_owned(), |n| count(n as u64)),
    ]);
    cells
}
