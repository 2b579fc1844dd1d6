#![allow(clippy::unwrap_used)]

use crate::plan::{Goal, Plan, plan};
use crate::scene::check;
use crate::sema::Options;
use crate::target::{default_mode, find};
use std::collections::BTreeSet;

fn planned(source: &str) -> Plan {
    let target = find("6502:plain").unwrap();
    let scene = check("test", source);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    let graph = scene
        .lower(&Options {
            offset: target.offset,
            ..Options::default()
        })
        .unwrap();
    let mode = default_mode(target, graph.image.width, graph.image.height).unwrap();
    plan(
        &graph,
        target,
        &Goal {
            name: "test".to_owned(),
            mode,
            rows: None,
            plot: true,
        },
    )
    .unwrap()
}

fn text(source: &str) -> String {
    let documents = super::emit(&planned(source));
    assert_eq!(documents.len(), 1);
    assert_eq!(documents[0].text.lines().count(), documents[0].lines.len());
    documents[0].text.clone()
}

/// The names that lines define, labels and symbols alike.
fn defined(text: &str) -> Vec<&str> {
    let name = |line: &'_ str| -> Option<usize> {
        let end = line.find([':', ' '])?;
        let symbol = line[end..].starts_with(':') || line[end..].starts_with(" = ");
        (symbol && line.starts_with(|c: char| c.is_ascii_alphabetic())).then_some(end)
    };
    text.lines()
        .filter_map(|line| name(line).map(|end| &line[..end]))
        .collect()
}

const GRADIENT: &str = "image 8 x 4 inks black, grey, white;
param tilt: real = 0.25 in -1 .. 1;
const steps = [0, 2, 1];
draw (x, y) = if x * tilt < y - 1 then ink(steps[x mod 3, 0]) else ink(2);";

#[test]
fn a_small_scene_reads_well() {
    insta::assert_snapshot!(format!("{GRADIENT}\n\n{}", text(GRADIENT)));
}

#[test]
fn names_of_scenes_never_meet_those_of_the_program() {
    let names = [
        "acc",
        "low",
        "lda",
        "sign",
        "start",
        "next_row",
        "pixel_x",
        "first_row",
        "multiply",
        "make_squares",
        "else1",
        "table0_0",
        "count",
        "s",
        "a",
        "param0",
        "take_int",
        "v1",
    ];
    for name in names {
        let source = format!(
            "image 8 x 4 inks black, white;
             param {name}: real = 0.25 in -1 .. 1;
             draw (x, y) = {{ let inc = sqrt({name} * x); let and_ = inc / (y + {name}); ink(floor(inc + and_)) }};"
        );
        let text = text(&source);
        let all = defined(&text);
        let unique: BTreeSet<&str> = all.iter().copied().collect();
        assert_eq!(all.len(), unique.len(), "{name}");
        for reserved in ["lda", "inc", "and", "a", "x", "y", "s"] {
            assert!(!unique.contains(reserved), "{name}: {reserved}");
        }
    }
}

#[test]
fn only_what_is_used_is_written() {
    let text = text("image 8 x 4 inks black, white; draw (x, y) = ink((x + y) mod 2);");
    for absent in [
        "multiply",
        "root",
        "divide",
        "make_squares",
        "clamp_index",
        "saturate",
    ] {
        assert!(!defined(&text).contains(&absent), "{absent}");
    }
}

#[test]
fn output_is_a_function_of_the_scene() {
    assert_eq!(text(GRADIENT), text(GRADIENT));
}

#[test]
fn a_dither_that_spreads_reads_well() {
    let source = "image 8 x 4 inks black, grey, white; draw (x, y) = floyd(x / 8, x, y);";
    // The runtime's parts are tested elsewhere.
    let all = text(source);
    let own = all.split("; ---- runtime").next().unwrap();
    insta::assert_snapshot!(format!("{source}\n\n{own}"));
}
