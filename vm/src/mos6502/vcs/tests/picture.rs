//! The playfield's pixels, to the clock.

use super::*;

/// Waits so many cycles, two at least.
pub(super) fn spend(cycles: u32) -> String {
    match cycles % 2 {
        1 => format!(" bit $80\n{}", " nop\n".repeat((cycles as usize - 3) / 2)),
        _ => " nop\n".repeat(cycles as usize / 2),
    }
}

/// The pixels of a line in which `program` runs from the line's first cycle on, with colour 2
/// where the playfield is and 4 where not.
fn line(set_up: &str, program: &str) -> Vec<u8> {
    let begin = format!(" lda #2\n sta $08\n lda #4\n sta $09\n{set_up}");
    let source = format!(
        "frame: lda #2\n sta $02\n sta $00\n sta $02\n lda #0\n sta $00\n sta $01\n{begin} sta $02\n\
         {program} sta $02\n sta $02\n jmp frame\n"
    );
    let (_, machine) = play(&cart(&source), "wait 2 quit");
    machine.lines()[2 * 160..3 * 160].to_vec()
}

/// A bit a column of four pixels, which are alike.
fn columns(line: &[u8]) -> String {
    let column = |four: &[u8]| {
        assert!(four.iter().all(|pixel| *pixel == four[0]), "{four:?}");
        if four[0] == 2 { '#' } else { '.' }
    };
    line.chunks(4).map(column).collect()
}

const PATTERN: &str = " lda #$50\n sta $0D\n lda #$F0\n sta $0E\n lda #$03\n sta $0F\n";

#[test]
fn the_playfield_is_repeated_or_mirrored() {
    let wait = spend(70);
    // PF0's bit 4 is the first; PF1 goes down from bit 7, PF2 up from bit 0.
    let left = "#.#.####....##......";
    let mirrored: String = left.chars().rev().collect();
    let repeats = line(&format!("{PATTERN} lda #0\n sta $0A\n"), &wait);
    assert_eq!(columns(&repeats), format!("{left}{left}"));
    let mirrors = line(&format!("{PATTERN} lda #1\n sta $0A\n"), &wait);
    assert_eq!(columns(&mirrors), format!("{left}{mirrored}"));
}

#[test]
fn the_score_has_the_players_colours_unless_the_playfield_is_in_front() {
    let colours = " lda #$20\n sta $06\n lda #$40\n sta $07\n";
    let all = " lda #255\n sta $0D\n sta $0E\n sta $0F\n";
    for (control, left, right) in [(0, 2, 2), (2, 0x20, 0x40), (6, 2, 2), (3, 0x20, 0x40)] {
        let set_up = format!("{colours}{all} lda #{control}\n sta $0A\n");
        let found = line(&set_up, &spend(70));
        assert_eq!(&found[..80], [left; 80], "{control}");
        assert_eq!(&found[80..], [right; 80], "{control}");
    }
}

/// A store to a playfield register is in time for a column of four clocks where it ends two
/// clocks before: cycle `n`, counted from 0, ends at clock 3 (n + 1).
#[test]
fn playfield_stores_take_effect_two_clocks_later() {
    for (register, first, count) in [(0x0D, 0, 4), (0x0E, 4, 8), (0x0F, 12, 8)] {
        for before in 10..66 {
            // The store's last cycle is the line's cycle `before` + 2.
            let program = format!(
                " ldy #255\n{} sty ${register:02X}\n{}",
                spend(before - 2),
                spend(72 - before)
            );
            let zero = format!(" lda #0\n sta $0A\n sta ${register:02X}\n");
            let clear = " lda #0\n sta $0D\n sta $0E\n sta $0F\n";
            let found = columns(&line(&format!("{clear}{zero}"), &program));
            let from = 3 * (before + 3) + 2;
            let expected: String = (0..40u32)
                .map(|column| {
                    let own = (first..first + count).contains(&(column % 20));
                    if own && 68 + 4 * column >= from {
                        '#'
                    } else {
                        '.'
                    }
                })
                .collect();
            assert_eq!(found, expected, "${register:02X} after {before} cycles");
        }
    }
}

/// Colours change where the store's cycle ends.
#[test]
fn colours_change_at_once() {
    for before in 25..60 {
        let program = format!(
            " ldy #$86\n{} sty $09\n{}",
            spend(before - 2),
            spend(72 - before)
        );
        let set_up = " lda #0\n sta $0D\n sta $0E\n sta $0F\n";
        let found = line(set_up, &program);
        let from = (3 * (before + 3) - 68) as usize;
        assert_eq!(&found[..from], vec![4; from], "{before}");
        assert_eq!(&found[from..], vec![0x86; 160 - from], "{before}");
    }
}

#[test]
fn a_blanked_line_is_black() {
    let program = format!(
        " ldy #2\n{} sty $01\n{} ldy #0\n sty $01\n",
        spend(30),
        spend(20)
    );
    let found = line(" lda #0\n sta $0D\n sta $0E\n sta $0F\n", &program);
    // Cycles 32 to 34, then 57 to 59: one clock behind 105 and behind 180.
    let (on, off) = (105 + 1 - 68, 180 + 1 - 68);
    let expected: Vec<u8> = (0..160)
        .map(|x| if (on..off).contains(&x) { 0 } else { 4 })
        .collect();
    assert_eq!(found, expected);
}

/// CTRLPF is asked for at the last clock before the middle.
#[test]
fn a_line_is_mirrored_as_control_says_before_its_middle() {
    let left = "#.#.####....##......";
    let mirrored: String = left.chars().rev().collect();
    for before in 20..60 {
        let program = format!(
            " ldy #1\n{} sty $0A\n{}",
            spend(before - 2),
            spend(72 - before)
        );
        let found = line(&format!("{PATTERN} lda #0\n sta $0A\n"), &program);
        let in_time = 3 * (before + 3) <= 68 + 79;
        let right = if in_time { &mirrored } else { left };
        assert_eq!(columns(&found), format!("{left}{right}"), "{before}");
    }
}

/// What a television shows of other things than the playfield is missing, and said.
#[test]
fn what_is_not_shown_is_said() {
    for (register, value, what) in [
        (0x1B, 1, "a player"),
        (0x1E, 2, "a missile"),
        (0x1F, 2, "the ball"),
    ] {
        let source = frames(
            &format!(" lda #{value}\n sta ${register:02X}\n"),
            200,
            " nop",
        );
        let said = play(&cart(&source), "wait 1 quit").0.output;
        let said = String::from_utf8(said).unwrap();
        assert!(said.contains(&format!("not shown here: {what}")), "{said}");
    }
    let source = frames(" lda #0\n sta $1B\n sta $1D\n sta $1F\n", 200, " nop");
    let said = String::from_utf8(play(&cart(&source), "wait 1 quit").0.output).unwrap();
    assert!(!said.contains("not shown"), "{said}");
}
