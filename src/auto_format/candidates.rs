//! The formats that a choice is made among, each judged by a plan without a search and a sample of
//! its pixels.

use crate::estimate::{self, Inked, Sampled};
use crate::interrupt;
use crate::need::{self, Need};
use crate::progress::Waiting;
use crate::scene::{Precision, Scene};
use crate::target_args::ScreenArgs;
use rayon::prelude::*;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::passes::pixel_blocks::pixel_blocks;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::{Lean, Target};
use slowlight_routine::Format;

/// Rows and columns of a candidate's sample and of its final plan's, and how many statements the
/// model may run for each.
pub(super) const CANDIDATE: (u32, u64) = (36, 8_000_000);
const FINAL: (u32, u64) = (64, 16_000_000);

/// The same where that is so near to the goal that other pixels may say otherwise.
const CLOSER: (u32, u64) = (160, 64_000_000);

/// By so many of its standard deviations a share that a sample tells may be less than the picture's.
const DEVIATIONS: f64 = 0.5;

/// How near, as a part of the goal, and as standard deviations of what a sample tells of a share
/// that is the goal.
const NEAR: (f64, f64) = (0.5, 2.0);

/// How many operations the native evaluation of a sample may take.
const NATIVE: u64 = 200_000_000;

/// In so many parts it is done at the same time.
const PARTS: usize = 2;

/// Of a sample one pixel in so many must have been looked at, or nothing is known.
const ENOUGH: usize = 8;

/// How much further than the goal a candidate may go: its final plan may be better, and the
/// sample is small.
const DOUBT: f64 = 1.5;

/// Where no more of the pixels are wrong, they are made in the same way.
const ALIKE: f64 = 0.1;

/// A candidate that takes no more than so many times as much without a search may be the quicker
/// one after it: a search in equal steps takes half in fixed point, by differences, and as much as
/// before in logarithms.
const CLOSE: f64 = 1.7;

/// A format as its plan without a search has it.
pub(super) struct Candidate {
    pub target: &'static Target,
    /// Of the picture, first and last, that the screen shows.
    pub rows: (u32, u32),
    /// What its program takes of the machine, in the mode with most room.
    pub need: Option<Need>,
    pub cycles: f64,
    pub wrong: f64,
}

impl Candidate {
    /// How large its program is.
    pub fn size(&self) -> u64 {
        self.need.as_ref().map_or(0, Need::total)
    }

    /// The smallest first, the exact ones last.
    pub fn order(&self) -> (bool, u64) {
        (self.target.last, self.size())
    }

    /// Its format, what it takes without a search, and its pixels wrong.
    pub fn seen(&self, wrong: f64) -> (&'static str, f64, f64) {
        (self.target.runtime.format, self.cycles, wrong)
    }

    /// Whether its plan may be within the goal.
    pub fn may(&self, goal: f64) -> bool {
        self.wrong <= DOUBT * goal
    }

    /// Whether it may be quicker in the end than what takes so many cycles without a search.
    pub fn is_close(&self, unsearched: f64) -> bool {
        self.cycles < CLOSE * unsearched
    }
}

/// Whether a format is of those that are looked at first.
pub(super) fn is_short(format: Format) -> bool {
    !format.is_long()
}

/// Whether it is one of those that only have more bits behind the point than another.
pub(super) fn is_finer(format: Format) -> bool {
    matches!(format, Format::Log { frac: 11.., .. })
}

pub(super) fn is_log(candidate: &Candidate) -> bool {
    matches!(candidate.target.runtime.real, Format::Log { .. })
}

/// The least that wider formats take: what those of 16 bits with a fixed point do, as each
/// operation takes longer in more bits; 0 where their pictures are so wrong that they may be
/// made by other turns of loops.
pub(super) fn least_of_wider(candidates: &[Candidate]) -> f64 {
    let alike = |one: &&Candidate| one.target.runtime.real.is_fixed() && one.wrong <= ALIKE;
    let alike = candidates.iter().filter(alike);
    alike.map(|one| one.cycles).reduce(f64::min).unwrap_or(0.0)
}

/// Of these formats those that a scene compiles for, in which its program is not by far too
/// large, and of which something is known: sorted. Those too large are in `left`.
pub(super) fn candidates(
    screen: &ScreenArgs,
    scene: &Scene,
    formats: &[&'static Target],
    goal: f64,
    left: &mut Vec<Candidate>,
) -> Vec<Candidate> {
    let (_waiting, _blind) = (Waiting::new("formats"), interrupt::blind());
    let job = interrupt::job();
    let sampled = |&target: &&'static Target| {
        if job.as_ref().is_some_and(interrupt::Job::is_stopped) {
            return None;
        }
        let mut plan = screen.unsearched(scene, target).ok()?;
        plan.lean = plan.target.lean == Lean::Calls;
        let modes = screen.modes(target, scene).ok()?;
        let need = need::first(&plan).ok()?;
        // Another mode may leave it more.
        let rooms = modes.iter().filter_map(|mode| need::room_in(&plan, *mode));
        let room = rooms.max().unwrap_or_default();
        let roomy = need.as_ref().map(|need| need.in_room(room));
        let near = need.iter().chain(&roomy).any(Need::is_near);
        if need.is_some() && !near {
            return Some(Err(Candidate {
                target: plan.target,
                rows: plan.rows,
                need: roomy,
                cycles: f64::INFINITY,
                wrong: 1.0,
            }));
        }
        let seen = estimate::sampled(&plan, CANDIDATE.0, CANDIDATE.1);
        Some(Ok((plan, roomy, seen)))
    };
    type Seen = (PlannedScene, Option<Need>, Sampled);
    let looked: Vec<Result<Seen, _>> = formats.par_iter().filter_map(sampled).collect();
    let mut all = Vec::new();
    for one in looked {
        match one {
            Ok(seen) => all.push(seen),
            Err(large) => left.push(large),
        }
    }
    // All look at the same pixels, as far as they come.
    let longest = all.iter().max_by_key(|(.., seen)| seen.inks.len());
    let native = longest.map_or(Vec::new(), |(plan, _, seen)| {
        native(scene, plan, &seen.inks)
    });
    let candidate = |(plan, need, seen): &Seen| {
        Some(Candidate {
            target: plan.target,
            rows: plan.rows,
            need: need.clone(),
            cycles: seen.cycles(),
            wrong: unlike((&seen.inks, seen.of), &native)?,
        })
    };
    let mut all: Vec<Candidate> = all.iter().filter_map(candidate).collect();
    sort(&mut all, goal);
    all
}

/// Those that may be within the goal come first, the quickest before the others; then those with
/// fewest pixels wrong.
pub(super) fn sort(all: &mut [Candidate], goal: f64) {
    all.sort_by(|a, b| match (a.may(goal), b.may(goal)) {
        (true, true) => a.cycles.total_cmp(&b.cycles),
        (false, false) => a.wrong.total_cmp(&b.wrong),
        (a, b) => b.cmp(&a),
    });
}

/// A share of a picture's pixels, as a sample of them tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Share {
    pub expected: f64,
    /// What it may be where the sample was a lucky one.
    pub most: f64,
    seen: usize,
}

impl Share {
    /// As so many of a picture's pixels say, of that share of them.
    fn of(share: f64, seen: usize, pixels: usize) -> Share {
        // What is drawn without replacement varies less, and not at all once all is drawn (Cochran,
        // Sampling Techniques, 1977, 3.2).
        let left = 1.0 - seen as f64 / pixels.max(seen).max(1) as f64;
        let variance = share * (1.0 - share) / seen.max(1) as f64 * left;
        Share {
            expected: share,
            most: share + DEVIATIONS * variance.sqrt(),
            seen: seen.max(1),
        }
    }
}

/// The share of a plan's pixels whose inks are not the native ones, by a sample that is the
/// larger the nearer that share is to the goal.
pub(super) fn expected(scene: &Scene, plan: &PlannedScene, goal: f64) -> Option<Share> {
    let (_waiting, _blind) = (Waiting::new("pixels"), interrupt::blind());
    let by = |(side, most): (u32, u64)| {
        let (inks, of) = estimate::inks(plan, side, most / PARTS as u64, PARTS);
        let share = unlike((&inks, of), &native(scene, plan, &inks))?;
        let rows = plan.rows.1 - plan.rows.0 + 1;
        let columns = plan.columns.1 - plan.columns.0 + 1;
        Some(Share::of(share, inks.len(), (rows * columns) as usize))
    };
    let first = by(FINAL)?;
    let most = (NEAR.0 * goal).max(NEAR.1 * (goal / first.seen as f64).sqrt());
    match (first.expected - goal).abs() < most {
        true => by(CLOSER).or(Some(first)),
        false => Some(first),
    }
}

/// The native inks of a sample, each by itself, since nothing is sent to it by others; of as
/// many as take no more work than is worth it.
fn native(scene: &Scene, plan: &PlannedScene, seen: &[Inked]) -> Vec<Option<u8>> {
    // What compiles for the machine compiles natively.
    let Ok(graph) = scene.graph(Some(plan.mode.inks), Precision::NATIVE) else {
        return Vec::new();
    };
    let mut graph = pixel_blocks(&graph, plan.graph.image.block);
    graph.part_pixels();
    // Rows are shared out among threads, each with its part of the work.
    let rows: Vec<&[Inked]> = seen.chunk_by(|a, b| a.1 == b.1).collect();
    let part = rows.len().div_ceil(PARTS).max(1);
    let known: Vec<Vec<Option<u8>>> = rows
        .par_chunks(part)
        .map(|rows| {
            let mut native = Native::within(&graph, NATIVE / PARTS as u64);
            let mut inks = Vec::new();
            for row in rows {
                let columns: Vec<i32> = row.iter().map(|(x, _, _)| *x as i32).collect();
                let mut pixels = Vec::new();
                native.scattered(&columns, row[0].1 as i32, &mut pixels);
                let known = !native.spent();
                inks.extend(pixels.iter().map(|pixel| known.then_some(pixel.ink)));
            }
            inks
        })
        .collect();
    known.concat()
}

/// The share of a sample's inks that are others than those; none where too few are known.
fn unlike((seen, of): (&[Inked], usize), native: &[Option<u8>]) -> Option<f64> {
    let pairs = seen.iter().zip(native);
    let pairs = pairs.filter_map(|((_, _, ink), native)| Some((*ink, (*native)?)));
    let (known, wrong) = pairs.fold((0, 0), |(known, wrong), (ink, native)| {
        (known + 1, wrong + usize::from(ink != native))
    });
    (known > 0 && known * ENOUGH >= of).then(|| wrong as f64 / known as f64)
}
