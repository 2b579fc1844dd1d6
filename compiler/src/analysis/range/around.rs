//! Path conditions: the facts that hold where the walk is, and what two of them say together: of
//! a condition that one of two others decides, and of which of the two.

use super::refine::{Choice, Conditions};
use crate::analysis::region::Fact;
use crate::ir::graph::*;

/// More facts than these are not looked through.
const MANY: usize = 200;

/// How many times what follows is looked at for what follows from it.
const ROUNDS: usize = 3;

/// What is known where the walk is.
#[derive(Default)]
pub(super) struct Around {
    facts: Vec<Fact>,
    choices: Vec<Choice>,
}

/// How much was known before an arm was entered.
#[derive(Clone, Copy)]
pub(super) struct Before {
    facts: usize,
    choices: usize,
}

impl Around {
    /// Enters an arm; answers what was known before, and all that is known by the arm's
    /// condition alone or with what is known: itself, and what each choice has come to.
    /// What several calls share is left out: it may be another call's by now.
    pub(super) fn enter(
        &mut self,
        conditions: &mut Conditions,
        shared: &[Option<bool>],
        fact: Fact,
    ) -> (Before, Vec<Fact>) {
        let own = |id: NodeId| shared[id.0 as usize].is_none();
        let before = Before {
            facts: self.facts.len(),
            choices: self.choices.len(),
        };
        let mut all = vec![fact];
        let mut from = before;
        let mut done = 0;
        for _ in 0..ROUNDS {
            if self.facts.len() > MANY || done == all.len() {
                break;
            }
            for fact in &all[done..] {
                let (facts, choices) = conditions.implied(*fact);
                self.facts.extend(facts.iter().filter(|(id, _)| own(*id)));
                let choices = choices.iter().filter(|choice| own(choice.by));
                self.choices.extend(choices.copied());
            }
            done = all.len();
            for (k, choice) in self.choices.iter().enumerate() {
                // What was known of what is known already was looked at then.
                let new = if k < from.choices { from.facts } else { 0 };
                let Some(&(_, is)) = self.facts[new..].iter().find(|(id, _)| *id == choice.by)
                else {
                    continue;
                };
                let chosen = (if is { choice.yes } else { choice.no }, choice.holds);
                if own(chosen.0) && !self.facts.contains(&chosen) && !all.contains(&chosen) {
                    all.push(chosen);
                }
            }
            from = Before {
                facts: self.facts.len(),
                choices: self.choices.len(),
            };
        }
        (before, all)
    }

    /// What came to be known since.
    pub(super) fn since(&self, before: Before) -> std::ops::Range<usize> {
        before.facts..self.facts.len()
    }

    /// One of the facts.
    pub(super) fn fact(&self, k: usize) -> Fact {
        self.facts[k]
    }

    /// Leaves it.
    pub(super) fn leave(&mut self, before: Before) {
        self.facts.truncate(before.facts);
        self.choices.truncate(before.choices);
    }
}
