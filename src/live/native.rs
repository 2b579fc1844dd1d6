//! The worker for native pictures: reads what is wanted, says what is wrong, and draws, a
//! coarse picture first where the whole one takes long.

use super::board::{Board, Wish};
use super::said;
use super::shown::{Native as State, Stage};
use crate::draw::{Drawn, Window};
use crate::failure::{Failure, Outcome, Said};
use crate::interrupt::{self, Job};
use crate::picture::{FileFormat, png};
use crate::scene::{Precision, Scene};
use rayon::prelude::*;
use slowlight_compiler::eval::native::{Native, Pixel};
use slowlight_compiler::ir::graph::Graph;
use slowlight_routine::Type;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use web_time::Instant;

/// How long a whole picture may take for no coarse one to come before it.
const QUICK: Duration = Duration::from_millis(80);

/// How long a coarse picture may take.
const COARSE: Duration = Duration::from_millis(50);

/// Columns and rows for one pixel of coarse pictures, the coarsest first.
const STEPS: [u32; 3] = [16, 8, 4];

/// Operations for the coarsest picture at most, over all its rows: a quarter of a second.
const MOST: u64 = 50_000_000;

/// Rows that are drawn by one evaluation, and pixels between looks at whether to go on.
const ROWS: usize = 4;
const BLOCK: usize = 64;

/// Operations for a row of the whole picture at most: some tenths of a second.
const ROW: u64 = 50_000_000;

/// What is said of a picture that takes more.
const DEAR: &str =
    "this picture takes more work than the page gives it; `slowlight render` has no limit";

/// Parts that the rows of a coarse picture are shared out in.
const PARTS: usize = 8;

/// Why there is no picture.
pub fn refused(board: &impl Board, wish: &Wish, failure: Failure) {
    let serial = wish.serial;
    let (why, problems) = match failure {
        Failure::Interrupted => {
            return board.show_of(serial, |shown, _| shown.native.stage = Stage::Stopped);
        }
        Failure::Scene(said) | Failure::Options(said) => {
            let Said {
                sources,
                diagnostics,
            } = *said;
            (None, Some(said::problems(serial, &sources, &diagnostics)))
        }
        other => (Some(other.reason()), None),
    };
    board.show_of(serial, |shown, _| {
        if let Some(problems) = problems {
            shown.problems = problems;
        }
        shown.native.serial = serial;
        shown.native.stage = Stage::Wrong;
        shown.native.wrong = why;
        for panel in &mut shown.panels {
            panel.machine.stage = Stage::Idle;
        }
    });
}

/// A scene and its graph with values for its params. A param that is gone, or has become
/// another, has the value that the text gives it.
pub fn set(
    scene: Scene,
    usual: Graph,
    set: &BTreeMap<String, Vec<f64>>,
) -> Outcome<(Scene, Graph)> {
    let fits = |name: &str, values: &[f64]| {
        let scalars: Vec<Type> = usual
            .params
            .iter()
            .filter(|p| p.name == name)
            .map(|p| p.ty)
            .collect();
        let may_be = |(ty, value): (&Type, &f64)| match ty {
            Type::Bool => *value == 0.0 || *value == 1.0,
            Type::Int => value.fract() == 0.0,
            _ => true,
        };
        scalars.len() == values.len() && scalars.iter().zip(values).all(may_be)
    };
    let set = set.iter().filter(|(name, values)| fits(name, values));
    let set: Vec<(String, Vec<f64>)> = set.map(|(n, v)| (n.clone(), v.clone())).collect();
    if set.is_empty() {
        return Ok((scene, usual));
    }
    let scene = scene.setting(set)?;
    let graph = scene.graph(None, Precision::NATIVE)?;
    Ok((scene, graph))
}

/// Draws a wish: what comes first is drawn even where a newer wish is there already, so that
/// a hand that does not rest sees something.
pub fn drawn(board: &impl Board, wish: &Wish, job: &Job, scene: Scene) -> Outcome<Scene> {
    let serial = wish.serial;
    let usual = scene.graph(None, Precision::NATIVE)?;
    let sources = &scene.checked.sources;
    let problems = said::problems(serial, sources, &scene.checked.diagnostics);
    let params = said::params(sources, &scene.checked.program, &usual);
    let size = scene.size();
    board.show(|shown, _| {
        shown.problems = problems;
        shown.params = params;
    });
    let (scene, graph) = set(scene, usual, &wish.set)?;
    let window = Window::whole(size.0, size.1);
    let since = || u64::try_from(wish.at.elapsed().as_millis()).unwrap_or(u64::MAX);
    let state = |stage, picture| State {
        serial,
        stage,
        picture,
        size,
        ..State::default()
    };
    let mut first = None;
    let soon = soon(&graph, window);
    if let Soon::Coarse(coarse) = soon {
        first = Some(since());
        board.show(|shown, pictures| {
            pictures.native = Arc::new(coarse);
            shown.native = State {
                first_ms: first,
                ..state(Stage::Coarse, shown.native.picture + 1)
            };
        });
    } else if matches!(soon, Soon::Whole) && job.is_stopped() {
        // A quick picture is drawn in any case.
        let whole = whole(&graph, window, None)?;
        let png = whole.picture().encode(FileFormat::Png)?;
        board.show(|shown, pictures| {
            pictures.native = Arc::new(png);
            shown.native = state(Stage::Coarse, shown.native.picture + 1);
        });
        return Err(Failure::Interrupted);
    }
    let whole = whole(&graph, window, Some(job))?;
    let png = whole.picture().encode(FileFormat::Png)?;
    board.show(|shown, pictures| {
        pictures.native = Arc::new(png);
        shown.native = State {
            first_ms: first.or(Some(since())),
            whole_ms: Some(since()),
            ..state(Stage::Done, shown.native.picture + 1)
        };
    });
    Ok(scene)
}

/// The whole picture, as `render` draws it, if it takes no more work than a page gives it:
/// what is in the middle of a pixel is not stopped.
fn whole(graph: &Graph, window: Window, job: Option<&Job>) -> Outcome<Drawn> {
    let rows: Vec<u32> = (window.rows.0..=window.rows.1).collect();
    let share = match graph.is_in_order() {
        true => rows.len(),
        false => ROWS,
    };
    let most = ROW * share as u64;
    let over = AtomicBool::new(false);
    let stopped = || interrupt::ends() || job.is_some_and(Job::is_stopped);
    let parts: Outcome<Vec<Vec<Pixel>>> = rows
        .par_chunks(share.max(1))
        .map(|rows| {
            let mut native = Native::within(graph, most);
            let mut out = Vec::with_capacity(rows.len() * window.width() as usize);
            let end = window.columns.1 as i32 + 1;
            for y in rows {
                for x in (window.columns.0 as i32..end).step_by(BLOCK) {
                    if stopped() {
                        return Err(Failure::Interrupted);
                    }
                    if native.spent() || over.load(Ordering::Relaxed) {
                        over.store(true, Ordering::Relaxed);
                        return Err(Failure::Wrong(DEAR.to_owned()));
                    }
                    native.pixels(x..end.min(x + BLOCK as i32), *y as i32, &mut out);
                }
            }
            match native.spent() {
                true => Err(Failure::Wrong(DEAR.to_owned())),
                false => Ok(out),
            }
        })
        .collect();
    Ok(Drawn {
        window,
        palette: graph.image.palette.clone(),
        pixels: parts?.concat(),
        traced: None,
    })
}

/// What there is soon of a picture.
enum Soon {
    /// All of it.
    Whole,
    /// A coarse one, as a PNG.
    Coarse(Vec<u8>),
    /// Nothing: it is dear, or its pixels cannot be had one by one.
    Nothing,
}

/// A coarse picture, as fine as there is time for, unless the whole one is there as soon.
fn soon(graph: &Graph, window: Window) -> Soon {
    if graph.is_in_order() {
        return Soon::Nothing;
    }
    if window.count() < 64 * 64 {
        return Soon::Whole;
    }
    let mut best = None;
    for step in STEPS {
        let begun = Instant::now();
        let most = MOST / PARTS as u64;
        let Some(shades) = grid(graph, window, step, most) else {
            break;
        };
        let taken = begun.elapsed();
        // Starting takes its time, too, so that this is more than the whole picture takes.
        if taken * step.pow(2) < QUICK {
            return Soon::Whole;
        }
        best = Some((step, shades));
        if taken * 4 > COARSE {
            break;
        }
    }
    let Some((step, shades)) = best else {
        return Soon::Nothing;
    };
    let columns = window.width().div_ceil(step);
    let palette = &graph.image.palette;
    let rgb: Vec<u8> = (shades.iter())
        .flat_map(|pixel| between(palette, pixel.shade))
        .collect();
    let made = png(columns, window.height().div_ceil(step), None, &rgb);
    made.map_or(Soon::Nothing, Soon::Coarse)
}

/// A pixel for each square of so many, row by row; none where they take more operations.
fn grid(graph: &Graph, window: Window, step: u32, most: u64) -> Option<Vec<Pixel>> {
    let middle = |k: u32, count: u32| (k * step + step / 2).min(count - 1) as i32;
    let (width, height) = (window.width(), window.height());
    let columns: Vec<i32> = (0..width.div_ceil(step))
        .map(|k| middle(k, width))
        .collect();
    let rows: Vec<u32> = (0..height.div_ceil(step)).collect();
    let parts: Option<Vec<Vec<Pixel>>> = rows
        .par_chunks(rows.len().div_ceil(PARTS).max(1))
        .map(|rows| {
            let mut native = Native::within(graph, most);
            let mut out = Vec::with_capacity(rows.len() * columns.len());
            for row in rows {
                native.scattered(&columns, middle(*row, height), &mut out);
            }
            (!native.spent()).then_some(out)
        })
        .collect();
    Some(parts?.concat())
}

/// The colour of a shade between the inks, which are dark to light.
fn between(palette: &[[u8; 3]], shade: f64) -> [u8; 3] {
    let steps = palette.len().saturating_sub(1);
    let at = if shade.is_nan() {
        0.0
    } else {
        shade.clamp(0.0, 1.0)
    } * steps as f64;
    let low = (at.floor() as usize).min(steps);
    let ink = |k: usize| palette.get(k.min(steps)).copied().unwrap_or_default();
    let (a, b, part) = (ink(low), ink(low + 1), at - low as f64);
    std::array::from_fn(|k| {
        let (a, b) = (f64::from(a[k]), f64::from(b[k]));
        (a + (b - a) * part).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shades_are_between_inks() {
        let palette = [[0, 0, 0], [100, 0, 0], [200, 200, 200]];
        assert_eq!(between(&palette, 0.25), [50, 0, 0]);
        assert_eq!(between(&palette, 1.0), [200, 200, 200]);
        assert_eq!(between(&palette, f64::NAN), [0, 0, 0]);
        assert_eq!(between(&palette, 7.0), [200, 200, 200]);
    }
}
