//! Machine code for the BBC Micro under its genuine operating system, in jsbeeb
//! ([`crate::peers_jsbeeb`]): what it draws, and how long that takes.

use crate::boxes::waves;
use crate::cli::{directory, json, success};
use crate::peers_jsbeeb::{hex, inks, jsbeeb, layout, unhex};
use serde_json::{Value, json};
use std::path::Path;

/// How much more cycles ours may be than the genuine machine's, in parts of one.
const MOST: f64 = 0.01;

/// A scene's disc as a job, and our own run of it.
struct Case {
    what: String,
    mode: u32,
    job: Value,
    cycles: u64,
    /// Columns and rows of the screen where our picture is, and its inks.
    picture: Picture,
}

struct Picture {
    offset: (usize, usize),
    size: (usize, usize),
    inks: Vec<u8>,
}

/// The inks of a binary PGM.
pub fn pgm(bytes: &[u8]) -> ((usize, usize), Vec<u8>) {
    let mut words = bytes.splitn(4, u8::is_ascii_whitespace);
    let mut word = || String::from_utf8_lossy(words.next().unwrap_or_default()).into_owned();
    assert_eq!(word(), "P5");
    let [width, height] = [word(), word()].map(|n| n.parse().expect("a number"));
    let pixels = bytes[bytes.len() - width * height..].to_vec();
    ((width, height), pixels)
}

fn case(dir: &Path, mode: u32, options: &[&str]) -> Case {
    let name = mode.to_string();
    // The quickest format would be over before interrupts have their usual share.
    let format = match options.contains(&"--format") {
        true => &[][..],
        false => &["--format", "fixed16.16"],
    };
    let of = [&["-t", "6502:bbc", "--mode", &name], format, options].concat();
    let said = json(
        dir,
        &[&["run", "scene.scn", "--json", "-o", "scene.pgm"], &of[..]].concat(),
    );
    assert_eq!(said["differs_from_model"], 0);
    success(dir, &[&["build", "scene.scn"], &of[..]].concat());
    let read = |name: &str| std::fs::read(dir.join(name)).expect("a file");
    let disc = read("scene.ssd");
    // Where the file that the disc boots is begun: `!BOOT` comes last in the catalogue.
    let begin = u16::from_le_bytes([disc[256 + 10], disc[256 + 11]]);
    let (size, inks) = pgm(&read("scene.pgm"));
    let offset = |k: usize| said["offset"][k].as_i64().expect("a number").max(0) as usize;
    let rows = options.iter().skip_while(|o| **o != "--rows").nth(1);
    let first = rows.and_then(|r| r.split("..").next()?.parse().ok());
    Case {
        what: format!("{options:?}, MODE {mode}"),
        mode,
        job: json!({
            "disc": hex(&disc),
            "begin": begin,
            "dump": [layout(mode).0, 0x8000],
            "press": true,
            "limit": 40_000_000_000u64,
        }),
        cycles: said["cycles"].as_u64().expect("cycles"),
        picture: Picture {
            offset: (offset(0), offset(1) + first.unwrap_or(0)),
            size,
            inks,
        },
    }
}

impl Case {
    fn holds(&self, result: &Value) {
        let what = &self.what;
        assert_eq!(result["stopped"], "prompt", "{what}");
        let theirs = result["cycles"].as_u64().expect("cycles");
        let excess = self.cycles as f64 / theirs as f64 - 1.0;
        println!("{what}: {theirs} cycles, ours {:+.2}%", 100.0 * excess);
        let screen = inks(
            self.mode,
            &unhex(result["memory"].as_str().expect("memory")),
        );
        let width = screen.len() / 256;
        let Picture { offset, size, inks } = &self.picture;
        let (columns, rows) = (offset.0..offset.0 + size.0, offset.1..offset.1 + size.1);
        let mut own = inks.iter();
        for (k, ink) in screen.iter().enumerate() {
            let inside = columns.contains(&(k % width)) && rows.contains(&(k / width));
            let expected = if inside {
                *own.next().expect("an ink")
            } else {
                0
            };
            assert_eq!(*ink, expected, "{what}: ({}, {})", k % width, k / width);
        }
        assert!(own.next().is_none());
        assert!(excess.abs() <= MOST, "{what}: {excess}");
        assert_eq!(result["back"], true, "{what}: no BASIC after a key");
    }
}

fn hold(cases: &[Case]) {
    let jobs: Vec<Value> = cases.iter().map(|c| c.job.clone()).collect();
    for (case, result) in cases.iter().zip(jsbeeb(&jobs)) {
        case.holds(&result);
    }
}

/// Booted from the disc, moved down and not; then a key brings BASIC back.
#[test]
fn discs_of_machine_code_boot_and_draw() {
    let dir = directory(&[("scene.scn", &waves(37, 23))]);
    let mut cases: Vec<Case> = [0, 1, 2, 4, 5].map(|m| case(dir.path(), m, &[])).into();
    cases.push(case(dir.path(), 1, &["--page", "E00"]));
    hold(&cases);
}

#[test]
fn rows_of_mirrors_in_machine_code() {
    let mirrors = include_str!("../../examples/mirrors.scn");
    let dir = directory(&[("scene.scn", mirrors)]);
    let rows = ["--rows", "128..131", "--format"];
    hold(
        &["fixed16", "fixed16.16"]
            .map(|format| case(dir.path(), 1, &[&rows[..], &[format]].concat())),
    );
}

/// A minute or so.
#[test]
#[ignore = "long"]
fn a_whole_picture_of_mirrors_in_machine_code() {
    let mirrors = include_str!("../../examples/mirrors.scn");
    let dir = directory(&[("scene.scn", mirrors)]);
    hold(&[case(dir.path(), 1, &["--format", "fixed16"])]);
}
