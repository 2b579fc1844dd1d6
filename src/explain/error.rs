//! Each line's share of the picture's error, on a sample of its pixels.

use crate::draw::Window;
use crate::failure::{Failure, Outcome};
use crate::interrupt;
use crate::progress::Progress;
use crate::scene::{Precision, Scene};
use rayon::prelude::*;
use slowlight_compiler::eval::native::{Native, Pixel};
use slowlight_compiler::passes::pixel_blocks::pixel_blocks;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::report::raised::{RaisedRun, raisable};
use std::collections::BTreeMap;

/// Rows and columns of the sample; a small picture is looked at whole.
const GRID: u32 = 40;

/// How many statements may run for that, the runs of all lines together: a scene of many lines
/// or long loops is looked at at fewer pixels.
const MOST: u64 = 1_000_000_000;

/// The error of a picture and what of it goes with each line.
pub struct Errors {
    /// Pixels looked at.
    pub pixels: usize,
    /// The root of the mean square of model shade less native shade.
    pub rmse: f64,
    /// Inks unlike the native picture's.
    pub differ: usize,
    /// By file and line.
    pub lines: BTreeMap<(u16, usize), Without>,
}

/// The error with a line's values in `f64`.
#[derive(Clone, Copy, Debug)]
pub struct Without {
    /// What is left.
    pub rmse: f64,
    /// Inks unlike the native picture's.
    pub differ: usize,
    /// What share of the mean square is gone: 1 is all; below 0 it grew.
    pub share: f64,
}

/// Looks at a plan's error line by line.
///
/// # Errors
/// Where the scene does not compile, and an interruption.
pub fn errors(scene: &Scene, plan: &PlannedScene) -> Outcome<Errors> {
    // The program may compare without ever computing the shade.
    errors_with(scene, plan, plan.shaded().as_ref())
}

/// The same with the plan of the shades, where the program's own does not compute them.
///
/// # Errors
/// As for [`errors`].
pub fn errors_with(
    scene: &Scene,
    plan: &PlannedScene,
    shaded: Option<&PlannedScene>,
) -> Outcome<Errors> {
    let shaded = shaded.unwrap_or(plan);
    let lines: Vec<_> = raisable(&scene.checked, shaded).into_iter().collect();
    let each = MOST / (lines.len() as u64 + 2);
    let places = looked_at(shaded, each);
    let written = scene.graph(Some(plan.mode.inks), Precision::NATIVE)?;
    // What blocks leave out is no line's.
    let graph = pixel_blocks(&written, plan.graph.image.block);
    let mut native = Native::within(&graph, MOST);
    let native: Vec<Pixel> = places.iter().map(|(x, y)| native.pixel(*x, *y)).collect();
    let job = interrupt::job();
    let stopped = || interrupt::ends() || job.as_ref().is_some_and(interrupt::Job::is_stopped);
    let look = |nodes: Vec<bool>| -> Option<(f64, usize)> {
        let mut run = RaisedRun::within(shaded, nodes, 2 * each);
        let (mut squares, mut differ) = (0.0, 0);
        for ((x, y), native) in places.iter().zip(&native) {
            if stopped() {
                return None;
            }
            let pixel = run.pixel(*x, *y);
            squares += (pixel.shade - native.shade).powi(2);
            differ += usize::from(pixel.ink != native.ink);
        }
        Some((squares / places.len().max(1) as f64, differ))
    };
    let (square, differ) = look(Vec::new()).ok_or(Failure::Interrupted)?;
    let progress = Progress::new("errors by line", lines.len() as u64);
    let without = lines.into_par_iter().map(|(line, nodes)| {
        let (left, differ) = look(nodes)?;
        progress.step(1);
        let gone = if square > 0.0 {
            1.0 - left / square
        } else {
            0.0
        };
        let without = Without {
            rmse: left.sqrt(),
            differ,
            share: gone,
        };
        Some((line, without))
    });
    let lines: Option<BTreeMap<_, _>> = without.collect();
    Ok(Errors {
        pixels: places.len(),
        rmse: square.sqrt(),
        differ,
        lines: lines.ok_or(Failure::Interrupted)?,
    })
}

/// The pixels of a plan that are looked at: of a sample as many as so many statements reach,
/// spread over it, in the order of the scan.
fn looked_at(plan: &Plan, most: u64) -> Vec<(i32, i32)> {
    let window = Window::of(plan);
    let mut some = match plan.graph.is_in_order() {
        // Pixels want those before them.
        true => window.grid(GRID),
        false => window.grid_coarse_first(GRID),
    };
    let mut run = RaisedRun::within(plan, Vec::new(), most);
    let reached = some.iter().take_while(|(x, y)| {
        run.pixel(*x, *y);
        !run.spent()
    });
    some.truncate(reached.count());
    some.sort_unstable_by_key(|(x, y)| (*y, *x));
    some
}
