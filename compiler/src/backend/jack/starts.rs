//! What programs take before they begin the scene, in VM commands: the runtime's tables are
//! worked out, and the scene's object is filled. Calls of the operating system count one.

use super::super::starts::{constants, params_made, tables, usual};
use super::logs::has_signs;
use crate::plan::Plan;
use slowlight_routine::{Format, Op, Type};

/// `let table[5] = 1;`.
const ENTRY: u64 = 8;
/// `let x = Float.constant(s, e, m);`, and its like in a table more than [`ENTRY`].
const CONSTANT: u64 = 16;
/// `let x = Float.new();`.
const VALUE: u64 = 13;
/// A param or row is set, and found to be in its range.
const PARAM: u64 = 14;

/// What a plan's program takes.
pub(in crate::backend) fn starts(plan: &Plan) -> u64 {
    let real = plan.runtime.real;
    let floats = real.is_object();
    // A word more to a real.
    let [constant, value] = match real {
        Format::Float416 => [CONSTANT + 3, VALUE + 2],
        _ => [CONSTANT, VALUE],
    };
    let logs = matches!(real, Format::Log { .. });
    let [made, divided] = params_made(plan);

    // Logarithms of params are looked up.
    let wanted = plan.parts().into_iter().map(|part| part.name);
    let wanted = wanted.chain((logs && made > 0).then_some("Log.fromInt"));
    let parts = plan.runtime.closure(wanted);
    let parts: u64 = parts.iter().map(|part| u64::from(part.starts)).sum();

    let read = tables(plan).into_iter();
    let read = read.filter_map(|id| plan.graph.tables.get(id.0 as usize));
    let entries = read.map(|table| {
        let each = match table.ty == Type::Real {
            true if floats => ENTRY + constant,
            true if logs && has_signs(table) => 2 * ENTRY,
            _ => ENTRY,
        };
        each * table.entries.len() as u64
    });
    let entries: u64 = entries.sum();

    let objects = match floats {
        true => {
            let places = plan.places().into_iter();
            let values = made + places.filter(|(_, format)| *format == real).count() as u64;
            constant * constants(plan).len() as u64 + value * values
        }
        false => 0,
    };
    let reals = match floats || logs {
        true => {
            made * usual(plan, Op::ToReal)
                + if floats {
                    divided * usual(plan, Op::Div)
                } else {
                    0
                }
        }
        false => divided * usual(plan, Op::Div),
    };
    parts + entries + objects + reals + PARAM * (2 + plan.params.len() as u64)
}
