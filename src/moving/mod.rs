//! Scenes that move: pictures one after the other, and what a player holds between two.

pub mod film;
pub mod hands;
pub mod places;
pub mod run;
mod said;
pub mod sweep;
pub mod walk;

use crate::draw::Window;
use crate::failure::{Failure, Outcome};
use crate::format::count;
use hands::Hands;
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::source::Diagnostic;
use slowlight_compiler::targets::{Target, every};
use std::collections::BTreeSet;

/// Pictures at most, and pixels of all of them; pictures of a machine, whose memory is kept
/// with each.
const MOST: u32 = 10_000;
const PIXELS: u64 = 1 << 28;
const FOLLOWED: u32 = 1_000;

/// Options of what moves.
#[derive(clap::Args, Clone, Debug)]
pub struct MovingArgs {
    /// So many pictures of a scene that moves, one after the other: 10,000 at most, and of a
    /// program that is followed 1,000
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub pictures: Option<u32>,
    /// What is held, a unit a picture: "up*40 right*10 fire wait 5" (docs/moving.md), or @FILE,
    /// a file of it
    #[arg(long, value_name = "SCRIPT", requires = "pictures")]
    pub keys: Option<String>,
    /// Pictures a second in the file
    #[arg(long, value_name = "N", requires = "pictures", default_value_t = 25,
          value_parser = clap::value_parser!(u16).range(1..=50))]
    pub fps: u16,
}

impl MovingArgs {
    /// What is held.
    ///
    /// # Errors
    /// What is wrong with the script.
    pub fn hands(&self) -> Outcome<Hands> {
        Hands::of(self.keys.as_deref().unwrap_or_default())
    }

    /// Fails where there is a script of keys, and nothing in a scene asks for them.
    ///
    /// # Errors
    /// Where its graph has no buttons.
    pub fn keys_are_asked_for(&self, graph: &Graph) -> Outcome<()> {
        if self.keys.is_none() || graph.buttons().next().is_some() {
            return Ok(());
        }
        let message = "--keys: no state of this scene asks for `input`".to_owned();
        Err(Failure::Usage(message))
    }
}

/// Fails where the pictures of a film are more than are kept.
///
/// # Errors
/// How many pixels there may be.
pub fn few_enough(window: Window, pictures: u32) -> Outcome<()> {
    no_more_than(MOST, "a film has", pictures)?;
    let pixels = window.count() as u64 * u64::from(pictures);
    if pixels <= PIXELS {
        return Ok(());
    }
    let most = PIXELS / window.count().max(1) as u64;
    Err(Failure::Usage(format!(
        "--pictures {pictures}: of pictures so large there may be {}; say fewer, or fewer --rows",
        count(most)
    )))
}

/// The same of a program that is followed.
///
/// # Errors
/// How many pictures there may be.
pub fn few_to_follow(pictures: u32) -> Outcome<()> {
    no_more_than(FOLLOWED, "a program is followed for", pictures)
}

fn no_more_than(most: u32, what: &str, pictures: u32) -> Outcome<()> {
    if pictures <= most {
        return Ok(());
    }
    let most = count(u64::from(most));
    let message = format!("--pictures {pictures}: {what} {most} at most");
    Err(Failure::Usage(message))
}

/// Pictures in words: `1 picture`, `1,000 pictures`.
pub fn pictures_in_words(pictures: u32) -> String {
    match pictures {
        1 => "1 picture".to_owned(),
        n => format!("{} pictures", count(u64::from(n))),
    }
}

/// What is said of a graph that a target cannot move.
pub fn refused(graph: &Graph, target: &Target, refines: bool) -> Option<Diagnostic> {
    let (state, _) = graph.steps().next()?;
    let span = graph.params.get(state.0 as usize).map(|p| p.span);
    let wrong = |message: String| Diagnostic::error(span.unwrap_or_default(), message);
    if !target.moves {
        let able: BTreeSet<&str> = every().filter(|t| t.moves).map(|t| t.name).collect();
        let able: Vec<&str> = able.into_iter().collect();
        let message = format!(
            "the scene moves, and programs for {} do not yet",
            target.name
        );
        return Some(wrong(message).help(format!(
            "those for {} do; `run`, `render` and `build --still` have its first picture",
            able.join(", ")
        )));
    }
    let what = match graph.diffusion {
        Some(_) => "its dither spreads errors from pixel to pixel",
        None if refines => "--refine leaves pixels out",
        None => return None,
    };
    Some(wrong(format!(
        "the scene moves, and {what}: that is not done together yet"
    )))
}

/// Fails where a scene has nothing that moves.
///
/// # Errors
/// Where its graph is of one picture.
pub fn must_move(graph: &Graph) -> Outcome<()> {
    match graph.is_moving() {
        true => Ok(()),
        false => Err(Failure::Usage(
            "--pictures: nothing moves in this scene; it has neither a `state` nor `picture`"
                .to_owned(),
        )),
    }
}
