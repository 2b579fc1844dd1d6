//! What programs are given at their start, whatever their machine: which tables they read
//! and which numbers they may keep. Each target says what having these ready takes it
//! ([`super::starts`]).

use crate::ir::graph::*;
use crate::ir::tree::{Origin, Statement, walk};
use crate::plan::Plan;
use slowlight_routine::{Op, Type, Value};
use std::collections::BTreeMap;

/// Which tables the plan reads.
pub(super) fn tables(plan: &Plan) -> Vec<TableId> {
    let mut found = Vec::new();
    for block in plan.tree.blocks() {
        walk(block, &mut |statement| {
            if let Statement::Let(id) = statement
                && let Node::Lookup { table, .. } = plan.graph.node(*id)
                && !found.contains(&table)
            {
                found.push(table);
            }
        });
    }
    found
}

/// The real constants that the plan's statements read, each once.
pub(super) fn constants(plan: &Plan) -> Vec<f64> {
    let mut found = BTreeMap::new();
    let mut read = |id: NodeId| {
        if let Some(value @ Value::Real(x)) = plan.graph.constant(id) {
            found.insert(plan.bits(value), x);
        }
    };
    for block in plan.tree.blocks() {
        walk(block, &mut |statement| match statement {
            Statement::Let(id) => plan.graph.node(*id).inputs().for_each(&mut read),
            Statement::Set {
                from: Origin::Node(id),
                ..
            } => read(*id),
            _ => {}
        });
    }
    found.into_values().collect()
}

/// How many real params are made of whole numbers, and how many of these are divided.
pub(super) fn params_made(plan: &Plan) -> [u64; 2] {
    let all = plan.graph.params.iter().zip(&plan.params);
    let digits = all.filter_map(|(param, made)| made.digits.filter(|_| param.ty == Type::Real));
    let digits: Vec<u8> = digits.collect();
    let divided = digits.iter().filter(|digits| **digits > 0).count();
    [digits.len() as u64, divided as u64]
}

/// What an operation of ordinary operands takes.
pub(super) fn usual(plan: &Plan, op: Op) -> u64 {
    let routine = plan.runtime.usual(op);
    routine.map_or(0, |routine| u64::from(routine.cycles))
}
