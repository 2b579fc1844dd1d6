//! `effects`: what it says of a called effect is what leaving it out changes; what
//! is not called costs nothing.

use crate::cli::{directory, json, slowlight, success, usual_format};
use crate::cli_run::{SPOT, targets};
use serde_json::Value;
use std::path::Path;

/// Two effects, one needed by some pixels only, with a loop that mostly ends early; and
/// one that nobody calls.
const LIT: &str = "image 16 x 8 inks black, white;
effect halo(v: real, x: int) -> real else v =
  loop (w = v, k = 0) max 9 { if k * 2 >= x then w else next(w + 0.05, k + 1) } else w;
effect rim(v: real) -> real else 0 = v * v * 0.9;
effect never(v: real) -> real else v = sqrt(v);
draw (x, y) = threshold(if y < 4 then halo(x / 20, x) else rim((x + y) / 24), bayer(4)[x mod 4, y mod 4]);
";

fn effects(dir: &Path, scene: &str, target: &str) -> Value {
    json(dir, &["effects", scene, "--target", target, "--json"])
}

fn row<'v>(found: &'v Value, name: &str) -> &'v Value {
    let rows = found["effects"].as_array().expect("a list");
    let row = rows.iter().find(|row| row["name"] == name);
    row.unwrap_or_else(|| panic!("{name} is in no row"))
}

#[test]
fn a_row_is_what_leaving_the_effect_out_changes() {
    let dir = directory(&[("lit.scn", LIT)]);
    let dir = dir.path();
    for target in targets(dir) {
        let run = |more: &[&str]| {
            let args = [&["run", "lit.scn", "--target", &target, "--json"], more].concat();
            json(dir, &args)
        };
        let found = effects(dir, "lit.scn", &target);
        let whole = run(&[]);
        assert_eq!(found["run"]["cycles"], whole["cycles"], "{target}");
        for name in ["halo", "rim"] {
            let row = row(&found, name);
            // In the whole scene's format: for itself it might take another.
            let format = whole["format"].as_str().expect("a format");
            let without = run(&["--without", name, "--format", format]);
            let less = |key: &str| {
                let of = |run: &Value| run[key].as_i64();
                Some(of(&whole)? - of(&without)?)
            };
            let pairs = [
                ("cycles", "cycles"),
                ("code_bytes", "code_bytes"),
                ("table_bytes", "table_bytes"),
                ("variable_bytes", "ram_bytes"),
            ];
            for (told, key) in pairs {
                assert_eq!(row[told].as_i64(), less(key), "{name} on {target}: {told}");
            }
            assert_ne!(row["cycles"], 0, "{name} on {target}");
            assert!(
                row["loss"]["rmse"].as_f64() > Some(0.0),
                "{name} on {target}"
            );
            assert!(
                row["loss"]["pixels"].as_u64() > Some(0),
                "{name} on {target}"
            );
            assert_ne!(
                whole["inks_sha256"], without["inks_sha256"],
                "{name} on {target}"
            );
            assert_eq!(row["calls"], 1, "{name} on {target}");
        }
    }
}

#[test]
fn what_is_not_needed_at_a_pixel_is_seen() {
    let dir = directory(&[("lit.scn", LIT)]);
    let args = [
        "effects",
        "lit.scn",
        "--target",
        "6502:plain",
        "--as-written",
        "--json",
    ];
    let found = json(dir.path(), &args);
    let (halo, rim) = (row(&found, "halo"), row(&found, "rim"));
    // Each is needed in half of the rows.
    assert_eq!(rim["ran"], 0.5);
    let ran = halo["ran"].as_f64().expect("a share");
    assert!((0.4..=0.5).contains(&ran), "{ran}");
    assert_eq!(halo["turns"]["limit"], 9);
    let mean = halo["turns"]["mean"].as_f64().expect("a mean");
    assert!((2.0..9.0).contains(&mean), "{mean}");
    for row in [halo, rim] {
        let own = row["own"]["cycles"].as_u64().expect("cycles");
        assert!((1..found["run"]["cycles"].as_u64().expect("cycles")).contains(&own));
    }
    // Turns are the scene's, whatever the compiler makes of the loop.
    let args = ["effects", "lit.scn", "-t", "6502:plain", "--json"];
    let compiled = json(dir.path(), &args);
    assert_eq!(row(&compiled, "halo")["turns"], halo["turns"]);
    for counted in ["pixel_cycles", "pixel_cycles_modelled"] {
        let of = |row: &Value, key: &str| row[counted][key].as_u64().expect("cycles");
        assert!(of(halo, "p99") >= of(halo, "median"));
        assert!(of(rim, "p99") > 0);
    }
}

/// What the machine counts pixel by pixel is what it counts line by line, and at as many
/// pixels as need the effect.
#[test]
fn a_pixels_cycles_are_the_machines() {
    let dir = directory(&[("lit.scn", LIT)]);
    let both = &["halo", "rim"][..];
    // In BASIC the rim is written where it is read.
    let cases = [
        ("6502:plain", both),
        ("6502:bbc", both),
        ("jack", both),
        ("bbc:micro", &both[..1]),
        ("bbc:agon", &both[..1]),
    ];
    for (target, names) in cases {
        let format = usual_format(target);
        let args = ["effects", "lit.scn", "-t", target, "--format", format];
        let found = json(
            dir.path(),
            &[&args[..], &["--as-written", "--json"]].concat(),
        );
        for name in names {
            let row = row(&found, name);
            let counted = &row["pixel_cycles"];
            let number = |value: &Value| value.as_u64().expect("a number");
            let (at, total) = (number(&counted["at"]), number(&counted["total"]));
            let own = number(&row["own"]["cycles"]);
            // A share of interrupts is added to each, which is rounded.
            assert!(
                total.abs_diff(own) <= at,
                "{name} on {target}: {counted}, {own}"
            );
            // Four rows of sixteen pixels.
            assert_eq!(at, 64, "{name} on {target}: {counted}");
            assert!(number(&counted["p99"]) >= total / 128, "{name} on {target}");
        }
    }
}

/// A shadow, which is dear, under a dither of few levels.
const SHADED: &str = "image 32 x 24 inks black, white;
effect shadow(h: hit) -> bool else false =
  if let s = sphere((0.6, 1.4, 0.4), 0.5).hit(ray(h.point + 0.02 * h.normal, (0.48, 0.8, 0.36))) then s.t < 9 else false;
draw (x, y) = {
  let r = ray((0, 0, 4), unit(((x - 15.5) / 16, (11.5 - y) / 16, -1)));
  let v = if let h = sphere((0, 0, 0), 1.6).hit(r)
          then max(dot(h.normal, (0.48, 0.8, 0.36)), 0.1) * (if shadow(h) then 0.4 else 1) else 0.3;
  threshold(v, bayer(4)[x mod 4, y mod 4])
};
";

/// Where the ink is known before the whole shade, the rest is not computed, and no pixel
/// changes.
#[test]
fn what_the_ink_does_not_need_is_not_computed() {
    let dir = directory(&[("shaded.scn", SHADED)]);
    for target in ["6502:plain", "jack", "bbc:micro"] {
        let format = usual_format(target);
        let of = ["shaded.scn", "-t", target, "--format", format, "--json"];
        let args = [&["effects"], &of[..]].concat();
        let known = &json(dir.path(), &args)["known_before_shade"];
        assert_eq!(known["inks_changed"], 0, "{target}");
        let saved = known["cycles_saved"].as_i64().expect("cycles");
        assert!(saved > 0, "{target}: {saved}");
        // What is said is what running both says.
        let run = |more: &[&str]| {
            let run = json(dir.path(), &[&["run"], &of[..], more].concat());
            assert_eq!(run["differs_from_model"], 0);
            run["cycles"].as_i64().expect("cycles")
        };
        assert_eq!(run(&["--every-shade"]) - run(&[]), saved, "{target}");
    }
}

/// Each effect of the library that a scene does not call leaves its program as it is,
/// byte for byte, on every target; and so does one of the scene's own.
#[test]
fn absent_effects_cost_nothing() {
    let dir = directory(&[("lit.scn", LIT), ("spot.scn", SPOT)]);
    let dir = dir.path();
    let library = include_str!("../../compiler/prelude/lights.scn");
    let cameras = include_str!("../../compiler/prelude/cameras.scn");
    let names = [library, cameras].into_iter().flat_map(str::lines);
    let names = names.filter_map(|line| line.strip_prefix("effect ")?.split('(').next());
    let names: Vec<&str> = names.chain(["never"]).collect();
    assert!(names.len() >= 6, "{names:?}");
    for target in targets(dir) {
        let found = effects(dir, "lit.scn", &target);
        for name in &names {
            let row = row(&found, name);
            for key in [
                "calls",
                "code_bytes",
                "table_bytes",
                "variable_bytes",
                "cycles",
            ] {
                assert_eq!(row[key], 0, "{name} on {target}: {key}");
            }
            let digests = &row["digests"];
            assert_eq!(digests["with"].as_str().map(str::len), Some(64), "{name}");
            assert_eq!(digests["with"], digests["without"], "{name} on {target}");
            assert_eq!(digests["equal"], true, "{name} on {target}");
        }
    }
}

#[test]
fn the_table_reads() {
    let dir = directory(&[("lit.scn", LIT)]);
    let said = success(
        dir.path(),
        &["effects", "lit.scn", "--target", "6502:plain"],
    );
    for word in [
        "halo",
        "rim",
        "never costs nothing: ",
        "fog (library)",
        "ran",
    ] {
        assert!(said.contains(word), "{word}\n{said}");
    }
    let out = slowlight(
        dir.path(),
        &[
            "effects",
            "lit.scn",
            "--target",
            "jack",
            "--without",
            "hallo",
        ],
    );
    assert_eq!(out.status.code(), Some(2));
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(said.contains("halo"), "{said}");
}

#[test]
fn a_picture_has_the_table_and_a_bar_for_what_costs_time() {
    let dir = directory(&[("lit.scn", LIT)]);
    let args = ["effects", "lit.scn", "-t", "6502"];
    let text = success(dir.path(), &[&args[..], &["--svg", "lit.svg"]].concat());
    let found = effects(dir.path(), "lit.scn", "6502");
    let rows = found["effects"].as_array().expect("a list").iter();
    let dear = rows.filter(|row| row["cycles"].as_i64() > Some(0)).count();
    let picture = std::fs::read_to_string(dir.path().join("lit.svg")).expect("a picture");
    let tree = roxmltree::Document::parse(&picture).expect("it parses");
    let bar = |n: &roxmltree::Node<'_, '_>| n.attribute("class") == Some("bar");
    assert_eq!(tree.descendants().filter(bar).count(), dear);
    let lines = text.lines().filter(|line| !line.is_empty());
    for line in lines.filter(|line| !line.contains("costs nothing")) {
        let said = |n: roxmltree::Node<'_, '_>| n.text() == Some(line);
        assert!(tree.descendants().any(said), "{line}");
    }
}
