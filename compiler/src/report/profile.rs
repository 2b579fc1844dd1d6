//! A profile by source line: what a machine counted for the lines of a generated
//! program, told by the lines of the scene that they come from.
//!
//! The targets keep, for each line they write, the place in the scene behind it
//! ([`Document::lines`]). A line without one is a routine's or the set-up's.
//! Machines charge routines to the lines that call them, so what is left of those
//! is what the program does before it draws: it goes to the scene's `image`, which
//! asks for a screen. The loops over rows and columns and the drawing go to `draw`
//! ([`crate::plan::Plan::drawn`]). Both are named ([`SourceLine::parts`]), so every
//! cycle has a line, and what it is spent on there.
//!
//! What the library computes belongs to the scene's line that calls it, and is told
//! by the library's functions as well ([`SourceLine::within`]).

use crate::analysis::rate::{Dependence, rates};
use crate::backend::Document;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::source::Span;
use std::collections::{BTreeMap, BTreeSet};

/// A line of a generated program, or a statement of it; all numbers are from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Line {
    /// Which of its documents.
    pub document: usize,
    /// Which line.
    pub line: usize,
    /// Which of the line's statements, where the machine counts those; else 0.
    pub statement: usize,
}

/// What a machine counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost {
    /// Where; none for what no document has.
    pub line: Option<Line>,
    /// The routine that was called from there, by its first line where a document has
    /// it; none for what the line did itself.
    pub called: Option<Option<Line>>,
    /// How often it was begun, or the routine called.
    pub times: u64,
    /// The machine's cycles.
    pub cycles: u64,
}

/// A program, and what was counted of it.
#[derive(Clone, Copy, Debug)]
pub struct Measured<'m> {
    /// Its documents.
    pub documents: &'m [Document],
    /// What was counted.
    pub costs: &'m [Cost],
    /// What lines take in memory, in whatever the machine counts.
    pub sizes: &'m [(Line, u64)],
}

/// A part of what a line took.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// A routine's name in the program, a function of the library and where it is, or
    /// [`SET_UP`] or [`FRAME`].
    pub name: String,
    /// How often it was begun.
    pub times: u64,
    /// The machine's cycles.
    pub cycles: u64,
}

/// What is done before a picture.
pub const SET_UP: &str = "set-up";
/// What is done for a picture around its values.
pub const FRAME: &str = "loops and drawing";

/// What a line of the scene took.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SourceLine {
    /// Its file's number.
    pub file: u16,
    /// The line, from 1.
    pub line: usize,
    /// What its values depend on; nothing for constants.
    pub rate: Vec<&'static str>,
    /// How often the line of the program that comes from it and runs most often ran.
    pub executions: u64,
    /// The machine's cycles, routines included.
    pub cycles: u64,
    /// What its lines take in memory.
    pub size: u64,
    /// Of the cycles: routines, the set-up, loops and drawing; the most first.
    pub parts: Vec<Part>,
    /// Of the cycles, what the library's functions took, routines included; the most first.
    pub within: Vec<Part>,
}

/// A run by source lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Profile {
    /// All cycles.
    pub cycles: u64,
    /// What took cycles or memory, in the order of the source.
    pub lines: Vec<SourceLine>,
    /// Cycles of what could not be told.
    pub rest: u64,
    /// Memory of what comes from no line: routines, tables, the set-up.
    pub rest_size: u64,
}

/// A line under way.
#[derive(Default)]
struct Found {
    executions: u64,
    cycles: u64,
    size: u64,
    parts: BTreeMap<String, (u64, u64)>,
    within: BTreeMap<String, (u64, u64)>,
}

/// Parts, the dearest first.
fn parts(all: BTreeMap<String, (u64, u64)>) -> Vec<Part> {
    let part = |(name, (times, cycles))| Part {
        name,
        times,
        cycles,
    };
    let mut all: Vec<Part> = all.into_iter().map(part).collect();
    all.sort_by_key(|part| std::cmp::Reverse(part.cycles));
    all
}

/// Where in a text.
type Place = (u16, usize);

/// Joins a program's line map with what a machine counted.
pub fn profile(scene: &Scene, plan: &Plan, measured: Measured<'_>) -> Profile {
    let lines = Lines::new(scene);
    let mut found: BTreeMap<Place, Found> = BTreeMap::new();
    let mut made = Profile::default();
    let draw = scene.program.draw.as_ref().map(|draw| draw.span);
    let span_of = |line: Line| {
        let document = measured.documents.get(line.document)?;
        let span = document.span(line.line, line.statement)?;
        // What a pass made of nothing that is written belongs to the picture as a whole.
        let nowhere = span.range().is_empty() && span.called().is_none();
        Some(draw.filter(|_| nowhere).unwrap_or(span))
    };
    let image = scene.program.image.as_ref().map(|image| image.span);
    for cost in measured.costs {
        made.cycles += cost.cycles;
        let own = cost.line.and_then(span_of);
        let Some(span) = own.or(image) else {
            made.rest += cost.cycles;
            continue;
        };
        let line = found.entry(lines.place(span)).or_default();
        line.cycles += cost.cycles;
        let part = match (own, cost.called) {
            (None, _) => Some(SET_UP.to_owned()),
            (_, Some(routine)) => Some(routine.map_or_else(
                || "the system".to_owned(),
                |entry| routine_name(measured.documents, entry),
            )),
            (Some(span), None) if Some(span) == plan.drawn => Some(FRAME.to_owned()),
            _ => None,
        };
        if cost.called.is_none() {
            line.executions = line.executions.max(cost.times);
        }
        if let Some(name) = part {
            let part = line.parts.entry(name).or_default();
            *part = (part.0 + cost.times, part.1 + cost.cycles);
        }
        if let Some(inner) = own.and_then(Span::called) {
            let times = if cost.called.is_none() { cost.times } else { 0 };
            let part = line.within.entry(lines.library(inner)).or_default();
            *part = (part.0.max(times), part.1 + cost.cycles);
        }
    }
    for (line, size) in measured.sizes {
        match span_of(*line) {
            Some(span) => found.entry(lines.place(span)).or_default().size += size,
            None => made.rest_size += size,
        }
    }
    let rates = line_rates(plan, &lines);
    let told = |((file, line), found): (Place, Found)| SourceLine {
        file,
        line,
        rate: rates
            .get(&(file, line))
            .map_or(Vec::new(), |set| set.iter().copied().collect()),
        executions: found.executions,
        cycles: found.cycles,
        size: found.size,
        parts: parts(found.parts),
        within: parts(found.within),
    };
    made.lines = found.into_iter().map(told).collect();
    made
}

/// What the values of each line depend on.
fn line_rates(plan: &Plan, lines: &Lines<'_>) -> BTreeMap<Place, BTreeSet<&'static str>> {
    let rates = rates(&plan.graph);
    let mut found: BTreeMap<Place, BTreeSet<&'static str>> = BTreeMap::new();
    for (place, _) in plan.places() {
        let crate::ir::tree::Place::Node(id) = place else {
            continue;
        };
        let line = found.entry(lines.place(plan.graph.span(id))).or_default();
        line.extend(rates.rate(id).iter().map(|dependence| match dependence {
            Dependence::Frame => "param",
            Dependence::Row => "row",
            Dependence::Pass => "pass",
            Dependence::Column => "column",
            Dependence::Loop(_) | Dependence::Last(_) => "loop",
        }));
    }
    found
}

/// The name of the routine that begins at a line: what is declared or labelled there,
/// or last before it.
fn routine_name(documents: &[Document], entry: Line) -> String {
    let Some(document) = documents.get(entry.document) else {
        return String::new();
    };
    let text: Vec<&str> = document.text.lines().take(entry.line + 1).collect();
    let declared = text.iter().rev().find_map(|line| declared(line));
    let Some(name) = declared else {
        return document.name.clone();
    };
    match document.name.strip_suffix(".jack") {
        Some(class) => format!("{class}.{name}"),
        None => name.to_owned(),
    }
}

/// What a line of BASIC, Jack or assembly declares.
fn declared(line: &str) -> Option<&str> {
    let word = |text: &str| {
        let end = text.find(|c: char| !c.is_alphanumeric() && c != '_' && c != '%');
        end.unwrap_or(text.len())
    };
    if let Some((_, name)) = line.split_once("DEF ") {
        return name.get(..word(name));
    }
    let kinds = ["function ", "method ", "constructor "];
    if let Some(rest) = kinds
        .iter()
        .find_map(|kind| line.trim_start().strip_prefix(kind))
    {
        let before = rest.split('(').next()?;
        return before.split_whitespace().last();
    }
    let label = line.split(';').next()?.trim_end().strip_suffix(':')?;
    (!label.is_empty() && word(label) == label.len()).then_some(label)
}

/// The lines of a scene's texts.
pub(super) fn lines_of(scene: &Scene) -> Lines<'_> {
    Lines::new(scene)
}

/// Lines of a scene's texts, and the library's items.
pub(super) struct Lines<'s> {
    scene: &'s Scene,
    /// For each text, where its lines begin.
    starts: Vec<Vec<u32>>,
    /// Where an item of the library begins, and what it is.
    items: BTreeMap<(u16, u32), String>,
}

impl<'s> Lines<'s> {
    fn new(scene: &'s Scene) -> Lines<'s> {
        let starts = scene.sources.files.iter().map(|file| {
            let ends = file.text.match_indices('\n');
            std::iter::once(0)
                .chain(ends.map(|(at, _)| at as u32 + 1))
                .collect()
        });
        let program = &scene.program;
        let functions = program.functions.iter().filter(|f| f.library);
        let functions = functions.map(|f| (f.span, f.name.clone()));
        let shapes = program.shapes.iter().filter(|s| s.library);
        let facets = shapes.flat_map(|shape| {
            let name = |kind: &str| format!("{}.{kind}", shape.name);
            let facets = shape.facets.iter();
            facets.map(move |facet| (facet.span, name(facet.kind.name())))
        });
        let items = functions.chain(facets);
        Lines {
            scene,
            starts: starts.collect(),
            items: items
                .map(|(span, name)| ((span.file, span.start), name))
                .collect(),
        }
    }

    /// The file and the line (from 1) where a span begins.
    pub fn place(&self, span: Span) -> Place {
        let starts = self.starts.get(usize::from(span.file));
        let line = starts.map_or(0, |starts| starts.partition_point(|at| *at <= span.start));
        (span.file, line)
    }

    /// A place in the library: `least_root (solve.scn:12)`.
    fn library(&self, span: Span) -> String {
        let (file, line) = self.place(span);
        let files = &self.scene.sources.files;
        let path = files.get(usize::from(file)).map_or("", |f| &f.name);
        let at = format!("{path}:{line}");
        let before = self.items.range((file, 0)..=(file, span.start));
        match before.last() {
            Some((_, name)) => format!("{name} ({at})"),
            None => at,
        }
    }
}
