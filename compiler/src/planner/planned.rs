//! A plan with how it was made.

use super::context::Context;
use super::search::stepped::Steps;
use crate::cost::size_budget::SizeBudget;
use crate::plan::Plan;
use crate::wordlength::{pointed, sample};
use std::ops::{Deref, DerefMut};
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// Which passes may rewrite formulas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rewriting {
    /// None: every formula as the scene has it.
    None,
    /// [`crate::passes::accuracy`].
    Stable,
    /// Those for speed, too; perhaps with little memory.
    Fast { budget: SizeBudget, steps: Steps },
}

/// A plan, and how it was made: whoever needs another plan of the same scene asks it.
#[derive(Clone, Debug)]
pub struct PlannedScene {
    /// The plan.
    pub plan: Plan,
    /// What was made on the way, and how its formulas could be rewritten.
    pub(super) cx: Arc<Context>,
    pub(super) rewriting: Rewriting,
    /// What making it took, in units of [`crate::fuel::Fuel`].
    pub(super) work: u64,
    /// How much fuel there is for each plan that is made from this one.
    pub(super) allowance: u64,
    /// How many statements are run to place the points of those plans, and how many were for its
    /// own.
    pub(super) looks: u64,
    pub(super) looked: u64,
}

impl Deref for PlannedScene {
    type Target = Plan;

    fn deref(&self) -> &Plan {
        &self.plan
    }
}

impl DerefMut for PlannedScene {
    fn deref_mut(&mut self) -> &mut Plan {
        &mut self.plan
    }
}

impl PlannedScene {
    /// The same; points of plans that are made from it are placed by few pixels, as is enough to
    /// see how large their programs are ([`PlannedScene::settled`]). Where values have two widths,
    /// which of them are narrow counts for more.
    #[must_use]
    pub fn on_trial(&self) -> PlannedScene {
        let looks = match self.runtime.narrow {
            Some(_) => self.looks,
            None => self.looks.min(sample::DRAFT),
        };
        PlannedScene {
            looks,
            ..self.clone()
        }
    }

    /// The same, with plans made from it as usual.
    #[must_use]
    pub fn off_trial(self) -> PlannedScene {
        PlannedScene {
            looks: self.cx.looks(),
            ..self
        }
    }

    /// The same off trial, with its points placed as those of a plan that is to be run; none where
    /// they are, or where there are none.
    pub fn settled(&self) -> Option<PlannedScene> {
        let looks = self.cx.looks();
        if self.points.is_none() || self.looked >= looks {
            return None;
        }
        let (points, ranges) = pointed(&self.graph, &self.tree, self.runtime, looks)?;
        let mut plan = self.plan.clone();
        let found = plan.take_points(points, ranges);
        found.then(|| PlannedScene {
            plan,
            looks,
            looked: looks,
            ..self.clone()
        })
    }

    /// How many statements ran in the routines' models to find the widths of values, for this
    /// plan and those that were made with it.
    pub fn modelled(&self) -> u64 {
        self.cx.ran.load(Ordering::Relaxed)
    }

    /// Units of fuel that were burnt to make its program fit, if that is noted.
    pub fn burnt(&self) -> u64 {
        self.cx.burnt.load(Ordering::Relaxed)
    }

    /// Notes what was burnt.
    pub fn note_burnt(&self, units: u64) {
        self.cx.burnt.store(units, Ordering::Relaxed);
    }
}
