//! Scenes in fixed point, each value with fraction bits of its own, on the Hack VM, held
//! against the model; and the model against its bounds.
#![allow(clippy::unwrap_used)]

use crate::held::stays_within_bounds;
use crate::jack::{MIRRORS, agrees, differences, documents, planned_in};
use crate::mos6502::Scribe;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::jack::JACK_FIXED16;

const TORUS: &str = include_str!("../../examples/torus.scn");
const MAZE: &str = include_str!("../../examples/maze.scn");

fn planned(source: &str, set: &[f64], rows: Option<(u32, u32)>) -> Result<PlannedScene, String> {
    planned_in(&JACK_FIXED16, source, (set, rows), true)
}

#[test]
fn random_scenes_are_drawn_as_the_model_says_and_nothing_wraps() {
    let mut scribe = Scribe(5);
    let (mut drawn, mut varied) = (0, 0);
    for _ in 0..200 {
        let source = scribe.scene();
        match planned(&source, &[], None) {
            Ok(plan) => {
                let run = agrees(&plan, &documents(&plan), &source);
                stays_within_bounds(&plan);
                drawn += 1;
                varied += u32::from(run.screen.pixels.contains(&0));
            }
            Err(said) => assert!(said.contains("fixed-point format"), "{said}\n{source}"),
        }
    }
    assert!(drawn >= 60 && varied >= 25, "{drawn} {varied}");
}

/// Also where an eye stands at the end of its range, which no plan looks at more closely.
#[test]
fn no_value_of_the_examples_leaves_its_bounds() {
    for (source, eyes) in [
        (MIRRORS, &[&[][..], &[0.35, 0.25, 3.6]][..]),
        (
            TORUS,
            &[&[], &[-3.0, 0.0, 2.0], &[3.0, 4.0, 8.0], &[0.5, 0.0, 2.0]],
        ),
        (MAZE, &[&[]]),
    ] {
        for eye in eyes {
            let plan = planned(source, eye, None).unwrap();
            let (reals, _) = stays_within_bounds(&plan);
            assert!(reals > 1000, "{reals}");
        }
    }
}

/// What the ranges cannot bound saturates, and does not wrap: a ray beside the horizon.
#[test]
fn quotients_beyond_all_bits_saturate() {
    let source = "image 64 x 64 inks black, white; param low: real = 0.01 in 0.001 .. 0.1;
        draw (x, y) = {
          let far = 1 / (low * abs(y - 32));
          ink(if far * far > 60 + x then 1 else 0)
        };";
    let plan = planned(source, &[], None).unwrap();
    let (_, ends) = stays_within_bounds(&plan);
    assert!(ends > 0);
    let run = agrees(&plan, &documents(&plan), source);
    let mut native = Native::new(&plan.graph);
    let off = differences(&plan, &run, |x, y| native.pixel(x, y).ink);
    assert!(off * 50 < 64 * 64, "{off}");
}

/// What is simulated for such a format: 22 to 54 pixels of a torus, 110 to 190 of mirrors.
#[test]
fn few_pixels_are_not_the_natives() {
    for (source, rows, most) in [(TORUS, (100, 163), 30), (MIRRORS, (90, 153), 60)] {
        let plan = planned(source, &[], Some(rows)).unwrap();
        let run = agrees(&plan, &documents(&plan), "an example");
        let mut native = Native::new(&plan.graph);
        let off = differences(&plan, &run, |x, y| native.pixel(x, y).ink);
        assert!(off <= most, "{off}");
        let text = &documents(&plan);
        assert!(text.iter().all(|d| !d.text.contains("Float")));
    }
}

#[test]
fn errors_spread_in_fixed_point_too() {
    let source = "image 40 x 12 inks black, white; param least: real = 0.3 in 0 .. 1;
        draw (x, y) = floyd(x / 40 * (least + y / 12), x, y);";
    let plan = planned(source, &[], None).unwrap();
    let run = agrees(&plan, &documents(&plan), source);
    assert!(run.screen.pixels.contains(&0));
    stays_within_bounds(&plan);
}

/// A picture of a shade, drawn as the model says with its param at several places, every
/// value within its bounds; answers in how many pixels it is not the native one at most.
fn most_off(shade: &str) -> u32 {
    let source = format!(
        "image 24 x 12 inks black, white; param eye: real = 0.7 in 0 .. 2;
        draw (x, y) = threshold({shade}, bayer(4)[x mod 4, y mod 4]);"
    );
    let off = [0.7, 0.0, 2.0].map(|eye| {
        let plan = planned(&source, &[eye], None).unwrap();
        let run = agrees(&plan, &documents(&plan), &source);
        stays_within_bounds(&plan);
        let mut native = Native::new(&plan.graph);
        differences(&plan, &run, |x, y| native.pixel(x, y).ink)
    });
    off.into_iter().max().unwrap()
}

/// Where it is added to half of what has few bits: 128 pixels are off where it has no more.
#[test]
fn a_constant_keeps_its_bits() {
    let source = "image 24 x 16 inks black, white; param k: real = 20 in -20 .. 20;
        draw (x, y) = threshold((0.02 + 0.5 * ((x * k * y) mod 1)) * x, 0.7);";
    let plan = planned(source, &[], None).unwrap();
    let run = agrees(&plan, &documents(&plan), source);
    let mut native = Native::new(&plan.graph);
    let off = differences(&plan, &run, |x, y| native.pixel(x, y).ink);
    assert!(off <= 16, "{off}");
}

/// Coordinates of many bits and of few, and a factor that is beyond 0 and 1.
#[test]
fn what_floors_leave_and_what_is_interpolated_stay_within_bounds() {
    for by in ["0.37", "11.3", "0.0021"] {
        let off = most_off(&format!(
            "noise((x * {by} * (eye + 0.1) - 20, y * {by} - eye))"
        ));
        assert!(off <= 12, "{by}: {off}");
    }
    let off = most_off("mix(x * 0.1 - eye, y * y * 0.01, x * 0.07 * eye - 0.4)");
    assert!(off <= 12, "{off}");
}

#[test]
fn powers_logarithms_tangents_and_arcs_are_drawn() {
    for (shade, most) in [
        ("exp(x / 8 - y)", 0),
        ("exp(0.01 - x * y / 16)", 0),
        ("1 - log(1 + x + y * 99) / 9", 0),
        ("log(x / 24 * eye) / 9 + 1", 0),
        // Some ties.
        ("abs((x / 12 - 1) ^ floor(y - 5) * eye)", 6),
        ("(1 + x * eye) ^ (-y / 7) * 4", 0),
        ("tan(x / 24 * 1rad) * eye / 2", 0),
        ("abs(tan((x * eye + y) * 1rad)) / 30", 0),
        (
            "asin(x / 24 * eye) / 1rad * (acos(y / 6 - 1) / 1rad) / 4",
            0,
        ),
        ("(atan2(y - 6, x - 12) / 1rad + 3.2) / 6.4", 0),
        ("atan2(x * 0.001, 0.03 + y * eye) / 1rad * 0.7", 0),
    ] {
        let off = most_off(shade);
        assert!(off <= most, "{shade}: {off}");
    }
}

/// Of sizes that no one point is right for, values saturate.
#[test]
fn powers_beyond_all_bits_saturate() {
    for shade in [
        "exp(sin(x * 1rad) * 300)",
        "(x / 24) ^ (1 + 40 * y)",
        "(x - 12) ^ (y * 500 * eye - 3000)",
        "log(exp(x * y * eye)) / 500",
        "tan(asin(x / 23)) * exp(-y) + 0 ^ (eye - y)",
    ] {
        most_off(shade);
    }
}

#[test]
fn what_cannot_be_computed_is_refused_with_its_place() {
    let source =
        "image 8 x 8 inks black, white; param p: real = 1; draw (x, y) = ink(floor(p * x));";
    let said = planned(source, &[], None).unwrap_err();
    assert!(said.contains("fixed16 is a fixed-point format"), "{said}");
}

/// Where a constant has no digits left, an int is another than that of exact reals.
#[test]
fn ints_of_what_is_rounded_away_are_the_models() {
    for draw in [
        "ink(ceil(y * 0.001 + 0.0000001) - 1)",
        "threshold(sqrt(y * 0.001 + 0.0000001), bayer(2)[x mod 2, y mod 2])",
        "ink(ceil(sqrt(p * p + 0.0000000001)) - 1)",
    ] {
        let source = format!(
            "image 16 x 8 inks black, white; param p: real = 0 in 0 .. 3; draw (x, y) = {draw};"
        );
        let plan = planned(&source, &[], None).unwrap();
        agrees(&plan, &documents(&plan), &source);
    }
}

/// An edited program is the one that would be made for the edited param.
#[test]
fn points_are_those_of_the_scene_whatever_its_params_are_set_to() {
    let source =
        "image 24 x 12 inks black, white; param eye: vec3 = (1, 2, 3) in (0, 0, 0) .. (100, 9, 9);
        draw (x, y) = ink(floor(1 / (x * 0.2 + eye.x) * (y + eye.y) * 999 / (1 + eye.z)) mod 2);";
    let lines = |set: &[f64]| {
        let plan = planned(source, set, None).unwrap();
        let text: String = documents(&plan).iter().map(|d| d.text.clone()).collect();
        let other = text.lines().filter(|line| !line.contains("let eye_"));
        other.map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(lines(&[]), lines(&[0.01, 8.0, 0.5]));
    assert_eq!(lines(&[]), lines(&[99.0, 0.0, 9.0]));
}

#[test]
fn a_threshold_that_nothing_reaches_takes_no_digits_from_others() {
    let source = "image 24 x 12 inks black, white; param k: real = 1 in 0 .. 2;
        draw (x, y) = threshold(x / 24 / k, bayer(4)[x mod 4, y mod 4]);";
    let plan = planned(source, &[], None).unwrap();
    let run = agrees(&plan, &documents(&plan), source);
    let mut native = Native::new(&plan.graph);
    let off = differences(&plan, &run, |x, y| native.pixel(x, y).ink);
    assert!(off <= 6, "{off}");
}

/// How many pixels of a scene in fixed point are not the native's; those of the machine
/// are the model's.
fn off(source: &str) -> usize {
    let plan = planned(source, &[], None).unwrap();
    let run = agrees(&plan, &documents(&plan), source);
    stays_within_bounds(&plan);
    let mut native = Native::new(&plan.graph);
    differences(&plan, &run, |x, y| native.pixel(x, y).ink) as usize
}

/// What stands for "larger than all others" ends where the others do.
#[test]
fn a_constant_above_all_others_takes_no_digits_from_them() {
    let choice = "image 48 x 32 inks black, white; param p: real = 3 in 1 .. 8;
        draw (x, y) = {
          let a = if x < y then 1000000 else x / p;
          let b = if x + y < 30 then -1000000 else y / p;
          threshold(if a > b then min(a, 20) / 20 else max(b, -3) / 20, bayer(8)[x mod 8, y mod 8])
        };";
    let found = off(choice);
    assert!(found <= 3, "{found}");
    // A ray along an axis lies between a box's other sides for ever.
    let along = "image 64 x 48 inks black, white;
        scene s { box((-1, -1, 1), (0.5, 0.6, 2)) is 1; }
        draw (x, y) = {
          let r = ray((0, 0, -2), unit(((x - 32) / 24, (24 - y) / 24, 1.5)));
          let v = if let h = s.trace(r, far: 30)
            then 0.2 + 0.7 * max(dot(h.normal, (0.48, 0.6, -0.64)), 0) else 0.1;
          threshold(v, bayer(8)[x mod 8, y mod 8])
        };";
    let found = off(along);
    assert!(found <= 30, "{found}");
}

/// A few large values that count, beside very many that are nothing.
#[test]
fn the_tiny_do_not_outvote_the_large() {
    let powers = "image 96 x 64 inks black, white; param k: real = 0.2 in 0 .. 0.4;
        draw (x, y) = threshold((x / 96) ^ 16 * (x / 96) ^ 16 + k + (y / 64) ^ 8, bayer(8)[x mod 8, y mod 8]);";
    let found = off(powers);
    assert!(found <= 20, "{found}");
}

/// Shapes joined with, cut from and cut by another kind of shape: what is asked of the sign
/// of a difference alone is not lost, nor is what is equal by agreement.
#[test]
fn shapes_made_of_others_keep_their_surfaces() {
    for join in ["union", "intersection", "difference"] {
        let source = format!(
            "image 40 x 24 inks black, white;
            scene world {{ {join}(box((-1, -1, -1), (1, 1, 1)), sphere((0.5, 0.5, 1), 0.8)) is 0.8; }}
            param eye: vec3 = (0, 0.5, 4) in (-1, 0, 3) .. (1, 1, 6);
            draw (x, y) = {{
              let r = pinhole(eye, at: (0, 0, 0), field: 50deg).through(x, y);
              let v = if let h = world.trace(r, far: 20)
                then lambert(h, unit((1, 1, 1))) * h.tag else 0.8;
              threshold(v, bayer(4)[x mod 4, y mod 4])
            }};"
        );
        let found = off(&source);
        assert!(found <= 4, "{join}: {found}");
    }
}

/// A sign is 1 or -1 even where nothing but the sign is asked of what has it.
#[test]
fn signs_are_reals_too() {
    let one = "image 24 x 16 inks black, white;
        draw (x, y) = floyd(sign(x / 24 + 0.1), x, y);";
    assert_eq!(off(one), 0);
    let both = "image 24 x 16 inks black, white;
        draw (x, y) = threshold(sign(sin(x * 0.5rad)) * 0.4 + 0.5, bayer(2)[x mod 2, y mod 2]);";
    let found = off(both);
    // Sin 0 is neither, and rounding may make it either.
    assert!(found <= 16, "{found}");
}
