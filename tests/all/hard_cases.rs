//! Hard cases: every vector natively, in every format's model, on every kind of
//! machine; and what the textbook's forms make of the same vectors.

use crate::cli::{directory, json, slowlight, success};
use slowlight::cases::{self, Row, Way, ways};
use slowlight_compiler::targets::jack::{JACK, JACK_F316R, JACK_F416};
use slowlight_compiler::targets::mos6502::PLAIN_REAL40;
use slowlight_compiler::targets::{TARGETS, Target};
use slowlight_routine::{Error, Op};
use std::collections::BTreeSet;

const FILES: [&str; 2] = ["tests/hard_cases.json", "tests/orientation_cases.json"];

/// What an arithmetic with the low product dropped cannot pass, whatever the formula
/// (a fact of the original Float316).
const ORIGINAL: &str = "mul_dropped_low/worst_pair";

fn rows(ways: &[Way], naive: bool) -> Vec<Row> {
    let tried = FILES.into_iter().flat_map(|path| {
        let path = format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).expect("the file is there");
        let file = cases::parse(&path, &text).expect("it is a file of cases");
        cases::run(&file, ways, naive).expect("it runs").rows
    });
    tried.collect()
}

#[test]
fn every_vector_passes_everywhere() {
    let targets = [TARGETS, &[&JACK_F316R, &JACK_F416]].concat();
    // Of a format's name there is one runtime among them.
    let more = [Way::Model(&PLAIN_REAL40), Way::Machine(&PLAIN_REAL40)];
    let ways = [ways(&targets, true), more.to_vec()].concat();
    let rows = rows(&ways, false);
    let places: BTreeSet<&str> = rows.iter().map(|r| r.way.place()).collect();
    assert_eq!(
        places.into_iter().collect::<Vec<_>>(),
        ["6502:plain", "bbc:micro", "jack", "model", "native"]
    );
    assert!(rows.len() > 1200, "{}", rows.len());
    for row in rows.iter().filter(|r| !r.verdict.passed) {
        let known = row.way.format() == "f316" && row.id == ORIGINAL;
        assert!(known, "{} {}: {row:?}", row.way.format(), row.way.place());
    }
    // And the original's fault is shown.
    let shown = rows
        .iter()
        .filter(|r| r.way.format() == "f316" && r.id == ORIGINAL && !r.verdict.passed);
    assert_eq!(shown.count(), 2);
}

/// What f316's product loses there is within what its runtime states, which `check`'s bounds
/// are made of, and that is more than the vector allows; what f316r states is not.
#[test]
fn the_originals_product_is_owned_up_to() {
    let stated = |target: &Target| {
        let mut products = target.runtime.routines.iter().filter(|r| r.op == Op::Mul);
        match products.find(|r| r.name == "mul").map(|r| r.error) {
            Some(Error::Relative(part)) => part,
            other => panic!("{other:?}"),
        }
    };
    let rows = rows(&[Way::Model(&JACK)], false);
    let row = rows.iter().find(|r| r.id == ORIGINAL).expect("it");
    let (Some(bound), worst) = (row.verdict.bound, row.verdict.worst) else {
        panic!("{row:?}");
    };
    let wanted = 1.015_502_929_687_5 * 1.031_127_929_687_5;
    assert!(worst > 1.0 && worst * bound <= stated(&JACK) * wanted);
    assert!(stated(&JACK) * wanted > bound && stated(&JACK_F316R) * wanted < bound);
}

#[test]
fn the_stable_forms_are_what_passes() {
    let native = rows(&[Way::Native], true);
    let failed = native.iter().filter(|r| !r.verdict.passed).count();
    assert!(
        (50..native.len()).contains(&failed),
        "{failed} of {}",
        native.len()
    );
    let models: Vec<Way> = ways(TARGETS, true)
        .into_iter()
        .filter(|w| !matches!(w, Way::Machine(_)))
        .collect();
    // Our own search found points that the naive determinant puts on the wrong
    // side, in every format.
    let all = rows(&models, true);
    for way in models {
        let wrong = all.iter().filter(|r| {
            r.way.format() == way.format()
                && r.id.starts_with("orientation/naive")
                && !r.verdict.passed
        });
        assert!(wrong.count() > 0, "{}", way.format());
    }
}

#[test]
fn check_tries_a_file_of_cases() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/hard_cases.json");
    let dir = directory(&[
        ("odd.json", "{\"families\": {}, \"vectors\": [{\"id\": 1}]}"),
        (
            "lost.json",
            r#"{"families": {}, "vectors": [{"id": "a/b", "entry": "c",
            "inputs": {}, "expected": {}, "predicate": {"kind": "present", "value": true}}]}"#,
        ),
    ]);
    let found = json(
        dir.path(),
        &["check", "--cases", path, "--target", "native", "--json"],
    );
    assert_eq!(
        (&found["count"], &found["passed"]),
        (&176.into(), &176.into())
    );
    let first = &found["cases"][0];
    assert_eq!(first["id"], "quadratic_cancellation/k3");
    assert_eq!(
        (&first["format"], &first["target"]),
        (&"f64".into(), &"native".into())
    );
    assert!(
        first["got"]["root_small"]
            .as_f64()
            .is_some_and(|r| (0.03..0.04).contains(&r))
    );
    let text = success(dir.path(), &["check", "--cases", path, "--target", "bbc"]);
    assert!(text.contains("| real40 bbc:micro"), "{text}");
    for (args, status) in [
        (&["check", "--cases", "odd.json"][..], 1),
        (&["check", "--cases", "lost.json"], 1),
        (&["check", "--cases", "none.json"], 1),
        (
            &[
                "check", "--cases", path, "--format", "f316", "--target", "model",
            ],
            1,
        ),
        (&["check", "--cases", path, "--target", "zx"], 2),
        (&["check", "--cases", path, "scene.scn"], 2),
        (&["check"], 2),
    ] {
        assert_eq!(
            slowlight(dir.path(), args).status.code(),
            Some(status),
            "{args:?}"
        );
    }
}

/// A decimal as a scene writes it, with digits on both sides of the point.
fn written(number: f64) -> String {
    let text = format!("{number:.20}");
    let short = text.trim_end_matches('0');
    match short.ends_with('.') {
        true => format!("{short}0"),
        false => short.to_owned(),
    }
}

/// A scene of one operation on two params, which is seen wherever it does not wrap.
fn operation(a: f64, op: &str, b: f64, wanted: f64) -> String {
    let param = |name: &str, value: f64| {
        let (lo, hi) = (value.min(value / 2.0), value.max(value / 2.0));
        let [value, lo, hi] = [value, lo, hi].map(written);
        format!("param {name}: real = {value} in {lo} .. {hi};\n")
    };
    format!(
        "image 8 x 8 inks black, white;
         {}{}draw (x, y) = {{
           let v = a {op} b;
           threshold(v / {}, 0.9)
         }};",
        param("a", a),
        param("b", b),
        written(wanted * 1.5),
    )
}

/// The family `fixed_range`, and more that 16.16 is too small for: both operands, and
/// what is wanted.
fn planted() -> Vec<(f64, &'static str, f64, f64)> {
    let text = include_str!("../hard_cases.json");
    let file: serde_json::Value = serde_json::from_str(text).expect("JSON");
    let decimal = |value: &serde_json::Value| -> f64 {
        let text = value.as_str().expect("a decimal");
        text.parse().expect("a number")
    };
    let vectors = file["vectors"].as_array().expect("vectors");
    let family = vectors.iter().filter(|v| {
        v["id"]
            .as_str()
            .is_some_and(|id| id.starts_with("fixed_range/"))
    });
    let mut all: Vec<_> = family
        .map(|vector| {
            let input = |name: &str| decimal(&vector["inputs"][name]["dec"]);
            let entry = vector["entry"].as_str().expect("an entry");
            let op = if entry == "mul" { "*" } else { "/" };
            let wanted = decimal(&vector["expected"][entry]);
            (input("a"), op, input("b"), wanted)
        })
        .collect();
    assert_eq!(all.len(), 7);
    all.extend([(300.0, "*", -200.0, -6e4), (-9.0, "/", 0.0001, -9e4)]);
    all
}

/// What fixed point is too small for ends where its numbers do and does not wrap, and
/// `check` says which value that is.
#[test]
fn planted_overflows_saturate_and_are_named() {
    let mut named = 0;
    for (a, op, b, wanted) in planted() {
        let scene = operation(a, op, b, wanted);
        let dir = directory(&[("planted.scn", &scene)]);
        for format in [
            "fixed16.16",
            "fixed12",
            "fixed16",
            "fixed20",
            "fixed24",
            "real40",
        ] {
            let run = [
                "run",
                "planted.scn",
                "-t",
                "6502",
                "--format",
                format,
                "--json",
            ];
            let said = json(dir.path(), &run);
            assert_eq!(said["differs_from_model"], 0, "{scene} {format}");
            assert_eq!(said["differs_from_native"], 0, "{scene} {format}");
        }
        let check = slowlight(dir.path(), &["check", "planted.scn", "--target", "6502"]);
        let said = String::from_utf8_lossy(&check.stderr);
        let leaves = said.contains("in fixed16.16 the value leaves the range");
        // 32,768 is a last place from the end, as a rounded result may be anyway.
        assert_eq!(leaves, wanted.abs() > 32768.0, "{scene}\n{said}");
        if leaves {
            named += 1;
            assert!(said.contains(&format!("let v = a {op} b;")), "{said}");
        }
    }
    assert_eq!(named, 3);
}
