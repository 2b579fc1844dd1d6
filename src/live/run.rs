//! A run: a machine that a scene is run on, and the options that it is planned with there.

use crate::failure::{Failure, Outcome};
use crate::given::Given;
use crate::scene::Scene;
use crate::target_args::{self, Refining, ScreenArgs};
use crate::ways::WayArgs;
use clap::Args;
use serde::Deserialize;
use slowlight_compiler::targets::{self, Target};
use std::borrow::Cow;

/// How many machines stand beside each other.
pub const MOST: usize = 2;

/// A run.
#[derive(Clone, Debug)]
pub struct Run {
    /// Which of the machines that stand beside each other.
    pub panel: usize,
    /// Goes up with whatever it hangs on: text, values, its own machine and options.
    pub serial: u64,
    /// The machine.
    pub target: &'static Target,
    /// The format, if one is asked for.
    pub format: Option<String>,
    /// The mode, if one is asked for.
    pub mode: Option<String>,
    /// Other options, as [`Options`] has them.
    pub options: String,
}

/// A run as the page asks for it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Asked {
    target: String,
    format: Option<String>,
    mode: Option<String>,
    #[serde(default)]
    options: String,
}

/// What `tune` chooses between, beside formats: options of `run` and `build`.
#[derive(Args, Clone, Debug, Default)]
struct Options {
    /// Whether all params are folded
    #[arg(long, value_name = "all", value_parser = ["all"])]
    freeze: Option<String>,
    #[arg(long, value_parser = target_args::block)]
    block: Option<(u32, u32)>,
    #[arg(long, value_parser = target_args::refining)]
    refine: Option<Refining>,
    #[arg(long, value_parser = target_args::turns)]
    max_turns: Option<u32>,
    #[arg(long, value_parser = target_args::turns)]
    max_steps: Option<u32>,
    #[command(flatten)]
    ways: WayArgs,
    #[arg(long, value_parser = target_args::thrift)]
    thrift: Option<u8>,
    #[arg(long)]
    outlined: bool,
}

impl Run {
    /// A run that was asked for; its options are read once it begins.
    ///
    /// # Errors
    /// Where there is no such machine.
    pub fn asked(panel: usize, serial: u64, asked: Asked) -> Result<Run, String> {
        let target = targets::find(&asked.target);
        Ok(Run {
            panel,
            serial,
            target: target.ok_or_else(|| format!("no target `{}`", asked.target))?,
            format: asked.format,
            mode: asked.mode,
            options: asked.options,
        })
    }

    /// The options, and the scene as they have it.
    ///
    /// # Errors
    /// Where they are none.
    pub fn planned_with<'s>(&self, scene: &'s Scene) -> Outcome<(ScreenArgs, Cow<'s, Scene>)> {
        let options = Given::<Options>::read(&self.options).map_err(Failure::Usage)?;
        let Options {
            freeze,
            block,
            refine,
            max_turns,
            max_steps,
            ways,
            thrift,
            outlined,
        } = options.args;
        let screen = ScreenArgs {
            format: self.format.clone(),
            mode: self.mode.clone(),
            block,
            refine,
            max_turns,
            max_steps,
            ways,
            thrift,
            outlined,
            ..ScreenArgs::default()
        };
        let scene = match freeze {
            Some(_) => Cow::Owned(scene.frozen()),
            None => Cow::Borrowed(scene),
        };
        Ok((screen, scene))
    }
}

/// What a server asks; a page by itself has its own desk.
#[cfg(not(target_family = "wasm"))]
impl Run {
    /// Whether another is the same but for its number.
    pub fn is_like(&self, other: &Run) -> bool {
        let own = |run: &Run| (run.format.clone(), run.options.clone());
        self.has_frontier_of(other) && own(self) == own(other)
    }

    /// Whether what is worth choosing for another is so for this one.
    pub fn has_frontier_of(&self, other: &Run) -> bool {
        self.target.name == other.target.name && self.mode == other.mode
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(options: &str) -> Run {
        Run {
            panel: 0,
            serial: 1,
            target: targets::find("6502").expect("a target"),
            format: Some("log10".to_owned()),
            mode: None,
            options: options.to_owned(),
        }
    }

    #[test]
    fn options_are_those_of_the_command_line() {
        let text = "image 8 x 8 inks black, white;\ndraw (x, y) = ink(x mod 2);\n";
        let scene = Scene::of_text(
            ("a.scn", text),
            std::path::Path::new("a.scn"),
            &crate::scene::Changes::default(),
            &mut |_, _| Err(String::new()),
        );
        let scene = scene.expect("a scene");
        let made = run("--freeze all --block 4x2 --max-turns 3 --hits march:64:0.01 --thrift 2");
        let (screen, frozen) = made.planned_with(&scene).expect("options");
        assert_eq!((screen.block, screen.max_turns), (Some((4, 2)), Some(3)));
        assert_eq!(screen.thrift, Some(2));
        assert!(screen.ways.hits.is_some() && matches!(frozen, Cow::Owned(_)));
        // What else `run` takes is no choice of the page's.
        for wrong in [
            "--block 0",
            "--freeze light",
            "--no-plot",
            "--help",
            "--prelude /",
            "torus.scn",
            "'",
        ] {
            assert!(run(wrong).planned_with(&scene).is_err(), "{wrong}");
        }
    }
}
