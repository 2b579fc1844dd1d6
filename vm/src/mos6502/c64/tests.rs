#![allow(clippy::unwrap_used)]

use super::*;
use crate::mos6502::{Run, assemble};

/// `10 SYS 2061`.
const LINE_10: &str = "* = $0801\n .byte 11, 8, 10, 0, 158, 50, 48, 54, 49, 0, 0, 0\n";

fn machine(source: &str) -> C64 {
    let mut machine = C64::new();
    let text = format!("{LINE_10}{source}");
    machine.load(&assemble(&text).unwrap().image()).unwrap();
    machine
}

fn run(source: &str) -> Run {
    machine(source).run(10_000_000, &mut |_| true)
}

fn message(source: &str) -> String {
    match run(source).stop {
        Stop::Fault(fault) => fault.to_string(),
        other => panic!("{other:?}"),
    }
}

/// A bitmap at $E000, colours at $CC00, all alike.
fn bitmap(d016: u8) -> String {
    format!(
        " sei\n lda #$35\n sta 1\n lda #$3b\n sta $d011\n lda #{d016}\n sta $d016\n lda #$38\n \
         sta $d018\n lda #0\n sta $dd00\n lda #6\n sta $d021\n ldx #0\nc: lda #$7e\n sta $cc00,x\n \
         sta $cd00,x\n sta $ce00,x\n sta $cf00,x\n lda #2\n sta $d800,x\n sta $d900,x\n \
         sta $da00,x\n sta $db00,x\n inx\n bne c\n"
    )
}

#[test]
fn bitmaps_are_shown_in_their_colours() {
    let hires = run(&format!(
        "{} lda #$a1\n sta $e149\n lda $dc01\n",
        bitmap(0xC8)
    ));
    assert_eq!(hires.stop, Stop::Ended);
    let screen = hires.screen.unwrap();
    assert_eq!((screen.width, screen.height), (320, 200));
    assert_eq!(
        screen.pixels[9 * 320 + 8..9 * 320 + 16],
        [1, 0, 1, 0, 0, 0, 0, 1]
    );
    assert_eq!(screen.palette, [COLOURS[14], COLOURS[7]]);
    let many = run(&format!(
        "{} lda #$1b\n sta $e149\n lda $dc01\n",
        bitmap(0xD8)
    ));
    let screen = many.screen.unwrap();
    assert_eq!((screen.width, screen.height), (160, 200));
    assert_eq!(screen.pixels[9 * 160 + 4..9 * 160 + 8], [0, 1, 2, 3]);
    assert_eq!(screen.palette, [6, 7, 14, 2].map(|c: usize| COLOURS[c]));
}

/// A character that has colours of its own makes inks the colours' numbers.
#[test]
fn colours_may_differ_by_character() {
    let run = run(&format!(
        "{} lda #$16\n sta $cc29\n lda #$80\n sta $e148\n lda $dc01\n",
        bitmap(0xC8)
    ));
    let screen = run.screen.unwrap();
    assert_eq!(screen.pixels[8 * 320 + 8..8 * 320 + 10], [1, 6]);
    assert_eq!((screen.pixels[0], screen.palette.len()), (14, 16));
}

#[test]
fn the_processor_waits_for_the_video_chip() {
    // Reads only: each bad line takes all of its 43 cycles but those that the last
    // instruction before had begun, which reads as well.
    let loop_for = |blank: &str| {
        run(&format!(
            "{blank} ldy #0\n ldx #0\nl: nop\n dex\n bne l\n dey\n bne l\n rts\n"
        ))
        .cycles
    };
    let (seen, blank) = (loop_for(""), loop_for(" lda #$0b\n sta $d011\n") - 6);
    let frames = seen as f64 / FRAME as f64;
    let waited = (seen - blank) as f64 / frames;
    assert!((waited - 25.0 * 43.0).abs() < 25.0, "{waited}");
    assert_eq!(blank, 4 + 256 * (256 * 7 - 1) + 256 * 5 - 1 + 6 - 6 + 6);
}

/// What is stored while the video chip asks for the bus is stored at once.
#[test]
fn stores_do_not_wait() {
    let mut circuits = Circuits {
        cycles: FIRST * LINE + FROM,
        ..Circuits::default()
    };
    circuits.write(0x4000, 1);
    assert_eq!(circuits.cycles, FIRST * LINE + FROM + 1);
    circuits.read(0x4000);
    assert_eq!(circuits.cycles, FIRST * LINE + FROM + WAITS + 1);
    assert_eq!(circuits.wait, (FIRST + 8) * LINE + FROM);
    circuits.cycles = (FIRST + 24 * 8) * LINE + FROM + WAITS;
    circuits.read(0x4000);
    assert_eq!(circuits.wait, FRAME + FIRST * LINE + FROM);
}

#[test]
fn roms_lie_over_the_ram_until_the_port_says_otherwise() {
    assert!(message(" lda $a000\n").contains("reads $A000"));
    assert!(message(" jsr $ffe4\n").contains("calls $FFE4"));
    // What is stored goes to the RAM below, and is seen once the ROM is gone.
    let mut seen =
        machine(" lda #7\n sta $e000\n lda #$35\n sta 1\n lda $e000\n sta $02\n lda $dc01\n");
    assert_eq!(seen.run(1000, &mut |_| true).stop, Stop::Ended);
    assert_eq!(seen.peek(2), 7);
}

#[test]
fn a_program_says_where_it_begins() {
    assert_eq!(run(" rts\n").stop, Stop::Ended);
    let mut wrong = C64::new();
    let image = assemble("* = $0801\n rts\n nop\n").unwrap().image();
    assert!(wrong.load(&image).is_err());
    let high = assemble("* = $c000\n rts\n").unwrap().image();
    assert!(C64::new().load(&high).is_ok());
}

#[test]
fn what_is_printed_is_a_complaint() {
    assert_eq!(
        message(" lda #72\n jsr $ffd2\n lda #73\n jsr $ffd2\n rts\n"),
        "hi"
    );
}
