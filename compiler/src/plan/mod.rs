//! The plan: how one machine computes a scene. Targets start from here.
//!
//! A [`Plan`] is a graph, the statement tree that says when each value is
//! computed ([`crate::flow::tree`]), and, for each value, a format, a routine
//! and a home. Emission only writes it down: everything that can fail has
//! failed before.
//!
//! What a target has to know:
//!
//! - The program draws picture rows `rows.0..=rows.1` and picture columns
//!   `columns.0..=columns.1` (both inclusive): `tree.frame` once, then for each
//!   y `tree.row`, then `tree.pass` for each pass over the row's columns, where the
//!   graph has such, then for each of its x `tree.segment` (or that only where one of its
//!   comparisons with x has changed) and `tree.pixel`, after which [`Graph::ink`] is
//!   the ink to plot at screen position (x + offset.0, y + offset.1), if the
//!   plan says [`Plan::plot`].
//! - [`Statement::Let`] computes node `id` by `plan.routine(id)` (operations) or
//!   by reading `graph.tables` (lookups; both indices clamp to the table unless
//!   `plan.ranges` proves them inside) and keeps it in the node's home.
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
//! - A loop needs a count of its turns; see [`Statement::Loop`].
//! - Where the graph spreads its error ([`Plan::error_rows`]), [`Node::Received`]
//!   is what has come to the pixel, and after `tree.pixel` each share is added,
//!   by [`Plan::gather`], to what its pixel has received so far. Then all rows
//!   from 0 and all columns are computed, and only those above are drawn.
//! - Constants, params and axes are read as such: [`Plan::bits`] gives a
//!   constant's bits, `params` how the parameter block writes each param.
//!
//! The model ([`crate::eval::model`]) runs the same plan bit for bit.

mod again;
mod cheaper;
mod choose;
mod fold_uses;
mod lifetimes;
mod merge;
mod names;
mod outlined;
mod params;
mod price;
#[cfg(test)]
mod price_tests;
pub mod print;
pub mod recipes;
pub(crate) mod settled;
mod spread;
mod stepped;

pub use lifetimes::{quick_homes, shared_homes};
pub use merge::merged;
pub use params::ParamPlan;
pub use spread::ErrorRows;

use crate::flow::graph::*;
use crate::flow::tree::*;
use crate::flow::verify::verify;
use crate::passes::early::without;
use crate::passes::fold::fold;
use crate::passes::interlace::interlaced;
use crate::passes::schedule::missing;
use crate::passes::stable::stable;
use crate::passes::still::{Still, still};
use crate::range::{Ranges, Slack};
use crate::source::{Diagnostic, Span};
use crate::target::{Mode, Target};
use cheaper::{apart_at_last, cheaper, with_recipes_followed};
use price::{Price, Thrift};
use settled::{Settled, scheduled, settle};
use slowlight_routine::{Bits, Format, Op, Range, Routine, Runtime, Type, Value};
use std::collections::HashMap;
use stepped::{Steps, stepped};

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
    /// Where the scene's items stand and what they are, in the order of the
    /// text: for listings.
    pub items: Vec<(Span, String)>,
    /// Whether to write it short, but not so short that it becomes slow to read
    /// for the machine: between neither and [`Plan::tight`].
    pub lean: bool,
    /// Where programs begin in a BBC Micro's memory, where that was asked for.
    pub page: Option<u16>,
    /// The values.
    pub graph: Graph,
    /// When each is computed.
    pub tree: Tree,
    /// Between which bounds each stays on this machine.
    pub ranges: Ranges,
    /// The live params, in the graph's order.
    pub params: Vec<ParamPlan>,
    routines: Vec<Option<&'static Routine>>,
    tables: Vec<recipes::Made>,
    gather: Option<&'static Routine>,
    folded: Vec<bool>,
    /// The runs of columns whose pixels need no computing, if there may be such.
    pub still: Option<Still>,
    homes: HashMap<Place, String>,
    /// What was planned, and how its formulas could be rewritten.
    origin: (Box<Graph>, Rewriting),
}

impl Plan {
    /// The routine that computes an operation.
    pub fn routine(&self, id: NodeId) -> Option<&'static Routine> {
        self.routines.get(id.0 as usize).copied().flatten()
    }

    /// The routine that adds what a pixel sends to what another has received
    /// so far, in that order, where the graph spreads its error.
    pub fn gather(&self) -> Option<&'static Routine> {
        self.gather
    }

    /// How the program has a table.
    pub fn table(&self, id: TableId) -> Option<&recipes::Made> {
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

    /// The format of a node's value.
    pub fn format(&self, id: NodeId) -> Format {
        self.runtime.format_of(self.graph.ty(id))
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
            | Node::Undefined(_) => None,
            Node::Carried { of, index } | Node::Last { of, index } => {
                Some(Place::Carried(of, index))
            }
            _ => Some(Place::Node(id)),
        }
    }

    /// Every place that the tree writes, in order of first writing, with its format.
    pub fn places(&self) -> Vec<(Place, Format)> {
        let mut all: Vec<(Place, Format)> = Vec::new();
        let mut seen = std::collections::HashSet::new();
        for block in self.tree.blocks() {
            walk(block, &mut |statement| {
                let place = match statement {
                    Statement::Let(id) => Place::Node(*id),
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
                self.runtime.format_of(found.copied().unwrap_or(Type::Real))
            }
        }
    }

    /// The names of the parts of the runtime that the routines need, closed
    /// over what those need; in the runtime's order.
    pub fn parts(&self) -> Vec<&'static slowlight_routine::Part> {
        let names = self
            .routines
            .iter()
            .chain([&self.gather])
            .flatten()
            .flat_map(|r| r.needs.iter().copied());
        self.runtime.closure(names)
    }
}

/// Plans a graph that `sema` lowered for this target's inks and offset.
pub fn plan(graph: &Graph, target: &'static Target, goal: &Goal) -> Result<Plan, Vec<Diagnostic>> {
    let all = Rewriting::Fast {
        thrift: Thrift::default(),
        steps: Steps::All,
    };
    planned(graph, target, goal, all)
}

/// The same without the passes that rewrite formulas ([`crate::passes::stable`]
/// and those for speed): every one as the scene has it. For warnings about what the formulas lose, and to show what the pass does.
pub fn plan_as_written(
    graph: &Graph,
    target: &'static Target,
    goal: &Goal,
) -> Result<Plan, Vec<Diagnostic>> {
    planned(graph, target, goal, Rewriting::None)
}

/// Which passes may rewrite formulas.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rewriting {
    /// None: every formula as the scene has it.
    None,
    /// [`crate::passes::stable`].
    Stable,
    /// Those for speed, too; perhaps with little memory.
    Fast { thrift: Thrift, steps: Steps },
}

/// How often stable forms are looked for: what one makes may let another in.
const STABLE_ROUNDS: u32 = 4;

fn planned(
    origin: &Graph,
    target: &'static Target,
    goal: &Goal,
    rewriting: Rewriting,
) -> Result<Plan, Vec<Diagnostic>> {
    let runtime = target.runtime;
    if let Err(broken) = verify(origin) {
        let message =
            format!("the graph is broken: {broken}; a fault of the compiler, please report it");
        return Err(vec![Diagnostic::error(origin.span(broken.node), message)]);
    }
    let params = params::params(origin, runtime)?;
    let slack = Slack::of(runtime);
    let rounds = match rewriting {
        Rewriting::None => 0,
        _ => STABLE_ROUNDS,
    };
    let drawn = |graph: Graph| match rewriting {
        Rewriting::Fast { thrift, .. } if thrift.passes() && runtime.segments => {
            interlaced(&graph, (target.pixels)(&goal.mode)).unwrap_or(graph)
        }
        _ => graph,
    };
    let mut now = steady(&drawn(fold(&without(origin))), &slack, rounds);
    if let Rewriting::Fast { thrift, steps } = rewriting {
        let early =
            (!origin.early.is_empty()).then(|| steady(&drawn(fold(origin)), &slack, rounds));
        let early = early.as_ref().map(|settled| &settled.graph);
        let price = Price::new(&now, runtime, thrift);
        let all = cheaper(now.clone(), early, &slack, runtime, thrift);
        let all = all
            .into_iter()
            .map(|plan| with_recipes_followed(plan, &slack, runtime, thrift))
            .map(|plan| stepped(plan, &slack, target, thrift, steps));
        now = price.cheapest(all).unwrap_or(now);
        now = apart_at_last(now, &slack, runtime, thrift);
    }
    let Settled {
        graph,
        tree,
        ranges,
    } = now;
    if let Some(id) = missing(&graph, &tree) {
        let message = format!("the schedule lost {id}: a fault of the compiler, please report it");
        return Err(vec![Diagnostic::error(graph.span(id), message)]);
    }
    let origin = (Box::new(origin.clone()), rewriting);
    assemble(graph, tree, ranges, params, target, goal, origin)
}

/// A graph with stable forms of its formulas.
fn steady(origin: &Graph, slack: &Slack, rounds: u32) -> Settled {
    let mut now = scheduled(fold(origin), slack);
    for _ in 0..rounds {
        let Some(next) = stable(&now.graph, &now.ranges, slack.most()) else {
            break;
        };
        now = scheduled(fold(&next), slack);
    }
    settle(&now.graph, slack)
}

/// A plan of statements whose ranges are known.
fn assemble(
    graph: Graph,
    tree: Tree,
    ranges_now: Ranges,
    params: Vec<ParamPlan>,
    target: &'static Target,
    goal: &Goal,
    origin: (Box<Graph>, Rewriting),
) -> Result<Plan, Vec<Diagnostic>> {
    let runtime = target.runtime;
    let routines = choose::choose(&graph, &tree, &ranges_now, runtime)?;
    let tables = recipes::made(&graph, runtime);
    let gather = graph.diffusion.as_ref().and_then(|_| gathering(runtime));
    let runs = !tree.segment.is_empty();
    let still = runs.then(|| still(&graph)).flatten();
    let folded = fold_uses::folded(&graph, &tree, still.as_ref());
    let (offset, columns, rows) = frame(&graph.image, &goal.mode);
    let rows = match goal.rows {
        Some((first, last)) => (first.clamp(rows.0, rows.1), last.clamp(rows.0, rows.1)),
        None => rows,
    };
    let homes = names::homes(&graph, &tree);
    Ok(Plan {
        name: goal.name.clone(),
        target,
        runtime,
        mode: goal.mode,
        offset,
        columns,
        rows,
        plot: goal.plot,
        tight: false,
        listing: false,
        items: Vec::new(),
        lean: false,
        page: None,
        ranges: ranges_now,
        params,
        routines,
        tables,
        gather,
        folded,
        still,
        homes,
        graph,
        tree,
        origin,
    })
}

/// The addition that is right for all arguments: what a pixel receives has no
/// bounds that could be known beforehand.
fn gathering(runtime: &'static Runtime) -> Option<&'static Routine> {
    let all = Range::ALL;
    let fits = |r: &&Routine| r.op == Op::Add && (r.domain)(&[all, all], all);
    runtime.routines.iter().find(fits)
}

/// Where the picture stands on the screen, and which of it is seen: centred
/// where the screen is larger, cropped where it is smaller.
fn frame(image: &Image, mode: &Mode) -> ((i32, i32), (u32, u32), (u32, u32)) {
    let axis = |picture: u32, screen: u32| {
        let offset = (i64::from(screen) - i64::from(picture)).div_euclid(2);
        let first = (-offset).max(0);
        let last = (first + i64::from(screen.min(picture)) - 1).min(i64::from(picture) - 1);
        (offset as i32, (first as u32, last.max(first) as u32))
    };
    let (left, columns) = axis(image.width, mode.width);
    let (top, rows) = axis(image.height, mode.height);
    ((left, top), columns, rows)
}
