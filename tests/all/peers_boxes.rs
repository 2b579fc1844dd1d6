//! Machine code for the BBC Micro under its genuine operating system, in jsbeeb
//! ([`crate::peers_jsbeeb`]): what it draws, and how long that takes.

use crate::boxes::waves;
use crate::cli::{directory, json, success};
use crate::peers_jsbeeb::{hex, jsbeeb, unhex};
use serde_json::{Value, json};
use std::path::Path;

/// How much more cycles ours may be than the genuine machine's, in parts of one.
const MOST: f64 = 0.01;

/// What a mode's registers are after MODE on the genuine machine: the whole line, where it ends and
/// its pulse, all lines and where they end, the ULA's control; and bytes side by side.
fn usual(mode: u32) -> ([u64; 3], [u64; 2], u64, usize) {
    let fast = ([127, 98, 0x28], 80);
    let slow = ([63, 49, 0x24], 40);
    let (control, (line, across)) = match mode {
        0 => (0x9C, fast),
        1 => (0xD8, fast),
        2 => (0xF4, fast),
        5 => (0xC4, slow),
        _ => (0x88, slow),
    };
    (line, [38, 34], control, across)
}

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
            "dump": [0, 0x8000],
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
    /// The inks that the machine's hardware shows, and how many are side by side. What is not the
    /// picture's shape is as MODE sets it, but that the picture is in the middle.
    fn seen(&self, memory: &[u8], video: &Value) -> (Vec<u8>, usize) {
        let what = &self.what;
        let register = |k: usize| video["registers"][k].as_u64().expect("a register");
        let (line, lines, control, most) = usual(self.mode);
        let (across, down) = (register(1) as usize, register(6) as usize);
        assert!(across <= most && down <= 32, "{what}");
        let end = line[1] - (most - across) as u64 / 2;
        assert_eq!([0, 2, 3].map(register), [line[0], end, line[2]], "{what}");
        let end = lines[1] - (32 - down) as u64 / 2;
        assert_eq!([4, 7].map(register), [lines[0], end], "{what}");
        assert_eq!([5, 8, 9, 10].map(register), [0, 1, 7, 0x20], "{what}");
        assert_eq!(video["control"], control, "{what}");
        let start = 8 * (256 * register(12) + register(13)) as usize;
        assert_eq!(start + 8 * across * down, 0x8000, "{what}");
        let pixels = match self.mode {
            0 | 4 => 8,
            2 => 2,
            _ => 4,
        };
        let byte = |x: usize, y: usize| memory[start + y / 8 * across * 8 + x * 8 + y % 8];
        let ink = |x: usize, y: usize| {
            let bit = |b: usize| byte(x / pixels, y) >> (7 - x % pixels - b * pixels) & 1;
            (0..8 / pixels).fold(0, |ink, b| ink << 1 | bit(b))
        };
        let width = across * pixels;
        let rows = (0..down * 8).flat_map(|y| (0..width).map(move |x| (x, y)));
        let screen: Vec<u8> = rows.clone().map(|(x, y)| ink(x, y)).collect();
        // Black, red, yellow and white, or the two that there are.
        let colours = match pixels {
            8 => [0, 7, 7, 7],
            _ => [0, 1, 3, 7],
        };
        // The ULA looks up a byte's bits 7, 5, 3 and 1 once it has shifted 1s in.
        for (x, y) in rows {
            let shifted = (u32::from(byte(x / pixels, y)) << 8 | 0xFF) << (x % pixels) >> 8;
            let pattern = [7, 5, 3, 1].map(|b| shifted >> b & 1);
            let pattern = pattern.iter().fold(0, |all, bit| all << 1 | bit) as usize;
            let colour = colours[usize::from(screen[y * width + x])];
            assert_eq!(video["palette"][pattern], colour, "{what}: ({x}, {y})");
        }
        (screen, width)
    }

    fn holds(&self, result: &Value) {
        let what = &self.what;
        assert_eq!(result["stopped"], "prompt", "{what}");
        let theirs = result["cycles"].as_u64().expect("cycles");
        let excess = self.cycles as f64 / theirs as f64 - 1.0;
        println!("{what}: {theirs} cycles, ours {:+.2}%", 100.0 * excess);
        let memory = unhex(result["memory"].as_str().expect("memory"));
        let (screen, width) = self.seen(&memory, &result["video"]);
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
