//! `tune`: the frontier is measured, its points are had again by their options, and goals
//! are never missed.

use crate::cli::{directory, json, names, slowlight, success};
use serde_json::Value;
use slowlight::scene::Changes;
use slowlight::target_args::ScreenArgs;
use slowlight::tune::choice::{Base, Choice, Setting};
use slowlight::tune::explore::Found;
use slowlight::tune::goal::{Goals, Measure};
use slowlight::tune::point::{Measured, Point};
use slowlight::tune::tell::Told;
use slowlight_compiler::report::frontier::rank_correlation;
use slowlight_compiler::targets::find;
use std::path::{Path, PathBuf};

/// A bright ball, mirrored by itself some times; params, loops and a dither.
pub const BALL: &str = "image 32 x 24 inks black, grey, white;
param light: vec3 = (0.5, 0.7, 0.5) in (-1, -1, 0) .. (1, 1, 1);
effect glow(first: real) -> real else first =
  loop (v = first, n = 0) max 9 { if v < 0.6 and n < 8 then next(v * 1.25 + 0.01, n + 1) else v } else 0.1;
draw (x, y) = {
  let r = ray((0, 0, 4), unit(((x - 15.5) / 16, (11.5 - y) / 16, -1)));
  let v = if let h = sphere((0, 0, 0), 2).hit(r) then 0.1 + 0.8 * max(dot(h.normal, light), 0) else y / 40;
  threshold(glow(v), bayer(4)[x mod 4, y mod 4])
};
";

/// Words of a command line without quotes.
fn words(text: &str) -> Vec<&str> {
    text.split_whitespace().collect()
}

fn tuned(dir: &Path, target: &str, more: &[&str]) -> Value {
    let args = words("tune ball.scn --json --no-cache --settings 6 -t");
    json(dir, &[&args[..], &[target], more].concat())
}

fn points(tuned: &Value) -> &Vec<Value> {
    tuned["points"].as_array().expect("points")
}

#[test]
fn every_point_is_had_again_by_its_options() {
    let dir = directory(&[("ball.scn", BALL)]);
    for target in ["6502:plain", "jack", "bbc:micro"] {
        let tuned = tuned(dir.path(), target, &[]);
        let all = points(&tuned);
        let on = |p: &&Value| p["on_frontier"] == true;
        let frontier: Vec<&Value> = all.iter().filter(on).collect();
        assert!(frontier.len() >= 3, "{target}: {}", tuned["frontier"]);
        assert!(all.iter().all(|p| p["differs_from_model"] == 0), "{target}");
        for point in frontier {
            let options = point["options"].as_str().expect("options");
            let args = ["run", "ball.scn", "-t", target, "--json"];
            let run = json(dir.path(), &[&args[..], &words(options)].concat());
            let same = [
                "cycles",
                "rmse",
                "psnr",
                "inks_sha256",
                "differs_from_native",
                "pixels",
                "format",
            ];
            for figure in same {
                assert_eq!(run[figure], point[figure], "{target} {options}: {figure}");
            }
        }
    }
}

#[test]
fn the_planner_orders_what_was_tried_as_the_machine_does() {
    let dir = directory(&[("ball.scn", BALL)]);
    for target in ["6502:plain", "jack"] {
        let tuned = tuned(dir.path(), target, &["--live"]);
        let of = |point: &Value, name| point[name].as_f64().expect("cycles");
        let pair = |point| (of(point, "predicted_cycles"), of(point, "cycles"));
        let all: Vec<(f64, f64)> = points(&tuned).iter().map(pair).collect();
        // On the frontier alone neighbours may change places that are a twentieth apart.
        let order = rank_correlation(&all).expect("an order");
        assert!(all.len() > 8 && order >= 0.95, "{target}: {all:?}");
    }
}

/// Another scene: a column's light does not depend on its row, and params are angles.
const COLUMNS: &str = "image 30 x 18 inks black, white;
param turn: angle = 0.05turn in 0turn .. 1turn;
draw (x, y) = {
  column let v = 0.5 + 0.45 * cos(turn + x * 0.03turn);
  threshold(v * (1 - y / 40), bayer(2)[x mod 2, y mod 2])
};
";

#[test]
fn goals_are_never_missed() {
    let dir = directory(&[("ball.scn", BALL), ("columns.scn", COLUMNS)]);
    for (scene, target) in [("ball.scn", "6502:plain"), ("columns.scn", "jack")] {
        let args = ["tune", scene, "-t", target, "--json", "--settings", "4"];
        let tuned = json(dir.path(), &args);
        let figures = |key: &str| -> Vec<f64> {
            let mut all: Vec<f64> = points(&tuned)
                .iter()
                .filter_map(|p| p[key].as_f64())
                .collect();
            all.sort_by(f64::total_cmp);
            all
        };
        let reached = |goal: &str, value: f64| {
            let goal_text = match goal {
                "--within" => format!("{value}s"),
                _ => value.to_string(),
            };
            let more = ["-o", "built", goal, &goal_text];
            let found = json(dir.path(), &[&args[..], &more].concat());
            let chosen = found["chosen"].as_str().expect("a choice").to_owned();
            let run = ["run", scene, "-t", target, "--json"];
            let run = json(dir.path(), &[&run[..], &words(&chosen)].concat());
            let off = run["differs_from_native"].as_f64().expect("pixels");
            let share = off / run["pixels"].as_f64().expect("pixels");
            match goal {
                "--within" => assert!(run["machine_seconds"].as_f64() <= Some(value), "{chosen}"),
                _ => assert!(share <= value, "{chosen}: {share} for {value}"),
            }
        };
        // Ten goals: what is just to be had among them.
        let at = |all: &[f64], part: usize| all[(all.len() - 1) * part / 4];
        for part in 0..5 {
            reached("--within", at(&figures("machine_seconds"), part));
            reached("--error", at(&figures("error"), part));
        }
    }
    assert!(names(dir.path()).contains(&"built".to_owned()));
}

#[test]
fn a_goal_that_nothing_reaches_says_how_close_one_comes() {
    let dir = directory(&[("ball.scn", BALL)]);
    let args = [
        "tune",
        "ball.scn",
        "-t",
        "jack",
        "--settings",
        "2",
        "-o",
        "none",
        "--no-cache",
    ];
    for (goal, value, said) in [
        ("--within", "1us", "the quickest takes"),
        ("--memory", "10", "the smallest takes"),
    ] {
        let output = slowlight(dir.path(), &[&args[..], &[goal, value]].concat());
        assert_eq!(output.status.code(), Some(1));
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            text.contains("nothing that was tried") && text.contains(said),
            "{text}"
        );
    }
    assert_eq!(names(dir.path()), ["ball.scn"]);
}

#[test]
fn the_page_is_whole_and_asks_for_nothing() {
    let dir = directory(&[("ball.scn", BALL)]);
    let args = [
        "tune",
        "ball.scn",
        "-t",
        "jack",
        "--settings",
        "4",
        "--no-cache",
    ];
    let files = ["--html", "report.html", "--svg", "plot.svg"];
    let more = ["--mark", "by <hand>=2h28m,0%"];
    let table = success(dir.path(), &[&args[..], &files, &more].concat());
    let page = std::fs::read_to_string(dir.path().join("report.html")).expect("a page");
    let sound = roxmltree::ParsingOptions {
        allow_dtd: true,
        ..Default::default()
    };
    let tree = roxmltree::Document::parse_with_options(&page, sound).expect("the page parses");
    for node in tree.descendants() {
        for attribute in node.attributes() {
            let (name, value) = (attribute.name(), attribute.value());
            if ["src", "href", "srcset", "action", "data"].contains(&name) {
                assert!(
                    value.starts_with("data:image/png;base64,"),
                    "{name}: {value}"
                );
            }
        }
        assert!(!["link", "iframe", "object", "embed"].contains(&node.tag_name().name()));
    }
    for outside in ["@import", "url(", "fetch(", "XMLHttpRequest", "import("] {
        assert!(!page.contains(outside), "{outside}");
    }
    // Of each kind: a dot that is worth choosing, its row, and its data.
    let data = tree
        .descendants()
        .find(|n| n.attribute("id") == Some("data"));
    let text = data.and_then(|n| n.text()).expect("data");
    let all: Vec<Value> = serde_json::from_str(text).expect("data is JSON");
    let dots = tree
        .descendants()
        .filter(|n| n.attribute("class") == Some("point"))
        .count();
    assert_eq!(dots, all.len());
    assert!(all.iter().all(|p| {
        p["picture"]
            .as_str()
            .is_some_and(|p| p.starts_with("iVBOR"))
    }));
    // The sentence on top is the terminal's.
    let sentence = table.lines().next().expect("a sentence");
    let shown = tree
        .descendants()
        .find(|n| n.attribute("class") == Some("sentence"));
    assert_eq!(shown.and_then(|n| n.text()), Some(sentence));
    let plot = std::fs::read_to_string(dir.path().join("plot.svg")).expect("a plot");
    let plot = roxmltree::Document::parse(&plot).expect("the plot parses");
    let marked = |n: roxmltree::Node<'_, '_>| n.text() == Some("by <hand>");
    assert!(plot.descendants().any(marked));
    // Of every point: what its time goes to.
    let spent = |p: &Value| p["spent"].as_array().is_some_and(|lines| !lines.is_empty());
    assert!(all.iter().all(spent));
}

#[test]
fn a_second_run_says_the_same_and_csv_has_every_point() {
    let dir = directory(&[("ball.scn", BALL)]);
    let args = ["tune", "ball.scn", "-t", "jack", "--settings", "3"];
    let json = |more: &str| success(dir.path(), &[&args[..], &["--json", more]].concat());
    // Whatever an earlier run may have kept.
    let anew = json("--no-cache");
    assert_eq!(json("--measure=pixels"), anew);
    assert_eq!(json("--measure=pixels"), anew);
    let csv = success(dir.path(), &[&args[..], &["--csv"]].concat());
    let lines: Vec<&str> = csv.lines().collect();
    let columns = lines[0].split(',').count();
    assert!(
        lines.len() > 3 && lines.iter().all(|l| l.split(',').count() == columns),
        "{csv}"
    );
}

#[test]
fn what_is_wrong_is_said() {
    let dir = directory(&[("ball.scn", BALL)]);
    for (more, said) in [
        (&["--within", "soon"][..], "write a time"),
        (&["--error", "130%"], "write an error as a share"),
        (&["--memory", "lots"], "write bytes"),
    ] {
        let output = slowlight(
            dir.path(),
            &[&["tune", "ball.scn", "-t", "6502"][..], more].concat(),
        );
        assert_eq!(output.status.code(), Some(2));
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(text.contains(said), "{text}");
    }
    for (more, said) in [
        (&["--block", "5"][..], "no whole number of such blocks"),
        (&["--block", "0"], "a block is"),
        (&["--max-turns", "0"], "from 1 to 65535 turns"),
        (
            &["--block", "4", "--rows", "2..7"],
            "blocks are 4 rows high",
        ),
    ] {
        let output = slowlight(
            dir.path(),
            &[&["run", "ball.scn", "-t", "6502"][..], more].concat(),
        );
        assert_eq!(output.status.code(), Some(2), "{more:?}");
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(text.contains(said), "{text}");
    }
}

/// A point on Jack of blocks so large, with so many cycles and wrong pixels.
pub fn planted(block: u32, cycles: u64, pixels: u64) -> Point {
    let errors = slowlight::measure::Errors {
        count: 100,
        rmse: pixels as f64 / 100.0,
        psnr: None,
        max: 0.0,
        p99: 0.0,
        pixels,
        expected: 0.0,
        low_pass: 0.0,
    };
    Point {
        choice: Choice {
            setting: Setting {
                block: (block, block),
                ..Setting::WHOLE
            },
            format: "f316".to_owned(),
            tables: None,
            frozen: false,
            outlined: false,
            thrift: 0,
        },
        measured: Measured {
            mode: String::new(),
            inks: 2,
            size: (10, 10),
            cycles,
            seconds: cycles as f64,
            predicted: cycles as f64,
            before: 0.0,
            bytes: [Some(100 * cycles), None, None],
            differs_from_model: 0,
            errors,
            spent: Vec::new(),
            program_sha256: String::new(),
            inks_sha256: String::new(),
            picture: String::new(),
            difference: String::new(),
        },
    }
}

#[test]
fn a_planted_dominated_point_is_shown_as_such_and_never_chosen() {
    let base = Base {
        path: PathBuf::from("planted.scn"),
        changes: Changes::default(),
        target: find("jack").expect("a target"),
        screen: ScreenArgs::default(),
    };
    let found = Found {
        points: vec![
            planted(1, 90, 0),
            planted(3, 50, 30),
            planted(2, 40, 20),
            planted(8, 10, 70),
        ],
        ..Found::default()
    };
    let told = Told::new(&base, Measure::Pixels, &found);
    let json = told.json(None);
    let bad: Vec<&Value> = points(&json)
        .iter()
        .filter(|p| p["on_frontier"] == false)
        .collect();
    assert_eq!(bad.len(), 1);
    assert_eq!(bad[0]["options"], "--format f316 --block 3");
    assert_eq!(bad[0]["dominated_by"], "--format f316 --block 2");
    assert!(!told.table().contains("--block 3"));
    let choose = |goals: Goals| {
        let point = goals.choose(&told.points, Measure::Pixels);
        point.ok().map(|p| base.words(&p.choice).join(" "))
    };
    let goals = Goals::default();
    let within = |most| {
        choose(Goals {
            within: Some(most),
            ..goals
        })
    };
    let error = |most| {
        choose(Goals {
            error: Some(most),
            ..goals
        })
    };
    assert_eq!(within(60.0).as_deref(), Some("--format f316 --block 2"));
    assert_eq!(error(0.35).as_deref(), Some("--format f316 --block 2"));
    assert_eq!(error(0.0).as_deref(), Some("--format f316"));
    assert_eq!(within(9.0), None);
    let small = Goals {
        memory: Some(4500),
        ..goals
    };
    assert_eq!(choose(small).as_deref(), Some("--format f316 --block 2"));
    let none = Goals {
        error: Some(0.1),
        within: Some(50.0),
        ..goals
    };
    assert_eq!(choose(none), None);
    // Of each goal, how close one comes while the other is reached.
    let why = none.choose(&told.points, Measure::Pixels);
    let why = format!("{:?}", why.err());
    for said in ["the quickest takes 1 min 30 s", "the best has 20.0 %"] {
        assert!(why.contains(said), "{why}");
    }
}
