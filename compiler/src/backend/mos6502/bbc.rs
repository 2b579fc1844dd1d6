//! A BBC Micro: modes and colours through its operating system, pixels into its memory.
//!
//! A program is loaded where the disc system leaves memory (&1900). Where it is not at
//! home there but lower, it puts itself in order: the file's first instruction jumps to
//! its end, and from there a short loop in the zero page moves all of it down.
//!
//! Interrupts stay on: the clock runs, and keys are heard. At the end the program waits
//! for one, with the picture standing, and then enters BASIC anew, whose memory it used.

use super::super::bbc::{colours, first_colour};
use super::Text;
use super::memory::{DISC_PAGE, Machine, Places};
use crate::plan::Plan;

/// Calls of the operating system.
pub(super) fn symbols(text: &mut Text) {
    text.headline("the operating system");
    for (name, address, about) in [
        ("oswrch", "ffee", "writes a byte to the screen"),
        ("osbyte", "fff4", "does what a says"),
        ("osrdch", "ffe0", "waits for a key"),
        ("oscli", "fff7", "does a command as typed behind *"),
    ] {
        text.line(format!("{:<24}; {about}", format!("{name} = ${address}")));
    }
}

/// How the program comes to the machine.
pub(super) fn how(places: &Places, text: &mut Text) {
    text.line(format!(
        "; On a disc its load and execution addresses are ${:04x}; *RUN it, in MODE 7.",
        loaded_at(places)
    ));
    text.line(
        "; It stops with the picture standing, and a key brings BASIC back, without its program.",
    );
}

/// Where the file is loaded, if that is not where the program is at home.
pub(super) fn moved_from(places: &Places) -> Option<u16> {
    (places.origin < DISC_PAGE).then_some(DISC_PAGE)
}

/// Where the file is loaded and begun.
pub(super) fn loaded_at(places: &Places) -> u16 {
    moved_from(places).unwrap_or(places.origin)
}

/// The program's first instruction.
pub(super) fn begin(places: &Places, text: &mut Text) {
    if let Some(from) = moved_from(places) {
        text.line(format!(
            "        ; loaded at ${from:04x}, at home at ${:04x}",
            places.origin
        ));
        text.code(&format!("jmp move_down+{}", from - places.origin));
        text.label("begin");
    }
    text.code("cld");
}

/// The mode, its colours, and no cursor.
pub(super) fn open(plan: &Plan, text: &mut Text) {
    text.code("ldx #0");
    text.label("screen_code");
    text.code(&format!(
        "lda screen_codes,x | jsr oswrch | inx | cpx #{} | bne screen_code",
        codes(plan)
            .iter()
            .map(|(bytes, _)| bytes.len())
            .sum::<usize>()
    ));
}

/// What the VDU is told, and why.
fn codes(plan: &Plan) -> Vec<(Vec<u8>, String)> {
    let mode = plan.mode.name;
    let number = mode.parse().unwrap_or(0);
    let mut all = vec![
        (vec![22, number], format!("MODE {mode}")),
        (vec![23, 1, 0, 0, 0, 0, 0, 0, 0, 0], "no cursor".to_owned()),
    ];
    for (ink, own) in colours(&plan.graph.image.palette).into_iter().enumerate() {
        // The upper inks of a mode with 16 flash.
        if own != first_colour(&plan.mode, ink) || ink > 7 {
            let bytes = vec![19, ink as u8, own, 0, 0, 0];
            all.push((bytes, format!("ink {ink} is colour {own}")));
        }
    }
    all
}

/// Behind the picture: it stands until a key is pressed.
pub(super) fn end(text: &mut Text) {
    text.label("keep_picture");
    text.line("        ; Escape and keys that were pressed meanwhile are forgotten");
    text.code("lda #124 | jsr osbyte | lda #21 | ldx #0 | jsr osbyte | jsr osrdch");
    text.code("ldx #<(basic) | ldy #>(basic) | jmp oscli");
    text.label("basic");
    text.line("        .byte 66, 65, 83, 73, 67, 13     ; *BASIC");
}

/// Says which param is wrong; its number is in a.
pub(super) fn wrong(text: &mut Text) {
    text.code("pha");
    complain("oswrch", text);
    text.code("jmp keep_picture");
}

/// Writes that a param, its number on the stack, is out of its range.
pub(super) fn complain(write: &str, text: &mut Text) {
    let said = "OUT OF ITS RANGE: PARAM ";
    text.code("ldx #0");
    text.label("wrong_letter");
    text.code(&format!(
        "lda wrong_text,x | jsr {write} | inx | cpx #{} | bne wrong_letter",
        said.len()
    ));
    text.code("pla | ldx #47 | sec");
    text.label("wrong_ten");
    text.code("inx | sbc #10 | bcs wrong_ten");
    text.code(&format!(
        "adc #58 | pha | txa | jsr {write} | pla | jsr {write}"
    ));
}

/// The text of that.
fn wrong_text(text: &mut Text) {
    text.label("wrong_text");
    let letters: Vec<String> = (b"OUT OF ITS RANGE: PARAM ".iter())
        .map(u8::to_string)
        .collect();
    text.line(format!("        .byte {}", letters.join(", ")));
}

/// What is told the screen, and texts.
pub(super) fn data(plan: &Plan, machine: Machine, text: &mut Text) {
    wrong_text(text);
    if machine != Machine::Bbc || !plan.plot {
        return;
    }
    text.label("screen_codes");
    for (bytes, about) in codes(plan) {
        let bytes: Vec<String> = bytes.iter().map(u8::to_string).collect();
        let line = format!("        .byte {}", bytes.join(", "));
        text.line(format!("{line:<48}; {about}"));
    }
}

/// Behind everything: what moves the program down. It runs where it was loaded; a loop
/// that nothing is moved over stands in the zero page, where the numbers will be.
pub(super) fn move_down(places: &Places, text: &mut Text) {
    let Some(from) = moved_from(places) else {
        return;
    };
    let by = from - places.origin;
    text.headline(&format!(
        "from ${from:04x} down to ${:04x}; the disc is not needed any more",
        places.origin
    ));
    text.label("move_down");
    text.line("        ; no file answers for the keyboard any more");
    text.code("lda #119 | jsr osbyte | ldx #20");
    text.label("copy_mover");
    text.code(&format!(
        "lda mover+{by},x | sta $00,x | dex | bpl copy_mover"
    ));
    text.code("ldx #>(program_end-start+255) | jmp $0000");
    text.label("mover");
    text.code("ldy #0");
    text.label("move_byte");
    text.code(&format!("lda ${from:04x},y | sta ${:04x},y", places.origin));
    text.code("iny | bne move_byte | inc $04 | inc $07 | dex | bne move_byte | jmp begin");
    text.label("program_end");
}
