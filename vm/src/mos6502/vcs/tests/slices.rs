//! Work that is cut into slices: where the timer is asked whether the longest of them still
//! fits, every frame has its lines, whatever is computed.

use super::*;
use crate::mos6502::Assembly;
use crate::mos6502::worst::Question;
use std::collections::{BTreeMap, BTreeSet};

/// What lies between two looks at the timer beside a slice: the rest of one look and the
/// beginning of the next.
const LOOK: u64 = 2 + 3 + 6 + 6 + 4;

/// Thirty-two products of bytes, time and again, between the pictures of a frame of 312 lines:
/// 70 of overscan, 3 of sync, 43 blank and 196 of picture. `ask` goes on where the timer has
/// `least` or more, else shows what comes next.
fn program(least: u64) -> Assembly {
    let text = format!(
        "* = $F000
start:
 ldx #32
 stx $91
 lda #83
 sta $0296
next:
 lda #0
 ldy #8
 ldx $92
 stx $94
bits:
 lsr $94
 bcc skip
 clc
 adc $93
skip:
 ror
 dey
 bne bits
 cmp #100
 bcc small
 inc $96
 inc $96
 inc $96
small:
 sta $95
ask1:
 jsr ask
 inc $92
 dec $91
 bne next
 lda #32
 sta $91
 inc $97
ask2:
 jsr ask
 jmp next
ask:
 lda $0284
 cmp #{least}
 bcs more
wait:
 lda $0284
 bne wait
 sta $02
 lda $90
 eor #1
 sta $90
 beq show
 lda #2
 sta $01
 sta $00
 sta $02
 sta $02
 sta $02
 lda #0
 sta $00
 lda #51
 sta $0296
more:
 rts
show:
 lda #0
 sta $01
 ldx #196
lines:
 stx $09
 sta $02
 dex
 bne lines
 lda #2
 sta $01
 lda #83
 sta $0296
 rts
"
    );
    let length = assemble(&text).unwrap().bytes.len();
    let rest = 0xFFA - length;
    assemble(&format!(
        "{text} .res {rest}, 255\n .word start, start, start\n"
    ))
    .unwrap()
}

fn longest(assembly: &Assembly) -> u64 {
    let at = |name: &str| assembly.symbols[name] as u16;
    let question = Question {
        assembly,
        ram: 0x80..=0xFF,
        mirrored: true,
        turns: BTreeMap::new(),
        ends: BTreeSet::from([at("ask1"), at("ask2")]),
        exit: None,
    };
    question.slices(at("start")).unwrap()
}

/// The lines of frames, and how many turns of the work were done, with these bytes to begin with.
fn shown(assembly: &Assembly, bytes: [u8; 2]) -> (Vec<u32>, u8) {
    let mut machine = Vcs::new();
    machine.load_at(0xF000, &assembly.bytes, None).unwrap();
    machine.poke(0x92, bytes[0]);
    machine.poke(0x93, bytes[1]);
    let script: Script = "wait 40 quit".parse().unwrap();
    machine
        .board
        .plug(Keyboard::new(script, Unit::Frames, |_| None));
    machine.run(2_000_000, &mut |_| true);
    // The first frame begins where the machine was switched on.
    (machine.frames()[1..].to_vec(), machine.peek(0x97))
}

#[test]
fn slices_that_fit_make_frames_that_do() {
    // A product's every way: all bits set, and what is behind it.
    let slice = longest(&program(0));
    let body = 2 + 2 + 3 + 3 + 8 * (5 + 2 + 2 + 3 + 2 + 2 + 3) - 1 + 2 + 2 + 15 + 3;
    assert_eq!(slice, (5 + 5 + 3) + body);
    // What is asked for: until the timer has come to 0, whose wait ends in the middle of a line.
    let least = (slice + LOOK).div_ceil(64) + 1;
    let sound = program(least);
    for bytes in [
        [0, 0],
        [255, 255],
        [255, 1],
        [7, 200],
        [128, 127],
        [85, 170],
    ] {
        let (frames, turns) = shown(&sound, bytes);
        assert_eq!(frames, [312; 39], "{bytes:?}");
        assert!(turns > 10, "{turns}");
    }
    // Where less is asked for, a slice runs into what comes next.
    let hopeful = program(1);
    assert!(
        shown(&hopeful, [255, 255])
            .0
            .iter()
            .any(|lines| *lines != 312)
    );
}
