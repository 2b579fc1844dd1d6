//! How long the compiler takes from a scene's text to a target's source.
//!
//! `cargo bench --bench compile`

use criterion::{Criterion, criterion_group, criterion_main};
use slowlight_compiler::plan::Goal;
use slowlight_compiler::planner::plan;
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;
use slowlight_compiler::targets::{TARGETS, Target, default_mode};
use std::hint::black_box;

const MIRRORS: &str = include_str!("../examples/mirrors.scn");

/// The bytes of source that a scene becomes; 0 where it does not compile.
fn compile(text: &str, target: &'static Target) -> usize {
    let checked = scene::check("mirrors.scn", text);
    let image = checked.program.image.as_ref();
    let (width, height) = image.map_or((1, 1), |i| (i.width, i.height));
    let Some(mode) = default_mode(target, width, height) else {
        return 0;
    };
    let options = Options {
        inks: Some(mode.inks),
        offset: target.offset,
        ..Options::default()
    };
    let goal = Goal {
        name: "mirrors".to_owned(),
        mode,
        rows: None,
        plot: true,
    };
    let plan = checked
        .lower(&options)
        .and_then(|graph| plan(&graph, target, &goal));
    plan.map_or(0, |plan| {
        slowlight_compiler::backend::emit(&plan)
            .iter()
            .map(|d| d.text.len())
            .sum()
    })
}

fn compiling(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("compile mirrors");
    group.bench_function("check", |b| {
        b.iter(|| scene::check("mirrors.scn", black_box(MIRRORS)));
    });
    for target in TARGETS {
        assert!(compile(MIRRORS, target) > 0, "{}", target.name);
        group.bench_function(target.name, |b| {
            b.iter(|| compile(black_box(MIRRORS), target));
        });
    }
    group.finish();
}

criterion_group!(benches, compiling);
criterion_main!(benches);
