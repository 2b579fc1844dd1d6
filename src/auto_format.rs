//! Format selection: of a machine's formats for reals, the one whose program is quickest while
//! its picture stays within an error goal.
//!
//! To search for a good plan in each of seven formats would take long. So each is judged by a
//! plan without a search ([`ScreenArgs::unsearched`]): its model is run at a sample of the
//! picture's pixels, which tells both what the statements take and which inks are not the native
//! ones ([`estimate::sampled`]). Then the quickest candidate within the goal is planned in
//! earnest, and looked at again by a larger sample: only then are its formulas and word lengths
//! final. Where that goes beyond the goal, or the program does not fit its machine, the next one
//! has its turn, and also where a program that had to be made small for its machine is slower
//! than the next one is without a search, and where the next one is nearly as quick without a
//! search: the quicker program of both is taken. One whose program is half as large again as what
//! the machine has for it in any mode is left out, unless nothing else is within the goal. Where
//! one does not fit in the end, larger ones are not tried, but for the machine's first format;
//! where two do not, nothing but the smallest is.
//!
//! The whole picture is looked at, whatever rows are asked for: a format is chosen for a scene.
//! Where its pixels take more work than is worth it, nothing is known, and the machine's first
//! format is taken.
//!
//! Formats of few bits are looked at first. Where the quickest of those is within the goal, and
//! no slower than fixed point in 16 bits, the wider ones are not: they take longer. Formats that are
//! exact and slow ([`Target::last`]) are looked at where no other may keep the goal, or three that
//! might have kept it do not. Where the quickest is one of long numbers, some of them may be short
//! in the end.

mod candidates;
mod mixed;
mod said;
mod tabulated;

use crate::estimate;
use crate::failure::{Failure, Outcome};
use crate::interrupt;
use crate::need::Need;
use crate::scene::Scene;
use crate::target_args::ScreenArgs;
use candidates::{
    Candidate, candidates, expected, is_finer, is_log, is_short, least_of_wider, sort,
};
use said::Others;
pub use said::Why;
use slowlight_compiler::passes::simplify::function_tables::has_periods_in_open_loops;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::{Target, formats};
use slowlight_routine::{Format, Op, Runtime};
use tabulated::Fewer;

/// How many formats are planned in earnest.
const TRIES: usize = 4;

/// The last two are the quickest with at most such a part of the pixels wrong that may be, the
/// very last the one with fewest if there is none.
const SURE: [f64; 2] = [0.5, 0.25];

/// How far off a format may look, in parts of the goal, and what part of an exact one's time it
/// takes, for it to be tried before that.
const NEARLY: f64 = 4.0;
const SOONER: f64 = 0.7;

/// A plan, and what is known of its format.
pub struct Chosen {
    /// In the format that was chosen, or asked for.
    pub plan: PlannedScene,
    /// Why that one; nothing where it was asked for, or there is one only.
    pub why: Option<Why>,
    /// The part of the pixels that are expected to be wrong by tables of functions, where its
    /// format is exact but for these.
    pub tabled: Option<f64>,
}

/// Where a BASIC program begins that has a disc system's memory.
const BELOW_DISC: &str = "it begins at PAGE &E00 and has the disc system's memory: its disc moves \
                          it there (--page 1900 makes a slower one that begins there)";

impl Chosen {
    /// The plan; why it is in its format is said on standard error.
    pub fn said(self) -> PlannedScene {
        if let Some(why) = self.why {
            eprintln!("note: {}", why.text(&self.plan));
        }
        if let Some(wrong) = self.tabled {
            eprintln!("note: {}", tabulated::text(wrong));
        }
        if self.plan.moved {
            eprintln!("note: {BELOW_DISC}");
        }
        self.plan
    }
}

/// A plan within the goal: the cycles of its program, and of that without a search.
#[derive(Clone, Copy)]
struct Kept {
    cycles: f64,
    unsearched: f64,
}

impl Kept {
    /// Whether another format's program may be quicker. It may be so already without a search
    /// where this one had to be made small.
    fn may_lose(&self, to: &Candidate, goal: f64) -> bool {
        to.may(goal) && (to.cycles < self.cycles || to.is_close(self.unsearched))
    }
}

/// Plans a scene in the format that is asked for, or else in the quickest within the goal; where
/// no format is, in that with fewest pixels wrong.
///
/// # Errors
/// As for [`ScreenArgs::plan`].
pub fn plan(screen: &ScreenArgs, scene: &Scene, target: &'static Target) -> Outcome<Chosen> {
    let chosen = match screen.format.is_some() || formats(target).count() < 2 {
        true => None,
        false => quickest(screen, scene, target)?,
    };
    match chosen {
        Some(chosen) => mixed::mixed(screen, scene, chosen),
        None => {
            let plan = screen.plan(scene, target, &[])?;
            let cut = plan.runtime.real == Format::Float316 { rounded: false };
            if cut && screen.format.is_some() {
                say_cut(plan.target);
            }
            let asked = screen.format.is_some() || screen.tables.is_some();
            let (plan, tabled) = match asked {
                true => (plan, None),
                false => tabulated::within_goal(screen, scene, plan)?,
            };
            Ok(Chosen {
                plan,
                why: None,
                tabled,
            })
        }
    }
}

/// Says how much further products of cut floats are off than those of rounded ones; who asks
/// for the original's numbers may want just that.
fn say_cut(target: &Target) {
    let rounded = |t: &&Target| t.runtime.real == (Format::Float316 { rounded: true });
    let Some(rounded) = formats(target).find(rounded) else {
        return;
    };
    let off = |runtime: &Runtime| {
        let products = runtime.routines.iter().filter(|r| r.op == Op::Mul);
        products.fold(0.0, |most, r| r.error.most(&[], 1.0).max(most))
    };
    eprintln!(
        "note: f316 leaves the lowest part of each product out, as the original ray marcher does: \
         up to {:.1} times as far off as {}, which rounds (`check` has bounds)",
        off(target.runtime) / off(rounded.runtime),
        rounded.runtime.format,
    );
}

/// What is tried before an exact format: a wide one, much quicker, that is not far off. Where
/// values' points were found by few pixels, it may be better than it looks.
fn sooner(known: &[Candidate], next: usize, goal: f64) -> Option<usize> {
    let exact = known.get(next).filter(|one| one.target.last)?;
    let fits = |one: &Candidate| {
        let wide = !one.target.last && !is_short(one.target.runtime.real);
        wide && one.wrong <= NEARLY * goal && one.cycles <= SOONER * exact.cycles
    };
    let all = known.iter().enumerate().filter(|(_, one)| fits(one));
    let best = all.min_by(|(_, a), (_, b)| a.wrong.total_cmp(&b.wrong));
    best.map(|(k, _)| k)
}

/// The quickest within the goal, or the nearest to it; none where nothing is known.
fn quickest(
    screen: &ScreenArgs,
    scene: &Scene,
    target: &'static Target,
) -> Outcome<Option<Chosen>> {
    let goal = screen.error_goal();
    // Where values have two widths, which of them are narrow is found by a search of its own
    // ([`mixed`]).
    let one_width = |t: &&Target| t.runtime.narrow.is_none();
    let all = formats(target).filter(one_width);
    let (mut last, all): (Vec<&'static Target>, Vec<_>) = all.partition(|t| t.last);
    let (short, mut long): (Vec<&'static Target>, Vec<_>) =
        all.into_iter().partition(|t| is_short(t.runtime.real));
    let (mut finer, short): (Vec<&'static Target>, Vec<_>) =
        short.into_iter().partition(|t| is_finer(t.runtime.real));
    // Those whose programs are too large, as far as nobody looked closer.
    let mut left: Vec<Candidate> = Vec::new();
    let mut others = Others::default();
    let mut known = candidates(screen, scene, &short, goal, &mut left);
    // Within the goal the quickest, else the nearest to it.
    let mut best: Option<(Chosen, f64)> = None;
    let mut kept: Option<Kept> = None;
    let (mut tries, mut too_large) = (0, 0);
    let is_first = |one: &Candidate| one.target.runtime.format == target.runtime.format;
    loop {
        interrupt::check()?;
        // Logarithms with a bit more are only looked for where those without are quick and wrong.
        let worth = |first: &Candidate| {
            let (far, none) = (!first.may(goal), tries > 0);
            let sooner = |one: &Candidate| is_log(one) && (far || one.cycles < first.cycles);
            none || known.iter().any(sooner)
        };
        let more = kept.is_none() && tries < TRIES;
        if more && !finer.is_empty() && known.first().is_some_and(worth) {
            let more = std::mem::take(&mut finer);
            known.extend(candidates(screen, scene, &more, goal, &mut left));
            sort(&mut known, goal);
        }
        let enough =
            |one: &Candidate| tries == 0 && one.may(goal) && one.cycles <= least_of_wider(&known);
        if more && !long.is_empty() && !known.first().is_some_and(enough) {
            let more = std::mem::take(&mut long);
            known.extend(candidates(screen, scene, &more, goal, &mut left));
            sort(&mut known, goal);
        }
        // The exact ones are looked at where no other may be within the goal, or three that might
        // have been are not.
        let none = !known.iter().any(|one| one.may(goal)) || tries + 1 == TRIES;
        let some = tries > 0 || !known.is_empty();
        if kept.is_none() && tries < TRIES && !last.is_empty() && some && none {
            let more = std::mem::take(&mut last);
            known.extend(candidates(screen, scene, &more, goal, &mut left));
            sort(&mut known, goal);
        }
        if tries == TRIES || known.is_empty() {
            // Where all that is within the goal is too large at first sight, one is looked at
            // closer: written smaller, if slower, it may fit.
            left.sort_by_key(Candidate::order);
            if kept.is_some() || too_large > 0 || left.is_empty() {
                break;
            }
            (known, tries) = (vec![left.remove(0)], TRIES - 1);
        }
        let next = match tries + 2 < TRIES || kept.is_some() {
            true => 0,
            false => {
                let part = SURE[usize::from(tries + 1 == TRIES)];
                let sure = |one: &Candidate| one.wrong <= part * goal;
                let all = known.iter().map(|one| one.wrong).enumerate();
                let surest = all.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(k, _)| k);
                known.iter().position(sure).or(surest).unwrap_or(0)
            }
        };
        let next = match tries + 1 < TRIES {
            true => sooner(&known, next, goal).unwrap_or(next),
            false => next,
        };
        if next >= known.len() {
            break;
        }
        let candidate = known.remove(next);
        if kept.is_some_and(|kept| !kept.may_lose(&candidate, goal)) {
            break;
        }
        tries += 1;
        let format = screen.in_format_of(candidate.target);
        let plan = match format.plan(scene, target, &[]) {
            Err(Failure::TooLarge(large)) => {
                others.does_not_fit(candidate.target.runtime.format, &large.least);
                too_large += 1;
                let larger = |one: &mut Candidate| one.size() >= candidate.size() && !is_first(one);
                left.extend(known.extract_if(.., larger));
                // To find that out takes longest: after two nothing but the smallest is tried.
                if too_large > 1 {
                    if too_large > 2 || best.is_some() {
                        break;
                    }
                    left.append(&mut known);
                    left.sort_by_key(Candidate::order);
                    let smaller = |one: &mut Candidate| one.size() < candidate.size();
                    known = left.extract_if(.., smaller).take(1).collect();
                    tries = TRIES - 1;
                    (finer, long, last) = (Vec::new(), Vec::new(), Vec::new());
                }
                continue;
            }
            Err(Failure::Scene(_)) => continue,
            plan => plan?,
        };
        let seen = |plan: &PlannedScene| {
            let mut whole = plan.clone();
            whole.rows = candidate.rows;
            // Where too little of it was seen, as the plan without a search has it.
            let wrong = (candidate.wrong, candidate.wrong);
            let share = expected(scene, &whole, goal);
            let (expected, most) = share.map_or(wrong, |share| (share.expected, share.most));
            (whole, expected, most <= goal)
        };
        let mut plan = plan;
        let (mut whole, mut expected, mut within) = seen(&plan);
        // Functions in tables are not as exact as the format is.
        let mut slower = false;
        let mut fewer = Fewer::new(&format, scene, target);
        let mut last = plan.clone();
        while (!within || has_periods_in_open_loops(&last.graph))
            && let Some(other) = fewer.after(&last)?
        {
            let looked = seen(&other);
            let better = match (within, looked.2) {
                (true, true) => estimate::cycles(&looked.0) < estimate::cycles(&whole),
                (false, false) => looked.1 < expected,
                (_, other) => other,
            };
            if better {
                slower |= !within;
                ((whole, expected, within), plan) = (looked, other.clone());
            }
            last = other;
        }
        others.seen.push(candidate.seen(expected));
        let why = |expected| Why {
            goal,
            expected,
            unsearched: match candidate.cycles.is_finite() {
                true => candidate.cycles,
                false => estimate::cycles(&whole),
            },
            others: Others::default(),
        };
        let close = |next: &Candidate| next.may(goal) && next.is_close(candidate.cycles);
        let quicker = |next: &Candidate| next.may(goal) && slower;
        let first = known.first();
        let sure = !plan.is_made_small() && !first.is_some_and(|next| close(next) || quicker(next));
        if within && kept.is_none() && sure {
            others.seen.extend(drafted(&known));
            let why = Some(Why {
                others,
                ..why(expected)
            });
            return Ok(Some(Chosen {
                plan,
                why,
                tabled: None,
            }));
        }
        let now = Kept {
            cycles: match within {
                true => estimate::cycles(&whole),
                false => f64::INFINITY,
            },
            unsearched: candidate.cycles,
        };
        let better = match (kept, within) {
            (None, true) => true,
            (Some(kept), true) => now.cycles < kept.cycles,
            (Some(_), false) => false,
            (None, false) => best.as_ref().is_none_or(|(_, least)| expected < *least),
        };
        if better {
            let why = Some(why(expected));
            best = Some((
                Chosen {
                    plan,
                    why,
                    tabled: None,
                },
                expected,
            ));
            kept = within.then_some(now).or(kept);
        }
    }
    others.seen.extend(drafted(&known));
    for one in &left {
        let need = one.need.as_ref().filter(|need| !need.fits());
        let tries = one.target.runtime.format;
        let at_sight = |need: &Need| {
            format!(
                "{} at first sight (--format {tries} looks closer)",
                need.short()
            )
        };
        let text = need.map(at_sight);
        others
            .large
            .extend(text.map(|text| (one.target.runtime.format, text)));
    }
    Ok(best.map(|(mut chosen, _)| {
        if let Some(why) = &mut chosen.why {
            why.others = others;
        }
        chosen
    }))
}

/// What is known of candidates that were not planned in earnest.
fn drafted(known: &[Candidate]) -> impl Iterator<Item = (&'static str, f64, f64)> {
    let drafted = known.iter().filter(|one| one.cycles.is_finite());
    drafted.map(|one| one.seen(one.wrong))
}
