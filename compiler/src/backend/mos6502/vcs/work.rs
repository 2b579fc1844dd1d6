//! The work between the pictures: the scene's statements, with what asks the timer.
//!
//! Here it is one text, in which `jsr ask_top` stands between statements and `jsr ask` where a
//! loop's turn begins, so that it can be read again as a whole ([`tidy`]); [`pieces`] cuts it
//! behind.
//!
//! [`tidy`]: slowlight_runtime_6502::tidy

use super::Line;
use super::ram::{Cell, HANDS, NEW_MASKS, instruction};
use super::tall;
use crate::backend::mos6502::Text;
use crate::backend::mos6502::code::Code;
use crate::backend::mos6502::homes::Homes;
use crate::backend::mos6502::slots::Slot;
use crate::backend::mos6502::steps::{Move, in_turn};
use crate::backend::mos6502::table;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::Plan;
use crate::plan::columns::Columns;
use slowlight_routine::{Part, Source};
use slowlight_runtime_6502::write::Place as Operand;
use std::ops::Range;

/// After so many cycles the timer is asked, about.
const SLICE: usize = 250;

/// What an instruction takes, and what a routine that is called, about.
const INSTRUCTION: usize = 4;
const ROUTINE: usize = 160;

/// The text of the work.
pub(super) struct Work {
    pub lines: Vec<Line>,
    /// The lines that name bytes, and those of the scene.
    pub symbols: Range<usize>,
    pub code: Range<usize>,
    /// Parts of the runtime that it calls.
    pub parts: Vec<&'static Part>,
    /// Tables of the columns.
    pub tables: Vec<(String, Vec<u8>)>,
    behind: usize,
}

/// Whether a part only names bytes.
fn is_page(part: &Part) -> bool {
    ["zero_page", "scaled_page"].contains(&part.name)
}

impl Work {
    pub fn new(plan: &Plan, homes: &Homes, columns: &Columns) -> Work {
        let mut body = Text::default();
        let (clamps, needs) = write(plan, homes, columns, &mut body);
        let mut names: Vec<&str> = plan.parts().iter().map(|part| part.name).collect();
        names.extend(needs);
        names.extend(["zero_page", "scaled_page"]);
        let parts = plan.runtime.closure(names);
        let mut text = Text::default();
        for part in parts.iter().filter(|part| is_page(part)) {
            text.line(source(part));
        }
        for home in homes.by_address() {
            text.line(format!("{} = ${:04x}", home.name, home.address));
        }
        let symbols = 0..text.lines.len();
        let code = symbols.end..symbols.end + body.lines.len();
        text.append(body);
        let rest = text.lines.len();
        text.line("vcs_ask:");
        text.line("vcs_ask_top:");
        text.line("vcs_publish:");
        text.code("lda $0284 | tax | tay | cmp $0284 | rts");
        if clamps {
            text.line(table::CLAMP);
        }
        for part in parts.iter().filter(|part| !is_page(part)) {
            text.line(source(part));
        }
        table::data(plan, &mut text);
        let first = (32 - plan.graph.image.width.min(32)) / 2;
        let full = super::Shape::of(plan, columns).walls.0;
        let tables = tall::tables(columns, first, full);
        for (name, bytes) in &tables {
            text.label(name);
            text.bytes(bytes.iter().copied());
        }
        Work {
            behind: text.lines.len() - rest,
            lines: text.lines,
            symbols,
            code,
            parts: parts.into_iter().filter(|part| !is_page(part)).collect(),
            tables,
        }
    }

    /// The lines of the scene, whatever was left out of them.
    pub fn code_lines(&self) -> Vec<Line> {
        let end = self.lines.len().saturating_sub(self.behind);
        let lines = self.lines.get(self.code.start..end);
        lines.unwrap_or_default().to_vec()
    }
}

/// A part's text.
pub(super) fn source(part: &Part) -> String {
    match part.source {
        Source::Text(lines) => lines.trim_end().to_owned(),
        Source::Made(write) => write().trim_end().to_owned(),
        Source::Table(make) => {
            let mut text = Text::default();
            text.label(part.name);
            text.bytes(make().into_iter().map(|b| (b & 0xFF) as u8));
            let lines: Vec<String> = text.lines.into_iter().map(|(line, _)| line).collect();
            lines.join("\n")
        }
    }
}

/// The names of bytes.
pub(super) fn cells(lines: &[Line]) -> Vec<Cell> {
    let symbol = |line: &'_ String| {
        let (name, value) = line.split(';').next()?.split_once(" = $")?;
        (!name.starts_with(' ') && !value.is_empty()).then(|| name.to_owned())
    };
    let named = lines.iter().filter_map(|(line, _)| symbol(line));
    let cell = |name: String| Cell { name, bytes: 1 };
    named.map(cell).collect()
}

/// A piece of the work: it begins where its number's label is, or where what stands before it
/// goes on.
pub(super) struct Piece {
    pub lines: Vec<Line>,
    /// How it ends.
    pub end: End,
}

/// How a piece ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// By asking the timer.
    Ask,
    /// By making the columns playfield.
    Publish,
    /// By a jump.
    Jump,
}

/// The work, cut where all of it may be interrupted.
pub(super) fn pieces(lines: Vec<Line>) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut now = Vec::new();
    for line in lines {
        let end = match instruction(&line.0) {
            Some(("jsr", "vcs_ask_top")) => End::Ask,
            Some(("jsr", "vcs_publish")) => End::Publish,
            _ => {
                now.push(line);
                continue;
            }
        };
        let lines = std::mem::take(&mut now);
        pieces.push(Piece { lines, end });
    }
    let end = End::Jump;
    pieces.push(Piece { lines: now, end });
    pieces
}

/// Writes all statements; answers what [`Code`] says of them.
fn write(
    plan: &Plan,
    homes: &Homes,
    columns: &Columns,
    text: &mut Text,
) -> (bool, Vec<&'static str>) {
    let mut code = Code::new(plan, homes, text);
    code.asks = true;
    let x = homes.name(Slot::Axis(Axis::X)).to_owned();
    code.text.headline("once a picture");
    code.text.label(super::WORK);
    slices(&mut code, &plan.tree.frame);
    if columns.walls().len() > 1 {
        code.text.code("lda #0");
        for byte in 0..4 {
            code.text.code(&format!("sta ${:04x}", NEW_MASKS + byte));
        }
    }
    code.copy_axis(&Operand::Constant(0), &x);
    code.text.headline("once a column");
    code.text.label("next_entry");
    code.text.code("jsr vcs_ask_top");
    slices(&mut code, &plan.tree.column);
    code.text.code("jsr vcs_ask_top");
    let first = (32 - plan.graph.image.width.min(32)) / 2;
    tall::keep(&mut code, columns, first);
    code.text.code(&format!(
        "ldx {x} | inx | stx {x} | cpx #{} | beq entries_done | jmp next_entry",
        plan.graph.image.width
    ));
    code.text.label("entries_done");
    code.text.span = None;
    code.text.code("jsr vcs_publish");
    held(&mut code);
    code.text.headline("the states in the next picture");
    slices(&mut code, &plan.tree.step);
    code.text.code("jsr vcs_ask_top");
    code.text.span = None;
    let mut steps = in_turn(&plan.graph).into_iter().peekable();
    let mut aside = 0u32;
    while let Some(step) = steps.next() {
        match step {
            Move::Aside(_) => aside += 1,
            Move::Back(_) => aside = aside.saturating_sub(1),
            Move::Give(..) => {}
        }
        code.give(step);
        if aside == 0 && steps.peek().is_some() {
            code.text.code("jsr vcs_ask_top");
        }
    }
    code.text.code(&format!("jmp {}", super::WORK));
    (code.clamps, std::mem::take(&mut code.needs))
}

/// What is held, for params.
fn held(code: &mut Code<'_>) {
    let plan = code.plan;
    for (id, button) in plan.graph.buttons() {
        let slot = Slot::Param(id.0);
        let home = code.homes.name(slot).to_owned();
        let bit = match button {
            Button::Up => 0x10,
            Button::Down => 0x20,
            Button::Left => 0x40,
            Button::Right => 0x80,
            Button::Fire => 1,
        };
        let skip = format!("not_{}", button.name());
        code.text.code(&format!(
            "ldx #0 | lda {HANDS} | and #{bit} | bne {skip} | inx"
        ));
        code.text.label(&skip);
        code.text.code(&format!("stx {home}"));
        let bytes = code.homes.bytes(plan, slot);
        if bytes > 1 {
            code.text.code("lda #0");
        }
        for k in 1..bytes {
            code.text.code(&format!("sta {home}+{k}"));
        }
    }
}

/// What statements take that were written since a line, about.
fn cycles(text: &Text, from: usize) -> usize {
    let lines = text.lines.get(from..).unwrap_or_default();
    let each = lines.iter().filter_map(|(line, _)| instruction(line));
    each.map(|(name, _)| if name == "jsr" { ROUTINE } else { INSTRUCTION })
        .sum()
}

/// Statements, with the timer asked between them.
fn slices(code: &mut Code<'_>, block: &Block) {
    let mut since = code.text.lines.len();
    let mut fused = false;
    for statement in block {
        let one = vec![statement.clone()];
        let from = code.text.lines.len();
        code.block(&one);
        let all = cycles(code.text, since);
        if all > SLICE && from > since && !fused {
            let ask = ("        jsr vcs_ask_top".to_owned(), None);
            code.text.lines.insert(from, ask);
            since = from + 1;
        }
        // Its outcome is in the carry.
        fused = matches!(statement, Statement::Let(id) if code.homes.fused.contains(id));
    }
}
