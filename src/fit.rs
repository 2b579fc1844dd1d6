//! Fit: a plan whose program the machine can hold, or how far that is from it.
//!
//! A program that does not fit as it reads best is tried once more, written as
//! tight as the target can; without `--mode`, the next mode is tried after that.
//! Where no mode that shows the whole picture holds it either way, they are tried
//! with subroutines for what the program has several times: slower, and much
//! smaller. Then come the modes that show a part of it, in the same way.

mod rom;

pub use rom::fit_rom;

use crate::failure::{Failure, Outcome};
use crate::need::{Need, about, need};
use rayon::prelude::*;
use slowlight_compiler::flow::graph::Table;
use slowlight_compiler::fuel::Fuel;
use slowlight_compiler::plan::{Copies, Plan, SEARCH};
use slowlight_compiler::source::Span;
use slowlight_compiler::target::Mode;
use slowlight_compiler::target::mos6502::DISC_PAGE;

/// How much work may be done to find a plan whose program fits, in units of
/// [`slowlight_compiler::fuel::Fuel`]: no example is cut short, of which fifty.scn on the 6502
/// takes most.
pub const FIT: u64 = 3_500_000_000;

/// The same for the plans that spend less memory, all together: they are made at the same
/// time, and have much in common that is made once and charged to each.
const LADDER: u64 = 6_000_000_000;

/// The first of the plans whose program fits, as it reads best or tight; where
/// none does, the first that does with subroutines. Modes that show a part of the
/// picture only come after all that is tried for those that show the whole. `plan` makes the
/// plan for a mode with so much fuel to search by; `name` says what the scene calls what
/// stands at a place of it.
///
/// What is tried for a mode costs fuel. Where there is none left, plans are made as they come,
/// and of the ways to make them smaller only the one is tried that makes them smallest.
///
/// # Errors
/// Where none does: how far each is from it, and what would help.
pub fn fit(
    modes: Vec<Mode>,
    plan: &dyn Fn(Mode, u64) -> Outcome<Plan>,
    name: &dyn Fn(Span) -> Option<String>,
) -> Outcome<Plan> {
    let fuel = Fuel::new(FIT);
    let search = Search { fuel: &fuel, name };
    let mut found = search.found(modes, plan)?;
    if fuel.was_cut() {
        found.note_cut();
    }
    Ok(found)
}

/// A search for a plan that fits.
struct Search<'s> {
    fuel: &'s Fuel,
    name: &'s dyn Fn(Span) -> Option<String>,
}

impl Search<'_> {
    fn found(&self, modes: Vec<Mode>, plan: &dyn Fn(Mode, u64) -> Outcome<Plan>) -> Outcome<Plan> {
        let mut large: Vec<(Plan, Need)> = Vec::new();
        let mut tried = None;
        let mut size = None;
        for (k, mode) in modes.iter().copied().enumerate() {
            // Where little can be tried, it is what leaves the program most room: of the modes
            // that show the whole picture the last, and the last of all.
            let whole = |mode: &Mode| {
                size.is_none_or(|(width, height)| mode.width >= width && mode.height >= height)
            };
            let rest = modes.get(k + 1..).unwrap_or_default();
            let is_last = rest.is_empty() || whole(&mode) && !rest.iter().any(whole);
            if k > 0 && !is_last && self.fuel.spent() {
                continue;
            }
            let plan = plan(mode, self.allowance(1))?;
            size = Some(plan.graph.image.on_screen());
            self.fuel.burn(plan.work());
            if tried.is_none() && crops(&plan) {
                if let Some(fits) = self.outlined(&mut large)? {
                    return Ok(fits);
                }
                tried = Some(large.len());
            }
            if let Some(fits) = self.quickest(&plan)? {
                return self.with_copies(fits);
            }
            // None of these fits as it is.
            let last = plan.thrifts().saturating_sub(1);
            let mut found =
                self.as_is_or_tight(self.again(&plan, |p| p.thriftier(last)).unwrap_or(plan))?;
            // Rather slower than with fewer inks.
            while let Fitted::TooLarge(plan, _) = &found
                && let Some(smaller) = self.again(plan, Plan::smaller)
            {
                found = self.as_is_or_tight(smaller)?;
            }
            match found {
                Fitted::Fits(plan) => return Ok(*plan),
                Fitted::TooLarge(plan, need) => large.push((*plan, need)),
            }
        }
        if let Some(fits) = self.outlined(&mut large[tried.unwrap_or(0)..])? {
            return Ok(fits);
        }
        let mut said = String::new();
        for (plan, least) in &large {
            let mode = match plan.mode.name {
                "" => String::new(),
                name => format!("mode {name}: "),
            };
            said.push_str(&format!("\n  {mode}{}", least.text()));
        }
        let Some((plan, _)) = large.last() else {
            return Err(Failure::Wrong("there is no mode to draw in".to_owned()));
        };
        Err(Failure::Wrong(format!(
            "{} does not fit {}:{said}\n{}",
            plan.name,
            plan.target.name,
            help(plan)
        )))
    }

    /// How much fuel a search for a plan may have that is one of so many.
    fn allowance(&self, of: u64) -> u64 {
        SEARCH.min(self.fuel.left() / of)
    }

    /// Another plan of the scene, by what fuel is left; none where there is none.
    fn again(&self, plan: &Plan, make: impl FnOnce(&Plan) -> Option<Plan>) -> Option<Plan> {
        if self.fuel.spent() {
            return None;
        }
        let mut plan = plan.clone();
        plan.allow(self.allowance(2));
        let made = make(&plan)?;
        self.fuel.burn(made.work());
        Some(made)
    }

    /// The first of the plans that fits with subroutines; where none does, what each
    /// takes at least is noted.
    fn outlined(&self, large: &mut [(Plan, Need)]) -> Outcome<Option<Plan>> {
        for (plan, least) in large {
            // A fault of the plan with subroutines would be one of the plan without.
            let Ok(outlined) = plan.outlined(self.name) else {
                continue;
            };
            match self.as_is_or_tight(outlined)? {
                Fitted::Fits(plan) => return Ok(Some(*plan)),
                Fitted::TooLarge(_, need) if need.total() < least.total() => *least = need,
                Fitted::TooLarge(..) => {}
            }
        }
        Ok(None)
    }

    /// The plan, or the quickest of those that spend less memory on speed that fits as
    /// it is, or with subroutines for what is done seldom: what is written short is slower.
    /// A step that spends less need not be slower: what it leaves out may make room for
    /// more. So where one of them fits, all are looked at that may be quicker.
    fn quickest(&self, plan: &Plan) -> Outcome<Option<Plan>> {
        if let Some(fits) = self.with_calls_where_seldom(plan)? {
            return Ok(Some(fits));
        }
        let last = plan.thrifts().saturating_sub(1);
        let Some(least) = self.again(plan, |plan| plan.thriftier(last)) else {
            return Ok(None);
        };
        let Some(mut found) = self.with_calls_where_seldom(&least)? else {
            return Ok(None);
        };
        let mut plans: Vec<(f64, Plan)> = (self.thriftier_plans(plan, last))
            .into_iter()
            .map(|plan| (plan.cycles_a_pixel(), plan))
            .collect();
        plans.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        plans.dedup_by(|(_, a), (_, b)| a.graph == b.graph);
        let most = least.cycles_a_pixel();
        for (cycles, plan) in plans {
            if cycles >= most || self.fuel.spent() {
                break;
            }
            if let Some(fits) = self.with_calls_where_seldom(&plan)? {
                found = fits;
                break;
            }
        }
        Ok(Some(found))
    }

    /// What the plan is by the steps before the last that spend less memory, in their order:
    /// by as many of them as there is fuel for. Which steps say nothing new is known once the
    /// others are planned.
    fn thriftier_plans(&self, plan: &Plan, last: usize) -> Vec<Plan> {
        let each = plan.work().max(1);
        let count = ((LADDER / each) as usize).min(last.saturating_sub(1));
        let (every, mut from) = (last.saturating_sub(1).div_ceil(count.max(1)), plan.clone());
        from.allow(SEARCH.min(LADDER / count.max(1) as u64));
        let steps = (1..last).step_by(every.max(1)).take(count);
        let (later, sooner): (Vec<usize>, Vec<usize>) = steps.partition(|&step| plan.repeats(step));
        let planned = |steps: Vec<usize>| -> Vec<(usize, Plan)> {
            let plans = steps.into_par_iter();
            plans
                .filter_map(|step| Some((step, from.thriftier(step)?)))
                .collect()
        };
        let mut all = planned(sooner);
        all.extend(planned(later));
        all.sort_by_key(|(step, _)| *step);
        if count < last.saturating_sub(1) {
            self.fuel.note_cut();
        }
        all.into_iter().map(|(_, plan)| plan).collect()
    }

    /// The plan, with as much of what stands behind several ways written on each of them as
    /// fits; rather tests than remarks. For the 6502 that is what pixels call, written in place:
    /// where the program leaves a disc system its memory, no more than that leaves.
    fn with_copies(&self, plan: Plan) -> Outcome<Plan> {
        if self.fuel.spent() {
            return Ok(plan);
        }
        let page = with_disc(plan.clone())?.page;
        let ways = [
            (Copies::Ends, plan.brief),
            (Copies::Tests, plan.brief),
            (Copies::Tests, true),
        ];
        let count = if is_basic(&plan) { 3 } else { 2 };
        for (copies, brief) in ways.into_iter().take(count) {
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
    /// without remarks where they are too much.
    fn with_calls_where_seldom(&self, plan: &Plan) -> Outcome<Option<Plan>> {
        let calls = |runs| plan.outlined_where_seldom(runs, self.name);
        let ways: [&dyn Fn() -> Option<Plan>; 3] =
            [&|| Some(plan.clone()), &|| calls(false), &|| calls(true)];
        for way in ways {
            if self.fuel.spent() {
                break;
            }
            let Some(mut tried) = way() else {
                continue;
            };
            for (brief, scant) in remarks(plan) {
                (tried.brief, tried.scant) = (*brief, *scant);
                match about(&tried, self.fuel)? {
                    Some(need) if !need.is_near() => break,
                    Some(need) if !need.fits() => {}
                    _ => return Ok(Some(tried)),
                }
            }
        }
        Ok(None)
    }

    /// Whether the machine holds a plan's program.
    fn holds(&self, plan: &Plan) -> Outcome<bool> {
        Ok(about(plan, self.fuel)?.is_none_or(|need| need.fits()))
    }

    fn as_is_or_tight(&self, mut plan: Plan) -> Outcome<Fitted> {
        let mut least: Option<Need> = None;
        let styles = [(false, false), (true, false), (true, true)];
        // What is to be read stays so, rather slower, while it can be smaller.
        let count = if plan.listing && plan.may_be_smaller() {
            1
        } else {
            3
        };
        for (lean, tight) in styles.into_iter().take(count) {
            // Only Jack and BASIC have a leaner style: machine code is the same in it.
            if lean && !tight && plan.target.name.starts_with("6502") {
                continue;
            }
            // The last is the smallest.
            if count == 3 && !tight && self.fuel.spent() {
                continue;
            }
            (plan.lean, plan.tight) = (lean, tight);
            let near = match about(&plan, self.fuel)? {
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
            let unstepped = |plan: &Plan| self.again(plan, Plan::unstepped);
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

/// Whether the screen shows a part of the picture only.
fn crops(plan: &Plan) -> bool {
    let (width, height) = plan.graph.image.on_screen();
    plan.mode.width < width || plan.mode.height < height
}

/// A plan that fits, or how large its smallest program is.
enum Fitted {
    Fits(Box<Plan>),
    TooLarge(Box<Plan>, Need),
}

/// Ways to write a program: with fewer remarks, and short where that takes longer. Only
/// where the text itself is what the machine holds do they make it smaller.
fn remarks(plan: &Plan) -> &'static [(bool, bool)] {
    match is_basic(plan) {
        true => &[(false, false), (true, false), (true, true)],
        false => &[(false, false)],
    }
}

fn is_basic(plan: &Plan) -> bool {
    plan.target.name.starts_with("bbc")
}

/// A plan whose program leaves the disc system of a BBC Micro its memory, where it may
/// have that and nothing else was asked for.
///
/// # Errors
/// Where the machine's tools refuse the text, which is a fault of ours.
pub fn with_disc(plan: Plan) -> Outcome<Plan> {
    if plan.target.name != "6502:bbc" || plan.page.is_some() {
        return Ok(plan);
    }
    let mut high = plan.clone();
    high.page = Some(DISC_PAGE);
    match need(&high)? {
        Some(need) if !need.fits() => Ok(plan),
        _ => Ok(high),
    }
}

/// What makes a program smaller.
fn help(plan: &Plan) -> String {
    let mut ways = Vec::new();
    let effects: Vec<&str> = plan.graph.effects.iter().map(|e| e.name.as_str()).collect();
    if !effects.is_empty() {
        ways.push(format!(
            "leave an effect out (--without {})",
            effects.join(", ")
        ));
    }
    if !plan.params.is_empty() {
        ways.push("fold the params (--freeze all)".to_owned());
    }
    if plan.graph.diffusion.is_some() {
        ways.push("dither by a matrix, which keeps no rows of errors".to_owned());
    }
    let large = |t: &Table| t.entries.len() > 1000;
    if plan.graph.tables.iter().any(large) {
        ways.push("make tables smaller".to_owned());
    }
    ways.push("draw fewer shapes, or more of one kind: what is alike is written once".to_owned());
    format!("what would help: {}", ways.join("; "))
}
