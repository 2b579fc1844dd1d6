//! Error diffusion: what pixels send to later ones waits in memory, a row for
//! each that a share reaches ([`ErrorRows`]), with a pointer into each.
//!
//! A pointer stands as far left of the pixel as a share may reach, so that an
//! index of one byte finds all that a pixel sends to. The pointers move on with
//! the pixels; behind a row they go back, and change places.

use super::code::Code;
use super::homes::Homes;
use super::logs;
use super::memory::{error_size, row_bytes};
use super::slots::Slot;
use crate::plan::ErrorRows;
use slowlight_runtime_6502::write::{self, Goal, Place as Operand};

fn pointer(homes: &Homes, row: u32) -> String {
    homes.name(Slot::Errors(row)).to_owned()
}

impl Code<'_> {
    /// All errors 0, and the pointers at their rows' beginnings.
    pub(super) fn start_errors(&mut self, rows: &ErrorRows) {
        let first = pointer(self.homes, 0);
        let (bytes, size) = (row_bytes(self.plan, rows), error_size(self.plan));
        // The first page from where the others are whole.
        let pages = bytes.div_ceil(256);
        let before = pages * 256 - bytes;
        let text = &mut *self.text;
        text.headline("no errors yet");
        text.code(&format!(
            "lda #<(errors-{before}) | sta {first} | lda #>(errors-{before}) | sta {first}+1"
        ));
        text.code(&format!("ldx #{pages} | ldy #{before} | lda #0"));
        text.label("clear_errors");
        text.code(&format!(
            "sta ({first}),y | iny | bne clear_errors | inc {first}+1 | dex | bne clear_errors"
        ));
        for k in 0..rows.rows {
            let name = pointer(self.homes, k);
            let at = k * rows.length() * size;
            self.text.code(&format!(
                "lda #<(errors+{at}) | sta {name} | lda #>(errors+{at}) | sta {name}+1"
            ));
        }
    }

    /// Takes what a pixel has received, and leaves 0.
    pub(super) fn receive_errors(&mut self, rows: &ErrorRows) {
        let size = error_size(self.plan);
        let (row, home) = (pointer(self.homes, 0), self.homes.name(Slot::Received));
        self.text.line(format!("        ; {home} = what came here"));
        for k in 0..size {
            let load = if k == 0 {
                format!("ldy #{}", size * rows.left)
            } else {
                "iny".to_owned()
            };
            let to = write::byte_at(home, k as u8);
            let other = self.none(k as u8);
            self.text.code(&format!(
                "{load} | lda ({row}),y{other} | sta {to} | lda #0 | sta ({row}),y"
            ));
        }
    }

    /// Sends a pixel's shares, and moves the pointers on.
    pub(super) fn send_errors(&mut self, rows: &ErrorRows) {
        let size = error_size(self.plan);
        for share in &rows.shares {
            let row = pointer(self.homes, u32::try_from(share.dy).unwrap_or(0));
            let right = i64::from(rows.left) + i64::from(share.dx);
            let at = i64::from(size) * right;
            self.text.span = Some(self.plan.graph.span(share.node));
            self.text
                .line(format!("        ; to ({}, {})", share.dx, share.dy));
            // Before what waits there: to read at another scale takes `acc`.
            let sent = match self.plan.points() {
                Some(points) => {
                    let to = (points.received(), points.widths().most());
                    self.read_at(points, share.node, to, "second")
                }
                None => self.homes.operand(self.plan, share.node),
            };
            self.text.code(&format!("ldy #{at}"));
            self.each_byte(&format!("lda ({row}),y | sta acc"));
            if let Some(routine) = self.plan.gather() {
                let args = [Operand::At("acc".to_owned()), sent];
                self.use_of(routine, &args, &Goal::At("prod"), 0);
            }
            self.text.code(&format!("ldy #{at}"));
            self.each_byte(&format!("lda prod | sta ({row}),y"));
        }
        self.text.span = self.plan.drawn;
        for k in 0..rows.rows {
            let name = pointer(self.homes, k);
            self.text.code(&format!(
                "clc | lda {name} | adc #{size} | sta {name} | bcc moved{k} | inc {name}+1"
            ));
            self.text.label(&format!("moved{k}"));
        }
    }

    /// Instructions for each byte of an error; `acc` and `prod` in them stand
    /// for the byte's place, and y moves on.
    fn each_byte(&mut self, instructions: &str) {
        for k in 0..error_size(self.plan) as u8 {
            let text = ["acc", "prod"]
                .iter()
                .fold(instructions.to_owned(), |t, n| {
                    t.replace(n, &write::byte_at(n, k))
                });
            let step = if k == 0 { "" } else { "iny | " };
            let other = format!("{} | sta", self.none(k));
            self.text
                .code(&format!("{step}{}", text.replace(" | sta", &other)));
        }
    }

    /// What makes a byte of an error of one that waits, or the other way round: of a
    /// logarithm, that what is cleared is 0.
    fn none(&self, k: u8) -> String {
        match logs::are(self.plan) && k == 1 {
            true => format!(" | eor #${:02x}", logs::LEAST),
            false => String::new(),
        }
    }

    /// Behind a row: back to its beginning, and the row that is done becomes
    /// the furthest one.
    pub(super) fn turn_errors(&mut self, rows: &ErrorRows) {
        let names: Vec<String> = (0..rows.rows).map(|k| pointer(self.homes, k)).collect();
        let [lo, hi, ..] = (error_size(self.plan) * rows.width).to_le_bytes();
        for name in &names {
            self.text.code(&format!(
                "sec | lda {name} | sbc #{lo} | sta {name} | lda {name}+1 | sbc #{hi} | sta {name}+1"
            ));
        }
        let [first, .., last] = names.as_slice() else {
            return;
        };
        self.text.code(&format!("ldx {first} | ldy {first}+1"));
        for pair in names.windows(2) {
            if let [to, from] = pair {
                self.text.code(&format!(
                    "lda {from} | sta {to} | lda {from}+1 | sta {to}+1"
                ));
            }
        }
        self.text.code(&format!("stx {last} | sty {last}+1"));
    }
}
