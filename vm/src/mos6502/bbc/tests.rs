#![allow(clippy::unwrap_used)]

use super::*;
use crate::mos6502::{Run, assemble};

fn run(source: &str) -> Run {
    let mut machine = Bbc::new();
    let text = format!("* = $1900\n{source}");
    machine.load(&assemble(&text).unwrap().image()).unwrap();
    machine.run(10_000_000, &mut |_| true)
}

fn message(source: &str) -> String {
    match run(source).stop {
        Stop::Fault(fault) => fault.to_string(),
        other => panic!("{other:?}"),
    }
}

/// Sends bytes to OSWRCH.
fn vdu(bytes: &[u8]) -> String {
    let line = |b: &u8| format!(" lda #{b}\n jsr $ffee\n");
    bytes.iter().map(line).collect()
}

/// The pixel at the left of a byte first, as the manual has them.
#[test]
fn each_mode_has_its_pixels_and_colours() {
    // A byte of which all pixels differ as far as they can, at (8 n, 9).
    for (mode, start, row, byte, inks) in [
        (0, 0x3000, 640, 0b1010_0001, &[1u8, 0, 1, 0, 0, 0, 0, 1][..]),
        (1, 0x3000, 640, 0b0011_0101, &[0, 1, 2, 3]),
        (2, 0x3000, 640, 0b1101_0110, &[0b1001, 0b1110]),
        (4, 0x5800, 320, 0b1010_0001, &[1, 0, 1, 0, 0, 0, 0, 1]),
        (5, 0x5800, 320, 0b0011_0101, &[0, 1, 2, 3]),
    ] {
        let at = start + row + 8 + 1;
        let run = run(&format!(
            "{} lda #{byte}\n sta {at}\n jsr $ffe0\n",
            vdu(&[22, mode, 19, 1, 5, 0, 0, 0])
        ));
        assert_eq!(run.stop, Stop::Ended, "MODE {mode}");
        let screen = run.screen.unwrap();
        let from = 9 * screen.width as usize + inks.len();
        assert_eq!(&screen.pixels[from..from + inks.len()], inks, "MODE {mode}");
        let drawn = screen.pixels.iter().filter(|p| **p != 0).count();
        assert_eq!(drawn, inks.iter().filter(|p| **p != 0).count());
        assert_eq!(screen.palette[..2], [[0; 3], [255, 0, 255]]);
    }
}

#[test]
fn a_mode_clears_what_was_there() {
    let run = run(&format!(
        "{} lda #255\n sta $4000\n{} rts\n",
        vdu(&[22, 1]),
        vdu(&[22, 1])
    ));
    assert_eq!(run.stop, Stop::Ended);
    assert!(run.screen.unwrap().pixels.iter().all(|p| *p == 0));
}

#[test]
fn what_is_printed_before_a_mode_is_a_complaint() {
    assert_eq!(
        message(&format!("{} jmp $ffe0\n", vdu(b"too large"))),
        "too large"
    );
}

#[test]
fn what_is_not_bundled_is_said() {
    for (source, said) in [
        (" jsr $ffd1\n", "calls &FFD1"),
        (" lda $fe40\n", "reads &FE40"),
        (" sta $fe40\n", "sets &FE40"),
        (" lda #129\n jsr $fff4\n", "OSBYTE 129"),
        (" lda #25\n jsr $ffee\n", "VDU 25"),
        (" lda #22\n jsr $ffee\n lda #3\n jsr $ffee\n", "MODE 3"),
        (" brk\n", "brk at $1900"),
    ] {
        assert!(message(source).contains(said), "{}", message(source));
    }
}

#[test]
fn programs_keep_out_of_the_roms() {
    let mut machine = Bbc::new();
    let image = assemble("* = $7fff\n nop\n nop\n").unwrap().image();
    assert!(machine.load(&image).is_err());
}

#[test]
fn interrupts_take_their_share() {
    // 1,000 turns of five cycles, less one, and the loop's start and end.
    let run = run(" ldx #250\n ldy #4\nl: dex\n bne l\n ldx #250\n dey\n bne l\n rts\n");
    let own = 2 + 2 + 4 * (250 * 5 - 1 + 2 + 2 + 3) - 1;
    assert_eq!(run.cycles, cost::with_interrupts(own + 6 + CALL_CYCLES));
}

/// Two characters of MODE 1 side by side and one row of them, with two of its inks exchanged; the
/// registers are those of the manual.
#[test]
fn a_screen_may_be_set_up_by_its_registers() {
    let registers = [
        (1, 2),
        (6, 1),
        (9, 7),
        (12, 0x7F00 >> 11),
        (13, 0x7F00 >> 3 & 0xFF),
    ];
    let set = |(number, value): &(u32, u32)| {
        format!(" lda #{number}\n sta $fe00\n lda #{value}\n sta $fe01\n")
    };
    let mut source: String = registers.iter().map(set).collect();
    source += " lda #154\n ldx #$d8\n jsr $fff4\n";
    // Of a byte's bits 7, 5, 3 and 1 the first and the third are a pixel's ink.
    for pattern in 0..16u32 {
        let ink = pattern >> 3 << 1 | pattern >> 1 & 1;
        let colour = [0, 3, 1, 7][ink as usize] ^ 7;
        source += &format!(" lda #{}\n sta $fe21\n", pattern << 4 | colour);
    }
    source += " lda #%00110101\n sta $7f08\n lda #%11110000\n sta $7f03\n jsr $ffe0\n";
    let run = run(&source);
    assert_eq!(run.stop, Stop::Ended);
    let screen = run.screen.unwrap();
    assert_eq!((screen.width, screen.height), (8, 8));
    assert_eq!(screen.pixels[4..8], [0, 1, 2, 3]);
    assert_eq!(screen.pixels[24..32], [2, 2, 2, 2, 0, 0, 0, 0]);
    let [red, yellow] = [[255, 0, 0], [255, 255, 0]];
    assert_eq!(screen.palette, [[0; 3], yellow, red, [255; 3]]);
}

/// In MODE 7 a program writes again; BASIC is where it ends.
#[test]
fn a_program_may_go_back_to_basic() {
    let source = format!(
        "{} ldx #<basic\n ldy #>basic\n jmp $fff7\nbasic: .byte 66, 65, 83, 73, 67, 13\n",
        vdu(&[22, 1, 22, 7])
    );
    let run = run(&source);
    assert_eq!(run.stop, Stop::Ended);
    assert!(run.screen.is_none());
}
