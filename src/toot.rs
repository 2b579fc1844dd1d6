//! Programs in the form of a post (`--style toot`), for a bot that runs what is posted to it.

use crate::format::{count, duration};
use slowlight_compiler::backend::{self, Document};
use slowlight_compiler::plan::Plan;
use slowlight_compiler::planner::PlannedScene;

/// How many characters a post may have where the bot lives.
pub const POST: usize = 500;

/// What a post to the bot has beside its program: to run three hours, and whom it is for.
pub const TAG: &str = "\u{1f680}#bbcmicrobot";

/// How long the bot lets a program run, in seconds of its machine.
const LONGEST: f64 = 3.0 * 3600.0;

/// How dear memory is to a plan for a post: as dear as can be.
pub const THRIFT: u8 = 6;

/// The plan whose program has fewest characters, of a plan and that of the scene's formulas as
/// they stand: without what no pixel needs.
pub fn shortest(plan: PlannedScene) -> PlannedScene {
    let stable = plan.stable().map(|mut stable| {
        stable.toot = plan.toot;
        stable.page = plan.page;
        stable
    });
    let all = [Some(plan.clone()), stable].into_iter().flatten();
    let observed = all.map(|plan| plan.observed().unwrap_or(plan));
    let found = observed.min_by_key(|plan| characters(&backend::emit(plan)));
    found.unwrap_or(plan)
}

/// How many characters the program of a post has.
pub fn characters(documents: &[Document]) -> usize {
    documents.iter().map(|d| d.text.chars().count()).sum()
}

/// How many characters a plan's post has with the rest of it; nothing for other programs.
pub fn posted(plan: &Plan, documents: &[Document]) -> Option<usize> {
    plan.toot
        .then(|| characters(documents) + TAG.chars().count())
}

/// Warns of a post that is too long, or takes too many seconds.
pub fn warn(post: Option<usize>, seconds: Option<f64>) {
    let Some(all) = post else {
        return;
    };
    if all > POST {
        eprintln!(
            "warning: {} characters too many for a post of {POST}",
            count((all - POST) as u64)
        );
    }
    if seconds.is_some_and(|seconds| seconds > LONGEST) {
        eprintln!(
            "warning: the bot ends a program after {}",
            duration(LONGEST)
        );
    }
}

/// What is said of a post of so many characters; nothing of other programs.
pub fn said(post: Option<usize>) -> String {
    let Some(all) = post else {
        return String::new();
    };
    let tag = TAG.chars().count();
    format!(
        "a post of {} of {POST} characters: {} of the program, {tag} of {TAG}; all params are \
         folded (--freeze all)\n",
        count(all as u64),
        count((all - tag) as u64)
    )
}
