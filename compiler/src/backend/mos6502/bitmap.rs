//! Screens that are memory: pixels gathered into bytes, and each byte stored once.
//!
//! In both machines a byte is some pixels side by side, and the next row's is in the next
//! byte of the same character: eight bytes a character, then the character to the right.
//! So a row steps by 8 and the next row by 1, and only every eighth row by more; no
//! address is computed.
//!
//! A byte that is being gathered has a **mark** in front of its pixels, which leaves it
//! for the carry flag when the last pixel comes in: that is all that counts them. How far
//! a pixel shifts those before it depends on how they lie ([`Lie`]).

use super::Text;
use super::homes::Homes;
use super::layout::{Layout, Lie};
use super::slots::{Sampling, Slot};
use crate::ir::graph::Axis;
use crate::plan::Plan;
use std::ops::RangeInclusive;

/// How a plan's picture goes to its screen.
pub(super) struct Bitmap {
    layout: Layout,
    /// Columns on the screen of the first pixel, and how many are drawn.
    left: u32,
    width: u32,
    /// The row on the screen of the first that may be drawn, and which of the picture's that is.
    top: u32,
    first: u32,
    block: (u32, u32),
    inks: u32,
    /// The columns that are seen, where more are computed.
    seen: Option<RangeInclusive<u32>>,
    /// Where rows are computed that are not drawn: what goes to `unseen_row` there.
    unseen: Option<String>,
    /// Whether rows come in another order than down the screen.
    jumps: bool,
    /// Whether there are two screens.
    turns: bool,
    /// The pixel's column, its row, and the first row to draw.
    axes: [String; 3],
    byte: String,
    at: String,
    line: String,
}

impl Bitmap {
    /// Where the plan draws on a screen that is memory.
    pub fn new(plan: &Plan, homes: &Homes) -> Option<Bitmap> {
        let layout = Layout::of(plan)?;
        let block = plan.graph.image.block;
        let place = |k: u32, size: u32, offset: i32| {
            u32::try_from(i64::from(k) * i64::from(size) + i64::from(offset)).unwrap_or(0)
        };
        let (first, _) = plan.shown_rows();
        let (from, to) = plan.columns;
        let name = |slot| homes.name(slot).to_owned();
        let axes = [Slot::Axis(Axis::X), Slot::Axis(Axis::Y), Slot::Rows(false)].map(name);
        let [_, y, top] = &axes;
        let unseen = match plan.kept_rows() {
            Some(_) => format!(
                "lda {} | beq unseen_row",
                name(Slot::Sampling(Sampling::Seen))
            ),
            None => format!("lda {y} | cmp {top} | lda {y}+1 | sbc {top}+1 | bcc unseen_row"),
        };
        Some(Bitmap {
            layout,
            left: place(from, block.0, plan.offset.0),
            width: (to - from + 1) * block.0,
            top: place(first, block.1, plan.offset.1),
            first,
            block,
            inks: plan.mode.inks,
            seen: (plan.computed_columns() != plan.columns).then_some(from..=to),
            unseen: plan.graph.is_in_order().then_some(unseen),
            jumps: plan.kept_rows().is_some(),
            turns: layout.second(plan).is_some(),
            axes,
            byte: name(Slot::ScreenByte),
            at: name(Slot::ScreenAt),
            line: name(Slot::ScreenLine),
        })
    }

    /// Where on the screen the first row's first byte is.
    pub fn first_byte(&self) -> u32 {
        let Layout { row, pixels, .. } = self.layout;
        self.top / 8 * row + self.left / pixels * 8 + self.top % 8
    }

    /// At the picture's beginning: to its first row.
    pub fn open(&self, text: &mut Text) {
        let start = self.layout.start;
        if self.jumps {
            return;
        }
        let (line, [_, _, first]) = (&self.line, &self.axes);
        text.line("        ; to the first row");
        if self.turns {
            text.code(&format!(
                "ldx hidden | lda hidden_low,x | sta {line} | lda hidden_high,x | sta {line}+1"
            ));
        } else {
            let [lo, hi, ..] = (u32::from(start) + self.first_byte()).to_le_bytes();
            text.code(&format!(
                "lda #{lo} | sta {line} | lda #{hi} | sta {line}+1"
            ));
        }
        text.code(&format!("lda {first}"));
        if self.first > 0 {
            text.code(&format!("sec | sbc #{}", self.first));
        }
        text.code("tax | beq first_line");
        text.label("skip_row");
        self.lines("skip_line", self.block.1, text);
        text.code("dex | bne skip_row");
        text.label("first_line");
    }

    /// So many lines down. Leaves x alone.
    fn lines(&self, label: &str, count: u32, text: &mut Text) {
        if count == 1 {
            return text.code("jsr next_line");
        }
        text.code(&format!("ldy #{count}"));
        text.label(label);
        text.code(&format!("jsr next_line | dey | bne {label}"));
    }

    /// To the line of a row that need not be the next: its characters' first line, and then
    /// so many further.
    fn to_row(&self, text: &mut Text) {
        let Layout {
            start, row, pixels, ..
        } = self.layout;
        let (line, [_, y, _]) = (&self.line, &self.axes);
        let [lo, hi, ..] = (u32::from(start) + self.left / pixels * 8).to_le_bytes();
        // Rows that are not shown have a line of others, which is left alone.
        let top = self.top.wrapping_sub(self.first * self.block.1) & 0xFF;
        match self.block.1 {
            1 => text.code(&format!("clc | lda {y} | adc #{top}")),
            high => {
                text.code(&format!("lda #{top} | ldx {y} | beq on_line"));
                text.label("lines_to_row");
                text.code(&format!("clc | adc #{high} | dex | bne lines_to_row"));
                text.label("on_line");
            }
        }
        text.code(&format!(
            "tax | and #7 | clc | adc #{lo} | sta {line} | lda #{hi} | adc #0 | sta {line}+1"
        ));
        let [lo, hi, ..] = row.to_le_bytes();
        text.code("txa | lsr | lsr | lsr | tax | beq at_row");
        text.label("characters_to_row");
        text.code(&format!(
            "clc | lda {line} | adc #{lo} | sta {line} | lda {line}+1 | adc #{hi} | sta {line}+1"
        ));
        text.code("dex | bne characters_to_row");
        text.label("at_row");
    }

    /// Before a row's first pixel.
    pub fn row(&self, text: &mut Text) {
        let Bitmap { line, at, byte, .. } = self;
        if self.jumps {
            self.to_row(text);
        }
        text.code(&format!(
            "lda {line} | sta {at} | lda {line}+1 | sta {at}+1"
        ));
        let mark = self.layout.mark(self.left % self.layout.pixels);
        text.code(&format!("lda #{mark} | sta {byte}"));
    }

    /// Puts a pixel into its byte, and a byte that is whole onto the screen. Goes to
    /// `unseen_pixel` where its column is not seen.
    pub fn pixel(&self, ink: &str, text: &mut Text) {
        let [x, ..] = &self.axes;
        if let Some(seen) = &self.seen {
            let [a0, a1, ..] = seen.start().to_le_bytes();
            let [b0, b1, ..] = seen.end().to_le_bytes();
            text.code(&format!(
                "lda {x} | cmp #{a0} | lda {x}+1 | sbc #{a1} | bcc unseen_pixel"
            ));
            text.code(&format!(
                "lda #{b0} | cmp {x} | lda #{b1} | sbc {x}+1 | bcc unseen_pixel"
            ));
        }
        if self.block.0 > 1 {
            text.code(&format!("ldx #{}", self.block.0));
            text.label("block_dot");
        }
        self.put(ink, text);
        if self.block.0 > 1 {
            text.code("dex | bne block_dot");
        }
    }

    fn put(&self, ink: &str, text: &mut Text) {
        let Bitmap { byte, at, .. } = self;
        text.code(&match self.layout.lie {
            Lie::Bits => format!("lda {ink} | lsr | rol {byte} | bcc part_of_byte | lda {byte}"),
            Lie::Spread => {
                format!("ldy {ink} | lda patterns,y | asl {byte} | ora {byte} | bcc part_of_byte")
            }
            Lie::Pairs => {
                format!("lda {byte} | asl | asl | ora {ink} | bcc part_of_byte")
            }
        });
        // The carry is 1 here.
        text.code(&format!(
            "ldy #0 | sta ({at}),y | lda {at} | adc #7 | sta {at} | bcc next_byte | inc {at}+1"
        ));
        text.label("next_byte");
        text.code(&format!("lda #{}", self.layout.mark(0)));
        match self.layout.lie {
            Lie::Bits => {
                text.code(&format!("sta {byte}"));
                text.label("part_of_byte");
            }
            Lie::Spread | Lie::Pairs => {
                text.label("part_of_byte");
                text.code(&format!("sta {byte}"));
            }
        }
    }

    /// Behind a row's last pixel: what is left of a byte, a block's other lines, and to
    /// the next row.
    pub fn row_done(&self, text: &mut Text) {
        let Bitmap { byte, at, .. } = self;
        if let Some(unseen) = &self.unseen {
            text.code(unseen);
        }
        let over = (self.left + self.width) % self.layout.pixels;
        if over > 0 {
            let left = self.layout.pixels - over;
            let bits = match self.layout.lie {
                Lie::Pairs => 2 * left,
                Lie::Bits | Lie::Spread => left,
            };
            let shifts = " | asl".repeat(bits as usize);
            text.code(&format!("lda {byte}{shifts} | ldy #0 | sta ({at}),y"));
        }
        if self.block.1 > 1 {
            self.copy_lines(text);
        }
        text.code("jsr next_line");
        if self.unseen.is_some() {
            text.label("unseen_row");
        }
    }

    /// A block's other lines are copies of its first.
    fn copy_lines(&self, text: &mut Text) {
        let Bitmap { line, at, .. } = self;
        let bytes = (self.left % self.layout.pixels + self.width).div_ceil(self.layout.pixels);
        text.code(&format!("ldx #{}", self.block.1 - 1));
        text.label("copy_line");
        text.code(&format!(
            "lda {line} | sta {at} | lda {line}+1 | sta {at}+1 | jsr next_line"
        ));
        text.code(&format!(
            "lda {line} | sta prod | lda {line}+1 | sta prod+1 | ldy #0 | lda #{bytes} | sta count"
        ));
        text.label("copy_byte");
        text.code(&format!(
            "lda ({at}),y | sta (prod),y | tya | clc | adc #8 | tay | bcc copied_byte | inc {at}+1 | inc prod+1"
        ));
        text.label("copied_byte");
        text.code("dec count | bne copy_byte | dex | bne copy_line");
    }

    /// What is called, and the inks' patterns.
    pub fn data(&self, text: &mut Text) {
        let line = &self.line;
        text.headline("the screen");
        text.line(
            "; the line below: the next byte, or every eighth time the next character's first",
        );
        text.label("next_line");
        text.code(&format!(
            "lda {line} | and #7 | cmp #7 | beq next_character"
        ));
        text.code(&format!("inc {line} | rts"));
        text.label("next_character");
        // The carry is 1 here.
        let [lo, hi, ..] = (self.layout.row - 8).to_le_bytes();
        text.code(&format!(
            "lda {line} | adc #{lo} | sta {line} | lda {line}+1 | adc #{hi} | sta {line}+1 | rts"
        ));
        if self.layout.lie == Lie::Spread {
            let patterns = (0..self.inks).map(|ink| format!("${:02x}", self.layout.pattern(ink)));
            let patterns: Vec<String> = patterns.collect();
            text.line("; each ink's bits where a byte's last pixel has them");
            text.label("patterns");
            text.line(format!("        .byte {}", patterns.join(", ")));
        }
    }
}
