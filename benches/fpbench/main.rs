//! Proved error bounds over measured errors on the cores of FPBench (Damouche et al., Toward a
//! Standard Benchmark Format and Suite for Floating-Point Analysis, 2017).
//!
//! `cargo bench --bench fpbench -- DIR` reads the `.fpcore` files of a directory, the suite's
//! `benchmarks`, and says as a Markdown table of each core that the scene language can say what is
//! proved of its error in each format of [`FORMATS`], or of those named by `--format F`, and what
//! the worst of [`POINTS`] points at random within its precondition was.

mod core;
#[path = "../../compiler/src/eval/random.rs"]
mod random;
mod reader;
mod trial;
mod within;

use crate::core::Core;
use slowlight_compiler::targets::{Target, in_all_formats};
use std::collections::BTreeMap;
use std::path::PathBuf;
use trial::Fared;

const FORMATS: [&str; 3] = ["f316", "real40", "fixed16.16"];

const POINTS: usize = 10_000;

/// How many statements and roundings a bound is worth: some thousand boxes of inputs.
const FUEL: u64 = 200_000;

fn main() {
    let args: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| a != "--bench")
        .collect();
    let Some(dir) = args.first().filter(|a| !a.starts_with('-')) else {
        println!("usage: cargo bench --bench fpbench -- DIR [--format F]...");
        return;
    };
    let named: Vec<&str> = (args.windows(2))
        .filter(|w| w[0] == "--format")
        .map(|w| w[1].as_str())
        .collect();
    let formats = if named.is_empty() {
        &FORMATS[..]
    } else {
        &named
    };
    let (said, unsaid) = cores(dir);
    println!(
        "{} of {} cores can be said; the others:",
        said.len(),
        said.len() + unsaid.values().sum::<usize>()
    );
    for (why, count) in &unsaid {
        println!("- {count}: {why}");
    }
    println!();
    let targets: Vec<&'static Target> = (formats.iter())
        .filter_map(|format| in_all_formats().find(|t| t.runtime.format == *format))
        .collect();
    let number = |name: &str| {
        let at = args.iter().position(|a| a == name)?;
        args.get(at + 1)?.parse().ok()
    };
    let points = number("--points").map_or(POINTS, |n| n as usize);
    table(&said, &targets, points, number("--fuel").unwrap_or(FUEL));
}

/// The cores that can be said, and how many cannot for each reason.
fn cores(dir: &str) -> (Vec<Core>, BTreeMap<String, usize>) {
    let files = std::fs::read_dir(dir).into_iter().flatten();
    let mut files: Vec<PathBuf> = files.filter_map(|f| Some(f.ok()?.path())).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "fpcore"));
    files.sort();
    let (mut said, mut unsaid) = (Vec::new(), BTreeMap::new());
    for path in files {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        for (_, made) in reader::read(&text).iter().filter_map(core::core) {
            match made {
                Ok(core) => said.push(core),
                Err(why) => *unsaid.entry(why).or_default() += 1,
            }
        }
    }
    (said, unsaid)
}

/// A line for each core, and what they come to.
fn table(cores: &[Core], targets: &[&'static Target], points: usize, fuel: u64) {
    let names: Vec<&str> = targets.iter().map(|t| t.runtime.format).collect();
    println!("| core | {} |", names.join(" | "));
    println!("|---|{}", "---|".repeat(names.len()));
    let mut all: Vec<Vec<Fared>> = vec![Vec::new(); targets.len()];
    for core in cores {
        let mut cells = Vec::new();
        for (target, all) in targets.iter().zip(&mut all) {
            let fared = trial::planned(core, target);
            match fared.and_then(|plan| trial::tried(core, plan, points, fuel)) {
                Ok(fared) => {
                    cells.push(cell(&fared));
                    all.push(fared);
                }
                Err(why) => cells.push(why),
            }
        }
        println!("| {} | {} |", core.name, cells.join(" | "));
    }
    println!();
    println!(
        "| format | cores | with a bound | median ratio of these | of all | bounds exceeded |"
    );
    println!("|---|---|---|---|---|---|");
    for (name, all) in names.iter().zip(&all) {
        let count = all.len();
        let bounded = all.iter().filter(|f| f.proved.is_finite()).count();
        let exceeded: usize = all.iter().map(|f| f.exceeded).sum();
        let mut ratios: Vec<f64> = all.iter().filter_map(Fared::ratio).collect();
        let these = median(&mut ratios);
        // What has no bound is beyond all that have one; what is never off has no ratio.
        ratios.resize(ratios.len() + count - bounded, f64::INFINITY);
        let each = median(&mut ratios);
        println!("| {name} | {count} | {bounded} | {these:.2} | {each:.2} | {exceeded} |");
    }
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn cell(fared: &Fared) -> String {
    let ratio = fared.ratio().map_or("-".to_owned(), |r| format!("{r:.1}"));
    let flips = if fared.undecided { " (may flip)" } else { "" };
    format!(
        "{:.1e} / {:.1e} = {ratio}{flips}",
        fared.proved, fared.measured
    )
}
