//! The search space: every setting in every format, params changeable or folded.

use super::choice::{Choice, Setting};
use super::search::Search;
use slowlight_compiler::planner::THRIFTS;
use slowlight_compiler::targets;

/// Ways to a smaller program: subroutines, or how much less memory is spent on speed.
const SMALLER: [(bool, u8); 5] = {
    let last = THRIFTS as u8 - 1;
    [
        (false, 0),
        (false, last / 3),
        (false, last * 2 / 3),
        (false, last),
        (true, 0),
    ]
};

/// All formats and settings, with params changeable and folded.
pub fn choices(search: &Search, folds: bool, settings: &[Setting]) -> Vec<Choice> {
    let frozen: &[bool] = match folds {
        // Of two of which the same is expected the first is tried: folded is quicker.
        true => &[true, false],
        false => &[false],
    };
    let smaller: &[(bool, u8)] = match search.smaller {
        true => &SMALLER,
        false => &SMALLER[..1],
    };
    let mut all = Vec::new();
    for &setting in settings {
        for target in targets::formats(search.base.target) {
            for &frozen in frozen {
                for &(outlined, thrift) in smaller {
                    all.push(Choice {
                        setting,
                        format: target.runtime.format.to_owned(),
                        frozen,
                        outlined,
                        thrift,
                    });
                }
            }
        }
    }
    all
}
