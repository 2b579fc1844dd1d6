//! Encoding: tables and params as a plan's points have them.

use super::divided;
use crate::analysis::points::Points;
use crate::analysis::range::Ranges;
use crate::homes::single_use;
use crate::ir::graph::*;
use crate::plan::table_init::{self, Made};
use crate::plan::{ParamPlan, Plan};
use crate::selection::routines;
use slowlight_routine::{Bits, Runtime, Type, Value};

/// Puts tables' entries and params where their points are.
pub(crate) fn hold(
    graph: &Graph,
    runtime: &Runtime,
    points: &Points,
    tables: &mut [Made],
    params: &mut [ParamPlan],
) {
    for id in graph.ids().filter(|id| graph.ty(*id) == Type::Real) {
        match graph.node(id) {
            Node::Lookup { table, .. } => {
                let from = graph.tables.get(table.0 as usize);
                let to = tables.get_mut(table.0 as usize);
                if let (Some(from), Some(to)) = (from, to) {
                    let entries = from.entries.iter().map(|e| e.value());
                    let bits = entries.map(|e| (runtime.encode)(e, points.format(id)));
                    to.bits = bits.collect();
                }
            }
            Node::Param(p) => {
                if let Some(param) = params.get_mut(p.0 as usize) {
                    param.bits = taken(runtime, points, param, id);
                }
            }
            _ => {}
        }
    }
}

/// A param's bits, from the whole number that the source has.
fn taken(runtime: &Runtime, points: &Points, param: &ParamPlan, id: NodeId) -> Bits {
    let own = points.own(id);
    let Some(digits) = param.digits else {
        return (runtime.encode)(Value::Real(param.value), points.format(id));
    };
    let unit = 10f64.powi(i32::from(digits));
    let whole = (param.value * unit).round() as i64;
    match divided(runtime, own).filter(|_| digits > 0) {
        Some(routine) => (routine.model)(&[whole as Bits, unit as Bits, i64::from(own) as Bits]),
        None => points.moved(whole as Bits, 0, (own, points.widths.value(id))),
    }
}

impl Plan {
    /// Takes other points and routines for them; where there are none, all stays as it was, and
    /// the answer is no.
    pub(crate) fn take_points(&mut self, points: Points, ranges: Ranges) -> bool {
        let (graph, tree, runtime) = (&self.graph, &self.tree, self.runtime);
        let Ok(routines) = routines::choose(graph, tree, &ranges, runtime, Some(&points)) else {
            return false;
        };
        self.tables = table_init::made(graph, runtime);
        self.folded = single_use::folded(graph, tree, self.still.as_ref(), &routines);
        (self.points, self.ranges) = (Some(points), ranges);
        self.routines = routines;
        self.hold();
        true
    }

    /// Puts tables' entries and params where points are, if the plan has such.
    pub(crate) fn hold(&mut self) {
        if let Some(points) = &self.points {
            let (tables, params) = (&mut self.tables, &mut self.params);
            hold(&self.graph, self.runtime, points, tables, params);
        }
    }
}
