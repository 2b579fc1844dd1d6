//! Whole pictures of mirrors on every kind of machine: no pixel differs from
//! the model, few from the native picture, for the eye of the scene and for
//! another, set on the command line or edited into the generated source.
//!
//! Rows 9 to 239 are counted, as the reference has them, without row 129: there
//! every pixel of direct floor lies on a tile's edge, so any format may put it
//! on either side.

use crate::cli::{directory, json, success};
use serde_json::Value;
use std::path::Path;

const ROWS: [&str; 2] = ["9..128", "130..239"];

/// A machine, the most pixels that may differ from the native picture, and the
/// other eye as its parameter block writes it.
struct Case {
    target: &'static str,
    most: u64,
    source: &'static str,
    edits: [(&'static str, &'static str); 3],
}

const CASES: [Case; 3] = [
    Case {
        target: "bbc:micro",
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
        most: 73_600 / 50,
        source: "Mirrors.jack",
        edits: [
            ("let eye_x = 0;", "let eye_x = 3500;"),
            ("let eye_y = -1000;", "let eye_y = 2500;"),
            ("let eye_z = 3000;", "let eye_z = 3600;"),
        ],
    },
    Case {
        target: "6502:plain",
        most: 73_600 / 50,
        source: "mirrors.asm",
        edits: [
            ("eye_x = 0 ", "eye_x = 350 "),
            ("eye_y = -100 ", "eye_y = 250 "),
            ("eye_z = 3000 ", "eye_z = 3600 "),
        ],
    },
];

/// Both halves of a picture: the sum of what differs from the native one, and
/// the digests. Nothing may differ from the model.
fn halves(dir: &Path, target: &str, more: &[&str]) -> (u64, Vec<Value>) {
    let (mut differ, mut digests) = (0, Vec::new());
    for rows in ROWS {
        let mut args = vec![
            "run",
            "mirrors.scn",
            "--target",
            target,
            "--json",
            "--rows",
            rows,
        ];
        args.extend(more);
        let said = json(dir, &args);
        assert_eq!(said["differs_from_model"], 0, "{target} {more:?}");
        differ += said["differs_from_native"].as_u64().expect("a count");
        digests.push(said["inks_sha256"].clone());
    }
    (differ, digests)
}

#[test]
fn whole_pictures_of_two_mirrors() {
    let dir = directory(&[("mirrors.scn", include_str!("../../examples/mirrors.scn"))]);
    let dir = dir.path();
    for Case {
        target,
        most,
        source,
        edits,
    } in CASES
    {
        let (differ, digests) = halves(dir, target, &[]);
        assert!(
            differ <= most,
            "{target}: {differ} pixels differ from the native picture"
        );
        let (moved, seen) = halves(dir, target, &["--set", "eye=0.35,0.25,3.6"]);
        assert!(moved <= most, "{target}, another eye: {moved}");
        assert_ne!(digests, seen, "{target}: the eye changes nothing");

        success(
            dir,
            &["build", "mirrors.scn", "--target", target, "-o", "out"],
        );
        let path = dir.join("out").join(source);
        let mut text = std::fs::read_to_string(&path).expect("a source");
        for (from, to) in edits {
            assert_eq!(text.matches(from).count(), 1, "{target}: {from}");
            text = text.replace(from, to);
        }
        std::fs::write(&path, text).expect("a source");
        let args = [
            "run",
            "mirrors.scn",
            "--target",
            target,
            "--program",
            "out",
            "--json",
        ];
        let edited = json(dir, &args);
        let set = [
            "run",
            "mirrors.scn",
            "--target",
            target,
            "--set",
            "eye=0.35,0.25,3.6",
            "--json",
        ];
        assert_eq!(edited["differs_from_model"], 0, "{target}: edited");
        assert_eq!(
            edited["inks_sha256"],
            json(dir, &set)["inks_sha256"],
            "{target}: edited"
        );
    }
}
