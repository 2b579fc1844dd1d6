//! Programs for the 6502 that any assembler made, and discs, by the command line.

use crate::cli::{STEPS, directory, json, names, slowlight, success};
use std::path::Path;

/// Opens a picture of 2 x 1 pixels in two inks, draws ink 1, then ink 0, and ends; by hand:
/// LDA #2, STA $FF00, LDA #1, STA $FF02, LDA #2, STA $FF04, LDA #1, STA $FF09,
/// LDA #0, STA $FF09, STA $FF0A.
const DRAWS: [u8; 28] = [
    0xA9, 2, 0x8D, 0x00, 0xFF, 0xA9, 1, 0x8D, 0x02, 0xFF, 0xA9, 2, 0x8D, 0x04, 0xFF, 0xA9, 1, 0x8D,
    0x09, 0xFF, 0xA9, 0, 0x8D, 0x09, 0xFF, 0x8D, 0x0A, 0xFF,
];
/// Cycles of that: five loads of 2, six stores of 4.
const CYCLES: u64 = 34;

fn write(dir: &Path, name: &str, bytes: &[u8]) {
    std::fs::write(dir.join(name), bytes).expect("written");
}

/// How a command ends, and what it says of an error.
fn fails(dir: &Path, args: &[&str]) -> (i32, String) {
    let output = slowlight(dir, args);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code().unwrap_or(-1), said)
}

#[test]
fn binaries_run_where_they_are_put() {
    let dir = directory(&[]);
    let dir = dir.path();
    write(dir, "plain.bin", &DRAWS);
    write(dir, "whole.prg", &[&[0x34, 0x12][..], &DRAWS[..]].concat());
    // Three bytes of data in front.
    write(dir, "data.o65", &[&[0, 0, 0][..], &DRAWS[..]].concat());
    for args in [
        &["plain.bin", "--at", "0x2000"][..],
        &["plain.bin", "--at", "$C000", "--start", "&C000"],
        &["plain.bin", "--at", "512"],
        &["whole.prg"],
        &["data.o65", "--at", "$4FFD", "--start", "20480"],
    ] {
        let drawn = ["--json", "-o", "drawn.pgm"];
        let said = json(dir, &[&["vm", "6502"][..], args, &drawn].concat());
        assert_eq!(said["cycles"], CYCLES, "{args:?}");
        let picture = std::fs::read(dir.join("drawn.pgm")).expect("a picture");
        assert!(picture.ends_with(&[1, 0]), "{args:?}");
    }
    for (args, status, said) in [
        (&["plain.bin"][..], 2, "--at ADDR"),
        (
            &["plain.bin", "--at", "65530"],
            1,
            "the ports begin at $FF00",
        ),
        (
            &["plain.bin", "--at", "512", "--start", "0xFFF0"],
            1,
            "no program begins at $FFF0",
        ),
        (&["plain.bin", "--at", "2000h"], 2, "hexadecimal"),
        (&["whole.prg", "--at", "512"], 2, "leave --at out"),
    ] {
        let (code, message) = fails(dir, &[&["vm", "6502"][..], args].concat());
        assert_eq!(code, status, "{args:?}: {message}");
        assert!(message.contains(said), "{args:?}: {message}");
    }
    let (code, message) = fails(dir, &["vm", "bbc", "plain.bin", "--at", "512"]);
    assert_eq!(code, 2, "{message}");
    assert!(message.contains("the 6502's"));
}

#[test]
fn what_ca65_made_runs() {
    // Of a macro, a scope, a local label and a condition: LDX #0, four times INX, INX,
    // CPX #8, BNE, then LDA #0, STA $FF0A.
    let made = [
        0xA2, 0, 0xE8, 0xE8, 0xE0, 8, 0xD0, 0xFA, 0xA9, 0, 0x8D, 0x0A, 0xFF,
    ];
    let dir = directory(&[]);
    write(dir.path(), "game", &made);
    let said = json(
        dir.path(),
        &["vm", "6502", "game", "--at", "$2000", "--json"],
    );
    assert_eq!(said["cycles"], 43);
}

#[test]
fn a_commodores_programs_begin_where_their_line_says() {
    let dir = directory(&[]);
    let dir = dir.path();
    // 10 SYS 2061 and a program that writes HI; the same entered behind the H.
    let line = [1, 8, 11, 8, 10, 0, 158, 50, 48, 54, 49, 0, 0, 0];
    let code = [0xA9, 72, 0x20, 0xD2, 0xFF, 0xA9, 73, 0x20, 0xD2, 0xFF, 0x60];
    write(dir, "hi.prg", &[&line[..], &code].concat());
    for (args, text) in [
        (&["hi.prg"][..], "hi"),
        (&["hi.prg", "--start", "2066"], "i"),
    ] {
        let output = slowlight(dir, &[&["vm", "6502:c64"][..], args].concat());
        assert_eq!(String::from_utf8_lossy(&output.stdout), text, "{args:?}");
    }
}

#[test]
fn text_never_runs_as_machine_code() {
    let dir = directory(&[
        ("ends.a", "* = $2000\n lda #0\n sta $FF0A\n"),
        ("ends.prg", "* = $3000\n nop\n lda #0\n sta $FF0A\n"),
        ("prose.txt", "A text, and no program.\n"),
        ("none.bin", ""),
        (
            "ca65.s",
            ".org $4000\n.macro twice\n iny\n.endmacro\n.proc main\n@again: dey\n bne @again\n",
        ),
    ]);
    let dir = dir.path();
    assert_eq!(json(dir, &["vm", "6502", "ends.a", "--json"])["cycles"], 6);
    assert_eq!(
        json(dir, &["vm", "6502", "ends.prg", "--json"])["cycles"],
        8
    );
    // Begun behind the `nop`.
    let later = ["vm", "6502", "ends.prg", "--start", "$3001", "--json"];
    assert_eq!(json(dir, &later)["cycles"], 6);
    for (args, status, said) in [
        (&["prose.txt"][..], 1, "the assembler refuses prose.txt"),
        (&["ends.a", "--at", "512"], 2, "--at is for binaries"),
        (&["none.bin"], 1, "no bytes"),
        (&["ca65.s"], 1, "1:1: `.org` is not read: an origin"),
        (&["ca65.s"], 1, "2:1: `.macro` is not read: a macro"),
        (&["ca65.s"], 1, "5:1: `.proc` is not read: a scope"),
        (
            &["ca65.s"],
            1,
            "6:1: `@again` is not read: a cheap local label",
        ),
        (
            &["ca65.s"],
            1,
            "slowlight vm 6502 FILE --at ADDR --start ADDR",
        ),
    ] {
        let (code, message) = fails(dir, &[&["vm", "6502"][..], args].concat());
        assert_eq!(code, status, "{args:?}: {message}");
        assert!(message.contains(said), "{args:?}: {message}");
    }
}

#[test]
fn discs_that_are_built_run() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let dir = dir.path();
    let build = ["build", "steps.scn", "-t", "6502:bbc", "-o", "out"];
    success(dir, &[&build[..], &["--format", "fixed16"]].concat());
    assert_eq!(
        names(&dir.join("out")),
        ["steps.asm", "steps.prg", "steps.ssd"]
    );
    let run = |file: &str| json(dir, &["vm", "6502:bbc", file, "--json"]);
    let source = run("out/steps.asm");
    assert_eq!(run("out/steps.ssd"), source);
    assert_eq!(run("out/steps.prg"), source);
    // In memory that a disc system has: loaded above it.
    let low = [
        "build",
        "steps.scn",
        "-t",
        "6502:bbc",
        "-o",
        "low",
        "--page",
        "E00",
    ];
    success(dir, &low);
    assert_eq!(run("low/steps.ssd"), run("low/steps.asm"));
    assert_eq!(run("low/steps.prg"), run("low/steps.asm"));
    // A disc that is cut off, one of BASIC's, one for another machine.
    let mut disc = std::fs::read(dir.join("out/steps.ssd")).expect("a disc");
    disc.truncate(1000);
    write(dir, "cut.ssd", &disc);
    write(dir, "two.dsd", &disc);
    success(dir, &["build", "steps.scn", "-t", "bbc", "-o", "basic"]);
    for (args, status, said) in [
        (&["6502:bbc", "cut.ssd"][..], 1, "the image ends within"),
        (&["6502:bbc", "two.dsd"], 1, "two sides"),
        (&["6502:bbc", "basic/steps.ssd"], 1, "!BOOT types"),
        (&["6502:c64", "out/steps.ssd"], 2, "vm 6502:bbc"),
    ] {
        let (code, message) = fails(dir, &[&["vm"][..], args].concat());
        assert_eq!(code, status, "{args:?}: {message}");
        assert!(message.contains(said), "{args:?}: {message}");
    }
}
