//! The format that is taken where none is asked for: the quickest within the error goal, as
//! whole pictures on the machines have it.

use crate::cli::{LONG, directory, json, slowlight, success, usual_format};
use serde_json::Value;
use slowlight_compiler::targets::{TARGETS, formats};
use std::path::Path;

/// A ball over a floor: few pixels are wrong in most formats.
const BALL: &str = "image 64 x 48 inks black, #808080, white;
    param size: real = 1.0 in 0.5 .. 1.5;
    const sun = (-0.48, 0.8, 0.36);
    scene s { sphere((0, 0, 0), size) is 0.9; plane((0, 1, 0), -1) is 0.6; }
    draw (x, y) = {
      let r = pinhole((0, 1.2, 4.6), at: (0, -0.15, 0), field: 46deg).through(x, y);
      let v = if let h = s.trace(r, far: 20) then h.tag * (0.2 + 0.8 * lambert(h, sun)) else 0.1;
      threshold(v, bayer(4)[x mod 4, y mod 4])
    };";

/// Steps of an orbit that doubles errors: formats of few bits lose it.
const ORBIT: &str = "image 64 x 48 inks black, white;
    draw (x, y) = {
      let c = x / 64;
      let v = loop (z = 0.1 + y / 60, k = 0) max 8 {
        if k >= 7 then z else next((3.4 + 0.5 * c) * z * (1 - z), k + 1)
      } else 0.0;
      threshold(v, 0.5)
    };";

/// Sines of the place alone.
const WAVES: &str = "image 64 x 48 inks black, white;
    draw (x, y) = threshold(0.5 + 0.25 * sin(x * 1rad / 7) + 0.25 * sin((y / 5 + x / 11) * 1rad), 0.5);";

/// A surface of degree 6: its normals lose bits.
const HEART: &str = "image 160 x 128 inks black, red, white;
    shape heart() {
      f(p) = { let a = p.x*p.x + 2.25*p.y*p.y + p.z*p.z - 1; a*a*a - p.x*p.x*p.z*p.z*p.z - 0.1125*p.y*p.y*p.z*p.z*p.z };
      bound = sphere((0,0,0), 1.6);
    }
    scene s { heart() is 1; }
    draw (x, y) = {
      let r = ray((0, -4, 0.2), unit(((x - 79.5) / 80, 1.5, (63.5 - y) / 80)));
      let v = if let h = s.trace(r, far: 20) then 0.1 + 0.9 * lambert(h, (0.48, -0.8, 0.36)) else 0;
      threshold(v, bayer(4)[x mod 4, y mod 4])
    };";

const SCENES: [(&str, &str); 3] = [
    ("ball.scn", BALL),
    ("orbit.scn", ORBIT),
    ("waves.scn", WAVES),
];

fn ran(dir: &Path, scene: &str, target: &str, more: &[&str]) -> Value {
    let args = ["run", scene, "--target", target, "--json"];
    json(dir, &[&args[..], more].concat())
}

/// The same in a format; nothing where a BBC Micro has no room for its tables.
fn ran_if_it_fits(dir: &Path, scene: &str, target: &str, format: &str) -> Option<Value> {
    let args = ["run", scene, "--target", target, "--format", format];
    let output = slowlight(dir, &[&args[..], &["--json"]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    if target == "6502:bbc" && said.contains("does not fit") {
        assert!(format.starts_with("log"), "{said}");
        return None;
    }
    assert_eq!(output.status.code(), Some(0), "{said}");
    serde_json::from_slice(&output.stdout).ok()
}

fn cycles(run: &Value) -> u64 {
    run["cycles"].as_u64().expect("cycles")
}

/// The share of pixels that are not as natively.
fn wrong(run: &Value) -> f64 {
    let number = |key: &str| run[key].as_f64().expect("a number");
    number("differs_from_native") / number("pixels")
}

#[test]
fn no_format_within_the_goal_is_much_quicker_than_the_one_taken() {
    let dir = directory(&SCENES);
    let mut taken = Vec::new();
    for target in TARGETS.iter().filter(|t| formats(t).count() > 1) {
        // Boards of the same processor are alike.
        let some = if target.name == "6502:bbc" || target.name == "6502:c64" {
            1
        } else {
            3
        };
        for (scene, _) in &SCENES[..some] {
            let own = ran(dir.path(), scene, target.name, &[]);
            let name = own["format"].as_str().expect("a format").to_owned();
            let said = format!("{scene} {}: {name}", target.name);
            let all: Vec<(String, Value)> = formats(target)
                // A width for each value is not looked for unasked.
                .filter(|t| t.runtime.narrow.is_none())
                .map(|t| t.runtime.format.to_owned())
                .filter_map(|f| {
                    let run = ran_if_it_fits(dir.path(), scene, target.name, &f)?;
                    Some((f, run))
                })
                .collect();
            let within = |goal: f64| all.iter().filter(move |(_, run)| wrong(run) <= goal);
            // By a sample: a little more may be wrong, and what is near the goal may be left.
            match within(0.01).next() {
                Some(_) => assert!(wrong(&own) <= 0.015, "{said} {}", wrong(&own)),
                None => assert!(all.iter().all(|(_, run)| wrong(run) >= 0.8 * wrong(&own))),
            }
            for (other, run) in within(0.005) {
                let (own, run) = (cycles(&own), cycles(run));
                assert!(own <= run + run / 5, "{said} {own}, {other} {run}");
            }
            taken.push(name);
        }
    }
    taken.sort();
    taken.dedup();
    assert!(taken.len() > 1, "{taken:?}");
}

#[test]
fn the_error_that_is_allowed_decides() {
    let dir = directory(&SCENES);
    let run = |more: &[&str]| ran(dir.path(), "orbit.scn", "6502:plain", more);
    let (exact, usual, any) = (run(&["--error", "0"]), run(&[]), run(&["--error", "100%"]));
    assert!(wrong(&exact) <= wrong(&usual) && wrong(&usual) <= wrong(&any));
    assert!(cycles(&any) < cycles(&exact), "{any} {exact}");
    assert_ne!(any["format"], exact["format"]);
    assert_eq!(run(&["--goal", "balanced"]), usual);
}

#[test]
fn functions_are_looked_up_where_a_machine_has_one_format_and_the_picture_takes_it() {
    let dir = directory(&SCENES);
    let run = |more: &[&str]| {
        let run = ran(dir.path(), "waves.scn", "bbc:micro", more);
        assert_eq!(run["differs_from_model"], 0, "{more:?}");
        run
    };
    let none = run(&["--tables", "no"]);
    assert_eq!(
        run(&["--format", "real40"]),
        none,
        "a format that is asked for is exact"
    );
    assert!(wrong(&run(&["--error", "0"])) == 0.0);
    let [usual, any] = [run(&[]), run(&["--tables", "yes"])];
    assert!(
        wrong(&none) <= wrong(&usual) && wrong(&usual) <= 0.015,
        "{usual}"
    );
    assert!(cycles(&any) <= cycles(&usual), "{any} {usual}");
    assert!(3 * cycles(&usual) < 2 * cycles(&none), "{usual} {none}");
    let args = ["run", "waves.scn", "--target", "bbc:micro"];
    let said = |more: &[&str]| {
        let output = slowlight(dir.path(), &[&args[..], more].concat());
        String::from_utf8_lossy(&output.stderr).contains("looked up in tables")
    };
    assert!(said(&[]) && !said(&["--tables", "no"]));
}

#[test]
fn where_no_format_is_within_the_goal_the_nearest_is_taken_and_that_is_said() {
    // An orbit that doubles what is between two of its points faster than any format has digits.
    let scene = "image 32 x 24 inks black, white;
        draw (x, y) = threshold(loop (k = 0, a = 0.2 + x / 100 + y / 1000) max 160 {
          if k == 150 then a else next(k + 1, 3.9 * a * (1 - a))
        } else a, 0.5);";
    let dir = directory(&[("orbit.scn", scene)]);
    let args = ["build", "orbit.scn", "-t", "jack", "-o", "out"];
    let output = slowlight(dir.path(), &[&args[..], &["--error", "0.2%"]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("none that was tried is nearer"), "{said}");
}

/// Where quicker formats keep the goal, the exact one is not even looked at.
#[test]
fn what_no_other_format_keeps_is_drawn_in_floats() {
    let dir = directory(&[("heart.scn", HEART)]);
    let format = |error: &str| {
        let args = ["build", "heart.scn", "-t", "6502:plain", "-o", "out"];
        json(
            dir.path(),
            &[&args[..], &["--json", "--error", error]].concat(),
        )["format"]
            .clone()
    };
    assert_eq!(format("0.3%"), "real40");
    assert_ne!(format("2%"), "real40");
}

/// An orbit whose fine parts count, and so many formulas that without a search only the shortest
/// format is not too large for the machine.
#[test]
fn what_is_too_large_at_first_sight_is_looked_at_where_nothing_else_is_within_the_goal() {
    let sum: Vec<String> = (0..22)
        .map(|k| {
            format!(
                "+ sqrt(c * {k}.3 + v) / (1 + {k} * v * v + {}.7 * c * v)",
                k + 1
            )
        })
        .collect();
    let fine = format!(
        "threshold((v * 40) mod 1 + 0.0001 * (0.0 {}), 0.5)",
        sum.join(" ")
    );
    let orbit = ORBIT.replace("k >= 7", "k >= 9").replace("max 8", "max 14");
    let scene = orbit.replace("threshold(v, 0.5)", &fine);
    let dir = directory(&[("fine.scn", &scene)]);
    let args = ["build", "fine.scn", "-t", "6502:bbc", "-o", "out", "--json"];
    assert_eq!(json(dir.path(), &args)["format"], "fixed24");
}

/// Where no other of Jack's formats keeps the goal, that with twice as many bits does.
#[test]
fn the_widest_format_is_the_last_resort() {
    let long = ORBIT
        .replace("k >= 7", "k >= 11")
        .replace("max 8", "max 12");
    let dir = directory(&[("long.scn", &long), ("waves.scn", WAVES)]);
    let exact = ran(dir.path(), "long.scn", "jack", &["--goal", "exact"]);
    assert_eq!(exact["format"], "f416");
    assert_eq!(exact["differs_from_model"], 0);
    assert!(wrong(&exact) <= 0.001, "{exact}");
    let rounded = ran(dir.path(), "long.scn", "jack", &["--format", "f316r"]);
    assert!(wrong(&rounded) > 0.001, "{rounded}");
    assert!(cycles(&rounded) < cycles(&exact));
    let waves = ran(dir.path(), "waves.scn", "jack", &["--goal", "exact"]);
    assert_ne!(waves["format"], "f416");
}

#[test]
fn some_rows_are_in_the_format_of_the_whole() {
    let dir = directory(&SCENES);
    let format = |rows: &[&str]| ran(dir.path(), "ball.scn", "jack", rows)["format"].clone();
    let whole = format(&[]);
    for rows in ["0", "20..23", "47"] {
        assert_eq!(format(&["--rows", rows]), whole, "{rows}");
    }
}

#[test]
fn a_format_that_is_asked_for_is_taken() {
    let dir = directory(&SCENES);
    let said = |more: &[&str]| {
        let args = ["run", "waves.scn", "--target", "jack"];
        let output = slowlight(dir.path(), &[&args[..], more].concat());
        assert_eq!(output.status.code(), Some(0));
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    assert!(said(&[]).contains("note: format "), "{}", said(&[]));
    assert!(!said(&["--format", "f316"]).contains("note: format"));
    // What the original's floats lose is told.
    assert!(said(&["--format", "f316"]).contains("7.6 times as far off as f316r,"));
    assert_eq!(said(&["--format", "f316r"]), "");
    let both = [
        "run",
        "waves.scn",
        "-t",
        "jack",
        "--format",
        "f316",
        "--error",
        "1%",
    ];
    assert_eq!(slowlight(dir.path(), &both).status.code(), Some(2));
}

/// A program that was built in another format than is taken unasked is run as what it is.
#[test]
fn an_edited_program_keeps_its_format() {
    let dir = directory(&SCENES);
    for (target, format) in [("jack", "f316"), ("6502:plain", "fixed16.16")] {
        let args = [
            "build", "ball.scn", "-t", target, "--format", format, "-o", target,
        ];
        success(dir.path(), &args);
        let name = if target == "jack" {
            "Ball.jack"
        } else {
            "ball.asm"
        };
        let path = dir.path().join(target).join(name);
        let text = std::fs::read_to_string(&path).expect("a source");
        let line = text.lines().find(|l| l.contains("size = ")).expect("size");
        let edited = line.replacen("= 1", "= 12", 1).replacen("000", "00", 1);
        assert_ne!(line, edited);
        std::fs::write(&path, text.replacen(line, &edited, 1)).expect("a source");
        assert_ne!(ran(dir.path(), "ball.scn", target, &[])["format"], format);
        let edited = ran(dir.path(), "ball.scn", target, &["--program", target]);
        assert_eq!(edited["format"], format);
        let set = ["--format", format, "--set", "size=1.2"];
        let set = ran(dir.path(), "ball.scn", target, &set);
        assert_eq!(edited["inks_sha256"], set["inks_sha256"], "{target}");
    }
}

/// Without a search a torus is too large for a mode of a BBC Micro in any format.
#[test]
fn what_another_mode_has_room_for_is_looked_at() {
    let dir = directory(&[("torus.scn", include_str!("../../examples/torus.scn"))]);
    let run = |more: &[&str]| {
        let rows = ["--rows", "120..123"];
        let all = [&rows[..], more].concat();
        ran(dir.path(), "torus.scn", "6502:bbc", &all)
    };
    let (usual, exact) = (run(&[]), run(&["--format", "real40"]));
    assert_eq!(usual["format"], "fixed16");
    assert!(wrong(&usual) <= 0.01, "{usual}");
    // Five bytes a number fit where less of the picture is seen.
    assert_ne!(usual["mode"], exact["mode"]);
    let [usual, exact] = [&usual, &exact].map(|run| run["cycles_per_pixel"].as_f64());
    assert!(usual.map(|own| 3.0 * own) < exact, "{usual:?} {exact:?}");
}

/// Of pixels that take longer than anybody looks nothing is claimed; and the looking ends.
#[test]
fn what_nobody_looked_at_is_not_said_to_be_right() {
    let dir = directory(&[("long.scn", LONG)]);
    for target in ["jack", "6502:plain"] {
        let args = ["build", "long.scn", "-t", target, "-o", "out", "--json"];
        let output = slowlight(dir.path(), &args);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert!(!said.contains("pixels are wrong"), "{said}");
        let built: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(built["format"], usual_format(target));
    }
}
