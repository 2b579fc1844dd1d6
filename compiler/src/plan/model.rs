//! Bit-exact simulation: a plan run in its routines' models.
//!
//! What the generated program computes on its machine is what this computes,
//! ink by ink; the difference between the two is a fault of ours.

use crate::eval::arithmetic::Arithmetic;
use crate::eval::native::Pixel;
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::ir::tree::Place;
use crate::plan::Plan;
use crate::plan::semantics::Operations;
use slowlight_routine::{Bits, Format, Op, Value};

/// A plan's arithmetic: bits and models.
pub struct Model<'p> {
    plan: &'p Plan,
    operations: Operations<'p>,
}

impl<'p> Model<'p> {
    /// That of a plan.
    pub fn of(plan: &'p Plan) -> Model<'p> {
        Model {
            plan,
            operations: Operations::of(plan),
        }
    }
}

impl Arithmetic for Model<'_> {
    type Value = Bits;

    fn constant(&self, value: Value) -> Bits {
        self.plan.bits(value)
    }

    fn entry(&self, table: TableId, at: usize, _: Value) -> Bits {
        self.plan.entry(table, at)
    }

    fn param(&self, id: ParamId) -> Bits {
        self.plan.params.get(id.0 as usize).map_or(0, |p| p.bits)
    }

    fn apply(&self, id: NodeId, _: Op, args: &[Bits]) -> Bits {
        self.operations.computed(id, args)
    }

    fn sent(&self, from: NodeId, value: Bits) -> Bits {
        self.plan.sent(from, value)
    }

    fn copied(&self, place: Place, from: NodeId, value: Bits) -> Bits {
        self.plan.copied(place, from, value)
    }

    fn gather(&self, received: Bits, sent: Bits) -> Bits {
        self.plan.gathered(received, sent)
    }

    fn truth(&self, value: Bits) -> bool {
        (self.plan.runtime.decode)(value, Format::Bool).truth()
    }

    fn int(&self, value: Bits) -> i32 {
        (self.plan.runtime.decode)(value, self.plan.runtime.int).int()
    }
}

/// Evaluates a plan pixel by pixel; row by row is cheapest.
pub struct ModelRun<'p> {
    plan: &'p Plan,
    run: Run<'p, Model<'p>>,
}

impl<'p> ModelRun<'p> {
    /// Runs the frame's statements.
    pub fn new(plan: &'p Plan) -> ModelRun<'p> {
        ModelRun::within(plan, u64::MAX)
    }

    /// The same where no more than so many statements are worth running
    /// ([`Run::within`]).
    pub fn within(plan: &'p Plan, most: u64) -> ModelRun<'p> {
        ModelRun {
            plan,
            run: Run::within(&plan.graph, &plan.tree, Model::of(plan), most),
        }
    }

    /// Whether all statements that were allowed have run: what the last pixel came to is of
    /// no use then.
    pub fn spent(&self) -> bool {
        self.run.spent()
    }

    /// How many statements are worth running yet.
    pub fn left(&self) -> u64 {
        self.run.left()
    }

    /// The ink and shade of the picture's column `x`, row `y`. Where the plan
    /// does not compute the shade, it is ink/(inks - 1).
    pub fn pixel(&mut self, x: i32, y: i32) -> Pixel {
        let plan = self.plan;
        let top = plan.graph.image.palette.len().saturating_sub(1);
        let bits = self.run.pixel(x, y);
        let ink = ink(plan, bits);
        let shade = plan.graph.shade.and_then(|id| {
            let bits = self.run.last(id)?;
            Some((plan.runtime.decode)(bits, plan.format(id)).real())
        });
        let shade = shade.unwrap_or(f64::from(ink) / top.max(1) as f64);
        Pixel { ink, shade }
    }

    /// How many pixels were traced ([`Run::traced`]).
    pub fn traced(&self) -> u64 {
        self.run.traced()
    }

    /// The bits of what the graph reports, after the last pixel.
    pub fn reports(&mut self) -> Vec<Bits> {
        self.run.reports()
    }

    /// The bits of the states in the next picture, in the order of the graph's: what each next
    /// value is as the state holds it. No pixel need have been asked for.
    pub fn next_states(&mut self) -> Vec<(ParamId, Bits)> {
        let plan = self.plan;
        let values = self.run.reports();
        let steps = plan.graph.steps().zip(values);
        steps
            .map(|((state, next), bits)| (state, plan.given(state, next, bits)))
            .collect()
    }

    /// How often the schedule read what it had not written; 0 if it is right.
    pub fn unset_reads(&self) -> u64 {
        self.run.unset_reads()
    }
}

/// The number of the ink that a plan's pixel comes to, within the picture's inks.
pub fn ink(plan: &Plan, bits: Bits) -> u8 {
    let top = plan.graph.image.palette.len().saturating_sub(1) as i32;
    let ink = (plan.runtime.decode)(bits, plan.runtime.int).int();
    ink.clamp(0, top.max(0)) as u8
}
