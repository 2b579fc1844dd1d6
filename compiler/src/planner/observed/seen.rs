//! An execution profile: the model's run of every pixel, watched.

use crate::eval::arithmetic::Arithmetic;
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::ir::tree::{Place, Statement};
use crate::plan::Plan;
use crate::plan::model::{Model, ink};
use rustc_hash::FxHashMap;
use slowlight_routine::{Bits, Op, Type, Value};
use slowlight_runtime_bbc::guards::{self, Guarded};
use std::cell::{Cell, RefCell};

/// Which ways of a choice were taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    Never,
    Yes,
    No,
    Both,
}

/// What was seen of a plan's nodes, loops and choices.
#[derive(Clone)]
pub(super) struct Seen {
    /// By node: whether it was computed.
    pub computed: Vec<bool>,
    /// Whether a test of its guard failed.
    pub fails: Vec<bool>,
    /// Whether it was always the same as one of its operands.
    pub same: Vec<[bool; 2]>,
    /// Between what it was, if it is an int.
    pub ints: Vec<Option<(i32, i32)>>,
    /// By loop: how many turns it took at most.
    pub turns: Vec<u32>,
    /// Homes that were read though nothing had written them.
    pub unset: u64,
    /// By statement of the tree, where that lies.
    ways: FxHashMap<usize, [bool; 2]>,
}

impl Seen {
    /// What rows of a picture do, by so many statements at most, and the inks of their pixels.
    pub fn of(plan: &Plan, rows: &[u32], most: u64) -> Option<(Seen, Vec<u8>)> {
        let nodes = plan.graph.nodes.len();
        let seen = RefCell::new(Seen {
            computed: vec![false; nodes],
            fails: vec![false; nodes],
            same: vec![[true; 2]; nodes],
            ints: vec![None; nodes],
            turns: vec![0; plan.graph.loops.len()],
            unset: 0,
            ways: FxHashMap::default(),
        });
        let watch = Watch {
            model: Model::of(plan),
            plan,
            guards: (plan.graph.ids())
                .map(|id| guards::guard(plan.routine(id)?.name))
                .collect(),
            seen: &seen,
            asks: Cell::new(None),
        };
        let mut run = Run::within(&plan.graph, &plan.tree, watch, most);
        let (left, right) = plan.computed_columns();
        let mut inks = Vec::new();
        for &y in rows {
            for x in left..=right {
                inks.push(ink(plan, run.pixel(x as i32, y as i32)));
            }
            if run.spent() {
                return None;
            }
        }
        let unset = run.unset_reads();
        drop(run);
        let seen = Seen {
            unset,
            ..seen.into_inner()
        };
        Some((seen, inks))
    }

    /// Adds what other rows did.
    pub fn add(&mut self, other: &Seen) {
        let or = |to: &mut bool, from: &bool| *to |= from;
        (self.computed.iter_mut().zip(&other.computed)).for_each(|(a, b)| or(a, b));
        (self.fails.iter_mut().zip(&other.fails)).for_each(|(a, b)| or(a, b));
        for (to, from) in self.same.iter_mut().zip(&other.same) {
            *to = [to[0] && from[0], to[1] && from[1]];
        }
        for (to, from) in self.ints.iter_mut().zip(&other.ints) {
            *to = match (*to, *from) {
                (Some((a, b)), Some((c, d))) => Some((a.min(c), b.max(d))),
                (one, other) => one.or(other),
            };
        }
        for (to, from) in self.turns.iter_mut().zip(&other.turns) {
            *to = (*to).max(*from);
        }
        for (at, ways) in &other.ways {
            let own = self.ways.entry(*at).or_default();
            *own = [own[0] || ways[0], own[1] || ways[1]];
        }
        self.unset += other.unset;
    }

    /// Which ways a choice took; of a loop, whether it was come to.
    pub fn way(&self, statement: &Statement) -> Way {
        match self.ways.get(&address(statement)) {
            None | Some([false, false]) => Way::Never,
            Some([true, false]) => Way::Yes,
            Some([false, true]) => Way::No,
            Some([true, true]) => Way::Both,
        }
    }
}

/// Statements are told apart by where they are: the tree stays where it is meanwhile.
fn address(statement: &Statement) -> usize {
    std::ptr::from_ref(statement).addr()
}

/// The model's arithmetic, watched.
struct Watch<'p> {
    model: Model<'p>,
    plan: &'p Plan,
    guards: Vec<Option<&'static Guarded>>,
    seen: &'p RefCell<Seen>,
    /// The choice whose condition is asked for next.
    asks: Cell<Option<usize>>,
}

impl Arithmetic for Watch<'_> {
    type Value = Bits;

    fn constant(&self, value: Value) -> Bits {
        self.model.constant(value)
    }

    fn entry(&self, table: TableId, at: usize, value: Value) -> Bits {
        self.model.entry(table, at, value)
    }

    fn param(&self, id: ParamId) -> Bits {
        self.model.param(id)
    }

    fn apply(&self, id: NodeId, op: Op, args: &[Bits]) -> Bits {
        let value = self.model.apply(id, op, args);
        let (at, plan) = (id.0 as usize, self.plan);
        let mut seen = self.seen.borrow_mut();
        seen.computed[at] = true;
        for (k, same) in seen.same[at].iter_mut().enumerate() {
            *same &= args.get(k) == Some(&value);
        }
        if plan.graph.ty(id) == Type::Int {
            let int = self.int(value);
            let (lo, hi) = seen.ints[at].unwrap_or((int, int));
            seen.ints[at] = Some((lo.min(int), hi.max(int)));
        }
        if let Some(guard) = self.guards[at]
            && !seen.fails[at]
        {
            let held = guard.when.iter().all(|(k, test)| {
                let format = plan.routine(id).and_then(|r| r.args.get(*k));
                let bits = args.get(*k).copied();
                let value = bits.zip(format).map(|(bits, format)| {
                    match (plan.runtime.decode)(bits, *format) {
                        Value::Int(n) => f64::from(n),
                        other => other.real(),
                    }
                });
                value.is_some_and(|x| test.holds(x))
            });
            seen.fails[at] = !held;
        }
        value
    }

    fn copied(&self, place: Place, from: NodeId, value: Bits) -> Bits {
        self.model.copied(place, from, value)
    }

    fn sent(&self, from: NodeId, value: Bits) -> Bits {
        self.model.sent(from, value)
    }

    fn gather(&self, received: Bits, sent: Bits) -> Bits {
        self.model.gather(received, sent)
    }

    fn truth(&self, value: Bits) -> bool {
        let holds = self.model.truth(value);
        if let Some(at) = self.asks.take() {
            let mut seen = self.seen.borrow_mut();
            seen.ways.entry(at).or_default()[usize::from(!holds)] = true;
        }
        holds
    }

    fn int(&self, value: Bits) -> i32 {
        self.model.int(value)
    }

    fn turn(&self, of: LoopId, turn: u32, _: &[Option<Bits>]) {
        let mut seen = self.seen.borrow_mut();
        if let Some(most) = seen.turns.get_mut(of.0 as usize) {
            *most = (*most).max(turn);
        }
    }

    fn step(&self, statement: &Statement) {
        self.asks.set(None);
        match statement {
            Statement::If { .. } => self.asks.set(Some(address(statement))),
            Statement::Loop(_) => {
                let mut seen = self.seen.borrow_mut();
                seen.ways.entry(address(statement)).or_default()[0] = true;
            }
            _ => {}
        }
    }
}
