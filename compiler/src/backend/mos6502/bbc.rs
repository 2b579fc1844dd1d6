//! A BBC Micro: its screen set up by registers, no larger than the picture, and pixels
//! written into its memory.
//!
//! A program is loaded where the disc system leaves memory (&1900). Where it is not at
//! home there but lower, it puts itself in order: the file's first instruction jumps to
//! its end, and from there a short loop in the zero page moves all of it down.
//!
//! What is done once, before the picture, stands last, and may be where the screen will be.
//!
//! Interrupts stay on: the clock runs, and keys are heard. At the end the program waits
//! for one, with the picture standing, and then enters BASIC anew, whose memory it used.

use super::super::bbc::{colours, first_colour};
use super::Text;
use super::layout::Layout;
use super::memory::{DISC_PAGE, Machine, Places};
use crate::plan::Plan;
use crate::targets::Mode;

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
pub(super) fn how(plan: &Plan, places: &Places, text: &mut Text) {
    text.line(format!(
        "; On a disc its load and execution addresses are ${:04x}; *RUN it, in MODE 7.",
        loaded_at(places)
    ));
    text.line(match plan.graph.is_moving() {
        true => "; The arrow keys and space are heard between two pictures; BREAK ends it.",
        false => {
            "; It stops with the picture standing, and a key brings BASIC back, without its program."
        }
    });
}

/// Where the file is loaded, if that is not where the program is at home.
pub(super) fn moved_from(places: &Places) -> Option<u16> {
    (places.origin < DISC_PAGE).then_some(DISC_PAGE)
}

/// Where the file is loaded and begun.
pub(super) fn loaded_at(places: &Places) -> u16 {
    moved_from(places).unwrap_or(places.origin)
}

/// Where what is done once begins, and where the picture does.
pub(super) const SET_UP: &str = "set_up";
pub(super) const PICTURE: &str = "picture";

/// The program's first instruction.
pub(super) fn start(places: &Places, text: &mut Text) {
    text.line("");
    text.label("start");
    let Some(from) = moved_from(places) else {
        return text.code(&format!("jmp {SET_UP}"));
    };
    text.line(format!(
        "        ; loaded at ${from:04x}, at home at ${:04x}",
        places.origin
    ));
    text.code(&format!("jmp move_down+{}", from - places.origin));
}

/// The screen: as wide and high as the mode says, below &8000. No mode is entered for it, which
/// would clear what the picture leaves to the program. What is done once may stand where it will
/// be, and be gone once it is cleared.
pub(super) fn open(plan: &Plan, text: &mut Text) {
    let screen = Layout::of(plan).filter(|_| plan.plot);
    if screen.is_some() {
        text.line("        ; the screen's shape, how its bytes are read, its colours");
        text.code("ldx #13");
        text.label("screen_shape");
        text.code("lda shape,x | stx $fe00 | sta $fe01 | dex | bpl screen_shape");
        text.code(&format!(
            "lda #154 | ldx #${:02x} | jsr osbyte | ldx #15",
            shown(&plan.mode).control
        ));
        text.label("screen_colour");
        text.code("lda colour,x | sta $fe21 | dex | bpl screen_colour");
    }
    text.code(&format!("jmp {PICTURE}"));
    text.headline("the picture");
    text.label(PICTURE);
    if let Some(layout) = screen {
        let lowest = layout.lowest(plan);
        let [lo, hi] = lowest.to_le_bytes();
        text.line(format!("        ; the screen, from ${lowest:04x}, empty"));
        text.code(&format!(
            "lda #${hi:02x} | sta prod+1 | ldy #${lo:02x} | lda #0 | sta prod"
        ));
        text.label("clear_byte");
        text.code("sta (prod),y | iny | bne clear_byte | inc prod+1 | bpl clear_byte");
    }
}

/// Shows the screen that was drawn on, where there are two, and goes on with the other.
pub(super) fn turn(plan: &Plan, text: &mut Text) {
    let second = Layout::of(plan).and_then(|layout| layout.second(plan));
    if second.is_none() {
        return;
    }
    text.line("        ; the picture is shown, and the next one drawn on the other screen");
    text.code("ldx hidden | lda #12 | sta $fe00 | lda shown_high,x | sta $fe01");
    text.code("lda #13 | sta $fe00 | lda shown_low,x | sta $fe01");
    text.code("txa | eor #1 | sta hidden");
}

/// Which of two screens is drawn on, from where on, and what the 6845 is told to show it.
pub(super) fn turned(plan: &Plan, first: u32, text: &mut Text) {
    let Some((layout, second)) =
        Layout::of(plan).and_then(|layout| Some((layout, layout.second(plan)?)))
    else {
        return;
    };
    text.line("; the screen that is not shown; its first row that is drawn; the 6845's start");
    text.label("hidden");
    text.line("        .byte 0");
    let both = [second, layout.start];
    let drawn = both.map(|start| u32::from(start) + first);
    let shown = both.map(|start| u32::from(start / 8));
    for (name, places, high) in [
        ("hidden_low", drawn, false),
        ("hidden_high", drawn, true),
        ("shown_low", shown, false),
        ("shown_high", shown, true),
    ] {
        let bytes = places.map(|place| match high {
            true => place >> 8 & 0xFF,
            false => place & 0xFF,
        });
        text.label(name);
        text.line(format!(
            "        .byte ${:02x}, ${:02x}",
            bytes[0], bytes[1]
        ));
    }
}

/// How a mode is shown.
struct Shown {
    /// The video ULA's control register.
    control: u8,
    /// Whether bytes are read at 2 MHz, or at half that.
    fast: bool,
}

fn shown(mode: &Mode) -> Shown {
    // As the operating system has them (Bray, Dickens and Holmes, The Advanced User Guide,
    // 19.1): the cursor's width, the clock, and characters a line.
    let (control, fast) = match mode.name {
        "0" => (0x9C, true),
        "1" => (0xD8, true),
        "2" => (0xF4, true),
        "4" => (0x88, false),
        _ => (0xC4, false),
    };
    Shown { control, fast }
}

/// The 6845's registers 0 to 13 for a screen of a mode, in the middle of what a television
/// shows (The Advanced User Guide, 18).
fn shape(layout: &Layout, mode: &Mode) -> [u8; 14] {
    // Characters of a line in all, of which seen, where it ends, and its pulse.
    let [line, most, end, pulse] = match shown(mode).fast {
        true => [127, 80, 98, 0x28],
        false => [63, 40, 49, 0x24],
    };
    let across = layout.characters().min(most) as u8;
    let down = (mode.height / 8).min(32) as u8;
    let [low, high] = (layout.start / 8).to_le_bytes();
    let side = (most as u8 - across) / 2;
    let above = (32 - down) / 2;
    [
        line as u8,
        across,
        end as u8 - side,
        pulse as u8,
        38,
        0,
        down,
        34 - above,
        1,
        7,
        // No cursor.
        0x20,
        8,
        high,
        low,
    ]
}

/// What the video ULA is told of each pattern of a byte's first bits: the ink that they are.
fn palette(plan: &Plan) -> [u8; 16] {
    let own = colours(&plan.graph.image.palette);
    let bits = plan.mode.inks.ilog2();
    std::array::from_fn(|pattern| {
        // Of two inks the first bit tells, of four the first and the third.
        let ink = match bits {
            1 => pattern >> 3,
            2 => pattern >> 3 << 1 | pattern >> 1 & 1,
            _ => pattern,
        };
        let colour = own
            .get(ink)
            .copied()
            .unwrap_or(first_colour(&plan.mode, ink));
        (pattern as u8) << 4 | colour ^ 7
    })
}

/// Behind the picture: it stands until a key is pressed.
pub(super) fn end(text: &mut Text) {
    text.label("keep_picture");
    text.line("        ; Escape and keys that were pressed meanwhile are forgotten");
    text.code("lda #124 | jsr osbyte | lda #21 | ldx #0 | jsr osbyte | jsr osrdch");
    text.line("        ; MODE 7");
    text.code("lda #22 | jsr oswrch | lda #7 | jsr oswrch");
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
    let Some(layout) = Layout::of(plan) else {
        return;
    };
    let mut table = |name: &str, bytes: &[u8], about: &str| {
        text.line(format!("; {about}"));
        text.label(name);
        let bytes: Vec<String> = bytes.iter().map(|b| format!("${b:02x}")).collect();
        for bytes in bytes.chunks(8) {
            text.line(format!("        .byte {}", bytes.join(", ")));
        }
    };
    let (across, down) = (layout.characters(), plan.mode.height / 8);
    table(
        "shape",
        &shape(&layout, &plan.mode),
        &format!("the 6845's registers: {across} bytes side by side, {down} rows of characters"),
    );
    table(
        "colour",
        &palette(plan),
        "the video ULA's palette: a pixel's pattern, its colour's bits inverted",
    );
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
    text.code("iny | bne move_byte | inc $04 | inc $07 | dex | bne move_byte");
    text.code(&format!("jmp {SET_UP}"));
    text.label("program_end");
}
