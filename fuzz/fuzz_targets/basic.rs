//! Any bytes as a BASIC program: as text, as tokens where they are lines, and as the body of one
//! line each, on every dialect, for two million cycles.
//!
//! What is held: no panic, no hang (`-timeout`), no unbounded memory (`-rss_limit_mb`).
#![no_main]

use libfuzzer_sys::fuzz_target;
use slowlight_vm::bbc::{Config, Dialect, Machine, detokenise, tokenise};

const CYCLES: u64 = 2_000_000;

fn run(dialect: Dialect, bytes: &[u8]) {
    let mut machine = Machine::new(Config { dialect, page: 0x1900 });
    if machine.load_tokenised(bytes).is_ok() {
        let run = machine.run(CYCLES, &mut |_| true);
        assert!(run.free_bytes < 0x10000);
    }
}

/// A line of each run of bytes between carriage returns.
fn lines(bytes: &[u8]) -> Vec<u8> {
    let mut program = Vec::new();
    for (k, body) in bytes.split(|b| *b == 13).take(200).enumerate() {
        let body = &body[..body.len().min(251)];
        program.extend([13, 0, k as u8, body.len() as u8 + 4]);
        program.extend(body);
    }
    program.extend([13, 255]);
    program
}

fuzz_target!(|bytes: &[u8]| {
    let Some((first, rest)) = bytes.split_first() else {
        return;
    };
    let dialect = [Dialect::Micro, Dialect::Agon, Dialect::BasicV][usize::from(*first) % 3];
    run(dialect, rest);
    run(dialect, &lines(rest));
    if let Ok(tokens) = tokenise(&String::from_utf8_lossy(rest), dialect) {
        run(dialect, &tokens);
    }
    let _ = detokenise(rest);
});
