//! `vm bbc`: discs that `build` writes, and programs of each dialect.

use crate::cli::{directory, json, slowlight, success};
use std::path::Path;

const SCENE: &str = include_str!("../scenes/gradient.scn");

fn inks(dir: &Path, file: &str) -> String {
    let said = json(dir, &["vm", "bbc", file, "--json"]);
    assert_eq!(said["stopped"], "ended");
    said["inks_sha256"].as_str().expect("a picture").to_owned()
}

/// At both PAGEs; at &E00 `!BOOT` moves the program down by a function key.
#[test]
fn discs_show_what_their_program_shows() {
    let dir = directory(&[("scene.scn", SCENE)]);
    let dir = dir.path();
    for page in ["1900", "E00"] {
        let build = ["build", "scene.scn", "--target", "bbc:micro"];
        success(dir, &[&build[..], &["--page", page]].concat());
        assert_eq!(inks(dir, "scene.ssd"), inks(dir, "scene.bbc"), "{page}");
    }
}

/// A command that fails: its exit status, and what it says.
fn fails(dir: &Path, args: &[&str], status: i32, says: &str) {
    let output = slowlight(dir, args);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{args:?}: {said}");
    assert!(said.contains(says), "{args:?}: {said}");
}

#[test]
fn wrong_discs_are_refused() {
    let dir = directory(&[("scene.scn", SCENE), ("text.ssd", "10PRINT 1\n")]);
    let dir = dir.path();
    success(dir, &["build", "scene.scn", "--target", "bbc:micro"]);
    let disc = std::fs::read(dir.join("scene.ssd")).expect("a disc");
    let with = |name: &str, change: &dyn Fn(&mut Vec<u8>)| {
        let mut disc = disc.clone();
        change(&mut disc);
        std::fs::write(dir.join(name), disc).expect("a file");
    };
    with("short.ssd", &|d| d.truncate(700));
    // The program's first byte: sector 3, after the catalogue and `!BOOT`.
    with("other.ssd", &|d| d[0x300] = b'1');
    with("none.ssd", &|d| d[0x106] &= 3);
    fails(dir, &["vm", "bbc", "text.ssd"], 1, "no disc image");
    fails(dir, &["vm", "bbc", "short.ssd"], 1, "ends within");
    fails(dir, &["vm", "bbc", "other.ssd"], 1, "SCENE is no program");
    fails(dir, &["vm", "bbc", "none.ssd"], 1, "start nothing");
    let agon = ["vm", "bbc", "scene.ssd", "--dialect", "agon"];
    fails(dir, &agon, 1, "discs are the Micro's");
}

/// Integers wrap on BASIC II alone, which alone takes one comparison.
#[test]
fn each_dialect_runs_its_programs() {
    let dir = directory(&[
        ("sum.bas", "PRINT;2147483647+1\n"),
        ("division.bas", "ON ERROR PRINT;ERR:END\nPRINT;1 DIV 0\n"),
        ("mode.bas", "MODE 10\nPRINT \"in\"\n"),
    ]);
    let dir = dir.path();
    let runs = |file: &str, dialect: &str| {
        let text = success(dir, &["vm", "bbc", file, "--dialect", dialect]);
        text.trim().to_owned()
    };
    assert_eq!(runs("sum.bas", "micro"), "-2.14748365E9");
    assert_eq!(runs("sum.bas", "agon"), "2.14748365E9");
    assert_eq!(runs("sum.bas", "basicv"), "2.14748365E9");
    assert_eq!(runs("division.bas", "micro"), "18");
    assert_eq!(runs("division.bas", "agon"), "-1");
    assert_eq!(runs("mode.bas", "agon"), "in");
    let plain = success(dir, &["vm", "bbc", "sum.bas"]);
    assert_eq!(plain.trim(), "-2.14748365E9");
    fails(
        dir,
        &["vm", "bbc", "sum.bas", "--dialect", "sinclair"],
        2,
        "basicv",
    );
    let other = ["vm", "6502", "sum.bas", "--dialect", "micro"];
    fails(dir, &other, 2, "--dialect is BBC BASIC's");
}
