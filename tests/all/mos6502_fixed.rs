//! Small scenes on the 6502 in all of its formats: the machine draws what the model says.

use crate::cli::{directory, json, success};

/// Those with a point a value.
const OWN: [&str; 4] = ["fixed12", "fixed16", "fixed20", "fixed24"];

/// Runs a scene of 24 x 16 pixels in a format; how many pixels are not the native's.
fn off(draw: &str, format: &str) -> u64 {
    let text = format!("image 24 x 16 inks black, white;\n{draw}");
    let dir = directory(&[("small.scn", &text)]);
    let args = [
        "run",
        "small.scn",
        "-t",
        "6502",
        "--json",
        "--format",
        format,
    ];
    let run = json(dir.path(), &args);
    assert_eq!(run["differs_from_model"], 0, "{draw} in {format}");
    run["differs_from_native"].as_u64().expect("a number")
}

/// What waits for a pixel is read after what is added to it has been moved to its scale.
#[test]
fn large_errors_are_sent_as_the_model_sends_them() {
    let draw = "draw (x, y) = floyd(if x < 6 then x * 3.1 + y * 0.1 else 0, x, y);";
    assert_eq!(off(draw, "fixed16.16"), 0);
    let _ = OWN.map(|format| off(draw, format));
}

/// Dividends that are one power of two by their range, and no constants.
#[test]
fn quotients_of_what_can_be_one_value_only_are_right() {
    for draw in [
        "param p: int = 4 in 4 .. 4;
        draw (x, y) = threshold(p / (x + 1), bayer(2)[x mod 2, y mod 2]);",
        "draw (x, y) = threshold((y - y mod 16 + 8) / (x + 9), bayer(2)[x mod 2, y mod 2]);",
    ] {
        let usual = off(draw, "fixed16.16");
        for format in OWN {
            let own = off(draw, format);
            assert!(own <= usual + 2, "{draw} in {format}: {own}, {usual}");
        }
    }
}

/// A constant of less than half a last place is 0, and the ranges know it.
#[test]
fn tiny_constants_do_not_make_inks_that_are_none() {
    let draw = "draw (x, y) = threshold(0.000001, bayer(2)[x mod 2, y mod 2]);";
    assert_eq!(off(draw, "fixed16.16"), 0);
    assert_eq!(OWN.map(|format| off(draw, format)), [0; OWN.len()]);
}

/// Rows in passes, in blocks as well, and in runs of columns, also where nothing of a run
/// is computed: the program has the loops that are meant, and draws what the model says.
#[test]
fn rows_in_passes_and_runs_are_what_the_model_draws() {
    const SHADE: &str =
        "threshold((y + 1) * 8 / ((x - 30) * (x - 30) / 8 + 20), bayer(4)[x mod 4, y mod 4])";
    const BALL: &str = "(x - 30.5) * (x - 30.5) + (y - 12) * (y - 12) < 50";
    let passes = ["once a pass"];
    let runs = ["once a run of columns"];
    let still = ["once a run of columns", "pixels whose inks are known"];
    let halves = format!("if x < 20 then ink(0) else if 3 * x > 100 + y then {SHADE} else ink(1)");
    let cut = format!(
        "if x < 20 + y then ink(0) else if x > 50 then ink(2) else if {BALL} then ink(2) else ink(1)"
    );
    let factor = format!("if (if x < 20 + y then 1.5 else 0.25) * {BALL} then ink(2) else ink(1)");
    let (two, three) = ("black, white", "black, grey, white");
    for (width, inks, draw, more, parts) in [
        (64, two, SHADE, &[][..], &passes[..]),
        // A pass but the last ends at the last column.
        (61, two, SHADE, &[][..], &passes[..]),
        (64, two, SHADE, &["--block", "2"][..], &passes[..]),
        (64, three, halves.as_str(), &[][..], &still[..]),
        (64, three, cut.as_str(), &[][..], &runs[..]),
        (64, three, factor.as_str(), &[][..], &runs[..]),
    ] {
        let text = format!("image {width} x 24 inks {inks};\ndraw (x, y) = {draw};");
        let dir = directory(&[("small.scn", &text)]);
        for format in OWN {
            let of = |command: &[&'static str]| -> Vec<&'static str> {
                let scene = ["small.scn", "-t", "6502", "--format", format];
                [&command[..1], &scene[..], more, &command[1..]].concat()
            };
            let written = success(dir.path(), &of(&["build", "--emit", "text"]));
            for part in parts {
                assert!(written.contains(part), "{draw}: {part}");
            }
            let run = json(dir.path(), &of(&["run", "--json"]));
            assert_eq!(run["differs_from_model"], 0, "{draw} {more:?}");
            // The native picture has no blocks.
            if more.is_empty() {
                assert_eq!(run["differs_from_native"], 0, "{draw}");
            }
        }
    }
}

/// A choice that a subroutine leaves is asked for more than its sign, though nothing else is asked
/// of it where it is made.
#[test]
fn choices_that_subroutines_leave_keep_their_magnitudes() {
    let glass = include_str!("../../examples/glass.scn");
    let dir = directory(&[("glass.scn", glass)]);
    let run = |more: &[&str]| {
        let args = "run glass.scn -t 6502:plain --format fixed24 --rows 100..101 --json";
        let args: Vec<&str> = args.split(' ').collect();
        let run = json(dir.path(), &[&args[..], more].concat());
        run["differs_from_native"].as_u64().expect("a number")
    };
    let [usual, called] = [&[][..], &["--outlined"]].map(run);
    assert!(called <= usual + 13, "{called} {usual} of 640");
}

/// A march of as many steps as bounds are looked for in: what it carries is held within what
/// its turns give on, and all that is made of it keeps its digits.
#[test]
fn what_marches_carry_has_bounds_after_any_count_of_steps() {
    let scene = "image 40 x 30 inks black, #404060, #9090b0, white;
shape sponge() {
  dist(p) = {
    let q = abs(p) - (1, 1, 1);
    let box = length(max(q, (0, 0, 0))) + min(max(q.x, max(q.y, q.z)), 0);
    loop (k = 0, d = box, s = 1.0) max 2 {
      let a = (p.x * s + 1) mod 2 - 1;
      let b = (p.y * s + 1) mod 2 - 1;
      let c = (p.z * s + 1) mod 2 - 1;
      let r = (abs(1 - 3 * abs(a)), abs(1 - 3 * abs(b)), abs(1 - 3 * abs(c)));
      let e = (min(max(r.x, r.y), min(max(r.y, r.z), max(r.z, r.x))) - 1) / (3 * s);
      if k == 1 then max(d, e) else next(k + 1, max(d, e), 3 * s)
    } else box
  };
}
scene world { sponge() is 0.9; }
draw (x, y) = {
  let r = pinhole((2.2, 1.6, 2.8), at: (0, 0, 0), field: 40deg).through(x, y);
  let v = if let h = world.march(r, steps: STEPS, near: 0.005, far: 8)
    then 0.15 + 0.8 * lambert(h, (0.36, 0.8, 0.48)) else 0.05;
  threshold(v, bayer(8)[x mod 8, y mod 8])
};\n";
    for steps in ["63", "64", "65"] {
        let scene = scene.replace("STEPS", steps);
        let dir = directory(&[("sponge.scn", &scene)]);
        let args = "run sponge.scn -t 6502:plain --format fixed24 --json";
        let run = json(dir.path(), &args.split(' ').collect::<Vec<_>>());
        let wrong = run["differs_from_native"].as_u64().expect("a number");
        assert!(wrong <= 3, "{wrong} of 1200 by {steps} steps");
    }
}
