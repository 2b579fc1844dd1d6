//! An estimate of a machine's time: what the routines say they cost, times how
//! often the model runs each, on a sample of the pixels.
//!
//! A routine's cost is a mean over its arguments; loads, stores, jumps and
//! drawing are left out. `run` measures. The sample is a grid of pixels; a small
//! picture is run whole.

use crate::draw::Window;
use slowlight_compiler::eval::arithmetic::Arithmetic;
use slowlight_compiler::eval::run::Run;
use slowlight_compiler::flow::graph::{NodeId, ParamId};
use slowlight_compiler::flow::tree::Place;
use slowlight_compiler::plan::Plan;
use slowlight_routine::{Bits, Format, Op, Value};
use std::cell::Cell;

/// Rows and columns of the sample.
const GRID: u32 = 24;

/// The models, with their cycles added up.
struct Costed<'p> {
    plan: &'p Plan,
    cycles: &'p Cell<u64>,
}

impl Arithmetic for Costed<'_> {
    type Value = Bits;

    fn constant(&self, value: Value) -> Bits {
        self.plan.bits(value)
    }

    fn param(&self, id: ParamId) -> Bits {
        self.plan.params.get(id.0 as usize).map_or(0, |p| p.bits)
    }

    fn apply(&self, id: NodeId, _: Op, args: &[Bits]) -> Bits {
        self.plan.routine(id).map_or(0, |routine| {
            self.cycles
                .set(self.cycles.get() + u64::from(routine.cycles));
            self.plan.computed(id, args)
        })
    }

    fn sent(&self, from: NodeId, value: Bits) -> Bits {
        self.plan.sent(from, value)
    }

    fn copied(&self, place: Place, from: NodeId, value: Bits) -> Bits {
        self.plan.copied(place, from, value)
    }

    fn gather(&self, received: Bits, sent: Bits) -> Bits {
        self.plan.gather().map_or(received, |routine| {
            self.cycles
                .set(self.cycles.get() + u64::from(routine.cycles));
            self.plan.gathered(received, sent)
        })
    }

    fn truth(&self, value: Bits) -> bool {
        (self.plan.runtime.decode)(value, Format::Bool).truth()
    }

    fn int(&self, value: Bits) -> i32 {
        (self.plan.runtime.decode)(value, self.plan.runtime.int).int()
    }
}

/// The cycles that a plan's operations take, all rows and columns together.
pub fn cycles(plan: &Plan) -> f64 {
    let mut window = Window::of(plan);
    let mut graph = plan.graph.clone();
    let mut sends = 0.0;
    if let Some(errors) = plan.error_rows() {
        // Pixels are sampled as if nothing had been sent to them: else all
        // those before had to be run.
        graph.diffusion = None;
        window.columns = plan.computed_columns();
        window.rows.0 = 0;
        let each = plan.gather().map_or(0, |routine| routine.cycles);
        let pixels = f64::from(window.width()) * f64::from(window.height());
        sends = f64::from(each) * errors.shares.len() as f64 * pixels;
    }
    let spent = Cell::new(0);
    let costed = Costed {
        plan,
        cycles: &spent,
    };
    let mut run = Run::new(&graph, &plan.tree, costed);
    let mut lap = {
        let mut before = 0;
        let spent = &spent;
        move || {
            let now = spent.get();
            let gone = now - before;
            before = now;
            gone as f64
        }
    };
    let frame = lap();
    let (mut row_cycles, mut pixel_cycles) = (0.0, 0.0);
    let (rows, columns) = (sample(window.rows), sample(window.columns));
    for &y in &rows {
        for (k, &x) in columns.iter().enumerate() {
            run.pixel(x as i32, y as i32);
            let mut here = lap();
            if k == 0 {
                // The same pixel again does without the row's statements.
                run.pixel(x as i32, y as i32);
                let again = lap();
                row_cycles += here - again;
                here = again;
            }
            pixel_cycles += here;
        }
    }
    let sampled = (rows.len() * columns.len()).max(1) as f64;
    let pixels = f64::from(window.width()) * f64::from(window.height());
    let row = row_cycles / rows.len().max(1) as f64;
    frame + sends + row * f64::from(window.height()) + pixel_cycles / sampled * pixels
}

/// Up to [`GRID`] numbers spread evenly between two, both included.
fn sample((first, last): (u32, u32)) -> Vec<u32> {
    let span = last - first;
    let steps = span.min(GRID - 1);
    let at = |k: u32| first + (u64::from(span) * u64::from(k) / u64::from(steps.max(1))) as u32;
    (0..=steps).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_reach_both_ends() {
        assert_eq!(sample((5, 5)), [5]);
        assert_eq!(sample((0, 3)), [0, 1, 2, 3]);
        let wide = sample((9, 239));
        assert_eq!(wide.len(), GRID as usize);
        assert_eq!((wide.first(), wide.last()), (Some(&9), Some(&239)));
    }
}
