//! A Commodore 64: a bitmap in the RAM under the KERNAL, and the machine for itself.
//!
//! The program is loaded like one in BASIC and begins with a line that starts it. While it
//! runs there are no interrupts and no ROMs, and all of the zero page is its own; the circuits
//! are there while they are told something or asked, else the RAM under them, which has the
//! tables of squares. The picture stands until a key is pressed; then everything is put back, and BASIC goes on.

use super::super::colours::{assign, commodore};
use super::Text;
use super::bbc::complain;
use super::layout::{Layout, Lie};
use crate::plan::Plan;

/// Where what belongs to the ROMs is kept: the zero page but its first two bytes, in which
/// the processor's port is, and the stack pointer in place of the first.
const KEPT: &str = "$cb00";

/// Lays the circuits over the RAM, without the ROMs; changes a.
pub(super) const CIRCUITS: &str = "lda #$35 | sta port";
/// Leaves the RAM alone. With neither ROM the third bit counts for nothing; an emulator has it
/// that looks at that bit only.
pub(super) const RAM: &str = "lda #$30 | sta port";

/// How the program comes to the machine.
pub(super) fn how(plan: &Plan, text: &mut Text) {
    text.line(
        "; In a .prg its load address, $0801, comes first, low byte before high; LOAD and RUN it.",
    );
    text.line(match plan.graph.is_moving() {
        true => "; A joystick in port 2 is asked between two pictures; a reset ends it.",
        false => "; It stops with the picture standing, and a key brings BASIC back.",
    });
}

/// Calls and places of the hardware.
pub(super) fn symbols(text: &mut Text) {
    text.headline("the machine");
    for (name, address, about) in [
        ("port", "01", "which ROMs lie over the RAM"),
        ("chrout", "ffd2", "writes a letter"),
        ("cint", "ff81", "the screen as at a start"),
    ] {
        text.line(format!("{:<24}; {about}", format!("{name} = ${address}")));
    }
}

/// The line of BASIC.
pub(super) fn line(text: &mut Text) {
    text.line("        .byte 11, 8, 10, 0, 158, 50, 48, 54, 49, 0, 0, 0    ; 10 SYS 2061");
}

/// The machine made one's own.
pub(super) fn begin(text: &mut Text) {
    text.line("        ; no interrupts, no ROMs; what is theirs is kept");
    text.code("sei | cld | lda #<(no_interrupt) | sta $fffa | lda #>(no_interrupt) | sta $fffb");
    text.code(&format!("{RAM} | ldx #2"));
    text.label("keep_page");
    text.code(&format!(
        "lda $00,x | sta {KEPT},x | inx | bne keep_page | tsx | stx {KEPT}"
    ));
}

/// The bitmap, empty, and its colours.
pub(super) fn open(plan: &Plan, text: &mut Text) {
    let mut colours = assign(&plan.graph.image.palette, &commodore());
    colours.resize(4, 0);
    let many = Layout::of(plan).is_some_and(|layout| layout.lie == Lie::Pairs);
    let pair = match many {
        true => colours[1] << 4 | colours[2],
        false => colours[1] << 4 | colours[0],
    };
    text.code(CIRCUITS);
    text.line("        ; the bitmap at $e000, empty; its colours at $cc00");
    text.code("ldy #$e0 | ldx #31 | lda #0 | jsr fill_pages");
    text.code(&format!("ldy #$cc | ldx #4 | lda #{pair} | jsr fill_pages"));
    if many {
        text.code(&format!(
            "ldy #$d8 | ldx #4 | lda #{} | jsr fill_pages",
            colours[3]
        ));
    }
    text.code(&format!("lda #{} | sta $d020 | sta $d021", colours[0]));
    text.code("lda $dd00 | and #$fc | sta $dd00 | lda #$38 | sta $d018");
    let columns = if many { "d8" } else { "c8" };
    text.code(&format!(
        "lda #${columns} | sta $d016 | lda #$3b | sta $d011 | {RAM}"
    ));
    text.line("        ; the bitmap's last bytes");
    text.code("ldx #63 | lda #0");
    text.label("fill_last");
    text.code("sta $ff00,x | dex | bpl fill_last");
}

/// Behind the picture: it stands until a key is pressed.
pub(super) fn end(text: &mut Text) {
    text.code(&format!("{CIRCUITS} | lda #0 | sta $dc00"));
    text.label("keep_picture");
    text.code("lda $dc01 | cmp #$ff | beq keep_picture");
    text.code("jsr give_back | jsr cint");
    text.label("to_basic");
    text.code(&format!("ldx {KEPT} | txs | cli | rts"));
    text.line("");
    text.line("; the ROMs and what is theirs");
    text.label("give_back");
    text.code("lda #$37 | sta port | ldx #2");
    text.label("give_byte");
    text.code(&format!(
        "lda {KEPT},x | sta $00,x | inx | bne give_byte | lda $dd00 | ora #3 | sta $dd00 | rts"
    ));
    text.label("no_interrupt");
    text.code("rti");
}

/// Says which param is wrong; its number is in a.
pub(super) fn wrong(text: &mut Text) {
    text.code("pha | jsr give_back");
    complain("chrout", text);
    text.code("jmp to_basic");
}

/// What is called.
pub(super) fn data(text: &mut Text) {
    text.line("; fills x pages from y on with a");
    text.label("fill_pages");
    text.code("sty prod+1 | ldy #0 | sty prod");
    text.label("fill_page");
    text.code("sta (prod),y | iny | bne fill_page | inc prod+1 | dex | bne fill_page | rts");
}
