//! Scenes on the 6502 in logarithms: the machine draws what the model says.
#![allow(clippy::unwrap_used)]

use crate::cli::{directory, json};
use crate::jack::planned_in;
use crate::mos6502::Scribe;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::targets::mos6502::PLAIN_LOG10;
use slowlight_vm::Stop;
use slowlight_vm::mos6502::{Plain, assemble};
use std::path::Path;

/// The machine's inks, held against the model's.
fn agrees(plan: &Plan, source: &str) -> Vec<u8> {
    let text = slowlight_compiler::backend::emit(plan).remove(0).text;
    let program = assemble(&text).unwrap_or_else(|faults| panic!("{}\n{text}", faults[0]));
    let mut machine = Plain::new();
    machine.load(&program.image()).unwrap();
    let run = machine.run(2_000_000_000, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended, "{source}");
    let screen = run.screen.unwrap();
    let mut model = ModelRun::new(plan);
    for y in 0..screen.height {
        for x in 0..screen.width {
            let drawn = screen.pixels[(y * screen.width + x) as usize];
            let ink = model.pixel(x as i32, y as i32).ink;
            assert_eq!(drawn, ink, "({x}, {y}) of\n{source}");
        }
    }
    assert_eq!(model.unset_reads(), 0, "{source}");
    screen.pixels
}

#[test]
fn random_scenes_are_drawn_as_the_model_says() {
    let mut scribe = Scribe(3);
    let mut varied = 0;
    for _ in 0..120 {
        let source = scribe.scene();
        let plan = planned_in(&PLAIN_LOG10, &source, (&[], None), true).unwrap();
        let pixels = agrees(&plan, &source);
        varied += u32::from(pixels.iter().any(|ink| *ink != pixels[0]));
    }
    assert!(varied >= 40, "only {varied} pictures show anything");
}

/// What waits is 0 where nothing has been sent, which is no 0 in memory.
#[test]
fn errors_spread_as_the_model_spreads_them() {
    let source = "image 40 x 12 inks black, white; param least: real = 0.3 in 0 .. 1;
        draw (x, y) = floyd(x / 40 * (least + y / 12), x, y);";
    let plan = planned_in(&PLAIN_LOG10, source, (&[], None), true).unwrap();
    let pixels = agrees(&plan, source);
    assert!(pixels.contains(&0) && pixels.contains(&1));
}

/// Of two params the sign of one is known by its range, and is not read.
#[test]
fn known_signs_are_not_read() {
    let source = "image 8 x 8 inks black, white;
        param a: real = 0.5 in 0.1 .. 2; param b: real = 0.5 in -2 .. 2;
        draw (x, y) = if (x + a) * (y + a) < a * 20 then ink(0)
            else if (x + a) * b < y + a then ink(1) else ink(0);";
    let plan = planned_in(&PLAIN_LOG10, source, (&[], None), true).unwrap();
    let pixels = agrees(&plan, source);
    assert!(pixels.contains(&0) && pixels.contains(&1));
    let text = slowlight_compiler::backend::emit(&plan).remove(0).text;
    assert!(text.contains("lda b_value+2"), "{text}");
    assert!(!text.contains("lda a_value+2"), "{text}");
}

#[test]
fn scenes_are_drawn_with_logarithms() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let dir = directory(&[]);
    for (name, rows) in [
        ("torus", "100..110"),
        ("mirrors", "100..106"),
        ("maze", "0..31"),
        ("primitives", "0..10"),
    ] {
        let path = root.join("examples").join(format!("{name}.scn"));
        let scene = path.to_str().expect("a path");
        let args = [
            "run", scene, "-t", "6502", "--json", "--rows", rows, "--format", "log10",
        ];
        let run = json(dir.path(), &args);
        assert_eq!(run["differs_from_model"], 0, "{name}");
        let rmse = run["rmse"].as_f64().expect("a number");
        assert!(rmse < 0.05, "{name}: {rmse}");
    }
}
