//! Hard cases of the kinds that are in `tests/hard_cases.json`, with other values: ten of
//! each, what is wanted of them computed from the file's stable formulas with 400 bits.
//! `tests/varied_cases.json` says how each kernel's inputs vary and what passes.

mod big;
mod case;
mod moves;
mod parse;
mod predicate;
mod run;
mod value;

use case::{Kernel, kernels};
use moves::Rule;
use run::Random;
use serde_json::{Value as Json, json};
use slowlight::cases::{self, Way, ways};
use slowlight_compiler::targets::jack::{JACK_F316R, JACK_FIXED16, JACK_LOG10};
use slowlight_compiler::targets::mos6502::{
    PLAIN_FIXED12, PLAIN_FIXED16, PLAIN_FIXED20, PLAIN_FIXED24, PLAIN_LOG10,
};
use slowlight_compiler::targets::{TARGETS, Target};

const FILE: &str = include_str!("../../hard_cases.json");

/// How many of each vector.
const TIMES: u64 = 10;

fn file() -> Json {
    serde_json::from_str(FILE).expect("JSON")
}

/// How many vectors the file has, varied so often; `only` says which of them are made.
fn varied(only: impl Fn(u64, u64) -> bool + Sync) -> Vec<(u64, Json)> {
    let file = file();
    let kernels = kernels(&file);
    let vectors = file["vectors"].as_array().expect("vectors");
    let all: Vec<(u64, &Json)> = (0..).zip(vectors).collect();
    let made = |&(n, vector): &(u64, &Json)| {
        let kernel = &kernels[&Kernel::key(vector)];
        let inputs = |time: u64| {
            let mut random = Random(0x9E37_79B9_7F4A_7C15 ^ (n * TIMES + time + 1) << 20);
            kernel.others(vector, &mut random)
        };
        let all: Vec<_> = (0..TIMES).map(inputs).collect();
        let times = (0..TIMES).filter(|&time| only(n, time));
        let made = times.map(|time| (n, kernel.varied(vector, time as usize, &all)));
        made.collect::<Vec<_>>()
    };
    // Side by side: operations are moved one by one.
    std::thread::scope(|scope| {
        let parts = all.chunks(all.len().div_ceil(4));
        let threads = parts.map(|part| scope.spawn(|| part.iter().flat_map(made).collect()));
        let threads: Vec<_> = threads.collect();
        let parts = threads.into_iter().map(|t| t.join().expect("it is made"));
        parts.flat_map(|part: Vec<_>| part).collect()
    })
}

/// A file of such vectors.
fn written<'v>(vectors: impl Iterator<Item = &'v Json>) -> cases::CaseFile {
    let vectors: Vec<&Json> = vectors.collect();
    let text = json!({"families": file()["families"], "vectors": vectors}).to_string();
    cases::parse("varied cases", &text).expect("it is a file of cases")
}

/// Whether all ten of each vector are asked for.
fn all() -> bool {
    std::env::var("SLOWLIGHT_VARIED").is_ok_and(|v| v == "all")
}

/// Where the file has not what its own formula gives: the torus' tangent point is not
/// reached in 3,000 steps, and the march that comes exactly to `eps` makes a step more.
const OTHERWISE: [&str; 2] = ["torus/top_tangent t", "march_grazing_plane/sin2p-1 "];

/// What is computed of a vector's inputs is what the file says of them, so that what is
/// computed of others can be trusted; no bound is wider.
#[test]
fn the_files_own_vectors_are_computed_again() {
    let file = file();
    let kernels = kernels(&file);
    let mut wrong = Vec::new();
    for vector in file["vectors"].as_array().expect("vectors") {
        let kernel = &kernels[&Kernel::key(vector)];
        let inputs = kernel.inputs(vector);
        let found = kernel.case(&inputs, &Rule::Fixed);
        wrong.extend(predicate::differences(vector, &found));
    }
    wrong.retain(|w| !OTHERWISE.iter().any(|known| w.starts_with(known)));
    assert_eq!(wrong, Vec::<String>::new(), "{}", wrong.join("\n"));
}

/// What does not pass, in words; and the table.
fn failed(file: &cases::CaseFile, found: &cases::Rows) -> Vec<String> {
    let failed = found.rows.iter().filter(|row| !row.verdict.passed);
    let words = failed.map(|row| {
        let (format, place) = (row.way.format(), row.way.place());
        let vector = file.vectors.iter().find(|v| v.id == row.id).expect("it");
        let inputs = vector.inputs.iter();
        let inputs: Vec<String> = inputs.map(|(n, i)| format!("{n} {}", i.dec)).collect();
        let (got, failure) = (&row.got, &row.failure);
        format!(
            "{format} {place}: {} ({}): {got:?} {failure:?} {:?}",
            row.id,
            inputs.join(", "),
            row.verdict
        )
    });
    let failed: Vec<String> = words.collect();
    println!("{}", cases::table::text(found));
    println!("{} of {} fail", failed.len(), found.rows.len());
    failed
}

/// One of each vector's ten, or all of them with `SLOWLIGHT_VARIED=all`, natively, in the
/// model of every format and on every machine.
#[test]
fn varied_vectors_pass_everywhere() {
    let all = all();
    let made = varied(|n, time| all || n % TIMES == time);
    let file = written(made.iter().map(|(_, vector)| vector));
    let targets = [TARGETS, &[&JACK_F316R]].concat();
    let mut ways = ways(&targets, true);
    // Both machines with logarithms: they share the format, not the program.
    ways.push(Way::Model(&JACK_LOG10));
    ways.extend([&JACK_LOG10, &PLAIN_LOG10].map(Way::Machine));
    let found = cases::run(&file, &ways, false).expect("it runs");
    let failed = failed(&file, &found);
    assert_eq!(failed, Vec::<String>::new(), "{}", failed.join("\n"));
}

/// Formats whose points the plan places. A machine is held to its model besides.
const PLANNED: [&Target; 5] = [
    &JACK_FIXED16,
    &PLAIN_FIXED12,
    &PLAIN_FIXED16,
    &PLAIN_FIXED20,
    &PLAIN_FIXED24,
];

/// The same where every value has a place of its own, so that a vector is a scene whose
/// params are said to be what its ten are. A plan for each takes its time: without the
/// variable every format has a fifth of the vectors.
#[test]
fn varied_vectors_pass_where_points_are_planned() {
    let all = all();
    let made = varied(|n, time| all || n % TIMES == time);
    let mut wrong = Vec::new();
    for (k, target) in (0..).zip(PLANNED) {
        let part = made.iter().filter(|(n, _)| all || n % 5 == k);
        let file = written(part.map(|(_, vector)| vector));
        let found = cases::run(&file, &[Way::Machine(target)], false).expect("it runs");
        assert_eq!(found.skipped, 0);
        wrong.extend(failed(&file, &found));
    }
    assert_eq!(wrong, Vec::<String>::new(), "{}", wrong.join("\n"));
}
