//! The pass manager: runs passes of the [pipeline](super::pipeline), but those that it was told to
//! leave out and those for which no fuel is left, and counts what each was good for
//! (`build --emit passes`).

use super::pipeline::{PASSES, Pass};
use crate::fuel::Fuel;
use crate::schedule::analysed::Analysed;
use std::fmt::Write;
use std::sync::{Arc, Mutex, PoisonError};

/// Some of the passes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PassSet(u64);

impl PassSet {
    /// The same with one more.
    #[must_use]
    pub fn with(self, pass: Pass) -> PassSet {
        PassSet(self.0 | 1 << pass as u64)
    }

    /// Whether one is among them.
    pub fn has(self, pass: Pass) -> bool {
        self.0 & 1 << pass as u64 != 0
    }

    /// All that come after one.
    pub fn after(pass: Pass) -> PassSet {
        let after = PASSES.iter().skip_while(|p| **p != pass).skip(1);
        after.fold(PassSet::default(), |all, pass| all.with(*pass))
    }
}

/// What a pass was good for so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct Count {
    /// How often it was run, and how often what it made was kept.
    pub runs: u64,
    pub kept: u64,
    /// What it burnt, with what ran inside of it, in units of [`Fuel`].
    pub work: u64,
}

/// What runs passes for all plans of a scene.
#[derive(Clone, Debug, Default)]
pub struct Pipeline {
    /// Those that are left out.
    pub without: PassSet,
    counts: Arc<Mutex<Vec<Count>>>,
}

impl Pipeline {
    /// One that leaves some out.
    pub fn without(without: PassSet) -> Pipeline {
        Pipeline {
            without,
            ..Pipeline::default()
        }
    }

    /// Runs a pass that makes another plan of one, or nothing where that would be no better, if
    /// it is not left out and there is fuel for it.
    pub fn pass(
        &self,
        fuel: &Fuel,
        pass: Pass,
        plan: Analysed,
        run: impl FnOnce(&Analysed) -> Option<Analysed>,
    ) -> Analysed {
        if self.without.has(pass) || fuel.spent() {
            return plan;
        }
        self.always(fuel, pass, || run(&plan)).unwrap_or(plan)
    }

    /// Runs a pass, if it is not left out, whatever fuel there is.
    pub fn always<T>(&self, fuel: &Fuel, pass: Pass, run: impl FnOnce() -> Option<T>) -> Option<T> {
        if self.without.has(pass) {
            return None;
        }
        let before = fuel.burnt();
        let made = run();
        let mut counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        counts.resize(PASSES.len(), Count::default());
        if let Some(count) = counts.get_mut(pass as usize) {
            count.runs += 1;
            count.kept += u64::from(made.is_some());
            count.work += fuel.burnt() - before;
        }
        made
    }

    /// What each pass was good for.
    pub fn count(&self, pass: Pass) -> Count {
        let counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        counts.get(pass as usize).copied().unwrap_or_default()
    }

    /// The passes in their order, with what was counted, as a table of text.
    pub fn text(&self) -> String {
        let mut text = format!(
            "{:19} {:>7} {:>7} {:>11}  what it does (compiler/src)\n",
            "pass", "runs", "kept", "work"
        );
        for pass in PASSES {
            let (name, file, what) = pass.about();
            let Count { runs, kept, work } = self.count(*pass);
            let left = if self.without.has(*pass) {
                "; left out"
            } else {
                ""
            };
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{name:19} {runs:7} {kept:7} {work:11}  {what} ({file}){left}"
            );
        }
        text
    }
}
