//! Format selection: of a machine's formats for reals, the one whose program is quickest while
//! its picture stays within an error goal.
//!
//! A machine may have seven formats, and to search for a good plan in each would take seconds.
//! So each is judged by a draft, a plan without a search ([`ScreenArgs::sketch`]): its model is
//! run at a sample of the picture's pixels, which tells both what the draft's statements take and
//! which inks are not the native ones ([`estimate::sampled`]). Then the quickest within the goal
//! is planned in earnest, and looked at again by a larger sample: a draft has neither the final
//! word lengths nor the final formulas. Where that goes beyond the goal, or the program does not
//! fit its machine, the next one has its turn; a draft that is half as large again as the machine
//! is left out.
//!
//! The whole picture is looked at, whatever rows are asked for: a format is chosen for a scene.

use crate::estimate::{self, Sampled};
use crate::failure::{Failure, Outcome};
use crate::need;
use crate::scene::{Precision, Scene};
use crate::target_args::ScreenArgs;
use rayon::prelude::*;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::passes::coarse::coarse;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::target::{Target, formats};

/// Statements that a draft's model may run, and a plan's.
const DRAFT: u64 = 8_000_000;
const PLAN: u64 = 16_000_000;

/// Rows and columns of a draft's sample, and of a plan's.
const DRAFT_SIDE: u32 = 36;
const PLAN_SIDE: u32 = 64;

/// How much further than the goal a draft may go: its plan may be better, and the sample is
/// small.
const DOUBT: f64 = 1.5;

/// How many formats are planned in earnest; the last is the one with fewest pixels wrong.
const TRIES: usize = 3;

/// A plan, and what is known of its format.
pub struct Chosen {
    /// In the format that was chosen, or asked for.
    pub plan: Plan,
    /// Why that one; nothing where it was asked for, or there is one only.
    pub why: Option<Why>,
}

impl Chosen {
    /// The plan; why it is in its format is said on standard error.
    pub fn said(self) -> Plan {
        if let Some(why) = self.why {
            let percent = |share: f64| format!("{}%", (share * 1000.0).round() / 10.0);
            let than = match why.gain > 1.05 {
                true => format!(", about {:.1} times as quick as the usual one", why.gain),
                false => String::new(),
            };
            eprintln!(
                "note: format {}{than}: about {} of the pixels are wrong, of the {} that may be \
                 (--error, --goal; --format for another)",
                self.plan.runtime.format,
                percent(why.expected),
                percent(why.goal),
            );
        }
        self.plan
    }
}

/// What a choice was made by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Why {
    /// The share of the picture's pixels that may be wrong.
    pub goal: f64,
    /// The share that is expected to be, by a sample of the plan's own.
    pub expected: f64,
    /// How many times as long the usual format's draft takes; 1 where nothing is known of it.
    pub gain: f64,
}

/// A format as its draft has it.
struct Draft {
    target: &'static Target,
    /// Of the picture, first and last, that the screen shows.
    rows: (u32, u32),
    cycles: f64,
    wrong: f64,
}

/// Plans a scene in the format that is asked for, or else in the quickest within the goal; where
/// no format is, in that with fewest pixels wrong.
///
/// # Errors
/// As for [`ScreenArgs::plan`].
pub fn plan(screen: &ScreenArgs, scene: &Scene, target: &'static Target) -> Outcome<Chosen> {
    let usual = || {
        let plan = screen.plan(scene, target, &[])?;
        Ok(Chosen { plan, why: None })
    };
    if screen.format.is_some() || formats(target).count() < 2 {
        return usual();
    }
    let goal = screen.error_goal();
    let drafts = drafts(screen, scene, target, goal);
    let own = |draft: &&Draft| draft.target.runtime.format == target.runtime.format;
    let own = drafts.iter().find(own).map(|draft| draft.cycles);
    let mut best: Option<Chosen> = None;
    let mut too_large = 0;
    let surest = drafts.iter().min_by(|a, b| a.wrong.total_cmp(&b.wrong));
    for draft in drafts.iter().take(TRIES - 1).chain(surest) {
        let plan = match screen.in_format_of(draft.target).plan(scene, target, &[]) {
            // To find that out takes longest.
            Err(Failure::Wrong(_)) if too_large > 0 => break,
            Err(Failure::Wrong(_)) => {
                too_large += 1;
                continue;
            }
            Err(Failure::Scene(_)) => continue,
            plan => plan?,
        };
        let expected = expected(scene, &plan, draft.rows)?;
        let gain = own.map_or(1.0, |own| own / draft.cycles.max(1.0));
        let why = Some(Why {
            goal,
            expected,
            gain,
        });
        let is_better = |best: &Chosen| best.why.is_none_or(|best| expected < best.expected);
        if best.as_ref().is_none_or(is_better) {
            best = Some(Chosen { plan, why });
        }
        if expected <= goal {
            break;
        }
    }
    match best {
        Some(best) => Ok(best),
        None => usual(),
    }
}

/// The formats that a scene compiles for, and in which its program is not by far too large:
/// those that may be within the goal, the quickest first, then the others, those with fewest
/// pixels wrong first.
fn drafts(screen: &ScreenArgs, scene: &Scene, target: &'static Target, goal: f64) -> Vec<Draft> {
    // Where values have two widths, which of them are narrow is found by a search of its own,
    // that takes longer than it gains.
    let one_width = |t: &&Target| t.runtime.narrow.is_none();
    let all: Vec<&'static Target> = formats(target).filter(one_width).collect();
    let sampled = |&target: &&'static Target| {
        let plan = screen.sketch(scene, target).ok()?;
        if !need::is_near(&plan).ok()? {
            return None;
        }
        let seen = estimate::sampled(&plan, DRAFT_SIDE, DRAFT);
        Some((plan, seen))
    };
    let all: Vec<(Plan, Sampled)> = all.par_iter().filter_map(sampled).collect();
    // All look at the same pixels, as far as they come.
    let Some((plan, longest)) = all.iter().max_by_key(|(_, seen)| seen.inks.len()) else {
        return Vec::new();
    };
    let Ok(native) = native(scene, plan, &longest.inks) else {
        return Vec::new();
    };
    let draft = |(plan, seen): &(Plan, Sampled)| Draft {
        target: plan.target,
        rows: plan.rows,
        cycles: seen.cycles + f64::from(plan.target.starts),
        wrong: unlike(seen, &native),
    };
    let mut drafts: Vec<Draft> = all.iter().map(draft).collect();
    let may = |draft: &Draft| draft.wrong <= DOUBT * goal;
    drafts.sort_by(|a, b| match (may(a), may(b)) {
        (true, true) => a.cycles.total_cmp(&b.cycles),
        (false, false) => a.wrong.total_cmp(&b.wrong),
        (a, b) => b.cmp(&a),
    });
    drafts
}

/// The share of a plan's pixels in some rows whose inks are not the native ones, by a sample.
fn expected(scene: &Scene, plan: &Plan, rows: (u32, u32)) -> Outcome<f64> {
    let mut plan = plan.clone();
    plan.rows = rows;
    let seen = estimate::sampled(&plan, PLAN_SIDE, PLAN);
    Ok(unlike(&seen, &native(scene, &plan, &seen.inks)?))
}

/// The native inks of a plan's pixels, each by itself: nothing is sent to it by others.
fn native(scene: &Scene, plan: &Plan, pixels: &[(u32, u32, u8)]) -> Outcome<Vec<u8>> {
    let graph = scene.graph(Some(plan.mode.inks), Precision::NATIVE)?;
    let mut graph = coarse(&graph, plan.graph.image.block);
    graph.diffusion = None;
    let mut native = Native::new(&graph);
    let ink = |&(x, y, _): &(u32, u32, u8)| native.pixel(x as i32, y as i32).ink;
    Ok(pixels.iter().map(ink).collect())
}

/// The share of a sample's inks that are others than those.
fn unlike(seen: &Sampled, native: &[u8]) -> f64 {
    let pairs = seen.inks.iter().zip(native);
    let wrong = pairs.filter(|((_, _, ink), native)| ink != *native);
    wrong.count() as f64 / seen.inks.len().max(1) as f64
}
