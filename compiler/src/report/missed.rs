//! Missed-optimization remarks: what the operations of a scene's line come to in a plan, and what
//! another plan of the same line does without.
//!
//! LLVM's passes say what they could not do where they gave up. Here two plans are held side by
//! side: that of the scene, and that of the scene with one thing more known, a range, a bound or
//! a constant. Operations are the same where they are one operation at one place of the source.
//! What the second plan computes with a cheaper routine, or not at all, is what the first could
//! not do for want of it.

use super::profile::lines_of;
use crate::eval::heard::{Heard, Listener};
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::ir::tree::{Statement, walk};
use crate::plan::Plan;
use crate::plan::model::Model;
use crate::scene::Scene;
use crate::source::Span;
use slowlight_routine::{Bits, Op, Range};
use std::cell::Cell;
use std::collections::BTreeMap;

/// How many statements may run to see how often operations do.
const MOST: u64 = 20_000_000;

/// A line: its file's number, and its own from 1.
pub type Place = (u16, usize);

/// An operation at a place of the source: where it stands, where in the library, and which.
type Key = (u32, u32, Option<(u16, u32)>, &'static str);

/// What an operation at one place of the source came to.
#[derive(Clone, Copy, Debug)]
pub struct Done {
    /// Which.
    pub op: Op,
    /// Where.
    pub span: Span,
    /// How often it ran at a pixel, in the mean.
    pub times: f64,
    /// What its routine takes, in the machine's cycles; of several copies the mean.
    pub cycles: f64,
    /// The routine of the copy that ran most often.
    pub routine: &'static str,
    /// What that copy's operands stay within, and where they are made.
    pub args: [Range; 2],
    /// What its result would stay within, did the format not cut it.
    pub exact: Range,
    /// The places of its operands.
    pub operands: [Span; 2],
    most: f64,
}

/// What the lines of a scene compute at the pixels of a plan, beside what rows and columns share.
#[derive(Clone, Debug, Default)]
pub struct Work {
    lines: BTreeMap<Place, BTreeMap<Key, Done>>,
}

impl Work {
    /// How many operations a line has at a pixel.
    pub fn operations(&self, line: Place) -> f64 {
        let all = self.lines.get(&line).into_iter().flatten();
        all.map(|(_, done)| done.times).sum()
    }
}

/// Runs a plan's model at some pixels, and notes what each line computes there. Places are told
/// as `told` has them: in the text of the scene that this one was made of.
pub fn work(
    scene: &Scene,
    plan: &Plan,
    pixels: &[(i32, i32)],
    told: &dyn Fn(Span) -> Span,
) -> Work {
    let graph = &Graph {
        diffusion: None,
        refinement: None,
        ..plan.graph.clone()
    };
    let heard = Heard {
        arithmetic: Model::of(plan),
        listener: Counted {
            times: vec![Cell::new(0); graph.nodes.len()],
        },
    };
    let mut run = Run::within(graph, &plan.tree, &heard, MOST).alone();
    let mut looked = 0;
    for (x, y) in pixels {
        run.pixel(*x, *y);
        if run.spent() {
            break;
        }
        looked += 1;
    }
    let tree = &plan.tree;
    let mut seldom = vec![false; graph.nodes.len()];
    for block in [&tree.frame, &tree.column, &tree.row, &tree.pass] {
        walk(block, &mut |s| {
            if let Statement::Let(id) = s {
                seldom[id.0 as usize] = true;
            }
        });
    }
    let lines = lines_of(scene);
    let mut found = Work::default();
    for id in graph.ids() {
        let at = id.0 as usize;
        let (Node::Apply(op, operands), Some(routine)) = (graph.node(id), plan.routine(id)) else {
            continue;
        };
        let times = heard.listener.times[at].get() as f64 / f64::from(looked.max(1));
        if seldom[at] || times == 0.0 {
            continue;
        }
        let line_of = lines.place(graph.span(id));
        let span = told(graph.span(id));
        let line = found.lines.entry(line_of).or_default();
        let key = (span.start, span.end, span.within, op.name());
        let done = line.entry(key).or_insert(Done {
            op,
            span,
            times: 0.0,
            cycles: 0.0,
            routine: routine.name,
            args: [Range::ALL; 2],
            exact: Range::ALL,
            operands: [span; 2],
            most: 0.0,
        });
        let cycles = done.cycles * done.times + f64::from(routine.cycles) * times;
        done.times += times;
        done.cycles = cycles / done.times;
        if times > done.most {
            done.most = times;
            done.routine = routine.name;
            done.args = plan.ranges.args.get(at).copied().unwrap_or(done.args);
            done.exact = plan.ranges.exact.get(at).copied().unwrap_or(done.exact);
            let place = |id: NodeId| told(graph.span(id));
            done.operands = match op.arity() {
                0 => [span; 2],
                1 => [place(operands[0]); 2],
                _ => operands.map(place),
            };
        }
    }
    found
}

/// Counts how often operations run.
struct Counted {
    times: Vec<Cell<u64>>,
}

impl Listener<Bits> for Counted {
    fn applied(&self, id: NodeId, _: Op, _: &[Bits], _: Bits) {
        if let Some(times) = self.times.get(id.0 as usize) {
            times.set(times.get() + 1);
        }
    }
}

/// What a plan could not do at a line that another can.
#[derive(Clone, Debug)]
pub enum Missed {
    /// Compute an operation by a cheaper routine: as it is, and as it would be.
    Cheaper(Box<[Done; 2]>),
    /// Leave so many operations out, of so many at a pixel.
    Fewer { left_out: f64, of: f64 },
    /// Neither: what it gains is not in the operations of this line's pixels.
    Elsewhere,
}

/// The greatest part of the routines' cycles of a line that another plan spares.
pub fn missed(now: &Work, then: &Work, line: Place) -> Missed {
    let none = BTreeMap::new();
    let [now, then] = [now, then].map(|work| work.lines.get(&line).unwrap_or(&none));
    let (mut dearest, mut cheaper) = (None, 0.0);
    let (mut most, mut left_out, mut fewer) = (0.0, 0.0, 0.0);
    for (key, done) in now {
        let other = then.get(key);
        let kept = other.map_or(0.0, |other| other.times.min(done.times));
        left_out += done.times - kept;
        fewer += (done.times - kept) * done.cycles;
        if let Some(other) = other {
            let gain = kept * (done.cycles - other.cycles);
            cheaper += gain.max(0.0);
            if gain > most {
                most = gain;
                dearest = Some((*done, *other));
            }
        }
    }
    // What is new there stands for something that is gone.
    for (key, done) in then {
        let before = now.get(key).map_or(0.0, |before| before.times);
        let more = (done.times - before).max(0.0);
        left_out -= more;
        fewer -= more * done.cycles;
    }
    let of = now.values().map(|done| done.times).sum();
    match dearest {
        Some((now, then)) if cheaper > fewer => Missed::Cheaper(Box::new([now, then])),
        _ if fewer > 0.0 && left_out >= 0.05 => Missed::Fewer { left_out, of },
        _ => Missed::Elsewhere,
    }
}
