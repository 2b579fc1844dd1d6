//! Dynamic range profiling: what values are at pixels spread over the picture, with the params in
//! many places of their ranges, and what the picture asks of them there.
//!
//! Where a few are far larger than all others, as quotients beside a horizon are, room for
//! these would cost all others their digits: they are cut where that loses less. What is
//! larger than all others by agreement, 1e6 for "nothing was hit", is asked for no more than
//! what it is compared with.

use super::watch::Watch;
use crate::analysis::carried::{Readers, held_by, readers};
use crate::analysis::points::widths::Widths;
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::wordlength::histogram::{BRIEF, Seen};
use crate::wordlength::low_discrepancy::scattered;
use crate::wordlength::rates::{Often, often};
use crate::wordlength::scales;
use crate::wordlength::uniform::shared;
use rayon::prelude::*;
use slowlight_routine::scale::{finest, fitting};
use slowlight_routine::{Op, Type};

/// Rows and columns that are looked at, the picture's borders among them.
const LOOKED_AT: [u32; 2] = [24, 31];

/// The same where nothing is chosen anew and a value has more than 16 bits: a digit more
/// counts for so little there that what few pixels have is worth its room.
const CLOSELY: [u32; 2] = [80, 101];

/// How often params are chosen anew.
const CHOICES: u32 = 12;

/// In how many parts, which may be looked at at the same time, where they are not.
const PARTS: u32 = 4;

/// How many statements may run, all choices together: for a plan that is to be run, and for
/// one that is only judged.
pub const PATIENCE: u64 = 3_000_000;
pub const DRAFT: u64 = 1_000_000;

/// How many values may be followed back, for each statement that may run: what is computed
/// once a picture or row is followed back for each pixel.
const FOLLOWED: u64 = 20;

/// How many more the pixel may run at which these end.
const LAST: u64 = 2_000_000;

/// What each node's value is expected to stay within.
pub struct Expected {
    /// In so many bits; nothing where none was asked for.
    pub ends: Vec<Option<f64>>,
    /// With room for all that was asked for.
    pub all: Vec<f64>,
    /// The fraction bits that values share in loops.
    pub shared: Vec<Option<i8>>,
}

/// What values are at the pixels looked at.
pub struct Sample {
    seen: Vec<Seen>,
    pixels: f64,
}

impl Sample {
    /// Of no pixel.
    fn none(graph: &Graph) -> Sample {
        Sample {
            seen: vec![Seen::default(); graph.nodes.len()],
            pixels: 0.0,
        }
    }

    /// Of another's pixels too.
    fn with(mut self, other: Sample) -> Sample {
        for (seen, other) in self.seen.iter_mut().zip(&other.seen) {
            seen.add(other);
        }
        self.pixels += other.pixels;
        self
    }
    /// How many pixels were looked at; what counts for several is several.
    #[cfg(test)]
    pub fn pixels(&self) -> f64 {
        self.pixels
    }
}

/// Looks at pixels, for values of so many bits at most, until so many statements have run. The
/// parts are the same on any number of threads, and are added up in their order.
pub fn seen(graph: &Graph, tree: &Tree, bits: u8, most: u64) -> Sample {
    let is_live = |p: &Param| p.range.is_some() || p.ty == Type::Bool;
    let live = graph.params.iter().any(is_live);
    let [choices, parts] = if live { [CHOICES, 1] } else { [1, PARTS] };
    let looked_at = match !live && bits > BRIEF {
        true => CLOSELY,
        false => LOOKED_AT,
    };
    // What pixels send is looked at, but not carried through the whole picture.
    let alone = Graph {
        diffusion: None,
        refinement: None,
        ..graph.clone()
    };
    let look = Look {
        graph,
        alone: &alone,
        tree,
        carried: readers(graph),
        often: often(graph, tree),
        looked_at,
        parts,
        most: most / u64::from(choices * parts),
    };
    let jobs: Vec<[u32; 2]> = (0..choices)
        .flat_map(|choice| (0..parts).map(move |part| [choice, part]))
        .collect();
    let seen = jobs.into_par_iter().map(|job| look.at(job));
    let mut samples = seen.collect::<Vec<Sample>>().into_iter();
    let first = samples.next().unwrap_or_else(|| Sample::none(graph));
    samples.fold(first, Sample::with)
}

/// What a sample is taken of, and how much of it by each part.
struct Look<'g> {
    graph: &'g Graph,
    /// The same without what pixels leave to others.
    alone: &'g Graph,
    tree: &'g Tree,
    carried: Readers,
    often: Vec<Often>,
    /// Rows and columns.
    looked_at: [u32; 2],
    parts: u32,
    /// How many statements a part may run.
    most: u64,
}

impl Look<'_> {
    /// Looks at every so many-th of the scattered pixels, with the params chosen so.
    fn at(&self, [choice, part]: [u32; 2]) -> Sample {
        let Look { graph, most, .. } = *self;
        let watch = Watch::new((graph, self.tree), &self.carried, &self.often, choice);
        let mut sample = Sample::none(graph);
        // The scene's own params count as much as all others.
        let times = f64::from(if choice == 0 { CHOICES - 1 } else { 1 });
        let last = LAST / u64::from(self.parts);
        let mut run = Run::within(self.alone, self.tree, &watch, most + last);
        let begun = watch.kept();
        let mut now = None;
        let mut followed = 0;
        let [rows, columns] = self.looked_at;
        let all = scattered([columns, rows], choice, CHOICES);
        for (column, row) in all.skip(part as usize).step_by(self.parts as usize) {
            if watch.ran() >= most || followed >= FOLLOWED * most {
                break;
            }
            let [x, y] = [
                (column, columns, graph.image.width),
                (row, rows, graph.image.height),
            ]
            .map(|(k, of, long)| {
                (u64::from(k) * u64::from(long.max(1) - 1) / u64::from(of - 1)) as i32
            });
            if now.replace(y) != Some(y) {
                watch.end_row(begun);
            }
            let ink = run.pixel(x, y);
            // One that goes on for longer than all of them may is not followed back.
            if run.spent() && sample.pixels > 0.0 {
                break;
            }
            let sent = graph.shares().filter_map(|s| run.last(s.node));
            watch.send(sent);
            let told = graph.reports.iter().filter_map(|id| run.last(*id));
            watch.tell(told);
            sample.pixels += times;
            followed += watch.kept() as u64;
            watch.ask(ink, &mut |id, x, asked| {
                if let Some(seen) = sample.seen.get_mut(id.0 as usize) {
                    seen.see(x, asked, times);
                }
            });
        }
        sample
    }
}

/// What values are expected to stay within in so many bits.
pub fn expected(scene: (&Graph, &Tree), sample: &Sample, widths: &Widths) -> Expected {
    let mut ends = chosen(scene, sample, widths);
    let seen = (&sample.seen[..], sample.pixels);
    Expected {
        shared: shared(scene, seen, widths, &mut ends),
        ends,
        all: sample.seen.iter().map(Seen::room).collect(),
    }
}

/// What the values are expected to stay within, in as many fraction bits as serve best.
fn chosen(
    (graph, tree): (&Graph, &Tree),
    Sample { seen, pixels }: &Sample,
    widths: &Widths,
) -> Vec<Option<f64>> {
    let carried = readers(graph);
    let mut given: Vec<Vec<NodeId>> = vec![Vec::new(); graph.nodes.len()];
    for block in tree.blocks() {
        walk(block, &mut |statement| {
            if let Statement::Set {
                place,
                from: Origin::Node(from),
            } = statement
                && let Some(id) = held_by(&carried, *place)
                && let Some(given) = given.get_mut(id.0 as usize)
            {
                given.push(*from);
            }
        });
    }
    let mut most = vec![None; graph.nodes.len()];
    let mut room = vec![finest(widths.most()); graph.nodes.len()];
    for id in graph.ids().filter(|id| graph.ty(*id) == Type::Real) {
        let (at, bits) = (id.0 as usize, widths.value(id));
        let full = fitting(seen[at].room(), bits);
        // More bits than what a value is made of gives it serve nothing.
        let cap = match graph.node(id) {
            Node::Apply(op, args) => scales::uncut(graph, (op, args), (full, bits), &room),
            _ => {
                let all = given[at].iter().map(|from| room[from.0 as usize]);
                all.max().unwrap_or(finest(bits))
            }
        };
        if let Some(end) = seen[at].expected(cap, bits, *pixels) {
            (room[at], most[at]) = (fitting(end, bits), Some(end));
        }
    }
    // The last round only raises: then it holds for all.
    for round in (0..ROUNDS).rev() {
        ends_passed_on(graph, (seen, &given), widths, round > 0, &mut most);
    }
    most
}

/// How often it is looked at what is cut where it goes.
const ROUNDS: u32 = 6;

/// What is cut is cut no lower than where it goes: what ends there is told from what does
/// not. Either what goes there is cut less, or what it goes to is cut as well, if that may
/// be and costs less.
fn ends_passed_on(
    graph: &Graph,
    (seen, given): (&[Seen], &[Vec<NodeId>]),
    widths: &Widths,
    may_cut: bool,
    most: &mut [Option<f64>],
) {
    let cost = |at: usize, end: f64| {
        let bits = widths.value(NodeId(at as u32));
        seen[at].cost(fitting(end, bits), bits)
    };
    for id in graph.ids().rev() {
        let passed = match graph.node(id) {
            Node::Apply(Op::Min | Op::Max, args) => args.to_vec(),
            Node::Apply(Op::Neg | Op::Abs, [a, _]) => vec![a],
            _ => given[id.0 as usize].clone(),
        };
        for from in passed {
            let (at, to) = (from.0 as usize, id.0 as usize);
            let (Some(held), Some(end)) = (most[at], most[to]) else {
                continue;
            };
            let least = end.min(seen[at].room());
            if held >= least {
                continue;
            }
            let raised = cost(at, least) - cost(at, held);
            let lowered = cost(to, held) - cost(to, end);
            match may_cut && lowered < raised {
                true => most[to] = Some(held),
                false => most[at] = Some(least),
            }
        }
    }
}
