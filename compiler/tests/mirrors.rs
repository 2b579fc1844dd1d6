//! The front end and the middle on the first example, without a machine.
#![allow(clippy::unwrap_used)]

use slowlight_compiler::analysis::verify::verify;
use slowlight_compiler::eval::arithmetic::Exact;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::eval::run::Run;
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::planner::plan;
use slowlight_compiler::scene;
use slowlight_compiler::schedule::statements::schedule;
use slowlight_compiler::sema::Options;
use slowlight_compiler::targets::{Lean, Mode, System, Target};

fn graph(options: &Options) -> Graph {
    let text = include_str!("../../examples/mirrors.scn");
    let scene = scene::check("mirrors.scn", text);
    assert_eq!(scene.diagnostics, []);
    let graph = scene.lower(options).unwrap();
    verify(&graph).unwrap();
    graph
}

static MODE: Mode = Mode {
    name: "",
    width: 320,
    height: 240,
    inks: 4,
};
static PLAIN: Target = Target {
    name: "6502:test",
    system: System::Plain6502,
    about: "the routines without a machine",
    runtime: &slowlight_runtime_6502::FIXED16_16,
    modes: &[MODE],
    offset: 1.0 / 256.0,
    hertz: 1e6,
    sizes: slowlight_compiler::targets::mos6502::PLAIN.sizes,
    wraps: false,
    columns: 0,
    pixels: |_| 1,
    drawing: 0,
    stolen: 0.0,
    lean: Lean::Nothing,
    last: false,
    windows: false,
    moves: false,
    columns_only: false,
};

/// Where the eye may be, the default first.
const EYES: [[f64; 3]; 4] = [
    [0.0, -0.1, 3.0],
    [0.35, 0.25, 3.6],
    [-2.0, 1.0, 2.0],
    [1.0, -1.4, 6.0],
];

fn seen_from(eye: [f64; 3], offset: f64) -> Graph {
    let set = vec![("eye".to_owned(), eye.to_vec())];
    graph(&Options {
        set,
        offset,
        ..Options::default()
    })
}

#[test]
fn the_native_picture_is_the_reference() {
    let reference = include_bytes!("../../tests/reference/mirrors-f64.pgm");
    let pixels = &reference[reference.len() - 320 * 240..];
    let graph = graph(&Options::default());
    let mut native = Native::new(&graph);
    let different = (9..240)
        .flat_map(|y| (0..320).map(move |x| (x, y)))
        .filter(|&(x, y)| native.pixel(x, y).ink != pixels[(y * 320 + x) as usize]);
    assert_eq!(different.count(), 0);
}

#[test]
fn the_statements_draw_what_the_graph_means() {
    for eye in EYES {
        let graph = seen_from(eye, 1e-9);
        let tree = schedule(&graph);
        let mut native = Native::new(&graph);
        let mut run = Run::new(&graph, &tree, Exact(&graph));
        for y in (1..240).step_by(7) {
            for x in 0..320 {
                assert_eq!(
                    run.pixel(x, y).int(),
                    i32::from(native.pixel(x, y).ink),
                    "({x}, {y})"
                );
            }
        }
        assert_eq!(run.unset_reads(), 0);
    }
}

#[test]
fn a_plan_in_fixed_point_stays_close_to_the_native_picture() {
    for eye in EYES {
        let (exact, coarse) = (seen_from(eye, 1e-9), seen_from(eye, PLAIN.offset));
        let goal = Goal {
            name: "mirrors".into(),
            mode: MODE,
            rows: None,
            plot: true,
        };
        let plan = plan(&coarse, &PLAIN, &goal).unwrap();
        let (mut native, mut model) = (Native::new(&exact), ModelRun::new(&plan));
        let rows = (0..240).filter(|y| *y % 4 == 2);
        let pixels: Vec<(i32, i32)> = rows.flat_map(|y| (0..320).map(move |x| (x, y))).collect();
        let different = pixels
            .iter()
            .filter(|&&(x, y)| native.pixel(x, y).ink != model.pixel(x, y).ink);
        let share = different.count() as f64 / pixels.len() as f64;
        assert!(share < 0.005, "eye {eye:?}: {share}");
        assert_eq!(model.unset_reads(), 0);
    }
}
