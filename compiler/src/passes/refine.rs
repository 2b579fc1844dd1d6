//! Adaptive sampling: pixels are traced only where those around them differ.
//!
//! A pixel between key rows ([`crate::ir::refinement`]) is traced if what the neighbours above
//! and below came to differs by more than a tolerance, or their mean from the neighbour to the
//! left; else it is that mean. What it comes to is kept as a byte. The dither stays the pixel's
//! own: it is given the mean as its shade.
//!
//! The way is Whitted's (An Improved Illumination Model for Shaded Display, 1980, section 4:
//! samples are added where those at a square's corners differ), by rows, so that a program
//! keeps few of them and draws each from left to right.

use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::ir::refinement::LEVELS;
use crate::passes::rewrite::dither::Dither;
use crate::passes::rewrite::rebuild::{End, Rewrite, rebuild_by};
use crate::source::Span;
use slowlight_routine::{Op, Value};

/// Rows from one key row to the next that may be asked for.
pub const STEPS: [u32; 4] = [2, 4, 8, 16];

/// By how many levels neighbours may differ where nothing else is said: over scenes of all kinds
/// a hundredth of the inks is another then (docs/refine.md).
pub const TOLERANCE: u8 = 8;

/// Why a picture cannot be refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unrefined {
    /// Errors are spread: each pixel's shade has what others sent.
    Spreads,
    /// There are inks alone, and nothing lies between two inks.
    NoShade,
}

/// The graph of a picture whose pixels are traced where their neighbours differ by more than so
/// many levels ([`LEVELS`]).
///
/// # Errors
/// Where the picture has no shade by itself.
pub fn refine(graph: &Graph, step: u32, tolerance: u8) -> Result<Graph, Unrefined> {
    if graph.is_in_order() {
        return Err(Unrefined::Spreads);
    }
    let shade = graph.shade.ok_or(Unrefined::NoShade)?;
    let mut refine = Refine {
        height: graph.image.height,
        shade,
        span: graph.span(shade),
        step,
        tolerance: tolerance.into(),
        dither: Dither::of(graph),
        done: false,
    };
    let made = rebuild_by(graph, &mut refine);
    // A choice between a dither and an ink has a shade, too, that no dither reads.
    match made.refinement {
        Some(_) => Ok(made),
        None => Err(Unrefined::NoShade),
    }
}

struct Refine<'g> {
    height: u32,
    shade: NodeId,
    span: Span,
    step: u32,
    /// In levels.
    tolerance: i32,
    dither: Dither<'g>,
    /// Whether what stands for the shade is made.
    done: bool,
}

/// A builder at a place in the source.
struct At<'b>(&'b mut Builder, Span);

impl At<'_> {
    fn int(&mut self, int: i32) -> NodeId {
        self.0.constant(Value::Int(int), self.1)
    }

    fn real(&mut self, real: f64) -> NodeId {
        self.0.constant(Value::Real(real), self.1)
    }

    fn op(&mut self, op: Op, args: &[NodeId]) -> NodeId {
        self.0.apply(op, args, self.1)
    }

    fn select(&mut self, cond: NodeId, yes: NodeId, no: NodeId) -> NodeId {
        self.0.select(cond, yes, no, self.1)
    }

    fn either(&mut self, a: NodeId, b: NodeId) -> NodeId {
        let yes = self.0.constant(Value::Bool(true), self.1);
        self.select(a, yes, b)
    }

    /// Whether two ints differ by more than so much.
    fn differ(&mut self, a: NodeId, b: NodeId, by: i32) -> NodeId {
        let (by, between) = (self.int(by), self.op(Op::IntSub, &[a, b]));
        let between = self.op(Op::IntAbs, &[between]);
        self.op(Op::IntLess, &[by, between])
    }

    /// The byte that is nearest to a shade.
    fn level(&mut self, shade: NodeId) -> NodeId {
        let [zero, one, half] = [0.0, 1.0, 0.5].map(|real| self.real(real));
        let levels = self.real(f64::from(LEVELS));
        let least = self.op(Op::Max, &[shade, zero]);
        let within = self.op(Op::Min, &[least, one]);
        let scaled = self.op(Op::Mul, &[within, levels]);
        let scaled = self.op(Op::Add, &[scaled, half]);
        self.op(Op::Floor, &[scaled])
    }

    /// Whether the row is traced as a whole: a key row, or none is below it.
    fn is_key(&mut self, step: u32, height: u32) -> NodeId {
        let y = self.0.axis(Axis::Y, self.1);
        let [step, zero] = [step as i32, 0].map(|int| self.int(int));
        let rest = self.op(Op::IntMod, &[y, step]);
        let key = self.op(Op::IntEqual, &[rest, zero]);
        // The lowest bit that is set is how far the row above is, and the one below.
        let minus = self.op(Op::IntNeg, &[y]);
        let reach = self.op(Op::BitAnd, &[y, minus]);
        let (below, last) = (
            self.op(Op::IntAdd, &[y, reach]),
            self.int(height.saturating_sub(1) as i32),
        );
        let outside = self.op(Op::IntLess, &[last, below]);
        self.either(key, outside)
    }
}

impl Refine<'_> {
    /// What is dithered: the scene's shade where it is traced, else the neighbours' mean.
    fn refined(&self, b: &mut Builder, traced: NodeId) -> NodeId {
        let mut at = At(b, self.span);
        let [above, below, left] = Neighbour::ALL.map(|which| at.0.neighbour(which, at.1));
        let two = at.int(2);
        let sum = at.op(Op::IntAdd, &[above, below]);
        let mean = at.op(Op::IntDiv, &[sum, two]);
        let apart = at.differ(above, below, self.tolerance);
        let edge = at.differ(mean, left, self.tolerance);
        let differs = at.either(apart, edge);
        let key = at.is_key(self.step, self.height);
        let needed = at.either(key, differs);
        let level = at.level(traced);
        let kept = at.select(needed, level, mean);
        let shade = at.op(Op::ToReal, &[mean]);
        let part = at.real(1.0 / f64::from(LEVELS));
        let shade = at.op(Op::Mul, &[shade, part]);
        let shade = at.select(needed, traced, shade);
        b.keep(Refinement {
            step: self.step,
            tolerance: self.tolerance,
            kept,
        });
        shade
    }
}

impl Rewrite for Refine<'_> {
    fn node(
        &mut self,
        b: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        moved: Node,
        span: Span,
    ) -> Option<NodeId> {
        if !self.done
            && self.dither.reads(id, self.shade)
            && let Some(traced) = self.dither.seen(made, self.shade)
        {
            let refined = self.refined(b, traced);
            self.dither.put(self.shade, refined);
            self.done = true;
        }
        self.dither.make(b, made, (id, moved), span);
        None
    }

    fn end(
        &mut self,
        _: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        end: End,
    ) -> Option<NodeId> {
        match end {
            End::Ink | End::Output => self.dither.seen(made, id),
            _ => None,
        }
    }
}
