//! Fit: a plan whose program the machine can hold, or how far that is from it.
//!
//! A program that does not fit as it reads best is tried once more, written as
//! tight as the target can; without `--mode`, the next mode is tried after that.
//! Where no mode that shows the whole picture holds it either way, they are tried
//! with subroutines for what the program has several times: slower, and much
//! smaller. Then come the modes that show a part of it, in the same way.

mod forms;
mod large;
mod rom;

pub use rom::fit_rom;

use crate::failure::{Failure, Outcome};
use crate::need::{Need, about, need};
use forms::Fitted;
pub use large::help;
use large::{Large, beyond_in, too_large};
use slowlight_compiler::backend::mos6502::DISC_PAGE;
use slowlight_compiler::fuel::Fuel;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::planner::SEARCH;
use slowlight_compiler::source::Span;
use slowlight_compiler::targets::{Language, Lean, Mode, System};
use std::cell::{Cell, RefCell};
use std::collections::VecDeque;

/// How much work may be done to find a plan whose program fits, in units of
/// [`slowlight_compiler::fuel::Fuel`]: no example is cut short.
pub const FIT: u64 = 3_500_000_000;

/// The same for the plans that spend less memory, all together: they are made at the same
/// time, and have much in common that is made once and charged to each. The dearer they are,
/// the fewer of the steps are looked at: no search is ended by that.
const LADDER: u64 = 2_000_000_000;

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
    plan: &dyn Fn(Mode, u64) -> Outcome<PlannedScene>,
    name: &dyn Fn(Span) -> Option<String>,
) -> Outcome<PlannedScene> {
    fit_within(modes, plan, name, FIT)
}

/// The same by so much fuel. Where that is less than usual and not enough, the plan was cut.
///
/// # Errors
/// As for [`fit`], and where more fuel might find one.
pub fn fit_within(
    modes: Vec<Mode>,
    plan: &dyn Fn(Mode, u64) -> Outcome<PlannedScene>,
    name: &dyn Fn(Span) -> Option<String>,
    most: u64,
) -> Outcome<PlannedScene> {
    let fuel = Fuel::new(most);
    let search = Search {
        fuel: &fuel,
        name,
        known: RefCell::default(),
        kept: Cell::default(),
    };
    let mut found = match search.found(modes, plan) {
        // With more of it something might have fitted.
        Err(Failure::TooLarge(_)) if most < FIT && fuel.was_cut() => return Err(too_dear()),
        other => other?,
    };
    found.note_burnt(fuel.burnt());
    if fuel.was_cut() {
        found.note_cut();
    }
    Ok(found)
}

/// Why a way among many is left: less work than usual was allowed, and it was not enough. It
/// is no fault of the scene's, for which something else would be tried.
pub const TOO_DEAR: &str = "to plan it takes too long for one way of many (--effort)";

/// The same as a failure.
pub fn too_dear() -> Failure {
    Failure::Usage(TOO_DEAR.to_owned())
}

/// A search for a plan that fits.
struct Search<'s> {
    fuel: &'s Fuel,
    name: &'s dyn Fn(Span) -> Option<String>,
    /// What programs take that were measured last: plans by several ways may be the same.
    known: RefCell<VecDeque<(PlannedScene, Option<Need>)>>,
    /// What part of machine code was left at least where it was read again; 0 where none was.
    kept: Cell<f64>,
}

/// How many of them.
const KNOWN: usize = 8;

/// Makes the plan for a mode with so much fuel.
type Make<'m> = &'m dyn Fn(Mode, u64) -> Outcome<PlannedScene>;

impl Search<'_> {
    fn found(&self, modes: Vec<Mode>, make: Make) -> Outcome<PlannedScene> {
        let mut large: Vec<Large> = Vec::new();
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
            if tried.is_none() && !whole(&mode) {
                if let Some(fits) = self.outlined(&mut large, make)? {
                    return Ok(fits);
                }
                tried = Some(large.len());
            }
            let plain = large.iter().map(|large| &large.plain);
            if let Some(plain) = beyond_in(mode, plain, &large) {
                large.push(Large {
                    mode,
                    quick: None,
                    plan: None,
                    plain,
                    outlined: None,
                });
                continue;
            }
            let plan = make(mode, self.allowance(1))?;
            if size.is_none() {
                size = Some(plan.graph.image.on_screen());
                tried = crops(&plan).then_some(0);
            }
            self.fuel.burn(plan.work());
            match self.fitted(plan.clone())? {
                Fitted::Fits(plan) => return Ok(*plan),
                Fitted::TooLarge(small, need) => large.push(Large {
                    quick: Some(plan),
                    ..Large::new(*small, need)
                }),
            }
        }
        if let Some(fits) = self.outlined(
            large.get_mut(tried.unwrap_or(0)..).unwrap_or_default(),
            make,
        )? {
            return Ok(fits);
        }
        Err(too_large(&large))
    }

    /// A mode's plan, or another of the scene, that fits without subroutines for what is done
    /// at each pixel.
    fn fitted(&self, mut plan: PlannedScene) -> Outcome<Fitted> {
        plan = plan.on_trial();
        // Calls are slower by a few parts in a hundred, a step that spends less memory by more.
        if plan.target.lean == Lean::Calls && !self.holds(&plan)? {
            plan.lean = true;
        }
        let quick = match self.with_calls_where_seldom(&plan)? {
            Ok(fits) => return self.with_copies(self.settled(fits)?).map(Fitted::from),
            Err(need) => need,
        };
        // What is written as the scene has it and short is about as small as it gets.
        let stable = self.again(&plan, PlannedScene::stable);
        if let (Some(stable), Some(quick)) = (&stable, quick.clone())
            && quick.exceeds(2)
        {
            let mut short = stable.clone();
            (short.lean, short.tight) = (true, true);
            if let Some(need) = self.about(&short)?
                && need.exceeds(8)
            {
                return Ok(Fitted::TooLarge(Box::new(short), need.or_less(Some(quick))));
            }
        }
        let (least, quickest) = self.quickest(&plan)?;
        if let Some(fits) = quickest {
            let fits = self.settled(self.or_outlined(&plan, fits)?)?;
            return self.with_copies(fits).map(Fitted::from);
        }
        let small = least.unwrap_or_else(|| plan.clone());
        let found = match (self.as_is_or_tight(small)?.or_less(quick), stable) {
            // Rather slower than with fewer inks.
            (Fitted::TooLarge(_, need), Some(stable)) => {
                self.as_is_or_tight(stable)?.or_less(Some(need))
            }
            (found, _) => found,
        };
        match found {
            Fitted::Fits(fits) => {
                let fits = self.or_outlined(&plan, *fits)?;
                self.settled(fits).map(Fitted::from)
            }
            large => Ok(large),
        }
    }

    /// A plan that fits, off trial, with its points as they are to be run by, if it fits so, too.
    fn settled(&self, plan: PlannedScene) -> Outcome<PlannedScene> {
        if let Some(settled) = plan.settled()
            && about(&settled, self.fuel, &self.kept)?.is_none_or(|need| need.fits())
        {
            return Ok(settled);
        }
        Ok(plan.off_trial())
    }

    /// What a plan's program takes.
    fn about(&self, plan: &PlannedScene) -> Outcome<Option<Need>> {
        let known = |(other, _): &&(PlannedScene, Option<Need>)| plan.is_written_as(other);
        if let Some((_, need)) = self.known.borrow().iter().find(known) {
            return Ok(need.clone());
        }
        // What is found by a plan that was cut hangs on it, wherever it was cut for being one of
        // many.
        if self.fuel.given() < FIT && plan.was_cut() {
            self.fuel.note_cut();
        }
        let need = about(plan, self.fuel, &self.kept)?;
        let mut all = self.known.borrow_mut();
        all.truncate(KNOWN - 1);
        all.push_front((plan.clone(), need.clone()));
        Ok(need)
    }

    /// How much fuel a search for a plan may have that is one of so many.
    fn allowance(&self, of: u64) -> u64 {
        SEARCH.min(self.fuel.left() / of)
    }

    /// Another plan of the scene, by what fuel is left; none where there is none.
    fn again(
        &self,
        plan: &PlannedScene,
        make: impl FnOnce(&PlannedScene) -> Option<PlannedScene>,
    ) -> Option<PlannedScene> {
        if self.fuel.spent() {
            return None;
        }
        let made = make(&plan.allowed(self.allowance(2)))?;
        self.fuel.burn(made.work());
        Some(made)
    }

    /// The first of the modes whose plan fits with subroutines; where none does, what each
    /// takes at least is noted.
    fn outlined(&self, large: &mut [Large], make: Make) -> Outcome<Option<PlannedScene>> {
        for k in 0..large.len() {
            let seen = large.iter().filter_map(|large| large.outlined.as_ref());
            let beyond = large.get(k).and_then(|of| beyond_in(of.mode, seen, large));
            let Some(of) = large.get_mut(k) else {
                break;
            };
            let plan = match (of.plan.take(), beyond) {
                (Some(plan), _) => plan,
                (None, Some(beyond)) => {
                    of.outlined = Some(beyond);
                    continue;
                }
                // Only its formulas as the scene has them are wanted.
                (None, None) => {
                    let plan = make(of.mode, 1)?;
                    self.fuel.burn(plan.work());
                    self.again(&plan, PlannedScene::stable).unwrap_or(plan)
                }
            };
            if let Some(quick) = of.quick.take()
                && let Some(fits) = self.outlined_to_fit(&quick.on_trial())?
            {
                return self.settled(fits).map(Some);
            }
            // A fault of the plan with subroutines would be one of the plan without.
            let outlined = plan.on_trial().outlined(self.name);
            of.plan = Some(plan);
            let Ok(outlined) = outlined else {
                continue;
            };
            match self.as_is_or_tight(outlined)? {
                Fitted::Fits(plan) => return self.settled(*plan).map(Some),
                Fitted::TooLarge(_, need) => of.outlined = Some(need),
            }
        }
        Ok(None)
    }
}

/// Whether the screen shows a part of the picture only.
fn crops(plan: &PlannedScene) -> bool {
    let (width, height) = plan.graph.image.on_screen();
    plan.mode.width < width || plan.mode.height < height
}

/// Ways to write a program: with fewer remarks, and short where that takes longer. Only
/// where the text itself is what the machine holds do they make it smaller.
fn remarks(plan: &PlannedScene) -> &'static [(bool, bool)] {
    match is_basic(plan) {
        true => &[(false, false), (true, false), (true, true)],
        false => &[(false, false)],
    }
}

fn is_basic(plan: &PlannedScene) -> bool {
    plan.target.system.language() == Language::Basic
}

/// A plan whose program leaves the disc system of a BBC Micro its memory, where it may
/// have that and nothing else was asked for.
///
/// # Errors
/// Where the machine's tools refuse the text, which is a fault of ours.
pub fn with_disc(plan: PlannedScene) -> Outcome<PlannedScene> {
    if plan.target.system != System::BbcCode || plan.page.is_some() {
        return Ok(plan);
    }
    let mut high = plan.clone();
    high.page = Some(DISC_PAGE);
    match need(&high)? {
        Some(need) if !need.fits() => Ok(plan),
        _ => Ok(high),
    }
}
