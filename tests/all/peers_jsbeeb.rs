//! The genuine BASIC II, under jsbeeb: `tests/peers/setup` installs it, `tests/peers/jsbeeb.mjs`
//! drives it.

use crate::rom_vectors::{Gives, OPERATIONS, Operands, Operation, error_bytes};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

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

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|b| format!("{b:02x}")).collect()
}

fn unhex(text: &str) -> Vec<u8> {
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
                json!([[0x404, hex(&a.to_le_bytes())], [0x408, hex(&b.to_le_bytes())]])
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
        assert!(kept == bytes, "{}: the ROM gives something else", operation.name);
    }
}
