//! Cartridges on Stella, the emulator of the Atari VCS: what it shows is what our machine does,
//! pixel by pixel. `tests/peers/setup` installs it, `tests/peers/stella.py` drives it.

use crate::cli::directory;
use slowlight_vm::keys::{Keyboard, Unit};
use slowlight_vm::mos6502::{Machine, Vcs, assemble};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Lines of picture in the middle of a frame.
const LINES: usize = 192;

/// A bank of 4K: a frame whose picture is `kernel`, which begins with the first cycle of a line
/// and takes so many of them, each ended by a store to WSYNC; X is 192 at first. `table` are the
/// 250 bytes at $FF00. The first of all bytes makes it none with a Superchip.
fn bank(system: u32, kernel: &str, table: impl Fn(usize) -> u8) -> Vec<u8> {
    let (above, below) = match system {
        262 => (37, 30),
        _ => (45, 72),
    };
    let wait = |label: &str, lines: usize| {
        format!(" ldx #{lines}\n{label}: sta $02\n dex\n bne {label}\n")
    };
    let text = format!(
        "* = $F000\n .byte 1\n .res 255\nstart: sei\n cld\n ldx #255\n txs\nframe: lda #2\n sta $01\n sta $02\n \
         sta $00\n sta $02\n sta $02\n lda #0\n sta $02\n sta $00\n{}\
         lda #0\n sta $01\n ldx #{LINES}\n lda #$1A\n sta $08\n lda #$64\n sta $09\n lda #$C8\n \
         sta $06\n lda #$36\n sta $07\n lda #0\n sta $0D\n sta $0E\n sta $0F\n sta $0A\n sta $02\n\
         {kernel} lda #2\n sta $01\n{} jmp frame\n",
        wait("above", above - 1),
        wait("below", below - 1),
    );
    let length = assemble(&text).expect("a program").bytes.len();
    let bytes: Vec<String> = (0..250).map(|at| table(at).to_string()).collect();
    let text = format!(
        "{text} .res {}\n .byte {}\n .word start, start, start\n",
        0xF00 - length,
        bytes.join(", ")
    );
    assemble(&text).expect("a program").bytes
}

fn noise(at: usize) -> u8 {
    (at * at * 5 + at * 73 + at / 7) as u8
}

/// What Stella shows: rows of 160 colours.
fn stella(dir: &Path, cartridge: &Path, kind: &str) -> Vec<Vec<String>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = Command::new("python3")
        .arg(root.join("tests/peers/stella.py"))
        .args([dir, cartridge])
        .arg(kind)
        .output()
        .expect("python3 is installed: see tests/peers/setup");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{kind}: {said}");
    let text = String::from_utf8(output.stdout).expect("text");
    let row = |line: &str| {
        let pixels = line.as_bytes().chunks(6);
        pixels
            .map(|p| String::from_utf8_lossy(p).into_owned())
            .collect()
    };
    text.lines().map(row).collect()
}

/// How many pixels differ at best, wherever Stella's screen has the picture: each of our
/// colours must be one of its.
fn differ(ours: &[&[u8]], theirs: &[Vec<String>]) -> usize {
    let at = |top: usize| {
        let mut colours: BTreeMap<u8, &str> = BTreeMap::new();
        let rows = ours.iter().zip(&theirs[top..]);
        let pixels = rows.flat_map(|(our, their)| our.iter().zip(their));
        pixels
            .filter(|(our, their)| *colours.entry(**our).or_insert(their) != their.as_str())
            .count()
    };
    let tops = 0..theirs.len() - ours.len();
    tops.map(at).min().expect("a place")
}

fn same(name: &str, kind: &str, system: u32, rom: &[u8]) {
    let dir = directory(&[]);
    let file = dir.path().join(format!("{name}.bin"));
    std::fs::write(&file, rom).expect("a file");
    let mut machine = Vcs::new();
    machine.load_at(0xF000, rom, None).expect("a cartridge");
    let script = "wait 9 quit".parse().expect("a script");
    machine.plug(Keyboard::new(script, Unit::Frames, |_| None));
    machine.run(1_000_000, &mut |_| true);
    assert_eq!(machine.frames(), vec![system; 9], "{name}");
    let first = if system == 262 { 40 } else { 48 };
    let ours: Vec<&[u8]> = machine
        .lines()
        .chunks(160)
        .skip(first)
        .take(LINES)
        .collect();
    let kinds = ours.concat();
    let colours: std::collections::BTreeSet<&u8> = kinds.iter().collect();
    assert!(colours.len() > 1, "{name}: nothing is drawn");
    let theirs = stella(dir.path(), &file, kind);
    assert_eq!(differ(&ours, &theirs), 0, "{name}");
}

/// Lines in which a store comes later and later.
fn late(register: u8, values: [u8; 2]) -> String {
    let lines = (0..LINES).map(|line| {
        let before = 2 + line % 60;
        let wait = match before % 2 {
            1 => format!(" bit $80\n{}", " nop\n".repeat((before - 3) / 2)),
            _ => " nop\n".repeat(before / 2),
        };
        let [first, then] = values;
        format!(" lda #{first}\n sta ${register:02X}\n lda #{then}\n{wait} sta ${register:02X}\n sta $02\n")
    });
    // A bank has no room for all of them.
    let lines: Vec<String> = lines.take(60).collect();
    format!(
        "{} ldx #{}\nrest: sta $02\n dex\n bne rest\n",
        lines.concat(),
        LINES - 60
    )
}

#[test]
fn stella_shows_the_same_pictures() {
    // Every register of the playfield twice a line, and how it is shown.
    let written = "lines: stx $09\n lda $FF00,x\n sta $0A\n sta $0D\n asl\n sta $0E\n eor #$5A\n \
                   sta $0F\n nop\n lda $FF01,x\n sta $0D\n nop\n eor #$3C\n sta $0E\n txa\n \
                   sta $0F\n sta $02\n dex\n bne lines\n";
    same("playfield", "4K", 312, &bank(312, written, noise));
    same("playfield-ntsc", "4K", 262, &bank(262, written, noise));
    let set = " lda #$A5\n sta $0D\n sta $0E\n sta $0F\n";
    for (name, register, values, set_up) in [
        ("pf0", 0x0D, [0, 255], ""),
        ("pf1", 0x0E, [0, 255], ""),
        ("pf2", 0x0F, [255, 0], ""),
        ("background", 0x09, [0x44, 0x98], ""),
        ("reflect", 0x0A, [0, 1], set),
        ("blank", 0x01, [0, 2], set),
    ] {
        let kernel = format!("{set_up}{} lda #0\n sta $01\n", late(register, values));
        same(name, "4K", 262, &bank(262, &kernel, noise));
    }
}

#[test]
fn stella_counts_the_same_time() {
    // The timer as a colour, three times a line: by every interval, and past 0.
    for (register, start) in [
        (0x294, 200),
        (0x295, 90),
        (0x296, 40),
        (0x296, 3),
        (0x297, 5),
    ] {
        let kernel = format!(
            " lda #{start}\n sta ${register:04X}\nlines: lda $0284\n sta $09\n lda $0285\n sta $0E\n \
             nop\n nop\n lda $0284\n sta $09\n lda $0284\n sta $08\n lda $0285\n sta $0F\n lda $0284\n \
             sta $02\n sta $09\n dex\n bne lines\n"
        );
        let name = format!("timer-{register:x}-{start}");
        same(&name, "4K", 312, &bank(312, &kernel, noise));
    }
}

#[test]
fn stella_has_the_same_banks() {
    for (kind, banks, spot) in [("F8", 2, 0xFFF8u16), ("F6", 4, 0xFFF6), ("F4", 8, 0xFFF4)] {
        // All banks have the same program, and tables of their own.
        let read = (0..3).map(|k| {
            let at = spot + k * 5 % banks;
            let into = [0x09, 0x0E, 0x0F][usize::from(k)];
            format!(" bit ${at:04X}\n lda $FF00,x\n sta ${into:02X}\n")
        });
        let kernel = format!(
            "lines:\n{} sta $02\n dex\n bne lines\n",
            read.collect::<String>()
        );
        let rom: Vec<u8> = (0..banks)
            .flat_map(|k| bank(262, &kernel, move |at| noise(at + 31 * usize::from(k))))
            .collect();
        same(kind, kind, 262, &rom);
        // With the Superchip: what a line stores is what lines below it show.
        let kernel = "lines: txa\n and #$3F\n tay\n lda $F080,y\n sta $09\n lda $FF00,x\n sta $F000,y\n \
                      sta $0E\n tya\n eor #21\n tay\n lda $F080,y\n sta $0F\n sta $02\n dex\n bne lines\n";
        let mut own = bank(262, kernel, noise);
        own[0] = 0;
        let rom = own.repeat(usize::from(banks));
        same(&format!("{kind}SC"), &format!("{kind}SC"), 262, &rom);
    }
}
