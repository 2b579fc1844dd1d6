//! Fixed-point word-length optimisation: where each real's point stands, in formats that leave
//! that to the plan ([`Format::Scaled`]): as many fraction bits as its range leaves room for.
//!
//! First the ranges are walked with exact reals ([`Slack::expecting`]). Intervals know
//! little of vectors, so where they are far wider than what pixels show that are spread over
//! the picture, with params all over their ranges ([`sample`]), a value is expected to
//! stay within twice that. From these ranges the points follow: a value has no more
//! fraction bits than fit, nor more than its operands give it, nor more than anybody reads.
//! What nobody tells apart counts for nothing there ([`saturation`]).
//! Then the ranges are walked again with what the machine does: every value is rounded to
//! its last place and ends where its bits do ([`Slack::with_points`]). What that second walk
//! does not prove to stay within its bits is computed by a routine that saturates. So an
//! expectation that is wrong costs accuracy, and nothing wraps.
//!
//! Copies and operands may be read at another scale than a value has; see
//! [`slowlight_routine::scale`].
//!
//! [`Slack::expecting`]: crate::analysis::range::Slack::expecting
//! [`Slack::with_points`]: crate::analysis::range::Slack::with_points

pub(crate) mod precision;
#[cfg(test)]
mod precision_tests;

mod adjoint;
mod doubts;
pub(crate) mod encode;
mod histogram;
mod low_discrepancy;
mod rates;
pub(crate) mod sample;
#[cfg(test)]
mod sample_tests;
mod saturation;
mod scales;
mod tape;
mod uniform;
mod watch;

use crate::analysis::points::unify::{Other, agreed};
use crate::analysis::points::widths::Widths;
use crate::analysis::points::{Points, RECEIVED};
use crate::analysis::range::{Ranges, Slack, ranges};
use crate::ir::graph::*;
use crate::ir::tree::*;
use rustc_hash::{FxHashMap, FxHashSet};
use scales::{cap, greatest, only_cut, power, wanted};
use slowlight_routine::scale::{self, Scales, finest, fitting};
use slowlight_routine::{Format, Op, Range, Routine, Runtime, Type};

/// How often ranges are cut to what is useful.
const ROUNDS: u32 = 2;

/// What is compared must be told from what it is compared with.
const BESIDE: f64 = 1.0 + 1.0 / 64.0;

/// What only the sign is asked of keeps one: at 0 it would be told from nothing.
const LEAST: f64 = 1.0 / (1u64 << 40) as f64;

/// The points of a plan, and its ranges with them, by pixels that may run so many statements;
/// nothing where the format has its own.
pub fn pointed(
    graph: &Graph,
    tree: &Tree,
    runtime: &'static Runtime,
    most: u64,
) -> Option<(Points, Ranges)> {
    let Format::Scaled { bits } = runtime.real else {
        return None;
    };
    let seen = sample::seen(graph, tree, bits, most);
    Some(placed(
        (graph, tree),
        runtime,
        &seen,
        &Widths::uniform(bits),
    ))
}

/// The points of values of such widths, and the ranges with them.
pub(crate) fn placed(
    (graph, tree): (&Graph, &Tree),
    runtime: &'static Runtime,
    seen: &sample::Sample,
    widths: &Widths,
) -> (Points, Ranges) {
    let sampled = sample::expected((graph, tree), seen, widths);
    let walk =
        |expected: &[Option<f64>]| ranges(graph, tree, &Slack::expecting(runtime, expected.into()));
    let mut expected = sampled.ends;
    let shared = &sampled.shared[..];
    // Nothing is cut where its format does not end.
    Points::new((graph, tree), &walk(&expected), runtime, (widths, shared)).ends(
        graph,
        &mut expected,
        &sampled.all,
    );
    let mut planned = walk(&expected);
    // What is cut makes what is made of it smaller.
    for _ in 0..ROUNDS {
        let useful = saturation::useful(graph, tree, &planned);
        for (expected, useful) in expected.iter_mut().zip(&useful) {
            let most = (useful.magnitude() * BESIDE).max(LEAST);
            *expected = Some(expected.map_or(most, |held| held.min(most)));
        }
        planned = walk(&expected);
    }
    let points = Points::new((graph, tree), &planned, runtime, (widths, shared));
    let slack = Slack::with_points(runtime, points.clone());
    let found = ranges(graph, tree, &slack);
    (points, found)
}

impl Points {
    /// The points that ranges leave room for, none finer than those that values are to share.
    pub fn new(
        (graph, tree): (&Graph, &Tree),
        ranges: &Ranges,
        runtime: &Runtime,
        (widths, shared): (&Widths, &[Option<i8>]),
    ) -> Points {
        let rooms = Rooms::new(graph, ranges, (widths, shared));
        let copies = Copies::of(graph, tree);
        let capped = |id: NodeId| {
            let (bits, own) = (widths.value(id), rooms.of(widths.value(id), id));
            match graph.node(id) {
                _ if copies.is_copy(id) => own,
                Node::Apply(op, args) if graph.ty(id) == Type::Real => {
                    own.min(cap(graph, (op, args), (own, bits), rooms.all(bits)))
                }
                _ => own,
            }
        };
        let mut own: Vec<i8> = graph.ids().map(capped).collect();
        for (own, shared) in own.iter_mut().zip(shared) {
            *own = shared.map_or(*own, |shared| shared.min(*own));
        }
        no_finer(graph, &copies, &mut own);
        copies.no_finer(&mut own);
        read_at_most(graph, &copies, widths, &mut own);
        for id in graph.ids().filter(|id| graph.ty(*id) != Type::Real) {
            own[id.0 as usize] = 0;
        }
        // A param and a table are held once, whoever reads them.
        let home = |node: &Node| match node {
            Node::Param(p) => Some(2 * p.0 as usize),
            Node::Lookup { table, .. } => Some(2 * table.0 as usize + 1),
            _ => None,
        };
        let homes = 2 * graph.params.len().max(graph.tables.len());
        let homes = (homes, home as Other);
        let carried = agreed(graph, &mut own, (i8::MAX, i8::min), homes);
        // As far as each width has room for them.
        let held: Vec<(u8, Vec<i8>)> = (rooms.0.iter())
            .map(|(bits, room)| {
                (
                    *bits,
                    own.iter().zip(room).map(|(o, r)| *o.min(r)).collect(),
                )
            })
            .collect();
        let scales = (graph.ids())
            .map(|id| match graph.node(id) {
                Node::Apply(op, args) if scale::concerns(op) => {
                    let bits = widths.operands(id);
                    // Only whole ints are exact, and only routines that know it make what is longer.
                    let made = |longer| longer == 0 || runtime.middle && bits == 16;
                    let fits = |args, longer| {
                        made(longer) && product_fits(ranges, id, args, (longer, bits))
                    };
                    let held = held.iter().find(|(of, _)| *of == bits);
                    let held = held.map_or(own.as_slice(), |(_, held)| held);
                    wanted(
                        graph,
                        (op, args),
                        (own[id.0 as usize], widths.operation(id)),
                        (held, rooms.all(bits), bits),
                        &fits,
                    )
                }
                _ => Scales::default(),
            })
            .collect();
        Points {
            widths: widths.clone(),
            shifted: runtime.shifted,
            own,
            carried,
            scales,
        }
    }
}

/// How many fraction bits each value has room for, in each width.
struct Rooms(Vec<(u8, Vec<i8>)>);

impl Rooms {
    fn new(graph: &Graph, ranges: &Ranges, (widths, shared): (&Widths, &[Option<i8>])) -> Rooms {
        let greatest = |id: NodeId| {
            let range = ranges.result[id.0 as usize];
            let shared = shared.get(id.0 as usize).copied().flatten();
            let shared =
                shared.map(|frac| scale::most(widths.value(id)) as f64 * (-f64::from(frac)).exp2());
            match (graph.node(id), graph.constant(id)) {
                (_, Some(value)) => value.real().abs().min(range.magnitude()),
                (Node::Received, _) => RECEIVED,
                // Where values share a point, entries are cut to it.
                (Node::Lookup { table, .. }, _) => shared.unwrap_or_else(|| greatest(graph, table)),
                _ => range.magnitude(),
            }
        };
        let greatest: Vec<f64> = graph.ids().map(greatest).collect();
        let of = |bits: u8| greatest.iter().map(|g| fitting(*g, bits)).collect();
        Rooms(widths.all().map(|bits| (bits, of(bits))).collect())
    }

    /// Those in one width.
    fn all(&self, bits: u8) -> &[i8] {
        let found = self.0.iter().find(|(of, _)| *of == bits);
        found.map_or(&[], |(_, all)| all)
    }

    fn of(&self, bits: u8, id: NodeId) -> i8 {
        self.all(bits)[id.0 as usize]
    }
}

/// The routine that divides a param by a power of ten.
pub fn divided(runtime: &Runtime, own: i8) -> Option<&'static Routine> {
    let number = Range::point(f64::from(own));
    let fits =
        |r: &&Routine| r.op == Op::Div && (r.domain)(&[Range::ALL, Range::ALL, number], Range::ALL);
    runtime.routines.iter().find(fits)
}

/// Leaves what is one of its operands, or the sum of them, no more bits than the finest of
/// these has; and a power of two of another value, of which only whole numbers are read, those
/// that this has, moved.
fn no_finer(graph: &Graph, copies: &Copies, own: &mut [i8]) {
    let places = only_cut(graph);
    let computed = |id: &NodeId| graph.ty(*id) == Type::Real && !copies.is_copy(*id);
    for id in graph.ids().filter(computed) {
        let Node::Apply(op, args) = graph.node(id) else {
            continue;
        };
        let live = args[..op.arity()]
            .iter()
            .filter(|arg| graph.constant(**arg).is_none());
        let finest = live.map(|arg| own[arg.0 as usize]).max();
        let moved = args.iter().find_map(|arg| power(graph, *arg));
        let finest = match (op, moved) {
            (Op::Mul, Some(by)) if places[id.0 as usize] => {
                finest.map(|finest| (finest + by).max(scale::FEWEST))
            }
            _ => finest.filter(|_| at_one_scale(op)),
        };
        if let Some(finest) = finest {
            own[id.0 as usize] = own[id.0 as usize].min(finest);
        }
    }
}

/// What statements alone hand on: values that subroutines are given, and those that they leave
/// behind, each at the node that it is a copy for.
struct Copies {
    /// From what, and for what node.
    all: Vec<(NodeId, NodeId)>,
    to: FxHashSet<NodeId>,
}

impl Copies {
    fn of(graph: &Graph, tree: &Tree) -> Copies {
        let mut all = Vec::new();
        for block in tree.blocks() {
            walk(block, &mut |statement| {
                if let Statement::Set {
                    place: Place::Node(to),
                    from: Origin::Node(from),
                } = statement
                    && !is_of(graph.node(*to), *from)
                {
                    all.push((*from, *to));
                }
            });
        }
        let to = all.iter().map(|(_, to)| *to).collect();
        Copies { all, to }
    }

    /// Leaves a copy no more bits than the finest has that it is made of.
    fn no_finer(&self, own: &mut [i8]) {
        let mut finest: FxHashMap<NodeId, i8> = FxHashMap::default();
        for (from, to) in &self.all {
            let finest = finest.entry(*to).or_insert(scale::FEWEST);
            *finest = (*finest).max(own[from.0 as usize]);
        }
        for (to, finest) in finest {
            let own = &mut own[to.0 as usize];
            *own = (*own).min(finest);
        }
    }

    /// Whether a value is not computed where its node says so: what that would be made of is
    /// computed nowhere.
    fn is_copy(&self, id: NodeId) -> bool {
        self.to.contains(&id)
    }
}

/// Whether a value is one of those that a node is made of by statements: an arm of a choice, what
/// is kept by columns.
fn is_of(node: Node, from: NodeId) -> bool {
    match node {
        Node::Select { yes, no, .. } => [yes, no].contains(&from),
        Node::Tabulated(_) => true,
        _ => false,
    }
}

/// Leaves a value the bits that somebody reads.
fn read_at_most(graph: &Graph, copies: &Copies, widths: &Widths, own: &mut [i8]) {
    let bits = widths.most();
    let mut read = vec![scale::FEWEST; graph.nodes.len()];
    let all = graph.loops.iter().flat_map(Loop::roots);
    for id in all.chain(graph.outputs()) {
        read[id.0 as usize] = finest(bits);
    }
    for (id, _) in &copies.all {
        read[id.0 as usize] = finest(bits);
    }
    for id in graph.ids().rev() {
        let at = id.0 as usize;
        let set = match graph.node(id) {
            Node::Lookup { .. } | Node::Received | Node::Slot(_) => true,
            Node::Apply(op, _) => scale::given(op, widths.value(id)).is_some(),
            // A state that nothing reads is still what it is.
            Node::Param(p) => read[at] == scale::FEWEST && is_state(graph, p),
            _ => false,
        };
        if !set {
            own[at] = own[at].min(read[at].max(scale::FEWEST));
        }
        let (most, sum) = match graph.node(id) {
            Node::Apply(op, _) => (finest(bits), at_one_scale(op)),
            Node::Select { .. } | Node::Tabulated(_) => (finest(bits), true),
            _ => (finest(bits), false),
        };
        let most = if sum && graph.ty(id) == Type::Real {
            own[at] + i8::from(is_twice(graph, id))
        } else {
            most
        };
        for arg in graph.node(id).operands().filter(|_| !copies.is_copy(id)) {
            let read = &mut read[arg.0 as usize];
            *read = (*read).max(most);
        }
    }
}

/// Whether a param is a state.
fn is_state(graph: &Graph, id: ParamId) -> bool {
    let param = graph.params.get(id.0 as usize);
    param.is_some_and(|param| param.role == Role::State)
}

/// Whether a value is added to itself.
fn is_twice(graph: &Graph, id: NodeId) -> bool {
    matches!(graph.node(id), Node::Apply(Op::Add, [a, b]) if a == b)
}

/// Operations whose operands are read at the scale of the result.
fn at_one_scale(op: Op) -> bool {
    matches!(
        op,
        Op::Add | Op::Sub | Op::Min | Op::Max | Op::Mod | Op::Neg | Op::Abs
    )
}

/// Whether a product that is so many bits longer than its result fits into it.
fn product_fits(ranges: &Ranges, id: NodeId, args: [i8; 2], (longer, bits): (i8, u8)) -> bool {
    let units = |k: usize| {
        let range: Range = ranges.args[id.0 as usize][k];
        scale::in_units(range, args[k]).magnitude()
    };
    units(0) * units(1) <= (scale::most(bits) as f64 * 0.99) * f64::from(longer).exp2()
}
