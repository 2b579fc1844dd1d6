//! How fast the bundled machines run: a row of the two mirrors on each target,
//! as cycles of the machine a second.
//!
//! `cargo bench --bench machines`

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use slowlight::trial::{LIMIT, build};
use slowlight_compiler::plan::{Goal, Plan, plan};
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;
use slowlight_compiler::target::{TARGETS, Target, default_mode};

const MIRRORS: &str = include_str!("../examples/mirrors.scn");
/// A row through both balls and the floor.
const ROW: u32 = 150;

/// The plan of one row.
fn row(target: &'static Target) -> Option<Plan> {
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
fn cycles(plan: &Plan) -> Option<u64> {
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

criterion_group!(benches, running);
criterion_main!(benches);
