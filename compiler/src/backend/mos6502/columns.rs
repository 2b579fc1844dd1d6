//! Arrays by columns: filled before the first row, read in pixels.
//!
//! An array is kept as planes, as tables are ([`super::table`]): the low bytes of all
//! columns, then their next bytes, and so on.

use super::code::Code;
use super::shapes::entry;
use super::slots::Slot;
use crate::ir::graph::*;
use crate::ir::tree::Place;
use slowlight_runtime_6502::write::{Place as Operand, byte_at};

/// Columns that an index of one byte reaches.
const NEAR: u32 = 256;

impl Code<'_> {
    /// The loop over the columns, `first` to `last`, that fills the arrays.
    pub(super) fn fill_columns(&mut self, (first, last): (u32, u32)) {
        let plan = self.plan;
        if plan.tree.column.is_empty() {
            return;
        }
        let x = self.homes.name(Slot::Axis(Axis::X)).to_owned();
        self.text.headline("once a column");
        self.copy_axis(&Operand::Constant(u64::from(first)), &x);
        self.text.label("next_entry");
        self.block(&plan.tree.column);
        self.text.span = None;
        let [lo, hi, ..] = last.to_le_bytes();
        self.text.code(&format!(
            "lda {x} | cmp #{lo} | lda {x}+1 | sbc #{hi} | bcs entries_done"
        ));
        self.text
            .code(&format!("inc {x} | bne more_entries | inc {x}+1"));
        self.text.label("more_entries");
        self.text.code("jmp next_entry");
        self.text.label("entries_done");
    }

    /// Keeps a value that has just been set at its column.
    pub(super) fn keep_column(&mut self, place: Place) {
        match place {
            Place::Node(id) if self.plan.is_tabulated(id) => {
                self.through_column(id, |home, entry| format!("lda {home} | sta {entry}"));
            }
            _ => {}
        }
    }

    /// Reads a value at the pixel's column.
    pub(super) fn read_column(&mut self, id: NodeId) {
        self.through_column(id, |home, entry| format!("lda {entry} | sta {home}"));
    }

    /// What is done with each byte of a value's home and of its entry.
    fn through_column(&mut self, id: NodeId, each: impl Fn(&str, &str) -> String) {
        let place = Place::Node(id);
        let home = self.homes.place(place).to_owned();
        let array = self.homes.name(Slot::Column(id)).to_owned();
        let x = self.homes.name(Slot::Axis(Axis::X)).to_owned();
        let bytes = match self.homes.shape(self.plan, place) {
            Some(shape) => shape.bytes,
            None => entry(self.plan, id),
        };
        let width = self.plan.graph.image.width;
        let from = |first: u32| {
            let bytes = (0..bytes).map(|k| {
                let at = u32::from(k) * width + first;
                each(&byte_at(&home, k), &format!("{array}+{at},x"))
            });
            bytes.collect::<Vec<_>>().join(" | ")
        };
        self.text.code(&format!("ldx {x}"));
        if width <= NEAR {
            return self.text.code(&from(0));
        }
        let n = self.text.next_serial();
        self.text.code(&format!("lda {x}+1 | bne beyond{n}"));
        self.text.code(&from(0));
        self.text.code(&format!("jmp column{n}"));
        self.text.label(&format!("beyond{n}"));
        self.text.code(&from(NEAR));
        self.text.label(&format!("column{n}"));
    }
}
