//! Pruning of the search by a separable model: what a setting costs is what the whole picture
//! costs in the same format, by the share of `f64` operations that the setting takes, and what
//! comes before the first row as it is; its error is the root of the sum of both squares, the
//! format's own and the setting's.
//!
//! So every format is tried with the whole picture first, and what another is expected to be
//! clearly cheaper than, and hardly worse, is not even planned. Only what is tried has figures.

use super::choice::{Choice, Setting};
use super::goal::Measure;
use super::rows::Look;
use super::settings::{Drafted, Drafts};

/// By how much another must be cheaper.
const CLEARLY: f64 = 0.8;

/// By how much it may be worse: errors are not quite the sum of two.
const HARDLY: f64 = 1.1;

/// The choices that the others are predicted by: whole pictures in each format, by the quickest
/// program, with params folded where they may be.
pub fn is_first(choice: &Choice, folds: bool) -> bool {
    let plain = !choice.outlined && choice.thrift == 0 && choice.frozen == folds;
    choice.setting == Setting::WHOLE && plain
}

/// What predicts the figures of choices by some that were looked at.
pub struct Predictor<'s> {
    /// Those, whole pictures.
    pub known: Vec<(Choice, Look)>,
    /// What settings are in `f64`.
    pub drafts: &'s Drafts,
    /// The error that decides.
    pub measure: Measure,
}

impl Predictor<'_> {
    /// A choice's figures; none where its format is not known.
    pub fn predict(&self, choice: &Choice) -> Option<Look> {
        let alike = |known: &Choice| known.format == choice.format;
        let (_, whole) = self.known.iter().find(|(known, _)| alike(known))?;
        let of = |d: &&Drafted| d.setting == choice.setting;
        let draft = self.drafts.chosen.iter().find(of)?;
        let share = draft.work as f64 / self.drafts.whole_work.max(1) as f64;
        let before = whole.before.min(whole.cycles);
        Some(Look {
            cycles: before + (whole.cycles - before) * share,
            before,
            error: whole.error.hypot(self.measure.of(&draft.errors)),
            pixels: whole.pixels,
        })
    }

    /// The choices that nothing is expected to beat clearly, and the others with their figures.
    pub fn pruned(&self, choices: Vec<Choice>) -> (Vec<Choice>, Vec<(Choice, Look)>) {
        let looks: Vec<Option<Look>> = choices.iter().map(|choice| self.predict(choice)).collect();
        let beats =
            |a: &Look, b: &Look| a.cycles < CLEARLY * b.cycles && a.error <= HARDLY * b.error;
        let known = self.known.iter().map(|(_, look)| look);
        let all: Vec<&Look> = known.chain(looks.iter().flatten()).collect();
        let (mut worth, mut beaten) = (Vec::new(), Vec::new());
        for (choice, look) in choices.into_iter().zip(&looks) {
            match look {
                Some(look) if all.iter().any(|other| beats(other, look)) => {
                    beaten.push((choice, *look));
                }
                _ => worth.push(choice),
            }
        }
        (worth, beaten)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Errors;

    fn drafted(block: u32, work: u64, pixels: u64) -> Drafted {
        Drafted {
            setting: Setting {
                block: (block, block),
                ..Setting::WHOLE
            },
            work,
            errors: Errors {
                pixels,
                count: 10_000,
                ..Errors::default()
            },
        }
    }

    fn choice(block: u32, format: &str) -> Choice {
        Choice {
            setting: drafted(block, 0, 0).setting,
            format: format.to_owned(),
            tables: None,
            frozen: false,
            outlined: false,
            thrift: 0,
        }
    }

    fn look(cycles: f64, error: f64) -> Look {
        Look {
            cycles,
            before: 2e5,
            error,
            pixels: 10_000.0,
        }
    }

    /// A quick format that is 2 % wrong, and one that is right and takes ten times as long.
    #[test]
    fn a_dear_format_is_not_tried_where_the_setting_is_what_is_wrong() {
        let (quick, dear) = (choice(1, "quick"), choice(1, "dear"));
        let predictor = Predictor {
            known: vec![(quick, look(1e6, 0.02)), (dear, look(1e7, 0.0))],
            drafts: &Drafts {
                chosen: vec![drafted(1, 1000, 0), drafted(2, 250, 3000)],
                left: Vec::new(),
                whole_work: 1000,
            },
            measure: Measure::Pixels,
        };
        assert_eq!(
            predictor.predict(&choice(2, "dear")),
            Some(look(2.65e6, 0.3))
        );
        let both = predictor
            .predict(&choice(2, "quick"))
            .map(|look| look.error);
        assert!(
            both.is_some_and(|error| (0.3006..0.3007).contains(&error)),
            "{both:?}"
        );
        assert_eq!(predictor.predict(&choice(2, "other")), None);
        let all = ["quick", "dear", "other"].map(|format| choice(2, format));
        let (worth, beaten) = predictor.pruned(all.to_vec());
        assert_eq!(worth, [choice(2, "quick"), choice(2, "other")]);
        assert_eq!(beaten, [(choice(2, "dear"), look(2.65e6, 0.3))]);
    }
}
