//! What is searched: the scene and its machine, what decides, and how much is tried.

use super::cache::Cache;
use super::choice::{Base, Choice};
use super::effort::Effort;
use super::goal::{Measure, percent};
use super::rows::Look;
use crate::format::duration;
use crate::progress;

/// How many settings go to the machines, where nobody says it.
pub const SETTINGS: u16 = 12;

/// What is tuned and how.
pub struct Search {
    /// What stays as the user has it.
    pub base: Base,
    /// The error that decides.
    pub measure: Measure,
    /// Whether params must stay changeable.
    pub live: bool,
    /// Whether to try smaller programs where what is quickest fits, too.
    pub smaller: bool,
    /// How many settings go to the machines.
    pub settings: usize,
    /// Cycles after which a machine is given up.
    pub limit: u64,
    /// How much is tried at all.
    pub effort: Effort,
    /// Whether to tell what each point's time goes to.
    pub by_line: bool,
    /// What is known from before.
    pub cache: Cache,
}

impl Search {
    /// Says what a choice comes to, by the whole picture or by some rows.
    pub fn tell(&self, choice: &Choice, look: &Look, whole: bool) {
        let about = if whole { "" } else { "about " };
        let time = duration(look.cycles / self.base.hertz());
        let (error, phrase) = (percent(look.error), self.measure.phrase());
        let options = self.base.words(choice).join(" ");
        progress::say(&format!("{about}{time}, {error} {phrase}: {options}"));
    }

    /// What the figures of a choice depend on: its options, and when a machine is given up.
    pub fn words(&self, choice: &Choice) -> Vec<String> {
        let mut words = self.base.words(choice);
        words.push(format!("limit {} {:?}", self.limit, self.effort));
        if !self.by_line {
            words.push("not by line".to_owned());
        }
        words
    }
}
