//! Ablation of the planner's passes: what each is worth over a set of scenes.
//!
//! `cargo bench --bench ablation -- SCENE...` (the examples where none is named) builds each scene
//! for [`TARGETS`] as it is and without each pass that was kept there, in the same format. What a
//! pass is worth is how many times as many cycles programs take without it, by the forecast that
//! `build` tells from some of their rows. A second table holds the planner's price of the usual
//! programs to that forecast. Both are Markdown, for docs/passes.md.

use rayon::prelude::*;
use serde_json::Value;
use slowlight_compiler::planner::pipeline::{PASSES, Pass};
use std::path::{Path, PathBuf};
use std::process::Command;

const TARGETS: [&str; 3] = ["jack", "6502:plain", "bbc:micro"];

/// A program's forecast in cycles, the work that its plan took, and what the planner thinks
/// that it takes.
struct Cost {
    cycles: f64,
    work: f64,
    priced: f64,
}

/// A scene on a target, as it is and without some passes.
struct Ablated {
    scene: String,
    target: usize,
    usual: Cost,
    without: Vec<(Pass, Option<Cost>)>,
}

fn main() {
    let named: Vec<PathBuf> = std::env::args()
        .skip(1)
        .filter(|arg| !arg.starts_with("--"))
        .map(PathBuf::from)
        .collect();
    let scenes = if named.is_empty() { examples() } else { named };
    let jobs: Vec<(&PathBuf, usize)> = (scenes.iter())
        .flat_map(|scene| (0..TARGETS.len()).map(move |target| (scene, target)))
        .collect();
    let all: Vec<Ablated> = jobs
        .par_iter()
        .filter_map(|(scene, target)| ablated(scene, *target))
        .collect();
    println!("{} programs of {} scenes", all.len(), scenes.len());
    println!();
    print!("| pass | what it does | lines | programs |");
    TARGETS.iter().for_each(|target| print!(" {target} |"));
    println!(" most | work |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for pass in PASSES {
        println!("{}", row(*pass, &all));
    }
    println!();
    println!("| target | programs | rank correlation | median ratio | median error |");
    println!("|---|---|---|---|---|");
    for target in 0..TARGETS.len() {
        println!("{}", priced(target, &all));
    }
}

/// A target's line of the table of prices.
fn priced(target: usize, all: &[Ablated]) -> String {
    let usual: Vec<&Cost> = (all.iter())
        .filter(|one| one.target == target)
        .map(|one| &one.usual)
        .collect();
    let mut ratios: Vec<f64> = usual.iter().map(|cost| cost.priced / cost.cycles).collect();
    let mut off: Vec<f64> = ratios.iter().map(|ratio| (ratio - 1.0).abs()).collect();
    format!(
        "| {} | {} | {:.3} | {:.2} | {:.1}% |",
        TARGETS[target],
        usual.len(),
        correlation(&usual),
        median(&mut ratios),
        100.0 * median(&mut off)
    )
}

/// Spearman's rank correlation of prices and cycles.
fn correlation(all: &[&Cost]) -> f64 {
    let ranks = |of: fn(&Cost) -> f64| {
        let mut order: Vec<usize> = (0..all.len()).collect();
        order.sort_by(|a, b| of(all[*a]).total_cmp(&of(all[*b])));
        let mut ranks = vec![0.0; all.len()];
        for (rank, at) in order.into_iter().enumerate() {
            ranks[at] = rank as f64;
        }
        ranks
    };
    let (a, b) = (ranks(|cost| cost.priced), ranks(|cost| cost.cycles));
    let apart: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum();
    let count = all.len().max(2) as f64;
    1.0 - 6.0 * apart / (count * (count * count - 1.0))
}

fn median(all: &mut [f64]) -> f64 {
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(f64::NAN)
}

/// A pass's line of the table.
fn row(pass: Pass, all: &[Ablated]) -> String {
    let of = |target: usize| {
        let those = all.iter().filter(move |one| one.target == target);
        those.map(move |one| ratio(one, pass, |cost| cost.cycles))
    };
    let means: Vec<String> = (0..TARGETS.len())
        .map(|target| format!("{:.4}", mean(of(target).collect())))
        .collect();
    let changed = all.iter().filter(|one| has(one, pass)).count();
    let most = all
        .iter()
        .map(|one| (ratio(one, pass, |cost| cost.cycles), one))
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let most = match most {
        Some((most, one)) if most > 1.0 => {
            format!("{most:.3} {} {}", one.scene, TARGETS[one.target])
        }
        _ => String::new(),
    };
    let work = mean(
        all.iter()
            .map(|one| ratio(one, pass, |cost| cost.work))
            .collect(),
    );
    let (name, file, what) = pass.about();
    format!(
        "| `{name}` | {what} | {} | {changed} | {} | {most} | {work:.3} |",
        lines(file),
        means.join(" | ")
    )
}

fn has(one: &Ablated, pass: Pass) -> bool {
    one.without.iter().any(|(of, _)| *of == pass)
}

/// How many times as much a program takes without a pass; what cannot be built without it counts
/// as ten times.
fn ratio(one: &Ablated, pass: Pass, of: fn(&Cost) -> f64) -> f64 {
    match one.without.iter().find(|(other, _)| *other == pass) {
        None => 1.0,
        Some((_, None)) => 10.0,
        Some((_, Some(cost))) => of(cost) / of(&one.usual),
    }
}

/// The geometric mean.
fn mean(all: Vec<f64>) -> f64 {
    let count = all.len().max(1) as f64;
    (all.iter().map(|one| one.ln()).sum::<f64>() / count).exp()
}

/// Nothing where the scene does not build as it is.
fn ablated(scene: &Path, target: usize) -> Option<Ablated> {
    let built = build(scene, target, &[])?;
    let format = built["format"].as_str()?.to_owned();
    let passes = built["passes"].as_object()?;
    let kept = |pass: &&Pass| {
        let count = passes.get(pass.about().0);
        // What the scene declares counts where loops are peeled, too.
        count.is_some_and(|count| count["kept"] != 0 || **pass == Pass::EarlyExit)
    };
    let usual = build(scene, target, &["--format", &format])?;
    let without = PASSES.iter().filter(kept).map(|pass| {
        let args = ["--format", &format, "--without-pass", pass.about().0];
        (*pass, build(scene, target, &args).as_ref().and_then(cost))
    });
    Some(Ablated {
        scene: scene.file_stem()?.to_string_lossy().into_owned(),
        target,
        usual: cost(&usual)?,
        without: without.collect(),
    })
}

fn cost(built: &Value) -> Option<Cost> {
    Some(Cost {
        cycles: built["cycles"].as_f64()?,
        work: built["work"].as_f64()?.max(1.0),
        priced: built["priced"].as_f64()?,
    })
}

/// What `build` says of a scene.
fn build(scene: &Path, target: usize, args: &[&str]) -> Option<Value> {
    let dir = tempfile::tempdir().ok()?;
    let out = Command::new(env!("CARGO_BIN_EXE_slowlight"))
        .args(["build", "--json", "-t", TARGETS[target], "-o"])
        .arg(dir.path())
        .arg(scene)
        .args(args)
        .output()
        .ok()?;
    serde_json::from_slice(&out.stdout).ok()
}

/// How many lines a pass has, tests apart.
fn lines(file: &str) -> usize {
    let at = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("compiler/src")
        .join(file);
    let mut all = vec![at.with_extension("rs")];
    if let Ok(inside) = std::fs::read_dir(&at) {
        all.extend(inside.filter_map(|entry| Some(entry.ok()?.path())));
    }
    let text = |path: &PathBuf| match path.to_string_lossy().contains("tests") {
        true => 0,
        false => std::fs::read_to_string(path).map_or(0, |text| text.lines().count()),
    };
    all.iter().map(text).sum()
}

fn examples() -> Vec<PathBuf> {
    let dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let scenes = std::fs::read_dir(dir).into_iter().flatten();
    let mut all: Vec<PathBuf> = scenes
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|ext| ext == "scn"))
        .collect();
    all.sort();
    all
}
