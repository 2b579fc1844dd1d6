//! The 6502's programs as each assembler has them: what the bundled one can read.

use crate::boxes::{MODES, waves};
use crate::cli::{STEPS, directory, json, slowlight, success};
use clap::Parser;
use rayon::prelude::*;
use slowlight::scene::{Changes, Scene};
use slowlight::target_args::ScreenArgs;
use slowlight_compiler::backend::mos6502::document;
use slowlight_compiler::backend::mos6502::syntax;
use slowlight_compiler::backend::mos6502::syntax::USUAL;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::{Target, find, formats};
use slowlight_vm::mos6502::{Assembly, Dialect, assemble_as};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Names that assemblers keep for themselves, and numbers of more than 24 bits.
const ODD: &str = "image 24 x 16 inks black, red, white;
param _tilt: real = -0.25 in -1 .. 1;
param bra: real = 0.5 in 0 .. 1;
param shl: int = 100000000;
param below: int = -8388609;
param PI: int = -8388608;
param EQUB: int = 8388607;
param Acc: int = -2000000000;
const gaps = [0, 2, 1, 1, 2];
draw (x, y) = {
  let byte = x * _tilt;
  let word = y * bra;
  ink((floor(byte + word) + shl + below + PI + EQUB + Acc + gaps[x mod 5, 0]) mod 3)
};";

/// Bytes of a small scene, which is soon planned; all of them have every part of the runtimes.
const SMALL: u64 = 810;

#[derive(Parser)]
struct Options {
    #[command(flatten)]
    screen: ScreenArgs,
}

/// The 6502 with reals in a format.
fn in_format(name: &str) -> &'static Target {
    let mut all = formats(find("6502").expect("a target"));
    all.find(|t| t.runtime.format == name).expect("a format")
}

/// The plan that `build` makes of a scene.
fn planned(path: &Path, target: &'static Target, options: &[&str]) -> PlannedScene {
    let options = Options::parse_from(options);
    let scene = Scene::open(path, &Changes::default());
    let plan = scene.and_then(|scene| options.screen.plan(&scene, target, &[]));
    plan.unwrap_or_else(|_| panic!("{} does not build", path.display()))
}

/// The scenes in a directory of the repository.
fn scenes(directory: &str) -> Vec<PathBuf> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join(directory);
    let entries = std::fs::read_dir(directory).expect("a directory");
    let paths = entries.map(|e| e.expect("an entry").path());
    let mut scenes: Vec<PathBuf> = paths
        .filter(|p| p.extension().is_some_and(|e| e == "scn"))
        .collect();
    scenes.sort();
    scenes
}

/// What assemblers are given.
pub struct Program {
    pub plan: PlannedScene,
    /// What the bundled assembler makes of the usual text.
    pub usual: Assembly,
}

impl Program {
    fn of(plan: PlannedScene) -> Program {
        let usual = read(&plan, &document(&plan, USUAL).text, Dialect::Common);
        Program { plan, usual }
    }
}

/// A scene, its machine in a format, and what else `build` is told.
type Build = (PathBuf, &'static Target, Vec<&'static str>);

/// Each example, odd scenes, and one with every routine.
pub fn programs() -> &'static [Program] {
    static PROGRAMS: OnceLock<Vec<Program>> = OnceLock::new();
    PROGRAMS.get_or_init(|| {
        let odd = directory(&[("odd.scn", ODD)]);
        let waves = directory(&[("waves.scn", &waves(37, 23)), ("even.scn", &waves(48, 24))]);
        let mut all = ["examples", "examples/hard"].map(scenes).concat();
        all.extend(scenes("tests/scenes"));
        all.push(odd.path().join("odd.scn"));
        let all = [builds(&all), screens(waves.path())].concat();
        let programs = all.par_iter().map(|(path, target, options)| {
            let plan = planned(path, target, &[&["build"], &options[..]].concat());
            Program::of(plan)
        });
        programs.collect()
    })
}

/// Whether a scene is small enough to be planned at once.
fn is_small(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|m| m.len() < SMALL)
}

/// Scenes as they are usually built, small ones in other formats too, and what else there is.
fn builds(scenes: &[PathBuf]) -> Vec<Build> {
    let mut all = Vec::new();
    for path in scenes {
        let named = |name: &str| path.ends_with(name);
        let mut add = |format: &str, options: &[&'static str]| {
            all.push((path.clone(), in_format(format), options.to_vec()));
        };
        add("fixed16.16", &[]);
        if is_small(path) {
            add("fixed12", &[]);
            add("fixed16", &[]);
            add("fixed24", &[]);
        }
        // All that logarithms have, and floats.
        if named("tests/scenes/routines.scn") {
            add("log10", &[]);
            add("real40", &[]);
        }
        // Opcodes that the data sheet leaves out.
        if named("examples/maze.scn") || named("examples/masks.scn") {
            add("fixed16", &["--undocumented"]);
        }
        // What is short is called.
        if named("examples/csg.scn") {
            let bbc = formats(find("6502:bbc").expect("a target"));
            let short = bbc.filter(|t| t.runtime.format == "fixed16");
            all.extend(short.map(|target| (path.clone(), target, Vec::new())));
        }
    }
    all
}

/// Every kind of screen, each also with what else is written for some pictures.
fn screens(waves: &Path) -> Vec<Build> {
    let mut all = Vec::new();
    for (target, mode, _) in MODES {
        for target in formats(find(target).expect("a target")) {
            all.push((waves.join("waves.scn"), target, vec!["--mode", mode]));
            let blocks = vec!["--mode", mode, "--block", "3x2"];
            all.push((waves.join("even.scn"), target, blocks));
        }
    }
    all
}

fn read(plan: &PlannedScene, text: &str, dialect: Dialect) -> Assembly {
    let name = &plan.name;
    assemble_as(text, dialect).unwrap_or_else(|f| panic!("{name}: {}", f[0]))
}

#[test]
fn beebasms_form_makes_the_same_bytes() {
    let beebasm = syntax::find("beebasm").expect("a syntax");
    let mut unseen = BTreeSet::new();
    let mut seen = BTreeSet::new();
    for Program { plan, usual } in programs() {
        let text = document(plan, beebasm).text;
        let read = read(plan, &text, Dialect::Beebasm);
        assert!(usual.image() == read.image(), "{}", plan.name);
        let has = |part: &&str| text.contains(&format!("; ---- runtime: {part}\n"));
        let parts = plan.runtime.parts.iter().map(|p| p.name);
        let (in_it, not): (BTreeSet<&str>, BTreeSet<&str>) = parts.partition(has);
        seen.extend(in_it);
        unseen.extend(not);
    }
    unseen.retain(|part| !part.ends_with("_page") && !seen.contains(part));
    assert!(unseen.is_empty(), "in no program: {unseen:?}");
}

#[test]
fn undocumented_opcodes_are_put_where_they_are_asked_for() {
    let dir = directory(&[("ball.scn", include_str!("../scenes/ball.scn"))]);
    let dir = dir.path();
    for target in ["6502:plain", "6502:bbc", "6502:c64"] {
        let run = [
            "run", "ball.scn", "-t", target, "--format", "fixed16", "--json",
        ];
        let [without, with] =
            [vec![], vec!["--undocumented"]].map(|more| json(dir, &[&run[..], &more].concat()));
        assert_eq!(with["differs_from_model"], 0, "{target}");
        assert_eq!(with["inks_sha256"], without["inks_sha256"], "{target}");
        // Cycles may be a few more: a table that moves may come to lie across a page.
        let bytes = |run: &serde_json::Value| run["code_bytes"].as_u64();
        assert!(bytes(&with) < bytes(&without), "{target}");
    }
    let jack = ["build", "ball.scn", "-t", "jack", "--undocumented"];
    assert_eq!(slowlight(dir, &jack).status.code(), Some(2));
}

#[test]
fn a_program_is_built_for_an_assembler() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let dir = dir.path();
    let read = |name: &str| std::fs::read(dir.join(name)).expect(name);
    let build = ["build", "steps.scn", "-t", "6502", "-o"];
    success(dir, &[&build[..], &["usual"]].concat());
    success(dir, &[&build[..], &["bee", "--syntax", "beebasm"]].concat());
    assert_eq!(read("usual/steps.prg"), read("bee/steps.prg"));
    let text = success(
        dir,
        &[
            "build",
            "steps.scn",
            "-t",
            "6502",
            "--syntax",
            "beebasm",
            "--emit",
            "text",
        ],
    );
    assert_eq!(read("bee/steps.asm"), text.as_bytes());
    // The bundled assembler reads it where it is told to, and only there.
    let run = json(dir, &["vm", "6502", "usual/steps.asm", "--json"]);
    let bee = ["vm", "6502", "bee/steps.asm", "--json"];
    assert_eq!(
        run,
        json(dir, &[&bee[..], &["--syntax", "beebasm"]].concat())
    );
    assert_eq!(slowlight(dir, &bee).status.code(), Some(1));
}
