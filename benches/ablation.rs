//! Ablation of the planner's passes: what each is worth over a set of scenes.
//!
//! `cargo bench --bench ablation -- SCENE...` (the examples where none is named) builds each scene
//! for [`TARGETS`] as it is and without each pass that was kept there, in the same format. What a
//! pass is worth is how many times as many cycles programs take without it, by the forecast that
//! `build` tells from some of their rows. The table is Markdown, for docs/passes.md.

mod corpus;

use corpus::{build, scenes};
use rayon::prelude::*;
use serde_json::Value;
use slowlight_compiler::planner::pipeline::{PASSES, Pass};
use std::path::{Path, PathBuf};

const TARGETS: [&str; 3] = ["jack", "6502:plain", "bbc:micro"];

/// What is done before there is a graph: programs that it changes have it.
const EARLY: [Pass; 2] = [Pass::Bounds, Pass::Instances];

/// A program's forecast in cycles, and the work that its plan took.
struct Cost {
    cycles: f64,
    work: f64,
}

/// A scene on a target, as it is and without some passes.
struct Ablated {
    scene: String,
    target: usize,
    usual: Cost,
    without: Vec<(Pass, Option<Cost>)>,
}

fn main() {
    let scenes = scenes();
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
    let built = build(scene, TARGETS[target], &[])?;
    let format = built["format"].as_str()?.to_owned();
    let passes = built["passes"].as_object()?;
    let kept = |pass: &&Pass| {
        // What is done before there is a graph is not counted as it runs.
        if EARLY.contains(*pass) {
            return true;
        }
        let count = passes.get(pass.about().0);
        // What the scene declares counts where loops are peeled, too.
        count.is_some_and(|count| count["kept"] != 0 || **pass == Pass::EarlyExit)
    };
    let usual = cost(&build(scene, TARGETS[target], &["--format", &format])?)?;
    let without = PASSES.iter().filter(kept).map(|pass| {
        let args = ["--format", &format, "--without-pass", pass.about().0];
        (
            *pass,
            build(scene, TARGETS[target], &args).as_ref().and_then(cost),
        )
    });
    let changed = |(pass, cost): &(Pass, Option<Cost>)| {
        let same = |cost: &Cost| EARLY.contains(pass) && cost.cycles == usual.cycles;
        !cost.as_ref().is_some_and(same)
    };
    let without = without.filter(changed).collect();
    Some(Ablated {
        scene: scene.file_stem()?.to_string_lossy().into_owned(),
        target,
        usual,
        without,
    })
}

fn cost(built: &Value) -> Option<Cost> {
    Some(Cost {
        cycles: built["cycles"].as_f64()?,
        work: built["work"].as_f64()?.max(1.0),
    })
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
