//! Tracing evaluation for reverse-mode differentiation: computes in `f64`, and keeps on a tape
//! what was computed and which values decided a way or an entry.

use super::tape::{Tape, Traced};
use crate::analysis::carried::{Readers, held_by};
use crate::eval::arithmetic::{Arithmetic, Exact, Tagged};
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::wordlength::adjoint::Asked;
use crate::wordlength::low_discrepancy::GOLDEN;
use crate::wordlength::rates::{Often, first_of_pixels};
use slowlight_routine::{Op, Range, Type, Value};
use std::cell::{Cell, RefCell};

/// Values by which a way or an entry was chosen: of the picture, the row and the pixel.
#[derive(Default)]
struct Roots {
    frame: Vec<Traced>,
    row: Vec<Traced>,
    pixel: Vec<Traced>,
}

/// Computes in `f64` and keeps what was computed.
pub(super) struct Watch<'g> {
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

impl<'g> Watch<'g> {
    /// Of one choice of the params.
    pub fn new(
        (graph, tree): (&'g Graph, &Tree),
        carried: &'g Readers,
        often: &'g [Often],
        choice: u32,
    ) -> Watch<'g> {
        Watch {
            exact: Exact(graph),
            carried,
            choice,
            often,
            tape: RefCell::new(Tape::new(graph)),
            roots: RefCell::default(),
            received: Cell::new(0.0),
            ran: Cell::new(0),
            first: first_of_pixels(tree),
            kept: Cell::new(usize::MAX),
        }
    }

    /// How many statements have run.
    pub fn ran(&self) -> u64 {
        self.ran.get()
    }

    /// How many values are on the tape.
    pub fn kept(&self) -> usize {
        self.tape.borrow().len()
    }

    /// What is told of a pixel at its end is told as it is: a shade that is measured.
    pub fn tell(&self, told: impl Iterator<Item = Traced>) {
        self.roots.borrow_mut().pixel.extend(told);
    }

    /// What a pixel leaves to others.
    pub fn send(&self, sent: impl Iterator<Item = Traced>) {
        let sum = |sum: f64, traced: Traced| {
            self.decides(traced);
            sum + traced.tagged().real()
        };
        self.received.set(sent.fold(0.0, sum));
    }

    /// A node's value where it is read.
    fn read(&self, id: NodeId, traced: Traced) -> Traced {
        match self.exact.0.node(id) {
            Node::Received => Traced::nowhere(Value::Real(self.received.get()).into()),
            _ => traced,
        }
    }

    /// Tells of every value what is asked of it by a pixel that has just been run.
    pub fn ask(&self, ink: Traced, tell: &mut impl FnMut(NodeId, f64, Asked)) {
        let mut roots = self.roots.borrow_mut();
        let Roots { frame, row, pixel } = &*roots;
        let all = [frame, row, pixel].into_iter().flatten().copied();
        self.tape.borrow_mut().follow(all.chain([ink]), tell);
        roots.pixel.clear();
        self.tape.borrow_mut().back_to(self.kept.get());
    }

    /// What was computed for a row is of no use any more: the tape is as it was before.
    pub fn end_row(&self, begun: usize) {
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

    fn chosen(&self, id: ParamId) -> Tagged {
        let own = self.exact.param(id);
        let found = self.exact.0.params.get(id.0 as usize);
        // A bool may be either, whatever is said of it.
        let range = |p: &Param| {
            p.range
                .or((p.ty == Type::Bool).then(|| Range::new(0.0, 1.0)))
        };
        let Some((param, range)) = found.and_then(|p| Some((p, range(p)?))) else {
            return own;
        };
        let part = self.part(id.0);
        let value = range.lo + part * (range.hi - range.lo);
        Tagged::from(match param.ty {
            // As the scene has it: a program whose params are edited keeps its points.
            _ if self.choice == 0 => param.usual(),
            Type::Bool => Value::Bool(part > 0.5),
            Type::Int => Value::Int(value.round() as i32),
            Type::Real => Value::Real(value),
        })
    }
}

impl Arithmetic for &Watch<'_> {
    type Value = Traced;

    fn constant(&self, value: Value) -> Traced {
        Traced::nowhere(self.exact.constant(value))
    }

    fn param(&self, id: ParamId) -> Traced {
        Traced::nowhere(self.chosen(id))
    }

    fn apply(&self, id: NodeId, op: Op, args: &[Traced]) -> Traced {
        let of = match self.exact.0.node(id) {
            Node::Apply(_, of) => of,
            _ => [id; 2],
        };
        let none = || Traced::nowhere(Value::Int(0).into());
        let arg = |k: usize| args.get(k).map_or_else(none, |arg| self.read(of[k], *arg));
        let first = arg(0);
        let second = if args.len() > 1 { arg(1) } else { first };
        self.tape.borrow_mut().computed(id, op, of, [first, second])
    }

    fn copied(&self, place: Place, from: NodeId, traced: Traced) -> Traced {
        let traced = self.read(from, traced);
        match held_by(self.carried, place) {
            Some(id) => self.tape.borrow_mut().copied(id, from, traced),
            None => traced,
        }
    }

    fn gather(&self, received: Traced, sent: Traced) -> Traced {
        Traced::nowhere(self.exact.gather(received.tagged(), sent.tagged()))
    }

    fn truth(&self, traced: Traced) -> bool {
        self.decides(traced);
        self.exact.truth(traced.tagged())
    }

    fn int(&self, traced: Traced) -> i32 {
        self.decides(traced);
        self.exact.int(traced.tagged())
    }

    fn step(&self, statement: &Statement) {
        self.ran.set(self.ran.get() + 1);
        if self.first == Some(std::ptr::from_ref(statement)) {
            self.kept.set(self.tape.borrow().len());
        }
    }
}
