//! The genuine BASIC II, under jsbeeb: `tests/peers/setup` installs it, `tests/peers/jsbeeb.mjs`
//! drives it.

use crate::cli::{directory, success};
use crate::refine;
use crate::rom_operations::{Gives, OPERATIONS, Operands, Operation, error_bytes};
use serde_json::{Value, json};
use slowlight_vm::Stop;
use slowlight_vm::bbc::{Config, Machine, Run};
use std::path::Path;
use std::process::{Command, Stdio};

/// Runs jobs (see the driver for what they are).
pub fn jsbeeb(jobs: &[Value]) -> Vec<Value> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let dir = tempfile::tempdir().expect("a directory");
    let file = dir.path().join("jobs.json");
    std::fs::write(&file, Value::from(jobs).to_string()).expect("a file");
    let output = Command::new("node")
        .arg(root.join("tests/peers/jsbeeb.mjs"))
        .arg(root.join("target/peers/node_modules/jsbeeb"))
        .arg(&file)
        .stderr(if jobs.iter().any(|job| job.get("tell").is_some()) {
            Stdio::inherit()
        } else {
            Stdio::piped()
        })
        .output()
        .expect("node is installed: see tests/peers/setup");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let results = serde_json::from_slice(&output.stdout).expect("results are JSON");
    assert!(matches!(&results, Value::Array(list) if list.len() == jobs.len()));
    match results {
        Value::Array(list) => list,
        _ => Vec::new(),
    }
}

pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|b| format!("{b:02x}")).collect()
}

pub fn unhex(text: &str) -> Vec<u8> {
    let digits = text.as_bytes().chunks(2);
    digits
        .map(|d| u8::from_str_radix(&String::from_utf8_lossy(d), 16).expect("hex"))
        .collect()
}

/// The ROM's results of an operation. Variables start at &4000: link, end of name, value.
fn rom(operation: &Operation) -> Vec<Vec<u8>> {
    const A: u16 = 0x4003;
    const B: u16 = 0x400b;
    const C: u16 = 0x4013;
    let cases: Vec<Value> = operation
        .cases()
        .iter()
        .map(|case| match case {
            Operands::Reals(a, b) => json!([[A, hex(&a.to_bytes())], [B, hex(&b.to_bytes())]]),
            Operands::Ints(a, b) => {
                json!([
                    [0x404, hex(&a.to_le_bytes())],
                    [0x408, hex(&b.to_le_bytes())]
                ])
            }
            Operands::Text(text) => json!([[0x5000, hex(format!("{text}\r").as_bytes())]]),
        })
        .collect();
    let program = format!(
        "1LOMEM=&4000\n10ON ERROR ?&71=ERR:?&70=3:GOTO 40\n20A=0:B=0:C=0\n\
         40REPEAT\n50?&70=1\n60{}\n70?&70=2\n80UNTIL0\n",
        operation.statement
    );
    let read = match operation.gives {
        Gives::Real => json!([C, 5]),
        Gives::Int => json!([0x40c, 4]),
        Gives::Text => json!([0x5100, 32]),
    };
    let job = json!({"typed": program, "cases": cases, "read": read, "quiet": true});
    let result = jsbeeb(&[job]).remove(0);
    let answers = result["cases"].as_array().expect("answers");
    assert_eq!(answers.len(), cases.len(), "{}", operation.name);
    answers
        .iter()
        .map(|answer| match &answer[0] {
            Value::String(text) => {
                let bytes = unhex(text);
                match operation.gives {
                    Gives::Text => bytes.split(|b| *b == 13).next().unwrap_or(&[]).to_vec(),
                    _ => bytes,
                }
            }
            number => error_bytes(operation.gives, number.as_u64().unwrap_or(0) as u8),
        })
        .collect()
}

/// With UPDATE_ROM_VECTORS=1 in the environment, writes the files instead.
#[test]
fn the_recorded_results_are_the_roms() {
    let update = std::env::var_os("UPDATE_ROM_VECTORS").is_some();
    for operation in OPERATIONS {
        let results = rom(operation);
        let separator: &[u8] = match operation.gives {
            Gives::Text => b"\r",
            _ => b"",
        };
        let bytes = results.join(separator);
        if update {
            std::fs::write(operation.file(), &bytes).expect("a file");
        }
        let kept = std::fs::read(operation.file()).expect("recorded results");
        assert!(
            kept == bytes,
            "{}: the ROM gives something else",
            operation.name
        );
    }
}

/// Our machine on the same text.
fn ours(text: &str) -> Run {
    ours_at(Config::default().page, text)
}

fn ours_at(page: u16, text: &str) -> Run {
    let mut machine = Machine::new(Config {
        page,
        ..Config::default()
    });
    machine.load_text(text).expect("a program");
    let run = machine.run(100_000_000_000, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended, "{text}");
    run
}

/// How much more we count than the ROM takes, in parts of one. What RUN and the prompt take is
/// taken off by way of an empty program.
fn excess(ours: u64, rom: &Value, empty: (u64, u64)) -> f64 {
    let rom = rom["cycles"].as_u64().expect("cycles") - empty.1;
    (ours - empty.0) as f64 / rom as f64 - 1.0
}

const EMPTY: &str = "10END\n";

/// Printed text without control codes but line feeds, and without the prompt.
fn printed(result: &Value) -> String {
    let text = result["text"].as_str().expect("text");
    let kept = text.chars().filter(|c| *c == '\n' || *c >= ' ');
    kept.collect::<String>()
        .trim_end_matches('>')
        .trim_end()
        .to_owned()
}

#[test]
fn other_programs_take_and_print_what_they_do_on_the_rom() {
    let programs = [
        ("strings", include_str!("../peers/programs/strings.bas")),
        ("sieve", include_str!("../peers/programs/sieve.bas")),
        ("proc", include_str!("../peers/programs/proc.bas")),
        ("data", include_str!("../peers/programs/data.bas")),
        ("plot", include_str!("../peers/programs/plot.bas")),
    ];
    let texts = programs.iter().map(|p| p.1).chain([EMPTY]);
    let jobs: Vec<Value> = texts.map(|text| json!({"typed": text})).collect();
    let results = jsbeeb(&jobs);
    let empty = (
        ours(EMPTY).cycles,
        results[5]["cycles"].as_u64().expect("cycles"),
    );
    for ((name, text), result) in programs.iter().zip(&results) {
        assert_eq!(result["stopped"], "prompt", "{name}");
        let run = ours(text);
        let excess = excess(run.cycles, result, empty);
        println!(
            "{name}: {} cycles, {:+.2}% of the ROM's",
            run.cycles,
            100.0 * excess
        );
        assert!(excess.abs() <= 0.03, "{name}: {excess}");
        // PLOT's bytes go through the same vector as text.
        if *name != "plot" {
            assert_eq!(run.text.trim_end(), printed(result), "{name}");
        }
    }
}

/// A screen's modes here: where its memory starts, bytes a row, pixels a byte.
pub fn layout(mode: u32) -> (usize, usize, usize) {
    match mode {
        0 => (0x3000, 80, 8),
        1 => (0x3000, 80, 4),
        2 => (0x3000, 80, 2),
        5 => (0x5800, 40, 4),
        _ => (0x5800, 40, 8),
    }
}

/// The inks of a screen, from its memory.
pub fn inks(mode: u32, memory: &[u8]) -> Vec<u8> {
    let (_, row, pixels) = layout(mode);
    let mut list = Vec::new();
    for y in 0..256 {
        for x in 0..row * pixels {
            let byte = memory[y / 8 * row * 8 + x / pixels * 8 + y % 8];
            let bit = |b: usize| byte >> (7 - (x % pixels) - b * pixels) & 1;
            list.push((0..8 / pixels).fold(0, |ink, b| ink << 1 | bit(b)));
        }
    }
    list
}

/// What `slowlight build` writes of a scene.
struct Written {
    text: String,
    tokens: Vec<u8>,
    disc: Vec<u8>,
}

fn build(scene: &str, options: &[&str]) -> Written {
    let dir = directory(&[("scene.scn", scene)]);
    let args = [&["build", "scene.scn", "--target", "bbc:micro"], options].concat();
    success(dir.path(), &args);
    let read = |name: &str| std::fs::read(dir.path().join(name)).expect("a file");
    Written {
        text: String::from_utf8(read("scene.bas")).expect("a program"),
        tokens: read("scene.bbc"),
        disc: read("scene.ssd"),
    }
}

/// Inks in which the ROM's screen differs from ours. BASIC's prompt is written over the first
/// row of text.
fn different_inks(mode: u32, rom: &Value, ours: &Run) -> usize {
    assert_eq!(rom["stopped"], "prompt");
    let memory = unhex(rom["memory"].as_str().expect("memory"));
    let rom = inks(mode, &memory[memory.len() - (0x8000 - layout(mode).0)..]);
    let ours = &ours.screen.pixels;
    assert_eq!(rom.len(), ours.len());
    assert!(ours.iter().any(|ink| *ink != ours[0]));
    let pairs = rom.iter().zip(ours).skip(rom.len() / 32);
    pairs.filter(|(a, b)| a != b).count()
}

/// A scene by some options, typed and as tokens, on the ROM and on ours: inks that differ, and
/// cycles.
fn compared(scene: &str, mode: u32, options: &[&str]) -> (usize, f64) {
    let mode_option = mode.to_string();
    let written = build(scene, &[&["--mode", &mode_option], options].concat());
    let dump = json!([layout(mode).0, 0x8000]);
    // Where it begins, as its first line says.
    let first = written.text.lines().next().unwrap_or_default();
    let page = match first.contains(" at PAGE &E00") {
        true => 0xe00,
        false => Config::default().page,
    };
    let results = jsbeeb(&[
        json!({"typed": written.text, "page": page, "dump": dump}),
        json!({"tokenised": hex(&written.tokens), "page": page, "dump": dump}),
        json!({"typed": EMPTY}),
    ]);
    let run = ours_at(page, &written.text);
    let empty = (
        ours(EMPTY).cycles,
        results[2]["cycles"].as_u64().expect("cycles"),
    );
    let different = results[..2]
        .iter()
        .map(|result| different_inks(mode, result, &run))
        .sum();
    (different, excess(run.cycles, &results[1], empty))
}

/// At both PAGEs; at &E00 the disc's program moves itself down first.
#[test]
fn discs_boot_and_typed_programs_have_our_tokens() {
    let mirrors = include_str!("../../examples/mirrors.scn");
    for page in [0x1900, 0xe00] {
        let written = build(
            mirrors,
            &["--rows", "140..141", "--page", &format!("{page:X}")],
        );
        let dump = json!([page, 0x8000]);
        let results = jsbeeb(&[
            json!({"disc": hex(&written.disc), "dump": dump}),
            json!({"typed": written.text, "page": page, "dump": dump}),
        ]);
        let run = ours_at(page, &written.text);
        for result in &results {
            assert_eq!(different_inks(1, result, &run), 0, "PAGE &{page:X}");
            let memory = unhex(result["memory"].as_str().expect("memory"));
            assert_eq!(memory[..written.tokens.len()], written.tokens);
        }
    }
}

/// The whole picture of mirrors with some options, tokens put at PAGE: prints what the ROM
/// takes. Without plotting there are no inks to compare.
fn whole(what: &str, page: u16, options: &[&str]) {
    let mirrors = include_str!("../../examples/mirrors.scn");
    let written = build(mirrors, options);
    let job = json!({
        "tokenised": hex(&written.tokens),
        "page": page,
        "dump": [layout(1).0, 0x8000],
        "limit": 40_000_000_000u64,
        "tell": 500_000_000,
    });
    let results = jsbeeb(&[job, json!({"typed": EMPTY})]);
    let run = ours_at(page, &written.text);
    let empty = (
        ours(EMPTY).cycles,
        results[1]["cycles"].as_u64().expect("cycles"),
    );
    let excess = excess(run.cycles, &results[0], empty);
    let different = match options.contains(&"--no-plot") {
        true => 0,
        false => different_inks(1, &results[0], &run),
    };
    println!(
        "{what}: the ROM's cycles {}, ours {} ({:+.2}%), {different} inks differ",
        results[0]["cycles"],
        run.cycles,
        100.0 * excess
    );
    assert_eq!(results[0]["stopped"], "prompt");
    assert_eq!(different, 0);
    assert!(excess.abs() <= 0.03, "{excess}");
}

/// Five minutes or so.
#[test]
#[ignore = "long; says how far it is with --nocapture"]
fn a_whole_picture_of_mirrors() {
    whole("params live", 0x1900, &[]);
    whole("params folded", 0x1900, &["--freeze", "all"]);
    let computed = [
        "--freeze",
        "all",
        "--page",
        "E00",
        "--no-plot",
        "--rows",
        "9..239",
    ];
    whole(
        "params folded, rows 9 to 239, computed only",
        0xe00,
        &computed,
    );
}

#[test]
fn generated_programs_draw_and_take_what_they_do_on_the_rom() {
    let mirrors = include_str!("../../examples/mirrors.scn");
    let torus = include_str!("../../examples/torus.scn");
    let maze = include_str!("../../examples/maze.scn");
    let disc = refine::disc(64, 43);
    for (name, scene, mode, options) in [
        ("mirrors", mirrors, 1, &["--rows", "120..121"][..]),
        ("torus", torus, 4, &["--rows", "60..60"]),
        ("maze", maze, 2, &["--rows", "14..17"]),
        ("disc", &disc, 2, &["--refine", "8", "--rows", "2..41"]),
    ] {
        let (different, excess) = compared(scene, mode, options);
        println!(
            "{name}, {options:?}: {different} inks differ, cycles {:+.2}%",
            100.0 * excess
        );
        assert_eq!(different, 0, "{name}");
        assert!(excess.abs() <= 0.03, "{name}: {excess}");
    }
}
