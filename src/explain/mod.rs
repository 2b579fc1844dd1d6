//! A profile of a scene: its program run on its machine, every cycle charged to a
//! line of the scene, beside what that line adds to the picture's error.

pub mod error;
pub mod html;
pub mod terminal;
mod told;
pub mod why;

use crate::auto_format;
use crate::draw::Window;
use crate::failure::{Failure, Outcome};
use crate::machine::{LineRoles, MachineRun, complaint};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::target_args::ScreenArgs;
use crate::trial;
use crate::vcs;
use error::{Errors, Without};
use serde::Serialize;
use serde_json::Value;
use slowlight_compiler::backend::Document;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::report::profile::{self, Cost, Measured, Part, Profile, SourceLine};
use slowlight_compiler::targets::Target;
use std::collections::BTreeMap;
use why::Whys;

/// A profile and what is needed to show it.
pub struct Explained {
    /// The scene.
    pub scene: Scene,
    /// Its plan.
    pub plan: PlannedScene,
    /// The machine's counts.
    pub run: MachineRun,
    /// The counts by the scene's lines.
    pub profile: Profile,
    /// The picture's error by the scene's lines.
    pub errors: Errors,
    /// What lines' plans could not do, if that was looked for.
    pub why: Option<Whys>,
}

/// A program that was run, with what its lines took.
pub struct Counted {
    /// What it is of.
    pub plan: PlannedScene,
    /// The machine's counts in all.
    pub run: MachineRun,
    documents: Vec<Document>,
    costs: Vec<Cost>,
    /// By effects' numbers: the cycles of their own at each pixel at which they had any,
    /// and where a row or a run of columns begins. None where the program does not part
    /// all of its pixels by statements that draw, as quick BASIC does not.
    pub stretches: Option<BTreeMap<u16, Vec<u64>>>,
    sizes: Vec<(profile::Line, u64)>,
}

impl Counted {
    /// What was counted, for a report.
    pub fn measured(&self) -> Measured<'_> {
        Measured {
            documents: &self.documents,
            costs: &self.costs,
            sizes: &self.sizes,
        }
    }
}

/// Runs a plan's program, and counts what each line takes.
///
/// # Errors
/// Where it does not end by itself.
pub fn count_lines(
    scene: &Scene,
    plan: PlannedScene,
    screen: &ScreenArgs,
    limit: u64,
) -> Outcome<Counted> {
    if vcs::is_cartridge(&plan) {
        let why = "a cartridge goes on for ever, and what its lines take is not told apart yet; \
                   `run` says what its first picture takes";
        return Err(Failure::Wrong(why.to_owned()));
    }
    let documents = slowlight_compiler::backend::emit(&plan);
    let mut loaded = trial::build_for(&plan, screen.machine(plan.target))?.loaded;
    let span = |line: profile::Line| {
        let document: &Document = documents.get(line.document)?;
        document.span(line.line, line.statement)
    };
    let roles = LineRoles {
        routine: &|line| span(line).is_none(),
        group: &|line| span(line)?.effect,
        // What is around a pixel's statements parts one pixel's from another's.
        cuts: &|line| span(line).is_some_and(|span| plan.drawn == Some(span)),
    };
    let window = Window::of(&plan);
    let progress = Progress::new(
        format!("{} {}", scene.name, plan.target.name),
        u64::from(window.height()),
    );
    let top = i64::from(window.rows.0) + i64::from(plan.offset.1);
    let (run, lines) = loaded.charges(limit, roles, &mut |now| {
        if let Some(row) = now.row {
            progress.reach(u64::try_from(i64::from(row) - top).unwrap_or(0));
        }
    })?;
    drop(progress);
    if let Some(wrong) = complaint(&run, limit) {
        let name = plan.target.name;
        return Err(Failure::Wrong(format!("{name}: {wrong}")));
    }
    Ok(Counted {
        sizes: loaded.line_sizes(),
        plan,
        run,
        documents,
        costs: lines.costs,
        stretches: (lines.cuts >= window.count() as u64).then_some(lines.stretches),
    })
}

/// Runs a scene's program and joins its counts with its line map.
///
/// # Errors
/// Where the scene does not compile or fit, or its program does not end by itself.
pub fn explain(
    scene: Scene,
    target: &'static Target,
    screen: &ScreenArgs,
    limit: u64,
) -> Outcome<Explained> {
    let plan = auto_format::plan(screen, &scene, target)?.said();
    let counted = count_lines(&scene, plan, screen, limit)?;
    let profile = profile::profile(&scene.checked, &counted.plan, counted.measured());
    let errors = error::errors(&scene, &counted.plan)?;
    let Counted { plan, run, .. } = counted;
    Ok(Explained {
        scene,
        plan,
        run,
        profile,
        errors,
        why: None,
    })
}

/// What a machine counts by.
pub fn unit(run: &MachineRun) -> &'static str {
    match run.vm_instructions {
        Some(_) => "VM commands",
        None => "cycles",
    }
}

/// What memory is counted by.
pub fn size_unit(run: &MachineRun) -> &'static str {
    match run.vm_instructions {
        Some(_) => "commands",
        None => "bytes",
    }
}

impl Explained {
    /// A number of cycles as a share of all, 0 to 1.
    pub fn share(&self, cycles: u64) -> f64 {
        cycles as f64 / self.profile.cycles.max(1) as f64
    }

    /// What the machine counts by.
    pub fn unit(&self) -> &'static str {
        unit(&self.run)
    }

    /// What memory is counted by.
    pub fn size_unit(&self) -> &'static str {
        size_unit(&self.run)
    }

    /// The scene's own files: number, name, text.
    pub fn files(&self) -> impl Iterator<Item = (u16, &str, &str)> {
        let files = (0..).zip(&self.scene.checked.sources.files);
        let own = files.filter(|(_, file)| !file.library);
        own.map(|(k, file)| (k, file.name.as_str(), file.text.as_str()))
    }

    /// What a line of a file took.
    pub fn line(&self, file: u16, line: usize) -> Option<&SourceLine> {
        let mut lines = self.profile.lines.iter();
        lines.find(|found| (found.file, found.line) == (file, line))
    }

    /// What is left of the error without that of a line, where it computes reals.
    pub fn error(&self, line: &SourceLine) -> Option<Without> {
        self.errors.lines.get(&(line.file, line.line)).copied()
    }

    /// What `explain --json` prints.
    pub fn report(&self) -> Report<'_> {
        let plan = &self.plan;
        let window = Window::on_screen(plan);
        let charged: u64 = self.profile.lines.iter().map(|line| line.cycles).sum();
        let files: Vec<(u16, &str, &str)> = self.files().collect();
        let line = |line: &SourceLine| {
            let file = files.iter().find(|(k, ..)| *k == line.file);
            let (name, text) = file.map_or(("", ""), |(_, name, text)| (*name, *text));
            LineReport {
                file: name.to_owned(),
                line: line.line,
                text: text
                    .lines()
                    .nth(line.line.saturating_sub(1))
                    .unwrap_or("")
                    .to_owned(),
                rate: line.rate.clone(),
                executions: line.executions,
                cycles: line.cycles,
                share: self.share(line.cycles),
                size: line.size,
                error: self.error(line).map(|without| ErrorReport {
                    rmse_without: without.rmse,
                    differs_without: without.differ,
                    share: without.share,
                }),
                parts: self.part_reports(&line.parts),
                library: self.part_reports(&line.within),
                why: self.why.as_ref().map(|all| {
                    let why = all.get(&(line.file, line.line));
                    why.map(|why| WhyReport {
                        text: &why.text,
                        change: &why.change,
                        saves: why.saves,
                        saves_in_all: why.saves_in_all,
                    })
                }),
            }
        };
        Report {
            scene: &self.scene.name,
            target: plan.target.name,
            mode: trial::mode_json(plan.mode.name),
            format: plan.runtime.format,
            width: window.width(),
            height: window.height(),
            rows: [window.rows.0, window.rows.1],
            cycles: self.run.cycles,
            unit: self.unit(),
            accounted: self.share(charged),
            rest: self.profile.rest,
            size_unit: self.size_unit(),
            rest_size: self.profile.rest_size,
            sampled: self.errors.pixels,
            rmse: self.errors.rmse,
            differs_from_native: self.errors.differ,
            lines: self.profile.lines.iter().map(line).collect(),
        }
    }

    fn part_reports(&self, parts: &[Part]) -> Vec<PartReport> {
        let report = |part: &Part| PartReport {
            name: part.name.clone(),
            times: part.times,
            cycles: part.cycles,
            share: self.share(part.cycles),
        };
        parts.iter().map(report).collect()
    }
}

/// The object of `explain --json`.
#[derive(Serialize)]
pub struct Report<'e> {
    scene: &'e str,
    target: &'e str,
    mode: Value,
    format: &'e str,
    /// Columns drawn.
    width: u32,
    /// Rows drawn.
    height: u32,
    /// The first and the last of them.
    rows: [u32; 2],
    /// The machine's cycles: the lines' and the rest's sum.
    cycles: u64,
    /// What they are.
    unit: &'static str,
    /// The share of them that lines have, 0 to 1.
    accounted: f64,
    rest: u64,
    /// What lines' sizes are.
    size_unit: &'static str,
    /// The size of what comes from no line: routines, tables, the set-up.
    rest_size: u64,
    /// Pixels that errors are of.
    sampled: usize,
    /// Over their shades, model against native.
    rmse: f64,
    differs_from_native: usize,
    lines: Vec<LineReport<'e>>,
}

/// A line in the object of `explain --json`.
#[derive(Serialize)]
struct LineReport<'e> {
    file: String,
    line: usize,
    text: String,
    rate: Vec<&'static str>,
    executions: u64,
    cycles: u64,
    share: f64,
    size: u64,
    /// Null where the line computes no reals.
    error: Option<ErrorReport>,
    /// Of its cycles: routines, the set-up, loops and drawing.
    parts: Vec<PartReport>,
    /// Of its cycles: the library's functions.
    library: Vec<PartReport>,
    /// What its plan could not do: absent where nobody asked, null where nothing was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<Option<WhyReport<'e>>>,
}

#[derive(Serialize)]
struct WhyReport<'e> {
    text: &'e str,
    /// What is to be written.
    change: &'e str,
    /// Cycles of the line, and of all.
    saves: u64,
    saves_in_all: u64,
}

/// What is left of the error where a line's values are in `f64`.
#[derive(Serialize)]
struct ErrorReport {
    rmse_without: f64,
    differs_without: usize,
    /// What share of the mean square is gone; below 0 it grew.
    share: f64,
}

#[derive(Serialize)]
struct PartReport {
    name: String,
    times: u64,
    cycles: u64,
    /// Of all cycles of the run.
    share: f64,
}
