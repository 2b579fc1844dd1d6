//! Where values live, and what they are called in the program.

use super::in_place::in_place;
use super::logs;
use super::memory::{self, Machine, Places, Room};
use super::moved::{self, Moved};
use super::names::Names;
use super::shapes::{self, Shapes};
use super::slots::{Slot, of_axis};
use super::uses;
use crate::analysis::rate::rates;
use crate::homes::interference::{InPlace, homes};
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::Plan;
use crate::schedule::segment::bounds_segment;
use rustc_hash::FxHashMap;
use slowlight_routine::Format;
use slowlight_runtime_6502::write::{self, Place as Operand, Shape};
use std::collections::{BTreeMap, BTreeSet};

/// A slot's place in memory.
#[derive(Clone, Debug)]
pub(super) struct Home {
    pub name: String,
    pub address: u16,
}

/// Every slot's home, and where the program may begin behind them.
pub(super) struct Homes {
    homes: BTreeMap<Slot, Home>,
    /// Each param's name in the parameter block.
    pub params: Vec<String>,
    /// Conditions that the statement after them branches on: they have no home.
    pub fused: BTreeSet<NodeId>,
    /// Comparisons with the column that end runs.
    pub bounds: BTreeSet<NodeId>,
    /// Where the homes, rows of errors and the program are.
    pub places: Places,
    /// The subroutines' labels.
    subroutines: Vec<String>,
    /// The place whose home each place shares, where memory is short or homes are small.
    shared: FxHashMap<Place, Place>,
    /// In how many bytes values are kept, where that is by their ranges.
    shapes: Option<Shapes>,
    /// Reals that are kept at a second scale.
    moved: BTreeSet<Moved>,
}

/// For each place, the first of those that it shares a home with: where memory is short or the
/// zero page holds more of them, all that are never alive together, else copies of each other.
fn sharing(plan: &Plan, shapes: Option<&Shapes>) -> FxHashMap<Place, Place> {
    let is_safe = |id| in_place(plan, shapes, id);
    let homes = homes(plan, InPlace::Where(&is_safe));
    let bytes = |place| shapes.map_or(0, |shapes| shapes.of(plan, place).bytes);
    if !plan.tight && shapes.is_none() {
        return homes.one;
    }
    let mut first: FxHashMap<(Format, u8, usize), Place> = FxHashMap::default();
    let mut shared = FxHashMap::default();
    for (place, format) in plan.places() {
        if let Some(&at) = homes.number.get(&place) {
            let key = (format, bytes(place), at);
            let one = homes.one.get(&place).copied().unwrap_or(place);
            let one = if bytes(one) == bytes(place) {
                one
            } else {
                place
            };
            shared.insert(place, *first.entry(key).or_insert(one));
        }
    }
    shared
}

impl Homes {
    pub fn new(plan: &Plan) -> Homes {
        let fused = fused(plan);
        let shapes = shapes::shapes(plan);
        // A copy is none where both are in one.
        let shared = sharing(plan, shapes.as_ref());
        let moved = moved::moved(plan);
        let count = uses::counted(plan, &moved, &shared, &fused);
        let mut slots: Vec<(Slot, u64)> = count.into_iter().collect();
        slots.sort_by_key(|(slot, count)| (std::cmp::Reverse(*count), *slot));

        let mut names = Names::new(plan);
        let params = plan.params.iter().map(|p| names.fresh(&p.label)).collect();
        let mut homes = BTreeMap::new();
        let machine = Machine::of(plan);
        let mut zero_page = machine.zero_page(plan);
        let mut memory = 0u16;
        // What is not in the zero page: by how far behind the first of them it is.
        let mut behind = Vec::new();
        for (slot, _) in slots {
            let size = size(plan, shapes.as_ref(), slot);
            let name = names.fresh(&wanted(plan, slot));
            let room = zero_page
                .iter_mut()
                .find(|free| free.len() >= usize::from(size));
            if let Some(free) = room {
                let address = free.start;
                free.start += size;
                homes.insert(slot, Home { name, address });
            } else {
                behind.push((slot, name, memory));
                memory = memory.saturating_add(size);
            }
        }
        let errors = memory::error_bytes(plan).unwrap_or(0);
        let places = machine.places(plan, memory, errors);
        for (slot, name, at) in behind {
            let address = places.values.saturating_add(at);
            homes.insert(slot, Home { name, address });
        }
        let named = plan.tree.subroutines.iter();
        let subroutines = named
            .map(|s| names.fresh(&format!("do_{}", s.label())))
            .collect();
        Homes {
            homes,
            subroutines,
            shared,
            params,
            fused,
            bounds: bounds(plan),
            places,
            shapes,
            moved,
        }
    }

    /// The scales that a real is kept at beside its own.
    pub fn scales_kept(&self, id: NodeId) -> Vec<i8> {
        let all = self.moved.range((id, i8::MIN)..=(id, i8::MAX));
        all.map(|(_, to)| *to).collect()
    }

    /// Where a real is kept with so many fraction bits, if it is.
    pub fn kept_at(&self, id: NodeId, to: i8) -> Option<&str> {
        let kept = self.moved.contains(&(id, to));
        kept.then(|| self.name(Slot::Moved((id, to))))
    }

    /// What the program may take of the machine's memory.
    pub fn room(&self, plan: &Plan) -> Room {
        Machine::of(plan).room(plan, &self.places)
    }

    /// Every home, by address.
    pub fn by_address(&self) -> Vec<&Home> {
        let mut all: Vec<&Home> = self.homes.values().collect();
        all.sort_by_key(|home| home.address);
        all
    }

    /// How many bytes a slot has.
    pub fn bytes(&self, plan: &Plan, slot: Slot) -> u16 {
        size(plan, self.shapes.as_ref(), slot)
    }

    /// A slot's address.
    pub fn address(&self, slot: Slot) -> Option<u16> {
        self.homes.get(&slot).map(|home| home.address)
    }

    pub fn name(&self, slot: Slot) -> &str {
        self.homes.get(&slot).map_or("acc", |home| &home.name)
    }

    pub fn place(&self, place: Place) -> &str {
        self.name(Slot::Value(
            self.shared.get(&place).copied().unwrap_or(place),
        ))
    }

    /// A subroutine's label.
    pub fn subroutine(&self, id: SubroutineId) -> &str {
        self.subroutines
            .get(id.0 as usize)
            .map_or("unused", String::as_str)
    }

    /// A place as an operand.
    pub fn held_in(&self, plan: &Plan, place: Place) -> Operand {
        let name = self.place(place).to_owned();
        match &self.shapes {
            Some(_) if matches!(plan.place_format(place), Format::Log { .. }) => Operand::At(name),
            Some(shapes) => Operand::Held(name, shapes.of(plan, place)),
            None => Operand::At(name),
        }
    }

    /// What has a slot that is no place.
    fn held(&self, plan: &Plan, slot: Slot) -> Operand {
        let name = self.name(slot).to_owned();
        match &self.shapes {
            Some(_) => Operand::Held(name, shapes::of_slot(plan, slot)),
            None => Operand::At(name),
        }
    }

    /// The last column of a run as an operand.
    pub fn run_end(&self, plan: &Plan) -> Operand {
        self.held(plan, Slot::RunEnd)
    }

    /// How a place is kept, where that is by its range.
    pub fn shape(&self, plan: &Plan, place: Place) -> Option<Shape> {
        self.shapes.as_ref().map(|shapes| shapes.of(plan, place))
    }

    /// Where a node's value is read from.
    pub fn operand(&self, plan: &Plan, id: NodeId) -> Operand {
        let at = |slot| match logs::is_one(plan, id) {
            true => logs::operand(plan, id, self.name(slot).to_owned()),
            false => self.held(plan, slot),
        };
        match (plan.place(id), plan.graph.node(id)) {
            (Some(place), _) if logs::is_one(plan, id) => {
                logs::operand(plan, id, self.place(place).to_owned())
            }
            (Some(place), _) => self.held_in(plan, place),
            (None, Node::Const(c)) => Operand::Constant(plan.bits(c.value())),
            (None, Node::Param(p)) => at(Slot::Param(p.0)),
            (None, Node::Axis(axis)) => at(of_axis(axis)),
            (None, Node::Received) => at(Slot::Received),
            (None, Node::Neighbour(which)) => at(Slot::Neighbour(which)),
            (None, _) => Operand::Constant(0),
        }
    }
}

/// Comparisons of the column with what the row knows, where columns come in runs.
fn bounds(plan: &Plan) -> BTreeSet<NodeId> {
    if plan.tree.segment.is_empty() {
        return BTreeSet::new();
    }
    let rates = rates(&plan.graph);
    let ids = plan.graph.ids();
    ids.filter(|id| bounds_segment(&plan.graph, &rates, *id))
        .collect()
}

/// Bools that are computed directly before the one statement that branches on them.
fn fused(plan: &Plan) -> BTreeSet<NodeId> {
    let mut found = BTreeSet::new();
    let mut visit = |first: Option<&Statement>, cond: NodeId| {
        let computes = first == Some(&Statement::Let(cond));
        let compares = plan.routine(cond).is_some_and(|r| r.result == Format::Bool);
        if computes && compares && plan.folded(cond) {
            found.insert(cond);
        }
    };
    fn pairs(block: &Block, visit: &mut dyn FnMut(Option<&Statement>, NodeId)) {
        for (i, statement) in block.iter().enumerate() {
            match statement {
                Statement::If { cond, .. } => {
                    visit(i.checked_sub(1).and_then(|before| block.get(before)), *cond);
                }
                Statement::Loop(turns) => visit(turns.body.last(), turns.again),
                _ => {}
            }
            for inner in inner(statement) {
                pairs(inner, visit);
            }
        }
    }
    for block in plan.tree.blocks() {
        pairs(block, &mut visit);
    }
    found
}

fn size(plan: &Plan, shapes: Option<&Shapes>, slot: Slot) -> u16 {
    match (slot, shapes) {
        (Slot::Column(id), _) => {
            let entry = match shapes {
                Some(shapes) => shapes.of(plan, Place::Node(id)).bytes,
                None => shapes::entry(plan, id),
            };
            let bytes = u32::from(entry) * plan.graph.image.width;
            return u16::try_from(bytes).unwrap_or(u16::MAX);
        }
        (Slot::Value(place), Some(shapes)) => return u16::from(shapes.of(plan, place).bytes),
        (Slot::Neighbour(_), Some(_)) => return 1,
        (Slot::Sampling(what), _) => return what.bytes(),
        (Slot::Param(_) | Slot::Axis(_) | Slot::Received | Slot::RunEnd, Some(_)) => {
            return u16::from(shapes::of_slot(plan, slot).bytes);
        }
        _ => {}
    }
    match slot {
        Slot::Value(place) => u16::from(write::size(plan.place_format(place))),
        Slot::Moved(_) => u16::from(write::size(plan.runtime.real)),
        Slot::Turns(of) => 1 + u16::from(most_turns(plan, of) > 0xFF),
        Slot::Which | Slot::ScreenByte => 1,
        Slot::Column(_)
        | Slot::PassFirst
        | Slot::Errors(_)
        | Slot::Block(_)
        | Slot::ScreenAt
        | Slot::Sampling(_)
        | Slot::ScreenLine => 2,
        Slot::Param(p) => {
            let ty = plan.graph.params.get(p as usize).map(|p| p.ty);
            let format = ty.map_or(plan.runtime.int, |ty| plan.runtime.format_of(ty));
            u16::from(write::size(format)).max(4)
        }
        Slot::Received => u16::from(write::size(plan.runtime.real)),
        Slot::Axis(_) | Slot::RunEnd | Slot::Rows(_) | Slot::Neighbour(_) => 4,
    }
}

/// How often a loop's body runs at most.
pub(super) fn most_turns(plan: &Plan, of: LoopId) -> u32 {
    plan.graph.loops.get(of.0 as usize).map_or(1, |l| l.max)
}

fn wanted(plan: &Plan, slot: Slot) -> String {
    match slot {
        Slot::Value(place) => plan.home(place).to_owned(),
        Slot::Moved((id, to)) => {
            let scale = i32::from(to).to_string().replace('-', "minus_");
            format!("{}_at_{scale}", plan.home(Place::of(&plan.graph, id)))
        }
        Slot::Param(p) => {
            let label = plan.params.get(p as usize).map_or("param", |p| &p.label);
            format!("{label}_value")
        }
        Slot::Axis(Axis::X | Axis::Run) => "pixel_x".to_owned(),
        Slot::Axis(Axis::Y) => "pixel_y".to_owned(),
        Slot::Axis(Axis::Pass(_)) => "pixel_pass".to_owned(),
        Slot::Column(id) => format!("{}_by_column", plan.home(Place::Node(id))),
        Slot::PassFirst => "pass_first".to_owned(),
        Slot::RunEnd => "run_end".to_owned(),
        Slot::Block(Axis::Y) => "block_y".to_owned(),
        Slot::Block(_) => "block_x".to_owned(),
        Slot::Turns(of) => format!("turns_{}", of.0),
        Slot::Rows(false) => "first_row_value".to_owned(),
        Slot::Rows(true) => "last_row_value".to_owned(),
        Slot::Which => "which_param".to_owned(),
        Slot::Received => "received".to_owned(),
        Slot::Neighbour(which) => format!("left_{}", which.name()),
        Slot::Sampling(what) => what.name().to_owned(),
        Slot::Errors(k) => format!("errors_{k}"),
        Slot::ScreenByte => "screen_byte".to_owned(),
        Slot::ScreenAt => "screen_at".to_owned(),
        Slot::ScreenLine => "screen_line".to_owned(),
    }
}
