//! Programs whose params were edited by hand: the picture follows, on every target.

use crate::cli::{directory, json, slowlight, success};
use crate::cli_run::{SPOT, built, edit, targets};

/// The text with the number behind `label =` replaced.
fn with_value(text: &str, label: &str, value: impl Fn(&str) -> String) -> Option<String> {
    let mut found = false;
    let line = |line: &str| {
        let assigned = line.find(label).and_then(|at| {
            let rest = &line[at + label.len()..];
            let equals = rest.find('=')?;
            let number = rest[equals + 1..].trim_start();
            let end = number.find(|c: char| !c.is_ascii_digit() && c != '.' && c != '-');
            let number = &number[..end.unwrap_or(number.len())];
            let head = &line[..line.len() - rest.len() + equals + 1];
            (rest[..equals].trim().is_empty() && !number.is_empty()).then_some((head, number))
        });
        match assigned {
            Some((head, number)) if !found => {
                found = true;
                let tail = line[head.len()..].replacen(number, &value(number), 1);
                format!("{head}{tail}")
            }
            _ => line.to_owned(),
        }
    };
    let new: Vec<String> = text.lines().map(line).collect();
    found.then(|| new.join("\n") + "\n")
}

#[test]
fn edited_parameters_change_the_picture() {
    let dir = directory(&[("spot.scn", SPOT)]);
    let dir = dir.path();
    for target in targets(dir) {
        let files = built(dir, &target);
        assert!(!files.is_empty(), "{target}");
        let out = dir.join("out");
        let run = ["run", "spot.scn", "--target", &target, "--program", "out"];
        let untouched = success(dir, &run);
        assert!(!untouched.is_empty());
        // 5.5 becomes 2, in the block's own scale.
        let scaled = |number: &str| {
            let old: f64 = number.parse().expect("a number");
            (old / 5.5 * 2.0).round().to_string()
        };
        assert_eq!(edit(&out, |t| with_value(t, "at_x", scaled)), 1, "{target}");
        let edited = json(dir, &[&run[..], &["--json"]].concat());
        assert_eq!(edited["differs_from_model"], 0, "{target}");
        let set = [
            "run", "spot.scn", "--target", &target, "--json", "--set", "at=2,3.5",
        ];
        assert_eq!(
            edited["inks_sha256"],
            json(dir, &set)["inks_sha256"],
            "{target}"
        );

        let fails = |part: &str| {
            let output = slowlight(dir, &run);
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(1), "{target}: {said}");
            assert!(said.contains(part), "{target}: {said}");
        };
        edit(&out, |t| with_value(t, "at_x", |_| "20000".to_owned()));
        fails("outside its range");
        edit(&out, |t| Some(t.replace("at_x", "at_q")));
        fails("at_x");
        std::fs::remove_dir_all(&out).expect("removed");
        fails("out");
    }
}

/// Names that mean something to some machine, and each type.
const ODD: &str = "image 8 x 4 inks black, white;
param a: real = 1 in 0 .. 4;
param field: real = 1 in 0 .. 4;
param Left: int = 1 in 0 .. 4;
param lda: real = 1 in 0 .. 4;
param sign: real = 1 in 0 .. 4;
param x1: bool = true;
param Count: real = 1 in 0 .. 4;
param count: real = 1 in 0 .. 4;
param COUNT: real = 0.5 in 0 .. 4;
param TO: int = 2 in 0 .. 4;
param X: int = 3 in 0 .. 4;
param ENDpoint: vec2 = (0.25, 1.5) in (0, 0) .. (4, 4);
draw (x, y) = {
  let endpoint_x = a + field + Left + lda + sign + Count + count;
  let to = (if endpoint_x > 2 then TO + y else X) + x;
  let sum = endpoint_x + COUNT + TO * X + ENDpoint.x * ENDpoint.y + to * to;
  ink(floor((sum + x) / 8) + (if x1 then 0 else 1))
};
";

#[test]
fn parameters_are_found_under_any_name() {
    let dir = directory(&[("spot.scn", ODD)]);
    let dir = dir.path();
    for target in targets(dir) {
        built(dir, &target);
        let run = ["run", "spot.scn", "--target", &target, "--program", "out"];
        let same = json(dir, &[&run[..], &["--json"]].concat());
        assert_eq!(same["differs_from_model"], 0, "{target}");
        // Each under its own name: one changed is that one.
        let out = dir.join("out");
        let names = ["ENDpoint_y", "endpoint_y"];
        let edited: usize = names
            .iter()
            .map(|name| edit(&out, |t| with_value(t, name, double)))
            .sum();
        assert_eq!(edited, 1, "{target}");
        let edited = json(dir, &[&run[..], &["--json"]].concat());
        let set = ["run", "spot.scn", "--target", &target, "--json"];
        let set = json(dir, &[&set[..], &["--set", "ENDpoint=0.25,3"]].concat());
        assert_eq!(edited["differs_from_model"], 0, "{target}");
        assert_eq!(edited["inks_sha256"], set["inks_sha256"], "{target}");
        std::fs::remove_dir_all(out).expect("removed");
    }
}

/// A number of the parameter block, doubled.
fn double(number: &str) -> String {
    let old: f64 = number.parse().expect("a number");
    (2.0 * old).to_string()
}

#[test]
fn edited_rows_are_the_picture() {
    let dir = directory(&[("spot.scn", SPOT)]);
    let dir = dir.path();
    for target in targets(dir) {
        built(dir, &target);
        let out = dir.join("out");
        let run = ["run", "spot.scn", "--target", &target, "--program", "out"];
        let set = |row: &str, number: &str| {
            let names = [format!("{row}_row"), format!("{row}%")];
            let edited = names
                .iter()
                .map(|name| edit(&out, |t| with_value(t, name, |_| number.to_owned())));
            assert_eq!(edited.sum::<usize>(), 1, "{target}");
        };
        set("first", "1");
        set("last", "3");
        let edited = json(dir, &[&run[..], &["--json"]].concat());
        assert_eq!(edited["differs_from_model"], 0, "{target}");
        assert_eq!(edited["height"], 3, "{target}");
        let rows = ["run", "spot.scn", "-t", &target, "--rows", "1..3", "--json"];
        let rows = json(dir, &rows);
        assert_eq!(edited["inks_sha256"], rows["inks_sha256"], "{target}");
        let same = json(dir, &[&run[..], &["--rows", "1..3", "--json"]].concat());
        assert_eq!(same["inks_sha256"], rows["inks_sha256"], "{target}");

        let fails = |more: &[&str], status: i32, part: &str| {
            let output = slowlight(dir, &[&run[..], more].concat());
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(status), "{target}: {said}");
            assert!(said.contains(part), "{target}: {said}");
        };
        fails(&["--rows", "2..3"], 2, "draws rows 1..3");
        set("last", "300");
        fails(&[], 1, "the screen shows rows");
        set("last", "0");
        fails(&[], 1, "it draws no row");
        std::fs::remove_dir_all(out).expect("removed");
    }
}
