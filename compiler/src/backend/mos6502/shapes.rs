//! In how many bytes numbers are kept where reals have points of their own, or are
//! logarithms: as many as their ranges need, of reals two at least.

use super::logs;
use super::slots::Slot;
use crate::analysis::carried::{held_by, readers};
use crate::ir::graph::*;
use crate::ir::ramp;
use crate::ir::tree::*;
use crate::plan::Plan;
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::{Format, Op, Range, Type, scale};
use slowlight_runtime_6502::write::{Shape, size};

/// Bytes of an int at most.
const MOST: u8 = 4;

/// Places' shapes.
pub(super) struct Shapes {
    places: FxHashMap<Place, Shape>,
}

/// Whether numbers are kept in as many bytes as their ranges need: ints, where reals are
/// short.
pub(super) fn by_range(plan: &Plan) -> bool {
    plan.points().is_some() || logs::are(plan)
}

/// Those of such a plan.
pub(super) fn shapes(plan: &Plan) -> Option<Shapes> {
    if !by_range(plan) {
        return None;
    }
    let mut ranges: FxHashMap<Place, Range> = FxHashMap::default();
    let mut add = |place: Place, range: Range| {
        let known = ranges.entry(home(place)).or_insert(range);
        *known = known.join(range);
    };
    let result = |id: NodeId| plan.ranges.result.get(id.0 as usize).copied();
    for block in plan.tree.blocks() {
        walk(block, &mut |statement| match statement {
            Statement::Let(id) => add(
                Place::of(&plan.graph, *id),
                result(*id).unwrap_or(Range::ALL),
            ),
            Statement::Set {
                place,
                from: Origin::Node(id),
            } => {
                let from = plan.graph.constant(*id).map(|v| Range::point(v.real()));
                let undefined = matches!(plan.graph.node(*id), Node::Undefined(_));
                // What is undefined is looked at by nobody.
                if !undefined {
                    add(*place, from.or(result(*id)).unwrap_or(Range::ALL));
                }
            }
            _ => {}
        });
    }
    let asked = asked(plan);
    let carried = readers(&plan.graph);
    let shape = |place: Place, range: Range| match plan.place_format(place) {
        Format::Int { .. } => {
            let shape = Shape::of(stepped(plan, place).unwrap_or(range), MOST);
            let asked = match place {
                Place::Node(id) => asked.get(&id).copied().unwrap_or(MOST),
                _ => MOST,
            };
            if asked < shape.bytes {
                Shape::whole(asked)
            } else {
                shape
            }
        }
        Format::Bool => Shape::of(Range::new(0.0, 1.0), 1),
        real => match plan.points() {
            Some(points) => of_real(scale::in_units(range, points.place(place)), size(real)),
            // As who reads it knows it.
            None => logs::shape(plan, held_by(&carried, place).map_or(place, Place::Node)),
        },
    };
    let places = ranges.into_iter().map(|(p, r)| (p, shape(p, r))).collect();
    let mut shapes = Shapes { places };
    shapes.widen_steps(plan);
    Some(shapes)
}

/// That of reals that are whole numbers in such a range: their upper bit tells the sign.
fn of_real(units: Range, most: u8) -> Shape {
    let fits = |bytes: &u8| {
        let end = scale::most(8 * bytes) as f64;
        units.within(-end, end)
    };
    match (LEAST..most).find(fits) {
        Some(bytes) => Shape {
            bytes,
            signed: units.lo < 0.0,
            spare: units.lo >= 0.0,
        },
        None => Shape::whole(most),
    }
}

/// Of how many of their lower bytes ints are asked that are computed for others only: where
/// only the lowest bits of a sum count, no more of its terms do.
fn asked(plan: &Plan) -> FxHashMap<NodeId, u8> {
    let graph = &plan.graph;
    let mut computed: FxHashMap<NodeId, u8> = FxHashMap::default();
    let mut whole: FxHashSet<NodeId> = graph.reports.iter().copied().collect();
    whole.insert(graph.ink);
    for block in plan.tree.blocks() {
        walk(block, &mut |statement| match statement {
            Statement::Let(id) => _ = computed.insert(*id, 0),
            Statement::Set {
                from: Origin::Node(id),
                ..
            } => _ = whole.insert(*id),
            _ => {}
        });
    }
    // What asks mostly stands behind what it asks for in the graph.
    while ask(plan, &whole, &mut computed) {}
    computed.retain(|id, asked| *asked > 0 && !whole.contains(id));
    computed
}

/// Tells all operands how much of them is asked; whether any did not know.
fn ask(plan: &Plan, whole: &FxHashSet<NodeId>, computed: &mut FxHashMap<NodeId, u8>) -> bool {
    let graph = &plan.graph;
    let mut more = false;
    for id in graph.ids().rev() {
        let own = match whole.contains(&id) {
            true => MOST,
            false => computed.get(&id).copied().unwrap_or(MOST),
        };
        let node = graph.node(id);
        for operand in node.operands() {
            let asks = match (node, plan.routine(id).map(|r| r.name)) {
                (Node::Apply(..), Some("int_add" | "int_sub" | "int_neg")) => own,
                (Node::Apply(Op::BitAnd, args), _) if args.iter().any(|a| is_byte(graph, *a)) => 1,
                _ => MOST,
            };
            if let Some(known) = computed.get_mut(&operand) {
                more |= asks > *known;
                *known = asks.max(*known);
            }
        }
    }
    more
}

fn is_byte(graph: &Graph, id: NodeId) -> bool {
    let value = graph.constant(id).map(|value| value.int());
    value.is_some_and(|value| (0..256).contains(&value))
}

/// What a ramp stays within at all columns, whoever reads it there: its lower bytes are
/// stepped by those of its step, which is read at each of them.
fn stepped(plan: &Plan, place: Place) -> Option<Range> {
    let Place::Node(id) = place else {
        return None;
    };
    let Node::Ramp { .. } = plan.graph.node(id) else {
        return None;
    };
    let last = plan.graph.image.width.saturating_sub(1) as i32;
    let result = |id: NodeId| match plan.graph.constant(id) {
        Some(value) => Range::point(value.real()),
        None => (plan.ranges.result.get(id.0 as usize).copied()).unwrap_or(Range::ALL),
    };
    Some(ramp::range(&plan.graph, id, 0..=last, result))
}

/// A loop's place, where what is scratch goes in the end.
fn home(place: Place) -> Place {
    match place {
        Place::Scratch(l, k) => Place::Carried(l, k),
        other => other,
    }
}

impl Shapes {
    /// Gives what steps another as many bytes: to add a byte costs less than to extend what
    /// has fewer.
    fn widen_steps(&mut self, plan: &Plan) {
        // What is stepped is behind what steps it in the graph.
        for id in plan.graph.ids().rev() {
            let (Node::Ramp { step, .. } | Node::Stepped { step, .. }) = plan.graph.node(id) else {
                continue;
            };
            let Some(&own) = self.places.get(&Place::of(&plan.graph, id)) else {
                continue;
            };
            let of_step = self.places.get_mut(&Place::of(&plan.graph, step));
            if let Some(shape) = of_step.filter(|shape| shape.bytes < own.bytes) {
                shape.bytes = own.bytes;
            }
        }
    }

    /// A place's; of one that is never written, all of its format.
    pub fn of(&self, plan: &Plan, place: Place) -> Shape {
        let whole = || match plan.place_format(place) {
            Format::Bool => Shape::of(Range::new(0.0, 1.0), 1),
            Format::Log { .. } => logs::shape(plan, place),
            format => Shape::whole(size(format)),
        };
        self.places.get(&home(place)).copied().unwrap_or_else(whole)
    }
}

/// The shape of what is no place.
pub(super) fn of_slot(plan: &Plan, slot: Slot) -> Shape {
    match slot {
        Slot::Axis(_) | Slot::RunEnd => Shape::of(Range::new(0.0, 32767.0), MOST),
        Slot::Neighbour(_) => Shape::of(Range::new(0.0, 255.0), MOST),
        Slot::Received => Shape::whole(size(plan.runtime.real)),
        Slot::Param(p) => match plan.graph.params.get(p as usize).map(|p| p.ty) {
            Some(Type::Real) => Shape::whole(size(plan.runtime.real)),
            _ => Shape::whole(MOST),
        },
        _ => Shape::whole(MOST),
    }
}

/// Bytes of an entry, if nothing says better.
pub(super) fn entry(plan: &Plan, id: NodeId) -> u8 {
    size(plan.place_format(Place::Node(id)))
}

/// Reals have so many bytes at least.
pub(super) const LEAST: u8 = 2;
