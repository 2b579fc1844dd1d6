//! The planner's price of plans held to the machines: over a set of scenes, what `build` says that
//! a program takes, and what the machine then takes for the whole picture.
//!
//! `cargo bench --bench prices -- SCENE...` (the examples where none is named). Pictures are made
//! smaller, to about [`PIXELS`]. The table is Markdown, for docs/passes.md; with `--each` there is
//! a line for each program before it.

mod corpus;

use corpus::{build, said, scenes};
use rayon::prelude::*;
use std::path::Path;

const TARGETS: [&str; 5] = ["jack", "6502:plain", "6502:c64", "6502:bbc", "bbc:micro"];

/// How many pixels a picture has, about.
const PIXELS: f64 = 8_000.0;

/// A program: what it was thought to take, and what it took, in cycles.
struct Program {
    scene: String,
    format: String,
    target: &'static str,
    priced: f64,
    cycles: f64,
}

impl Program {
    fn ratio(&self) -> f64 {
        self.priced / self.cycles
    }
}

fn main() {
    let scenes = scenes();
    let jobs: Vec<_> = (scenes.iter())
        .flat_map(|scene| TARGETS.map(|target| (scene, target)))
        .collect();
    let all: Vec<Program> = jobs
        .par_iter()
        .filter_map(|(scene, target)| program(scene, target))
        .collect();
    if std::env::args().any(|arg| arg == "--each") {
        for one in &all {
            println!(
                "{} {} {}: {:.0} for {:.0} cycles, {:.3}",
                one.target,
                one.scene,
                one.format,
                one.priced,
                one.cycles,
                one.ratio()
            );
        }
    }
    println!("| target | programs | rank correlation | median ratio | median error |");
    println!("|---|---|---|---|---|");
    for target in TARGETS {
        let of: Vec<&Program> = all.iter().filter(|one| one.target == target).collect();
        println!("{}", line(target, &of));
    }
    println!("{}", line("all", &all.iter().collect::<Vec<_>>()));
}

/// A line of the table.
fn line(target: &str, of: &[&Program]) -> String {
    let mut ratios: Vec<f64> = of.iter().map(|one| one.ratio()).collect();
    let mut off: Vec<f64> = ratios.iter().map(|ratio| (ratio - 1.0).abs()).collect();
    format!(
        "| {target} | {} | {:.3} | {:.2} | {:.1}% |",
        of.len(),
        correlation(of),
        median(&mut ratios),
        100.0 * median(&mut off)
    )
}

/// Spearman's rank correlation of prices and cycles.
fn correlation(all: &[&Program]) -> f64 {
    let ranks = |of: fn(&Program) -> f64| {
        let mut order: Vec<usize> = (0..all.len()).collect();
        order.sort_by(|a, b| of(all[*a]).total_cmp(&of(all[*b])));
        let mut ranks = vec![0.0; all.len()];
        for (rank, at) in order.into_iter().enumerate() {
            ranks[at] = rank as f64;
        }
        ranks
    };
    let (a, b) = (ranks(|one| one.priced), ranks(|one| one.cycles));
    let apart: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum();
    let count = all.len().max(2) as f64;
    1.0 - 6.0 * apart / (count * (count * count - 1.0))
}

fn median(all: &mut [f64]) -> f64 {
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Nothing where the scene does not fit the machine.
fn program(scene: &Path, target: &'static str) -> Option<Program> {
    let dir = tempfile::tempdir().ok()?;
    let small = dir.path().join("small.scn");
    std::fs::write(&small, smaller(&std::fs::read_to_string(scene).ok()?)?).ok()?;
    let built = build(&small, target, &[])?;
    let ran = said(&small, target, &["run"])?;
    Some(Program {
        scene: scene.file_stem()?.to_string_lossy().into_owned(),
        format: built["format"].as_str()?.to_owned(),
        target,
        priced: built["priced"].as_f64()?,
        cycles: ran["cycles"].as_f64()?,
    })
}

/// A scene of a picture as small as that.
fn smaller(scene: &str) -> Option<String> {
    let start = scene
        .lines()
        .find(|line| line.trim_start().starts_with("image "))?;
    let mut words = start.split_whitespace().skip(1);
    let width: f64 = words.next()?.parse().ok()?;
    let height: f64 = words.nth(1)?.parse().ok()?;
    let by = (width * height / PIXELS).sqrt().max(1.0);
    let size = format!("image {:.0} x {:.0}", width / by, height / by);
    Some(scene.replacen(&format!("image {width} x {height}"), &size, 1))
}
