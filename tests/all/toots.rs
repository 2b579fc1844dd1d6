//! Programs in the form of a post: `--style toot`.

use crate::cli::{directory, json, slowlight, success};
use serde_json::Value;
use slowlight_vm::bbc::{Dialect, tokenise};
use std::fmt::Write as _;
use std::path::Path;

pub const MIRRORS: &str = include_str!("../../examples/mirrors.scn");

/// Small scenes that fit.
pub const POSTS: &[(&str, &str)] = &[
    (
        "plasma",
        "image 160 x 256 inks black, red, green, yellow, blue, magenta, cyan, white;
draw (x, y) = ink(floor(8 + 3 * sin(x * 1rad / 13) + 3 * cos(y * 1rad / 21)
  + 2 * sin((x + y) * 1rad / 29)) mod 8);
",
    ),
    (
        "rings",
        "image 320 x 256 inks black, red, yellow, white;
param wide: real = 9 in 4 .. 20;
draw (x, y) = threshold(0.5 + 0.5 * cos(sqrt((x - 160) * (x - 160) + (y - 128) * (y - 128))
  * 1rad / wide), bayer(4)[x mod 4, y mod 4]);
",
    ),
    (
        "ball",
        "image 40 x 32 inks black, white;
draw (x, y) = {
  let u = (x - 19.5) / 16;
  let v = (15.5 - y) / 16;
  let z = 1 - u * u - v * v;
  threshold(if z > 0 then max(0, 0.5 * u + 0.5 * v + 0.6 * sqrt(z)) else 0,
    bayer(8)[x mod 8, y mod 8])
};
",
    ),
    (
        "julia",
        "image 40 x 32 inks black, red, green, yellow, blue, magenta, cyan, white;
draw (x, y) = ink(loop (a = (x - 19.5) / 12, b = (15.5 - y) / 12, n = 0) max 23 {
  let p = a * a;
  let q = b * b;
  if p + q < 4 then next(p - q - 0.7, 2 * a * b + 0.3, n + 1) else n mod 8
} else 0);
",
    ),
];

fn written(dir: &Path, name: &str) -> (String, Vec<u8>) {
    let read = |end: &str| std::fs::read(dir.join(format!("{name}.{end}"))).expect("a file");
    let text = String::from_utf8(read("toot.txt")).expect("text");
    (text, read("bbc"))
}

#[test]
fn posts_have_so_many_characters() {
    let dir = directory(&[("mirrors.scn", MIRRORS)]);
    let mut sizes = String::new();
    let all = [("mirrors", MIRRORS)];
    for (name, scene) in all.iter().chain(POSTS) {
        std::fs::write(dir.path().join(format!("{name}.scn")), scene).expect("a file");
        let scene = format!("{name}.scn");
        let said = success(
            dir.path(),
            &["build", &scene, "-t", "bbc:micro", "--style", "toot"],
        );
        let (text, tokens) = written(dir.path(), name);
        let count = text.chars().count();
        assert!(
            said.contains(&format!("a post of {} of 500 characters", count + 13)),
            "{said}"
        );
        let _ = writeln!(sizes, "{name} {count}");
        // It is a program as it stands, line by line, and that is the one beside it.
        assert_eq!(
            tokenise(&text, Dialect::Micro).as_ref(),
            Ok(&tokens),
            "{name}"
        );
        for line in text.lines() {
            assert!((1..=251).contains(&line.chars().count()), "{name}: {line}");
        }
        // What a post might lose or change: spaces at an end, control characters, soft hyphens;
        // the bot takes tags out.
        let odd = |c: char| {
            !(' '..='~').contains(&c) && !('\u{a1}'..='\u{1ff}').contains(&c) && c != '\n'
                || "\u{ad}#@".contains(c)
        };
        assert!(!text.contains(odd) && text == text.trim(), "{name}: {text}");
    }
    insta::assert_snapshot!(sizes.trim_end());
}

#[test]
fn posts_draw_what_their_models_do() {
    let dir = directory(&[]);
    let ran = |scene: &str, rows: &str| -> Value {
        let args = ["run", scene, "-t", "bbc:micro", "--style", "toot", "--json"];
        let rows: &[&str] = if rows.is_empty() {
            &[]
        } else {
            &["--rows", rows]
        };
        json(dir.path(), &[&args[..], rows].concat())
    };
    for (name, text) in POSTS {
        std::fs::write(dir.path().join(format!("{name}.scn")), text).expect("a file");
    }
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    for (scene, rows, wrong) in [
        ("plasma.scn".to_owned(), "100..103", 0),
        ("rings.scn".to_owned(), "64..66", 0),
        ("ball.scn".to_owned(), "", 0),
        ("julia.scn".to_owned(), "", 0),
        (format!("{examples}/mirrors.scn"), "118..125", 0),
        (format!("{examples}/torus.scn"), "120..122", 2),
        (format!("{examples}/maze.scn"), "9..14", 0),
        (format!("{examples}/colours.scn"), "100..101", 0),
        (format!("{examples}/masks.scn"), "60..61", 0),
    ] {
        let found = ran(&scene, rows);
        assert_eq!(found["differs_from_model"], 0, "{scene}");
        let native = found["differs_from_native"].as_u64();
        assert!(native <= Some(wrong), "{scene}: {native:?}");
    }
}

#[test]
fn what_runs_is_what_is_posted() {
    let dir = directory(&[("julia.scn", POSTS[3].1)]);
    let options = ["julia.scn", "-t", "bbc:micro", "--style", "toot"];
    success(dir.path(), &[&["build"][..], &options].concat());
    let run = json(dir.path(), &[&["run"][..], &options, &["--json"]].concat());
    let (text, tokens) = written(dir.path(), "julia");
    assert_eq!(run["code_bytes"], tokens.len());
    let posted = success(dir.path(), &["vm", "bbc", "julia.toot.txt", "--json"]);
    let posted: Value = serde_json::from_str(&posted).expect("JSON");
    assert_eq!(posted["cycles"], run["cycles"], "{text}");
}

#[test]
fn a_scene_that_is_too_long_warns() {
    let dir = directory(&[]);
    let maze = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/maze.scn");
    let output = slowlight(
        dir.path(),
        &["build", maze, "-t", "bbc:micro", "--style", "toot"],
    );
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    let (text, _) = written(dir.path(), "maze");
    let more = text.chars().count() + 13 - 500;
    assert!(
        said.contains(&format!("{more} characters too many for a post of 500")),
        "{said}"
    );
}

#[test]
fn other_machines_have_no_posts() {
    let dir = directory(&[("ball.scn", POSTS[2].1)]);
    for target in ["bbc:agon", "6502:bbc", "jack"] {
        let output = slowlight(
            dir.path(),
            &["build", "ball.scn", "-t", target, "--style", "toot"],
        );
        assert_eq!(output.status.code(), Some(2), "{target}");
    }
}

/// Loops that are left early around and inside of others, tables by remainders, the least int.
const ODD: &[&str] = &[
    "image 6 x 6 inks black, red, yellow, white;
draw (x, y) = ink((loop (i = 0, s = y) max 2 { if y < 3 then next(i + 1, s + 5) else s } else s) * x mod 4);
",
    "image 12 x 9 inks black, red, yellow, white;
const t = [0, 1, 2; 3, 3, 2; 0, 2, 1];
draw (x, y) = ink(t[y mod 3, x mod 3]);
",
    "image 8 x 8 inks black, red, yellow, white;
draw (x, y) = ink((y - 8) div (x - 3) mod 4);
",
    "image 8 x 8 inks black, red, yellow, white;
draw (x, y) = ink(floor(1.0 * (y - 5) / (x - 7)) mod 4);
",
    "image 20 x 10 inks black, red, yellow, white;
draw (x, y) = ink(loop (a = 0, r = x) max 60000 { if r > 300 then r mod 4 else
  next(a + 1, r + 1 + loop (c = 0, p = a) max 4 { if p > x then p else next(c + 1, p + 1) } else p) } else 0);
",
];

#[test]
fn odd_posts_draw_what_their_models_do() {
    let dir = directory(&[]);
    for text in ODD {
        std::fs::write(dir.path().join("odd.scn"), text).expect("a file");
        let args = ["run", "odd.scn", "-t", "bbc:micro", "--style", "toot"];
        let run = json(dir.path(), &[&args[..], &["--json"]].concat());
        assert_eq!(run["differs_from_model"], 0, "{text}");
    }
}

#[test]
fn what_a_post_is_not_is_said() {
    let moves = "image 8 x 8 inks black, white;
param p: int = 3 in 0 .. 7;
state a: int = 0 in 0 .. 7 -> (a + 1) mod 8;
draw (x, y) = ink(if x == a or y == p then 1 else 0);
";
    let dir = directory(&[("moves.scn", moves)]);
    let toot = ["moves.scn", "-t", "bbc:micro", "--style", "toot"];
    let ran = |command: &str, more: &[&str]| {
        let args = [&[command][..], &toot, more].concat();
        let out = slowlight(dir.path(), &args);
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        (out.status.code(), said)
    };
    let (status, said) = ran("build", &["-o", "post/"]);
    assert!(status == Some(0) && said.contains("one picture"), "{said}");
    for (command, more) in [
        ("run", &["--program", "post"][..]),
        ("explain", &[]),
        ("effects", &[]),
    ] {
        let (status, said) = ran(command, more);
        assert_eq!(status, Some(0), "{command}: {said}");
    }
    for more in [&["--freeze", "nope"][..], &["--pictures", "3"]] {
        let (status, said) = ran("run", more);
        assert_eq!(status, Some(2), "{said}");
    }
}
