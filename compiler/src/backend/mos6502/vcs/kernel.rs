//! The kernel: what shows a picture while the beam draws it, and what makes playfield of columns.
//!
//! Thirty-two columns are four bytes of playfield, PF1 and PF2 of the left half and, reflected,
//! of the right one. All four are stored on every line: PF2 the second time when the beam has
//! just left its last bit on the left (the 48th cycle of the line, no other will do), PF1 from
//! the 38th to the 59th. Lines come in pairs, the first with all walls, the second with those
//! that are drawn whole. The picture is the same above and below its middle row, so there is
//! memory for one half, and a table says which row a pair of lines shows.
//!
//! A frame is 3 lines of vertical sync, a part in which the work goes on, a line to begin with,
//! the picture, and another part for the work.

use super::Line;
use super::colours::nearest;
use super::ram::{CHIP, FRESH, HANDS, HEIGHTS, MASKS, NEW_MASKS, PHASE, READ, ROWS, instruction};
use super::tall::byte_and_bit;
use crate::backend::mos6502::homes::Homes;
use crate::backend::mos6502::slots::Slot;
use crate::plan::Plan;
use crate::plan::columns::Columns;
use slowlight_runtime_6502::squares::TABLES;

/// Lines of a frame.
pub const LINES: u32 = 312;

/// Lines of the picture at most.
const PICTURE: u32 = 192;

/// Cycles of a line.
const LINE: u32 = 76;

/// Where in a line the timer comes to 0, about.
const MIDDLE: u32 = 30;

/// How a picture is shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shape {
    /// Columns and rows.
    pub size: (u32, u32),
    /// The first column, of 32.
    pub first: u32,
    /// Pairs of lines for each row.
    pub pairs: u32,
    /// The first line of the picture behind the begin of the vertical sync.
    pub top: u32,
    /// What the timer is set to behind the sync, and behind the picture.
    timers: [u32; 2],
    /// The inks of walls: drawn on every line, and on every second.
    pub walls: (u8, Option<u8>),
    /// Those above and below.
    pub backs: [u8; 2],
    /// The colours of the first of these walls, and above and below.
    pub colours: [u8; 3],
}

/// A timer's start for so many lines, where it is set in some cycle of the first; none where it
/// would come to 0 near a line's end.
fn timer(lines: u32, from: u32) -> Option<u32> {
    let end = lines.checked_sub(1)? * LINE + MIDDLE;
    let ticks = end.checked_sub(from)?.div_ceil(64);
    let zero = from + ticks * 64;
    // It is seen within seven cycles more.
    let within = zero / LINE == lines - 1 && (8..58).contains(&(zero % LINE));
    within.then_some(ticks + 1)
}

/// How many lines there are behind the sync, and the timers there and behind the picture, of so
/// many lines that are free.
fn parts(free: u32) -> (u32, [u32; 2]) {
    let middle = free * 11 / 20;
    let near = (0..free / 2).flat_map(|by| [middle + by, middle.saturating_sub(by)]);
    let both = |above: &u32| {
        let behind = free.checked_sub(*above)?;
        Some([timer(*above, 14)?, timer(behind, 22)?])
    };
    let mut found = near.filter_map(|above| Some((above, both(&above)?)));
    found.next().unwrap_or((middle, [1, 1]))
}

impl Shape {
    /// That of a picture.
    pub fn of(plan: &Plan, columns: &Columns) -> Shape {
        let image = &plan.graph.image;
        let size = (image.width, image.height);
        let pairs = (PICTURE / 2 / size.1.max(1)).max(1);
        let picture = 2 * pairs * size.1;
        // The picture's middle is a little above the frame's, as the sync is at its top.
        let free = LINES - 3 - 1 - picture;
        let (under, timers) = parts(free);
        let palette = &image.palette;
        let rgb = |ink: u8| palette.get(usize::from(ink)).copied().unwrap_or_default();
        let backs = columns.backs;
        let far = |ink: &u8| {
            let squares = rgb(*ink).into_iter().zip(rgb(backs[0]));
            squares
                .map(|(a, b)| (i32::from(a) - i32::from(b)).pow(2))
                .sum::<i32>()
        };
        let mut walls = columns.walls();
        walls.sort_by_key(far);
        let full = walls.pop().unwrap_or(0);
        Shape {
            size,
            first: (32 - size.0) / 2,
            pairs,
            top: 3 + under + 1,
            timers,
            walls: (full, walls.pop()),
            backs,
            colours: [full, backs[0], backs[1]].map(|ink| nearest(rgb(ink))),
        }
    }
}

fn push(lines: &mut Vec<Line>, code: &str) {
    let each = code
        .split('|')
        .map(|c| (format!("        {}", c.trim()), None));
    lines.extend(each);
}

fn label(lines: &mut Vec<Line>, name: &str) {
    lines.push((format!("{name}:"), None));
}

/// What the machine begins with.
pub(super) fn boot(plan: &Plan, homes: &Homes, shape: &Shape, texts: &[&Vec<Line>]) -> Vec<Line> {
    let uses = |name: &str| {
        let lines = texts.iter().flat_map(|text| text.iter());
        let mut instructions = lines.filter_map(|(line, _)| instruction(line));
        instructions.any(|(_, operand)| operand.contains(name))
    };
    let mut lines = Vec::new();
    let l = &mut lines;
    label(l, "vcs_boot");
    push(l, "sei | cld | ldx #$ff | txs | lda #0 | tax");
    label(l, "vcs_boot_clear");
    push(l, "sta $00,x | inx | bne vcs_boot_clear | ldx #$7f");
    label(l, "vcs_boot_chip");
    push(l, &format!("sta ${CHIP:04x},x | dex | bpl vcs_boot_chip"));
    if shape.walls.1.is_none() {
        push(l, "lda #$ff");
        for k in 0..4 {
            push(l, &format!("sta ${:04x}", MASKS + k));
        }
    }
    push(
        l,
        &format!("lda #1 | sta $0a | lda #{} | sta $08", shape.colours[0]),
    );
    for (param, k) in plan.params.iter().zip(0..) {
        let slot = Slot::Param(k);
        let name = homes.name(slot);
        if homes.address(slot).is_none() || !uses(name) {
            continue;
        }
        for byte in 0..homes.bytes(plan, slot) {
            // All memory is 0 by now.
            let value = (param.bits >> (8 * byte)) & 0xFF;
            if value == 0 {
                continue;
            }
            push(l, &format!("lda #{value} | sta {name}+{byte}"));
        }
    }
    let pointers = [("sum", "sqr"), ("dif", "sqd")];
    for (pointer, _) in pointers {
        for (k, byte) in ["lo", "hi"].into_iter().enumerate() {
            let table = if pointer == "sum" { k } else { 2 + k };
            let page = 0x11 + 2 * table.min(TABLES.len());
            push(l, &format!("lda #${page:02x}"));
            for which in ["", "1"] {
                let pointer = format!("{pointer}{which}_{byte}");
                if uses(&pointer) {
                    push(l, &format!("sta {pointer}+1"));
                }
            }
        }
    }
    push(
        l,
        &format!("lda #2 | sta $01 | lda #{} | sta $0296", shape.timers[1]),
    );
    // Two frames of nothing: televisions want to see what comes.
    for _ in 0..4 {
        push(l, "jsr vcs_frame_part");
    }
    lines
}

/// The kernel, and the conversion.
pub(super) fn text(shape: &Shape) -> Vec<Line> {
    let mut lines = Vec::new();
    let l = &mut lines;
    label(l, "vcs_frame_part");
    push(l, "lda $0284 | bne vcs_frame_part | sta $02");
    push(
        l,
        &format!("lda {PHASE} | eor #1 | sta {PHASE} | beq vcs_show"),
    );
    push(
        l,
        "lda #2 | sta $00 | sta $02 | sta $02 | sta $02 | lda #0 | sta $00",
    );
    push(l, &format!("lda #{} | sta $0296 | rts", shape.timers[0]));
    let last = shape.pairs * shape.size.1 - 1;
    let rows = |k: u16| format!("lda ${:04x},y", CHIP + READ + k * ROWS);
    let masked = |k: u16| format!("{} | and ${:04x}", rows(k), MASKS + READ + k);
    label(l, "vcs_show");
    push(
        l,
        &format!("ldx #{last} | ldy vcs_kernel_rows+{last} | lda #0 | sta $01"),
    );
    label(l, "vcs_kernel");
    push(l, "sta $02");
    push(l, &format!("{} | sta $0e | {} | sta $0f", rows(0), rows(1)));
    push(l, "lda vcs_kernel_backs,x | sta $09");
    // Twenty cycles, of which nobody has need.
    push(l, &["nop"; 10].join("|"));
    push(
        l,
        &format!("{} | sta $0f | {} | sta $0e | sta $02", rows(2), rows(3)),
    );
    push(
        l,
        &format!("{} | sta $0e | {} | sta $0f", masked(0), masked(1)),
    );
    push(l, &format!("{} | bit $80", ["nop"; 6].join("|")));
    push(
        l,
        &format!("{} | sta $0f | {} | sta $0e", masked(2), masked(3)),
    );
    push(
        l,
        "dex | bmi vcs_shown | ldy vcs_kernel_rows,x | jmp vcs_kernel",
    );
    label(l, "vcs_shown");
    push(
        l,
        "sta $02 | lda #2 | sta $01 | lda #0 | sta $0e | sta $0f | sta $09",
    );
    push(
        l,
        &format!("sta {FRESH} | lda #{} | sta $0296 | rts", shape.timers[1]),
    );
    convert(shape, l);
    lines
}

/// All columns are there: they become playfield, and what is held is looked at.
fn convert(shape: &Shape, l: &mut Vec<Line>) {
    label(l, "vcs_publish");
    // What was made before is shown first.
    push(l, &format!("lda {FRESH} | bne vcs_publish_wait"));
    push(l, "lda $0284 | cmp #vcs_publish_least | bcs vcs_convert");
    label(l, "vcs_publish_wait");
    push(l, "jsr vcs_frame_part | jmp vcs_publish");
    label(l, "vcs_convert");
    push(l, "lda #0");
    for at in 0..4 * ROWS {
        push(l, &format!("sta ${:04x}", CHIP + at));
    }
    for x in 0..shape.size.0 {
        let column = x + shape.first;
        let (byte, bit) = byte_and_bit(column);
        let rows = CHIP + u16::from(byte) * ROWS;
        push(
            l,
            &format!(
                "ldy ${:04x} | lda ${:04x},y | ora #{bit} | sta ${rows:04x},y",
                HEIGHTS + READ + column as u16,
                rows + READ
            ),
        );
    }
    for byte in 0..4 {
        let rows = CHIP + byte * ROWS;
        push(l, &format!("lda ${:04x}", rows + READ));
        for row in 1..ROWS - 1 {
            push(
                l,
                &format!("ora ${:04x} | sta ${:04x}", rows + READ + row, rows + row),
            );
        }
    }
    if shape.walls.1.is_some() {
        for byte in 0..4 {
            push(
                l,
                &format!(
                    "lda ${:04x} | sta ${:04x}",
                    NEW_MASKS + READ + byte,
                    MASKS + byte
                ),
            );
        }
    }
    push(l, "lda $0280 | and #$f0 | bit $0c | bpl vcs_fires | ora #1");
    label(l, "vcs_fires");
    push(l, &format!("sta {HANDS} | lda #1 | sta {FRESH} | rts"));
}

/// The kernel's tables: which row each pair of lines shows, and the colour behind it, the last
/// pair first.
pub(super) fn tables(shape: &Shape) -> Vec<(&'static str, Vec<u8>)> {
    let (pairs, height) = (shape.pairs, shape.size.1);
    let half = height / 2;
    let row = |k: u32| (pairs * height - 1 - k) / pairs;
    let shown = |k: u32| {
        let y = row(k);
        let from_top = if y < half { y } else { height - 1 - y };
        (u32::from(ROWS) - 1 - half + from_top) as u8
    };
    let back = |k: u32| shape.colours[1 + usize::from(row(k) >= half)];
    let all = 0..pairs * height;
    vec![
        ("vcs_kernel_rows", all.clone().map(shown).collect()),
        ("vcs_kernel_backs", all.map(back).collect()),
    ]
}
