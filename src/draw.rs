//! The pictures that the compiler's own evaluations make, rows in parallel;
//! where a scene spreads its dither's error, in order from the first row.

use crate::failure::{Failure, Outcome};
use crate::interrupt;
use crate::picture::Picture;
use crate::progress::Progress;
use rayon::prelude::*;
use slowlight_compiler::eval::native::{Native, Pixel};
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::planner::PlannedScene;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// Stack of a thread that compiles or evaluates, in bytes: deep scenes recurse.
pub const STACK: usize = 256 << 20;

/// Part of a picture, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// First and last column.
    pub columns: (u32, u32),
    /// First and last row.
    pub rows: (u32, u32),
}

impl Window {
    /// A whole picture.
    pub fn whole(width: u32, height: u32) -> Window {
        Window {
            columns: (0, width.saturating_sub(1)),
            rows: (0, height.saturating_sub(1)),
        }
    }

    /// What a plan computes: of a picture of blocks, the blocks.
    pub fn of(plan: &Plan) -> Window {
        Window {
            columns: plan.columns,
            rows: plan.rows,
        }
    }

    /// What a plan draws, in pixels.
    pub fn on_screen(plan: &Plan) -> Window {
        Window::of(plan).times(plan.graph.image.block)
    }

    /// A window of blocks in pixels.
    pub fn times(self, (wide, high): (u32, u32)) -> Window {
        let pixels = |(first, last): (u32, u32), size: u32| (first * size, (last + 1) * size - 1);
        Window {
            columns: pixels(self.columns, wide),
            rows: pixels(self.rows, high),
        }
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.columns.1 - self.columns.0 + 1
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.rows.1 - self.rows.0 + 1
    }

    /// Pixels.
    pub fn count(&self) -> usize {
        self.width() as usize * self.height() as usize
    }

    /// Up to `side` rows of as many columns, spread evenly, row by row.
    pub fn grid(&self, side: u32) -> Vec<(i32, i32)> {
        let along = |(first, last): (u32, u32)| {
            let count = last - first + 1;
            let taken = count.min(side);
            (0..taken).map(move |k| (first + (2 * k + 1) * count / (2 * taken)) as i32)
        };
        let row = |y| along(self.columns).map(move |x| (x, y));
        along(self.rows).flat_map(row).collect()
    }

    /// The same in an order of rows of which any beginning is spread over the picture: for who
    /// may have to stop before the last.
    pub fn grid_coarse_first(&self, side: u32) -> Vec<(i32, i32)> {
        let grid = self.grid(side);
        let rows: Vec<&[(i32, i32)]> = grid.chunk_by(|(_, a), (_, b)| a == b).collect();
        coarse_first(rows).concat()
    }

    /// Where its pixels are, row by row.
    pub fn places(&self) -> impl Iterator<Item = (u32, u32)> + use<> {
        let (columns, rows) = (self.columns, self.rows);
        (rows.0..=rows.1).flat_map(move |y| (columns.0..=columns.1).map(move |x| (x, y)))
    }
}

/// In an order of which any beginning is spread evenly.
pub fn coarse_first<T>(all: Vec<T>) -> Vec<T> {
    let mut all: Vec<(u32, T)> = (0..).zip(all).collect();
    all.sort_by_key(|(k, _)| k.reverse_bits());
    all.into_iter().map(|(_, each)| each).collect()
}

/// Inks and shades, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// What part of the picture.
    pub window: Window,
    /// The inks' colours.
    pub palette: Vec<[u8; 3]>,
    /// A pixel each.
    pub pixels: Vec<Pixel>,
    /// How many of them were traced, where that may be less than all.
    pub traced: Option<u64>,
}

impl Drawn {
    /// The inks alone.
    pub fn picture(&self) -> Picture {
        Picture {
            width: self.window.width(),
            height: self.window.height(),
            palette: self.palette.clone(),
            inks: self.pixels.iter().map(|p| p.ink).collect(),
        }
    }
}

/// Runs work on a thread of its own, whose stack is deep enough for any scene.
///
/// # Errors
/// What the work says, or that no thread could be had.
pub fn deep<T: Send>(work: impl FnOnce() -> Outcome<T> + Send) -> Outcome<T> {
    let none = |e: std::io::Error| Failure::Wrong(format!("cannot start a thread: {e}"));
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new()
            .stack_size(STACK)
            .spawn_scoped(scope, work)
            .map_err(none)?;
        match thread.join() {
            Ok(done) => done,
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

/// Lets rayon's threads have deep stacks too. To be called once, first.
pub fn set_up_threads() {
    // Fails only where a pool exists, as in a test; then that one serves.
    let _ = rayon::ThreadPoolBuilder::new()
        .stack_size(STACK)
        .build_global();
}

/// The native picture of a graph.
///
/// # Errors
/// Only an interruption.
pub fn native(graph: &Graph, window: Window) -> Outcome<Drawn> {
    Ok(native_counted(graph, window)?.0)
}

/// The same, and how many operations it took. A window of a picture of blocks is of
/// blocks; its picture has all their pixels.
///
/// # Errors
/// Only an interruption.
pub fn native_counted(graph: &Graph, window: Window) -> Outcome<(Drawn, u64)> {
    let operations = AtomicU64::new(0);
    let counted = &operations;
    let pixels = rows("native picture", graph, window, || {
        let mut native = Native::new(graph);
        let mut before = 0;
        move |columns, y, out| {
            native.pixels(columns, y, out);
            counted.fetch_add(native.operations() - before, Ordering::Relaxed);
            before = native.operations();
        }
    })?;
    let block = graph.image.block;
    let drawn = Drawn {
        window: window.times(block),
        palette: graph.image.palette.clone(),
        pixels: enlarged(pixels, window.width(), block),
        traced: None,
    };
    Ok((drawn, operations.into_inner()))
}

/// The picture of a plan in its routines' models; the shades are computed for
/// their own sake where the plan gets its inks without.
///
/// # Errors
/// Only an interruption.
pub fn model(plan: &PlannedScene) -> Outcome<Drawn> {
    model_with(plan, plan.shaded().as_deref())
}

/// The same with the shades of a plan that is known already, since to make one may take
/// long; without one, the plan's own, whatever they are.
///
/// # Errors
/// Only an interruption.
pub fn model_with(plan: &Plan, shaded: Option<&Plan>) -> Outcome<Drawn> {
    let (mut pixels, traced) = modelled("model", plan)?;
    if let Some(shaded) = shaded {
        for (pixel, other) in pixels.iter_mut().zip(modelled("shades", shaded)?.0) {
            pixel.shade = other.shade;
        }
    }
    Ok(Drawn {
        window: Window::on_screen(plan),
        palette: plan.graph.image.palette.clone(),
        pixels: enlarged(pixels, Window::of(plan).width(), plan.graph.image.block),
        traced: plan.graph.refinement.map(|_| traced),
    })
}

/// Each pixel of a picture so wide as a block of pixels.
fn enlarged(pixels: Vec<Pixel>, width: u32, (wide, high): (u32, u32)) -> Vec<Pixel> {
    if (wide, high) == (1, 1) {
        return pixels;
    }
    let mut out = Vec::with_capacity(pixels.len() * (wide * high) as usize);
    for row in pixels.chunks(width.max(1) as usize) {
        let line: Vec<Pixel> = row
            .iter()
            .flat_map(|pixel| std::iter::repeat_n(*pixel, wide as usize))
            .collect();
        (0..high).for_each(|_| out.extend_from_slice(&line));
    }
    out
}

/// A plan's picture, and how many of its pixels were traced.
fn modelled(what: &'static str, plan: &Plan) -> Outcome<(Vec<Pixel>, u64)> {
    let traced = AtomicU64::new(0);
    let counted = &traced;
    let pixels = rows(what, &plan.graph, Window::of(plan), || {
        let mut model = ModelRun::new(plan);
        move |columns, y, out| {
            let before = model.traced();
            out.extend(columns.map(|x| model.pixel(x, y)));
            counted.fetch_add(model.traced() - before, Ordering::Relaxed);
        }
    })?;
    Ok((pixels, traced.into_inner()))
}

/// Pixels that are drawn between looks at whether Ctrl-C was pressed.
const BLOCK: usize = 64;

/// Into how many parts a window is cut, for threads to take.
const SHARES: usize = 32;

/// Evaluates a window, each thread with an evaluation of its own, which is
/// given some columns of a row and where to put their pixels. An evaluation
/// that spreads errors draws by itself what comes before the window, so only
/// one thread draws then.
fn rows<E>(
    what: &'static str,
    graph: &Graph,
    window: Window,
    start: impl Fn() -> E + Sync + Send,
) -> Outcome<Vec<Pixel>>
where
    E: FnMut(Range<i32>, i32, &mut Vec<Pixel>),
{
    let progress = Progress::new(what, u64::from(window.height()));
    // Starting an evaluation costs a walk over the graph: not for each row. What is started
    // is counted, so it hangs on no number of threads.
    let shares = match graph.diffusion {
        Some(_) => 1,
        None => SHARES,
    };
    let share = (window.height() as usize).div_ceil(shares);
    // A row between key rows wants those around it: a share is as many rows as some bands.
    let band = graph.refinement.map_or(1, |r| 4 * r.step as usize);
    let share = share.next_multiple_of(band);
    let rows: Vec<u32> = (window.rows.0..=window.rows.1).collect();
    let job = interrupt::job();
    let stopped = || interrupt::ends() || job.as_ref().is_some_and(interrupt::Job::is_stopped);
    let parts: Vec<Option<Vec<Pixel>>> = rows
        .par_chunks(share.max(1))
        .map(|rows| {
            let mut pixels = start();
            let (from, to) = (window.columns.0 as i32, window.columns.1 as i32 + 1);
            let mut out = Vec::with_capacity(rows.len() * window.width() as usize);
            for &y in rows {
                for x in (from..to).step_by(BLOCK) {
                    if stopped() {
                        return None;
                    }
                    pixels(x..to.min(x + BLOCK as i32), y as i32, &mut out);
                }
                progress.step(1);
            }
            Some(out)
        })
        .collect();
    let all: Option<Vec<Vec<Pixel>>> = parts.into_iter().collect();
    Ok(all.ok_or(Failure::Interrupted)?.concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operations_are_the_same_by_any_number_of_threads() {
        let text = "image 40 x 30 inks black, white;\n\
            param turn: angle = 0.05turn in 0turn .. 1turn;\n\
            draw (x, y) = threshold(0.5 + 0.3 * cos(turn) * sin(turn) + x / 200, bayer(2)[x mod 2, y mod 2]);\n";
        let scene = slowlight_compiler::scene::check("turned", text);
        let graph = scene.lower(&Default::default()).expect("a graph");
        let counted = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let draw = || native_counted(&graph, Window::whole(40, 30)).expect("a picture");
            pool.expect("threads").install(draw).1
        };
        assert_eq!(counted(1), counted(3));
    }
}
