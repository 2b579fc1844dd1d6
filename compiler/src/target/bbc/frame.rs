//! Everything around a scene's statements.

use super::Style;
use super::code::Code;
use super::lines::Lines;
use super::poke::Poke;
use super::ramp;
use super::screen;
use super::short::short;
use super::spread::Spread;
use crate::flow::graph::Table;
use crate::flow::tree::SubroutineId;
use crate::plan::Plan;
use crate::source::Span;
use slowlight_routine::{Part, Source, Type, Value};
use slowlight_runtime_bbc::literal;

/// A table's index clamped to 0..n.
const FN_INDEX: &str = "\
DEF FNindex(i%,n%)
IF i%<0 THEN =0
IF i%>n% THEN =n% ELSE =i%
";

/// The file of what a graph reports.
const REPORTS: &str = "REPORTS";

/// How often a row's and a pixel's statements are carried out, roughly: for
/// the weights of names only.
const ROW: u64 = 300;
const PIXEL: u64 = 100_000;

/// The whole program.
pub fn program(plan: &Plan) -> Lines {
    let mut code = Code::new(plan);
    let first = code.values.names.unique("first", "%");
    let last = code.values.names.unique("last", "%");
    let spread = Spread::new(plan, &mut code);
    parameters(plan, &mut code, &first, &last);
    picture(plan, &mut code, &first, &last, spread.as_ref());
    code.lines.weight = PIXEL;
    procedures(plan, &mut code);
    code.lines.weight = 1;
    let rare = std::mem::take(&mut code.rare);
    code.lines.append(rare);
    let parts = called(plan, &code);
    setup(plan, &mut code, &parts, &first, &last);
    // Called for many pixels, but not for all.
    code.lines.weight = 5_000;
    functions(&mut code, &parts);
    code.lines.weight = 1;
    data(plan, &mut code);
    let style = code.values.style;
    if style == Style::Listing {
        return code.lines.remarked(|span| item(plan, span));
    }
    let params = (0..plan.params.len()).map(|k| code.values.names.param(k).to_owned());
    let keep: Vec<String> = params.chain([first, last]).collect();
    short(code.lines, &keep, style)
}

/// The scene's item that something comes from: the last that begins before it.
fn item(plan: &Plan, span: Span) -> Option<String> {
    let before = |(at, _): &&(Span, String)| at.file == span.file && at.start <= span.start;
    let (_, name) = plan
        .items
        .iter()
        .filter(before)
        .max_by_key(|(at, _)| at.start)?;
    (!name.is_empty()).then(|| name.clone())
}

fn parameters(plan: &Plan, code: &mut Code<'_>, first: &str, last: &str) {
    let mode = plan.mode;
    let page = match plan.page {
        Some(page) => format!(" at PAGE &{page:X}"),
        None => String::new(),
    };
    code.line(format!(
        "REM {}, {}x{} in {} inks, by slowlight for {}{page}",
        plan.name, mode.width, mode.height, mode.inks, plan.target.name
    ));
    code.line("REM Change what you like here:");
    for (k, (param, written)) in plan.graph.params.iter().zip(&plan.params).enumerate() {
        let name = code.values.names.param(k);
        let range = match &written.range {
            Some((lo, hi)) => format!(":REM {lo} to {hi}"),
            None => String::new(),
        };
        let text = format!("{name}={}{range}", written.text);
        code.lines.line(text, Some(param.span));
    }
    let (top, bottom) = screen::rows(plan);
    code.line(format!(
        "{first}={}:{last}={}:REM rows to draw, from {top} to {bottom}",
        plan.rows.0, plan.rows.1
    ));
}

fn picture(plan: &Plan, code: &mut Code<'_>, first: &str, last: &str, spread: Option<&Spread>) {
    // MODE must stand outside procedures, and after nothing but small tables.
    code.statement("PROCsetup");
    if plan.plot {
        code.statement(format!("MODE {}", plan.mode.name));
        code.statement("VDU 23,1,0;0;0;0;");
        for (ink, rgb) in plan.graph.image.palette.iter().enumerate() {
            if let Some(text) = screen::colour(plan, ink, *rgb) {
                code.statement(text);
            }
        }
    }
    if let Some(spread) = spread {
        spread.start(code);
    }
    code.block(&plan.tree.frame);
    // Errors come from the rows above, drawn or not.
    let top = if spread.is_some() { "0" } else { first };
    let poke = Poke::new(plan, code);
    code.line(format!("FOR Y%={top} TO {last}"));
    code.lines.weight = ROW;
    if plan.plot && poke.is_none() {
        code.statement(format!("R%={}", screen::y_expression(plan)));
    }
    code.block(&plan.tree.row);
    ramp::start(plan, code);
    let columns = plan.computed_columns();
    match &poke {
        Some(poke) => poke.columns(plan, code),
        None => code.line(format!("FOR X%={} TO {}", columns.0, columns.1)),
    }
    code.lines.weight = PIXEL;
    if let Some(spread) = spread {
        spread.receive(code);
    }
    code.block(&plan.tree.pixel);
    let ink = code.values.read(plan.graph.ink);
    code.assign("I%", &ink);
    if let Some(poke) = &poke {
        poke.gather(code);
    } else if plan.plot {
        // After MODE the screen is ink 0 already.
        let x = screen::x_expression(plan);
        let seen = seen(plan, first);
        code.line(format!("IF I%{seen} THEN GCOL 0,I%:PLOT 69,{x},R%"));
    }
    if let Some(spread) = spread {
        spread.send(code);
    }
    ramp::step(plan, code);
    code.line("NEXT");
    if let Some(poke) = &poke {
        poke.put(plan, code, first);
    }
    code.lines.weight = ROW;
    if let Some(spread) = spread {
        spread.turn(code);
    }
    code.line("NEXT");
    code.lines.weight = 1;
    reports(plan, code);
    code.line("END");
}

/// What a pixel that is computed must pass beside to be drawn.
fn seen(plan: &Plan, first: &str) -> String {
    let mut text = String::new();
    if plan.graph.diffusion.is_none() {
        return text;
    }
    text.push_str(&format!(" AND Y%>={first}"));
    let (computed, drawn) = (plan.computed_columns(), plan.columns);
    if computed.0 < drawn.0 {
        text.push_str(&format!(" AND X%>={}", drawn.0));
    }
    if computed.1 > drawn.1 {
        text.push_str(&format!(" AND X%<={}", drawn.1));
    }
    text
}

/// Writes what the graph reports to a file, in the machine's own bytes.
fn reports(plan: &Plan, code: &mut Code<'_>) {
    if plan.graph.reports.is_empty() {
        return;
    }
    let channel = code.values.names.unique("channel", "%");
    code.line(format!("{channel}=OPENOUT(\"{REPORTS}\")"));
    for &id in &plan.graph.reports {
        let value = code.values.read(id).text;
        code.line(format!("PRINT#{channel},{value}"));
    }
    code.line(format!("CLOSE#{channel}"));
}

/// The parts that the program calls, as far as it is written, and those that
/// they need: an expression may have taken a function's place.
fn called(plan: &Plan, code: &Code<'_>) -> Vec<&'static Part> {
    let calls = |text: &str, name: &str| text.contains(&format!("{name}("));
    let names: Vec<&'static str> = plan
        .runtime
        .parts
        .iter()
        .map(|part| part.name)
        .filter(|name| code.lines.texts().any(|text| calls(text, name)))
        .collect();
    plan.runtime.closure(names)
}

fn setup(plan: &Plan, code: &mut Code<'_>, parts: &[&Part], first: &str, last: &str) {
    code.line("DEF PROCsetup");
    for (k, (param, written)) in plan.graph.params.iter().zip(&plan.params).enumerate() {
        let name = code.values.names.param(k).to_owned();
        if let Some((lo, hi)) = &written.range {
            code.lines.line(
                format!("IF {name}<{lo} OR {name}>{hi} THEN PRINT \"{name} must be from {lo} to {hi}\":END"),
                Some(param.span),
            );
        }
        if param.ty == Type::Bool {
            code.statement(format!("{name}={name}<>0"));
        }
    }
    let (top, bottom) = screen::rows(plan);
    code.line(format!(
        "IF {first}<{top} OR {last}>{bottom} OR {first}>{last} THEN PRINT \"rows must be from {top} to {bottom}\":END"
    ));
    for part in parts {
        if let Source::Text(text) = part.source
            && !text.starts_with("DEF")
        {
            text.lines().for_each(|l| code.statement(l));
        }
    }
    let names = &code.values.names;
    let constants: Vec<String> = names.constants().chain(names.copies()).collect();
    for text in constants {
        code.statement(text);
    }
    for (t, table) in plan.graph.tables.iter().enumerate() {
        let Some(name) = code.values.names.tables.get(t).cloned() else {
            continue;
        };
        let (w, h) = (table.width - 1, table.height - 1);
        // The element, the bounds, and the loops around reading it.
        let (index, bounds, loops, ends) = match (w, h) {
            (_, 0) => ("X%", format!("{w}"), format!("FOR X%=0 TO {w}"), "NEXT"),
            (0, _) => ("Y%", format!("{h}"), format!("FOR Y%=0 TO {h}"), "NEXT"),
            _ => (
                "X%,Y%",
                format!("{w},{h}"),
                format!("FOR Y%=0 TO {h}:FOR X%=0 TO {w}"),
                "NEXT:NEXT",
            ),
        };
        let element = format!("{name}({index})");
        let shrink = match scale(plan, table) {
            1 => String::new(),
            scale => format!(":{element}={element}/{scale}"),
        };
        code.line(format!(
            "DIM {name}({bounds}):{loops}:READ {element}{shrink}:{ends}"
        ));
    }
    code.line("ENDPROC");
}

/// What is called from several places.
fn procedures(plan: &Plan, code: &mut Code<'_>) {
    for (k, subroutine) in plan.tree.subroutines.iter().enumerate() {
        let id = SubroutineId(k as u32);
        let name = code.values.names.procedure(id).to_owned();
        let span = Some(subroutine.span);
        if code.values.style == Style::Listing {
            let calls = plan.tree.calls(id);
            let about = format!("REM {}, called from {calls} places", subroutine.label());
            code.lines.line(about, span);
        }
        code.lines.line(format!("DEF PROC{name}"), span);
        code.block(&subroutine.body);
        code.lines.line("ENDPROC", span);
    }
}

fn functions(code: &mut Code<'_>, parts: &[&Part]) {
    let mut whole = |text: &str| text.lines().for_each(|l| code.line(l));
    for part in parts {
        if let Source::Text(text) = part.source
            && text.starts_with("DEF")
        {
            whole(text);
        }
    }
    if code.values.clamps {
        FN_INDEX.lines().for_each(|l| code.line(l));
    }
}

/// By what a table's entries are multiplied in DATA: where memory is short,
/// fractions of a power of two are written as whole numbers, which are shorter
/// and, divided again, the same bits.
fn scale(plan: &Plan, table: &Table) -> u32 {
    if !plan.tight || table.ty != Type::Real {
        return 1;
    }
    let whole = |scale: &u32| {
        let mut entries = table.entries.iter().map(|e| e.value().real());
        entries.all(|x| {
            let scaled = x * f64::from(*scale);
            scaled.fract() == 0.0 && scaled.abs() < 1e6
        })
    };
    (0..=16).map(|k| 1 << k).find(whole).unwrap_or(1)
}

fn data(plan: &Plan, code: &mut Code<'_>) {
    let width = if plan.tight { 200 } else { 60 };
    for table in &plan.graph.tables {
        let scale = f64::from(scale(plan, table));
        let mut line = String::new();
        for entry in &table.entries {
            let text = match entry.value() {
                Value::Real(x) => literal(x * scale),
                Value::Int(n) => n.to_string(),
                Value::Bool(b) => (-i32::from(b)).to_string(),
            };
            if line.len() + text.len() > width {
                code.line(std::mem::take(&mut line));
            }
            line.push_str(if line.is_empty() { "DATA " } else { "," });
            line.push_str(&text);
        }
        if !line.is_empty() {
            code.line(line);
        }
    }
}
