//! What hangs on the column alone is computed once a column, whatever the machine: more
//! rows take no more of it.

use crate::cli::{directory, json};
use std::fs;

/// Columns of the pictures, in a program more than an index of one byte reaches.
const WIDE: u64 = 300;
const NARROW: u64 = 20;

/// A hilly horizon: sines by column, one of them halved in a loop, a bool and an int.
fn scene(width: u64, height: u64) -> String {
    format!(
        "image {width} x {height} inks black, white;
param k: real = 0.37 in 0.1 .. 1;
draw (x, y) = {{
  column let wave = 5 + 4 * sin(x mod 20 * k * 1rad);
  column let small = loop (part = wave) max 6 {{ if part < 1 then part else next(part * 0.5) }} else 0.5;
  column let high = wave > 6.5;
  let level = if high then wave else 3 + small;
  if y < level then ink((x + floor(wave)) mod 2) else ink(0)
}};
"
    )
}

const MACHINES: [(&str, &str, u64); 7] = [
    ("jack", "f316", NARROW),
    ("jack", "log10", NARROW),
    ("jack", "fixed16", WIDE),
    ("bbc:micro", "real40", WIDE),
    ("6502:plain", "fixed16.16", WIDE),
    ("6502:plain", "fixed16", NARROW),
    ("6502:bbc", "fixed16", WIDE),
];

#[test]
fn more_rows_take_no_more_of_what_a_column_takes() {
    let dir = directory(&[]);
    for (target, format, width) in MACHINES {
        let cycles = |height: u64, k: &str| {
            let name = format!("hills{height}.scn");
            fs::write(dir.path().join(&name), scene(width, height)).expect("a scene");
            let args = [
                "run", &name, "-t", target, "--format", format, "--json", "--set", k,
            ];
            let said = json(dir.path(), &args);
            assert_eq!(said["differs_from_model"], 0, "{target} {format} {k}");
            let off = said["differs_from_native"].as_u64().expect("a count");
            assert!(off * 50 <= width * height, "{target} {format} {k}: {off}");
            (
                said["cycles"].as_u64().expect("a count"),
                said["inks_sha256"].clone(),
            )
        };
        let ((few, _), (many, usual)) = (cycles(8, "k=0.37"), cycles(16, "k=0.37"));
        // A pixel is one of eight in a column of the first picture.
        let pixel = (many - few) as f64 / (8 * width) as f64;
        let column = few as f64 / width as f64 - 8.0 * pixel;
        assert!(
            column > 2.0 * pixel,
            "{target} {format}: {column} a column, {pixel} a pixel"
        );
        // The arrays are made by the program, of its params.
        assert_ne!(usual, cycles(16, "k=0.9").1, "{target} {format}");
    }
}
