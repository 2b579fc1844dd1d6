//! Everything around a scene's statements.

mod behind;

use super::Style;
use super::code::Code;
use super::code::Late;
use super::columns;
use super::dead;
use super::lines::Lines;
use super::passes::Passes;
use super::poke::Poke;
use super::procedure::as_procedure;
use super::ramp;
use super::refine::Refined;
use super::screen;
use super::segment::{SEGMENT, Segments};
use super::short::{Known, short};
use super::spread::Spread;
use super::steps;
use super::tables;
use super::tail;
use super::thread::threaded;
use super::ways;
use crate::ir::graph::ParamId;
use crate::plan::{Copies, Plan};
use crate::source::Span;
pub(super) use behind::{called, functions, procedures};
use behind::{called_rarely, reports, setup};

/// How often a row's and a pixel's statements are carried out, roughly: for
/// the weights of names only.
const ROW: u64 = 300;
pub(super) const PIXEL: u64 = 100_000;

/// The whole program.
pub fn program(plan: &Plan) -> Lines {
    let mut code = Code::new(plan);
    let first = code.values.names.unique("first", "%");
    let last = code.values.names.unique("last", "%");
    let spread = Spread::new(plan, &mut code);
    parameters(plan, &mut code, &first, &last);
    picture(plan, &mut code, &first, &last, spread.as_ref());
    code.lines.weight = if plan.calls_at_pixels() { PIXEL } else { ROW };
    procedures(plan, &mut code);
    code.lines.weight = 1;
    let rare = std::mem::take(&mut code.rare);
    code.lines.append(rare);
    let parts = called(plan, &code);
    setup(plan, &mut code, &parts, &first, &last);
    // Called for many pixels, but not for all.
    let rarely = !plan.calls_at_pixels() && called_rarely(&code);
    code.lines.weight = if rarely { 1 } else { 5_000 };
    functions(&mut code, &parts);
    code.lines.weight = 1;
    tables::data(plan, &mut code);
    let style = code.values.style;
    if style == Style::Listing {
        return code.lines.remarked(|span| item(plan, span));
    }
    let params = (0..plan.params.len()).map(|k| code.values.names.param(k).to_owned());
    let keep: Vec<String> = params.chain([first, last]).collect();
    let lines = threaded(code.lines, &mut code.labels, style != Style::Small);
    let rounds = match style {
        Style::Fast => ROUNDS,
        _ => 0,
    };
    // What nothing asks for any more leaves ways that are the same.
    let lines = (0..rounds).fold(dead::without(lines), |lines, _| {
        dead::without(ways::split(lines, &mut code.labels, plan.copies))
    });
    let lines = match plan.copies {
        Copies::Ends => tail::copied(lines, &mut code.labels),
        _ => lines,
    };
    let mut lines = lines.away(&code.seldom);
    // The innermost loop is meant in any case, and is found sooner without its name.
    lines.each_text(|text| *text = unnamed(text));
    let assigned = code.values.names.constants();
    let constants = assigned
        .filter_map(|text| Some(text.split_once('=')?.0.to_owned()))
        .collect();
    let flags = code.values.names.flags(plan);
    let known = Known {
        constants: &constants,
        flags: &flags,
        spare: plan.calls_seldom(),
        scant: plan.scant,
    };
    short(lines, &keep, &known, style)
}

/// How often ways are split and what they set in vain is left out.
const ROUNDS: usize = 2;

/// Statements with the names of loops that end left out.
fn unnamed(text: &str) -> String {
    let mut parts = text.split("NEXT ");
    let first = parts.next().unwrap_or("").to_owned();
    let of = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
    parts.fold(first, |done, part| {
        format!("{done}NEXT{}", part.trim_start_matches(of))
    })
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
    let what = match plan.scant {
        true => String::new(),
        false => format!(", {}x{} in {} inks,", mode.width, mode.height, mode.inks),
    };
    code.line(format!(
        "REM {}{what} by slowlight for {}{page}",
        plan.name, plan.target.name
    ));
    let remark = |text: String| match plan.brief {
        true => String::new(),
        false => format!(":REM {text}"),
    };
    if !plan.brief {
        code.line("REM Change what you like here:");
    }
    for (k, (param, written)) in plan.graph.params.iter().zip(&plan.params).enumerate() {
        if plan.is_held(ParamId(k as u32)) {
            continue;
        }
        let name = code.values.names.param(k);
        let range = match &written.range {
            Some((lo, hi)) => remark(format!("{lo} to {hi}")),
            None => String::new(),
        };
        let text = format!("{name}={}{range}", written.text);
        code.lines.line(text, Some(param.span));
    }
    let (top, bottom) = plan.shown_rows();
    let rows = remark(format!("rows to draw, from {top} to {bottom}"));
    code.line(format!(
        "{first}={}:{last}={}{rows}",
        plan.rows.0, plan.rows.1
    ));
}

pub(super) fn picture(
    plan: &Plan,
    code: &mut Code<'_>,
    first: &str,
    last: &str,
    spread: Option<&Spread>,
) {
    // MODE must stand outside procedures, and after nothing but small tables.
    if !plan.toot {
        code.statement("PROCsetup");
    }
    if plan.plot {
        code.statement(format!("MODE {}", plan.mode.name));
        if !plan.toot {
            code.statement("VDU 23,1,0;0;0;0;");
        }
        for (ink, rgb) in plan.graph.image.palette.iter().enumerate() {
            if let Some(text) = screen::colour(plan, ink, *rgb) {
                code.statement(text);
            }
        }
    }
    if let Some(spread) = spread {
        spread.start(code);
    }
    // What a program that goes on makes once stands before its first picture.
    let again = plan.graph.is_moving().then(|| {
        columns::make(plan, code);
        let screen = in_memory(plan, code);
        let label = code.labels.next();
        code.lines.place(label);
        (screen, label)
    });
    code.block(&plan.tree.frame);
    if again.is_none() {
        columns::make(plan, code);
    }
    columns::fill(plan, code);
    let refined = Refined::new(plan, code);
    // Errors come from the rows above, drawn or not.
    let top = if spread.is_some() { "0" } else { first };
    let ((passes, poke), again) = match again {
        Some((screen, label)) => (screen, Some(label)),
        None => (in_memory(plan, code), None),
    };
    code.frame = plan.drawn;
    match &refined {
        Some(refined) => refined.begin(code, (first, last)),
        None => code.line(format!("FOR Y%={top} TO {last}")),
    }
    code.lines.weight = ROW;
    if let Some(refined) = &refined {
        refined.row(code);
    }
    let pokes = poke.is_some() || passes.as_ref().is_some_and(Passes::pokes);
    if plan.plot && !pokes && !plan.toot {
        code.statement(format!("R%={}", screen::y_expression(plan)));
    }
    let mut apart = Vec::new();
    if let Some(row) = as_procedure(code, "row", |code| {
        code.block(&plan.tree.row);
        if passes.is_none() && plan.computed_columns().0 > 0 {
            ramp::start(plan, code, &plan.computed_columns().0.to_string());
        }
    }) {
        apart.push(row);
    }
    let columns = plan.computed_columns();
    let segments = Segments::new(plan, code);
    let still = segments.is_some() && poke.is_none();
    if still && code.values.style == Style::Fast {
        code.late = Late::of(plan, code);
    }
    let top_label = code.labels.next();
    let behind_run = code.labels.next();
    match (&poke, &segments) {
        _ if passes.is_some() => {
            let row = passes.iter();
            let segments = segments.as_ref();
            apart.extend(
                row.flat_map(|row| row.begin(plan, code, segments, (top_label, behind_run))),
            );
        }
        (Some(poke), _) => {
            apart.extend(poke.columns(plan, code, segments.as_ref(), top_label));
        }
        (None, Some(segments)) => {
            code.statement(format!("X%={}", columns.0));
            ramp::are_at(code, "X%");
            code.lines.place(top_label);
            let draw = screen::run(plan, code, segments.end(), 1);
            apart.extend(as_procedure(code, "segment", |code| {
                segments.begin(plan, code, Some(&draw));
            }));
            segments.drawn(plan, code, behind_run);
            code.line(format!("FOR X%=X% TO {}", segments.end()));
        }
        (None, None) => code.line(format!("FOR X%={} TO {}", columns.0, columns.1)),
    }
    code.lines.weight = PIXEL;
    if let Some(spread) = spread {
        spread.receive(code);
    }
    if let Some(refined) = &refined {
        refined.receive(code);
    }
    code.closes = true;
    code.block(&plan.tree.pixel);
    code.closes = false;
    code.known = None;
    let posted = plan.toot && plan.plot && spread.is_none() && refined.is_none();
    if !posted {
        let ink = code.values.read(plan.graph.ink);
        code.assign("I%", &ink);
    }
    if posted {
        screen::draw(plan, code);
    } else if let Some(poke) = &poke {
        poke.gather(code);
    } else if let Some(row) = passes.as_ref().filter(|row| row.pokes()) {
        row.put(code);
    } else if plan.plot {
        // After MODE the screen is ink 0 already.
        let seen = seen(plan, (first, last));
        code.line(format!(
            "IF I%{seen} THEN GCOL 0,I%:{}",
            screen::point(plan)
        ));
    }
    if let Some(spread) = spread {
        spread.send(code);
    }
    if let Some(refined) = &refined {
        refined.send(code);
    }
    ramp::step(plan, code);
    // It ends the loops that were left inside.
    code.line(if code.open > 0 { "NEXT X%" } else { "NEXT" });
    if let (Some(row), Some(_)) = (&passes, &segments) {
        code.lines.weight = SEGMENT;
        row.after_run(code);
    }
    match (&poke, &segments) {
        (Some(poke), _) => poke.put(
            plan,
            code,
            (first, last),
            segments.is_some().then_some(top_label),
        ),
        (None, Some(_)) => {
            code.lines.place(behind_run);
            code.line(format!("IF X%<={} THEN {top_label}", columns.1));
        }
        (None, None) => {}
    }
    code.lines.weight = ROW;
    if passes.is_some() {
        code.line("NEXT");
    }
    if let Some(spread) = spread {
        spread.turn(code);
    }
    match &refined {
        Some(refined) => {
            refined.end(code);
            apart.push(refined.procedures(code));
        }
        None => code.line("NEXT"),
    }
    code.lines.weight = 1;
    code.frame = None;
    match again {
        Some(again) => {
            steps::between(plan, code, plan.plot && poke.is_none());
            code.line(format!("GOTO {again}"));
        }
        None => {
            reports(plan, code);
            if plan.toot && plan.plot {
                // No prompt and no cursor in the picture.
                code.statement("VDU 5,21");
            }
            code.line("END");
        }
    }
    apart.into_iter().for_each(|lines| code.lines.append(lines));
}

/// How pixels are put into memory: in passes, or byte by byte.
fn in_memory(plan: &Plan, code: &mut Code<'_>) -> (Option<Passes>, Option<Poke>) {
    let passes = Passes::new(plan, code);
    let poke = passes.is_none().then(|| Poke::new(plan, code)).flatten();
    (passes, poke)
}

/// What a pixel that is computed must pass beside to be drawn.
fn seen(plan: &Plan, rows: (&str, &str)) -> String {
    let mut text = String::new();
    if !plan.graph.is_in_order() {
        return text;
    }
    text.push_str(&format!(" AND {}", screen::seen_rows(plan, rows)));
    let (computed, drawn) = (plan.computed_columns(), plan.columns);
    if computed.0 < drawn.0 {
        text.push_str(&format!(" AND X%>={}", drawn.0));
    }
    if computed.1 > drawn.1 {
        text.push_str(&format!(" AND X%<={}", drawn.1));
    }
    text
}
