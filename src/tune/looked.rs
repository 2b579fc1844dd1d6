//! A first look at a choice, and its whole picture: what is planned and run, or remembered.

use super::bands;
use super::choice::Choice;
use super::goal::Measure;
use super::planned::Planned;
use super::point::{self, Natives, Point};
use super::rows::{self, Look};
use super::search::Search;
use super::work;
use crate::failure::{Failure, Outcome};
use crate::fit::TOO_DEAR;
use crate::scene::Scene;
use serde::{Deserialize, Serialize};

/// What a first look at a choice came to.
#[derive(Clone, Serialize, Deserialize)]
pub enum First {
    /// It is quick, so it was run whole.
    Whole(Box<Point>),
    /// It takes long, so some rows were run.
    Rows(Look),
    /// It cannot be had.
    Not(String),
    /// To plan it takes too much.
    Dear,
}

impl First {
    /// Its figures, if it can be had.
    pub fn look(&self, measure: Measure) -> Option<Look> {
        match self {
            First::Whole(point) => Some(Look::of(point, measure)),
            First::Rows(look) => Some(*look),
            First::Not(_) | First::Dear => None,
        }
    }
}

/// The same with the plan, where one was made and is needed again: planning takes long.
pub struct Begun {
    /// What was seen.
    pub first: First,
    /// What it took to be planned, as [`work`] counts it.
    pub planning: f64,
    /// The plan.
    pub plan: Option<Planned>,
}

/// Looks at a choice, or remembers what was seen.
///
/// # Errors
/// Only an interruption.
pub fn begun(search: &Search, scene: &Scene, natives: &Natives, choice: &Choice) -> Outcome<Begun> {
    let (base, measure) = (&search.base, search.measure);
    let mut words = search.words(choice);
    words.push(format!("first {measure:?}"));
    let (mut kept, mut planning) = (None, 0.0);
    let work = || {
        let tried = planned(search, scene, choice).and_then(|planned| {
            planning = work::of_plan(&planned.plan);
            rows::hopeless(&planned, search.limit)?;
            if let Some(look) = rows::unseen(&planned) {
                kept = Some(planned);
                return Ok(First::Rows(look));
            }
            if !bands::pays(&planned) {
                let point = point::measure(
                    base,
                    scene,
                    natives,
                    choice,
                    planned,
                    (search.limit, search.by_line),
                )?;
                return Ok(First::Whole(Box::new(point)));
            }
            let how = (measure, search.limit);
            let look = rows::look(base, scene, natives, choice, &planned, how)?;
            kept = Some(planned);
            Ok(First::Rows(look))
        });
        match tried {
            Err(Failure::Interrupted) => Err(Failure::Interrupted),
            Err(other) if other.reason() == TOO_DEAR => Ok((First::Dear, 0.0)),
            Err(other) => Ok((First::Not(other.reason()), 0.0)),
            Ok(first) => Ok((first, planning)),
        }
    };
    let (first, planning) = search.cache.known_or(scene, base.target, &words, work)?;
    Ok(Begun {
        first,
        planning,
        plan: kept,
    })
}

/// A choice's plan, which is refused where it takes too much to be made for one of many.
fn planned(search: &Search, scene: &Scene, choice: &Choice) -> Outcome<Planned> {
    let mut screen = search.base.screen(choice);
    screen.fuel = search.effort.plan();
    Ok(Planned::new(screen.plan(scene, search.base.target, &[])?))
}

/// A choice's point, or why it cannot be had.
pub type Tried = Result<Point, String>;

/// Runs a choice whole, by the plan if there is one.
///
/// # Errors
/// Only an interruption.
pub fn tried(
    search: &Search,
    scene: &Scene,
    natives: &Natives,
    choice: &Choice,
    plan: Option<Planned>,
) -> Outcome<Tried> {
    let base = &search.base;
    let plan = match plan {
        Some(plan) => Ok(plan),
        None => planned(search, scene, choice),
    };
    let measured = |plan| {
        point::measure(
            base,
            scene,
            natives,
            choice,
            plan,
            (search.limit, search.by_line),
        )
    };
    match plan.and_then(measured) {
        Ok(point) => Ok(Ok(point)),
        Err(Failure::Interrupted) => Err(Failure::Interrupted),
        Err(other) => Ok(Err(other.reason())),
    }
}
