#![allow(clippy::unwrap_used)]

use super::*;
use crate::mos6502::{Run, assemble};
use proptest::prelude::*;

fn run(source: &str) -> Run {
    let mut machine = Plain::new();
    machine.load(&assemble(source).unwrap().image()).unwrap();
    machine.run(1_000_000, &mut |_| true)
}

fn message(source: &str) -> String {
    match run(source).stop {
        Stop::Fault(fault) => fault.to_string(),
        other => panic!("{other:?}"),
    }
}

/// A program that opens a picture of 3 x 2 pixels in 4 inks.
const OPEN: &str = "* = $0800\n lda #3\n sta $ff00\n lda #2\n sta $ff02\n lda #4\n sta $ff04\n";

#[test]
fn a_picture_is_drawn_ink_by_ink() {
    let run = run(&format!(
        "{OPEN} ldx #0\nl: txa\n and #3\n sta $ff09\n inx\n cpx #6\n bne l\n
         lda #2\n sta $ff05\n lda #0\n sta $ff07\n lda #3\n sta $ff09\n lda $ff07\n sta $10\n sta $ff0a\n"
    ));
    // The exit status was Y after the ink at the end of row 0: 1.
    assert_eq!(
        run.stop,
        Stop::Fault(fault("the program ended with status 1".to_owned()))
    );
    let screen = run.screen.unwrap();
    assert_eq!((screen.width, screen.height, run.plots), (3, 2, 7));
    assert_eq!(screen.pixels, [0, 1, 3, 3, 0, 1]);
    assert_eq!(screen.palette, [[0; 3], [85; 3], [170; 3], [255; 3]]);
}

#[test]
fn cycles_are_those_of_the_instructions() {
    // 2 + 4 for each of the three ports, then 2 + 4 for the exit.
    let run = run(&format!("{OPEN} lda #0\n sta $ff0a\n"));
    assert_eq!(
        (run.stop, run.cycles, run.instructions),
        (Stop::Ended, 24, 8)
    );
}

#[test]
fn a_palette_is_told_byte_by_byte() {
    let run = run(&format!(
        "{OPEN} ldx #9\nl: stx $ff0b\n dex\n bne l\n stx $ff0a\n"
    ));
    assert_eq!(
        run.screen.unwrap().palette,
        [[9, 8, 7], [6, 5, 4], [3, 2, 1], [255; 3]]
    );
}

#[test]
fn faults_say_where() {
    assert_eq!(
        message("* = $0800\n nop\n.byte $02"),
        "opcode $02 at $0801 stops the processor"
    );
    assert_eq!(
        message("* = $0800\n nop\n brk"),
        "brk at $0801, and no handler at $FFFE"
    );
    assert_eq!(
        message("* = $0800\n rts"),
        "brk at $0001, and no handler at $FFFE"
    );
    assert_eq!(
        message(" sta $ff09"),
        "an ink is stored before the picture is opened"
    );
    assert_eq!(
        message(&format!("{OPEN} sta $ff09")),
        "ink 4 at (0, 0), but there are 4 inks"
    );
    assert_eq!(
        message(&format!("{OPEN} sta $ff05\n sta $ff09")),
        "an ink at (4, 0), outside the picture"
    );
    assert_eq!(
        message(&format!("{OPEN} sta $ff08\n sta $ff09")),
        "an ink at (0, 1024), outside the picture"
    );
    assert_eq!(
        message(&format!("{OPEN} sta $ff04")),
        "the picture is opened twice"
    );
    assert!(message(" sta $ff04").starts_with("no picture of 0 x 0 pixels in 256 inks"));
}

#[test]
fn a_handler_makes_brk_an_instruction() {
    let source = "* = $0800\n lda #<(h)\n sta $fffe\n lda #>(h)\n sta $ffff\n brk\n.byte 0\nh: lda #0\n sta $ff0a";
    assert_eq!(run(source).stop, Stop::Ended);
}

#[test]
fn endless_programs_are_stopped() {
    let mut machine = Plain::new();
    machine
        .load(&assemble("* = $0800\nl: jmp l").unwrap().image())
        .unwrap();
    let first = machine.run(25_000_000, &mut |_| true);
    assert_eq!(first.stop, Stop::CycleLimit);
    assert!((25_000_000..25_000_003).contains(&first.cycles));
    let mut calls = 0;
    let second = machine.run(u64::MAX, &mut |progress| {
        calls += 1;
        progress.cycles < 50_000_000
    });
    assert_eq!((second.stop, calls), (Stop::Interrupted, 3));
}

#[test]
fn images_that_do_not_fit_are_refused() {
    let mut machine = Plain::new();
    assert!(machine.load(&[]).is_err());
    assert!(machine.load(&[0, 8]).is_err());
    assert!(machine.load(&[0xFE, 0xFE, 1, 2]).is_ok());
    let fault = machine.load(&[0xFE, 0xFE, 1, 2, 3]).unwrap_err();
    assert_eq!(
        fault.message,
        "the program lies at $FEFE to $FF00, but the ports begin at $FF00"
    );
    assert!(machine.load(&[0x80, 0xFF, 1]).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn no_program_makes_a_panic_or_hangs(image in prop::collection::vec(any::<u8>(), 0..4000)) {
        let mut machine = Plain::new();
        if machine.load(&image).is_ok() {
            let run = machine.run(100_000, &mut |_| true);
            prop_assert!(run.cycles < 100_010);
        }
    }

    #[test]
    fn nor_does_one_that_stores_to_ports(stores in prop::collection::vec((any::<u8>(), 0u8..16), 1..200)) {
        let mut image = vec![0x00, 0x08];
        for (value, port) in stores {
            image.extend([0xA9, value, 0x8D, port, 0xFF]);
        }
        let mut machine = Plain::new();
        prop_assert!(machine.load(&image).is_ok());
        machine.run(100_000, &mut |_| true);
    }
}

#[test]
fn bytes_are_put_and_begun_where_it_is_said() {
    // STA $FF0A twice: the first is skipped.
    let code = [0x8D, 0x0A, 0xFF, 0xA9, 5, 0x8D, 0x0A, 0xFF];
    let mut machine = Plain::new();
    machine.load_at(0x3000, &code, Some(0x3003)).unwrap();
    let run = machine.run(100, &mut |_| true);
    let status = "the program ended with status 5".to_owned();
    assert_eq!((run.stop, run.cycles), (Stop::Fault(fault(status)), 6));
    let mut machine = Plain::new();
    machine.load_at(0x3000, &code, None).unwrap();
    let run = machine.run(100, &mut |_| true);
    assert_eq!((run.stop, run.cycles), (Stop::Ended, 4));
    let refused = |at, bytes: &[u8], start| {
        let wrong = Plain::new().load_at(at, bytes, start).unwrap_err();
        wrong.message
    };
    assert_eq!(refused(0x3000, &[], None), "the program has no bytes");
    assert_eq!(
        refused(0x3000, &code, Some(0xFF00)),
        "no program begins at $FF00: the ports begin at $FF00"
    );
    assert!(refused(0xFEF9, &code, None).starts_with("the program lies at $FEF9 to $FF00"));
}
