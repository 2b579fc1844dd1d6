//! Scenes on the 6502 in logarithms: the machine draws what the model says.
#![allow(clippy::unwrap_used)]

use crate::cli::{directory, json};
use crate::jack::planned_in;
use crate::mos6502::Scribe;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::plan::{Copies, Plan};
use slowlight_compiler::targets::mos6502::{PLAIN_LOG10, PLAIN_LOG11};
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

/// Lookups called, written out in loops, and in whole tables; these begin at pages, one byte
/// further each.
#[test]
fn what_memory_is_spent_on_changes_no_pixel() {
    let source = "image 24 x 16 inks black, white;
        param a: real = 0.3 in 0.1 .. 2;
        draw (x, y) = {
            let v = loop (k = 0, s = 0.0) max 6 {
                if s > 40 then s
                else next(k + 1, s * 0.7 + max(x - 12, 0) * (k + a) - max(y - 7, 0) * a)
            } else a;
            ink(floor(v - x * 0.001) mod 2)
        };";
    for target in [&PLAIN_LOG10, &PLAIN_LOG11] {
        let mut plan = planned_in(target, source, (&[], None), true).unwrap();
        let mut pixels = Vec::new();
        let mut sizes = Vec::new();
        for lean in [false, true] {
            for copies in [Copies::None, Copies::Ends, Copies::Loops, Copies::Tables] {
                (plan.lean, plan.copies) = (lean, copies);
                pixels.push(agrees(&plan, source));
                let text = slowlight_compiler::backend::emit(&plan).remove(0).text;
                let program = assemble(&text).unwrap();
                let at = |name: &str| program.symbols[name] & 0xFF;
                assert_eq!((at("log_sums"), at("log_lost")), (0, 1));
                sizes.push(program.image().len());
            }
        }
        assert!(pixels.iter().all(|found| *found == pixels[0]));
        assert!(pixels[0].contains(&0) && pixels[0].contains(&1));
        // Calls are shorter; loops are not where nothing is called; whole tables are long.
        assert!(sizes[4] < sizes[0] && sizes[2] == sizes[1] && sizes[6] > sizes[5]);
        assert!(sizes[3] >= sizes[2] + 6000 && sizes[7] >= sizes[6] + 6000);
    }
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
