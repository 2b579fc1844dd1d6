//! Programs for the Commodore 64 on c64py's, whose video chip asks for the bus as VICE's
//! does: `tests/peers/setup` installs it, `tests/peers/c64.py` drives it. It has no ROMs
//! here, and the programs need none until a key is pressed.

use crate::boxes::waves;
use crate::cli::{directory, json, success};
use crate::peers_boxes::pgm;
use crate::peers_jsbeeb::unhex;
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// How much more cycles ours may be, in parts of one.
const MOST: f64 = 0.01;

fn c64py(program: &Path) -> Value {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = Command::new("python3")
        .arg(root.join("tests/peers/c64.py"))
        .arg(root.join("target/peers/python"))
        .arg(program)
        .output()
        .expect("python3 is installed: see tests/peers/setup");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    serde_json::from_slice(&output.stdout).expect("results are JSON")
}

#[test]
fn another_c64_draws_the_same() {
    let dir = directory(&[("scene.scn", &waves(37, 23))]);
    for (mode, bits, d016) in [("hires", 1, 0xC8), ("multicolour", 2, 0xD8)] {
        let of = ["scene.scn", "-t", "6502:c64", "--mode", mode];
        let run = ["run", "--json", "-o", "scene.pgm"];
        let said = json(dir.path(), &[&run[..], &of[..]].concat());
        assert_eq!(said["differs_from_model"], 0);
        success(dir.path(), &[&["build"], &of[..]].concat());
        let theirs = c64py(&dir.path().join("scene.prg"));
        assert_eq!(theirs["ended"], true);

        let register = |name: &str| theirs["registers"][name].as_u64().expect("a register");
        // A bitmap that is seen, at $E000, its colours at $CC00, in the upper 16K.
        let found = ["0xd011", "0xd016", "0xd018", "0xdd00"].map(register);
        assert_eq!(
            [found[0], found[1], found[2], found[3] & 3],
            [0x3B, d016, 0x38, 0]
        );
        let memory = unhex(theirs["memory"].as_str().expect("memory"));
        let ((width, height), inks) =
            pgm(&std::fs::read(dir.path().join("scene.pgm")).expect("a file"));
        let offset = |k: usize| said["offset"][k].as_u64().expect("a number") as usize;
        let (left, top) = (offset(0), offset(1));
        let (columns, pixels) = (320 / bits, 8 / bits);
        for y in 0..200 {
            for x in 0..columns {
                let byte = memory[0xE000 + y / 8 * 320 + x / pixels * 8 + y % 8];
                let ink = byte >> (8 - bits - x % pixels * bits) & ((1 << bits) - 1);
                let inside = (left..left + width).contains(&x) && (top..top + height).contains(&y);
                let expected = match inside {
                    true => inks[(y - top) * width + x - left],
                    false => 0,
                };
                assert_eq!(ink, expected, "{mode}: ({x}, {y})");
            }
        }
        // All characters have the same colours.
        let colours = &memory[0xCC00..0xCC00 + 1000];
        assert!(
            colours
                .iter()
                .all(|pair| *pair == colours[0] && pair >> 4 != pair & 15)
        );

        let cycles = said["cycles"].as_f64().expect("cycles");
        let excess = cycles / theirs["cycles"].as_f64().expect("cycles") - 1.0;
        println!(
            "{mode}: {} cycles, ours {:+.2}%",
            theirs["cycles"],
            100.0 * excess
        );
        assert!(excess.abs() <= MOST, "{mode}: {excess}");
    }
}
