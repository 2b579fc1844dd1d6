//! What options mean for a program in the form of a post.

use super::{ScreenArgs, Style};
use crate::failure::{Failure, Outcome};
use crate::scene::{Scene, SceneArgs};
use slowlight_compiler::targets::{System, Target};

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
