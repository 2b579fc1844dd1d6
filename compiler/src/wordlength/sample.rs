//! Dynamic range profiling: what values are at pixels spread over the picture, with the params in
//! many places of their ranges, and what the picture asks of them there.
//!
//! Where a few are far larger than all others, as quotients beside a horizon are, room for
//! these would cost all others their digits: they are cut where that loses less. What is
//! larger than all others by agreement, 1e6 for "nothing was hit", is asked for no more than
//! what it is compared with.

use super::tape::{NOWHERE, Tape, Traced};
use crate::analysis::carried::{Readers, held_by, readers};
use crate::analysis::points::widths::Widths;
use crate::eval::arithmetic::{Arithmetic, Exact};
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::wordlength::histogram::{BRIEF, Seen};
use crate::wordlength::low_discrepancy::{GOLDEN, scattered};
use crate::wordlength::rates::{Often, first_of_pixels, often};
use crate::wordlength::scales;
use slowlight_routine::scale::{finest, fitting};
use slowlight_routine::{Op, Type, Value};
use std::cell::{Cell, RefCell};

/// Rows and columns that are looked at, the picture's borders among them.
const LOOKED_AT: [u32; 2] = [24, 31];

/// The same where nothing is chosen anew and a value has more than 16 bits: a digit more
/// counts for so little there that what few pixels have is worth its room.
const CLOSELY: [u32; 2] = [80, 101];

/// How often params are chosen anew.
const CHOICES: u32 = 12;

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
}

/// What values are at the pixels looked at.
pub struct Sample {
    seen: Vec<Seen>,
    pixels: f64,
}

#[cfg(test)]
impl Sample {
    /// How many pixels were looked at; what counts for several is several.
    pub fn pixels(&self) -> f64 {
        self.pixels
    }
}

/// Looks at pixels, for values of so many bits at most, until so many statements have run.
pub fn seen(graph: &Graph, tree: &Tree, bits: u8, most: u64) -> Sample {
    let seen = RefCell::new(vec![Seen::default(); graph.nodes.len()]);
    let carried = readers(graph);
    let often = often(graph, tree);
    let live = graph.params.iter().any(|p| p.range.is_some());
    let choices = if live { CHOICES } else { 1 };
    let [rows, columns] = match !live && bits > BRIEF {
        true => CLOSELY,
        false => LOOKED_AT,
    };
    let mut pixels = 0.0;
    // What pixels send is looked at, but not carried through the whole picture.
    let alone = Graph {
        diffusion: None,
        ..graph.clone()
    };
    for choice in 0..choices {
        let watch = Watch {
            exact: Exact(graph),
            carried: &carried,
            choice,
            often: &often,
            tape: RefCell::new(Tape::new(graph)),
            roots: RefCell::default(),
            received: Cell::new(0.0),
            ran: Cell::new(0),
            first: first_of_pixels(tree),
            kept: Cell::new(usize::MAX),
        };
        let most = most / u64::from(choices);
        // The scene's own params count as much as all others.
        let times = f64::from(if choice == 0 { CHOICES - 1 } else { 1 });
        let mut run = Run::within(&alone, tree, &watch, most + LAST);
        let begun = watch.tape.borrow().len();
        let mut now = None;
        let mut followed = 0;
        for (column, row) in scattered([columns, rows], choice, CHOICES) {
            if watch.ran.get() >= most || followed >= FOLLOWED * most {
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
            if run.spent() && pixels > 0.0 {
                break;
            }
            let sent = graph.shares().filter_map(|s| run.last(s.node));
            watch.send(sent);
            // What is told at the end is told as it is: a shade that is measured.
            let told = graph.reports.iter().filter_map(|id| run.last(*id));
            watch.roots.borrow_mut().pixel.extend(told);
            pixels += times;
            followed += watch.tape.borrow().len() as u64;
            watch.ask(ink, &mut |id, value, asked| {
                if let Some(seen) = seen.borrow_mut().get_mut(id.0 as usize)
                    && let Value::Real(x) = value
                {
                    seen.see(x, asked, times);
                }
            });
        }
    }
    let seen = seen.into_inner();
    Sample { seen, pixels }
}

/// What values are expected to stay within in so many bits.
pub fn expected(scene: (&Graph, &Tree), sample: &Sample, widths: &Widths) -> Expected {
    Expected {
        ends: chosen(scene, sample, widths),
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

/// Values by which a way or an entry was chosen: of the picture, the row and the pixel.
#[derive(Default)]
struct Roots {
    frame: Vec<Traced>,
    row: Vec<Traced>,
    pixel: Vec<Traced>,
}

/// Computes in `f64` and keeps what was computed.
struct Watch<'g> {
    exact: Exact<'g>,
    /// By whom carried values are read.
    carried: &'g Readers,
    choice: u32,
    often: &'g [Often],
    tape: RefCell<Tape>,
    roots: RefCell<Roots>,
    /// What the pixel has received: all that the one looked at before it has sent.
    received: Cell<f64>,
    ran: Cell<u64>,
    /// Where pixels begin, and how long the tape was there: what follows is of no use once
    /// the pixel has been followed back.
    first: Option<*const Statement>,
    kept: Cell<usize>,
}

impl Watch<'_> {
    fn send(&self, sent: impl Iterator<Item = Traced>) {
        let sum = |sum: f64, traced: Traced| {
            self.decides(traced);
            sum + traced.value.real()
        };
        self.received.set(sent.fold(0.0, sum));
    }

    /// A node's value where it is read.
    fn read(&self, id: NodeId, traced: Traced) -> Traced {
        match self.exact.0.node(id) {
            Node::Received => untraced(Value::Real(self.received.get())),
            _ => traced,
        }
    }

    /// Tells of every value what is asked of it by a pixel that has just been run.
    fn ask(
        &self,
        ink: Traced,
        tell: &mut impl FnMut(NodeId, Value, crate::wordlength::adjoint::Asked),
    ) {
        let mut roots = self.roots.borrow_mut();
        let Roots { frame, row, pixel } = &*roots;
        let all = [frame, row, pixel].into_iter().flatten().copied();
        self.tape.borrow_mut().follow(all.chain([ink]), tell);
        roots.pixel.clear();
        self.tape.borrow_mut().back_to(self.kept.get());
    }

    /// What was computed for a row is of no use any more: the tape is as it was before.
    fn end_row(&self, begun: usize) {
        self.roots.borrow_mut().row.clear();
        self.tape.borrow_mut().back_to(begun);
    }

    fn decides(&self, traced: Traced) {
        let Some(id) = self.tape.borrow().node(traced) else {
            return;
        };
        let mut roots = self.roots.borrow_mut();
        match self.often.get(id.0 as usize) {
            Some(Often::Frame) => roots.frame.push(traced),
            Some(Often::Row) => roots.row.push(traced),
            _ => roots.pixel.push(traced),
        }
    }

    /// Where in its range a param is: as it is, at either end, in the middle, then spread.
    fn part(&self, param: u32) -> f64 {
        match self.choice {
            1 => 0.0,
            2 => 1.0,
            3 => 0.5,
            // Multiples of the golden ratio's fraction, another for each param.
            n => (f64::from(n * (param + 1)) * GOLDEN).fract(),
        }
    }

    fn chosen(&self, id: ParamId) -> Value {
        let own = self.exact.param(id);
        let found = self.exact.0.params.get(id.0 as usize);
        let Some((param, range)) = found.and_then(|p| Some((p, p.range?))) else {
            return own;
        };
        let part = self.part(id.0);
        let value = range.lo + part * (range.hi - range.lo);
        match param.ty {
            // As the scene has it: a program whose params are edited keeps its points.
            _ if self.choice == 0 => param.usual(),
            Type::Bool => Value::Bool(part > 0.5),
            Type::Int => Value::Int(value.round() as i32),
            Type::Real => Value::Real(value),
        }
    }
}

fn untraced(value: Value) -> Traced {
    Traced { value, at: NOWHERE }
}

impl Arithmetic for &Watch<'_> {
    type Value = Traced;

    fn constant(&self, value: Value) -> Traced {
        untraced(self.exact.constant(value))
    }

    fn param(&self, id: ParamId) -> Traced {
        untraced(self.chosen(id))
    }

    fn apply(&self, id: NodeId, op: Op, args: &[Traced]) -> Traced {
        let mut all = [untraced(Value::Int(0)); 2];
        let of = self.exact.0.node(id).operands();
        for ((held, arg), of) in all.iter_mut().zip(args).zip(of) {
            *held = self.read(of, *arg);
        }
        let mut tape = self.tape.borrow_mut();
        tape.computed(self.exact.0, id, op, &all[..args.len().min(2)])
    }

    fn copied(&self, place: Place, from: NodeId, traced: Traced) -> Traced {
        let traced = self.read(from, traced);
        match held_by(self.carried, place) {
            Some(id) => self.tape.borrow_mut().copied(id, from, traced),
            None => traced,
        }
    }

    fn gather(&self, received: Traced, sent: Traced) -> Traced {
        untraced(self.exact.gather(received.value, sent.value))
    }

    fn truth(&self, traced: Traced) -> bool {
        self.decides(traced);
        self.exact.truth(traced.value)
    }

    fn int(&self, traced: Traced) -> i32 {
        self.decides(traced);
        self.exact.int(traced.value)
    }

    fn step(&self, statement: &Statement) {
        self.ran.set(self.ran.get() + 1);
        if self.first == Some(std::ptr::from_ref(statement)) {
            self.kept.set(self.tape.borrow().len());
        }
    }
}
