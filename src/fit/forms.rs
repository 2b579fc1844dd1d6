//! Ways to write a plan of one mode so that its program fits: with less memory spent on speed,
//! with calls of what is done seldom, without remarks, short.

use super::{LADDER, Search, is_basic, remarks, with_disc};
use crate::estimate;
use crate::failure::Outcome;
use crate::need::{Need, first};
use rayon::prelude::*;
use slowlight_compiler::plan::Copies;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::planner::{Candidate, SEARCH};
use slowlight_compiler::targets::Lean;
use slowlight_routine::Format;

/// To find what a plan has several times takes so small a part of what it took to find the plan.
const OUTLINING: u64 = 8;

/// How often it is tried, the last time with all of it.
const OUTLINED: u32 = 5;

/// Plans that take so many times as much as one that does not fit may be slower than that is with
/// subroutines.
const SLOWER: f64 = 1.15;

/// A plan that fits, or how large its smallest program is.
pub(super) enum Fitted {
    Fits(Box<PlannedScene>),
    TooLarge(Box<PlannedScene>, Need),
}

impl Fitted {
    /// The same where another of the programs that are too large takes so much.
    pub(super) fn or_less(self, other: Option<Need>) -> Fitted {
        match self {
            Fitted::TooLarge(plan, need) => Fitted::TooLarge(plan, need.or_less(other)),
            fits => fits,
        }
    }
}

impl From<PlannedScene> for Fitted {
    fn from(plan: PlannedScene) -> Fitted {
        Fitted::Fits(Box::new(plan))
    }
}

impl Search<'_> {
    /// The plan that spends hardly any memory on speed; and the quickest of those that spend less
    /// that fits as it is, or with subroutines for what is done seldom: what is written short is
    /// slower. A step that spends less need not be slower: what it leaves out may make room for
    /// more. So where the last of them fits, all are looked at that may be quicker.
    pub(super) fn quickest(
        &self,
        plan: &PlannedScene,
    ) -> Outcome<(Option<PlannedScene>, Option<PlannedScene>)> {
        let last = plan.thrifts().saturating_sub(1);
        if self.fuel.spent() || !plan.may_be_smaller() {
            return Ok((None, None));
        }
        let Some(least) = plan.allowed(self.allowance(2)).thriftier(last) else {
            return Ok((None, None));
        };
        self.fuel.burn(least.work());
        let most = least.cycles_a_pixel();
        let Some(least) = plan.completed(least) else {
            return Ok((None, None));
        };
        let Ok(mut found) = self.with_calls_where_seldom(&least)? else {
            return Ok((Some(least), None));
        };
        let mut quicker = self.thriftier(plan, last);
        quicker.sort_by(|a, b| a.cycles_a_pixel().total_cmp(&b.cycles_a_pixel()));
        quicker.dedup_by(|a, b| a.is(b));
        for tried in quicker {
            if tried.cycles_a_pixel() >= most || self.fuel.spent() {
                break;
            }
            let Some(tried) = plan.completed(tried) else {
                continue;
            };
            if let Ok(fits) = self.with_calls_where_seldom(&tried)? {
                found = fits;
                break;
            }
        }
        Ok((Some(least), Some(found)))
    }

    /// The plan with subroutines for what it has several times, as far as that is needed for its
    /// program to fit; none where it does not in any case.
    pub(super) fn outlined_to_fit(&self, plan: &PlannedScene) -> Outcome<Option<PlannedScene>> {
        let mut plan = plan.clone();
        plan.lean |= plan.target.lean == Lean::Calls;
        let need = self.about(&plan)?;
        let Some(need) = need.filter(|need| !need.is_beyond_calls()) else {
            return Ok(None);
        };
        let total = |plan: &PlannedScene| -> Outcome<u64> {
            Ok(first(plan)?.map_or(0, |need| need.total()))
        };
        // Statements stand in another order, which is not as short.
        let Ok(whole) = plan.outlined_until(0, self.name) else {
            return Ok(None);
        };
        let written = total(&whole)?;
        let excess = need.excess() + written.saturating_sub(total(&plan)?);
        let (mut enough, mut before) = (excess / 2, None);
        for left in (0..OUTLINED).rev() {
            if self.fuel.spent() {
                break;
            }
            let Ok(tried) = plan.outlined_until(enough, self.name) else {
                break;
            };
            self.fuel.burn(plan.work() / OUTLINING);
            if self.holds(&tried)? {
                return Ok(Some(tried));
            }
            // What statements take is known about: it is told by what they took.
            let saved = written.saturating_sub(total(&tried)?);
            // All is called already: no more is spared, though far more is asked for.
            if before.replace(saved) == Some(saved) && enough > 2 * saved {
                break;
            }
            let by = 1.05 * excess as f64 / saved.max(1) as f64;
            enough = match left {
                0 | 1 => u64::MAX,
                _ => (enough as f64 * by.clamp(1.2, 3.0)) as u64,
            };
        }
        Ok(None)
    }

    /// A plan that fits, or another of the same scene with subroutines, where that is quicker.
    pub(super) fn or_outlined(
        &self,
        plan: &PlannedScene,
        fits: PlannedScene,
    ) -> Outcome<PlannedScene> {
        let cycles = estimate::cycles_roughly(&fits);
        if self.fuel.spent() || cycles < SLOWER * estimate::cycles_roughly(plan) {
            return Ok(fits);
        }
        let outlined = self.outlined_to_fit(plan)?;
        let quicker = outlined.filter(|outlined| estimate::cycles_roughly(outlined) < cycles);
        Ok(quicker.unwrap_or(fits))
    }

    /// What the plan is by the steps before the last that spend less memory, in their order:
    /// by as many of them as there is fuel for.
    fn thriftier(&self, plan: &PlannedScene, last: usize) -> Vec<Candidate> {
        let each = plan.work().max(1);
        let count = ((LADDER / each) as usize).min(last.saturating_sub(1));
        let every = last.saturating_sub(1).div_ceil(count.max(1));
        let from = plan.allowed(SEARCH.min(LADDER / count.max(1) as u64));
        let steps: Vec<usize> = (1..last).step_by(every.max(1)).take(count).collect();
        let made = steps.into_par_iter().map(|step| from.thriftier(step));
        made.collect::<Vec<_>>().into_iter().flatten().collect()
    }

    /// The plan, with as much of what stands behind several ways written on each of them as
    /// fits; rather tests than remarks. For the 6502 that is what pixels call, written in place:
    /// where the program leaves a disc system its memory, no more than that leaves.
    pub(super) fn with_copies(&self, plan: PlannedScene) -> Outcome<PlannedScene> {
        if self.fuel.spent() {
            return Ok(plan);
        }
        let page = with_disc(plan.clone())?.page;
        let brief = plan.brief;
        let ways: &[_] = match plan.runtime.real {
            _ if is_basic(&plan) => &[
                (Copies::Ends, brief),
                (Copies::Tests, brief),
                (Copies::Tests, true),
            ],
            Format::Log { .. } => &[
                (Copies::Tables, brief),
                (Copies::Loops, brief),
                (Copies::Ends, brief),
            ],
            _ => &[(Copies::Ends, brief)],
        };
        for (copies, brief) in ways.iter().copied() {
            let mut tried = plan.clone();
            (tried.copies, tried.brief, tried.page) = (copies, brief, page);
            if self.holds(&tried)? {
                tried.page = plan.page;
                return Ok(tried);
            }
        }
        Ok(plan)
    }

    /// A plan that fits as it is, or else with subroutines for what is done seldom; each
    /// without remarks where they are too much. Where none fits, what the least takes, as far as
    /// there was fuel to look.
    pub(super) fn with_calls_where_seldom(
        &self,
        plan: &PlannedScene,
    ) -> Outcome<Result<PlannedScene, Option<Need>>> {
        let calls = |runs| plan.outlined_where_seldom(runs, self.name);
        let remarks = remarks(plan);
        let (Some(first), Some(last), false) = (remarks.first(), remarks.last(), self.fuel.spent())
        else {
            return Ok(Err(None));
        };
        let mut least: Option<Need> = None;
        // What it takes where that is too much.
        let mut excess = |plan: &mut PlannedScene, (brief, scant)| -> Outcome<Option<Need>> {
            (plan.brief, plan.scant) = (brief, scant);
            let need = self.about(plan)?.filter(|need| !need.fits());
            if let Some(need) = &need
                && least.as_ref().is_none_or(|l| need.total() < l.total())
            {
                least = Some(need.clone());
            }
            Ok(need)
        };
        let mut as_is = plan.clone();
        match excess(&mut as_is, *first)? {
            None => return Ok(Ok(as_is)),
            // What is done seldom is not half of a program.
            Some(need) if need.exceeds(1) => return Ok(Err(least)),
            Some(_) => {}
        }
        // What is too much in the shortest way is too much in those before it.
        let mut ways = vec![as_is];
        ways.extend([false, true].into_iter().filter_map(calls));
        if let Some(shortest) = ways.last_mut()
            && excess(shortest, *last)?.is_some()
        {
            return Ok(Err(least));
        }
        for mut tried in ways {
            if self.fuel.spent() || excess(&mut tried, *last)?.is_some() {
                continue;
            }
            for style in remarks {
                if excess(&mut tried, *style)?.is_none() {
                    return Ok(Ok(tried));
                }
            }
        }
        Ok(Err(least))
    }

    /// Whether the machine holds a plan's program.
    pub(super) fn holds(&self, plan: &PlannedScene) -> Outcome<bool> {
        Ok(self.about(plan)?.is_none_or(|need| need.fits()))
    }

    pub(super) fn as_is_or_tight(&self, mut plan: PlannedScene) -> Outcome<Fitted> {
        let mut least: Option<Need> = None;
        let styles = [(false, false), (true, false), (true, true)];
        // What is to be read stays so, rather slower, while it can be smaller.
        let count = if plan.listing && plan.may_be_smaller() {
            1
        } else {
            3
        };
        for (lean, tight) in styles.into_iter().take(count) {
            let of = plan.target.lean;
            // Machine code is the same in two of them; what is too large without calls stays so.
            if !tight && (lean && of == Lean::Nothing || !lean && of == Lean::Calls) {
                continue;
            }
            // The last is the smallest.
            if count == 3 && !tight && self.fuel.spent() {
                continue;
            }
            (plan.lean, plan.tight) = (lean, tight);
            let near = match self.about(&plan)? {
                Some(need) if !need.fits() => {
                    let near = need.is_near();
                    if least.as_ref().is_none_or(|l| need.total() < l.total()) {
                        least = Some(need);
                    }
                    near
                }
                _ => return Ok(Fitted::Fits(Box::new(plan))),
            };
            // Steps take a few bytes; to write it short costs more than they save.
            let unstepped = |plan: &PlannedScene| self.again(plan, PlannedScene::unstepped);
            let mut less = (near && !lean).then(|| unstepped(&plan)).flatten();
            while let Some(plain) = less {
                if self.holds(&plain)? {
                    return Ok(Fitted::Fits(Box::new(plain)));
                }
                less = unstepped(&plain);
            }
        }
        Ok(match least {
            Some(need) => Fitted::TooLarge(Box::new(plan), need),
            None => Fitted::Fits(Box::new(plan)),
        })
    }
}
