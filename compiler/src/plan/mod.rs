//! The plan: how one machine computes a scene. Targets start from here.
//!
//! A [`Plan`] is a graph, the statement tree that says when each value is
//! computed ([`crate::ir::tree`]), and, for each value, a format, a routine
//! and a home. Emission only writes it down: everything that can fail has
//! failed before.
//!
//! What a target has to know:
//!
//! - The program draws picture rows `rows.0..=rows.1` and picture columns
//!   `columns.0..=columns.1` (both inclusive): `tree.frame` once, then `tree.column` for each of
//!   its x ([`Node::Tabulated`]), then for each y `tree.row`, then `tree.pass` for each pass over
//!   the row's columns, where the graph has such, then for each of its x `tree.segment` (or that
//!   only where one of its comparisons with x has changed) and `tree.pixel`, after which
//!   [`Graph::ink`] is the ink to plot at screen position (x + offset.0, y + offset.1), if the
//!   plan says [`Plan::plot`]. Where the image is of blocks ([`Image::block`]), columns and rows
//!   are of blocks, and the ink fills the one whose top left is at (x * block.0 + offset.0, y *
//!   block.1 + offset.1).
//! - [`Statement::Let`] computes node `id` by `plan.routine(id)` (operations) or by reading
//!   `graph.tables` (lookups; both indices clamp to the table unless `plan.ranges` proves them
//!   inside) and keeps it in the node's home.
//! - Homes: one variable for each node that is computed or set, one for each
//!   carried value that is read ([`Node::Carried`] and [`Node::Last`] share it),
//!   and one for each scratch place that is set. [`Plan::home`] names them:
//!   names are unique in the program, valid identifiers (lower-case letters,
//!   digits, `_`), and follow the scene.
//! - [`Plan::folded`]: a value read exactly once, by a later statement of the
//!   same block, whose operands still hold what they held: its expression may
//!   be written where it is read, and needs no home. Targets may also give it one.
//! - [`Node::Ramp`], let in the row's block, is set to its first value there, and
//!   stepped at the end of every pixel, whatever way the pixel took: `home = home +
//!   step`, a ramp before what it is stepped by. Where the first column computed is
//!   not 0, it is stepped there first.
//! - [`Node::Stepped`], let in the pixel's block, is kept where its first value is,
//!   which the segment's block sets: there it is stepped, `home = home + step`.
//! - A loop needs a count of its turns; see [`Statement::Loop`].
//! - Where the graph moves ([`Graph::is_moving`]), `tree.step` stands behind the picture, before
//!   it what is held is read into the params of [`Graph::buttons`], and behind it each state of
//!   [`Graph::steps`] is given its next value, all at once, as [`Plan::given`] says.
//! - Where the graph spreads its error ([`Plan::error_rows`]), [`Node::Received`] is what has
//!   come to the pixel, and after `tree.pixel` each share is added, by [`Plan::gather`], to what
//!   its pixel has received so far. Then [`Plan::computed_rows`] and columns are more than drawn.
//! - Where not all pixels are traced, [`KeptRows`] says what pixels leave to others.
//! - Constants, params and axes are read as such: [`Plan::bits`] gives a
//!   constant's bits, `params` how the parameter block writes each param.
//!
//! The model ([`crate::plan::model`]) runs the same plan bit for bit.

pub mod columns;
mod copies;
pub mod error;
mod error_rows;
mod kept_rows;
pub mod model;
pub(crate) mod params;
mod placing;
pub mod print;
mod semantics;
pub mod table_init;

pub use copies::Copies;
pub use error_rows::ErrorRows;
pub use kept_rows::KeptRows;
pub use params::ParamPlan;
pub(crate) use placing::placed;

use crate::analysis::points::Points;
use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::ir::ramp;
use crate::ir::tree::*;
use crate::schedule::constant_runs::Still;
use crate::source::Span;
use crate::targets::{Mode, Target};
use rustc_hash::FxHashMap;
use slowlight_routine::{Bits, Format, Routine, Runtime, Type, Value};

/// What to build, beside the scene and the target.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    /// The scene's name, for headers and file names.
    pub name: String,
    /// The screen's mode.
    pub mode: Mode,
    /// First and last picture row to draw; all where `None`.
    pub rows: Option<(u32, u32)>,
    /// Whether the program draws, or only computes (for timing).
    pub plot: bool,
}

/// How one machine computes a scene.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The scene's name.
    pub name: String,
    /// The target.
    pub target: &'static Target,
    /// Its routines in the formats chosen.
    pub runtime: &'static Runtime,
    /// The screen's mode.
    pub mode: Mode,
    /// Where the picture's top left stands on the screen; negative where it is cropped.
    pub offset: (i32, i32),
    /// First and last picture column drawn.
    pub columns: (u32, u32),
    /// First and last picture row drawn.
    pub rows: (u32, u32),
    /// Whether to draw.
    pub plot: bool,
    /// Whether to write it as small as it goes, where that costs the text its
    /// readability; the values are the same.
    pub tight: bool,
    /// Whether to write it for reading rather than for speed, where the target
    /// knows the difference; the values are the same.
    pub listing: bool,
    /// Whether to write it in as few characters as it goes, to be posted.
    pub toot: bool,
    /// Whether the values that are met most are kept at fixed addresses, where the
    /// machine finds them faster there (the Hack computer's processor, in Jack).
    pub statics: bool,
    /// Where the scene's items stand and what they are, in the order of the
    /// text: for listings.
    pub items: Vec<(Span, String)>,
    /// The scene's `draw`, where the loops over rows and columns and the drawing are to
    /// be told as lines of its own: in line maps.
    pub drawn: Option<Span>,
    /// Whether to write it short, but not so short that it becomes slow to read
    /// for the machine: between neither and [`Plan::tight`].
    pub lean: bool,
    /// What there is memory to write on each way to it.
    pub copies: Copies,
    /// Whether remarks beside the first line are left out, where memory is short.
    pub brief: bool,
    /// Whether it is written short where that hardly costs time: it does not fit otherwise.
    pub scant: bool,
    /// Whether a 6502's program may have the opcodes that its data sheet leaves out.
    pub undocumented: bool,
    /// Where a BBC Micro's program begins, if not where the disc system ends; whether unasked.
    pub page: Option<u16>,
    pub moved: bool,
    /// The values.
    pub graph: Graph,
    /// When each is computed.
    pub tree: Tree,
    /// Between which bounds each stays on this machine.
    pub ranges: Ranges,
    /// The live params, in the graph's order.
    pub params: Vec<ParamPlan>,
    pub(crate) routines: Vec<Option<&'static Routine>>,
    /// Where reals have their points, where that is the plan's affair.
    pub(crate) points: Option<Points>,
    pub(crate) tables: Vec<table_init::Made>,
    pub(crate) gather: Option<&'static Routine>,
    pub(crate) folded: Vec<bool>,
    /// The runs of columns whose pixels need no computing, if there may be such.
    pub still: Option<Still>,
    pub(crate) homes: FxHashMap<Place, String>,
    /// Whether a search for something cheaper was ended for want of fuel.
    pub(crate) cut: bool,
}

impl Plan {
    /// Whether it has subroutines.
    pub fn is_outlined(&self) -> bool {
        !self.tree.subroutines.is_empty()
    }

    /// Whether a pixel calls subroutines, not only what is done more seldom.
    pub fn calls_at_pixels(&self) -> bool {
        let mut calls = false;
        walk(&self.tree.pixel, &mut |statement| {
            calls |= matches!(statement, Statement::Call(_));
        });
        calls
    }

    /// Whether only what is done more seldom than pixels calls subroutines: the plan
    /// did not fit as it was.
    pub fn calls_seldom(&self) -> bool {
        self.is_outlined() && !self.calls_at_pixels()
    }

    /// Whether another plan of the same scene and target makes the same program.
    pub fn is_written_as(&self, other: &Plan) -> bool {
        let style = |plan: &Plan| {
            let short = (plan.tight, plan.lean, plan.brief, plan.scant, plan.copies);
            (short, plan.listing, plan.toot, plan.statics, plan.page)
        };
        let whole = (self.mode, self.rows) == (other.mode, other.rows);
        whole && style(self) == style(other) && self.tree == other.tree && self.graph == other.graph
    }

    /// For what it is planned.
    pub(crate) fn goal(&self) -> Goal {
        Goal {
            name: self.name.clone(),
            mode: self.mode,
            rows: Some(self.rows),
            plot: self.plot,
        }
    }
    /// Whether the search was ended because it had done all the work that it may: there may
    /// be a quicker plan.
    pub fn was_cut(&self) -> bool {
        self.cut
    }

    /// Notes that a search that led to it was ended before its time.
    pub fn note_cut(&mut self) {
        self.cut = true;
    }

    /// The routine that computes an operation.
    pub fn routine(&self, id: NodeId) -> Option<&'static Routine> {
        self.routines.get(id.0 as usize).copied().flatten()
    }

    /// First and last picture row that the screen has.
    pub fn shown_rows(&self) -> (u32, u32) {
        placed(&self.graph.image, &self.mode).2
    }

    /// The routine that adds what a pixel sends to what another has received
    /// so far, in that order, where the graph spreads its error.
    pub fn gather(&self) -> Option<&'static Routine> {
        self.gather
    }

    /// How the program has a table.
    pub fn table(&self, id: TableId) -> Option<&table_init::Made> {
        self.tables.get(id.0 as usize)
    }

    /// The bits of a table's entry.
    pub fn entry(&self, table: TableId, at: usize) -> Bits {
        let made = self.table(table).and_then(|made| made.bits.get(at));
        made.copied().unwrap_or(0)
    }

    /// Whether a value may be written where it is read.
    pub fn folded(&self, id: NodeId) -> bool {
        self.folded.get(id.0 as usize) == Some(&true)
    }

    /// Where each real's point is, where the format leaves that to the plan.
    pub fn points(&self) -> Option<&Points> {
        self.points.as_ref()
    }

    /// The format of a node's value.
    pub fn format(&self, id: NodeId) -> Format {
        match (&self.points, self.graph.ty(id)) {
            (Some(points), Type::Real) => points.format(id),
            (_, ty) => self.runtime.format_of(ty),
        }
    }

    /// The format of a live param.
    pub fn param_format(&self, id: ParamId) -> Format {
        let ty = self
            .graph
            .params
            .get(id.0 as usize)
            .map_or(Type::Real, |p| p.ty);
        self.read_as(ty, |node| matches!(node, Node::Param(p) if p == id))
    }

    /// Whether a param is what a player holds, which nobody writes down.
    pub fn is_held(&self, id: ParamId) -> bool {
        self.graph.buttons().any(|(button, _)| button == id)
    }

    /// The node that reads a param, if something does.
    pub fn param_node(&self, id: ParamId) -> Option<NodeId> {
        let mut ids = self.graph.ids();
        ids.find(|node| self.graph.node(*node) == Node::Param(id))
    }

    /// The format of a table's entries.
    pub fn entry_format(&self, id: TableId) -> Format {
        let ty = self
            .graph
            .tables
            .get(id.0 as usize)
            .map_or(Type::Real, |t| t.ty);
        self.read_as(
            ty,
            |node| matches!(node, Node::Lookup { table, .. } if table == id),
        )
    }

    /// The format of what some nodes read, if they are there; that of the type without.
    fn read_as(&self, ty: Type, reads: impl Fn(Node) -> bool) -> Format {
        let points = self.points.as_ref().filter(|_| ty == Type::Real);
        let reader = points.and_then(|_| self.graph.ids().find(|id| reads(self.graph.node(*id))));
        reader.map_or(self.runtime.format_of(ty), |id| self.format(id))
    }

    /// A constant's bits in its type's format.
    pub fn bits(&self, value: Value) -> Bits {
        (self.runtime.encode)(value, self.runtime.format_of(value.ty()))
    }

    /// The name of a place's variable.
    pub fn home(&self, place: Place) -> &str {
        self.homes.get(&place).map_or("unused", String::as_str)
    }

    /// The place that a node is read from; `None` for constants, params and axes.
    pub fn place(&self, id: NodeId) -> Option<Place> {
        match self.graph.node(id) {
            Node::Const(_)
            | Node::Param(_)
            | Node::Axis(_)
            | Node::Received
            | Node::Neighbour(_)
            | Node::Undefined(_) => None,
            Node::Carried { of, index } | Node::Last { of, index } => {
                Some(Place::Carried(of, index))
            }
            _ => Some(Place::of(&self.graph, id)),
        }
    }

    /// Whether a value is an entry of an array by columns ([`Node::Tabulated`]): what is set
    /// of it goes there at once, since its home may be another's by the column's end.
    pub fn is_tabulated(&self, id: NodeId) -> bool {
        matches!(self.graph.node(id), Node::Tabulated(_))
    }

    /// Every place that the tree writes, in order of first writing, with its format.
    pub fn places(&self) -> Vec<(Place, Format)> {
        let mut all: Vec<(Place, Format)> = Vec::new();
        let mut seen = rustc_hash::FxHashSet::default();
        for block in self.tree.blocks() {
            walk(block, &mut |statement| {
                let place = match statement {
                    Statement::Let(id) => Place::of(&self.graph, *id),
                    Statement::Set { place, .. } => *place,
                    _ => return,
                };
                if seen.insert(place) {
                    all.push((place, self.place_format(place)));
                }
            });
        }
        all
    }

    /// The format of what a place holds.
    pub fn place_format(&self, place: Place) -> Format {
        match place {
            Place::Node(id) => self.format(id),
            Place::Carried(l, k) | Place::Scratch(l, k) => {
                let found = self
                    .graph
                    .loops
                    .get(l.0 as usize)
                    .and_then(|l| l.types.get(k as usize));
                match (&self.points, found.copied().unwrap_or(Type::Real)) {
                    (Some(points), Type::Real) => points.place_format(place),
                    (_, ty) => self.runtime.format_of(ty),
                }
            }
        }
    }

    /// The ramps that a row or pass sets and their steps, in the order of stepping.
    pub fn ramps(&self) -> Vec<(NodeId, NodeId)> {
        let mut set = Vec::new();
        for block in [&self.tree.row, &self.tree.pass] {
            walk(block, &mut |statement| {
                if let Statement::Let(id) = statement {
                    set.push(*id);
                }
            });
        }
        ramp::in_steps(&self.graph, set)
    }

    /// The names of the parts of the runtime that the routines need, closed
    /// over what those need; in the runtime's order.
    pub fn parts(&self) -> Vec<&'static slowlight_routine::Part> {
        let names = (self.routines.iter())
            .chain([&self.gather])
            .flatten()
            .flat_map(|r| r.needs.iter().copied());
        self.runtime.closure(names)
    }
}
