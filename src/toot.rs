//! Programs in the form of a post (`--style toot`), for a bot that runs what is posted to it.

use crate::failure::{Failure, Outcome};
use crate::format::{count, duration};
use crate::scene::{Scene, SceneArgs};
use crate::target_args::{ScreenArgs, Style};
use slowlight_compiler::backend::{self, Document};
use slowlight_compiler::plan::Plan;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::{System, Target};

/// How many characters a post may have where the bot lives.
pub const POST: usize = 500;

/// What a post to the bot has beside its program: to run three hours, and whom it is for.
pub const TAG: &str = "\u{1f680}#bbcmicrobot";

/// How long the bot lets a program run, in seconds of its machine.
const LONGEST: f64 = 3.0 * 3600.0;

/// How dear memory is to a plan for a post: as dear as can be.
pub const THRIFT: u8 = 6;

impl ScreenArgs {
    /// Whether the program is to be posted.
    pub fn is_toot(&self) -> bool {
        self.style == Some(Style::Toot)
    }

    /// The scene's arguments as they are for this style: params cannot be changed in a post.
    pub fn scene_args(&self, args: &SceneArgs) -> SceneArgs {
        let mut args = args.clone();
        if self.is_toot() {
            args.changes.freeze = vec!["all".to_owned()];
        }
        args
    }

    /// The scene as it moves, unless its first picture alone is wanted, as it is for this style.
    pub fn moving(&self, scene: Scene, still: bool) -> Scene {
        match still || self.is_toot() {
            true => scene,
            false => scene.moving(),
        }
    }

    /// Refuses the style for other machines than the bot's.
    ///
    /// # Errors
    /// Where it is asked for such a machine.
    pub fn check_toot(&self, target: &Target) -> Outcome<()> {
        if !self.is_toot() || target.system == System::BbcBasic {
            return Ok(());
        }
        let message = format!(
            "--style toot is for bbc:micro, which the bot has; {} is another machine",
            target.name
        );
        Err(Failure::Usage(message))
    }
}

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

/// What is said of a program that is to be posted and takes so many seconds, if that is known;
/// nothing of others. Warns where it is too long for that, or takes too long.
pub fn said(plan: &Plan, documents: &[Document], seconds: Option<f64>) -> String {
    if !plan.toot {
        return String::new();
    }
    let (own, tag) = (characters(documents), TAG.chars().count());
    let all = own + tag;
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
    format!(
        "a post of {} of {POST} characters: {} of the program, {tag} of {TAG}; all params are \
         folded (--freeze all)\n",
        count(all as u64),
        count(own as u64)
    )
}
