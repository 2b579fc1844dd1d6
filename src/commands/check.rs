//! `check`: diagnostics, without anything else.

use crate::failure::{Failure, Outcome};
use crate::scene::{NATIVE_OFFSET, Scene, SceneArgs};
use crate::{diagnostics, say, say_json};
use serde_json::json;
use slowlight_compiler::source::{Diagnostic, Sources};

/// Options of `check`.
#[derive(clap::Args, Debug)]
pub struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Print the diagnostics as JSON
    #[arg(long)]
    json: bool,
}

/// Checks the scene, down to its graph.
pub fn run(args: &Args) -> Outcome<()> {
    let checked = Scene::load(&args.scene).and_then(|scene| {
        scene.graph(None, NATIVE_OFFSET)?;
        Ok(scene)
    });
    match checked {
        Ok(scene) => {
            let said = &scene.checked.diagnostics;
            if args.json {
                tell(&scene.checked.sources, said);
            } else {
                scene.warn();
                say(&match said.len() {
                    0 => format!("{}: nothing to remark\n", args.scene.scene.display()),
                    1 => format!("{}: 1 warning\n", args.scene.scene.display()),
                    n => format!("{}: {n} warnings\n", args.scene.scene.display()),
                });
            }
            Ok(())
        }
        Err(Failure::Scene(said)) => {
            if args.json {
                tell(&said.sources, &said.diagnostics);
            }
            Err(Failure::Scene(said))
        }
        Err(other) => Err(other),
    }
}

fn tell(sources: &Sources, said: &[Diagnostic]) {
    say_json(&json!({ "diagnostics": diagnostics::to_json(sources, said) }));
}
