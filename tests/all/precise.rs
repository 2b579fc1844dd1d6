//! `check` in the targets' formats: what is fragile, what is proved.

use crate::cli::{directory, json, slowlight, success};
use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn a_fragile_line_is_named_with_a_way_out() {
    let args = ["check", "tests/fragile/huge_floor.scn", "--target", "jack"];
    let output = slowlight(root(), &args);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(
        said.contains("in f316 as few as 5 of 13 bits are left here"),
        "{said}"
    );
    assert!(said.contains("huge_floor.scn:8:"), "{said}");
    assert!(said.contains("help: nearly equal values are subtracted"));
    // Forty bits are enough for it.
    let fine = [
        "check",
        "tests/fragile/huge_floor.scn",
        "--format",
        "real40",
    ];
    assert!(success(root(), &fine).contains("nothing to remark"));
}

#[test]
fn what_is_proved_stands_beside_what_is_measured() {
    let found = json(root(), &["check", "examples/mirrors.scn", "--json"]);
    let formats = found["formats"].as_array().expect("formats");
    assert_eq!(formats.len(), 3);
    for row in formats {
        let number = |name: &str| row[name].as_f64().expect("a number");
        assert!(number("proved") > 0.5 * number("pixels"), "{row}");
        assert!(number("bound_proved") >= number("error_measured"), "{row}");
        assert!(number("error_measured") > 0.0, "{row}");
    }
    let quick = json(
        root(),
        &["check", "examples/mirrors.scn", "--quick", "--json"],
    );
    assert_eq!(quick["formats"].as_array().map(Vec::len), Some(0));
}

#[test]
fn a_format_that_no_target_has_is_wrong_usage() {
    let args = ["check", "examples/mirrors.scn", "--format", "f32"];
    let output = slowlight(root(), &args);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("no format `f32`"), "{said}");
}

#[test]
fn a_divisor_that_may_be_zero_is_named_with_its_range() {
    let scene = "image 8 x 8 inks black, white;\n\
        param d: vec3 = (0.5, 0, 1) in (-1, -1, -1) .. (1, 1, 1);\n\
        draw (x, y) = threshold(1 / d.x + (if d.y > 0 then 1 / d.y else 0) + 1 / (2 + d.z), 0.5);\n";
    let dir = directory(&[("zero.scn", scene)]);
    let output = slowlight(dir.path(), &["check", "zero.scn", "--quick"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    let wanted = "`1 / d.x` may divide by zero: `d.x` lies in [-1, 1]";
    assert!(said.contains(wanted), "{said}");
    // What a condition or a range excludes is no fault.
    assert_eq!(said.matches("may divide").count(), 1, "{said}");
}

/// A pixel that takes more steps than are run to look at one is not one without a fault.
#[test]
fn nothing_is_said_of_pixels_that_nobody_looked_at() {
    let turns = |k: u32, inner: &str| {
        format!(
            "loop (i{k} = 0) max 65535 {{ if i{k} > 60000 then i{k} else next(i{k} + 1 + {inner}) }} \
             else 0"
        )
    };
    let nest = turns(0, &format!("({}) mod 2", turns(1, "(x + y) mod 2")));
    let text = format!("image 8 x 8 inks black, white;\ndraw (x, y) = ink({nest} mod 2);\n");
    let dir = directory(&[("nest.scn", &text)]);
    let said = success(dir.path(), &["check", "nest.scn", "-t", "jack"]);
    assert!(!said.contains("nothing to remark"), "{said}");
    let unseen = "no pixel could be looked at in f316: a single one takes more steps";
    assert!(said.contains(unseen), "{said}");
    let found = json(dir.path(), &["check", "nest.scn", "-t", "jack", "--json"]);
    assert_eq!(found["formats"][0]["unseen"], true);
}
