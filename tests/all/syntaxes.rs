//! The 6502's programs as each assembler has them: what the bundled one can read.

use crate::boxes::{MODES, waves};
use crate::cli::{STEPS, directory, json, slowlight, success};
use clap::Parser;
use slowlight::scene::{Changes, Scene};
use slowlight::target_args::ScreenArgs;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::target::mos6502::document;
use slowlight_compiler::target::mos6502::syntax::{self, USUAL};
use slowlight_compiler::target::{Target, find, formats};
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

/// Bytes of a small scene.
const SMALL: u64 = 2000;

#[derive(Parser)]
struct Options {
    #[command(flatten)]
    screen: ScreenArgs,
}

/// The plan that `build` makes of a scene in a format.
fn planned(path: &Path, format: &str) -> Plan {
    let mut all = formats(find("6502").expect("a target"));
    let target = all.find(|t| t.runtime.format == format).expect("a format");
    planned_for(path, target, &["build"])
}

fn planned_for(path: &Path, target: &'static Target, options: &[&str]) -> Plan {
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

/// The plan of each example, of odd scenes, and of one with every routine.
pub fn programs() -> &'static [Plan] {
    static PLANS: OnceLock<Vec<Plan>> = OnceLock::new();
    PLANS.get_or_init(|| {
        let odd = directory(&[("odd.scn", ODD)]);
        let mut all = ["examples", "examples/hard", "tests/scenes"]
            .map(scenes)
            .concat();
        all.push(odd.path().join("odd.scn"));
        let usual = all.iter().map(|path| planned(path, "fixed16.16"));
        // Of each scene that is small enough to be planned at once.
        let small = |path: &&PathBuf| std::fs::metadata(path).is_ok_and(|m| m.len() < SMALL);
        let own = all
            .iter()
            .filter(small)
            .flat_map(|path| ["fixed16", "fixed24"].map(|format| planned(path, format)));
        // Every kind of screen, each also with what else is written for some pictures.
        let waves = directory(&[("waves.scn", &waves(37, 23)), ("even.scn", &waves(48, 24))]);
        let kinds = MODES.iter().flat_map(|(target, mode, _)| {
            let all = formats(find(target).expect("a target"));
            let waves = waves.path();
            all.flat_map(move |target| {
                let of = |scene: &str, more: &[&str]| {
                    let options = [&["build", "--mode", mode], more].concat();
                    planned_for(&waves.join(scene), target, &options)
                };
                [of("waves.scn", &[]), of("even.scn", &["--block", "3x2"])]
            })
        });
        usual.chain(own).chain(kinds).collect()
    })
}

/// What the bundled assembler makes of the usual text.
pub fn usual(plan: &Plan) -> Assembly {
    assembled(plan, USUAL, Dialect::Common)
}

fn assembled(plan: &Plan, syntax: &syntax::Syntax, dialect: Dialect) -> Assembly {
    let text = document(plan, syntax).text;
    let name = &plan.name;
    assemble_as(&text, dialect).unwrap_or_else(|f| panic!("{name}, {}: {}", syntax.name, f[0]))
}

#[test]
fn beebasms_form_makes_the_same_bytes() {
    let beebasm = syntax::find("beebasm").expect("a syntax");
    let mut unseen = BTreeSet::new();
    let mut seen = BTreeSet::new();
    for plan in programs() {
        let read = assembled(plan, beebasm, Dialect::Beebasm);
        assert!(usual(plan).image() == read.image(), "{}", plan.name);
        let text = document(plan, beebasm).text;
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
fn a_program_is_built_for_an_assembler() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let dir = dir.path();
    let read = |name: &str| std::fs::read(dir.join(name)).expect(name);
    let build = ["build", "steps.scn", "-t", "6502", "-o"];
    success(dir, &[&build[..], &["usual"]].concat());
    success(dir, &[&build[..], &["bee", "--syntax", "beebasm"]].concat());
    assert_eq!(read("usual/steps.bin"), read("bee/steps.bin"));
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
