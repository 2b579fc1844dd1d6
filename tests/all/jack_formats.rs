//! The language's four scenes in every format of reals that Jack has: the machine draws
//! what the model says, or the scene is refused with what it lacks.

use crate::cli::{directory, json};
use slowlight_compiler::target::{self, jack::JACK};
use std::path::Path;

/// Rows in which each scene shows most of what it has; errors spread from row 0 on.
const SCENES: [(&str, &str); 5] = [
    ("torus", "100..110"),
    ("torus-march", "100..101"),
    ("mirrors", "100..106"),
    ("maze", "0..31"),
    ("primitives", "0..50"),
];

#[test]
fn the_four_scenes_are_drawn_in_every_format() {
    let dir = directory(&[]);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for format in target::formats(&JACK).map(|t| t.runtime.format) {
        for (name, rows) in SCENES {
            let path = root.join("examples").join(format!("{name}.scn"));
            let scene = path.to_str().expect("a path");
            let args = [
                "run", scene, "-t", "jack", "--json", "--rows", rows, "--format", format,
            ];
            let run = json(dir.path(), &args);
            assert_eq!(run["differs_from_model"], 0, "{name} {format}");
            let of = |key: &str| run[key].as_f64().expect("a number");
            // Shades are right to a fiftieth; dithers may differ by many pixels for that.
            assert!(of("rmse") < 0.05, "{name} {format}: {}", of("rmse"));
        }
    }
}
