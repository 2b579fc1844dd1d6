//! `explain`: every cycle of a machine is told by the scene's lines, on every target.

use crate::cli::{directory, json, names, slowlight, success, usual_format};
use crate::cli_run::{SPOT, targets};
use serde_json::Value;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::planner::plan;
use slowlight_compiler::report::raised::{RaisedRun, raisable};
use slowlight_compiler::scene::check;
use slowlight_compiler::sema::Options;
use slowlight_compiler::targets::{default_mode, in_all_formats};
use std::path::Path;

/// Scenes that come with the project, and rows of each that are quick to draw.
const SCENES: &[(&str, &str)] = &[
    ("fog", "20..20"),
    ("masks", "60..62"),
    ("maze", "10..14"),
    ("mirrors", "60..65"),
    ("shadows", "20..20"),
    ("torus", "20..20"),
    ("wave", "20..20"),
];

/// The other scenes, and a row of each: on Jack, and two of them on a machine of each kind.
const OTHERS: &[(&str, &str)] = &[
    ("csg", "20"),
    ("glass", "20"),
    ("room", "20"),
    ("terrain", "20"),
    ("torus-march", "20"),
    ("torus-original", "20"),
    ("primitives", "0"),
    ("colours", "100"),
];

/// Scenes that take long even so: on one machine.
const LONG: &[(&str, &str)] = &[("fifty", "20"), ("focus", "20"), ("twist", "20")];

fn sum(parts: &Value, key: &str) -> u64 {
    let parts = parts.as_array().expect("a list").iter();
    parts
        .map(|part| part[key].as_u64().expect("a number"))
        .sum()
}

/// What must hold of every profile: all cycles are told, each once, and nearly all by lines.
fn is_whole(profile: &Value, run: &Value, what: &str) {
    let cycles = profile["cycles"].as_u64().expect("cycles");
    assert_eq!(cycles, run["cycles"].as_u64().expect("cycles"), "{what}");
    let lines = &profile["lines"];
    let rest = profile["rest"].as_u64().expect("a number");
    assert_eq!(sum(lines, "cycles") + rest, cycles, "{what}");
    let accounted = profile["accounted"].as_f64().expect("a share");
    assert!(accounted >= 0.98, "{what}: {accounted}");
    for line in lines.as_array().expect("a list") {
        let own = line["cycles"].as_u64().expect("cycles");
        for parts in ["parts", "library"] {
            let told = sum(&line[parts], "cycles");
            assert!(told <= own, "{what}: {told} {parts} of {own} in {line}");
        }
        let text = line["text"].as_str().expect("a text").trim();
        assert!(
            own == 0 || !text.is_empty() && !text.starts_with("//"),
            "{what}: {line}"
        );
    }
}

fn held(dir: &Path, scene: &str, target: &str, more: &[&str]) -> Value {
    let of = |command: &str| {
        let args = [&[command, scene, "--target", target, "--json"], more].concat();
        json(dir, &args)
    };
    let (profile, run) = (of("explain"), of("run"));
    is_whole(&profile, &run, &format!("{scene} on {target}"));
    profile
}

#[test]
fn every_cycle_has_a_line_of_the_scene() {
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    for (scene, rows) in SCENES {
        let scene = format!("{scene}.scn");
        for target in targets(Path::new(examples)) {
            // As they are written, most are too large for the 6502's machines, which share
            // their code with the plain one.
            let is_box = ["6502:bbc", "6502:c64"].contains(&target.as_str());
            if is_box && !["maze.scn", "masks.scn"].contains(&scene.as_str()) {
                continue;
            }
            let more = ["--rows", rows, "--as-written"];
            held(Path::new(examples), &scene, &target, &more);
        }
    }
}

#[test]
fn and_so_it_has_in_every_scene() {
    let examples = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/examples"));
    let looked = |(scene, rows): &(&str, &str), targets: &[&str]| {
        let scene = format!("{scene}.scn");
        for target in targets {
            let args = ["explain", &scene, "-t", target, "--json", "--as-written"];
            let profile = json(examples, &[&args[..], &["--rows", rows]].concat());
            is_whole(&profile, &profile, &format!("{scene} on {target}"));
        }
    };
    OTHERS.iter().for_each(|scene| looked(scene, &["jack"]));
    for scene in [OTHERS[2], OTHERS[3]] {
        looked(&scene, &["bbc:micro", "6502:plain"]);
    }
    LONG.iter().for_each(|scene| looked(scene, &["jack"]));
    // None is left out.
    let all = [SCENES, OTHERS, LONG].concat();
    for name in names(examples)
        .iter()
        .filter_map(|name| name.strip_suffix(".scn"))
    {
        assert!(all.iter().any(|(scene, _)| *scene == name), "{name}");
    }
}

#[test]
fn and_so_it_has_where_the_plan_is_rewritten() {
    let dir = directory(&[("spot.scn", SPOT)]);
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    for target in targets(dir.path()) {
        held(dir.path(), "spot.scn", &target, &[]);
        held(dir.path(), "spot.scn", &target, &["--outlined"]);
        // Planning takes long: once will do.
        if target == "jack" {
            held(
                Path::new(examples),
                "mirrors.scn",
                &target,
                &["--rows", "60..63"],
            );
        }
        held(
            Path::new(examples),
            "maze.scn",
            &target,
            &["--rows", "10..11"],
        );
    }
    for format in ["f316r", "log10", "fixed16", "f416"] {
        held(dir.path(), "spot.scn", "jack", &["--format", format]);
    }
    held(dir.path(), "spot.scn", "bbc:micro", &["--style", "listing"]);
}

/// A picture of blocks has as many pixels as any, and what blocks leave out is no line's error.
#[test]
fn blocks_are_told_in_pixels() {
    let dir = directory(&[("spot.scn", SPOT)]);
    for format in ["f316", "f316r"] {
        let args = ["spot.scn", "-t", "jack", "--block", "2", "--json"];
        let args = [&args[..], &["--format", format]].concat();
        let told = json(dir.path(), &[&["explain"], &args[..]].concat());
        let run = json(dir.path(), &[&["run"], &args[..]].concat());
        assert_eq!(
            (&told["width"], &told["height"]),
            (&run["width"], &run["height"])
        );
        let rmse = |of: &Value| of["rmse"].as_f64().expect("a number");
        assert!(rmse(&told) < 0.01 && rmse(&told) < rmse(&run) / 4.0);
    }
}

/// A dear line and a cheap one, and what the library computes.
const TOLD: &str = "image 16 x 8 inks black, white;
draw (x, y) = {
  let near = sin(x * 0.1rad) * cos(y * 0.1rad) + sqrt(x * y + 1);
  let r = ray((0, 0, 3), unit((x - 7.5, y - 3.5, -20)));
  let met = if let h = sphere((0, 0, 0), 1).hit(r) then h.t else 0;
  threshold(near / 10 + met / 10, 0.5)
};
";

#[test]
fn lines_are_told_with_what_they_call() {
    // What hangs on the column alone takes little: a power of e for each pixel.
    let told = TOLD.replace("y + 1);", "y + 1) * exp(x * y * -0.001);");
    assert_ne!(told, TOLD);
    let dir = directory(&[("told.scn", &told)]);
    for target in targets(dir.path()) {
        let format = ["--format", usual_format(&target)];
        let profile = held(dir.path(), "told.scn", &target, &format);
        let lines = profile["lines"].as_array().expect("a list");
        let line = |number: u64| {
            let found = lines.iter().find(|line| line["line"] == number);
            found.unwrap_or_else(|| panic!("{target} has no line {number}"))
        };
        let rate = |number| line(number)["rate"].to_string();
        assert!(
            rate(3).contains("row") && rate(3).contains("column"),
            "{target}: {}",
            rate(3)
        );
        // BASIC writes a value where it is read once.
        let written = if target.starts_with("bbc") { 6 } else { 3 };
        assert!(
            line(written)["executions"].as_u64() >= Some(128),
            "{target}"
        );
        assert!(line(written)["share"].as_f64() > Some(0.25), "{target}");
        // The sphere's root is the library's, on behalf of the line that asks for it.
        let library = line(5)["library"].to_string();
        assert!(library.contains(".scn:"), "{target}: {library}");
        if written == 3 {
            assert!(sum(&line(3)["parts"], "times") >= 128, "{target}");
        }
    }
}

#[test]
fn the_terminal_shows_the_source() {
    let dir = directory(&[("told.scn", TOLD)]);
    let out = success(
        dir.path(),
        &["explain", "told.scn", "--target", "6502:plain"],
    );
    for line in TOLD.lines() {
        assert!(out.contains(line.trim_end()), "{line}\n{out}");
    }
    assert!(out.contains("100.0%") && out.contains('█'), "{out}");
}

#[test]
fn what_cannot_be_counted_is_said() {
    let dir = directory(&[("spot.scn", SPOT)]);
    let args = ["explain", "spot.scn", "--target", "jack", "--os", "jack"];
    let out = slowlight(dir.path(), &args);
    assert_eq!(out.status.code(), Some(2));
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(said.contains("--os jack"), "{said}");
    let args = ["explain", "spot.scn", "--target", "jack", "--limit", "10"];
    let out = slowlight(dir.path(), &args);
    assert_eq!(out.status.code(), Some(1));
}

/// With no line raised the model is the plan's own; with all of them, the shades are
/// the native ones but for what is rounded between lines.
#[test]
fn raised_values_are_exact() {
    let scene = check("told.scn", TOLD);
    for target in in_all_formats() {
        let mode = default_mode(target, 16, 8).expect("a mode");
        let lowered = |offset, epsilon, floats| {
            let options = Options {
                inks: Some(mode.inks),
                offset,
                epsilon,
                floats,
                ..Options::default()
            };
            scene.lower(&options).expect("a graph")
        };
        let real = target.runtime.real;
        let graph = lowered(target.offset, real.epsilon(), !real.is_fixed());
        let goal = Goal {
            name: "told".to_owned(),
            mode,
            rows: None,
            plot: true,
        };
        let planned = plan(&graph, target, &goal).expect("a plan");
        let planned = planned.shaded().unwrap_or(planned);
        let all = raisable(&scene, &planned).into_values();
        let all = all.fold(vec![false; planned.graph.nodes.len()], |all, nodes| {
            all.iter().zip(nodes).map(|(a, b)| *a || b).collect()
        });
        assert!(all.contains(&true), "{}", target.name);
        let native = lowered(1e-9, f64::EPSILON / 2.0, true);
        let mut native = Native::new(&native);
        let mut model = ModelRun::new(&planned);
        let mut same = RaisedRun::within(&planned, Vec::new(), u64::MAX);
        let mut exact = RaisedRun::within(&planned, all, u64::MAX);
        let (mut off, mut left) = (0.0, 0.0);
        for (x, y) in (0..8).flat_map(|y| (0..16).map(move |x| (x, y))) {
            let (model, same) = (model.pixel(x, y), same.pixel(x, y));
            let what = (target.name, target.runtime.format, x, y);
            assert_eq!((model.ink, model.shade), (same.ink, same.shade), "{what:?}");
            let native = native.pixel(x, y).shade;
            off += (model.shade - native).powi(2);
            left += (exact.pixel(x, y).shade - native).powi(2);
        }
        // What is not raised, constants and params among it, counts for more where the error is
        // least: 0.27 of it is left there.
        let rest = match target.runtime.format {
            "log11" => 3.5,
            _ => 4.0,
        };
        assert!(
            left <= off / rest,
            "{} {}: {left} of {off}",
            target.name,
            target.runtime.format
        );
    }
}

/// The terminal's lines as a picture, and behind each that took anything a bar.
#[test]
fn a_picture_has_the_lines_and_their_bars() {
    let dir = directory(&[("spot.scn", SPOT)]);
    let args = ["explain", "spot.scn", "-t", "6502", "--svg", "spot.svg"];
    let text = success(dir.path(), &args);
    let picture = std::fs::read_to_string(dir.path().join("spot.svg")).expect("a picture");
    let tree = roxmltree::Document::parse(&picture).expect("it parses");
    let bars: Vec<f64> = (tree.descendants())
        .filter(|n| n.attribute("class") == Some("bar"))
        .map(|n| n.attribute("width").and_then(|w| w.parse().ok()))
        .map(|width| width.expect("a width"))
        .collect();
    let told: Vec<f64> = (text.lines())
        .filter_map(|line| {
            line.split_whitespace()
                .next()?
                .strip_suffix('%')?
                .parse()
                .ok()
        })
        .collect();
    assert_eq!(bars.len(), told.len(), "{text}");
    // Bars are to each other as shares are.
    let most = |all: &[f64]| all.iter().copied().fold(0.0, f64::max);
    let (longest, dearest) = (most(&bars), most(&told));
    for (bar, share) in bars.iter().zip(&told) {
        let off = bar / longest - share / dearest;
        assert!(off.abs() < 0.01, "{bar} of {longest}, {share} of {dearest}");
    }
    for line in SPOT.lines().filter(|line| !line.trim().is_empty()) {
        let said = |n: roxmltree::Node<'_, '_>| n.text().is_some_and(|t| t.contains(line.trim()));
        assert!(tree.descendants().any(said), "{line}");
    }
}
