//! `6502:vcs`: cartridges of column scenes show what their models do, in frames that have their
//! lines, and what is no column scene is told so.

use crate::cli::{directory, json, slowlight, success};
use std::path::Path;

fn example(name: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("examples/moving").join(format!("{name}.scn"));
    path.to_string_lossy().into_owned()
}

/// Walls about the middle row: how tall by a state, of two kinds by the column.
const STEPS: &str = "image 24 x 20 inks black, grey, white;
state at: int = 3 in 0 .. 9 -> (at + 1 + input.fire) mod 10;
draw (x, y) = {
  column let tall = ((x + at) mod 10) + 0.5;
  column let side = if (x + at) mod 3 == 0 then 1 else 2;
  ink(if abs(y - 9.5) >= tall then 0 else side)
};
";

/// Runs pictures, and holds them, their states and their frames.
fn walked(dir: &Path, scene: &str, keys: &str, pictures: usize) -> serde_json::Value {
    let count = pictures.to_string();
    let args = [
        "run",
        scene,
        "-t",
        "6502:vcs",
        "--pictures",
        &count,
        "--json",
    ];
    let keys: &[&str] = if keys.is_empty() {
        &[]
    } else {
        &["--keys", keys]
    };
    let said = json(dir, &[&args[..], keys].concat());
    assert_eq!(said["differs_from_model"], 0, "{scene}");
    assert_eq!(said["states_differ"], 0, "{scene}");
    assert_eq!(said["pictures"].as_array().map(Vec::len), Some(pictures));
    said
}

#[test]
fn a_cartridge_walks_as_its_model_does() {
    let dir = directory(&[]);
    let keys = "up*4 right*3 up*4 left*2 down*4";
    for scene in ["walk", "cartridge"] {
        walked(dir.path(), &example(scene), keys, 20);
    }
}

/// The run would have ended with a fault at the first frame of another number of lines.
#[test]
fn every_frame_has_its_lines() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let args = ["run", "steps.scn", "-t", "6502:vcs", "--pictures", "12"];
    let said = success(dir.path(), &[&args[..], &["--keys", "fire*3"]].concat());
    let frames = said.lines().find(|line| line.contains("frames,"));
    let frames = frames.expect("frames").trim();
    let counted = frames.trim_start_matches("frames").trim();
    let (all, rest) = counted.split_once(" frames, ").expect("a count");
    assert_eq!(rest, format!("{all} of them of 312 lines (PAL)"));
}

#[test]
fn walls_of_two_kinds_come_and_go() {
    let dir = directory(&[("steps.scn", STEPS)]);
    walked(dir.path(), "steps.scn", "fire*4", 12);
}

/// A still picture is the first, and a film's frames are what is built, too.
#[test]
fn a_cartridge_is_built_and_runs_by_itself() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let dir = dir.path();
    let said = success(dir, &["build", "steps.scn", "-t", "6502:vcs", "-o", "out"]);
    assert!(
        said.contains("cycles between two looks at the timer"),
        "{said}"
    );
    let said = success(dir, &["vm", "6502:vcs", "out/steps.a26", "--frames", "30"]);
    assert_eq!(said, "30 frames, 30 of them of 312 lines (PAL)\n");
    let said = json(dir, &["run", "steps.scn", "-t", "6502:vcs", "--json"]);
    assert_eq!(said["differs_from_model"], 0);
}

#[test]
fn what_is_no_column_scene_is_told_so() {
    let draws = [
        // A second number is compared with the row.
        "if y < 3 + at then 0 else if y > 12 + 2 * at then 0 else 1",
        // Not about the middle row.
        "if y >= 2 * at + 2 then 0 else 1",
        // The ink hangs on the row and on the state otherwise.
        "(y * at) mod 2",
        // A dither.
        "if abs(y - 9.5) >= at then 0 else (x + y) mod 2",
    ];
    for draw in draws {
        let text = format!(
            "image 24 x 20 inks black, white;
             state at: int = 3 in 0 .. 9 -> (at + 1) mod 10;
             draw (x, y) = ink({draw});\n"
        );
        let dir = directory(&[("other.scn", &text)]);
        let output = slowlight(dir.path(), &["build", "other.scn", "-t", "6502:vcs"]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{draw}: {said}");
        assert!(
            said.contains("6502:vcs draws column scenes only"),
            "{draw}: {said}"
        );
        assert!(
            said.contains("in a column scene every column is a wall"),
            "{said}"
        );
    }
}
