//! Scenes compiled to Jack, run on the Hack VM and held against the model.
#![allow(clippy::unwrap_used)]

use crate::mos6502::Scribe;
use slowlight::scene::Precision;
use slowlight_compiler::backend::Document;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::planner::plan;
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;
use slowlight_compiler::targets::jack::{JACK_F316R, JACK_LOG10};
use slowlight_compiler::targets::{Target, default_mode, find};
use slowlight_vm::Stop;
use slowlight_vm::hack::jack::compile;
use slowlight_vm::hack::vm::{Machine, Program, Run};

pub const MIRRORS: &str = include_str!("../../examples/mirrors.scn");

/// A scene's plan for the target.
fn planned(source: &str, set: &[f64], rows: Option<(u32, u32)>, plot: bool) -> PlannedScene {
    let found = planned_in(find("jack").unwrap(), source, (set, rows), plot);
    found.unwrap_or_else(|said| panic!("{said}\n{source}"))
}

/// The same in some format of reals, or what it says of what it cannot compute.
pub fn planned_in(
    target: &'static Target,
    source: &str,
    (set, rows): (&[f64], Option<(u32, u32)>),
    plot: bool,
) -> Result<PlannedScene, String> {
    let scene = scene::check("test", source);
    assert!(scene.is_right(), "{:?}\n{source}", scene.diagnostics);
    let set = if set.is_empty() {
        Vec::new()
    } else {
        vec![("eye".to_owned(), set.to_vec())]
    };
    let options = Precision::of(target).options(Options {
        inks: Some(2),
        set,
        ..Options::default()
    });
    let graph = scene.lower(&options).unwrap();
    let mode = default_mode(target, graph.image.width, graph.image.height).unwrap();
    let goal = Goal {
        name: "test".to_owned(),
        mode,
        rows,
        plot,
    };
    plan(&graph, target, &goal).map_err(|said| format!("{said:?}"))
}

/// The classes; `Main` first, the scene's second. None clears the screen: in the web IDE that
/// takes the upper half of the heap with it.
pub fn documents(plan: &PlannedScene) -> Vec<Document> {
    let documents = slowlight_compiler::backend::emit(plan);
    for document in &documents {
        assert!(
            !document.text.contains("do Screen.clearScreen"),
            "{}",
            document.name
        );
    }
    documents
}

fn run(documents: &[Document]) -> Run {
    let files: Vec<(String, String)> = documents
        .iter()
        .map(|d| (d.name.clone(), d.text.clone()))
        .collect();
    let compiled = compile(&files).unwrap_or_else(|f| panic!("{}\n{}", f[0], documents[1].text));
    let files: Vec<_> = compiled.into_iter().map(|f| (f.name, f.text)).collect();
    let program = Program::link(&files).unwrap_or_else(|f| panic!("{}", f[0]));
    Machine::new(&program).run(5_000_000_000, &mut |_| true)
}

/// Pixels of the plan's rows in which the screen is not what `ink` says, given
/// the picture's column and row.
pub fn differences(plan: &PlannedScene, run: &Run, mut ink: impl FnMut(i32, i32) -> u8) -> u32 {
    let mut different = 0;
    for y in plan.rows.0..=plan.rows.1 {
        for x in plan.columns.0..=plan.columns.1 {
            let (left, top) = plan.offset;
            let at = (y as i32 + top) * 512 + x as i32 + left;
            let drawn = run.screen.pixels[at as usize];
            different += u32::from(drawn != ink(x as i32, y as i32));
        }
    }
    different
}

/// Runs a plan; its every pixel must be the model's.
pub fn agrees(plan: &PlannedScene, documents: &[Document], source: &str) -> Run {
    let run = run(documents);
    assert_eq!(run.stop, Stop::Ended, "{source}");
    assert_eq!(run.text, "", "{source}");
    let mut model = ModelRun::new(plan);
    let different = differences(plan, &run, |x, y| model.pixel(x, y).ink);
    assert_eq!(different, 0, "{source}\n{}", documents[1].text);
    assert_eq!(model.unset_reads(), 0);
    run
}

#[test]
fn two_mirrors_are_drawn_as_the_model_says() {
    for (set, rows) in [
        (&[][..], (60, 63)),
        (&[], (118, 121)),
        (&[0.35, 0.25, 3.6], (127, 131)),
    ] {
        let plan = planned(MIRRORS, set, Some(rows), true);
        let run = agrees(&plan, &documents(&plan), "mirrors");
        // The border stays white.
        let black = run.screen.pixels.iter().filter(|ink| **ink == 0).count();
        let inside = 320 * (rows.1 - rows.0 + 1) as usize;
        assert!(black > 0 && black < inside, "{black}");
    }
}

/// The machine draws the model's pixels, so the model stands for it here.
/// Row 129 is a tie in exact arithmetic.
#[test]
fn two_mirrors_are_near_the_native_picture() {
    for set in [&[][..], &[0.35, 0.25, 3.6]] {
        let plan = planned(MIRRORS, set, None, true);
        let (mut model, mut native) = (ModelRun::new(&plan), Native::new(&plan.graph));
        let (mut off, mut all) = (0, 0);
        for y in (9..240).filter(|y| *y != 129) {
            for x in 0..320 {
                off += u32::from(model.pixel(x, y).ink != native.pixel(x, y).ink);
                all += 1;
            }
        }
        assert!(off * 500 <= all, "{off} of {all}");
    }
}

#[test]
fn a_pixel_costs_what_it_cost() {
    let plan = planned(MIRRORS, &[], Some((120, 120)), true);
    insta::assert_snapshot!(run(&documents(&plan)).instructions / 320);
}

#[test]
fn nothing_is_allocated_while_drawing() {
    let allocated = |rows| {
        let plan = planned(MIRRORS, &[], Some(rows), true);
        let calls = run(&documents(&plan)).os_calls_by_name;
        let of = |name: &str| calls.iter().find(|c| c.0 == name).map(|c| c.1);
        (of("Memory.alloc"), of("Array.new"))
    };
    assert_eq!(allocated((100, 100)), allocated((100, 102)));
}

#[test]
fn the_parameter_block_is_live_and_checked() {
    let rows = Some((70, 71));
    let original = documents(&planned(MIRRORS, &[], rows, true));
    let edit = |edits: &[(&str, &str, &str)]| {
        let mut edited = original.clone();
        for (name, from, to) in edits {
            let line = format!("let {name} = {from};");
            assert_eq!(edited[1].text.matches(&line).count(), 1, "{line}");
            edited[1].text = edited[1]
                .text
                .replacen(&line, &format!("let {name} = {to};"), 1);
        }
        edited
    };
    let edited = edit(&[
        ("eye_x", "0", "3500"),
        ("eye_y", "-1000", "2500"),
        ("eye_z", "3000", "3600"),
    ]);
    let plan = planned(MIRRORS, &[0.35, 0.25, 3.6], rows, true);
    agrees(&plan, &edited, "edited");

    for (name, from, to, range) in [
        ("eye_x", "0", "30001", "-30000 to 30000"),
        ("eye_x", "0", "-32767", "-30000 to 30000"),
        ("eye_y", "-1000", "32767", "-15000 to 20000"),
        ("eye_z", "3000", "-32767", "1500 to 6000"),
        ("first_row", "70", "-1", "0 to 239"),
        ("last_row", "71", "240", "0 to 239"),
    ] {
        let run = run(&edit(&[(name, from, to)]));
        assert_eq!(run.stop, Stop::Ended);
        assert_eq!(run.text, format!("{name} is outside its range, {range}"));
        assert!(run.screen.pixels.iter().filter(|ink| **ink == 0).count() < 20_000);
    }
    let run = run(&edit(&[("eye_x", "0", "30000"), ("last_row", "71", "70")]));
    assert_eq!((run.stop, run.text.as_str()), (Stop::Ended, ""));
}

#[test]
fn large_tables_long_loops_and_wide_pictures() {
    let entries: Vec<String> = (0..300)
        .map(|n| ((n * 7919) % 256 - 128).to_string())
        .collect();
    let rows: Vec<String> = entries.chunks(20).map(|row| row.join(", ")).collect();
    let source = format!(
        "image 600 x 3 inks black, white;
         const big = [{}];
         const small = [0.5, -1, 2; 3, 4.25, -5];
         param steep: int = 3 in 1 .. 4;
         param turned_on: bool = true;
         draw (x, y) = {{
           let far = big[x - 5, y * 4 - 2] + small[x - 298, y - 1] + small[y, 3 - x];
           let turned = loop (n = 0, sum = far) max 40000 {{
             if sum < 900 then next(n + 1, sum + small[n mod 3, n div 150]) else n
           }} else 7;
           ink(if turned_on then abs(floor(turned * steep * 0.37)) mod 2 else 0)
         }};",
        rows.join("; ")
    );
    let plan = planned(&source, &[], None, true);
    assert_eq!((plan.offset, plan.columns), ((-44, 126), (44, 555)));
    agrees(&plan, &documents(&plan), &source);
}

#[test]
fn a_loop_of_many_turns_ends() {
    let source = "image 2 x 2 inks black, white;
         draw (x, y) = ink(floor(
           loop (n = 0.5) max 40000 { if n < 0 then n else next(n) } else x) mod 2);";
    let plan = planned(source, &[], None, true);
    agrees(&plan, &documents(&plan), source);
}

#[test]
fn names_of_scenes_never_meet_those_of_the_program() {
    let names = [
        "class",
        "field",
        "this",
        "int",
        "Main",
        "Float",
        "Math",
        "drawRow",
        "drawPixel",
        "first_row",
        "turns",
        "real_2",
        "eye_value",
        "Test",
        "x_2",
        "add",
        "powers",
        "init",
    ];
    for name in names {
        let source = format!(
            "image 8 x 4 inks black, white;
             param {name}: real = 0.25 in -1 .. 1;
             const table = [1, 2];
             draw (x, y) = {{
               let do_ = sqrt({name} * x); let static = do_ / (y + {name});
               ink(loop (let_ = 2 * x) max 2 {{ if let_ > 3 then let_ else next(let_ - 1) }} else
                 floor(do_ + static + table[x, 0]))
             }};"
        );
        let plan = planned(&source, &[], None, true);
        agrees(&plan, &documents(&plan), &source);
    }
}

#[test]
fn a_program_that_does_not_plot_still_works() {
    let whole = planned(MIRRORS, &[], Some((80, 80)), true);
    let blind = planned(MIRRORS, &[], Some((80, 80)), false);
    let (drawn, computed) = (run(&documents(&whole)), run(&documents(&blind)));
    assert!(computed.screen.pixels.iter().all(|ink| *ink == 1));
    let share = computed.instructions as f64 / drawn.instructions as f64;
    assert!((0.9..1.0).contains(&share), "{share}");
}

#[test]
fn random_scenes_are_drawn_as_the_model_says() {
    for target in [find("jack").unwrap(), &JACK_F316R] {
        let mut scribe = Scribe(2);
        let mut varied = 0;
        for _ in 0..120 {
            let source = scribe.scene();
            let plan = planned_in(target, &source, (&[], None), true).unwrap();
            let run = agrees(&plan, &documents(&plan), &source);
            varied += u32::from(run.screen.pixels.contains(&0));
        }
        assert!(varied >= 40, "only {varied} pictures show anything");
    }
}

/// Fewer commands than what is cut, and fewer pixels that are not the native's.
#[test]
fn two_mirrors_rounded() {
    for set in [&[][..], &[0.35, 0.25, 3.6]] {
        let off = [find("jack").unwrap(), &JACK_F316R].map(|target| {
            let plan = planned_in(target, MIRRORS, (set, Some((100, 163))), true).unwrap();
            let run = agrees(&plan, &documents(&plan), "mirrors");
            let mut native = Native::new(&plan.graph);
            let off = differences(&plan, &run, |x, y| native.pixel(x, y).ink);
            (off, run.instructions)
        });
        let [(cut, slow), (rounded, quick)] = off;
        assert!(2 * rounded <= cut && quick * 5 < slow * 4, "{off:?}");
    }
}

#[test]
fn random_scenes_are_drawn_with_logarithms_as_the_model_says() {
    let mut scribe = Scribe(3);
    let mut varied = 0;
    for _ in 0..120 {
        let source = scribe.scene();
        let plan = planned_in(&JACK_LOG10, &source, (&[], None), true).unwrap();
        let run = agrees(&plan, &documents(&plan), &source);
        varied += u32::from(run.screen.pixels.contains(&0));
    }
    assert!(varied >= 40, "only {varied} pictures show anything");
}

/// A quarter of the floats' cycles at least, and few pixels that are not the native's.
#[test]
fn two_mirrors_with_logarithms() {
    for set in [&[][..], &[0.35, 0.25, 3.6]] {
        let plan = planned_in(&JACK_LOG10, MIRRORS, (set, Some((100, 131))), true).unwrap();
        let run = agrees(&plan, &documents(&plan), "mirrors");
        let floats = planned(MIRRORS, set, Some((100, 131)), true);
        let slower = self::run(&documents(&floats));
        assert!(
            run.instructions * 4 < slower.instructions,
            "{}",
            run.instructions
        );
        let mut native = Native::new(&plan.graph);
        let off = differences(&plan, &run, |x, y| native.pixel(x, y).ink);
        assert!(off * 100 < 320 * 32, "{off}");
    }
}

#[test]
fn errors_spread_as_logarithms_too() {
    let source = "image 40 x 12 inks black, white; param least: real = 0.3 in 0 .. 1;
        draw (x, y) = floyd(x / 40 * (least + y / 12), x, y);";
    let plan = planned_in(&JACK_LOG10, source, (&[], None), true).unwrap();
    let documents = documents(&plan);
    let run = agrees(&plan, &documents, source);
    assert!(run.screen.pixels.contains(&0));
    let floats = documents.iter().any(|d| d.text.contains("Float"));
    assert!(!floats, "logarithms are no objects");
}
