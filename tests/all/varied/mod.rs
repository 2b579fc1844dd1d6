//! Hard cases of the kinds that are in `tests/hard_cases.json`, with other values: ten of
//! each, what is wanted of them computed from the file's stable formulas with 400 bits.
//! `tests/varied_cases.json` says how each kernel's inputs vary and what passes.

mod big;
mod case;
mod parse;
mod predicate;
mod run;

use case::{Kernel, kernels};
use run::Random;
use serde_json::{Value as Json, json};
use slowlight::cases::{self, Row, Way, ways};
use slowlight_compiler::target::{TARGETS, jack::JACK_F316R};

const FILE: &str = include_str!("../../hard_cases.json");

/// How many of each vector.
const TIMES: u64 = 10;

fn file() -> Json {
    serde_json::from_str(FILE).expect("JSON")
}

/// Every vector of the file varied so often, as such a file; `only` says which of them.
fn varied(only: impl Fn(u64, u64) -> bool) -> cases::CaseFile {
    let file = file();
    let kernels = kernels(&file);
    let vectors = file["vectors"].as_array().expect("vectors");
    let mut made = Vec::new();
    for (n, vector) in (0..).zip(vectors) {
        for time in (0..TIMES).filter(|&time| only(n, time)) {
            let mut random = Random(0x9E37_79B9_7F4A_7C15 ^ (n * TIMES + time + 1) << 20);
            made.push(kernels[&Kernel::key(vector)].varied(vector, time, &mut random));
        }
    }
    let text = json!({"families": file["families"], "vectors": made}).to_string();
    cases::parse("varied cases", &text).expect("it is a file of cases")
}

fn tried(file: &cases::CaseFile, ways: &[Way]) -> Vec<Row> {
    cases::run(file, ways, false).expect("it runs").rows
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
        let found = kernel.case(&inputs);
        wrong.extend(predicate::differences(vector, &found));
    }
    wrong.retain(|w| !OTHERWISE.iter().any(|known| w.starts_with(known)));
    assert_eq!(wrong, Vec::<String>::new(), "{}", wrong.join("\n"));
}

/// One of each vector's ten, or all of them with `SLOWLIGHT_VARIED=all`, natively, in the
/// model of every format and on every machine.
#[test]
fn varied_vectors_pass_everywhere() {
    let all = std::env::var("SLOWLIGHT_VARIED").is_ok_and(|v| v == "all");
    let file = varied(|n, time| all || n % TIMES == time);
    let targets = [TARGETS, &[&JACK_F316R]].concat();
    let rows = tried(&file, &ways(&targets, true));
    let failed = rows.iter().filter(|row| !row.verdict.passed);
    let failed: Vec<String> = failed
        .map(|row| {
            let (format, place) = (row.way.format(), row.way.place());
            let id = &row.id;
            let inputs = &file
                .vectors
                .iter()
                .find(|v| v.id == *id)
                .expect("it")
                .inputs;
            let inputs: Vec<String> = inputs
                .iter()
                .map(|(n, i)| format!("{n} {}", i.dec))
                .collect();
            let (got, failure) = (&row.got, &row.failure);
            format!(
                "{format} {place}: {id} ({}): {got:?} {failure:?} {:?}",
                inputs.join(", "),
                row.verdict
            )
        })
        .collect();
    println!("{} of {} fail", failed.len(), rows.len());
    assert_eq!(failed, Vec::<String>::new(), "{}", failed.join("\n"));
}
