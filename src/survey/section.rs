//! One scene on one machine, as a part of the document.

use crate::format::duration;
use crate::tune::goal::{Measure, percent};
use crate::tune::plot::svg;
use crate::tune::point::Point;
use crate::tune::search::Search;
use crate::tune::settings::Drafted;
use crate::tune::tell::Told;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// How many digits of a program's digest are told: enough to see that it is another.
const DIGITS: usize = 12;

/// What is written of one scene on one machine.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Section {
    /// The scene's file.
    pub path: PathBuf,
    /// The scene's name.
    pub scene: String,
    /// The machine's name.
    pub target: String,
    /// The command that finds the same.
    pub command: String,
    /// The conclusion.
    pub sentence: String,
    /// The frontier, a cell a figure; the first row has the titles.
    pub rows: Vec<Vec<String>>,
    /// What is to be said below.
    pub notes: Vec<String>,
    /// The plot.
    pub svg: String,
    /// A row for the table of all: cells.
    pub summary: Vec<String>,
    /// Pixels of programs unlike their models: 0, or something is broken.
    pub wrong: u64,
}

impl Section {
    /// Of what a search found.
    pub fn new(told: &Told<'_>, search: &Search) -> Section {
        let base = told.base;
        let mut command = format!(
            "slowlight tune {} --target {} --settings {} --limit {}",
            base.path.display(),
            base.target.name,
            search.settings,
            search.limit
        );
        command.push_str(match told.measure {
            Measure::Pixels => "",
            Measure::Rmse => " --measure rmse",
            Measure::Lowpass => " --measure lowpass",
        });
        let wrong = |p: &Point| p.measured.differs_from_model;
        Section {
            path: base.path.clone(),
            scene: base.name(),
            target: base.target.name.to_owned(),
            command,
            sentence: told.sentence(),
            rows: rows(told),
            notes: notes(told),
            svg: svg(told),
            summary: summary(told),
            wrong: told.points.iter().map(wrong).sum(),
        }
    }

    /// The name of its plot's file.
    pub fn picture(&self) -> String {
        format!(
            "accuracy-{}-{}.svg",
            self.scene,
            self.target.replace(':', "-")
        )
    }
}

/// The frontier, and the beginning of each program's digest.
fn rows(told: &Told<'_>) -> Vec<Vec<String>> {
    let mut rows = told.rows();
    let digests = told.frontier().map(|(_, point)| {
        let digest = point.measured.program_sha256.get(..DIGITS);
        digest.unwrap_or_default().to_owned()
    });
    let last = std::iter::once("program".to_owned()).chain(digests);
    for (row, cell) in rows.iter_mut().zip(last) {
        row.push(cell);
    }
    rows
}

/// The ends and the knee, and how well the planner knew.
fn summary(told: &Told<'_>) -> Vec<String> {
    let says = |p: Option<&Point>| match p {
        Some(p) => format!(
            "{}, {}",
            duration(p.measured.seconds),
            percent(told.error(p))
        ),
        None => "-".to_owned(),
    };
    let mut ends = told.frontier().map(|(_, p)| p);
    let first = ends.next();
    let last = ends.next_back().or(first);
    let spans = first.zip(last).map_or("-".to_owned(), |(a, b)| {
        format!("{:.0}", b.measured.seconds / a.measured.seconds)
    });
    let tried = told.found.tried.max(told.points.len());
    vec![
        says(first),
        says(told.knee()),
        says(last),
        spans,
        format!("{} of {tried}", told.frontier().count()),
        told.correlation()
            .map_or("-".to_owned(), |r| format!("{r:.3}")),
    ]
}

fn notes(told: &Told<'_>) -> Vec<String> {
    let mut notes = Vec::new();
    let hertz = told.base.hertz();
    for mark in &told.marks {
        let time = duration(mark.time.seconds(hertz));
        let error = percent(mark.error);
        notes.push(format!("Red in the plot: {}, {time}, {error}.", mark.name));
    }
    let mut others: Vec<String> = (told.found.drafted.iter())
        .filter_map(|draft| other_way(told, draft))
        .collect();
    others.sort();
    if !others.is_empty() {
        notes.push(format!(
            "Drawn in `f64` and left out there: {}.",
            others.join("; ")
        ));
    }
    let pruned = told.found.pruned.len();
    if pruned > 0 {
        notes.push(format!(
            "Left out by what formats and settings are by themselves: {pruned}."
        ));
    }
    let looked = told.found.left.len();
    if looked > 0 {
        notes.push(format!("Left out after three bands of rows: {looked}."));
    }
    let failed = told.found.failed.iter().map(|(choice, why)| {
        let words = told.base.words(choice).join(" ");
        let options = match words.is_empty() {
            true => "(none)".to_owned(),
            false => format!("`{words}`"),
        };
        format!("\n- {options}: {}", why.lines().next().unwrap_or_default())
    });
    let failed: String = failed.collect();
    if !failed.is_empty() {
        notes.push(format!("Not to be had:{failed}"));
    }
    notes
}

/// A setting that finds in another way what the scene asks for, pixel by pixel.
fn other_way(told: &Told<'_>, draft: &Drafted) -> Option<String> {
    let setting = draft.setting;
    if setting.ways.words().is_empty() || setting.block != (1, 1) {
        return None;
    }
    let words = told.base.setting(&setting).join(" ");
    let work = draft.work as f64 / told.found.whole_work.max(1) as f64;
    let error = percent(told.measure.of(&draft.errors));
    Some(format!(
        "`{words}`, {work:.2} times the operations of the scene as written, {error}"
    ))
}
