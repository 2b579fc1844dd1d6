//! The language's four scenes in every format of reals that Jack has, and others in fixed point,
//! there and on the 6502: the machine draws what the model says.

use crate::cli::{directory, json};
use slowlight_compiler::targets;
use slowlight_compiler::targets::jack::JACK;
use std::path::Path;

/// Rows in which each scene shows most of what it has; errors spread from row 0 on.
const SCENES: [(&str, &str); 5] = [
    ("torus", "100..110"),
    ("torus-march", "100..101"),
    ("mirrors", "100..106"),
    ("maze", "0..31"),
    ("primitives", "0..50"),
];

/// Other examples, for fixed point, whose points the first ones may happen to suit; those
/// with `false` need more digits than it has for them.
const OTHERS: [(&str, &str, bool); 6] = [
    ("focus", "120..120", true),
    ("fog", "120..121", true),
    ("shadows", "120..121", true),
    ("terrain", "120..120", false),
    // In one row a pixel at an edge is all of the twentieth.
    ("twist", "110..129", true),
    ("wave", "120..120", true),
];

#[test]
fn scenes_are_drawn_in_every_format() {
    for format in targets::formats(&JACK).map(|t| t.runtime.format) {
        for (name, rows) in SCENES {
            is_drawn("jack", (name, rows), format, true);
        }
    }
}

#[test]
fn other_scenes_are_drawn_in_fixed_point() {
    for (name, rows, right) in OTHERS {
        is_drawn("jack", (name, rows), "fixed16", right);
    }
}

#[test]
fn scenes_are_drawn_on_the_6502_with_points_of_their_own() {
    for (name, rows) in SCENES {
        is_drawn("6502", (name, rows), "fixed16", true);
    }
    // In three bytes few scenes must do: each is planned anew, which takes long.
    for (name, rows) in [SCENES[2], SCENES[3]] {
        is_drawn("6502", (name, rows), "fixed24", true);
    }
    for (name, rows, right) in [OTHERS[1], OTHERS[5]] {
        is_drawn("6502", (name, rows), "fixed16", right);
    }
}

/// Reals of two widths, which are chosen by the inks of the whole picture each time: shades
/// that no ink asks for may be far off.
#[test]
fn scenes_are_drawn_on_the_6502_with_reals_of_two_widths() {
    for format in ["fixed12", "fixed20"] {
        for (name, rows, right) in [("mirrors", "100..106", false), ("maze", "0..31", true)] {
            is_drawn("6502", (name, rows), format, right);
        }
    }
}

/// Runs rows of an example, which must be the model's, and perhaps right to the eye.
fn is_drawn(target: &str, (name, rows): (&str, &str), format: &str, right: bool) {
    let dir = directory(&[]);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("examples").join(format!("{name}.scn"));
    let scene = path.to_str().expect("a path");
    let args = [
        "run", scene, "-t", target, "--json", "--rows", rows, "--format", format,
    ];
    let run = json(dir.path(), &args);
    assert_eq!(run["differs_from_model"], 0, "{name} {target} {format}");
    let rmse = run["rmse"].as_f64().expect("a number");
    // Shades are right to a twentieth; dithers may differ by many pixels for that.
    assert!(!right || rmse < 0.05, "{name} {target} {format}: {rmse}");
}
