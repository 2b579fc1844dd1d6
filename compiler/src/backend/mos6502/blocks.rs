//! Pixels drawn as blocks: line by line, since the machine's port goes on to the right by
//! itself after each ink, and to the next line never.

use super::Text;
use super::homes::Homes;
use super::slots::Slot;
use crate::ir::graph::Axis;
use crate::passes::loops::strip_mine::passes;
use crate::plan::Plan;
use slowlight_runtime_6502::write::{self, Place as Operand};

/// Pixels of a line that are drawn without counting, at most.
const TOGETHER: u32 = 8;

/// The names and sizes of what draws blocks.
pub(super) struct Blocks {
    /// Where the block's left column and top row on the screen are kept.
    place: [String; 2],
    /// Columns and rows of a block.
    size: (u32, u32),
    /// The left column of a row's first block, and the screen's row of the picture's first.
    first: [u64; 2],
    /// How far a pixel's block is from the next one drawn, in blocks.
    passes: u32,
}

impl Blocks {
    /// Where the picture is of blocks.
    pub fn new(plan: &Plan, homes: &Homes) -> Option<Blocks> {
        let size = plan.graph.image.block;
        if size == (1, 1) {
            return None;
        }
        let place = [Axis::X, Axis::Y].map(|axis| homes.name(Slot::Block(axis)).to_owned());
        let (column, _) = plan.computed_columns();
        let left = i64::from(column) * i64::from(size.0) + i64::from(plan.offset.0);
        let first = [left, i64::from(plan.offset.1)].map(|n| n as u64);
        let passes = passes(&plan.graph);
        Some(Blocks {
            place,
            size,
            first,
            passes,
        })
    }

    /// Before a row's first block: both places. The row's is a sum, which is short.
    pub fn row(&self, y: &str, text: &mut Text) {
        for (name, first) in self.place.iter().zip(self.first) {
            let [lo, hi] = [0, 1].map(|k| write::byte(&Operand::Constant(first), k));
            text.code(&format!("lda {lo} | sta {name} | lda {hi} | sta {name}+1"));
        }
        let [_, name] = &self.place;
        let [lo, hi, ..] = self.size.1.to_le_bytes();
        // As many times as a block has rows; the high byte counts down last.
        text.code(&format!("ldx #{lo} | ldy #{}", hi + u8::from(lo > 0)));
        text.label("down_to_row");
        text.code(&format!("clc | lda {name} | adc {y} | sta {name}"));
        text.code(&format!("lda {name}+1 | adc {y}+1 | sta {name}+1"));
        text.code("dex | bne down_to_row | dey | bne down_to_row");
    }

    /// Before the first block of a pass at a column.
    pub fn pass(&self, start: &str, first: u32, text: &mut Text) {
        let [left, _] = &self.place;
        let [lo, hi] = [0, 1].map(|k| write::byte(&Operand::Constant(self.first[0]), k));
        text.code(&format!("lda {lo} | sta {left} | lda {hi} | sta {left}+1"));
        let [behind, ..] = first.to_le_bytes();
        text.code(&format!(
            "sec | lda {start} | sbc #{behind} | tax | beq at_pass"
        ));
        text.label("right_to_pass");
        self.right(1, text);
        text.code("dex | bne right_to_pass");
        text.label("at_pass");
    }

    /// So many blocks to the right.
    fn right(&self, blocks: u32, text: &mut Text) {
        let [left, _] = &self.place;
        let [lo, hi, ..] = (blocks * self.size.0).to_le_bytes();
        text.code(&format!("clc | lda {left} | adc #{lo} | sta {left}"));
        text.code(&format!("lda {left}+1 | adc #{hi} | sta {left}+1"));
    }

    /// Draws the block.
    pub fn draw(&self, ink: &str, text: &mut Text) {
        let [left, top] = &self.place;
        let high = self.size.1 & 0xFF;
        text.code("ldx #0");
        text.label("block_line");
        text.code(&format!(
            "lda {left} | sta x_port | lda {left}+1 | sta x_port+1"
        ));
        text.code(&format!("clc | txa | adc {top} | sta y_port"));
        text.code(&format!("lda {top}+1 | adc #0 | sta y_port+1"));
        text.code(&format!("lda {ink}"));
        self.dots(text);
        text.code(&format!("inx | cpx #{high} | bne block_line"));
    }

    /// A line of a block in the ink in a: as many pixels at a time as divide it, since
    /// counting one takes longer than drawing it.
    fn dots(&self, text: &mut Text) {
        let wide = self.size.0;
        let mut divisors = (1..=TOGETHER).rev().filter(|n| wide.is_multiple_of(*n));
        let together = divisors.next().unwrap_or(1);
        let turns = wide / together;
        if turns > 1 {
            text.code(&format!("ldy #{}", turns & 0xFF));
            text.label("block_dot");
        }
        for _ in 0..together {
            text.code("sta ink_port");
        }
        if turns > 1 {
            text.code("dey | bne block_dot");
        }
    }

    /// Goes on to the next block of the row or pass.
    pub fn next(&self, text: &mut Text) {
        self.right(self.passes, text);
    }
}
