//! What a program's time goes to, in the scene's own words: so that who looks at a point
//! of the frontier sees what the choice has made dear, and what of the error it is.
//!
//! Lines are charged as `explain` does it, on the bands of rows that a first look takes.

use super::bands::{bands_of, pays};
use super::planned::Planned;
use crate::explain::{Counted, count_lines, error};
use crate::failure::Outcome;
use crate::scene::Scene;
use crate::target_args::ScreenArgs;
use serde::{Deserialize, Serialize};
use slowlight_compiler::report::profile::{Part, Profile, profile};
use std::collections::BTreeMap;

/// How many lines are told.
const TOLD: usize = 6;

/// What takes less than this share of the time is not told.
const LEAST: f64 = 0.01;

/// A line of the scene, and what it takes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spent {
    /// Where: `line 17`, with the file if it is not the scene's own.
    pub place: String,
    /// The line's text.
    pub text: String,
    /// Its share of the cycles, 0 to 1.
    pub share: f64,
    /// What share of the mean square error goes where its values are `f64`; none where it
    /// computes no reals, or there is no error.
    pub error: Option<f64>,
    /// The routine that takes most of it, and its share of all cycles.
    pub routine: Option<(String, f64)>,
}

/// Cycles of a line, and of its routines.
#[derive(Default)]
struct Line {
    cycles: u64,
    parts: BTreeMap<String, u64>,
}

/// Where a plan's program spends its time.
///
/// # Errors
/// Where the program does not end by itself.
pub fn spent(
    scene: &Scene,
    planned: &Planned,
    screen: &ScreenArgs,
    limit: u64,
) -> Outcome<Vec<Spent>> {
    let mut lines: BTreeMap<(u16, usize), Line> = BTreeMap::new();
    let mut all = 0;
    for rows in looked_at(planned) {
        let counted = count_lines(scene, planned.band(rows), screen, limit)?;
        all += add(&mut lines, &profile_of(scene, &counted));
    }
    let errors = error::errors_with(scene, &planned.plan, planned.shaded())?;
    let files = &scene.checked.sources.files;
    let scene_file = files.iter().find(|f| !f.library).map_or("", |f| &f.name);
    let share = |cycles: u64| cycles as f64 / all.max(1) as f64;
    let mut lines: Vec<((u16, usize), Line)> = lines.into_iter().collect();
    lines.sort_by(|(at, a), (other, b)| b.cycles.cmp(&a.cycles).then(at.cmp(other)));
    let told = lines.into_iter().take(TOLD);
    let told = told.filter(|(_, line)| share(line.cycles) >= LEAST);
    let told = told.map(|((file, number), line)| {
        let file_of = files.get(usize::from(file));
        let text = file_of.and_then(|f| f.text.lines().nth(number.saturating_sub(1)));
        let routine = line.parts.into_iter().max_by_key(|(_, cycles)| *cycles);
        let without = errors.lines.get(&(file, number));
        Spent {
            place: match file_of {
                Some(file) if file.name != scene_file => format!("line {number} of {}", file.name),
                _ => format!("line {number}"),
            },
            text: text.unwrap_or("").trim().to_owned(),
            share: share(line.cycles),
            error: without.filter(|_| errors.rmse > 0.0).map(|w| w.share),
            routine: routine.map(|(name, cycles)| (name, share(cycles))),
        }
    });
    Ok(told.collect())
}

/// The rows that are looked at: all, where that is no work.
fn looked_at(planned: &Planned) -> Vec<(u32, u32)> {
    match pays(planned) {
        true => bands_of(planned).to_vec(),
        false => vec![planned.plan.rows],
    }
}

fn profile_of(scene: &Scene, counted: &Counted) -> Profile {
    profile(&scene.checked, &counted.plan, counted.measured())
}

/// Adds a profile up; its cycles.
fn add(lines: &mut BTreeMap<(u16, usize), Line>, profile: &Profile) -> u64 {
    for line in &profile.lines {
        let sum = lines.entry((line.file, line.line)).or_default();
        sum.cycles += line.cycles;
        for Part { name, cycles, .. } in &line.parts {
            *sum.parts.entry(name.clone()).or_default() += cycles;
        }
    }
    profile.cycles
}
