//! Every stage of small scenes, and the generated code of mirrors for each
//! target: source and output in one file, so that a change shows in review.

use slowlight::scene::Precision;
use slowlight_compiler::analysis::range::{Slack, ranges};
use slowlight_compiler::analysis::rate::rates;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::plan::print::{ranges_text, rates_text};
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::planner::plan;
use slowlight_compiler::scene::{self, Scene};
use slowlight_compiler::schedule::statements::schedule;
use slowlight_compiler::sema::Options;
use slowlight_compiler::syntax;
use slowlight_compiler::targets::{TARGETS, Target, default_mode};
use std::fmt::Write;

fn load(name: &str) -> (String, Scene) {
    let path = format!("{}/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("a scene");
    let scene = scene::check(name, &text);
    assert_eq!(scene.diagnostics, []);
    (text, scene)
}

fn planned(scene: &Scene, name: &str, target: &'static Target) -> PlannedScene {
    let image = scene.lower(&Options::default()).expect("a graph").image;
    let mode = default_mode(target, image.width, image.height).expect("a mode");
    let options = Precision::of(target).options(Options {
        inks: Some(mode.inks),
        ..Options::default()
    });
    let graph = scene.lower(&options).expect("a graph");
    let goal = Goal {
        name: name.to_owned(),
        mode,
        rows: None,
        plot: true,
    };
    plan(&graph, target, &goal).expect("a plan")
}

pub fn check(name: &str, output: &str) {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/snapshots");
    insta::with_settings!({ snapshot_path => folder, prepend_module_to_snapshot => false, omit_expression => true }, {
        insta::assert_snapshot!(name, output);
    });
}

#[test]
fn every_stage_of_small_scenes() {
    for name in ["gradient", "ball", "spiral"] {
        let (text, scene) = load(&format!("tests/scenes/{name}.scn"));
        let graph = scene.lower(&Options::default()).expect("a graph");
        let tree = schedule(&graph);
        let stages = [
            ("tokens", syntax::print::tokens(&text)),
            ("tree", syntax::print::tree(&syntax::parse(&text, 0).0)),
            ("program", scene.program.to_string()),
            ("graph", graph.to_string()),
            ("rates", rates_text(&graph, &rates(&graph))),
            ("statements", tree.to_string()),
            (
                "ranges",
                ranges_text(&graph, &ranges(&graph, &tree, &Slack::exact())),
            ),
        ];
        let mut output = text.clone();
        for (stage, printed) in stages {
            let _ = write!(output, "\n===== {stage}\n{printed}");
        }
        // The 6502's machines have plans in common.
        for target in TARGETS.iter().filter(|t| !is_box(t)) {
            let plan = planned(&scene, name, target);
            let _ = write!(output, "\n===== plan for {}\n{}", target.name, plan.plan);
        }
        check(&format!("stages_{name}"), &output);
    }
}

/// A machine around a 6502 beside the plain one.
fn is_box(target: &Target) -> bool {
    matches!(target.name, "6502:bbc" | "6502:c64")
}

#[test]
fn generated_code() {
    for name in ["tests/scenes/ball", "examples/mirrors"] {
        let (text, scene) = load(&format!("{name}.scn"));
        let stem = name.rsplit('/').next().unwrap_or(name);
        // What the 6502's machines have of their own is in small programs as well.
        let large = stem == "mirrors";
        for target in TARGETS.iter().filter(|t| !large || !is_box(t)) {
            let plan = planned(&scene, stem, target);
            let mut output = text.clone();
            for document in slowlight_compiler::backend::emit(&plan) {
                let lines = document.text.lines().count();
                assert_eq!(
                    document.lines.len(),
                    lines,
                    "{}: a place a line",
                    document.name
                );
                let _ = write!(output, "\n===== {}\n{}", document.name, document.text);
            }
            check(
                &format!("code_{stem}_{}", target.name.replace(':', "_")),
                &output,
            );
        }
    }
}
