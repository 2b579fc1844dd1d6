//! docs/accuracy.md is still true: its programs are those that are made today, and what is
//! cheap to run again comes to the same cycles and errors. `slowlight survey` writes it anew
//! by the command that stands on its top.

#[cfg(unix)]
use crate::cli::interrupted;
use crate::cli::{LONG, directory, json, names, slowlight, success};
use serde_json::Value;
use slowlight::scene::{Changes, Scene};
use slowlight::target_args::ScreenArgs;
use slowlight::ways::{apart, search};
use slowlight::{digest, target_args};
use slowlight_compiler::targets::find;
use std::path::{Path, PathBuf};

/// A row of a frontier.
#[derive(Clone, Debug)]
struct Row {
    scene: String,
    target: String,
    options: String,
    cycles: u64,
    pixels: u64,
    program: String,
}

/// All rows of a document, by its section's command and its table.
fn rows(text: &str) -> Vec<Row> {
    let (mut scene, mut target) = (String::new(), String::new());
    let mut found = Vec::new();
    let number = |cell: &str| cell.replace(',', "").parse().ok();
    for line in text.lines() {
        if let Some(command) = line.strip_prefix("`slowlight tune ") {
            let mut words = command.split_whitespace();
            scene = words.next().expect("a scene").to_owned();
            target = words.nth(1).expect("a target").to_owned();
        }
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let [_, options, _, cycles, pixels, _, _, _, _, program, _] = cells[..] else {
            continue;
        };
        if let (Some(cycles), Some(pixels)) = (number(cycles), number(pixels)) {
            found.push(Row {
                scene: scene.clone(),
                target: target.clone(),
                options: options.replace("(none)", ""),
                cycles,
                pixels,
                program: program.to_owned(),
            });
        }
    }
    found
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn document() -> String {
    let path = root().join("docs/accuracy.md");
    std::fs::read_to_string(path).expect("docs/accuracy.md")
}

/// The digest of the program that a row's options make.
fn program(row: &Row) -> String {
    let mut changes = Changes::default();
    let mut screen = ScreenArgs::default();
    let mut words = row.options.split_whitespace();
    while let Some(option) = words.next() {
        let value = words.next().expect("a value").to_owned();
        match option {
            "--format" => screen.format = Some(value),
            "--freeze" => changes.freeze.push(value),
            "--block" => screen.block = target_args::block(&value).ok(),
            "--refine" => screen.refine = target_args::refining(&value).ok(),
            "--max-turns" => screen.max_turns = value.parse().ok(),
            "--max-steps" => screen.max_steps = value.parse().ok(),
            "--hits" => screen.ways.hits = search(&value).ok(),
            "--differences" => screen.ways.differences = apart(&value).ok(),
            "--samples" => screen.ways.samples = value.parse().ok(),
            other => panic!("{other} is no option of a row"),
        }
    }
    let target = find(&row.target).expect("a target");
    let scene = Scene::open(&root().join(&row.scene), &changes).expect("a scene");
    digest::program(&screen.plan(&scene, target, &[]).expect("a plan"))
}

/// The quickest row of each section.
fn quickest(rows: &[Row]) -> Vec<Row> {
    let mut found: Vec<Row> = Vec::new();
    for row in rows {
        let same = |other: &Row| (&other.scene, &other.target) == (&row.scene, &row.target);
        if !found.last().is_some_and(same) {
            found.push(row.clone());
        }
    }
    found
}

#[test]
fn every_kind_of_machine_is_surveyed_with_its_plots() {
    let text = document();
    let rows = rows(&text);
    // By the command on its top, which somebody will run again.
    let words = || {
        text.split('`')
            .nth(1)
            .expect("a command")
            .split_whitespace()
    };
    let scenes: Vec<&str> = words().filter(|word| word.ends_with(".scn")).collect();
    assert!(scenes.len() >= 4, "{scenes:?}");
    for scene in scenes {
        for target in ["jack", "bbc:micro", "6502:plain"] {
            let here = |row: &&Row| (row.scene.as_str(), row.target.as_str()) == (scene, target);
            let here = rows.iter().filter(here).count();
            assert!(here > 0, "{scene} on {target}");
            let stem = Path::new(scene).file_stem().expect("a name");
            let (stem, file) = (stem.to_string_lossy(), target.replace(':', "-"));
            let name = format!("accuracy-{stem}-{file}.svg");
            assert!(text.contains(&format!("(pictures/{name})")), "{name}");
            let path = root().join("docs/pictures").join(&name);
            let plot = std::fs::read_to_string(path).expect("a plot");
            let plot = roxmltree::Document::parse(&plot).expect("the plot parses");
            let blue = |n: &roxmltree::Node<'_, '_>| {
                n.attribute("class") == Some("point") && n.attribute("fill-opacity") == Some("1")
            };
            assert_eq!(plot.descendants().filter(blue).count(), here, "{name}");
        }
    }
}

/// The scene that is planned soonest: all its rows are looked at.
const SOON: &str = "examples/maze.scn";

/// Of one scene every row, and with that most formats of every machine; of every other
/// section one row is run, below.
#[test]
fn the_programs_are_those_that_are_made_today() {
    let all = rows(&document());
    let mut stale = Vec::new();
    let mut looked = 0;
    for row in all.iter().filter(|row| row.scene == SOON) {
        looked += 1;
        let made = program(row);
        if !made.starts_with(&row.program) {
            stale.push(format!("{} on {}: {}", row.scene, row.target, row.options));
        }
    }
    assert!(looked >= 12, "{looked}");
    let stale = stale.join("\n  ");
    assert!(
        stale.is_empty(),
        "docs/accuracy.md is of other programs; the command on its top writes it anew:\n  {stale}"
    );
}

/// The quickest row of every section.
#[test]
fn what_is_cheap_comes_to_the_same_again() {
    for row in quickest(&rows(&document())) {
        let mut args = vec!["run", &row.scene, "-t", &row.target, "--json"];
        args.extend(row.options.split_whitespace());
        let run = json(root(), &args);
        let what = format!("{} on {}: {}", row.scene, row.target, row.options);
        assert_eq!(run["differs_from_model"], 0, "{what}");
        assert_eq!(run["cycles"], row.cycles, "{what}");
        assert_eq!(run["differs_from_native"], row.pixels, "{what}");
    }
}

/// Stripes and a disc: something to be off by.
const DISC: &str = "image 16 x 12 inks black, grey, white;
param high: real = 5 in 0 .. 11;
// mark 6502: by hand = 200000 cycles, 10%
// mark my words: this is none
draw (x, y) = {
  let away = (x - 7.5)^2 + (y - high)^2;
  threshold(if away < 20 then 0.9 - away / 40 else x / 32, bayer(2)[x mod 2, y mod 2])
};
";

#[test]
fn a_survey_is_written_whole_and_says_the_same_again() {
    let dir = directory(&[("disc.scn", DISC)]);
    let args = [
        "survey", "disc.scn", "-t", "6502", "-t", "jack", "-o", "found.md",
    ];
    let more = ["--settings", "3", "--no-cache"];
    success(dir.path(), &[&args[..], &more].concat());
    let wanted = [
        "accuracy-disc-6502-plain.svg",
        "accuracy-disc-jack.svg",
        "disc.scn",
        "found.md",
    ];
    assert_eq!(names(dir.path()), wanted);
    let read = |name: &str| std::fs::read_to_string(dir.path().join(name)).expect("a file");
    let text = read("found.md");
    success(dir.path(), &[&args[..], &more].concat());
    assert_eq!(read("found.md"), text);
    let found = rows(&text);
    assert!(found.len() >= 4, "{text}");
    for row in &found {
        let mut args = vec!["run", &row.scene, "-t", &row.target, "--json"];
        args.extend(row.options.split_whitespace());
        let run: Value = json(dir.path(), &args);
        assert_eq!(run["cycles"], row.cycles, "{row:?}");
        assert_eq!(run["differs_from_native"], row.pixels, "{row:?}");
    }
    // The scene's own mark, on its machine alone.
    assert_eq!(text.matches("by hand").count(), 1, "{text}");
    assert!(read("accuracy-disc-6502-plain.svg").contains("by hand"));
    assert!(!read("accuracy-disc-jack.svg").contains("by hand"));
}

/// Of a survey that is interrupted neither the document nor a directory for its plots.
#[cfg(unix)]
#[test]
fn an_interrupted_survey_leaves_nothing() {
    let dir = directory(&[("long.scn", LONG)]);
    let args = ["survey", "long.scn", "-t", "6502", "-o", "found/a.md"];
    let more = ["--pictures", "found/plots", "--no-cache"];
    interrupted(dir.path(), &[&args[..], &more].concat());
    assert_eq!(names(dir.path()), ["long.scn"]);
}

/// What takes too long is left out and said, scene by scene; directories are made.
#[test]
fn a_scene_may_have_a_limit_of_its_own() {
    let dir = directory(&[("disc.scn", DISC), ("other.scn", DISC)]);
    let args = ["survey", "disc.scn", "other.scn", "-t", "jack"];
    let limits = [
        "--limit=9000000",
        "--limit=other=30",
        "--limit=other/jack=20000",
    ];
    let out = ["-o", "docs/found.md", "--pictures", "docs/plots"];
    let more = ["--settings", "3", "--no-cache"];
    success(dir.path(), &[&args[..], &limits, &out, &more].concat());
    let text = std::fs::read_to_string(dir.path().join("docs/found.md")).expect("a file");
    let wanted = ["accuracy-disc-jack.svg", "accuracy-other-jack.svg"];
    assert_eq!(names(&dir.path().join("docs/plots")), wanted);
    assert!(text.contains("--limit 9000000 --limit other=30 --limit other/jack=20000"));
    let (of_disc, of_other) = text.split_once("## other").expect("two scenes");
    assert!(of_disc.contains("tune disc.scn --target jack --settings 3 --limit 9000000`"));
    assert!(of_other.contains("tune other.scn --target jack --settings 3 --limit 20000`"));
    assert!(!of_disc.contains("Not to be had"), "{of_disc}");
    assert!(of_other.contains("Not to be had"), "{of_other}");
    // What was left out is what takes longer, and nothing else.
    let of = |scene: &str| {
        let rows = rows(&text).into_iter();
        rows.filter(|row| row.scene == scene).collect::<Vec<Row>>()
    };
    assert!(of("other.scn").iter().all(|row| row.cycles <= 20_000));
    assert!(of("disc.scn").iter().any(|row| row.cycles > 20_000));
}

#[test]
fn what_cannot_be_surveyed_is_said() {
    let wrong = DISC.replace("200000 cycles", "soon");
    let other = PathBuf::from("other").join("disc.scn");
    let dir = directory(&[("disc.scn", &wrong), ("square.scn", DISC)]);
    std::fs::create_dir(dir.path().join("other")).expect("a directory");
    std::fs::write(dir.path().join(&other), DISC).expect("a file");
    let other = other.display().to_string();
    for (args, status, said) in [
        (
            &["disc.scn", "-t", "6502", "-o", "a.md"][..],
            1,
            "disc.scn:3",
        ),
        (&["disc.scn", &other, "-o", "a.md"], 2, "have one name"),
        (
            &["square.scn", "-o", "a.md", "--pictures", "/tmp"],
            2,
            "beside or below",
        ),
        (
            &["square.scn", "-o", "a.md", "--pictures", "square.scn/plots"],
            1,
            "square.scn is no directory",
        ),
        (
            &["square.scn", "-o", "a.md", "--limit", "disc=900000"],
            2,
            "no scene here is called disc",
        ),
        (
            &[
                "square.scn",
                "-t",
                "jack",
                "-o",
                "a.md",
                "--limit",
                "square/6502:bbc=9",
            ],
            2,
            "on any machine here",
        ),
        (
            &["square.scn", "-o", "a.md", "--limit", "square=lots"],
            2,
            "write cycles",
        ),
        (
            &["square.scn", "-o", "a.md", "--settings", "disc=3"],
            2,
            "--settings disc=...: no scene here is called disc",
        ),
        (
            &["square.scn", "-o", "a.md", "--settings", "201"],
            2,
            "write a number, at most 200",
        ),
        (&["none.scn", "-o", "a.md"], 1, "none.scn"),
    ] {
        let output = slowlight(dir.path(), &[&["survey"][..], args].concat());
        assert_eq!(output.status.code(), Some(status), "{args:?}");
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(text.contains(said), "{text}");
    }
    assert!(!names(dir.path()).contains(&"a.md".to_owned()));
}
