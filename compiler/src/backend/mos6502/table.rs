//! Constant tables and lookups in them.
//!
//! A table is kept as planes: the low bytes of all entries, row by row, then
//! their next bytes, and so on; a plane whose bytes are all alike is left out.
//! Up to 256 entries are indexed by x, and up to 512 in a row by x in one of two pages. A larger
//! table is read through a pointer.

use super::super::starts::tables;
use super::Text;
use super::code::Code;
use crate::ir::graph::*;
use crate::ir::tree::Place;
use crate::plan::Plan;
use slowlight_routine::{Bits, Range};
use slowlight_runtime_6502::write::{self, Place as Operand};

/// Byte `k` of every entry.
fn plane(plan: &Plan, (id, table): (TableId, &Table), k: u8) -> Vec<u8> {
    let byte = |bits: Bits| bits.to_le_bytes().get(usize::from(k)).copied().unwrap_or(0);
    let bits = |(at, e): (usize, &Constant)| match plan.points() {
        Some(_) => plan.entry(id, at),
        None => plan.bits(e.value()),
    };
    let entries = table.entries.iter().enumerate();
    entries.map(|entry| byte(bits(entry))).collect()
}

/// The one byte that a plane is made of, if it is.
fn uniform(plane: &[u8]) -> Option<u8> {
    let first = plane.first()?;
    plane.iter().all(|b| b == first).then_some(*first)
}

fn planes(plan: &Plan, id: TableId, table: &Table) -> Vec<Vec<u8>> {
    let size = write::size(plan.entry_format(id));
    (0..size).map(|k| plane(plan, (id, table), k)).collect()
}

/// A plane's label.
fn label(table: TableId, k: usize) -> String {
    format!("table{}_{k}", table.0)
}

/// Whether some table is too large for an index of one byte.
pub(super) fn any_large(plan: &Plan) -> bool {
    let large = |t: &TableId| plan.graph.tables.get(t.0 as usize).is_some_and(is_large);
    tables(plan).iter().any(large)
}

fn is_large(table: &Table) -> bool {
    table.entries.len() > 256
}

/// Whether the first two bytes of a place are all that an index of such a range has.
fn has_two_bytes(place: &Operand, range: Range) -> bool {
    let short = matches!(place, Operand::Held(_, shape) if shape.bytes < 2);
    range.within(if short { 0.0 } else { -32768.0 }, 32767.0)
}

/// Writes the tables that are used.
pub(super) fn data(plan: &Plan, text: &mut Text) {
    for id in tables(plan) {
        let Some(table) = plan.graph.tables.get(id.0 as usize) else {
            continue;
        };
        text.headline(&format!(
            "table {}, {} x {}",
            table.name, table.width, table.height
        ));
        for (k, plane) in planes(plan, id, table).iter().enumerate() {
            if uniform(plane).is_some() {
                continue;
            }
            text.label(&label(id, k));
            for row in plane.chunks(16) {
                let bytes: Vec<String> = row.iter().map(u8::to_string).collect();
                text.line(format!("        .byte {}", bytes.join(", ")));
            }
        }
        if !is_large(table) && table.height > 1 && !table.width.is_power_of_two() {
            text.label(&rows_label(id));
            let offsets = (0..table.height).map(|row| ((row * table.width) & 0xFF).to_string());
            text.line(format!(
                "        .byte {}",
                offsets.collect::<Vec<_>>().join(", ")
            ));
        }
    }
}

/// Where each row begins.
fn rows_label(table: TableId) -> String {
    format!("table{}_rows", table.0)
}

impl Code<'_> {
    /// Computes a lookup into its home.
    pub(super) fn lookup(&mut self, id: NodeId, of: TableId, column: NodeId, row: NodeId) {
        let plan = self.plan;
        let Some(table) = plan.graph.tables.get(of.0 as usize) else {
            return;
        };
        let place = Place::Node(id);
        let home = self.homes.place(place).to_owned();
        let bytes = match self.homes.shape(plan, place) {
            Some(shape) => shape.bytes,
            None => write::size(plan.runtime.format_of(table.ty)),
        };
        if is_large(table) {
            return self.large_lookup((id, &home, bytes), (of, table), column, row);
        }
        let [columns, rows] = plan.ranges.args[id.0 as usize];
        let column = self.index(column, (columns, table.width), "arg");
        let row = if table.height > 1 {
            Some(self.index(row, (rows, table.height), "low"))
        } else {
            None
        };
        self.text.code(&match row {
            None => format!("ldx {column}"),
            Some(row) if table.width.is_power_of_two() => {
                let shifts = " | asl".repeat(table.width.trailing_zeros() as usize);
                format!("lda {row}{shifts} | clc | adc {column} | tax")
            }
            Some(row) => {
                let load = if row.starts_with('#') {
                    format!("lda {row} | tax")
                } else {
                    format!("ldx {row}")
                };
                format!(
                    "{load} | lda {},x | clc | adc {column} | tax",
                    rows_label(of)
                )
            }
        });
        let planes = planes(plan, of, table);
        let planes = planes.get(..usize::from(bytes)).unwrap_or(&planes);
        self.entry(&home, (of, planes), "");
    }

    /// One byte that holds an index, clamped to 0..n-1: the operand itself where
    /// its range is proved to lie inside, else kept in `to`.
    fn index(&mut self, id: NodeId, (range, n): (Range, u32), to: &str) -> String {
        let place = self.homes.operand(self.plan, id);
        if range.within(0.0, f64::from(n) - 1.0) {
            return write::byte(&place, 0);
        }
        let signed = n <= 0x80 && range.within(-128.0, 127.0);
        if signed || range.within(0.0, 255.0) {
            self.clamp_byte(&place, (range, n), to);
            return to.to_owned();
        }
        self.clamp(&place, n);
        self.text.code(&format!("lda acc | sta {to}"));
        to.to_owned()
    }

    /// The same of an index of one byte.
    fn clamp_byte(&mut self, place: &Operand, (range, n): (Range, u32), to: &str) {
        let serial = self.text.next_serial();
        self.text.code(&format!("lda {}", write::byte(place, 0)));
        if range.lo < 0.0 {
            self.text.code(&format!(
                "bpl above_byte{serial} | lda #0 | beq within_byte{serial}"
            ));
            self.text.label(&format!("above_byte{serial}"));
        }
        self.text.code(&format!(
            "cmp #{n} | bcc within_byte{serial} | lda #{}",
            n - 1
        ));
        self.text.label(&format!("within_byte{serial}"));
        self.text.code(&format!("sta {to}"));
    }

    /// `acc` = the index in a place, clamped.
    fn clamp(&mut self, place: &Operand, n: u32) {
        self.copy_to(place, "acc");
        self.copy_to(&Operand::Constant(Bits::from(n.saturating_sub(1))), "prod");
        self.text.code("jsr clamp_index");
        self.clamps = true;
    }

    /// In the page that the index's second byte says, clamped where the index may be outside.
    fn paged_lookup(
        &mut self,
        home: &str,
        (of, planes): (TableId, &[Vec<u8>]),
        (place, range): (&Operand, Range),
    ) {
        let n = self.text.next_serial();
        let entries = planes.iter().map(Vec::len).max().unwrap_or(0);
        let last = entries.saturating_sub(1);
        let [low, high] = [0, 1].map(|k| write::byte(place, k));
        self.text
            .code(&format!("ldx {low} | lda {high} | beq first{n}"));
        if range.lo < 0.0 {
            self.text.code(&format!("bmi below{n}"));
        }
        if range.hi > last as f64 {
            if last > 256 {
                self.text
                    .code(&format!("cmp #1 | bne above{n} | cpx #{}", last - 256));
                self.text.code(&format!("bcc inside{n}"));
                self.text.label(&format!("above{n}"));
            }
            self.text.code(&format!("ldx #{}", last - 256));
            if last > 256 {
                self.text.label(&format!("inside{n}"));
            }
        }
        self.entry(home, (of, planes), "+256");
        self.text.code(&format!("jmp read{n}"));
        if range.lo < 0.0 {
            self.text.label(&format!("below{n}"));
            self.text.code("ldx #0");
        }
        self.text.label(&format!("first{n}"));
        self.entry(home, (of, planes), "");
        self.text.label(&format!("read{n}"));
    }

    /// Copies the entry at x, so far behind a table's first.
    fn entry(&mut self, home: &str, (of, planes): (TableId, &[Vec<u8>]), behind: &str) {
        for (k, plane) in planes.iter().enumerate() {
            let to = write::byte_at(home, k as u8);
            self.text.code(&match uniform(plane) {
                Some(byte) => format!("lda #${byte:02x} | sta {to}"),
                None => format!("lda {}{behind},x | sta {to}", label(of, k)),
            });
        }
    }

    /// Through a pointer to the entry's first byte that is not that of all; the other planes follow.
    fn large_lookup(
        &mut self,
        (id, home, bytes): (NodeId, &str, u8),
        (of, table): (TableId, &Table),
        column: NodeId,
        row: NodeId,
    ) {
        let [columns, _] = self.plan.ranges.args[id.0 as usize];
        let mut place = self.homes.operand(self.plan, column);
        if table.height == 1 && table.entries.len() <= 512 && has_two_bytes(&place, columns) {
            let planes = planes(self.plan, of, table);
            let planes = planes.get(..usize::from(bytes)).unwrap_or(&planes);
            return self.paged_lookup(home, (of, planes), (&place, columns));
        }
        if table.height > 1 {
            let row = self.homes.operand(self.plan, row);
            self.clamp(&row, table.height);
            self.copy_to(&Operand::Constant(Bits::from(table.width)), "arg");
            self.text
                .code("jsr int_multiply | lda acc | sta prod+4 | lda acc+1 | sta prod+5");
        }
        if !columns.within(0.0, f64::from(table.width) - 1.0) {
            self.clamp(&place, table.width);
            place = Operand::At("acc".to_owned());
        }
        let [mut low, mut high] = [0, 1].map(|k| write::byte(&place, k));
        if table.height > 1 {
            self.text
                .code(&format!("clc | lda {low} | adc prod+4 | sta acc"));
            self.text
                .code(&format!("lda {high} | adc prod+5 | sta acc+1"));
            (low, high) = ("acc".to_owned(), "acc+1".to_owned());
        }
        let [lo, hi, ..] = (table.entries.len() as u32).to_le_bytes();
        let planes = planes(self.plan, of, table);
        let planes = planes.iter().enumerate().take(usize::from(bytes));
        let (alike, others): (Vec<_>, Vec<_>) = planes.partition(|(_, p)| uniform(p).is_some());
        for (nth, (k, _)) in others.into_iter().enumerate() {
            let to = write::byte_at(home, k as u8);
            if nth > 0 {
                self.text.code(&format!(
                    "clc | lda acc | adc #{lo} | sta acc | lda acc+1 | adc #{hi} | sta acc+1"
                ));
            } else {
                let first = label(of, k);
                self.text
                    .code(&format!("clc | lda {low} | adc #<({first}) | sta acc"));
                self.text.code(&format!(
                    "lda {high} | adc #>({first}) | sta acc+1 | ldy #0"
                ));
            }
            self.text.code(&format!("lda (acc),y | sta {to}"));
        }
        // Only then, as nothing says here that the index is elsewhere than the entry.
        for (k, plane) in alike {
            let (to, byte) = (write::byte_at(home, k as u8), plane.first());
            let byte = byte.copied().unwrap_or(0);
            self.text.code(&format!("lda #${byte:02x} | sta {to}"));
        }
    }
}

/// `acc` clamped to 0..prod, which is not negative.
pub(super) const CLAMP: &str = "\
clamp_index:
        lda acc+3
        bpl clamp_index_above
        lda #0
        sta acc
        sta acc+1
        rts
clamp_index_above:
        lda prod
        cmp acc
        lda prod+1
        sbc acc+1
        lda #0
        sbc acc+2
        lda #0
        sbc acc+3
        bcs clamp_index_done
        lda prod
        sta acc
        lda prod+1
        sta acc+1
clamp_index_done:
        rts";
