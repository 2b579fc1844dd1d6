//! The heap of Jack programs: what a build says of it is what the program takes, and on
//! which operating systems it runs.

use crate::cli::{directory, json, slowlight, success};
use crate::jack::{MIRRORS, documents, planned_in};
use slowlight::need::need;
use slowlight_compiler::targets::Target;
use slowlight_compiler::targets::jack;
use slowlight_vm::hack::jack::compile;
use slowlight_vm::hack::vm::{Machine, Program};
use std::path::Path;

const TORUS: &str = include_str!("../../examples/torus.scn");
const PRIMITIVES: &str = include_str!("../../examples/primitives.scn");

/// A table of so many ints, of which a picture shows a few.
fn with_table(entries: usize) -> String {
    let entry = |k: usize| ((k * 31) % 97).to_string();
    let entries: Vec<String> = (0..entries).map(entry).collect();
    format!(
        "image 16 x 2 inks black, white;
         const many = [{}];
         draw (x, y) = ink(many[(x * 577 + y * 31) mod {}, 0] mod 2);",
        entries.join(", "),
        entries.len()
    )
}

/// Words of the heap that are taken when a program has ended, with their headers.
fn taken(machine: &Machine) -> u64 {
    let (mut words, mut segment) = (0, 2048);
    while segment < 16382 {
        let next = machine.peek(segment + 1).cast_unsigned();
        assert!(next > segment, "the list at {segment}");
        if machine.peek(segment) == 0 {
            words += u64::from(next - segment);
        }
        segment = next;
    }
    words
}

/// Every array, number, field and header is counted; no more is.
#[test]
fn a_heap_is_counted_as_the_machine_takes_it() {
    for (target, source, rows) in [
        (&jack::JACK, MIRRORS, (100, 100)),
        (&jack::JACK, PRIMITIVES, (0, 0)),
        (&jack::JACK_F316R, MIRRORS, (100, 100)),
        (&jack::JACK_LOG10, MIRRORS, (7, 7)),
        (&jack::JACK_LOG10, PRIMITIVES, (0, 0)),
        (&jack::JACK_FIXED16, PRIMITIVES, (0, 0)),
    ] {
        counted(target, source, rows);
    }
}

fn counted(target: &'static Target, source: &str, rows: (u32, u32)) {
    let plan = planned_in(target, source, (&[], Some(rows)), true).expect("a plan");
    let documents = documents(&plan);
    let files: Vec<(String, String)> = (documents.iter())
        .map(|d| (d.name.clone(), d.text.clone()))
        .collect();
    let compiled = compile(&files).expect("Jack");
    let files: Vec<_> = compiled.into_iter().map(|f| (f.name, f.text)).collect();
    let program = Program::link(&files).expect("a program");
    let mut machine = Machine::new(&program);
    machine.run(5_000_000_000, &mut |_| true);
    let need = need(&plan).expect("sizes").expect("a heap");
    let heap = need.heap().expect("a heap");
    // What is said of a param out of its range is never needed by one that draws.
    let message = heap.parts.iter().find(|(name, _)| *name == "messages");
    let message = message.map_or(0, |(_, words)| *words);
    let format = target.runtime.format;
    assert_eq!(heap.words - message, taken(&machine), "{format}");
    // Of the examples only rows of errors in logarithms take more than every system has.
    assert!(heap.words <= 14_334, "{format}: {}", heap.words);
    let everywhere = heap.systems == "runs on every operating system";
    assert_eq!(everywhere, heap.words <= 11_500, "{format}: {}", heap.words);
}

/// The torus in logarithms under the official system: the same picture.
#[test]
fn logarithms_fit_the_official_heap() {
    let dir = directory(&[("torus.scn", TORUS)]);
    let dir = dir.path();
    let args = [
        "run",
        "torus.scn",
        "-t",
        "jack",
        "--format",
        "log10",
        "--freeze",
        "all",
        "--rows",
        "120..121",
        "--json",
    ];
    let digest = |more: &[&str]| {
        let found = json(dir, &[&args[..], more].concat());
        assert_eq!(found["differs_from_model"], 0, "{more:?}");
        found["inks_sha256"].clone()
    };
    let usual = digest(&[]);
    assert!(usual.is_string());
    assert_eq!(digest(&["--heap", "official"]), usual);
    assert_eq!(digest(&["--heap", "built-in"]), usual);
}

/// Beyond what every system has it is said which ones have as much; beyond what any has
/// nothing is built.
#[test]
fn a_build_says_which_systems_have_the_heap() {
    let scenes = [100, 12_000, 14_000, 14_400].map(with_table);
    let dir = directory(&[
        ("small.scn", &scenes[0]),
        ("middle.scn", &scenes[1]),
        ("large.scn", &scenes[2]),
        ("huge.scn", &scenes[3]),
    ]);
    let dir = dir.path();
    let build = |scene| {
        [
            "build", scene, "-t", "jack", "--format", "fixed16", "-o", "out",
        ]
    };
    let said = success(dir, &build("small.scn"));
    assert!(said.contains("runs on every operating system"), "{said}");
    let said = success(dir, &build("middle.scn"));
    let needs = "needs the built-in OS of the VM emulator or the web IDE";
    assert!(said.contains(needs), "{said}");
    assert!(said.contains("tables 12,002"), "{said}");
    let heap = &json(dir, &[&build("middle.scn")[..], &["--json"]].concat())["heap"];
    assert_eq!(heap["parts"]["tables"], 12_002);
    assert_eq!(heap["largest"], "the array many");
    assert!(heap["words"].as_u64() > Some(12_002), "{heap}");
    runs_by_heap(dir);
    std::fs::remove_dir_all(dir.join("out")).expect("a directory");
    let output = slowlight(dir, &build("huge.scn"));
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for part in ["of 14,334 words of heap", "largest: the array many, 14,402"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(!dir.join("out").exists(), "nothing is written");
    // The largest that there is room for.
    success(dir, &build("large.scn"));
}

/// What was built last runs with the one heap, and has no room in the other.
fn runs_by_heap(dir: &Path) {
    let run = |heap| slowlight(dir, &["vm", "jack", "out", "--heap", heap]);
    let output = run("built-in");
    assert_eq!(output.status.code(), Some(0));
    let output = run("official");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("Sys.error(6)"), "{said}");
}

#[test]
fn other_machines_have_no_such_heap() {
    let dir = directory(&[
        ("s.scn", &with_table(10)),
        ("p.bas", "10 END\n"),
        ("p.asm", "@0\n0;JMP\n"),
    ]);
    let dir = dir.path();
    success(dir, &["build", "s.scn", "-t", "jack", "-o", "out"]);
    for (args, part) in [
        (&["run", "s.scn", "-t", "bbc:micro"][..], "the Hack VM's"),
        (
            &["run", "s.scn", "-t", "jack", "--os", "jack"],
            "ours in Jack",
        ),
        (&["vm", "jack", "out", "--cpu"], "ours in Jack"),
        (&["vm", "jack", "out", "--os", "jack"], "ours in Jack"),
        (&["vm", "bbc", "p.bas"], "the Hack VM's"),
        (&["vm", "hack", "p.asm"], "the CPU's"),
        (&["vm", "jack", "out", "--os", "unix"], "possible values"),
    ] {
        let output = slowlight(dir, &[args, &["--heap", "official"]].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {said}");
        assert!(said.contains(part), "{args:?}: {said}");
    }
}
