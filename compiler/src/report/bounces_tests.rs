//! Two mirrors that face each other, as measured and as the theory has it; the
//! table and the plot of docs/bounces.md, which are held against a new measurement.
//! `UPDATE_DOCS=1 cargo test -p slowlight-compiler bounces` writes them.
#![allow(clippy::unwrap_used)]

use super::bounces::{Growth, measure, mirrors, warnings};
use crate::plan::Goal;
use crate::planner::PlannedScene;
use crate::planner::plan;
use crate::scene;
use crate::sema::Options;
use crate::targets::{default_mode, find};
use std::fmt::Write;
use std::path::Path;

const FACING: &str = include_str!("../../../tests/scenes/bounces.scn");
const TARGETS: [(&str, &str); 3] = [
    ("jack", "#b2182b"),
    ("6502:plain", "#2166ac"),
    ("bbc:micro", "#1b7837"),
];
/// Bounces that are shown.
const SHOWN: usize = 8;

fn planned(target: &str, source: &str) -> PlannedScene {
    let target = find(target).unwrap();
    let scene = scene::check("test", source);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    let options = Options {
        offset: target.offset,
        ..Options::default()
    };
    let graph = scene.lower(&options).unwrap();
    let goal = Goal {
        name: "test".to_owned(),
        mode: default_mode(target, graph.image.width, graph.image.height).unwrap(),
        rows: None,
        plot: true,
    };
    // The loop as the scene has it, its first turn not apart.
    let plan = plan(&graph, target, &goal).unwrap();
    plan.stable().unwrap()
}

/// The mirrors' loop: the one that is seen to take most turns.
fn facing(target: &str) -> (String, Growth) {
    facing_of(target, FACING)
}

fn facing_of(target: &str, source: &str) -> (String, Growth) {
    let plan = planned(target, source);
    let loops = measure(&plan).loops.into_iter();
    let most = loops.max_by_key(|l| l.turns.len()).unwrap();
    (plan.runtime.format.to_owned(), most)
}

#[test]
fn theory_has_the_largest_eigenvalue() {
    assert!((mirrors(1.0, 1.0) - (2.0 + libm::sqrt(3.0))).abs() < 1e-15);
    // What the matrix does to an offset and an angle, bounce by bounce.
    for (gap, radius) in [(1.0, 1.0), (0.5, 2.0), (3.0, 1.0)] {
        let (mut h, mut a) = (1e-9, 0.0);
        let mut factor = 0.0;
        for _ in 0..60 {
            let before = h;
            (h, a) = (
                h + gap * a,
                2.0 / radius * h + (1.0 + 2.0 * gap / radius) * a,
            );
            factor = h / before;
        }
        assert!(
            (factor - mirrors(gap, radius)).abs() < 1e-9,
            "{gap} {radius}"
        );
    }
}

#[test]
fn measured_growth_is_as_the_theory_has_it() {
    let theory = mirrors(1.0, 1.0);
    for target in ["jack", "6502:plain"] {
        let (format, growth) = facing(target);
        let factor = growth.factor.unwrap();
        assert!((factor / theory - 1.0).abs() < 0.1, "{format}: {factor}");
        assert!(growth.turns.len() >= SHOWN, "{format}: {:?}", growth.turns);
    }
    // Its floats have so small errors across the axis that those along it hide
    // them until the last of the bounces.
    let (format, growth) = facing("bbc:micro");
    let last = last_ratio(&growth);
    assert!((3.0..4.0).contains(&last), "{format}: {last}");
}

fn last_ratio(growth: &Growth) -> f64 {
    growth.turns[SHOWN - 1].median / growth.turns[SHOWN - 2].median
}

/// A direction that is too long by a part l goes 3 l too deep, where the normal
/// is too short by as much; the mirror then makes it -11 l.
#[test]
fn lengths_that_are_not_renewed_grow_faster() {
    let plain = FACING.replace("unit(reflect(r.dir, h.normal))", "reflect(r.dir, h.normal)");
    let (_, growth) = facing_of("bbc:micro", &plain);
    let ratios = growth.turns.windows(2).take(4);
    for ratio in ratios.map(|t| t[1].median / t[0].median) {
        assert!((ratio / 11.0 - 1.0).abs() < 0.1, "{ratio}");
    }
}

#[test]
fn too_many_bounces_get_a_word_where_they_happen() {
    for (target, warned) in [("jack", true), ("6502:plain", true), ("bbc:micro", false)] {
        let said = |source: &str| {
            let plan = planned(target, source);
            warnings(&plan, &measure(&plan))
        };
        let words = said(FACING);
        assert_eq!(words.len(), usize::from(warned), "{target}: {words:?}");
        if let Some(word) = words.first() {
            let place = &FACING[word.span.start as usize..word.span.end as usize];
            assert!(place.starts_with("loop (r = first"), "{target}: {place}");
            assert!(
                word.message.contains(" of its 12 turns"),
                "{}",
                word.message
            );
        }
        // As many as are borne: nothing to remark.
        assert_eq!(said(&FACING.replace("max 12", "max 3")), [], "{target}");
    }
}

#[test]
fn sound_scenes_get_no_word_on_their_loops() {
    for (name, source) in [
        ("mirrors", include_str!("../../../examples/mirrors.scn")),
        ("torus", include_str!("../../../examples/torus.scn")),
        ("maze", include_str!("../../../examples/maze.scn")),
        (
            "primitives",
            include_str!("../../../examples/primitives.scn"),
        ),
    ] {
        for (target, _) in TARGETS {
            let plan = planned(target, source);
            let words = warnings(&plan, &measure(&plan));
            assert_eq!(words, [], "{name} on {target}");
        }
    }
}

#[test]
fn the_documents_figures_are_measured() {
    let all: Vec<(String, Growth)> = TARGETS.iter().map(|(t, _)| facing(t)).collect();
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let (page, plot) = (docs.join("bounces.md"), docs.join("pictures/bounces.svg"));
    let (table, drawn) = (table(&all), svg(&all));
    let text = std::fs::read_to_string(&page).unwrap();
    let (before, rest) = text.split_once("<!-- measured -->\n").unwrap();
    let (shown, after) = rest.split_once("<!-- end -->").unwrap();
    if std::env::var_os("UPDATE_DOCS").is_some() {
        let new = format!("{before}<!-- measured -->\n{table}<!-- end -->{after}");
        std::fs::write(&page, new).unwrap();
        std::fs::write(&plot, drawn).unwrap();
        return;
    }
    assert_eq!(shown, table, "UPDATE_DOCS=1 writes it");
    let kept = std::fs::read_to_string(&plot).unwrap();
    assert!(
        kept == drawn,
        "docs/pictures/bounces.svg: UPDATE_DOCS=1 writes it"
    );
}

fn table(all: &[(String, Growth)]) -> String {
    let mut out = "| bounces |".to_owned();
    for (format, _) in all {
        let _ = write!(out, " {format} |");
    }
    out += "\n| ---: |";
    out += &" ---: |".repeat(all.len());
    for n in 0..SHOWN {
        let _ = write!(out, "\n| {} |", n + 1);
        for (_, growth) in all {
            let _ = write!(out, " {:.1e} |", growth.turns[n].median);
        }
    }
    // An error that has not left its floor has no growth to be fitted.
    let grown = |growth: &Growth| growth.turns[SHOWN - 1].median > 1e-3;
    out += "\n| growth a bounce |";
    for (_, growth) in all {
        let _ = match grown(growth) {
            true => write!(out, " {:.2} |", growth.factor.unwrap()),
            false => write!(out, " {:.2} (the last) |", last_ratio(growth)),
        };
    }
    out += "\n| bounces borne |";
    for (_, growth) in all {
        let _ = match grown(growth) {
            true => write!(out, " {} |", growth.bears.unwrap()),
            false => write!(out, " all {SHOWN} |"),
        };
    }
    out + "\n"
}

/// Bounces to the right, the error's logarithm upwards; dashed what the theory
/// has, from each format's first error on.
fn svg(all: &[(String, Growth)]) -> String {
    let (width, height, decades) = (520.0, 360.0, 11.0);
    let x = |n: usize| 60.0 + (width - 160.0) * n as f64 / (SHOWN - 1) as f64;
    let y = |error: f64| 20.0 - (height - 60.0) * error.max(1e-11).log10() / decades;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    for decade in (0..=11).step_by(2) {
        let at = y(10f64.powi(-decade));
        let _ = writeln!(
            out,
            "<path d=\"M60 {at:.1}H{:.1}\" stroke=\"#ddd\"/><text x=\"52\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            width - 100.0,
            at + 4.0,
            match decade {
                0 => "1".to_owned(),
                n => format!("1e-{n}"),
            }
        );
    }
    for n in 0..SHOWN {
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            x(n),
            height - 22.0,
            n + 1
        );
    }
    let _ = writeln!(
        out,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">bounces</text>",
        (width - 40.0) / 2.0,
        height - 6.0
    );
    let theory = mirrors(1.0, 1.0);
    for ((_, colour), (format, growth)) in TARGETS.iter().zip(all) {
        let medians: Vec<f64> = growth.turns.iter().take(SHOWN).map(|t| t.median).collect();
        let line = |of: &dyn Fn(usize) -> f64| {
            let point = |n| format!("{:.1},{:.1}", x(n), y(of(n)));
            (0..SHOWN).map(point).collect::<Vec<String>>().join(" ")
        };
        let dashed = line(&|n| (medians[0] * theory.powi(n as i32)).min(1.0));
        let _ = writeln!(
            out,
            "<polyline points=\"{dashed}\" fill=\"none\" stroke=\"{colour}\" stroke-dasharray=\"4 4\"/>"
        );
        let solid = line(&|n| medians[n]);
        let _ = writeln!(
            out,
            "<polyline points=\"{solid}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>"
        );
        let last = medians[SHOWN - 1];
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"{colour}\">{format}</text>",
            x(SHOWN - 1) + 8.0,
            y(last) + 4.0
        );
    }
    out + "</svg>\n"
}
