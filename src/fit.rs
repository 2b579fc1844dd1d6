//! Fit: a plan whose program the machine can hold, or how far that is from it.
//!
//! A program that does not fit as it reads best is tried once more, written as
//! tight as the target can; without `--mode`, the next mode is tried after that.
//! Where no mode that shows the whole picture holds it either way, they are tried
//! with subroutines for what the program has several times: slower, and much
//! smaller. Then come the modes that show a part of it, in the same way.

use crate::failure::{Failure, Outcome};
use crate::machine::Machine;
use crate::need::{Need, need, need_beside};
use crate::trial::build_for;
use rayon::prelude::*;
use slowlight_compiler::flow::graph::Table;
use slowlight_compiler::plan::{Copies, Plan};
use slowlight_compiler::source::Span;
use slowlight_compiler::target::mos6502::DISC_PAGE;
use std::ops::Range;

/// The first of the plans whose program fits, as it reads best or tight; where
/// none does, the first that does with subroutines. Modes that show a part of the
/// picture only come after all that is tried for those that show the whole.
/// `name` says what the scene calls what stands at a place of it.
///
/// # Errors
/// Where none does: how far each is from it, and what would help.
pub fn fit(
    plans: impl IntoIterator<Item = Outcome<Plan>>,
    name: &dyn Fn(Span) -> Option<String>,
) -> Outcome<Plan> {
    let mut large: Vec<(Plan, Need)> = Vec::new();
    let mut tried = None;
    for plan in plans {
        let plan = plan?;
        if tried.is_none() && crops(&plan) {
            if let Some(fits) = outlined(&mut large, name)? {
                return Ok(fits);
            }
            tried = Some(large.len());
        }
        if let Some(fits) = quickest(&plan, name)? {
            return with_copies(fits);
        }
        // None of these fits as it is.
        let least = plan.thriftier(plan.thrifts().saturating_sub(1));
        let mut found = as_is_or_tight(least.unwrap_or(plan))?;
        // Rather slower than with fewer inks.
        while let Fitted::TooLarge(plan, _) = &found
            && let Some(smaller) = plan.smaller()
        {
            found = as_is_or_tight(smaller)?;
        }
        match found {
            Fitted::Fits(plan) => return Ok(*plan),
            Fitted::TooLarge(plan, need) => large.push((*plan, need)),
        }
    }
    if let Some(fits) = outlined(&mut large[tried.unwrap_or(0)..], name)? {
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

/// Whether the screen shows a part of the picture only.
fn crops(plan: &Plan) -> bool {
    let (width, height) = plan.graph.image.on_screen();
    plan.mode.width < width || plan.mode.height < height
}

/// The first of the plans that fits with subroutines; where none does, what each
/// takes at least is noted.
fn outlined(
    large: &mut [(Plan, Need)],
    name: &dyn Fn(Span) -> Option<String>,
) -> Outcome<Option<Plan>> {
    for (plan, least) in large {
        // A fault of the plan with subroutines would be one of the plan without.
        let Ok(outlined) = plan.outlined(name) else {
            continue;
        };
        match as_is_or_tight(outlined)? {
            Fitted::Fits(plan) => return Ok(Some(*plan)),
            Fitted::TooLarge(_, need) if need.total() < least.total() => *least = need,
            Fitted::TooLarge(..) => {}
        }
    }
    Ok(None)
}

/// A plan that fits, or how large its smallest program is.
enum Fitted {
    Fits(Box<Plan>),
    TooLarge(Box<Plan>, Need),
}

/// The plan, or the quickest of those that spend less memory on speed that fits as
/// it is, or with subroutines for what is done seldom: what is written short is slower.
/// A step that spends less need not be slower: what it leaves out may make room for
/// more. So where one of them fits, all are looked at that may be quicker.
fn quickest(plan: &Plan, name: &dyn Fn(Span) -> Option<String>) -> Outcome<Option<Plan>> {
    if let Some(fits) = with_calls_where_seldom(plan, name)? {
        return Ok(Some(fits));
    }
    let last = plan.thrifts().saturating_sub(1);
    let thriftier = |step| plan.thriftier(step);
    let Some(least) = thriftier(last) else {
        return Ok(None);
    };
    let Some(mut found) = with_calls_where_seldom(&least, name)? else {
        return Ok(None);
    };
    let mut plans: Vec<(f64, Plan)> = thriftier_plans(plan, 1..last)
        .into_iter()
        .map(|plan| (plan.cycles_a_pixel(), plan))
        .collect();
    plans.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    plans.dedup_by(|(_, a), (_, b)| a.graph == b.graph);
    let most = least.cycles_a_pixel();
    for (cycles, plan) in plans {
        if cycles >= most {
            break;
        }
        if let Some(fits) = with_calls_where_seldom(&plan, name)? {
            found = fits;
            break;
        }
    }
    Ok(Some(found))
}

/// What the plan is by some steps that spend less memory, in their order. Which steps say
/// nothing new is known once the others are planned.
fn thriftier_plans(plan: &Plan, steps: Range<usize>) -> Vec<Plan> {
    let (later, sooner): (Vec<usize>, Vec<usize>) = steps.partition(|&step| plan.repeats(step));
    let planned = |steps: Vec<usize>| -> Vec<(usize, Plan)> {
        let plans = steps.into_par_iter();
        plans
            .filter_map(|step| Some((step, plan.thriftier(step)?)))
            .collect()
    };
    let mut all = planned(sooner);
    all.extend(planned(later));
    all.sort_by_key(|(step, _)| *step);
    all.into_iter().map(|(_, plan)| plan).collect()
}

/// The plan, with as much of what stands behind several ways written on each of them as
/// fits; rather tests than remarks. For the 6502 that is what pixels call, written in place:
/// where the program leaves a disc system its memory, no more than that leaves.
fn with_copies(plan: Plan) -> Outcome<Plan> {
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
        if need(&tried)?.is_none_or(|need| need.fits()) {
            tried.page = plan.page;
            return Ok(tried);
        }
    }
    Ok(plan)
}

/// A plan that fits as it is, or else with subroutines for what is done seldom; each
/// without remarks where they are too much.
fn with_calls_where_seldom(
    plan: &Plan,
    name: &dyn Fn(Span) -> Option<String>,
) -> Outcome<Option<Plan>> {
    let calls = |runs| plan.outlined_where_seldom(runs, name);
    let ways: [&dyn Fn() -> Option<Plan>; 3] =
        [&|| Some(plan.clone()), &|| calls(false), &|| calls(true)];
    for way in ways {
        let Some(mut tried) = way() else {
            continue;
        };
        for (brief, scant) in remarks(plan) {
            (tried.brief, tried.scant) = (*brief, *scant);
            if need(&tried)?.is_none_or(|need| need.fits()) {
                return Ok(Some(tried));
            }
        }
    }
    Ok(None)
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

fn as_is_or_tight(mut plan: Plan) -> Outcome<Fitted> {
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
        (plan.lean, plan.tight) = (lean, tight);
        match need(&plan)? {
            Some(need) if !need.fits() => {
                if least.as_ref().is_none_or(|l| need.total() < l.total()) {
                    least = Some(need);
                }
            }
            _ => return Ok(Fitted::Fits(Box::new(plan))),
        }
        // Steps take a few bytes; to write it short costs more than they save.
        let mut less = if lean { None } else { plan.unstepped() };
        while let Some(plain) = less {
            if need(&plain)?.is_some_and(|need| need.fits()) {
                return Ok(Fitted::Fits(Box::new(plain)));
            }
            less = plain.unstepped();
        }
    }
    Ok(match least {
        Some(need) => Fitted::TooLarge(Box::new(plan), need),
        None => Fitted::Fits(Box::new(plan)),
    })
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

/// A plan whose program fits the ROM of the Hack's processor as well, and its heap beside
/// the operating system's part of it: short, or with subroutines, where it does not
/// without.
///
/// # Errors
/// By how many words it does not, and what would help.
pub fn fit_rom(
    plan: Plan,
    machine: Machine,
    name: &dyn Fn(Span) -> Option<String>,
) -> Outcome<Plan> {
    // The text is ours: its size is all that the machine's tools can refuse.
    let refused = |plan: &Plan| match build_for(plan, machine) {
        Ok(built) => {
            let need = need_beside(plan, &built.loaded.system);
            Ok((!need.fits()).then(|| need.text()))
        }
        Err(Failure::Wrong(said)) => Ok(Some(said)),
        Err(other) => Err(other),
    };
    let mut said = String::new();
    // A fault of the plan with subroutines would be one of the plan without.
    let outlined = || plan.outlined(name).ok();
    let plans = std::iter::once_with(|| Some(plan.clone())).chain(std::iter::once_with(outlined));
    for mut tried in plans.flatten() {
        // Short, it has the routines of the VM: slower ones.
        for lean in [false, true] {
            tried.lean = lean;
            match refused(&tried)? {
                None => return Ok(tried),
                Some(why) => said = why,
            }
        }
    }
    Err(Failure::Wrong(format!(
        "{} does not fit the Hack with its operating system: {said}\n{}; run it on the VM, where \
         code and the system take no memory (--os native)",
        plan.name,
        help(&plan)
    )))
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
