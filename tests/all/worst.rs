//! `build --worst`: no run takes longer than is said, and what has no bound says so.

use crate::cli::{directory, json, slowlight, success};
use std::path::Path;

fn example(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("examples")
        .join(name);
    path.to_string_lossy().into_owned()
}

/// Loops of the scene, of rows and of columns, tables, calls and what the runtime's loops are
/// said to take, in both formats whose loops all have bounds.
#[test]
fn no_picture_takes_longer_than_is_said() {
    let dir = directory(&[]);
    let dir = dir.path();
    let maze = example("maze.scn");
    for format in ["fixed16", "fixed12"] {
        let of = ["-t", "6502:plain", "--format", format];
        let said = json(
            dir,
            &[&["build", &maze, "--worst", "--json"], &of[..]].concat(),
        );
        let bound = said["worst_cycles"].as_u64();
        let bound = bound.unwrap_or_else(|| panic!("{format}: no bound"));
        for (place, heading) in [
            ("8.5,9.5", "0.125turn"),
            ("1.5,1.5", "0.3turn"),
            ("1,1", "0turn"),
            ("15,15", "1turn"),
            ("7.99,3.01", "0.51turn"),
        ] {
            let set = [format!("pos={place}"), format!("heading={heading}")];
            let set = ["--set", &set[0], "--set", &set[1]];
            let run = json(dir, &[&["run", &maze, "--json"], &of[..], &set].concat());
            let cycles = run["cycles"].as_u64().expect("cycles");
            println!("{format} {place} {heading}: {cycles} of {bound}");
            assert!(
                cycles <= bound,
                "{format} {place} {heading}: {cycles} of {bound}"
            );
        }
    }
}

#[test]
fn a_picture_of_a_film_has_a_bound_too() {
    let dir = directory(&[]);
    let walk = example("moving/walk.scn");
    let of = [
        "build",
        &walk,
        "-t",
        "6502:plain",
        "--format",
        "fixed16",
        "--worst",
    ];
    let said = success(dir.path(), &of);
    assert!(
        said.contains("at most ") && said.contains(" cycles a picture, "),
        "{said}"
    );
}

#[test]
fn what_has_no_bound_says_so() {
    let dir = directory(&[]);
    let dir = dir.path();
    let maze = example("maze.scn");
    // Its numbers are shifted bit by bit until they have their form.
    let said = success(
        dir,
        &[
            "build",
            &maze,
            "-t",
            "6502:plain",
            "--format",
            "real40",
            "--worst",
        ],
    );
    assert!(said.contains("its worst time is not known: "), "{said}");
    for target in ["jack", "bbc:micro", "6502:bbc", "6502:c64"] {
        let output = slowlight(dir, &["build", &maze, "-t", target, "--worst"]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("--worst is the plain 6502's"), "{said}");
    }
}
