//! `run`, `build` and `compare` on every target: the machine against the model
//! and the native picture, exit statuses.

use crate::cli::{STEPS, directory, json, names, slowlight, success};
use serde_json::Value;
use std::path::Path;

/// A scene with everything that the pipeline has: params, an effect, a loop,
/// a table, a dither; smooth, so that formats differ by little.
pub const SPOT: &str = "image 12 x 8 inks black, white;
param at: vec2 = (5.5, 3.5) in (0, 0) .. (11, 7);
const cells = [0.2, 0.6; 0.8, 0.4];
effect glow(v: real) -> real else v = min(v + 0.1, 1);
fn halved(v: real, n: int) -> real =
  loop (w = v, k = n) max 3 { if k > 0 then next(w / 2, k - 1) else w } else w;
dither dots(v: real, x: int, y: int) -> ink =
  ink(if v > cells[x mod 2, y mod 2] then inks - 1 else 0);
draw (x, y) = {
  let p = (x, y) - at;
  dots(glow(halved(2 * (1 - dot(p, p) / 40), 1)), x, y)
};
";

/// The names of all targets.
pub fn targets(dir: &Path) -> Vec<String> {
    let listed = json(dir, &["targets", "--json"]);
    let all = listed.as_array().expect("a list").iter();
    // Those of column scenes have tests of their own.
    let all = all.filter(|t| t["columns_only"] == false);
    let names = all.map(|t| t["target"].as_str().expect("a name").to_owned());
    names.collect()
}

const FIELDS: &[&str] = &[
    "scene",
    "target",
    "mode",
    "inks",
    "offset",
    "format",
    "width",
    "height",
    "pixels",
    "cycles",
    "plot_cycles",
    "cycles_per_pixel",
    "machine_seconds",
    "code_bytes",
    "table_bytes",
    "ram_bytes",
    "inks_sha256",
    "differs_from_model",
    "differs_from_native",
    "rmse",
    "psnr",
    "effects",
];

#[test]
fn machines_draw_what_their_models_do() {
    let dir = directory(&[("spot.scn", SPOT)]);
    let dir = dir.path();
    assert!(!targets(dir).is_empty());
    for target in targets(dir) {
        let run = |more: &[&str]| {
            let mut args = vec!["run", "spot.scn", "--target", &target, "--json"];
            args.extend(more);
            json(dir, &args)
        };
        let whole = run(&["-o", "spot.pgm"]);
        let mut keys: Vec<&str> = FIELDS.to_vec();
        if target == "jack" {
            keys.extend(["vm_instructions", "os_calls", "rom_words"]);
        }
        let object = whole.as_object().expect("an object");
        for key in &keys {
            assert!(object.contains_key(*key), "{target}: no {key}");
        }
        assert_eq!(object.len(), keys.len(), "{target}: {whole}");
        assert_eq!(whole["differs_from_model"], 0, "{target}");
        assert!(
            whole["differs_from_native"].as_u64() <= Some(2),
            "{target}: {whole}"
        );
        assert_eq!(
            (&whole["width"], &whole["pixels"]),
            (&12.into(), &96.into())
        );
        assert_eq!(whole["effects"], Value::from(vec!["glow"]));
        assert!(whole["cycles"].as_u64() > Some(96), "{target}");
        let drawn = std::fs::read(dir.join("spot.pgm")).expect("a picture");
        assert_eq!(drawn.len(), b"P5\n12 8\n1\n".len() + 96);

        let rows = run(&["--rows", "2..4"]);
        assert_eq!((&rows["height"], &rows["pixels"]), (&3.into(), &36.into()));
        assert_eq!(rows["differs_from_model"], 0, "{target}");
        assert!(
            rows["cycles"].as_u64() < whole["cycles"].as_u64(),
            "{target}"
        );

        let moved = run(&["--set", "at=2,6"]);
        assert_eq!(moved["differs_from_model"], 0, "{target}");
        assert_ne!(moved["inks_sha256"], whole["inks_sha256"], "{target}");
        let frozen = run(&["--set", "at=2,6", "--freeze", "at"]);
        assert_eq!(frozen["inks_sha256"], moved["inks_sha256"], "{target}");

        let without = run(&["--without", "glow"]);
        assert_eq!(without["differs_from_model"], 0, "{target}");
        assert_eq!(without["effects"], Value::from(Vec::<Value>::new()));

        let blind = run(&["--no-plot"]);
        assert_eq!(blind["differs_from_model"], Value::Null);
        assert!(
            blind["cycles"].as_u64() < whole["cycles"].as_u64(),
            "{target}"
        );
    }
}

#[test]
fn the_offset_is_where_the_picture_stands_on_the_screen() {
    let wide = "image 600 x 4 inks black, white; draw (x, y) = ink(x mod 2);";
    let dir = directory(&[("spot.scn", SPOT), ("wide.scn", wide)]);
    let dir = dir.path();
    let offset = |scene: &str, target: &str| {
        json(dir, &["run", scene, "--target", target, "--json"])["offset"].clone()
    };
    // In the middle of 512 x 256; on the 6502's screen, which is as large as the picture.
    assert_eq!(offset("spot.scn", "jack"), serde_json::json!([250, 124]));
    assert_eq!(offset("wide.scn", "jack"), serde_json::json!([-44, 126]));
    assert_eq!(offset("spot.scn", "6502:plain"), serde_json::json!([0, 0]));
}

/// The sources that `build` writes for a target, in a directory of their own.
pub fn built(dir: &Path, target: &str) -> Vec<String> {
    success(dir, &["build", "spot.scn", "--target", target, "-o", "out"]);
    names(&dir.join("out"))
}

/// Changes the files of `out` with `change`; answers how many it changed.
pub fn edit(dir: &Path, change: impl Fn(&str) -> Option<String>) -> usize {
    let mut changed = 0;
    for name in names(dir) {
        let path = dir.join(name);
        if let Ok(text) = std::fs::read_to_string(&path)
            && let Some(new) = change(&text)
        {
            std::fs::write(&path, new).expect("a file");
            changed += 1;
        }
    }
    changed
}

#[test]
fn build_writes_what_machines_load() {
    let dir = directory(&[("spot.scn", SPOT)]);
    let dir = dir.path();
    for target in targets(dir) {
        let files = built(dir, &target);
        let expected: &[&str] = match target.split(':').next() {
            Some("6502") if target == "6502:c64" => &["spot.asm", "spot.prg"],
            Some("6502") if target == "6502:bbc" => &["spot.asm", "spot.prg", "spot.ssd"],
            Some("6502") => &["spot.asm", "spot.prg"],
            Some("bbc") if target == "bbc:micro" => &["spot.bas", "spot.bbc", "spot.ssd"],
            Some("bbc") => &["spot.bas", "spot.bbc"],
            _ => &["Main.jack"],
        };
        for name in expected {
            assert!(files.iter().any(|f| f == name), "{target}: {files:?}");
        }
        let text = success(dir, &["build", "spot.scn", "-t", &target, "--emit", "text"]);
        assert!(text.len() > 500, "{target}");
        let plan = success(dir, &["build", "spot.scn", "-t", &target, "--emit", "plan"]);
        assert!(plan.contains("pixel:"), "{target}: {plan}");
        std::fs::remove_dir_all(dir.join("out")).expect("removed");
    }
    assert_eq!(names(dir), ["spot.scn"]);
}

#[test]
fn a_listing_names_the_items_that_its_lines_come_from() {
    let scene = include_str!("../../examples/mirrors.scn");
    let dir = directory(&[("spot.scn", scene)]);
    let build = |style: &str| {
        let args = [
            "build", "spot.scn", "-t", "bbc", "--style", style, "--emit", "text",
        ];
        success(dir.path(), &args)
    };
    let listing = build("listing");
    for item in ["REM draw", "REM effect tiles", "REM effect mirrors"] {
        assert!(listing.contains(item), "{item}\n{listing}");
    }
    assert!(!build("fast").contains("REM effect"));
}

#[test]
fn what_was_built_runs_by_itself() {
    let dir = directory(&[("spot.scn", SPOT)]);
    let dir = dir.path();
    for (machine, file) in [("6502", "out/spot.asm"), ("6502", "out/spot.prg")] {
        built(dir, machine);
        let alone = json(dir, &["vm", machine, file, "--json"]);
        let run = json(dir, &["run", "spot.scn", "-t", machine, "--json"]);
        assert_eq!(alone["cycles"], run["cycles"]);
        assert_eq!(alone["inks_sha256"], run["inks_sha256"]);
    }
}

#[test]
fn a_program_that_draws_otherwise_is_status_3() {
    let dir = directory(&[("spot.scn", SPOT)]);
    let dir = dir.path();
    built(dir, "6502");
    // Every pixel in ink 0.
    let other = |text: &str| {
        let draws = text.contains("sta ink_port");
        draws.then(|| text.replace("sta ink_port", "lda #0\n        sta ink_port"))
    };
    assert_eq!(edit(&dir.join("out"), other), 1);
    let args = ["run", "spot.scn", "-t", "6502", "--program", "out"];
    let output = slowlight(dir, &[&args[..], &["-o", "out.png", "--json"]].concat());
    assert_eq!(output.status.code(), Some(3));
    let said: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert!(said["differs_from_model"].as_u64() > Some(0));
    assert!(dir.join("out.png").exists());
}

#[test]
fn a_run_can_be_cut_short() {
    let dir = directory(&[("steps.scn", STEPS)]);
    for target in targets(dir.path()) {
        let args = [
            "run",
            "steps.scn",
            "-t",
            &target,
            "--limit",
            "100",
            "-o",
            "x.png",
        ];
        let output = slowlight(dir.path(), &args);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{target}: {said}");
        assert!(said.contains("--limit"), "{target}: {said}");
    }
    assert_eq!(names(dir.path()), ["steps.scn"]);
}

/// A dither of halves: the ink of the dark half needs no shade.
const HALVES: &str = "image 16 x 16 inks black, white;
draw (x, y) = {
  let v = (x + 0.5) / width;
  if y mod 8 == 7 then ink(0) else threshold(v * v, bayer(4)[x mod 4, y mod 4])
};
";

/// A dither whose first step, a product, is a step of comparing it as well, behind a
/// loop that may end in inks.
const SUNK: &str = "image 16 x 16 inks black, white;
param at: vec2 = (5.5, 3.5) in (0, 0) .. (11, 7);
draw (x, y) = {
  let p = ((x, y) - at) / 8;
  let s = loop (a = dot(p, p), k = 0) max 4 {
    if a < 1 then next(a * 1.9 + 0.02, k + 1) else a * p.x
  } else a * p.y;
  threshold(s * 0.3, 0.5)
};
";

#[test]
fn errors_are_of_shades_even_where_the_program_needs_none() {
    let dir = directory(&[("halves.scn", HALVES), ("sunk.scn", SUNK)]);
    for target in targets(dir.path()) {
        for scene in ["halves.scn", "sunk.scn"] {
            let run = json(dir.path(), &["run", scene, "-t", &target, "--json"]);
            assert_eq!(run["differs_from_model"], 0, "{scene} on {target}");
            // The inks alone would differ from the shades by a third.
            let rmse = run["rmse"].as_f64().expect("a number");
            assert!(rmse < 0.001, "{scene} on {target}: {rmse}");
        }
    }
}

#[test]
fn compare_puts_all_targets_in_one_table() {
    let dir = directory(&[("spot.scn", SPOT)]);
    let dir = dir.path();
    let table = success(dir, &["compare", "spot.scn", "-o", "all.png"]);
    for target in targets(dir) {
        let starts = |l: &&str| l.split_whitespace().take(2).eq(["spot", target.as_str()]);
        let row = table.lines().find(starts);
        assert_eq!(
            row.map(|r| r.split_whitespace().count() > 9),
            Some(true),
            "{table}"
        );
    }
    assert!(dir.join("all.png").exists());
    let one = json(dir, &["compare", "spot.scn", "-t", "6502", "--json"]);
    assert_eq!(one.as_array().map(Vec::len), Some(1));
    assert_eq!(one[0]["target"], "6502:plain");
}

#[test]
fn compare_goes_on_where_a_scene_is_wrong() {
    let wrong = "image 4 x 4 inks black, white; draw (x, y) = ink(flor(x));";
    let scenes = [("spot.scn", SPOT), ("odd.scn", wrong), ("wave.scn", SPOT)];
    let dir = directory(&scenes);
    let args = ["compare", "odd.scn", "spot.scn", "wave.scn", "-t", "6502"];
    let output = slowlight(dir.path(), &[&args[..], &["--rows", "1..2"]].concat());
    assert_eq!(output.status.code(), Some(1));
    let table = String::from_utf8_lossy(&output.stdout);
    let starts: Vec<&str> = table.lines().take(4).map(|l| &l[..4]).collect();
    assert_eq!(starts, ["scen", "odd ", "spot", "wave"], "{table}");
    assert!(table.contains("no function `flor`"), "{table}");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("odd.scn:1:"), "{said}");
    // A row that the picture does not have is wrong usage, and each scene's own.
    let args = ["compare", "spot.scn", "-t", "6502", "--rows", "9..10"];
    let output = slowlight(dir.path(), &args);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let args = ["compare", "spot.scn", "-t", "6502", "--markdown"];
    let lines = success(dir.path(), &args);
    assert!(
        lines.lines().take(3).all(|l| l.matches('|').count() == 14),
        "{lines}"
    );
}

#[test]
fn what_a_scene_does_not_call_costs_nothing() {
    let library = Path::new(env!("CARGO_MANIFEST_DIR")).join("compiler/prelude");
    let dir = directory(&[("spot.scn", SPOT)]);
    let dir = dir.path();
    let changed = dir.join("prelude");
    std::fs::create_dir(&changed).expect("a directory");
    for name in names(&library) {
        std::fs::copy(library.join(&name), changed.join(&name)).expect("copied");
    }
    let more = "effect haze(v: real, p: vec3) -> real else v = v * exp(-length(p));\n";
    std::fs::write(changed.join("zz_more.scn"), more).expect("a file");
    for target in targets(dir) {
        let emit = ["build", "spot.scn", "-t", &target, "--emit", "text"];
        let with = success(dir, &[&emit[..], &["--prelude", "prelude"]].concat());
        assert!(with == success(dir, &emit), "{target}");
    }
    // The directory was really read.
    let caller = SPOT
        .replace("glow(halved", "haze(halved")
        .replace(", 1)), x, y)", ", 1), (0, 0, 0)), x, y)");
    std::fs::write(dir.join("hazy.scn"), caller).expect("a file");
    success(dir, &["check", "hazy.scn", "--prelude", "prelude"]);
    assert_eq!(
        slowlight(dir, &["check", "hazy.scn"]).status.code(),
        Some(1)
    );
}

/// A sign of what may be 0 at the end of its range.
#[test]
fn signs_of_what_ends_at_zero() {
    for sign in ["sign(x - 15)", "sign(-x * y)", "-sign(x)"] {
        let scene = format!("image 16 x 2 inks black, red, white; draw (x, y) = ink(1 + {sign});");
        let dir = directory(&[("s.scn", &scene)]);
        for target in ["bbc:micro", "6502:plain", "jack"] {
            let args = ["run", "s.scn", "-t", target, "--json"];
            let said = json(dir.path(), &args);
            assert_eq!(said["differs_from_native"], 0, "{target} {sign}");
        }
    }
}
