//! `effects`: what it says of a called effect is what leaving it out changes; what
//! is not called costs nothing.

use crate::cli::{directory, json, slowlight, success};
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
            let without = run(&["--without", name]);
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
    let of = |row: &Value, key: &str| row["pixel_cycles_modelled"][key].as_u64().expect("cycles");
    assert!(of(halo, "p99") >= of(halo, "median"));
    assert!(of(rim, "p99") > 0);
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
