//! How fast the bundled machines run: a row of the two mirrors on each target,
//! as cycles of the machine a second.
//!
//! And the same row in Jack's formats on the Hack's VM and on a straightforward
//! interpreter of its commands, the yardstick. (Programs by hand are measured by
//! `cargo bench -p slowlight-vm`, the processor's too.)
//!
//! `cargo bench --bench machines`

#[path = "../vm/benches/yardstick/mod.rs"]
mod yardstick;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use slowlight::trial::{LIMIT, build};
use slowlight_compiler::plan::Goal;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::planner::plan;
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;
use slowlight_compiler::targets::jack::JACK;
use slowlight_compiler::targets::{TARGETS, Target, default_mode, formats};
use slowlight_vm::hack::jack;
use slowlight_vm::hack::vm::{Machine, Program};
use std::hint::black_box;
use yardstick::Straight;

const MIRRORS: &str = include_str!("../examples/mirrors.scn");
/// A row through both balls and the floor.
const ROW: u32 = 150;

/// The plan of one row.
fn row(target: &'static Target) -> Option<PlannedScene> {
    let checked = scene::check("mirrors.scn", MIRRORS);
    let image = checked.program.image.as_ref()?;
    let mode = default_mode(target, image.width, image.height)?;
    let options = Options {
        inks: Some(mode.inks),
        offset: target.offset,
        ..Options::default()
    };
    let goal = Goal {
        name: "mirrors".to_owned(),
        mode,
        rows: Some((ROW, ROW)),
        plot: true,
    };
    plan(&checked.lower(&options).ok()?, target, &goal).ok()
}

/// The cycles that a program takes.
fn cycles(plan: &PlannedScene) -> Option<u64> {
    let mut loaded = build(plan).ok()?.loaded;
    loaded.run(LIMIT, &mut |_| ()).ok().map(|run| run.cycles)
}

fn running(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a row of mirrors");
    group.sample_size(10);
    for target in TARGETS {
        let plan = row(target);
        let cycles_of = || plan.as_ref().and_then(cycles);
        let Some(count) = cycles_of() else {
            panic!("mirrors does not run on {}", target.name);
        };
        group.throughput(Throughput::Elements(count));
        group.bench_function(target.name, |b| b.iter(cycles_of));
    }
    group.finish();
}

/// The VM code of a plan for Jack.
fn vm_code(plan: &PlannedScene) -> Vec<(String, String)> {
    let documents = slowlight_compiler::backend::emit(plan).into_iter();
    let sources: Vec<(String, String)> = documents.map(|d| (d.name, d.text)).collect();
    match jack::compile(&sources) {
        Ok(files) => files.into_iter().map(|f| (f.name, f.text)).collect(),
        Err(faults) => panic!("{faults:?}"),
    }
}

fn yardstick_of_the_vm(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a row of mirrors on the Hack VM");
    group.sample_size(10);
    for target in formats(&JACK) {
        let Some(plan) = row(target) else {
            panic!("mirrors is not planned in {}", target.runtime.format);
        };
        let code = vm_code(&plan);
        let (Ok(program), Some(straight)) = (Program::link(&code), Straight::read(&code)) else {
            panic!("{} is not read", target.runtime.format);
        };
        let run = Machine::new(&program).run(LIMIT, &mut |_| true);
        let left = straight.run();
        assert_eq!(left.commands, run.instructions, "the same commands");
        let screen = &left.memory[16384..24576];
        let dark = screen.iter().map(|word| word.count_ones()).sum::<u32>();
        let seen = run.screen.pixels.iter().filter(|ink| **ink == 0).count();
        assert_eq!(dark as usize, seen, "the same picture");
        group.throughput(Throughput::Elements(run.instructions));
        let name = target.runtime.format;
        group.bench_function(name, |b| {
            b.iter(|| black_box(Machine::new(&program).run(LIMIT, &mut |_| true)));
        });
        group.bench_function(format!("{name}, straightforward"), |b| {
            b.iter(|| black_box(straight.run().commands));
        });
    }
    group.finish();
}

criterion_group!(benches, running, yardstick_of_the_vm);
criterion_main!(benches);
