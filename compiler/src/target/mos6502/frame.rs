//! The program around the statements: its head, the picture's opening, the
//! loops over rows and columns, and the runtime's parts.

use super::blocks::Blocks;
use super::code::Code;
use super::homes::{Homes, Slot};
use super::params::{Entry, entries, take_params};
use super::syntax::Syntax;
use super::{Text, table};
use crate::flow::graph::Axis;
use crate::flow::tree::SubroutineId;
use crate::plan::Plan;
use slowlight_routine::{Format, Part, Source, Type};
use slowlight_runtime_6502::write::{self, Place as Operand};

/// The whole program.
pub(super) fn program(plan: &Plan, homes: &Homes, syntax: &Syntax, text: &mut Text) {
    let entries = entries(plan, homes);
    head(plan, &entries, syntax, text);
    // What operands are read with is known when they have been.
    let (_, read) = main(plan, homes, &[], &mut Text::default());
    let parts = parts(plan, &entries, &read);
    symbols(homes, &parts, text);
    let (clamps, _) = main(plan, homes, &parts, text);
    take_params(plan, homes, &entries, syntax, text);
    if plan.plot {
        colours(plan, text);
    }
    if clamps {
        text.headline("an index kept inside its table");
        text.line(table::CLAMP);
    }
    table::data(plan, text);
    for part in parts.iter().filter(|p| !is_page(p)) {
        text.headline(&format!("runtime: {}", part.name));
        source(part, text);
    }
    syntax
        .last(&plan.name)
        .iter()
        .for_each(|line| text.line(line));
}

/// The parts that the program needs: those of the plan and of its own frame.
fn parts(plan: &Plan, entries: &[Entry], read: &[&'static str]) -> Vec<&'static Part> {
    let mut names: Vec<&str> = plan.parts().iter().map(|p| p.name).collect();
    names.extend(read);
    names.push("zero_page");
    names.extend(plan.points().map(|_| "scaled_page"));
    for entry in entries {
        names.extend(entry.needs(plan));
    }
    if table::any_large(plan) {
        names.push("int_multiply");
    }
    plan.runtime.closure(names)
}

/// Whether a part only names places in the zero page.
fn is_page(part: &Part) -> bool {
    matches!(part.name, "zero_page" | "scaled_page")
}

fn source(part: &Part, text: &mut Text) {
    match part.source {
        Source::Text(lines) => text.line(lines.trim_end()),
        Source::Table(make) => {
            text.label(part.name);
            for row in make().chunks(16) {
                let bytes: Vec<String> = row.iter().map(|b| (b & 0xFF).to_string()).collect();
                text.line(format!("        .byte {}", bytes.join(", ")));
            }
        }
    }
}

fn head(plan: &Plan, entries: &[Entry], syntax: &Syntax, text: &mut Text) {
    let image = &plan.graph.image;
    text.line(format!(
        "; {}: {} x {} {}, {} inks, for a plain 6502 ({})",
        plan.name,
        image.width,
        image.height,
        image.unit(),
        image.palette.len(),
        plan.runtime.format
    ));
    for line in syntax.how(&plan.name) {
        text.line(line);
    }
    syntax.first().iter().for_each(|line| text.line(line));
    text.headline("parameters: change them here");
    text.line("; Checked once at the start: the first one outside its range ends the");
    text.line("; program with its number as the exit status.");
    for (k, entry) in entries.iter().enumerate() {
        let assignment = format!("{} = {}", entry.symbol, entry.text);
        let Entry {
            unit,
            least,
            greatest,
            ..
        } = entry;
        text.line(format!(
            "{assignment:<24}; {}: {unit}, from {least} to {greatest}",
            k + 1
        ));
    }
}

fn symbols(homes: &Homes, parts: &[&'static Part], text: &mut Text) {
    text.headline("the machine's ports");
    let ports = [
        ("width_port", "ff00", "the picture's size: two bytes"),
        ("height_port", "ff02", "two bytes"),
        ("inks_port", "ff04", "opens the picture"),
        ("x_port", "ff05", "where the next ink goes: two bytes"),
        ("y_port", "ff07", "two bytes"),
        ("ink_port", "ff09", "draws a pixel and moves to the right"),
        ("exit_port", "ff0a", "ends the program"),
        ("palette_port", "ff0b", "red, green, blue of each ink"),
    ];
    for (name, address, about) in ports {
        text.line(format!("{:<24}; {about}", format!("{name} = ${address}")));
    }
    text.headline("the runtime's zero page");
    for part in parts.iter().filter(|p| is_page(p)) {
        source(part, text);
    }
    text.headline("values, the most used in the zero page");
    for home in homes.by_address() {
        let width = if home.address < 0x100 { 2 } else { 4 };
        text.line(format!("{} = ${:0width$x}", home.name, home.address));
    }
    if let Some(at) = homes.errors {
        text.line(format!("errors = ${at:04x}"));
    }
    text.line("");
    text.line(format!("* = ${:04x}", homes.origin));
}

/// The program proper; answers whether it clamps an index, and with what operands are read.
fn main(
    plan: &Plan,
    homes: &Homes,
    parts: &[&'static Part],
    text: &mut Text,
) -> (bool, Vec<&'static str>) {
    text.line("");
    text.label("start");
    text.code("cld | ldx #$ff | txs");
    if parts.iter().any(|p| p.name == "squares") {
        text.code("jsr make_squares");
    }
    if parts.iter().any(|p| p.name == "product") {
        text.code("jsr set_squares");
    }
    text.code("jsr take_params");
    if plan.plot {
        open(plan, text);
    }
    let mut code = Code {
        plan,
        homes,
        text,
        clamps: false,
        needs: Vec::new(),
    };
    let errors = plan.error_rows();
    if let Some(rows) = &errors {
        code.start_errors(rows);
    }
    if !plan.tree.frame.is_empty() {
        code.text.headline("once a picture");
        code.block(&plan.tree.frame);
    }
    code.text.span = plan.drawn;
    let [x, y] = [Axis::X, Axis::Y].map(|axis| homes.name(Slot::Axis(axis)).to_owned());
    let [first, last] = [false, true].map(|end| homes.name(Slot::Rows(end)).to_owned());
    // Errors come from the rows above, drawn or not.
    let top = match errors {
        Some(_) => Operand::Constant(0),
        None => Operand::At(first.clone()),
    };
    code.copy_axis(&top, &y);

    code.text.headline("once a row");
    code.text.label("next_row");
    let blocks = plan.plot.then(|| Blocks::new(plan, homes)).flatten();
    if let Some(blocks) = &blocks {
        blocks.row(&y, code.text);
    } else if plan.plot {
        let left = (i64::from(plan.computed_columns().0) + i64::from(plan.offset.0)) as u64;
        let [x0, x1] = [0, 1].map(|k| write::byte(&Operand::Constant(left), k));
        code.text
            .code(&format!("lda {x0} | sta x_port | lda {x1} | sta x_port+1"));
        let [dy0, dy1] =
            [0, 1].map(|k| write::byte(&Operand::Constant(i64::from(plan.offset.1) as u64), k));
        code.text
            .code(&format!("clc | lda {y} | adc {dy0} | sta y_port"));
        code.text
            .code(&format!("lda {y}+1 | adc {dy1} | sta y_port+1"));
    }
    let columns = plan.computed_columns();
    code.copy_axis(&Operand::Constant(u64::from(columns.0)), &x);
    code.block(&plan.tree.row);
    code.text.span = plan.drawn;
    if columns.0 > 0 && !plan.ramps().is_empty() {
        // To the first column, by as many steps as there are before it.
        let [lo, hi, ..] = columns.0.to_le_bytes();
        code.text
            .code(&format!("lda #{lo} | sta count | lda #{hi} | sta bits"));
        code.text.label("next_step");
        code.step();
        code.text.code("lda count | bne low_step | dec bits");
        code.text.label("low_step");
        code.text
            .code("dec count | lda count | ora bits | beq last_step | jmp next_step");
        code.text.label("last_step");
    }

    code.text.headline("once a pixel");
    code.text.label("next_pixel");
    if let Some(rows) = &errors {
        code.receive_errors(rows);
    }
    code.block(&plan.tree.pixel);
    code.text.span = plan.drawn;
    if plan.plot {
        let ink = write::byte(&homes.operand(plan, plan.graph.ink), 0);
        if errors.is_some() {
            code.text.code(&format!(
                "lda {y} | cmp {first} | lda {y}+1 | sbc {first}+1 | bcc unseen_pixel"
            ));
        }
        match &blocks {
            Some(blocks) => blocks.draw(&ink, code.text),
            None => code.text.code(&format!("lda {ink} | sta ink_port")),
        }
        if errors.is_some() {
            code.text.label("unseen_pixel");
        }
    }
    if let Some(blocks) = &blocks {
        blocks.next(code.text);
    }
    if let Some(rows) = &errors {
        code.send_errors(rows);
    }
    code.step();
    let [end0, end1] = [0, 1].map(|k| write::byte(&Operand::Constant(u64::from(columns.1) + 1), k));
    let (clamps, mut needs) = (code.clamps, std::mem::take(&mut code.needs));
    let text = &mut *code.text;
    text.code(&format!("inc {x} | bne next_column | inc {x}+1"));
    text.label("next_column");
    text.code(&format!("lda {x} | cmp {end0} | bne more_pixels"));
    text.code(&format!("lda {x}+1 | cmp {end1} | beq last_pixel"));
    text.label("more_pixels");
    text.code("jmp next_pixel");
    text.label("last_pixel");
    if let Some(rows) = &errors {
        code.turn_errors(rows);
    }
    let text = &mut *code.text;
    text.code(&format!(
        "lda {y} | cmp {last} | lda {y}+1 | sbc {last}+1 | bcs picture_done"
    ));
    text.code(&format!("inc {y} | bne more_rows | inc {y}+1"));
    text.label("more_rows");
    text.code("jmp next_row");
    text.span = None;
    text.label("picture_done");
    reports(plan, homes, text);
    text.code("lda #0 | sta exit_port");
    text.label("halted");
    text.code("jmp halted");
    let called = subroutines(plan, homes, text);
    needs.extend(called.1);
    (called.0 || clamps, needs)
}

/// What is called from several places; answers what [`main`] does.
fn subroutines(plan: &Plan, homes: &Homes, text: &mut Text) -> (bool, Vec<&'static str>) {
    let (mut clamps, mut needs) = (false, Vec::new());
    for (k, subroutine) in plan.tree.subroutines.iter().enumerate() {
        let calls = plan.tree.calls(SubroutineId(k as u32));
        text.headline(&format!(
            "{}, called from {calls} places",
            subroutine.label()
        ));
        text.label(homes.subroutine(SubroutineId(k as u32)));
        let mut code = Code {
            plan,
            homes,
            text,
            clamps: false,
            needs: Vec::new(),
        };
        code.block(&subroutine.body);
        clamps |= code.clamps;
        needs.append(&mut code.needs);
        text.span = Some(subroutine.span);
        text.code("rts");
        text.span = None;
    }
    (clamps, needs)
}

/// Gives out what the graph reports through the one port for bytes that there
/// is: as a picture of one row, four inks a value, low byte first.
fn reports(plan: &Plan, homes: &Homes, text: &mut Text) {
    if plan.graph.reports.is_empty() || plan.plot {
        return;
    }
    let [lo, hi, ..] = (4 * plan.graph.reports.len()).to_le_bytes();
    text.code(&format!(
        "lda #{lo} | sta width_port | lda #{hi} | sta width_port+1"
    ));
    text.code("lda #1 | sta height_port | lda #0 | sta height_port+1 | sta inks_port");
    for &id in &plan.graph.reports {
        let mut value = homes.operand(plan, id);
        if let (Some(points), Some(constant)) = (plan.points(), plan.graph.constant(id)) {
            let real = plan.graph.ty(id) == Type::Real;
            let bits = (plan.runtime.encode)(constant, plan.format(id));
            value = Operand::Constant(if real {
                points.read(&plan.graph, id, bits, points.own(id))
            } else {
                bits
            });
        }
        if let Operand::Held(..) = value {
            let mut lines = Vec::new();
            write::copy_bytes(&value, "acc", 4, &mut lines);
            lines.iter().for_each(|line| text.line(line));
            value = Operand::At("acc".to_owned());
        }
        let bytes = match plan.format(id) {
            Format::Bool => 1,
            _ => 4,
        };
        for k in 0..4 {
            let byte = match k < bytes {
                true => write::byte(&value, k),
                false => "#0".to_owned(),
            };
            text.code(&format!("lda {byte} | sta ink_port"));
        }
    }
}

/// Opens the picture and tells its palette.
fn open(plan: &Plan, text: &mut Text) {
    let image = &plan.graph.image;
    // The screen is the mode's where there is one, else the picture's.
    let (width, height) = (plan.mode.width.max(1), plan.mode.height.max(1));
    for (port, value) in [("width_port", width), ("height_port", height)] {
        let [lo, hi, ..] = value.to_le_bytes();
        text.code(&format!(
            "lda #{lo} | sta {port} | lda #{hi} | sta {port}+1"
        ));
    }
    text.code(&format!(
        "lda #{} | sta inks_port",
        image.palette.len() & 0xFF
    ));
    let bytes = 3 * image.palette.len();
    // All fit an index of one byte but those of more than 85 inks.
    for (k, _) in image.palette.chunks(85).enumerate() {
        let count = (bytes - 255 * k).min(255);
        text.code("ldx #0");
        text.label(&format!("palette{k}"));
        text.code(&format!(
            "lda colours+{},x | sta palette_port | inx | cpx #{count} | bne palette{k}",
            255 * k
        ));
    }
}

/// The palette: red, green and blue of each ink.
fn colours(plan: &Plan, text: &mut Text) {
    text.headline("the inks' red, green and blue");
    text.label("colours");
    for [red, green, blue] in &plan.graph.image.palette {
        text.line(format!("        .byte {red}, {green}, {blue}"));
    }
}
