//! Whole pictures of mirrors on every kind of machine: no pixel differs from
//! the model, few from the native picture, for the eye of the scene and for
//! another, set on the command line or edited into the generated source.

use crate::cli::{directory, json, success};
use serde_json::Value;
use std::path::Path;

/// A machine, the most pixels that may differ from the native picture, and the
/// other eye as its parameter block writes it.
struct Case {
    target: &'static str,
    format: &'static str,
    most: u64,
    source: &'static str,
    edits: [(&'static str, &'static str); 3],
}

const CASES: [Case; 3] = [
    Case {
        target: "bbc:micro",
        format: "real40",
        most: 12,
        source: "mirrors.bas",
        edits: [
            ("eye_x=0", "eye_x=0.35"),
            ("eye_y=-0.1", "eye_y=0.25"),
            ("eye_z=3", "eye_z=3.6"),
        ],
    },
    Case {
        target: "jack",
        // In f316, which cuts, 142 pixels are otherwise than natively, and 88.
        format: "f316r",
        most: 50,
        source: "Mirrors.jack",
        edits: [
            ("let eye_x = 0;", "let eye_x = 3500;"),
            ("let eye_y = -1000;", "let eye_y = 2500;"),
            ("let eye_z = 3000;", "let eye_z = 3600;"),
        ],
    },
    Case {
        target: "6502:plain",
        format: "fixed16.16",
        most: 50,
        source: "mirrors.asm",
        edits: [
            ("eye_x = 0 ", "eye_x = 350 "),
            ("eye_y = -100 ", "eye_y = 250 "),
            ("eye_z = 3000 ", "eye_z = 3600 "),
        ],
    },
];

/// A picture's ink digest. Nothing may differ from the model, and no more than so many
/// pixels from the native picture.
fn drawn(dir: &Path, case: &Case, most: u64, more: &[&str]) -> Value {
    let Case { target, format, .. } = case;
    let run = [
        "run",
        "mirrors.scn",
        "-t",
        target,
        "--format",
        format,
        "--json",
    ];
    let said = json(dir, &[&run[..], more].concat());
    assert_eq!(said["differs_from_model"], 0, "{target} {more:?}");
    let differ = said["differs_from_native"].as_u64().expect("a count");
    assert!(
        differ <= most,
        "{target} {more:?}: {differ} pixels differ from the native picture"
    );
    said["inks_sha256"].clone()
}

fn whole_pictures(case: &Case) {
    let dir = directory(&[("mirrors.scn", include_str!("../../examples/mirrors.scn"))]);
    let (dir, target) = (dir.path(), case.target);
    let usual = drawn(dir, case, case.most, &[]);
    let moved = drawn(dir, case, case.most, &["--set", "eye=0.35,0.25,3.6"]);
    assert_ne!(usual, moved, "{target}: the eye changes nothing");

    success(
        dir,
        &[
            "build",
            "mirrors.scn",
            "-t",
            target,
            "--format",
            case.format,
            "-o",
            "out",
        ],
    );
    let path = dir.join("out").join(case.source);
    let mut text = std::fs::read_to_string(&path).expect("a source");
    for (from, to) in case.edits {
        assert_eq!(text.matches(from).count(), 1, "{target}: {from}");
        text = text.replace(from, to);
    }
    std::fs::write(&path, text).expect("a source");
    let edited = drawn(dir, case, u64::MAX, &["--program", "out"]);
    assert_eq!(edited, moved, "{target}: edited");
}

#[test]
fn whole_pictures_of_two_mirrors_in_basic() {
    whole_pictures(&CASES[0]);
}

#[test]
fn whole_pictures_of_two_mirrors_in_jack() {
    whole_pictures(&CASES[1]);
}

#[test]
fn whole_pictures_of_two_mirrors_in_machine_code() {
    whole_pictures(&CASES[2]);
}
