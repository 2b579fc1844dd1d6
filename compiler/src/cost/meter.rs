//! Instrumented execution: a picture run in `f64`, with the params as the scene has them, and
//! what ran.

use crate::eval::arithmetic::{Arithmetic, Exact, Tagged};
use crate::ir::graph::*;
use crate::ir::tree::Statement;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Value};
use std::cell::{Cell, RefCell};

/// Computes in `f64` and adds up what the statements cost that run.
pub(crate) struct Meter<'g, C> {
    exact: Exact<'g>,
    cost: C,
    /// What statements cost that ran, each asked for once, and how often they did.
    costs: RefCell<FxHashMap<*const Statement, (f64, u64)>>,
    /// By node the greatest magnitude of a real that an operation came to, if that is watched.
    largest: Option<RefCell<Vec<f64>>>,
    /// How often what runs now counts.
    pub weight: Cell<u64>,
    /// What it came to.
    pub sum: Cell<f64>,
    /// How many ran.
    pub ran: Cell<u64>,
}

impl<'g, C: Fn(&Statement) -> f64> Meter<'g, C> {
    pub fn new(graph: &'g Graph, cost: C) -> Meter<'g, C> {
        Meter {
            exact: Exact(graph),
            cost,
            costs: RefCell::default(),
            largest: None,
            weight: Cell::new(1),
            sum: Cell::new(0.0),
            ran: Cell::new(0),
        }
    }

    /// The same, watching how large values are.
    pub fn watching(self) -> Meter<'g, C> {
        let nodes = self.exact.0.nodes.len();
        Meter {
            largest: Some(RefCell::new(vec![0.0; nodes])),
            ..self
        }
    }

    /// How large values were, by node.
    pub fn largest(&self) -> Vec<f64> {
        let all = self.largest.as_ref();
        all.map_or_else(Vec::new, |all| all.borrow().clone())
    }

    /// Forgets what statements cost, and what it came to.
    pub fn forget(&self) {
        self.costs.borrow_mut().clear();
        self.sum.set(0.0);
    }

    /// How often a statement ran.
    pub fn count(&self, statement: &Statement) -> u64 {
        let costs = self.costs.borrow();
        costs
            .get(&std::ptr::from_ref(statement))
            .map_or(0, |(_, count)| *count)
    }
}

impl<C: Fn(&Statement) -> f64> Arithmetic for &Meter<'_, C> {
    type Value = Tagged;

    fn constant(&self, value: Value) -> Tagged {
        self.exact.constant(value)
    }

    /// What the scene gives it, whatever it is now: a program whose params are
    /// edited keeps its plan.
    fn param(&self, id: ParamId) -> Tagged {
        let param = self.exact.0.params.get(id.0 as usize);
        param.map_or_else(|| self.exact.param(id), |param| param.usual().into())
    }

    fn apply(&self, id: NodeId, op: Op, args: &[Tagged]) -> Tagged {
        let value = self.exact.apply(id, op, args);
        if let Some(largest) = &self.largest
            && let Value::Real(real) = Value::from(value)
            && let Some(most) = largest.borrow_mut().get_mut(id.0 as usize)
        {
            *most = most.max(real.abs());
        }
        value
    }

    fn gather(&self, received: Tagged, sent: Tagged) -> Tagged {
        self.exact.gather(received, sent)
    }

    fn truth(&self, value: Tagged) -> bool {
        self.exact.truth(value)
    }

    fn int(&self, value: Tagged) -> i32 {
        self.exact.int(value)
    }

    fn step(&self, statement: &Statement) {
        self.ran.set(self.ran.get() + 1);
        let mut costs = self.costs.borrow_mut();
        let cost = costs.entry(std::ptr::from_ref(statement));
        let (cost, count) = cost.or_insert_with(|| ((self.cost)(statement), 0));
        let weight = self.weight.get();
        *count += weight;
        self.sum.set(self.sum.get() + *cost * weight as f64);
    }
}
