//! `render`: the native picture.

use crate::draw::{Window, native};
use crate::failure::{Failure, Outcome};
use crate::moving::film::FilmFile;
use crate::moving::sweep;
use crate::moving::walk::{Step, walk};
use crate::moving::{MovingArgs, must_move, pictures_in_words};
use crate::picture::Picture;
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
    /// In the inks of this machine's screen, as in 6502:c64
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: Option<&'static Target>,
    /// The mode of that screen, as in hires
    #[arg(long, value_name = "N", requires = "target")]
    mode: Option<String>,
    /// Only these rows, both ends included, as in 0..19
    #[arg(long, value_name = "A..B")]
    rows: Option<String>,
    /// Where to write the picture: .png, .pgm (numbers of inks) or .pbm (two inks); pictures that
    /// move: .gif or .png, animated
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Show the picture as text, and print nothing else; without it and a file's name, a
    /// terminal shows the picture as it can, and what is no terminal gets text
    #[arg(long)]
    ascii: bool,
    /// Print size and digest (SHA-256 of the inks) as JSON
    #[arg(long, conflicts_with = "ascii")]
    json: bool,
    #[command(flatten)]
    moving: MovingArgs,
}

/// Draws and writes it.
pub fn run(args: &Args) -> Outcome<()> {
    if let Some(pictures) = args.moving.pictures {
        return film(args, pictures);
    }
    if let Some(set) = args.scene.changes.set.iter().find(|set| set.contains("..")) {
        let message = format!("--set {set}: over how many pictures? say --pictures N");
        return Err(Failure::Usage(message));
    }
    let output = PictureFile::named(args.output.as_deref())?;
    let scene = Scene::load(&args.scene)?;
    let (width, height) = scene.size();
    let shown = shown_inks(args, &scene)?;
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

/// Draws and writes the pictures of a scene that moves, or of a param that goes from one value
/// to another.
fn film(args: &Args, pictures: u32) -> Outcome<()> {
    if args.ascii {
        let message = "--ascii is of one picture: leave --pictures out".to_owned();
        return Err(Failure::Usage(message));
    }
    let output = FilmFile::named(args.output.as_deref())?;
    if !output.wanted() && !args.json {
        let message = "--pictures: where to? say -o walk.gif or walk.png".to_owned();
        return Err(Failure::Usage(message));
    }
    let hands = args.moving.hands()?;
    let changes = &args.scene.changes;
    let ends = sweep::ends(changes)?;
    let open = |changes| Scene::open(&args.scene.scene, changes).map(Scene::moving);
    let scene = open(ends.as_ref().map_or(changes, |(first, _)| first))?;
    let shown = shown_inks(args, &scene)?;
    let (width, height) = scene.size();
    let mut window = Window::whole(width, height);
    if let Some(rows) = &args.rows {
        window.rows = target_args::rows(rows, height)?;
    }
    scene.warn();
    let graph = scene.graph(shown, Precision::NATIVE)?;
    let sweeps = match &ends {
        Some((_, last)) => {
            let last = open(last)?.graph(shown, Precision::NATIVE)?;
            sweep::between(&graph, &last, changes)?
        }
        None => {
            must_move(&graph)?;
            Vec::new()
        }
    };
    args.moving.keys_are_asked_for(&graph)?;
    let steps = walk(&graph, window, pictures, &hands, &sweeps)?;
    let states: Vec<_> = steps.iter().map(states_json).collect();
    let drawn: Vec<Picture> = steps.into_iter().map(|step| step.picture).collect();
    output.write(&drawn, args.moving.fps)?;
    let inks = graph.image.palette.len();
    let (width, height) = (window.width(), window.height());
    if args.json {
        let all = states.into_iter().zip(&drawn);
        let all =
            all.map(|(states, picture)| json!({"inks_sha256": picture.sha256(), "states": states}));
        return say_json(&json!({
            "scene": scene.name,
            "inks": inks,
            "width": width,
            "height": height,
            "pictures": all.collect::<Vec<_>>(),
        }));
    }
    say(&format!(
        "{}: {} of {width} x {height} pixels, {inks} inks\n",
        scene.name,
        pictures_in_words(pictures)
    ))
}

/// A picture's states, by name.
fn states_json(step: &Step) -> serde_json::Map<String, serde_json::Value> {
    let all = step.states.iter();
    let all = all.map(|(name, value)| (name.clone(), json!(value)));
    all.collect()
}

/// How many inks the screen has that the picture is for, if it is for one.
fn shown_inks(args: &Args, scene: &Scene) -> Outcome<Option<u32>> {
    let screen = ScreenArgs {
        mode: args.mode.clone(),
        ..ScreenArgs::default()
    };
    let target = args.target;
    target
        .map(|target| Ok(screen.mode(target, scene)?.inks))
        .transpose()
}
