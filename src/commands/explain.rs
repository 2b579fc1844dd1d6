//! `explain`: what each line of a scene costs on a machine.

use crate::explain::why::whys;
use crate::explain::{explain, html, terminal};
use crate::failure::Outcome;
use crate::files;
use crate::scene::{Scene, SceneArgs};
use crate::target_args::{self, ScreenArgs};
use crate::trial::LIMIT;
use crate::{say, say_json};
use slowlight_compiler::targets::Target;
use std::path::PathBuf;

/// Options of `explain`.
#[derive(clap::Args, Debug)]
pub struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The machine, as in jack, bbc, 6502 or 6502:c64; `slowlight targets` lists all
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: &'static Target,
    #[command(flatten)]
    screen: ScreenArgs,
    /// Say for each line what its plan could not do and what would let it: a range, a bound or a
    /// constant. What may help is tried on the machine, so it takes several times as long
    #[arg(long)]
    why: bool,
    /// Write a page that shows the same, for any browser, without the network
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write it as a picture
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Give up after so many cycles of the machine
    #[arg(long, value_name = "CYCLES", default_value_t = LIMIT)]
    limit: u64,
}

/// Profiles and reports.
pub fn run(args: &Args) -> Outcome<()> {
    files::may_write_each([args.html.as_ref(), args.svg.as_ref()])?;
    let scene = Scene::load(&args.screen.scene_args(&args.scene))?;
    let mut found = explain(scene, args.target, &args.screen, args.limit)?;
    if args.why {
        found.why = Some(whys(&found, args.target, &args.screen, args.limit)?);
    }
    if let Some(path) = &args.html {
        files::write(path, html::page(&found).as_bytes())?;
    }
    if let Some(path) = &args.svg {
        files::write(path, terminal::svg(&found).as_bytes())?;
    }
    match args.json {
        true => say_json(&found.report()),
        false => say(&terminal::text(&found)),
    }
}
