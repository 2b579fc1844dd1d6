//! Adaptive sampling: what pixels leave to later ones waits in bytes, a row for every second
//! row of a band ([`KeptRows`]), with a pointer into the rows of the neighbours and into the
//! pixel's own.
//!
//! The rows come in bands, and in each by halves: the key row below it, the one in the middle,
//! the middles of what is left. A subroutine goes to the next.

use super::Text;
use super::code::Code;
use super::homes::Homes;
use super::slots::{Sampling, Slot};
use crate::ir::graph::*;
use crate::plan::{KeptRows, Plan};
use slowlight_runtime_6502::write::{self, Place as Operand};

/// Where the rows are.
pub(super) const KEPT: &str = "kept_rows";

/// The rows and the names of what they need.
pub(super) struct Refined {
    rows: KeptRows,
    height: u32,
    /// Pointers to what the neighbours left, and to the row's own.
    up: String,
    down: String,
    own: String,
    /// The key row above the band, its last row, and the last of all.
    band: String,
    till: String,
    end: String,
    /// How far neighbours are from the row, and whether it is drawn.
    reach: String,
    seen: String,
    neighbours: [String; 3],
    /// The column, the row, the first and the last row to draw.
    axes: [String; 4],
    /// Bytes of an int that is nothing but a byte.
    wide: u8,
}

impl Refined {
    /// Where a plan does not trace every pixel.
    pub fn new(plan: &Plan, homes: &Homes) -> Option<Refined> {
        let name = |slot| homes.name(slot).to_owned();
        let of = |what| name(Slot::Sampling(what));
        Some(Refined {
            rows: plan.kept_rows()?,
            height: plan.graph.image.height,
            up: of(Sampling::Up),
            down: of(Sampling::Down),
            own: of(Sampling::Own),
            band: of(Sampling::Band),
            till: of(Sampling::Till),
            end: of(Sampling::End),
            reach: of(Sampling::Reach),
            seen: of(Sampling::Seen),
            neighbours: Neighbour::ALL.map(|which| name(Slot::Neighbour(which))),
            axes: [
                Slot::Axis(Axis::X),
                Slot::Axis(Axis::Y),
                Slot::Rows(false),
                Slot::Rows(true),
            ]
            .map(name),
            wide: match super::shapes::by_range(plan) {
                true => 1,
                false => write::size(plan.runtime.int),
            },
        })
    }

    /// Before the first row: the key row above the first that is drawn, and the last of all.
    pub fn begin(&self, code: &mut Code<'_>) {
        let [_, y, first, last] = &self.axes;
        code.copy_axis(&Operand::At(first.clone()), y);
        let step = self.rows.refinement.step;
        let Refined {
            band,
            till,
            end,
            reach,
            ..
        } = self;
        let text = &mut *code.text;
        let mask = 256 - step;
        text.code(&format!("lda {y} | and #{mask} | sta {y} | sta {till}"));
        text.code(&format!("sec | sbc #{step} | sta {band}"));
        text.code(&format!(
            "lda {y}+1 | sta {till}+1 | sbc #0 | sta {band}+1 | lda #1 | sta {reach}"
        ));
        // The key row at the last or below it, or the picture's last.
        text.code(&format!(
            "clc | lda {last} | adc #{} | and #{mask} | sta {end} | lda {last}+1 | adc #0 | sta {end}+1",
            step - 1
        ));
        let [lo, hi, ..] = self.height.saturating_sub(1).to_le_bytes();
        text.code(&format!(
            "lda #{lo} | cmp {end} | lda #{hi} | sbc {end}+1 | bcs end_is_known"
        ));
        text.code(&format!("lda #{lo} | sta {end} | lda #{hi} | sta {end}+1"));
        text.label("end_is_known");
        // Of what neighbours left only the lowest byte is told.
        let above = (1..self.wide).flat_map(|k| {
            let names = self.neighbours.iter();
            names.map(move |name| format!(" | sta {}", write::byte_at(name, k)))
        });
        let above: String = above.collect();
        if !above.is_empty() {
            text.code(&format!("lda #0{above}"));
        }
    }

    /// Before a row's first pixel: where its neighbours are, and whether it is drawn.
    pub fn row(&self, code: &mut Code<'_>) {
        let [_, y, first, last] = &self.axes;
        let Refined {
            up,
            down,
            own,
            band,
            reach,
            seen,
            ..
        } = self;
        let text = &mut *code.text;
        let point = |at: &str| {
            format!("lsr | tax | lda kept_low,x | sta {at} | lda kept_high,x | sta {at}+1")
        };
        text.line("        ; where the neighbours' bytes are");
        text.code(&format!(
            "sec | lda {y} | sbc {band} | sta count | {}",
            point(own)
        ));
        text.code(&format!("sec | lda count | sbc {reach} | {}", point(up)));
        text.code(&format!("clc | lda count | adc {reach} | {}", point(down)));
        let [_, _, left] = &self.neighbours;
        text.code(&format!("ldy #0 | lda ({up}),y | sta {left}"));
        text.code(&format!("sty {seen}"));
        text.code(&format!(
            "lda {y} | cmp {first} | lda {y}+1 | sbc {first}+1 | bcc is_seen"
        ));
        text.code(&format!(
            "lda {last} | cmp {y} | lda {last}+1 | sbc {y}+1 | bcc is_seen"
        ));
        text.code(&format!("inc {seen}"));
        text.label("is_seen");
    }

    /// Takes what a pixel's neighbours have left.
    pub fn receive(&self, code: &mut Code<'_>) {
        let [x, ..] = &self.axes;
        let [above, below, _] = &self.neighbours;
        let Refined { up, down, .. } = self;
        code.text.code(&format!(
            "ldy {x} | lda ({up}),y | sta {above} | lda ({down}),y | sta {below}"
        ));
    }

    /// Leaves what the pixel came to.
    pub fn send(&self, code: &mut Code<'_>) {
        let [x, ..] = &self.axes;
        let [_, _, left] = &self.neighbours;
        let kept = code.homes.operand(code.plan, self.rows.refinement.kept);
        let (kept, own) = (write::byte(&kept, 0), &self.own);
        code.text.code(&format!(
            "lda {kept} | sta {left} | ldy {x} | sta ({own}),y"
        ));
    }

    /// Goes on where a pixel is not seen.
    pub fn unseen(&self) -> String {
        format!("lda {} | beq unseen_pixel", self.seen)
    }

    /// What follows the column into the next 256.
    pub fn next_page(&self) -> String {
        let pointers = [&self.up, &self.down, &self.own];
        let high = pointers.map(|name| format!(" | inc {name}+1"));
        high.concat()
    }

    /// Behind a row: to the next, or to `picture_done`.
    pub fn end(&self, code: &mut Code<'_>) {
        code.text
            .code("jsr below_row | bcs all_rows | jmp next_row");
        code.text.label("all_rows");
        code.text.code("jmp picture_done");
    }

    /// What goes to the next row, with the carry set where there is none.
    pub fn data(&self, text: &mut Text) {
        let [_, y, ..] = &self.axes;
        let Refined {
            up,
            own,
            band,
            till,
            end,
            reach,
            ..
        } = self;
        let (step, width) = (self.rows.refinement.step, self.rows.width);
        text.headline("rows by halves of what is between two key rows");
        text.label("below_row");
        text.code(&format!(
            "lda {reach} | asl | clc | adc {y} | sta {y} | bcc try_row | inc {y}+1"
        ));
        text.label("try_row");
        text.code(&format!(
            "lda {till} | cmp {y} | lda {till}+1 | sbc {y}+1 | bcc half_reach | clc | rts"
        ));
        text.label("half_reach");
        text.code(&format!("lsr {reach} | beq next_band"));
        text.code(&format!(
            "clc | lda {band} | adc {reach} | sta {y} | lda {band}+1 | adc #0 | sta {y}+1 | jmp try_row"
        ));
        text.label("next_band");
        text.code(&format!(
            "lda {till} | sta {band} | lda {till}+1 | sta {band}+1"
        ));
        text.code(&format!(
            "lda {band} | cmp {end} | lda {band}+1 | sbc {end}+1 | bcc more_bands | rts"
        ));
        text.label("more_bands");
        text.line("        ; the key row is above the next band");
        let from = step / 2 * width;
        text.code(&format!(
            "lda #<({KEPT}+{from}) | sta {own} | lda #>({KEPT}+{from}) | sta {own}+1"
        ));
        text.code(&format!(
            "lda #<{KEPT} | sta {up} | lda #>{KEPT} | sta {up}+1"
        ));
        let (pages, rest) = (width / 256, width % 256);
        text.code("ldy #0");
        if pages > 0 {
            text.code(&format!("ldx #{pages}"));
            text.label("copy_page");
            text.code(&format!(
                "lda ({own}),y | sta ({up}),y | iny | bne copy_page | inc {own}+1 | inc {up}+1 | dex | bne copy_page"
            ));
        }
        if rest > 0 {
            text.label("copy_kept");
            text.code(&format!(
                "lda ({own}),y | sta ({up}),y | iny | cpy #{rest} | bne copy_kept"
            ));
        }
        text.code(&format!("lda #{step} | sta {reach}"));
        text.code(&format!(
            "clc | adc {band} | sta {y} | sta {till} | lda {band}+1 | adc #0 | sta {y}+1 | sta {till}+1"
        ));
        text.code(&format!(
            "lda {end} | cmp {till} | lda {end}+1 | sbc {till}+1 | bcc short_band | jmp try_row"
        ));
        text.label("short_band");
        text.code(&format!(
            "lda {end} | sta {till} | lda {end}+1 | sta {till}+1 | jmp try_row"
        ));
        text.line("; the rows; a key row has none below that is read");
        for (label, part) in [("kept_low", '<'), ("kept_high", '>')] {
            let row = |k: u32| format!("{part}({KEPT}+{})", k.min(step / 2) * width);
            let rows: Vec<String> = (0..=step).map(row).collect();
            text.label(label);
            text.line(format!("        .byte {}", rows.join(", ")));
        }
    }
}
