#![allow(clippy::unwrap_used)]

use crate::plan::Goal;
use crate::planner::PlannedScene;
use crate::planner::plan;
use crate::scene::check;
use crate::sema::Options;
use crate::targets::{default_mode, find};

fn planned(target: &str, source: &str, plot: bool) -> PlannedScene {
    let target = find(target).unwrap();
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
            plot,
        },
    )
    .unwrap()
}

fn text(target: &str, source: &str, plot: bool) -> String {
    let documents = super::emit(&planned(target, source, plot));
    assert_eq!(documents.len(), 1);
    assert_eq!(documents[0].name, "test.bas");
    assert_eq!(documents[0].text.lines().count(), documents[0].lines.len());
    documents[0].text.clone()
}

const GRADIENT: &str = "image 8 x 4 inks black, grey, white;
param tilt: real = 0.25 in -1 .. 1;
const steps = [0, 2, 1];
draw (x, y) = if x * tilt < y - 1 then ink(steps[x mod 3, 0]) else ink(2);";

const MIRRORS: &str = include_str!("../../../../examples/mirrors.scn");

#[test]
fn a_small_scene_reads_well() {
    for target in ["bbc:micro", "bbc:agon"] {
        let name = target.replace(':', "_");
        insta::assert_snapshot!(
            name,
            format!("{GRADIENT}\n\n{}", text(target, GRADIENT, true))
        );
    }
}

#[test]
fn two_mirrors() {
    insta::assert_snapshot!(format!("{MIRRORS}\n\n{}", text("bbc:micro", MIRRORS, true)));
}

#[test]
fn a_listing_is_written_for_reading() {
    let mut plan = planned("bbc:micro", MIRRORS, true);
    plan.listing = true;
    insta::assert_snapshot!(super::emit(&plan)[0].text.clone());
}

#[test]
fn the_screens_memory_is_written_where_bytes_are_whole() {
    let poked = |width: u32, target: &str| {
        let source = format!("image {width} x 4 inks black, white; draw (x, y) = ink(x mod 2);");
        text(target, &source, true).contains('?')
    };
    assert!(poked(16, "bbc:micro"));
    // Centred, it would begin within a byte.
    assert!(!poked(18, "bbc:micro"));
    assert!(!poked(16, "bbc:agon"));
}

#[test]
fn lines_are_in_order_and_every_goto_goes_to_one() {
    let text = text("bbc:micro", MIRRORS, true);
    let mut numbers = Vec::new();
    for line in text.lines() {
        let digits = line.find(|c: char| !c.is_ascii_digit()).unwrap();
        numbers.push(line[..digits].parse::<u32>().unwrap());
        assert!(line.len() < 250, "{line}");
        assert!(line.matches("ELSE").count() < 2, "{line}");
        assert!(!line.contains('\u{1}'), "{line}");
    }
    assert!(numbers.is_sorted());
    let mut gotos = 0;
    for word in ["GOTO", "THEN"] {
        for (at, _) in text.match_indices(word) {
            let rest = text[at + word.len()..].trim_start();
            let digits = rest
                .find(|c: char| !c.is_ascii_digit())
                .unwrap_or(rest.len());
            if let Ok(n) = rest[..digits].parse::<u32>() {
                assert!(numbers.contains(&n), "{n}");
                gotos += 1;
            }
        }
    }
    assert!(gotos > 5);
}

#[test]
fn a_program_that_does_not_draw_changes_no_screen() {
    let text = text("bbc:micro", GRADIENT, false);
    for word in ["MODE", "VDU", "GCOL", "PLOT"] {
        assert!(!text.contains(word), "{text}");
    }
}

#[test]
fn a_dither_that_spreads_reads_well() {
    let source = "image 8 x 4 inks black, grey, white; draw (x, y) = floyd(x / 8, x, y);";
    insta::assert_snapshot!(format!("{source}\n\n{}", text("bbc:micro", source, true)));
}
