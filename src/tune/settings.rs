//! The settings that are worth a machine's time: each is drawn in `f64` first.
//!
//! That a picture of blocks, or one with fewer turns of loops, is off by so much is known
//! before any machine runs, and so is how many operations it takes. What is no better than
//! another setting in either goes no further.

use super::bands::{bands, share};
use super::choice::Setting;
use super::point::Natives;
use crate::draw::{Drawn, Window, native_counted};
use crate::failure::{Failure, Outcome};
use crate::measure::{Errors, errors};
use crate::progress::Progress;
use crate::scene::{Limits, Precision, Scene};
use crate::target_args::Refining;
use serde::{Deserialize, Serialize};
use slowlight_compiler::eval::native::Pixel;
use slowlight_compiler::ir::graph::{Graph, Image};
use slowlight_compiler::passes::pixel_blocks::pixel_blocks;
use slowlight_compiler::passes::refine::refine;
use slowlight_compiler::sema::{Millionths, Search, Ways};

/// The areas that blocks have, in pixels.
const AREAS: [u32; 13] = [1, 2, 4, 8, 9, 16, 25, 32, 64, 128, 256, 512, 1024];

/// How far key rows are from each other where not every pixel is traced, and by how many levels
/// neighbours may differ.
const REFINED: [(u32, u8); 6] = [(4, 4), (8, 8), (8, 16), (8, 32), (8, 64), (8, 255)];

/// Turns that loops may be cut to.
const TURNS: [u32; 13] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96];

/// Steps of a march in place of the shapes' own solutions, and what is near enough.
const MARCHES: [u32; 2] = [16, 64];
const NEARS: [Millionths; 2] = [Millionths(100_000), Millionths(10_000)];

/// How far apart differences are in the place of gradients.
const APARTS: [Millionths; 3] = [Millionths(100_000), Millionths(20_000), Millionths(5_000)];

/// Rays a pixel, where the library draws it by several.
const SAMPLES: [u32; 4] = [1, 4, 9, 16];

/// How much better a setting must be in both ways to leave another out: what a machine
/// makes of them may be otherwise by as much.
const CLEARLY: f64 = 0.9;

/// The settings that go to the machines, and those that do not.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Drafts {
    /// What is worth a machine's time.
    pub chosen: Vec<Drafted>,
    /// What is not: others clearly beat it, or are like it and take less work.
    pub left: Vec<Drafted>,
    /// Operations of the scene as written.
    pub whole_work: u64,
}

/// A setting, and what it is in `f64`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drafted {
    /// The setting.
    pub setting: Setting,
    /// Operations of the native evaluation.
    pub work: u64,
    /// What is lost by the setting alone.
    pub errors: Errors,
}

/// What is asked of settings.
#[derive(Clone, Copy, Debug)]
pub struct Asked {
    /// The screen's inks.
    pub inks: u32,
    /// How many settings at most.
    pub most: usize,
    /// How many operations drawing them may take: where whole pictures take more, bands of
    /// their rows are drawn.
    pub operations: f64,
}

/// The settings of a scene that may be worth their time by an error, spread over the work that
/// they take.
///
/// # Errors
/// Only an interruption.
pub fn worthwhile(
    scene: &Scene,
    natives: &Natives,
    error: &dyn Fn(&Errors) -> f64,
    asked: &Asked,
) -> Outcome<Drafts> {
    let (width, height) = scene.size();
    let truth = natives.of(scene, asked.inks, Window::whole(width, height))?;
    let limits = limits(scene, asked.inks)?;
    let graph = scene.graph(Some(asked.inks), Precision::NATIVE)?;
    let share = rows_share(&graph, limits.len(), asked.operations)?;
    let truth = Truth {
        drawn: &truth,
        share,
    };
    let blocks = blocks(&graph, &truth, error)?;
    let each = blocks.len() + refined(&graph).len();
    let progress = Progress::new("settings", (limits.len() * each) as u64);
    let mut all = Vec::new();
    for (graph, limit) in &limits {
        let each = blocks.iter().map(|block| (*block, None));
        let refined = refined(graph).into_iter().map(|one| ((1, 1), Some(one)));
        for (block, refine) in each.chain(refined) {
            let setting = Setting {
                block,
                refine,
                max_turns: limit.turns,
                max_steps: limit.steps,
                ways: limit.ways.into(),
            };
            all.push(drafted(graph, setting, &truth)?);
            progress.step(1);
        }
    }
    let chosen = spread(kept(all.clone(), error), error, asked.most);
    let whole = all.iter().find(|one| one.setting == Setting::WHOLE);
    let whole_work = whole.map_or(0, |one| one.work);
    all.retain(|one| !chosen.contains(one));
    Ok(Drafts {
        chosen,
        left: all,
        whole_work,
    })
}

/// The picture as written, and whether settings are drawn on bands of rows only, each of one
/// row in so many.
struct Truth<'t> {
    drawn: &'t Drawn,
    share: Option<u32>,
}

/// Rows of blocks from which on some stand for all.
const MANY: u32 = 8;

impl Truth<'_> {
    /// The windows, of blocks, that are drawn of a picture.
    fn windows(&self, image: &Image) -> Vec<Window> {
        let whole = Window::whole(image.width, image.height);
        match self.share {
            Some(share) if image.height >= MANY => {
                let bands = bands(whole.rows, share).into_iter();
                bands.map(|rows| Window { rows, ..whole }).collect()
            }
            _ => vec![whole],
        }
    }

    /// The rows of a window of blocks.
    fn pixels(&self, window: Window, block: (u32, u32)) -> &[Pixel] {
        let Window { rows, .. } = window.times(block);
        let width = self.drawn.window.width() as usize;
        let (from, to) = (rows.0 as usize * width, (rows.1 as usize + 1) * width);
        self.drawn.pixels.get(from..to).unwrap_or_default()
    }
}

/// How much dearer all blocks of a way are than its pixels: the sum of their areas' inverses,
/// with room for the shapes that each area has.
const BLOCKS: f64 = 2.5;

/// What part of its pixels a picture has traced that is refined, about.
const TRACED: f64 = 0.4;

/// What share of the rows settings are drawn on, one in so many in each of three bands; none for
/// whole pictures, where these take no more than so many operations, or where errors spread.
fn rows_share(graph: &Graph, limits: usize, most: f64) -> Outcome<Option<u32>> {
    let (_, work) = native_counted(graph, Window::whole(graph.image.width, graph.image.height))?;
    let all = work as f64 * limits as f64 * (BLOCKS + TRACED * refined(graph).len() as f64);
    let whole = all <= most || graph.diffusion.is_some();
    Ok((!whole).then(|| share(3.0 * all, most)))
}

/// The ways not to trace every pixel of a graph; none where it has no shade of its own.
fn refined(graph: &Graph) -> Vec<Refining> {
    let all = REFINED.map(|(step, tolerance)| Refining { step, tolerance });
    let can = |one: &Refining| refine(graph, one.step, one.tolerance).is_ok();
    all.into_iter().filter(can).collect()
}

/// Draws a setting.
fn drafted(graph: &Graph, setting: Setting, truth: &Truth<'_>) -> Outcome<Drafted> {
    let mut graph = pixel_blocks(graph, setting.block);
    if let Some(Refining { step, tolerance }) = setting.refine {
        graph = refine(&graph, step, tolerance).unwrap_or(graph);
    }
    let (mut drawn, mut native, mut work, mut rows) = (Vec::new(), Vec::new(), 0, 0);
    for mut window in truth.windows(&graph.image) {
        // Those that they hang on are drawn in any case.
        if let Some(refinement) = graph.refinement {
            window.rows = refinement.computed(window.rows, graph.image.height);
        }
        let (picture, operations) = native_counted(&graph, window)?;
        drawn.extend(picture.pixels);
        native.extend_from_slice(truth.pixels(window, setting.block));
        work += operations;
        rows += window.height();
    }
    let inks: Vec<u8> = drawn.iter().map(|p| p.ink).collect();
    let (width, levels) = (truth.drawn.window.width(), graph.image.palette.len());
    let errors = errors(width, &inks, &drawn, &native, levels);
    Ok(Drafted {
        setting,
        work: work * u64::from(graph.image.height) / u64::from(rows.max(1)),
        errors,
    })
}

/// A block of about 64 pixels that a picture is whole numbers of.
pub fn quick_block((width, height): (u32, u32)) -> Option<(u32, u32)> {
    let coarse = AREAS.into_iter().filter(|area| (16..=64).contains(area));
    coarse
        .rev()
        .find_map(|area| shapes(area, (width, height)).next())
}

/// The blocks of an area that a picture is whole numbers of.
fn shapes(area: u32, (width, height): (u32, u32)) -> impl Iterator<Item = (u32, u32)> {
    let sides = (1..=area).filter(move |wide| area.is_multiple_of(*wide));
    sides
        .map(move |wide| (wide, area / wide))
        .filter(move |(wide, high)| {
            let whole = width.is_multiple_of(*wide) && height.is_multiple_of(*high);
            // A block much longer than wide is off by its length.
            whole && *wide <= 2 * high && *high <= 2 * wide
        })
}

/// The scene's graph as written, and done with less or otherwise wherever that makes another.
fn limits(scene: &Scene, inks: u32) -> Outcome<Vec<(Graph, Limits)>> {
    let whole = scene.graph(Some(inks), Precision::NATIVE)?;
    let longest = whole.loops.iter().map(|l| l.max).max().unwrap_or(0);
    let mut all = vec![(whole, Limits::default())];
    for limit in fewer(longest).into_iter().chain(otherwise()) {
        let made = scene.graph_within(Some(inks), Precision::NATIVE, &[], limit);
        // What lowers as written may not otherwise: a shape without `dist` is not marched to.
        let Ok(graph) = made else {
            continue;
        };
        if all.iter().all(|(known, _)| *known != graph) {
            all.push((graph, limit));
        }
    }
    Ok(all)
}

/// Fewer turns of loops than the longest has.
fn fewer(longest: u32) -> Vec<Limits> {
    let turns = TURNS.into_iter().filter(|n| *n < longest);
    let each = turns.flat_map(|n| {
        let own = Limits {
            turns: Some(n),
            ..Limits::default()
        };
        let library = Limits {
            steps: Some(n),
            ..Limits::default()
        };
        [own, library]
    });
    each.collect()
}

/// What can be found in another way, one at a time.
fn otherwise() -> Vec<Limits> {
    let mut all = vec![Ways {
        search: Some(Search::Trace),
        ..Ways::default()
    }];
    for steps in MARCHES {
        all.extend(NEARS.map(|near| Ways {
            search: Some(Search::March { steps, near }),
            ..Ways::default()
        }));
    }
    all.extend(APARTS.map(|apart| Ways {
        differences: Some(apart),
        ..Ways::default()
    }));
    all.extend(SAMPLES.map(|n| Ways {
        samples: Some(n),
        ..Ways::default()
    }));
    let limits = |ways| Limits {
        ways,
        ..Limits::default()
    };
    all.into_iter().map(limits).collect()
}

/// Of each area the block that is least off.
fn blocks(
    graph: &Graph,
    truth: &Truth<'_>,
    error: &dyn Fn(&Errors) -> f64,
) -> Outcome<Vec<(u32, u32)>> {
    let size = (graph.image.width, graph.image.height);
    let mut found = Vec::new();
    for area in AREAS {
        let mut best: Option<(f64, (u32, u32))> = None;
        for block in shapes(area, size) {
            let setting = Setting {
                block,
                ..Setting::WHOLE
            };
            let off = error(&drafted(graph, setting, truth)?.errors);
            if best.is_none_or(|(least, _)| off < least) {
                best = Some((off, block));
            }
        }
        found.extend(best.map(|(_, block)| block));
    }
    if found.is_empty() {
        return Err(Failure::Wrong("the picture has no pixels".to_owned()));
    }
    Ok(found)
}

/// Without those that another clearly beats, or does not differ from in anything but that
/// it leaves more out.
fn kept(all: Vec<Drafted>, error: &dyn Fn(&Errors) -> f64) -> Vec<Drafted> {
    let beaten = |at: usize, one: &Drafted| {
        let (work, off) = (one.work as f64, error(&one.errors));
        all.iter().enumerate().any(|(k, other)| {
            let (w, e) = (other.work as f64, error(&other.errors));
            let clearly = w < CLEARLY * work && e <= CLEARLY * off && off > 0.0;
            let alike = k < at && other.work <= one.work && e <= off;
            clearly || alike
        })
    };
    let stays: Vec<bool> = (0..).zip(&all).map(|(k, one)| !beaten(k, one)).collect();
    let mut stays = stays.into_iter();
    let whole = |one: &Drafted| one.setting == Setting::WHOLE;
    all.into_iter()
        .filter(|one| stays.next() == Some(true) || whole(one))
        .collect()
}

/// Errors below this are as good as none.
const NO_ERROR: f64 = 1e-3;

/// At most so many, evenly over the logarithms of their work and error, as a plot has them; the
/// picture as written always.
fn spread(mut all: Vec<Drafted>, error: &dyn Fn(&Errors) -> f64, most: usize) -> Vec<Drafted> {
    all.sort_by(|a, b| b.work.cmp(&a.work).then(a.setting.cmp(&b.setting)));
    let work = |d: &Drafted| (d.work.max(1) as f64).ln();
    let off = |d: &Drafted| error(&d.errors).max(NO_ERROR).ln();
    let apart = |a: &Drafted, b: &Drafted| (work(a) - work(b)).hypot(off(a) - off(b));
    // The closest pair loses the one that is further off.
    while all.len() > most.max(1) {
        let pairs = all
            .windows(2)
            .enumerate()
            .filter(|(k, _)| *k > 0 || all.len() <= 2);
        let closest =
            pairs.min_by(|(_, a), (_, b)| apart(&a[0], &a[1]).total_cmp(&apart(&b[0], &b[1])));
        let Some((k, pair)) = closest else {
            break;
        };
        let first_is_better = error(&pair[0].errors) <= error(&pair[1].errors);
        // The cheapest of all stays: it is one end of what can be had.
        let last = k + 2 == all.len();
        let out = if first_is_better && !last { k + 1 } else { k };
        let is_whole = all[out].setting == Setting::WHOLE;
        all.remove(if is_whole { 2 * k + 1 - out } else { out });
    }
    all
}
