//! What the command line says of a scene: remarks about inks and divisors, one for each
//! place; and scenes from standard input.

use crate::cli::{directory, json, slowlight, success};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Five inks by number, where the Hack has two and a Micro's mode 1 four.
const NUMBERED: &str = "image 64 x 16 inks black, #333333, grey, silver, white;
draw (x, y) = {
  let n = x div 8;
  ink(1 + n mod 4)
};
";

/// The same in shades.
const DITHERED: &str = "image 64 x 16 inks black, #333333, grey, silver, white;
draw (x, y) = threshold((1 + x div 8 mod 4) / 4, bayer(4)[x mod 4, y mod 4]);
";

/// A scene with a line that two formats are too coarse for.
const MASKS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/masks.scn");

fn said(dir: &Path, args: &[&str]) -> String {
    let output = slowlight(dir, args);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{args:?}: {said}");
    said
}

#[test]
fn ink_numbers_that_a_screen_lacks_are_told() {
    let dir = directory(&[("n.scn", NUMBERED), ("d.scn", DITHERED)]);
    let dir = dir.path();
    let hack = "ink numbers go up to 4 where there are 2 inks: all above 1 look like 1";
    let commands: [&[&str]; 4] = [
        &["check", "n.scn", "--target", "jack"],
        &["build", "n.scn", "-t", "jack", "-o", "out"],
        &["run", "n.scn", "-t", "jack"],
        &["render", "n.scn", "-t", "jack"],
    ];
    for args in commands {
        let said = said(dir, args);
        assert!(said.contains(hack), "{args:?}: {said}");
        // 32 columns and 16 rows are looked at, three of four numbers are above 1.
        assert!(
            said.contains("jack: 384 of 512 pixels looked at"),
            "{args:?}: {said}"
        );
        assert!(said.contains("n.scn:4:3"), "{args:?}: {said}");
        assert!(said.contains("threshold(v, bayer(4)"), "{args:?}: {said}");
        let mut same: Vec<&str> = args.to_vec();
        same[1] = "d.scn";
        let said = slowlight(dir, &same);
        let said = String::from_utf8_lossy(&said.stderr).into_owned();
        assert!(!said.contains("ink number"), "{same:?}: {said}");
    }
    // Mode 2 has them all; and so has the picture.
    for args in [
        &["run", "n.scn", "-t", "bbc"][..],
        &["check", "n.scn", "--quick"],
    ] {
        assert!(!said(dir, args).contains("ink number"), "{args:?}");
    }
    let said = said(dir, &["run", "n.scn", "-t", "bbc", "--mode", "1"]);
    assert!(said.contains("up to 4 where there are 4 inks"), "{said}");
}

/// A divisor that stands in three places, and a weakness that several formats have.
#[test]
fn what_is_nearly_the_same_is_said_once() {
    let scene = "image 16 x 16 inks black, white;
param k: real = 3 in -4 .. 4;
draw (x, y) = threshold(x / k / 16 + y / k / 16, 1 / k);
";
    let dir = directory(&[("thrice.scn", scene)]);
    let found = json(dir.path(), &["check", "thrice.scn", "--quick", "--json"]);
    let found = found["diagnostics"].as_array().expect("diagnostics");
    assert_eq!(found.len(), 1, "{found:?}");
    let message = found[0]["message"].as_str().expect("a message");
    assert!(
        message.ends_with("may divide by zero: `k` lies in [-4, 4]"),
        "{message}"
    );
    assert_eq!(found[0]["others"].as_array().map(Vec::len), Some(2));

    let found = json(dir.path(), &["check", MASKS, "--json"]);
    let found = found["diagnostics"].as_array().expect("diagnostics");
    let mut places: Vec<_> = found.iter().map(|d| (&d["line"], &d["column"])).collect();
    let all = places.len();
    places.dedup();
    assert_eq!(places.len(), all, "{found:?}");
    let joined = |d: &&serde_json::Value| {
        let message = d["message"].as_str().unwrap_or_default();
        message.contains("in f316") && message.contains("; in fixed16.16")
    };
    assert!(found.iter().any(|d| joined(&d)), "{found:?}");
}

/// Runs with a text on standard input.
fn fed(dir: &Path, text: &str, args: &[&str]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_slowlight"))
        .args(args)
        .current_dir(dir)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary runs");
    let mut input = child.stdin.take().expect("a pipe");
    // Who refuses the command line does not read.
    let _ = input.write_all(text.as_bytes());
    drop(input);
    child.wait_with_output().expect("it ends")
}

#[test]
fn scenes_come_from_standard_input() {
    let dir = directory(&[("d.scn", DITHERED), ("part.scn", "const c = 1;\n")]);
    let dir = dir.path();
    let printed = |text: &str, args: &[&str]| {
        let output = fed(dir, text, args);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{args:?}: {said}");
        String::from_utf8(output.stdout).expect("a text")
    };
    let shown = printed(DITHERED, &["render", "-"]);
    assert_eq!(
        shown.replace("stdin:", "d:"),
        success(dir, &["render", "d.scn"])
    );
    let shown = printed(DITHERED, &["check", "-", "--quick"]);
    assert_eq!(shown, "-: nothing to remark\n");
    let shown = printed(DITHERED, &["run", "-", "-t", "6502"]);
    assert!(shown.starts_with("stdin on 6502:plain: 64 x 16"), "{shown}");
    let shown = printed(DITHERED, &["build", "-", "-t", "6502", "-o", "out"]);
    assert!(shown.contains("out/stdin.asm"), "{shown}");
    // What it uses stands in the working directory.
    let uses = format!("use \"part.scn\";\n{}", DITHERED.replace("(1 +", "(c +"));
    printed(&uses, &["check", "-", "--quick"]);
    let loose = DITHERED.replace("draw (x, y) = ", "draw(x,y)=");
    assert_eq!(printed(&loose, &["fmt", "-"]), DITHERED);
    assert_eq!(printed(DITHERED, &["fmt", "-"]), DITHERED);
    assert_eq!(printed(DITHERED, &["fmt", "--check", "-"]), "");
    let output = fed(dir, &loose, &["fmt", "--check", "-"]);
    assert_eq!(output.status.code(), Some(1));

    let wrong = fed(dir, "draw (x, y) = ink(;", &["check", "-"]);
    assert_eq!(wrong.status.code(), Some(1));
    let said = String::from_utf8_lossy(&wrong.stderr).into_owned();
    assert!(said.contains("standard input:1:"), "{said}");
    for text in ["", "draw (x, y) = ink(;"] {
        let wrong = fed(dir, text, &["fmt", "-"]);
        assert_eq!(String::from_utf8_lossy(&wrong.stdout), "");
        assert_eq!(wrong.status.success(), text.is_empty());
    }
}

/// What a Micro needs for drawing grows with the picture, and what its mode needs does not
/// count.
#[test]
fn cycles_of_drawing_are_of_drawing() {
    let dir = directory(&[("n.scn", NUMBERED)]);
    let dir = dir.path();
    let drawing = |target: &str, more: &[&str]| {
        let args = [&["run", "n.scn", "-t", target, "--json"], more].concat();
        let found = json(dir, &args);
        let cycles = found["cycles"].as_u64().expect("cycles");
        let drawing = found["plot_cycles"].as_u64().expect("cycles");
        assert!(drawing < cycles);
        drawing
    };
    for target in ["bbc:micro", "bbc:agon"] {
        let one = drawing(target, &["--rows", "0..0"]);
        let all = drawing(target, &[]);
        assert!(one > 0, "{target}");
        // Within one part of a hundred: a program's variables are met in some order.
        let rows = all as f64 / one as f64;
        assert!((rows - 16.0).abs() < 0.16, "{target}: {one}, {all}");
        assert_eq!(drawing(target, &["--no-plot"]), 0, "{target}");
    }
}

/// The head of each column of `explain`'s page is a term of its list; what browsers make of
/// the pages, the tests with peers see.
#[test]
fn a_page_explains_its_columns() {
    let dir = directory(&[("d.scn", DITHERED)]);
    for target in ["jack", "6502", "bbc"] {
        let args = ["explain", "d.scn", "-t", target, "--rows", "0..1"];
        success(dir.path(), &[&args[..], &["--html", "page.html"]].concat());
        let page = std::fs::read_to_string(dir.path().join("page.html")).expect("a page");
        let heads = page.split("<th").skip(1).filter_map(|rest| {
            let text = rest.split_once('>')?.1;
            text.split(['<', '\n']).next()
        });
        let heads: Vec<&str> = heads.collect();
        assert_eq!(heads.len(), 8, "{heads:?}");
        for head in heads {
            assert!(
                page.contains(&format!("<dt>{head}</dt><dd>")),
                "{target}: {head}"
            );
        }
        for wanted in [
            "width=device-width",
            "prefers-color-scheme:dark",
            "<dd>of all ",
        ] {
            assert!(page.contains(wanted), "{target}: {wanted}");
        }
    }
}
