//! A machine's picture in the terminal, drawn over again while its program runs.

use crate::ascii;
use crate::draw::{Window, native};
use crate::failure::Outcome;
use crate::machine::Loaded;
use crate::picture::Picture;
use crate::say;
use crate::scene::{Precision, Scene};
use crate::show::{self, Means};
use crate::trial::{self, Trial};
use slowlight_compiler::planner::PlannedScene;
use std::time::{Duration, Instant};

/// How often it is drawn.
const FRAME: Duration = Duration::from_millis(200);

/// Frames that stand in one place of the terminal.
struct Frames {
    means: Means,
    /// Lines of the last one.
    lines: usize,
}

impl Frames {
    /// Draws a picture over the last one.
    fn draw(&mut self, picture: &Picture) -> Outcome<()> {
        let (columns, lines) = show::room();
        let text = show::text(picture, self.means, (columns, Some(lines)))?;
        let up = match self.lines {
            0 => String::new(),
            lines => format!("\x1b[{lines}A"),
        };
        self.lines = text.lines().count();
        // Another size than before leaves nothing of it below.
        say(&format!("{up}{text}\x1b[J"))
    }
}

/// Runs a program as [`trial::run`] does, and shows its picture: as it grows where the terminal
/// draws it of characters, else when it is done; as text where there is no terminal.
///
/// # Errors
/// As for [`trial::run`].
pub fn run(
    scene: &Scene,
    plan: PlannedScene,
    set: &[(String, Vec<f64>)],
    loaded: Loaded,
    limit: u64,
) -> Outcome<Trial> {
    let means = show::means();
    let mut frames = match means {
        Some(means @ (Means::Blocks | Means::Blocks256)) => Some(Frames { means, lines: 0 }),
        _ => None,
    };
    let graph = scene.graph_with(Some(plan.mode.inks), Precision::NATIVE, set)?;
    let run = match &mut frames {
        None => trial::ran(scene, &plan, loaded, limit)?,
        Some(frames) => {
            let mut last = Instant::now();
            trial::ran_watched(&plan, loaded, limit, &mut |now| {
                if last.elapsed() < FRAME {
                    return;
                }
                last = Instant::now();
                let screen = (now.screen)();
                // Before its first mode is set, a machine's screen does not hold the picture.
                if let Ok(picture) = trial::shown(&plan, screen.as_ref()) {
                    // What cannot be shown now is said at the end.
                    let _ = frames.draw(&picture);
                }
            })?
        }
    };
    let native = native(&graph, Window::on_screen(&plan))?;
    let trial = trial::held(scene, plan, run, native)?;
    if let Some(picture) = &trial.picture {
        match (&mut frames, means) {
            (Some(frames), _) => frames.draw(picture)?,
            (None, Some(means)) => say(&show::text(picture, means, (show::room().0, None))?)?,
            (None, None) => say(&ascii::text(picture, ascii::COLUMNS))?,
        }
    }
    Ok(trial)
}
