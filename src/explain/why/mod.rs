//! Missed-optimization remarks by experiment: for each line what its plan could not do, what
//! would let it, and how many of the machine's cycles that spares.
//!
//! What might help is put into the scene, one thing at a time ([`ways`], [`bounds`]). Drafts,
//! plans without a search, say about what each gains; of those that ask as much the one that
//! claims least is kept, and the best are planned in earnest, built and run on the machine as
//! the scene itself was. So a gain that is told was measured, line by line; and what the plan
//! could not do is read off the two plans ([`slowlight_compiler::report::missed`]).

mod bounds;
mod sentence;
mod ways;

use super::{Explained, count_lines};
use crate::auto_format;
use crate::draw::Window;
use crate::estimate;
use crate::failure::{Failure, Outcome};
use crate::jobs;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::target_args::ScreenArgs;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::report::missed::{Place, Work, missed, work};
use slowlight_compiler::report::profile::{Profile, profile};
use slowlight_compiler::targets::{Target, formats};
use std::collections::BTreeMap;
use ways::{Kind, Way};

/// How many ways are tried on the machine.
const TRIES: usize = 10;
/// How many params are tried as constants, whatever drafts say: what a search makes of them
/// they do not know.
const CONSTANTS: usize = 4;
/// What a draft has to gain, in parts of what it takes, to be tried.
const WORTH: f64 = 0.005;
/// Which part of the greatest gain of a group will do.
const MOST_OF_IT: f64 = 0.9;
/// What a line must gain to be told: of all cycles, and of its own.
const TOLD: f64 = 0.005;
const TOLD_OF_LINE: f64 = 0.02;
/// What a constant's gain counts beside that of something that leaves params changeable.
const CONSTANT: f64 = 0.6;
/// Rows and columns of the pixels at which operations are counted.
const GRID: u32 = 16;

/// What is said of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Why {
    /// The whole sentence.
    pub text: String,
    /// It without what would be spared, which several lines may have alike.
    pub head: String,
    /// What is to be written.
    pub change: String,
    /// How many of the line's cycles that spares.
    pub saves: u64,
    /// How many of all.
    pub saves_in_all: u64,
}

/// What is said of lines, by file and line; of lines that are not there nothing tried here
/// would spare anything worth it.
pub type Whys = BTreeMap<Place, Why>;

/// A way that was tried.
struct Tried<'w> {
    way: &'w Way,
    plan: PlannedScene,
    profile: Profile,
    work: Work,
    /// How many cycles less it takes.
    saves: u64,
}

/// Looks for what each line's plan could not do.
///
/// # Errors
/// Where the scene does not compile, and an interruption.
pub fn whys(
    found: &Explained,
    target: &'static Target,
    screen: &ScreenArgs,
    limit: u64,
) -> Outcome<Whys> {
    let scene = &found.scene;
    let may_choose = screen.format.is_none() && formats(target).count() > 1;
    let same = held_as(screen, &found.plan);
    let mut groups = ways::of_params(scene, may_choose)?;
    groups.extend(bounds::of_bounds(scene));
    groups.retain(|group| !group.is_empty());
    let ways = chosen(scene, groups, (target, &same))?;
    let pixels = Window::of(&found.plan).grid(GRID);
    let now = work(&scene.checked, &found.plan, &pixels, &|span| span);
    let progress = Progress::new("what would help", ways.len() as u64);
    let each: Vec<&Way> = ways.iter().collect();
    let tried = jobs::each(&each, |&way| {
        let screen = match way.kind {
            Kind::Formats => screen,
            _ => &same,
        };
        let tried = tried(way, found, (target, screen, limit), &pixels);
        progress.step(1);
        tried
    })?;
    drop(progress);
    let mut helped = Vec::new();
    for one in tried {
        helped.extend(given(one)?);
    }
    Ok(told(found, &now, &helped))
}

/// Options that keep the format and the mode of a plan.
fn held_as(screen: &ScreenArgs, plan: &PlannedScene) -> ScreenArgs {
    let mode = Some(plan.mode.name.to_owned()).filter(|name| !name.is_empty());
    ScreenArgs {
        mode,
        error: None,
        goal: None,
        ..screen.like(plan)
    }
}

/// Nothing where a scene that says more does not compile or fit; only an interruption counts.
fn given<T>(outcome: Outcome<T>) -> Outcome<Option<T>> {
    match outcome {
        Ok(found) => Ok(Some(found)),
        Err(Failure::Interrupted) => Err(Failure::Interrupted),
        Err(_) => Ok(None),
    }
}

/// Of each group of ways the one that claims least and gains most of what is to be had, by
/// drafts; the best of all groups.
fn chosen(
    scene: &Scene,
    groups: Vec<Vec<Way>>,
    (target, screen): (&'static Target, &ScreenArgs),
) -> Outcome<Vec<Way>> {
    let draft = |scene: &Scene| -> Outcome<Option<f64>> {
        let target = found_format(target, screen);
        let plan = given(screen.unsearched(scene, target))?;
        Ok(plan.map(|plan| estimate::cycles_roughly(&plan)))
    };
    let all: f64 = draft(scene)?.unwrap_or(f64::INFINITY);
    let flat: Vec<&Way> = groups.iter().flatten().collect();
    let priced = jobs::each(&flat, |way| draft(&way.scene))?;
    let mut gains = Vec::new();
    for cycles in priced {
        let gain = cycles?.map_or(0.0, |cycles| (all - cycles) / all.max(1.0));
        gains.push(if gain.is_finite() { gain } else { 0.0 });
    }
    let mut gains = gains.into_iter();
    let mut constants = 0;
    let mut kept: Vec<(Way, f64)> = Vec::new();
    for group in groups {
        let gains: Vec<f64> = gains.by_ref().take(group.len()).collect();
        let most = gains.iter().copied().fold(0.0, f64::max);
        let enough = gains.iter().position(|gain| *gain >= MOST_OF_IT * most);
        let Some(way) = enough.and_then(|k| group.into_iter().nth(k)) else {
            continue;
        };
        let gain = match way.kind {
            Kind::Formats => 1.0,
            Kind::Constant if most < WORTH && constants < CONSTANTS => {
                constants += 1;
                WORTH
            }
            _ => most,
        };
        if gain >= WORTH {
            kept.push((way, gain));
        }
    }
    kept.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    kept.truncate(TRIES);
    Ok(kept.into_iter().map(|(way, _)| way).collect())
}

/// The target in the format that options ask for.
fn found_format(target: &'static Target, screen: &ScreenArgs) -> &'static Target {
    let asked = |t: &&Target| screen.format.as_deref() == Some(t.runtime.format);
    formats(target).find(asked).unwrap_or(target)
}

/// A way planned, built and run.
fn tried<'w>(
    way: &'w Way,
    found: &Explained,
    (target, screen, limit): (&'static Target, &ScreenArgs, u64),
    pixels: &[(i32, i32)],
) -> Outcome<Tried<'w>> {
    let plan = auto_format::plan(screen, &way.scene, target)?.plan;
    if plan.mode.name != found.plan.mode.name {
        return Err(Failure::Wrong("another mode".to_owned()));
    }
    if way.kind == Kind::Formats && plan.runtime.format == found.plan.runtime.format {
        return Err(Failure::Wrong("the same format".to_owned()));
    }
    let counted = count_lines(&way.scene, plan, screen, limit)?;
    let checked = &way.scene.checked;
    Ok(Tried {
        way,
        profile: profile(checked, &counted.plan, counted.measured()),
        work: work(checked, &counted.plan, pixels, &|span| way.told(span)),
        saves: found.run.cycles.saturating_sub(counted.run.cycles),
        plan: counted.plan,
    })
}

/// For each line the way that gains most there.
fn told(found: &Explained, now: &Work, helped: &[Tried<'_>]) -> Whys {
    let all = found.run.cycles as f64;
    let mut whys = Whys::new();
    for line in &found.profile.lines {
        let place = (line.file, line.line);
        let mut best: Option<(&Tried<'_>, u64, f64)> = None;
        for tried in helped {
            let same =
                |l: &&slowlight_compiler::report::profile::SourceLine| (l.file, l.line) == place;
            let then = tried.profile.lines.iter().find(same);
            let less = line.cycles.saturating_sub(then.map_or(0, |l| l.cycles));
            // What has only gone to another line is not spared.
            let less = less.min(tried.saves);
            let worth =
                less as f64 >= TOLD * all && less as f64 >= TOLD_OF_LINE * line.cycles as f64;
            let weight = match tried.way.kind {
                Kind::Constant => CONSTANT,
                _ => 1.0,
            };
            let gain = weight * less as f64;
            if worth && best.as_ref().is_none_or(|(.., most)| gain > *most) {
                best = Some((tried, less, gain));
            }
        }
        let Some((tried, saves, _)) = best else {
            continue;
        };
        let not_done = missed(now, &tried.work, place);
        let could_not = sentence::could_not(found, tried, not_done);
        let head = format!("{could_not}, as {}; {}", tried.way.cause, tried.way.said);
        let spared = super::terminal::spared(found, saves, line.cycles);
        whys.insert(
            place,
            Why {
                text: format!("{head} {spared}"),
                head,
                change: tried.way.change.clone(),
                saves,
                saves_in_all: tried.saves,
            },
        );
    }
    whys
}

/// A number in two digits, rounded up or down.
fn number(value: f64, up: bool) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let place = 1 - value.abs().log10().floor() as i32;
    let scale = 10f64.powi(place);
    let scaled = value * scale;
    // What is as good as round is not rounded further.
    let near = (scaled - scaled.round()).abs() < 1e-9 * scaled.abs();
    let whole = match (near, up) {
        (true, _) => scaled.round(),
        (_, true) => scaled.ceil(),
        (_, false) => scaled.floor(),
    };
    let text = format!("{:.*}", place.max(0) as usize, whole / scale);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let told = [
            (1.234, true),
            (1.234, false),
            (-0.0567, false),
            (1200.0, true),
            (0.5, true),
        ]
        .map(|(value, up)| number(value, up));
        assert_eq!(told, ["1.3", "1.2", "-0.057", "1200", "0.5"]);
    }
}
