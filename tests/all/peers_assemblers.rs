//! The generated assembly, unchanged, under the real assemblers as its head says.

use crate::cli::{directory, json, slowlight};
use crate::syntaxes::{Program, programs};
use slowlight_compiler::backend::mos6502::document;
use slowlight_compiler::backend::mos6502::syntax;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// The commands that a listing's head quotes for a tool, in backticks.
fn quoted<'a>(listing: &'a str, tool: &str) -> Vec<&'a str> {
    let quotes = listing.lines().filter(|l| l.starts_with(';'));
    let pieces = quotes.flat_map(|l| l.split('`').skip(1).step_by(2));
    pieces.filter(|p| p.starts_with(tool)).collect()
}

/// Runs a command in a directory.
fn run(dir: &Path, command: &str) {
    let mut words = command.split_whitespace();
    let done = Command::new(words.next().expect("a tool"))
        .args(words)
        .current_dir(dir)
        .output()
        .expect("the assemblers are installed: see tests/peers/setup");
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{command}: {said}");
}

/// Assembles every program with an assembler, by its commands, which make the
/// bytes with or without the load address before them.
fn assembles(name: &str, tools: &[&str], file: &str, load_address: bool) {
    let syntax = syntax::find(name).expect("a syntax");
    for Program { plan, usual } in programs() {
        let dir = tempfile::tempdir().expect("a directory");
        let document = document(plan, syntax);
        std::fs::write(dir.path().join(&document.name), &document.text).expect("written");
        for tool in tools {
            let commands = quoted(&document.text, &format!("{tool} "));
            assert_eq!(commands.len(), 1, "{tool}: {commands:?}");
            run(dir.path(), commands[0]);
        }
        let path = dir.path().join(file.replace("NAME", &plan.name));
        let made = std::fs::read(path).expect("the assembler writes");
        let ours = match load_address {
            true => usual.image(),
            false => usual.bytes.clone(),
        };
        assert!(made == ours, "{}: {name} makes other bytes", plan.name);
    }
}

#[test]
fn ca65_makes_the_same_bytes() {
    assembles("ca65", &["ca65", "ld65"], "NAME", false);
}

#[test]
fn tass_makes_the_same_bytes() {
    assembles("64tass", &["64tass"], "NAME.prg", true);
}

#[test]
fn acme_makes_the_same_bytes() {
    assembles("acme", &["acme"], "NAME.prg", true);
}

#[test]
fn dasm_makes_the_same_bytes() {
    assembles("dasm", &["dasm"], "NAME.prg", true);
}

#[test]
fn xa_makes_the_same_bytes() {
    assembles("xa", &["xa"], "NAME", false);
}

/// The same program for three assemblers, with what the bundled one does not read: 43 cycles.
const CA65: &str = "\
.macro inx2
  inx
  inx
.endmacro
.proc main
  ldx #0
@loop:
  inx2
  cpx #8
  bne @loop
.if 1
  lda #0
.else
  lda #1
.endif
  sta $FF0A
.endproc
";
const TASS: &str = "\
* = $2000
inx2 .macro
  inx
  inx
  .endm
main .block
  ldx #0
loop
  #inx2
  cpx #8
  bne loop
.if 1
  lda #0
.else
  lda #1
.endif
  sta $FF0A
  .bend
";
const ACME: &str = "\
* = $2000
!macro inx2 {
  inx
  inx
}
!zone main
  ldx #0
.loop
  +inx2
  cpx #8
  bne .loop
!if 1 {
  lda #0
} else {
  lda #1
}
  sta $FF0A
";

#[test]
fn what_the_bundled_assembler_does_not_read_runs_from_its_binary() {
    let dir = directory(&[("ca65.s", CA65), ("64tass.s", TASS), ("acme.s", ACME)]);
    let dir = dir.path();
    for command in [
        "ca65 -o ca65.o ca65.s",
        "ld65 -t none -S 0x2000 -o ca65 ca65.o",
        "64tass -o 64tass.prg 64tass.s",
        "acme -f cbm -o acme.prg acme.s",
    ] {
        run(dir, command);
    }
    for args in [
        &["ca65", "--at", "0x2000"][..],
        &["64tass.prg"],
        &["acme.prg"],
    ] {
        let said = json(dir, &[&["vm", "6502"][..], args, &["--json"]].concat());
        assert_eq!(said["cycles"], 43, "{args:?}");
    }
    for source in ["ca65.s", "64tass.s", "acme.s"] {
        let refused = slowlight(dir, &["vm", "6502", source]);
        assert_eq!(refused.status.code(), Some(1), "{source}");
        let said = String::from_utf8_lossy(&refused.stderr);
        assert!(said.contains("is not read"), "{said}");
    }
}

/// What `build --labels` says of a program's names is what ca65 and ld65 make of its source.
#[test]
fn ca65_has_our_labels_at_their_addresses() {
    let dir = directory(&[("ball.scn", include_str!("../scenes/ball.scn"))]);
    let dir = dir.path();
    let labels = |name: &str| -> BTreeMap<String, u32> {
        let text = std::fs::read_to_string(dir.join(name)).expect("labels");
        let entries = text.lines().filter_map(|line| {
            let (at, name) = line.strip_prefix("al ")?.split_once(" .")?;
            let at = u32::from_str_radix(at.trim_start_matches("C:"), 16).ok()?;
            Some((name.to_owned(), at))
        });
        entries.collect()
    };
    for target in ["6502:plain", "6502:bbc", "6502:c64"] {
        let build = ["build", "ball.scn", "-t", target, "--labels", "vice"];
        assert!(slowlight(dir, &build).status.success());
        let listing = std::fs::read_to_string(dir.join("ball.asm")).expect("a source");
        run(
            dir,
            &quoted(&listing, "ca65 ")[0].replacen("ca65 ", "ca65 -g ", 1),
        );
        run(
            dir,
            &format!("{} -Ln real.lbl", quoted(&listing, "ld65 ")[0]),
        );
        let (ours, real) = (labels("ball.vs"), labels("real.lbl"));
        // The linker adds names of its own.
        let real: Vec<_> = real
            .iter()
            .filter(|(name, _)| !name.starts_with("__"))
            .collect();
        assert!(real.len() > 50, "{}", real.len());
        for (name, at) in real {
            assert_eq!(ours.get(name), Some(at), "{target}: {name}");
        }
    }
}
