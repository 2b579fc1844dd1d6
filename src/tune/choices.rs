//! The search space: every setting in every format, params changeable or folded.

use super::choice::{Choice, Setting};
use super::search::Search;
use crate::target_args::Tables;
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

/// All formats and settings, with params changeable and folded; where the scene has functions that
/// tables may hold, formats of many digits with and without those.
pub fn choices(
    search: &Search,
    (folds, tabled): (bool, bool),
    settings: &[Setting],
) -> Vec<Choice> {
    let open = search.base.screen.tables.is_none();
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
            let both = tabled && open && target.runtime.real.is_long();
            let tables: &[Option<Tables>] = match both {
                true => &[Some(Tables::Yes), Some(Tables::No)],
                false => &[None],
            };
            for &frozen in frozen {
                for &tables in tables {
                    all.extend(smaller.iter().map(|&(outlined, thrift)| Choice {
                        setting,
                        format: target.runtime.format.to_owned(),
                        tables,
                        frozen,
                        outlined,
                        thrift,
                    }));
                }
            }
        }
    }
    all
}
