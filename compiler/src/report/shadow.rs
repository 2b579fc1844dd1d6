//! Native values and a machine's side by side, on the native way.

use crate::eval::arithmetic::Arithmetic;
use crate::eval::native::param_value;
use crate::ir::graph::*;
use crate::ir::tree::Place;
use crate::plan::Plan;
use slowlight_routine::{Bits, Format, Op, Type, Value};
use std::cell::RefCell;

/// What is off by less than this many units in the last place is in order.
const GROWN: f64 = 64.0;

/// A native value as near to a border as this part of it lies on the border.
const TIE: f64 = 16.0 * f64::EPSILON;

/// A last place larger than this part of a step is coarse.
const COARSE: f64 = 32.0;

/// How many operations of a row are remembered.
const REMEMBERED: usize = 4_000_000;

/// One value, natively and on the machine.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    exact: Value,
    bits: Bits,
    /// What the bits stand for; a bool is 0 or 1.
    machine: f64,
    /// The machine's last place there, where all values have it that the place may hold.
    place: Option<f64>,
    /// The operation that made it.
    event: Option<u32>,
}

impl Pair {
    /// The native value.
    pub fn exact(&self) -> Value {
        self.exact
    }

    /// How far the machine's value is from it.
    pub fn off(&self) -> f64 {
        (self.machine - self.exact.real()).abs()
    }
}

/// One operation that was run.
#[derive(Clone, Copy, Debug)]
pub struct Event {
    /// Which.
    pub node: NodeId,
    /// By how many units in the last place the result is off.
    pub units: f64,
    /// What made its arguments.
    pub args: [Option<u32>; 2],
}

/// What was seen on a pixel.
#[derive(Clone, Copy, Debug)]
pub enum What {
    /// A comparison or step on its border natively.
    Tie(NodeId),
    /// 0/0 natively.
    NoMeaning(NodeId),
    /// A step where the format's last place is not much less than a step.
    Coarse { node: NodeId, place: f64 },
    /// A comparison or step whose native arguments are nearer to its border than
    /// the format can tell, without an error that grew.
    Close { node: NodeId, units: f64 },
    /// An event far off, and what came out otherwise because of it.
    Off { event: u32, flips: Option<NodeId> },
}

/// The arithmetic that remembers.
pub struct Shadow<'p> {
    plan: &'p Plan,
    /// One unit in the last place where points float: a part of the value.
    unit: f64,
    /// The formats of the tables' entries and of the params.
    entries: Vec<Format>,
    params: Vec<Format>,
    log: RefCell<Log>,
}

#[derive(Default)]
struct Log {
    events: Vec<Event>,
    kept: usize,
    run: u64,
    seen: Vec<What>,
}

impl<'p> Shadow<'p> {
    pub fn new(plan: &'p Plan) -> Shadow<'p> {
        let (tables, params) = (plan.graph.tables.len(), plan.graph.params.len());
        Shadow {
            plan,
            unit: plan.runtime.real.epsilon(),
            entries: (0..tables as u32)
                .map(|k| plan.entry_format(TableId(k)))
                .collect(),
            params: (0..params as u32)
                .map(|k| plan.param_format(ParamId(k)))
                .collect(),
            log: RefCell::default(),
        }
    }

    /// What was run so far is remembered for good: the frame.
    pub fn keep(&self) {
        let mut log = self.log.borrow_mut();
        log.kept = log.events.len();
    }

    /// Forgets what was run since.
    pub fn forget(&self) {
        let mut log = self.log.borrow_mut();
        let kept = log.kept;
        log.events.truncate(kept);
    }

    /// How many operations have been run.
    pub fn run(&self) -> u64 {
        self.log.borrow().run
    }

    /// What was seen since the last call.
    pub fn seen(&self) -> Vec<What> {
        std::mem::take(&mut self.log.borrow_mut().seen)
    }

    /// An operation by its number.
    pub fn event(&self, at: u32) -> Event {
        let log = self.log.borrow();
        let none = Event {
            node: self.plan.graph.ink,
            units: 0.0,
            args: [None; 2],
        };
        log.events.get(at as usize).copied().unwrap_or(none)
    }

    /// Looks at a pixel's shade: whether it is off by more than `most`.
    pub fn shade(&self, pair: Pair, most: f64) {
        let off = pair.off();
        if let Some(event) = pair.event
            && off > most
        {
            self.saw(What::Off { event, flips: None });
        }
    }

    fn saw(&self, what: What) {
        self.log.borrow_mut().seen.push(what);
    }

    /// A value whose machine's bits are in a format.
    fn pair(&self, exact: Value, bits: Bits, format: Format) -> Pair {
        Pair {
            exact,
            bits,
            machine: (self.plan.runtime.decode)(bits, format).real(),
            place: format.is_fixed().then(|| format.epsilon()),
            event: None,
        }
    }

    fn remember(&self, event: Event) -> Option<u32> {
        let mut log = self.log.borrow_mut();
        log.run += 1;
        (log.events.len() < REMEMBERED).then(|| {
            log.events.push(event);
            (log.events.len() - 1) as u32
        })
    }

    /// A comparison or a step that the machine takes otherwise.
    fn flip(&self, id: NodeId, op: Op, args: &[Pair]) {
        let (margin, size) = border(op, args);
        if margin <= TIE * size {
            return self.saw(What::Tie(id));
        }
        let Some(worst) = args.iter().max_by(|a, b| a.off().total_cmp(&b.off())) else {
            return;
        };
        let places = args.iter().filter_map(|p| p.place).reduce(f64::max);
        let place = places.unwrap_or(self.unit * size);
        match worst.event {
            Some(event) if units(worst.off(), place) > GROWN => {
                let flips = Some(id);
                self.saw(What::Off { event, flips });
            }
            _ if op == Op::Floor && place * COARSE > 1.0 => {
                self.saw(What::Coarse { node: id, place });
            }
            _ => {
                let units = units(margin, place);
                self.saw(What::Close { node: id, units });
            }
        }
    }
}

/// An error in units of the last place.
fn units(off: f64, place: f64) -> f64 {
    match (off == 0.0, place == 0.0) {
        (true, _) => 0.0,
        (_, true) => f64::MAX,
        _ => (off.abs() / place).min(f64::MAX),
    }
}

/// How far native arguments lie from where the result changes, and how large they are.
fn border(op: Op, args: &[Pair]) -> (f64, f64) {
    let value = |k: usize| args.get(k).map_or(0.0, |p: &Pair| p.exact.real());
    let (a, b) = (value(0), value(1));
    match op {
        Op::Floor => ((a - a.round()).abs(), a.abs().max(1.0)),
        Op::Round => ((a - a.floor() - 0.5).abs(), a.abs().max(1.0)),
        Op::Sign => (a.abs(), a.abs()),
        Op::Mod => {
            let turns = a / b;
            (
                (turns - turns.round()).abs() * b.abs(),
                a.abs().max(b.abs()),
            )
        }
        _ => ((a - b).abs(), a.abs().max(b.abs())),
    }
}

impl Arithmetic for &Shadow<'_> {
    type Value = Pair;

    fn entry(&self, table: TableId, at: usize, value: Value) -> Pair {
        let format = self.entries.get(table.0 as usize);
        let format = format.copied().unwrap_or(self.plan.runtime.real);
        self.pair(value, self.plan.entry(table, at), format)
    }

    fn constant(&self, value: Value) -> Pair {
        let made = self.pair(
            value,
            self.plan.bits(value),
            self.plan.runtime.format_of(value.ty()),
        );
        match (value, self.plan.points()) {
            // It is rounded where it is read.
            (Value::Real(exact), Some(_)) => Pair {
                machine: exact,
                place: None,
                ..made
            },
            _ => made,
        }
    }

    fn copied(&self, place: Place, from: NodeId, value: Pair) -> Pair {
        let bits = self.plan.copied(place, from, value.bits);
        match self.plan.points() {
            Some(_) if self.plan.graph.ty(from) == Type::Real => Pair {
                event: value.event,
                ..self.pair(value.exact, bits, self.plan.place_format(place))
            },
            _ => value,
        }
    }

    fn param(&self, id: ParamId) -> Pair {
        let format = self.params.get(id.0 as usize);
        let format = format.copied().unwrap_or(self.plan.runtime.real);
        let bits = self.plan.params.get(id.0 as usize).map_or(0, |p| p.bits);
        self.pair(param_value(&self.plan.graph, id), bits, format)
    }

    fn apply(&self, id: NodeId, op: Op, args: &[Pair]) -> Pair {
        let list = |k: usize| args.get(k).copied();
        let exacts = [list(0), list(1)].map(|p| p.map_or(Value::Int(0), |p| p.exact));
        let machines = [list(0), list(1)].map(|p| p.map_or(0, |p| p.bits));
        let exact = op.eval(&exacts[..args.len()]);
        let bits = self.plan.computed(id, &machines[..args.len()]);
        let made = self.pair(exact, bits, self.plan.format(id));
        let off = made.off();
        if op == Op::Div && exacts.iter().all(|v| v.real() == 0.0) {
            self.saw(What::NoMeaning(id));
        }
        let steps = op.result() != Type::Real && op.args().contains(&Type::Real);
        let wraps = op == Op::Mod && off > exacts[1].real().abs() / 2.0;
        if (steps && off != 0.0) || wraps {
            self.flip(id, op, args);
            // From here on as natively, or one flip would be found again and again.
            return self.constant(exact);
        }
        let event = self.remember(Event {
            node: id,
            units: units(off, made.place.unwrap_or(self.unit * exact.real().abs())),
            args: [list(0), list(1)].map(|p| p.and_then(|p| p.event)),
        });
        Pair { event, ..made }
    }

    fn gather(&self, received: Pair, _: Pair) -> Pair {
        received
    }

    fn truth(&self, value: Pair) -> bool {
        value.exact.truth()
    }

    fn int(&self, value: Pair) -> i32 {
        value.exact.int()
    }
}
