//! A program of the 6502 as one reads it: where things lie, what its routines take, and
//! each line of the scene above the code that it became, with addresses, bytes and cycles.

use crate::failure::{Failure, Outcome};
use crate::format::{count, table};
use crate::machine::File;
use crate::scene::Scene;
use slowlight_compiler::backend::Document;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::source::Span;
use slowlight_vm::mos6502::{Assembly, LineSpan, assemble};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// What begins a part of the generated source.
const PART: &str = "; ---- ";

/// The listing of a plan's program, `NAME.lst`.
///
/// # Errors
/// Where the assembler refuses the program, which is a fault of ours.
pub fn listing(scene: &Scene, plan: &Plan) -> Outcome<File> {
    let (document, assembly) = assembled(plan)?;
    let mut text = memory(&document, &assembly);
    text.push_str(&operations(plan));
    text.push_str(&program(scene, &document, &assembly));
    Ok(File::text(&format!("{}.lst", plan.name), &text))
}

/// A plan's program for the 6502 as the bundled assembler reads it, and what that makes of it.
///
/// # Errors
/// Where the assembler refuses the program, which is a fault of ours.
pub fn assembled(plan: &Plan) -> Outcome<(Document, Assembly)> {
    let document = slowlight_compiler::backend::emit(plan).remove(0);
    let assembly = assemble(&document.text).map_err(|faults| {
        let said: Vec<String> = faults.iter().map(ToString::to_string).collect();
        Failure::Wrong(said.join("\n"))
    })?;
    Ok((document, assembly))
}

/// A table under a headline.
fn headed(head: &str, columns: &[&str], rows: Vec<Vec<String>>) -> String {
    let names = columns.iter().map(|c| (*c).to_owned()).collect();
    let all: Vec<Vec<String>> = std::iter::once(names).chain(rows).collect();
    format!("{head}\n\n{}\n", table(&all))
}

/// The parts of a program in memory: what its zero page and its values take, and what the
/// assembler put where.
fn memory(document: &Document, assembly: &Assembly) -> String {
    let mut rows = Vec::new();
    let (mut part, mut line) = ("once a picture", 0);
    let starts = document.text.lines().enumerate();
    let starts = starts.filter_map(|(k, text)| Some((text.strip_prefix(PART)?, k + 1)));
    let end = document.text.lines().count() + 1;
    for (name, start) in starts.chain([("", end)]) {
        let bytes: Vec<&LineSpan> = (assembly.lines.iter())
            .filter(|span| (line..start).contains(&(span.line as usize)))
            .collect();
        let named = symbols(document, line..start);
        if let (Some(least), Some(most)) = (named.iter().min(), named.iter().max()) {
            let whole = format!("{part}, {} names", named.len());
            rows.push(vec![whole, format!("{least:04X}-{most:04X}")]);
            part = "once a picture";
        }
        if let (Some(first), Some(last)) = (bytes.first(), bytes.last()) {
            let behind = u32::from(last.address) + last.length;
            rows.push(vec![
                part.to_owned(),
                format!("{:04X}-{:04X}", first.address, behind - 1),
                count(u64::from(behind - u32::from(first.address))),
            ]);
        }
        (part, line) = (name, start);
    }
    let head = "Where things lie (hexadecimal; of what is not in the file, from the first to the last name)";
    headed(head, &["part", "addresses", "bytes"], rows)
}

/// The addresses that lines of the source give names to.
fn symbols(document: &Document, lines: std::ops::Range<usize>) -> Vec<u32> {
    let text = document.text.lines().enumerate();
    let within = text.filter(|(k, _)| lines.contains(&(k + 1)));
    let address = |(_, line): (usize, &str)| {
        let (_, value) = (line.split_once(" = $")).filter(|(name, _)| *name != "*")?;
        let digits = value.split(' ').next()?;
        u32::from_str_radix(digits, 16).ok()
    };
    within.filter_map(address).collect()
}

/// The operations of the plan: what the runtime says that they take, and how many there are.
fn operations(plan: &Plan) -> String {
    let mut found: BTreeMap<&str, (u32, u64)> = BTreeMap::new();
    for id in plan.graph.ids() {
        if let Some(routine) = plan.routine(id) {
            let uses = found.entry(routine.name).or_insert((routine.cycles, 0));
            uses.1 += 1;
        }
    }
    let mut rows: Vec<(&str, (u32, u64))> = found.into_iter().collect();
    rows.sort_by_key(|(name, (cycles, _))| (std::cmp::Reverse(*cycles), *name));
    let rows = rows
        .into_iter()
        .map(|(name, (cycles, uses))| vec![name.to_owned(), count(u64::from(cycles)), count(uses)]);
    let head =
        "Operations: mean cycles of each, as the runtime states them, and how many the program has";
    headed(head, &["routine", "cycles", "uses"], rows.collect())
}

/// The source with what stands where, each line of the scene above what comes from it.
fn program(scene: &Scene, document: &Document, assembly: &Assembly) -> String {
    let sources = &scene.checked.sources;
    let place = |span: Span| (span.file, sources.line_column(span).0);
    let mut text = String::from(
        "The program: addresses, bytes, cycles (+: one more for a branch that is taken or an index that crosses a page)\n\n",
    );
    let mut shown = None;
    let columns = assembly.columns(&document.text);
    for ((k, line), left) in document.text.lines().enumerate().zip(columns) {
        if line.starts_with(PART) {
            shown = None;
        }
        let from = document.span(k, 0).map(place);
        if let Some((file, number)) = from.filter(|_| from != shown)
            && let Some(file) = sources.files.get(usize::from(file))
        {
            let source = file.text.lines().nth(number - 1).unwrap_or_default();
            let _ = writeln!(
                text,
                "\n{:36}; {}:{number}: {}",
                "",
                file.name,
                source.trim()
            );
            shown = from;
        }
        let _ = writeln!(text, "{}", format!("{left}{line}").trim_end());
    }
    text
}
