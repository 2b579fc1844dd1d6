//! What options mean for a program in the form of a post.

use super::{ScreenArgs, Style};
use crate::failure::{Failure, Outcome};
use crate::scene::{Changes, Scene, SceneArgs};
use slowlight_compiler::targets::{System, Target};

impl ScreenArgs {
    /// Whether the program is to be posted.
    pub fn is_toot(&self) -> bool {
        self.style == Some(Style::Toot)
    }

    /// The scene's arguments as they are for this style.
    pub fn scene_args(&self, args: &SceneArgs) -> SceneArgs {
        SceneArgs {
            changes: self.changes(&args.changes),
            ..args.clone()
        }
    }

    /// What is changed of a scene as it is for this style: params cannot be changed in a post.
    pub fn changes(&self, changes: &Changes) -> Changes {
        let mut changes = changes.clone();
        if self.is_toot() {
            changes.freeze.push("all".to_owned());
        }
        changes
    }

    /// The scene as it moves, unless its first picture alone is wanted, as it is for this style.
    pub fn moving(&self, scene: Scene, still: bool) -> Scene {
        if self.is_toot() && scene.has_states() {
            eprintln!("note: a post draws one picture: states stay as they start");
        }
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
