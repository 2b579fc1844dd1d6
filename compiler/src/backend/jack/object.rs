//! What the scene's object holds beside the values: constants, params, tables.

use super::expression::Expression;
use super::names::{Names, identifier};
use crate::ir::graph::*;
use crate::plan::Plan;
use slowlight_routine::{Bits, Type};
use slowlight_runtime_jack::SUM;
use std::collections::BTreeMap;

/// A Float that never changes.
pub(super) struct Constant {
    pub name: String,
    pub bits: Bits,
    /// What the scene has for it.
    pub value: f64,
}

/// Constants and params, as they are asked for.
#[derive(Default)]
pub(super) struct Object {
    constants: Vec<Constant>,
    by_bits: BTreeMap<Bits, usize>,
    /// Real params' Floats, by param.
    values: BTreeMap<u32, String>,
}

impl Object {
    /// The field that holds a constant.
    pub fn constant(&mut self, names: &mut Names, bits: Bits, value: f64) -> String {
        let at = *self.by_bits.entry(bits).or_insert_with(|| {
            let name = names.fresh(&constant_name(value));
            self.constants.push(Constant { name, bits, value });
            self.constants.len() - 1
        });
        self.constants
            .get(at)
            .map_or(String::new(), |c| c.name.clone())
    }

    /// The constants, in the order in which they were asked for.
    pub fn constants(&self) -> &[Constant] {
        &self.constants
    }

    /// A param where it is used.
    pub fn param(&mut self, plan: &Plan, names: &mut Names, id: ParamId) -> Expression {
        let label = names.params.get(id.0 as usize).cloned().unwrap_or_default();
        match plan.graph.params.get(id.0 as usize).map(|p| p.ty) {
            Some(Type::Real) => {
                let wanted = format!("{label}_value");
                let name = self
                    .values
                    .entry(id.0)
                    .or_insert_with(|| names.fresh(&wanted));
                Expression::term(name.as_str())
            }
            Some(Type::Bool) => Expression {
                text: format!("~({label} = 0)"),
                level: SUM,
            },
            _ => Expression::term(label),
        }
    }

    /// The Floats of real params that are used, by param.
    pub fn values(&self) -> impl Iterator<Item = (u32, &str)> {
        self.values.iter().map(|(p, name)| (*p, name.as_str()))
    }
}

/// `real_1_9` for 1.9, `real_minus_0_5` for -0.5.
fn constant_name(value: f64) -> String {
    let digits: String = format!("{}", value.abs()).chars().take(8).collect();
    let sign = if value < 0.0 { "minus_" } else { "" };
    identifier(&format!("real_{sign}{digits}"), "real")
}
