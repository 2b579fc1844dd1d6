//! `render`: the native picture.

use crate::draw::{Window, native};
use crate::failure::Outcome;
use crate::picture::PictureFile;
use crate::scene::{Precision, Scene, SceneArgs};
use crate::target_args::{self, ScreenArgs};
use crate::{ascii, diagnostics, inks, say, say_json, show};
use serde_json::json;
use slowlight_compiler::targets::Target;
use std::path::PathBuf;

/// Options of `render`.
#[derive(clap::Args, Debug)]
pub struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// In the inks of this target's screen
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: Option<&'static Target>,
    /// The screen's mode, whose inks count
    #[arg(long, value_name = "N", requires = "target")]
    mode: Option<String>,
    /// Only these rows, both ends included
    #[arg(long, value_name = "A..B")]
    rows: Option<String>,
    /// Where to write the picture: .png, .pgm (ink indices) or .pbm (two inks)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Show the picture as text, and print nothing else; without it and a file's name, a
    /// terminal shows the picture as it can, and what is no terminal gets text
    #[arg(long)]
    ascii: bool,
    /// Print size and digest as JSON
    #[arg(long, conflicts_with = "ascii")]
    json: bool,
}

/// Draws and writes it.
pub fn run(args: &Args) -> Outcome<()> {
    let output = PictureFile::named(args.output.as_deref())?;
    let scene = Scene::load(&args.scene)?;
    let (width, height) = scene.size();
    let screen = ScreenArgs {
        mode: args.mode.clone(),
        ..ScreenArgs::default()
    };
    let shown = match args.target {
        Some(target) => Some(screen.mode(target, &scene)?.inks),
        None => None,
    };
    let mut window = Window::whole(width, height);
    if let Some(rows) = &args.rows {
        window.rows = target_args::rows(rows, height)?;
    }
    scene.warn();
    if let (Some(target), Some(_)) = (args.target, shown) {
        let said = inks::warnings(&scene, &[(target.name.to_owned(), shown)], window)?;
        diagnostics::print(&scene.checked.sources, &said);
    }
    let graph = scene.graph(shown, Precision::NATIVE)?;
    let drawn = native(&graph, window)?;
    let picture = drawn.picture();
    output.write(&picture)?;
    if args.json {
        return say_json(&json!({
            "scene": scene.name,
            "inks": picture.palette.len(),
            "width": picture.width,
            "height": picture.height,
            "pixels": picture.inks.len(),
            "inks_sha256": picture.sha256(),
        }));
    }
    let mut text = String::new();
    if args.ascii || !output.wanted() {
        text += &match show::means().filter(|_| !args.ascii) {
            Some(means) => show::text(&picture, means, (show::room().0, None))?,
            None => ascii::text(&picture, ascii::COLUMNS),
        };
    }
    if !args.ascii {
        let (width, height, inks) = (picture.width, picture.height, picture.palette.len());
        text += &format!("{}: {width} x {height} pixels, {inks} inks\n", scene.name);
    }
    say(&text)
}
