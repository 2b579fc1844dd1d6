//! The models of fixed-point formats, every value of which is held to what the ranges say.
#![allow(clippy::unwrap_used)]

use slowlight_compiler::eval::arithmetic::Arithmetic;
use slowlight_compiler::eval::run::Run;
use slowlight_compiler::ir::graph::{NodeId, ParamId, TableId};
use slowlight_compiler::ir::tree::Place;
use slowlight_compiler::plan::Plan;
use slowlight_routine::{Bits, Format, Op, Type, Value};
use std::cell::Cell;

/// What was seen of a plan's values.
#[derive(Default)]
pub struct Seen {
    /// How many results there were, all of which were held to their ranges.
    pub results: Cell<u64>,
    /// How many of them stand at their format's end.
    pub ends: Cell<u64>,
}

/// The model of a plan with params that may be other than the scene's.
struct Held<'p> {
    plan: &'p Plan,
    params: &'p [Bits],
    seen: &'p Seen,
}

impl Held<'_> {
    /// A real's units must fit its bits, and its value its range; an int its range.
    fn hold(&self, id: NodeId, op: Op, bits: Bits) {
        let plan = self.plan;
        let format = plan.format(id);
        let value = match (op.result(), format) {
            (Type::Bool, _) => return,
            (Type::Int, _) => f64::from((plan.runtime.decode)(bits, format).int()),
            // As the model has it: what the machine's bits would make of it is not asked.
            (Type::Real, Format::Fixed { bits: wide, frac }) => {
                let units = match wide {
                    32 => i64::from(bits as u32 as i32),
                    _ => bits as i64,
                };
                let most = (1i64 << (wide - 1)) - 1;
                // Only 16.16 uses the least number that has no opposite.
                let least = -most - i64::from(wide == 32);
                assert!((least..=most).contains(&units), "{op:?} wraps: {units}");
                let ends = &self.seen.ends;
                ends.set(ends.get() + u64::from(units.abs() >= most));
                units as f64 * (-f64::from(frac)).exp2()
            }
            _ => panic!("{id} has no fixed-point format"),
        };
        let range = plan.ranges.result[id.0 as usize];
        assert!(range.contains(value), "{op:?}: {value} is not in {range:?}");
        self.seen.results.set(self.seen.results.get() + 1);
    }
}

impl Arithmetic for Held<'_> {
    type Value = Bits;

    fn constant(&self, value: Value) -> Bits {
        self.plan.bits(value)
    }

    fn entry(&self, table: TableId, at: usize, _: Value) -> Bits {
        self.plan.entry(table, at)
    }

    fn param(&self, id: ParamId) -> Bits {
        self.params[id.0 as usize]
    }

    fn apply(&self, id: NodeId, op: Op, args: &[Bits]) -> Bits {
        let bits = self.plan.computed(id, args);
        self.hold(id, op, bits);
        bits
    }

    fn copied(&self, place: Place, from: NodeId, value: Bits) -> Bits {
        self.plan.copied(place, from, value)
    }

    fn sent(&self, from: NodeId, value: Bits) -> Bits {
        self.plan.sent(from, value)
    }

    fn gather(&self, received: Bits, sent: Bits) -> Bits {
        let bits = self.plan.gathered(received, sent);
        if let Format::Fixed { bits: 16, .. } | Format::Scaled { bits: 16 } = self.plan.runtime.real
        {
            assert!((bits as i64).abs() <= 32767);
        }
        bits
    }

    fn truth(&self, value: Bits) -> bool {
        (self.plan.runtime.decode)(value, Format::Bool).truth()
    }

    fn int(&self, value: Bits) -> i32 {
        (self.plan.runtime.decode)(value, self.plan.runtime.int).int()
    }
}

/// Runs pixels of a plan, its params being these bits; all values must stay in their bounds.
pub fn hold(plan: &Plan, params: &[Bits], pixels: impl Iterator<Item = (i32, i32)>, seen: &Seen) {
    let mut run = Run::new(&plan.graph, &plan.tree, Held { plan, params, seen });
    for (x, y) in pixels {
        run.pixel(x, y);
    }
}

/// Runs some 1,600 pixels of a plan, every value of which must stay in its bounds; answers
/// how many were computed, and how many of them saturated.
pub fn stays_within_bounds(plan: &Plan) -> (u64, u64) {
    let own: Vec<Bits> = plan.params.iter().map(|p| p.bits).collect();
    let (image, seen) = (&plan.graph.image, Seen::default());
    let step = |side: u32| side.div_ceil(40) as usize;
    let rows = (0..image.height as i32).step_by(step(image.height));
    let pixels = rows.flat_map(|y| {
        let columns = (0..image.width as i32).step_by(step(image.width));
        columns.map(move |x| (x, y))
    });
    hold(plan, &own, pixels, &seen);
    (seen.results.get(), seen.ends.get())
}
