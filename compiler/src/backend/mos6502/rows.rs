//! The loops over rows and columns.
//!
//! A row is drawn from left to right; or, where the plan has passes
//! ([`crate::passes::loops::strip_mine`]), in passes over every nth column; or in runs of columns
//! ([`crate::schedule::segment`]): what the plan's segment block computes holds until a
//! comparison of the column with what the row knows changes, and each of those, as it is
//! met, says how far the run goes at most. What of runs needs no computing at all
//! ([`crate::schedule::constant_runs`]) is drawn in a loop that does nothing else.

use super::Text;
use super::code::Code;
use super::refine::Refined;
use super::screen::Screen;
use super::slots::Slot;
use crate::ir::graph::*;
use crate::passes::loops::strip_mine::passes;
use crate::plan::{Copies, ErrorRows};
use crate::schedule::constant_runs::{Inks, Still};
use slowlight_runtime_6502::write::{self, Place as Operand};

/// What the loops are made of.
pub(super) struct Rows<'r> {
    screen: Option<&'r Screen>,
    errors: Option<&'r ErrorRows>,
    refined: Option<&'r Refined>,
    /// The names of the column, the row, and the first and last row to draw.
    x: String,
    y: String,
    first: String,
    last: String,
    /// The columns, how many passes they take, and whether they come in runs.
    columns: (u32, u32),
    passes: u32,
    runs: bool,
}

impl<'r> Rows<'r> {
    pub fn new(
        code: &Code<'_>,
        screen: Option<&'r Screen>,
        (errors, refined): (Option<&'r ErrorRows>, Option<&'r Refined>),
    ) -> Rows<'r> {
        let name = |slot| code.homes.name(slot).to_owned();
        let plan = code.plan;
        Rows {
            screen,
            errors,
            refined,
            x: name(Slot::Axis(Axis::X)),
            y: name(Slot::Axis(Axis::Y)),
            first: name(Slot::Rows(false)),
            last: name(Slot::Rows(true)),
            columns: plan.computed_columns(),
            passes: passes(&plan.graph),
            runs: !plan.tree.segment.is_empty(),
        }
    }

    /// All rows; goes to `picture_done`.
    pub fn write(&self, code: &mut Code<'_>) {
        let plan = code.plan;
        let y = &self.y;
        // Errors come from the rows above, drawn or not.
        let top = match self.errors {
            Some(_) => Operand::Constant(0),
            None => Operand::At(self.first.clone()),
        };
        match self.refined {
            Some(refined) => refined.begin(code),
            None => code.copy_axis(&top, y),
        }
        code.text.headline("once a row");
        code.text.label("next_row");
        if let Some(screen) = self.screen {
            screen.row(y, code.text);
        }
        if let Some(refined) = self.refined {
            refined.row(code);
        }
        let first = Operand::Constant(u64::from(self.columns.0));
        code.copy_axis(&first, &self.x);
        code.block(&plan.tree.row);
        code.text.span = plan.drawn;
        match self.passes {
            1 => {
                code.block(&plan.tree.pass);
                self.to_first_column(code, 0);
            }
            _ => self.begin_pass(code),
        }
        if self.runs {
            self.begin_run(code);
        }
        self.pixel(code);
        if self.passes > 1 {
            self.next_pass(code);
        }
        if let Some(rows) = self.errors {
            code.turn_errors(rows);
        }
        if let Some(screen) = self.screen {
            screen.row_done(code.text);
        }
        match self.refined {
            Some(refined) => refined.end(code),
            None => self.next_row(code.text),
        }
        code.text.span = None;
    }

    /// To the next row, or to `picture_done`.
    fn next_row(&self, text: &mut Text) {
        let Rows { y, last, .. } = self;
        text.code(&format!(
            "lda {y} | cmp {last} | lda {y}+1 | sbc {last}+1 | bcs picture_done"
        ));
        text.code(&format!("inc {y} | bne more_rows | inc {y}+1"));
        text.label("more_rows");
        text.code("jmp next_row");
    }

    /// Brings the ramps to the first column, by as many steps as there are before it: one
    /// more in the first so many passes.
    fn to_first_column(&self, code: &mut Code<'_>, early: u32) {
        let steps = self.columns.0 / self.passes;
        if steps + early == 0 || code.plan.ramps().is_empty() {
            return;
        }
        let [lo, hi, ..] = steps.to_le_bytes();
        code.text
            .code(&format!("lda #{lo} | sta count | lda #{hi} | sta bits"));
        if early > 0 {
            let pass = self.pass(code);
            code.text
                .code(&format!("lda {pass} | cmp #{early} | bcs whole_steps"));
            code.text.code("inc count | bne whole_steps | inc bits");
            code.text.label("whole_steps");
        }
        if steps == 0 {
            code.text.code("lda count | bne next_step | jmp last_step");
        }
        code.text.label("next_step");
        code.step();
        code.text.code("lda count | bne low_step | dec bits");
        code.text.label("low_step");
        code.text
            .code("dec count | lda count | ora bits | beq last_step | jmp next_step");
        code.text.label("last_step");
    }

    fn pass(&self, code: &Code<'_>) -> String {
        let axis = Axis::Pass(self.passes);
        code.homes.name(Slot::Axis(axis)).to_owned()
    }

    /// From a row's beginning to that of a pass: its number is its columns' remainder.
    fn begin_pass(&self, code: &mut Code<'_>) {
        let (pass, x) = (self.pass(code), &self.x);
        let start = code.homes.name(Slot::PassFirst).to_owned();
        let first = self.columns.0;
        let early = first % self.passes;
        code.copy_axis(&Operand::Constant(u64::from(early)), &pass);
        code.text.code(&format!(
            "lda {x} | sta {start} | lda {x}+1 | sta {start}+1"
        ));
        code.text.headline("once a pass");
        code.text.label("next_pass");
        if let Some(screen) = self.screen {
            screen.pass(&start, self.columns.0, code.text);
        }
        code.text.code(&format!(
            "lda {start} | sta {x} | lda {start}+1 | sta {x}+1"
        ));
        code.block(&code.plan.tree.pass);
        code.text.span = code.plan.drawn;
        self.to_first_column(code, early);
    }

    /// Behind the last pixel of a pass: to the next, until all had their turn.
    fn next_pass(&self, code: &mut Code<'_>) {
        let pass = self.pass(code);
        let start = code.homes.name(Slot::PassFirst).to_owned();
        let (first, n) = (self.columns.0, self.passes);
        let text = &mut *code.text;
        text.code(&format!("inc {start} | bne next_start | inc {start}+1"));
        text.label("next_start");
        text.code(&format!("inc {pass}"));
        if first % n > 0 {
            text.code(&format!("lda {pass} | cmp #{n} | bcc same_turn"));
            text.code(&format!("lda #0 | sta {pass}"));
            text.label("same_turn");
        }
        // The first columns differ by less than 256.
        let [behind, ..] = (first + n).to_le_bytes();
        text.code(&format!("lda {start} | cmp #{behind} | beq row_done"));
        text.code("jmp next_pass");
        text.label("row_done");
    }

    /// What is the same for a run of columns, at its first.
    fn begin_run(&self, code: &mut Code<'_>) {
        let end = code.homes.name(Slot::RunEnd).to_owned();
        let [lo, hi, ..] = self.columns.1.to_le_bytes();
        code.text.headline("once a run of columns");
        code.text.label("next_run");
        code.text
            .code(&format!("lda #{lo} | sta {end} | lda #{hi} | sta {end}+1"));
        code.in_run = true;
        code.block(&code.plan.tree.segment);
        code.in_run = false;
        code.text.span = code.plan.drawn;
        self.stop_behind(&end, code);
        if let (Some(still), None) = (&code.plan.still, self.errors) {
            self.still(still, code);
        }
    }

    /// Whether a run ends where a column is met, and not where it is passed.
    fn meets_end(&self) -> bool {
        self.runs && self.passes.is_power_of_two() && self.passes <= 0x80
    }

    /// The column of the pass that comes behind a run, in place of the run's last: so each
    /// pixel asks whether two columns are equal, and mostly looks at one byte of them.
    fn stop_behind(&self, end: &str, code: &mut Code<'_>) {
        if !self.meets_end() {
            return;
        }
        let (x, n) = (&self.x, self.passes);
        code.text.code(&format!(
            "sec | lda {end} | sbc {x} | and #{} | tax | lda {end}+1 | sbc {x}+1 | tay",
            0x100 - n
        ));
        code.text.code(&format!(
            "clc | txa | adc {x} | sta {end} | tya | adc {x}+1 | sta {end}+1"
        ));
        let label = format!("stop{}", code.text.next_serial());
        code.text.code(&format!(
            "clc | lda {end} | adc #{n} | sta {end} | bcc {label} | inc {end}+1"
        ));
        code.text.label(&label);
    }

    /// Draws a run whose inks are known.
    fn still(&self, still: &Still, code: &mut Code<'_>) {
        let Some(screen) = self.screen else {
            return;
        };
        code.text.line("        ; pixels whose inks are known");
        for &(cond, holds) in &still.conditions {
            let value = write::byte(&code.homes.operand(code.plan, cond), 0);
            let n = code.text.next_serial();
            let branch = if holds { "bne" } else { "beq" };
            code.text
                .code(&format!("lda {value} | {branch} still{n} | jmp next_pixel"));
            code.text.label(&format!("still{n}"));
        }
        code.text.label("still_pixel");
        let read = |code: &Code<'_>, id: NodeId| write::byte(&code.homes.operand(code.plan, id), 0);
        match still.inks {
            Inks::One(ink) => screen.pixel(&read(code, ink), code.text),
            Inks::Either { cond, yes, no } => {
                code.compare(cond);
                let (yes, no) = (read(code, yes), read(code, no));
                code.text
                    .code(&format!("lda {yes} | bcs still_ink | lda {no}"));
                code.text.label("still_ink");
                code.text.code("sta third");
                screen.pixel("third", code.text);
            }
        }
        screen.next(code.text);
        code.step();
        self.next_column("still_column", code);
        self.again(code, "still_pixel", "more_still");
        self.behind_run(code, "pass_over");
    }

    fn pixel(&self, code: &mut Code<'_>) {
        let Rows { x, y, first, .. } = self;
        let plan = code.plan;
        code.text.headline("once a pixel");
        code.text.label("next_pixel");
        if let Some(rows) = self.errors {
            code.receive_errors(rows);
        }
        if let Some(refined) = self.refined {
            refined.receive(code);
        }
        code.quick = plan.copies != Copies::None;
        code.block(&plan.tree.pixel);
        code.quick = false;
        code.text.span = plan.drawn;
        if let Some(screen) = self.screen {
            let ink = write::byte(&code.homes.operand(plan, plan.graph.ink), 0);
            if self.errors.is_some() {
                code.text.code(&format!(
                    "lda {y} | cmp {first} | lda {y}+1 | sbc {first}+1 | bcc unseen_pixel"
                ));
            }
            if let Some(refined) = self.refined {
                code.text.code(&refined.unseen());
            }
            screen.pixel(&ink, code.text);
            if plan.graph.is_in_order() {
                code.text.label("unseen_pixel");
            }
            screen.next(code.text);
        }
        if let Some(rows) = self.errors {
            code.send_errors(rows);
        }
        if let Some(refined) = self.refined {
            refined.send(code);
        }
        code.step();
        self.next_column("next_column", code);
        if self.passes > 1 || self.runs {
            self.again(code, "next_pixel", "more_pixels");
            if self.runs {
                self.behind_run(code, "last_pixel");
            }
        } else {
            let end = Operand::Constant(u64::from(self.columns.1) + 1);
            let [end0, end1] = [0, 1].map(|k| write::byte(&end, k));
            let text = &mut *code.text;
            text.code(&format!("lda {x} | cmp {end0} | bne more_pixels"));
            text.code(&format!("lda {x}+1 | cmp {end1} | beq last_pixel"));
            text.label("more_pixels");
            text.code("jmp next_pixel");
        }
        if self.runs || self.passes == 1 {
            code.text.label("last_pixel");
        }
    }

    /// To the next column of the pass.
    fn next_column(&self, label: &str, code: &mut Code<'_>) {
        let x = &self.x;
        let follows = self.screen.and_then(Screen::follows);
        let page = self.refined.map(Refined::next_page).unwrap_or_default();
        code.text.code(&match (self.passes, follows) {
            (1, _) => format!("inc {x} | bne {label} | inc {x}+1{page}"),
            (n, None) => format!("clc | lda {x} | adc #{n} | sta {x} | bcc {label} | inc {x}+1"),
            // Its upper byte has been told unless it changes.
            (n, Some(port)) => format!(
                "clc | lda {x} | adc #{n} | sta {x} | sta {port} | bcc {label}
                | inc {x}+1 | lda {x}+1 | sta {port}+1"
            ),
        });
        code.text.label(label);
    }

    /// On to a label until the run or pass is drawn.
    fn again(&self, code: &mut Code<'_>, label: &str, more: &str) {
        let x = &self.x;
        let (lo, hi) = match self.runs {
            true => {
                let end = code.homes.name(Slot::RunEnd);
                (end.to_owned(), format!("{end}+1"))
            }
            false => {
                let [lo, hi, ..] = self.columns.1.to_le_bytes();
                (format!("#{lo}"), format!("#{hi}"))
            }
        };
        let done = format!("{more}_done");
        if self.meets_end() {
            code.text.code(&format!("lda {x} | cmp {lo} | bne {more}"));
            code.text
                .code(&format!("lda {x}+1 | cmp {hi} | beq {done}"));
            code.text.label(more);
            code.text.code(&format!("jmp {label}"));
            code.text.label(&done);
            return;
        }
        code.text.code(&format!(
            "lda {lo} | cmp {x} | lda {hi} | sbc {x}+1 | bcc {done}"
        ));
        code.text.code(&format!("jmp {label}"));
        code.text.label(&done);
    }

    /// On to the next run, or behind the pass to a label.
    fn behind_run(&self, code: &mut Code<'_>, last: &str) {
        let x = &self.x;
        let [lo, hi, ..] = self.columns.1.to_le_bytes();
        code.text.code(&format!(
            "lda #{lo} | cmp {x} | lda #{hi} | sbc {x}+1 | bcc {last}"
        ));
        code.text.code("jmp next_run");
        if last != "last_pixel" {
            code.text.label(last);
            code.text.code("jmp last_pixel");
        }
    }
}
