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

use crate::eval::native::Native;
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

/// How many of sixteen pixels between key rows are thought to be traced until [`expected`] has
/// looked.
const USUAL: u8 = 6;

/// Bands on which it is seen how many are, and how many operations that may take.
const BANDS: u32 = 6;
const OPERATIONS: u64 = 20_000_000;

/// The graph with how many of its pixels are expected to be traced, as bands of its native
/// picture have it.
pub fn expected(mut graph: Graph) -> Graph {
    let Some(mut refinement) = graph.refinement else {
        return graph;
    };
    let mut native = Native::within(&graph, OPERATIONS);
    let bands = graph.image.height / refinement.step;
    let mut pixels = Vec::new();
    for k in 0..BANDS.min(bands) {
        let band = (2 * k + 1) * bands / (2 * BANDS.min(bands));
        for y in band * refinement.step..(band + 1) * refinement.step {
            native.pixels(0..graph.image.width as i32, y as i32, &mut pixels);
            pixels.clear();
        }
        if native.spent() {
            break;
        }
    }
    refinement.often = (16.0 * native.traced_between()).round() as u8;
    graph.refinement = Some(refinement);
    graph
}

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
            often: USUAL,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::verify::verify;
    use crate::eval::arithmetic::Exact;
    use crate::eval::drawn::{lowered, native};
    use crate::eval::neighbours::Neighbours;
    use crate::eval::run::Run;
    use crate::schedule::statements::schedule;

    /// The column takes part in the shade and in the dither, by the same expression too.
    const STEP: &str = "image 24 x 20 inks black, grey, white;
draw (x, y) = threshold(if x + y < 18 then (x mod 8) / 200 else 0.5 + y / 100,
  bayer(4)[(x mod 8) mod 4, y mod 4]);
";

    /// The byte that is kept of a shade.
    fn level(shade: f64) -> i32 {
        (shade.clamp(0.0, 1.0) * f64::from(LEVELS) + 0.5).floor() as i32
    }

    #[test]
    fn a_pixel_is_the_scenes_or_its_neighbours_mean() {
        let whole = lowered(STEP);
        let refined = refine(&whole, 4, TOLERANCE).expect("it has a shade");
        assert_eq!(verify(&refined).err(), None);
        let (plain, made) = (native(&whole), native(&refined));
        let mut neighbours = Neighbours::new(&refined).expect("neighbours");
        let mut left = std::collections::BTreeMap::new();
        let (mut traced, mut others) = (0, 0);
        for y in 0..20 {
            for x in 0..24 {
                let mut all = neighbours.due(x, y);
                all.push((x, y));
                for (x, y) in all {
                    let around = neighbours.around(x, y);
                    let (column, row) = (x as usize, y as usize);
                    let (is, was) = (made[row][column], plain[row][column]);
                    let is_traced = neighbours.traces_between(y, around).unwrap_or(true);
                    let kept = match is_traced {
                        true => {
                            assert_eq!(is, was, "({x}, {y})");
                            level(was.shade)
                        }
                        false => {
                            let mean = (around[0] + around[1]) / 2;
                            let shade = f64::from(mean) * (1.0 / 255.0);
                            assert_eq!(is.shade, shade, "({x}, {y})");
                            mean
                        }
                    };
                    if left.insert((x, y), kept).is_none() {
                        traced += i32::from(is_traced);
                        others += i32::from(!is_traced);
                    }
                    neighbours.keep(x, y, kept);
                }
            }
        }
        assert!(traced > 100 && others > 100, "{traced} and {others}");
    }

    /// In any order of rows, and in lanes or through statements.
    #[test]
    fn evaluations_agree_on_refined_pictures() {
        for step in STEPS {
            let refined = refine(&lowered(STEP), step, TOLERANCE).expect("it has a shade");
            let all = native(&refined);
            let tree = schedule(&refined);
            let mut run = Run::new(&refined, &tree, Exact(&refined));
            for y in (0..20).rev() {
                for x in 0..24 {
                    let ink = run.pixel(x, y).int();
                    let found = all[y as usize][x as usize].ink;
                    assert_eq!(ink, i32::from(found), "({x}, {y}) every {step}");
                }
            }
            assert_eq!(run.unset_reads(), 0);
            assert!(run.traced() < 24 * 20, "{step}");
        }
    }

    #[test]
    fn a_refined_graph_is_read_back() {
        let made = refine(&lowered(STEP), 8, 3).expect("it has a shade");
        let text = made.to_string();
        assert!(text.contains(" every 8 within 3 often 6\n"), "{text}");
        let read = crate::ir::read::read(&text).expect("it reads");
        assert_eq!(read.refinement, made.refinement);
        assert_eq!(verify(&read).err(), None);
    }

    #[test]
    fn what_has_no_shade_of_its_own_is_not_refined() {
        let inks = lowered("image 8 x 8 inks black, white; draw (x, y) = ink(x mod 2);");
        assert_eq!(refine(&inks, 8, 0), Err(Unrefined::NoShade));
        let sent = lowered("image 8 x 8 inks black, white; draw (x, y) = floyd(x / 8, x, y);");
        assert_eq!(refine(&sent, 8, 0), Err(Unrefined::Spreads));
    }
}
