//! The program around the statements: its head, the picture's opening and end, and the
//! runtime's parts.

use super::code::Code;
use super::first::First;
use super::homes::Homes;
use super::memory::Machine;
use super::params::{Entry, entries, take_params};
use super::refine::{self, Refined};
use super::reports::reports;
use super::rows::Rows;
use super::screen::Screen;
use super::squares::Squares;
use super::syntax::Syntax;
use super::{Text, bbc, c64, ports, steps, table};
use crate::ir::tree::SubroutineId;
use crate::plan::{Copies, Plan};
use slowlight_routine::{Format, Part, Source};
use slowlight_runtime_6502::log::with_whole_tables;
use slowlight_runtime_6502::write;
use std::ops::Range;

/// Where parts of a program's text are, by lines.
#[derive(Clone, PartialEq, Eq)]
pub(super) struct Lines {
    /// What names the bytes that nobody else uses.
    pub symbols: Range<usize>,
    /// What the scene became.
    pub code: Range<usize>,
}

/// The whole program.
pub(super) fn program(plan: &Plan, homes: &Homes, syntax: &Syntax, text: &mut Text) -> Lines {
    let entries = entries(plan, homes);
    head(plan, homes, &entries, syntax, text);
    // What operands are read with is known when they have been.
    let mut body = Text::default();
    let (clamps, read) = main(plan, homes, &mut body);
    let parts = parts(plan, &entries, &read);
    let named_from = symbols(plan, homes, &parts, text);
    let named_to = text.lines.len();
    let machine = Machine::of(plan);
    let code = match machine {
        // What is done once may be where the screen will be, if it stands last.
        Machine::Bbc => {
            bbc::start(&homes.places, text);
            resident(plan, homes, (clamps, &parts), text);
            let from = text.lines.len();
            let mut once = Text::default();
            once.label(bbc::SET_UP);
            once.code("cld");
            set_up(plan, &parts, &mut once);
            let is_picture = |(line, _): &(String, _)| line.strip_suffix(':') == Some(bbc::PICTURE);
            let picture = body.lines.iter().position(is_picture).unwrap_or(0);
            once.lines.extend(body.lines.drain(..picture));
            body.lines.extend(once.lines);
            text.append(body);
            let to = text.lines.len();
            take_params(plan, homes, &entries, syntax, text);
            bbc::data(plan, machine, text);
            bbc::move_down(&homes.places, text);
            from..to
        }
        _ => {
            begin(plan, &parts, text);
            text.append(body);
            let to = text.lines.len();
            take_params(plan, homes, &entries, syntax, text);
            if machine == Machine::C64 {
                bbc::data(plan, machine, text);
            }
            resident(plan, homes, (clamps, &parts), text);
            named_to..to
        }
    };
    let loaded = match machine {
        Machine::Bbc => Some(bbc::loaded_at(&homes.places)),
        _ => None,
    };
    let last = syntax.last(&plan.name, loaded);
    last.iter().for_each(|line| text.line(line));
    Lines {
        symbols: named_from..named_to,
        code,
    }
}

/// What is read and called until the picture is done.
fn resident(
    plan: &Plan,
    homes: &Homes,
    (clamps, parts): (bool, &[&'static Part]),
    text: &mut Text,
) {
    let machine = Machine::of(plan);
    if plan.plot {
        Screen::new(plan, homes).data(plan, text);
    }
    if clamps {
        text.headline("an index kept inside its table");
        text.line(table::CLAMP);
    }
    table::data(plan, text);
    let first = First::of(plan, parts);
    let behind = |part: &&&Part| !is_page(part) && !first.has(part);
    for part in parts.iter().filter(behind) {
        text.headline(&format!("runtime: {}", part.name));
        source(machine, part, text);
    }
}

/// The parts that the program needs: those of the plan and of its own frame.
fn parts(plan: &Plan, entries: &[Entry], read: &[&'static str]) -> Vec<&'static Part> {
    let mut names: Vec<&str> = plan.parts().iter().map(|p| p.name).collect();
    names.extend(read);
    names.push("zero_page");
    names.extend(plan.points().map(|_| match write::size(plan.runtime.real) {
        2 => "scaled_page",
        _ => "scaled24_page",
    }));
    match plan.runtime.real {
        Format::Log { .. } => names.push("log_page"),
        Format::Real40 => names.push("float_page"),
        _ => {}
    }
    for entry in entries {
        names.extend(entry.needs(plan));
    }
    if table::any_large(plan) {
        names.push("int_multiply");
    }
    let runtime = match plan.copies {
        Copies::Tables => with_whole_tables(plan.runtime),
        _ => plan.runtime,
    };
    runtime.closure(names)
}

/// Whether a part only names places in the zero page.
fn is_page(part: &Part) -> bool {
    let pages = [
        "zero_page",
        "scaled_page",
        "scaled24_page",
        "log_page",
        "float_page",
    ];
    pages.contains(&part.name)
}

fn source(machine: Machine, part: &Part, text: &mut Text) {
    match part.source {
        Source::Text(lines) => text.line(machine.placed(lines.trim_end())),
        Source::Made(write) => text.line(machine.placed(write().trim_end())),
        Source::Table(make) => {
            text.label(part.name);
            text.bytes(make().into_iter().map(|b| (b & 0xFF) as u8));
        }
    }
}

fn head(plan: &Plan, homes: &Homes, entries: &[Entry], syntax: &Syntax, text: &mut Text) {
    let (image, machine) = (&plan.graph.image, Machine::of(plan));
    text.line(format!(
        "; {}: {} x {} {}, {} inks, for {} ({})",
        plan.name,
        image.width,
        image.height,
        image.unit(),
        image.palette.len(),
        machine.about(),
        plan.runtime.format
    ));
    for line in syntax.how(&plan.name, plan.target.name, plan.undocumented) {
        text.line(line);
    }
    match machine {
        Machine::Plain => {}
        Machine::Bbc => bbc::how(plan, &homes.places, text),
        Machine::C64 => c64::how(plan, text),
    }
    syntax.first().iter().for_each(|line| text.line(line));
    text.headline("parameters: change them here");
    text.line("; Checked once at the start: the first one outside its range ends the");
    text.line(match machine {
        Machine::Plain => "; program with its number as the exit status.",
        Machine::Bbc | Machine::C64 => "; program, which says its number.",
    });
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

/// Answers the line from which on bytes have names that nobody else uses.
fn symbols(plan: &Plan, homes: &Homes, parts: &[&'static Part], text: &mut Text) -> usize {
    let machine = Machine::of(plan);
    match machine {
        Machine::Plain => ports::symbols(plan, text),
        Machine::Bbc => bbc::symbols(text),
        Machine::C64 => c64::symbols(text),
    }
    let first = text.lines.len();
    text.headline("the runtime's zero page");
    for part in parts.iter().filter(|p| is_page(p)) {
        source(machine, part, text);
    }
    text.headline("values, the most used in the zero page");
    for home in homes.by_address() {
        let width = if home.address < 0x100 { 2 } else { 4 };
        text.line(format!("{} = ${:0width$x}", home.name, home.address));
    }
    if plan.error_rows().is_some() {
        text.line(format!("errors = ${:04x}", homes.places.errors));
    }
    if plan.kept_rows().is_some() {
        text.line(format!("{} = ${:04x}", refine::KEPT, homes.places.errors));
    }
    text.line("");
    let origin = First::of(plan, parts).origin(homes.places.origin);
    text.line(format!("* = ${origin:04x}"));
    first
}

/// What sets the pointers into a part's tables, or makes these.
const MADE: [(&str, &str); 5] = [
    ("product", "set_squares"),
    ("squares24", "set_squares24"),
    ("log_sum", "set_sums"),
    ("log_difference", "set_lost"),
    ("log_whole", "set_parts"),
];

/// How the program begins, but on a BBC Micro.
fn begin(plan: &Plan, parts: &[&'static Part], text: &mut Text) {
    text.line("");
    text.label("start");
    let machine = Machine::of(plan);
    if machine == Machine::C64 {
        c64::line(text);
    }
    First::of(plan, parts).write(text);
    match machine {
        Machine::C64 => c64::begin(text),
        _ => text.code("cld | ldx #$ff | txs"),
    }
    set_up(plan, parts, text);
}

/// What the runtime's parts and the params want before everything else.
fn set_up(plan: &Plan, parts: &[&'static Part], text: &mut Text) {
    Squares::of(Machine::of(plan), parts).set(text);
    for (part, make) in MADE {
        if parts.iter().any(|p| p.name == part) {
            text.code(&format!("jsr {make}"));
        }
    }
    text.code("jsr take_params");
}

/// The program proper; answers whether it clamps an index, and with what operands are read.
fn main(plan: &Plan, homes: &Homes, text: &mut Text) -> (bool, Vec<&'static str>) {
    let machine = Machine::of(plan);
    let screen = plan.plot.then(|| Screen::new(plan, homes));
    let moves = plan.graph.is_moving();
    if let Some(screen) = &screen {
        screen.open(plan, text);
        if !moves {
            screen.begin(text);
        }
    }
    let mut code = Code::new(plan, homes, text);
    let errors = plan.error_rows();
    if let Some(rows) = &errors {
        code.start_errors(rows);
    }
    if moves {
        // All of a picture is written by the next one, so the screen is cleared once.
        if machine == Machine::Bbc {
            bbc::open(plan, code.text);
        }
        code.text.label(steps::NEXT);
        screen.iter().for_each(|screen| screen.begin(code.text));
    }
    if !plan.tree.frame.is_empty() {
        code.text.headline("once a picture");
        code.block(&plan.tree.frame);
    }
    code.fill_columns(plan.computed_columns());
    if machine == Machine::Bbc && !moves {
        bbc::open(plan, code.text);
    }
    code.text.span = plan.drawn;
    let refined = Refined::new(plan, homes);
    let others = (errors.as_ref(), refined.as_ref());
    Rows::new(&code, screen.as_ref(), others).write(&mut code);
    code.text.label("picture_done");
    if moves {
        steps::between(&mut code);
    }
    let (clamps, mut needs) = (code.clamps, std::mem::take(&mut code.needs));
    let text = &mut *code.text;
    match machine {
        Machine::Plain if moves => {}
        Machine::Plain => {
            reports(plan, homes, text);
            text.code("lda #0 | sta exit_port");
            text.label("halted");
            text.code("jmp halted");
        }
        // What moves comes here only where a param is outside its range.
        Machine::Bbc => bbc::end(text),
        Machine::C64 => c64::end(text),
    }
    if let Some(refined) = &refined {
        refined.data(text);
    }
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
        let mut code = Code::new(plan, homes, text);
        // What a run calls may end it; elsewhere a run that ends sooner is right as well.
        code.in_run = !plan.tree.segment.is_empty();
        code.block(&subroutine.body);
        clamps |= code.clamps;
        needs.append(&mut code.needs);
        text.span = Some(subroutine.span);
        text.code("rts");
        text.span = None;
    }
    (clamps, needs)
}
