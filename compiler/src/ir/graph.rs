//! The graph: pure scalar operations in an arena.
//!
//! A picture is one function from a pixel (x, y) and the params to an ink. The
//! graph holds that function as scalar [`Node`]s, each applied to nodes made
//! before it (a [`NodeId`] is an index into the arena, so the arena is in
//! topological order, loops included: see below). Vectors, records, optional
//! values, shapes and function calls are gone: specialisation took them apart.
//!
//! Nothing here says *when* a value is computed. [`Node::Select`] needs its
//! condition and then only one of its arms; whoever evaluates a graph does so
//! by need. The statement tree ([`super::tree`]) is derived from the graph by
//! the demand pass; it is a side table, and so are all analyses.
//!
//! A [`Loop`] carries values. [`Node::Carried`] is a carried value in the body,
//! [`Node::Last`] is what the last `next` gave, seen by the `else`, and
//! [`Node::Result`] is one of the loop's results. The body is the set of nodes
//! that depend on `Carried`; it is described by three lists of roots in the
//! [`Loop`]: whether to go on, the next values, the results when done. Those
//! roots are nodes made after the `Carried` nodes and before the `Result`s.
//!
//! [`Node::Undefined`] stands where no value is ever needed: the arm of a
//! select that is taken only when the loop goes on, say.

pub use super::diffusion::{Diffusion, Share};
pub use super::node::*;
pub use super::refinement::Refinement;
pub use super::table::Table;
use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Range, Type, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A bounded loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// How often the body runs at most; 1 to 65535.
    pub max: u32,
    /// The carried values' names in the scene.
    pub names: Vec<String>,
    /// The carried values' types.
    pub types: Vec<Type>,
    /// Their values at the start.
    pub init: Vec<NodeId>,
    /// A bool: whether this turn ends in `next`.
    pub again: NodeId,
    /// What `next` gives, where `again` holds.
    pub next: Vec<NodeId>,
    /// The results, where `again` does not hold.
    pub done: Vec<NodeId>,
    /// The results when `max` turns have passed; may use [`Node::Last`].
    pub otherwise: Vec<NodeId>,
    /// Where it is written.
    pub span: Span,
}

impl Loop {
    /// Every node that the loop refers to.
    pub fn roots(&self) -> impl Iterator<Item = NodeId> + '_ {
        let lists = [&self.init, &self.next, &self.done, &self.otherwise];
        lists.into_iter().flatten().copied().chain([self.again])
    }
}

/// Who gives a param its value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Role {
    /// Whoever edits the program.
    #[default]
    Param,
    /// The program, from picture to picture: the graph's reports are the next values.
    State,
    /// Whoever plays, between two pictures.
    Input(Button),
}

/// What a player may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Button {
    /// To the left.
    Left,
    /// To the right.
    Right,
    /// Up.
    Up,
    /// Down.
    Down,
    /// Whatever a game does with a button.
    Fire,
}

impl Button {
    /// All of them, as the library's record has them.
    pub const ALL: [Button; 5] = [
        Button::Left,
        Button::Right,
        Button::Up,
        Button::Down,
        Button::Fire,
    ];

    /// What the language calls it.
    pub fn name(self) -> &'static str {
        match self {
            Button::Left => "left",
            Button::Right => "right",
            Button::Up => "up",
            Button::Down => "down",
            Button::Fire => "fire",
        }
    }
}

/// A scalar that stays changeable in the generated program.
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    /// The param's name.
    pub name: String,
    /// `x`, `y`, `z` for a vector's components, else empty.
    pub component: &'static str,
    /// Who gives it its value.
    pub role: Role,
    /// Bool, int or real (angles in radians).
    pub ty: Type,
    /// Its value.
    pub value: f64,
    /// The value that the scene gives it, whatever it is set to: what plans are made
    /// for, so that a program whose params are edited keeps its plan.
    pub usual: f64,
    /// The range that may be trusted, if the scene gives one.
    pub range: Option<Range>,
    /// Where it is declared.
    pub span: Span,
}

impl Param {
    /// The value that the scene gives it.
    pub fn usual(&self) -> Value {
        match self.ty {
            Type::Bool => Value::Bool(self.usual != 0.0),
            Type::Int => Value::Int(self.usual as i32),
            Type::Real => Value::Real(self.usual),
        }
    }

    /// What to call it in generated source: `eye_y`.
    pub fn label(&self) -> String {
        if self.component.is_empty() {
            self.name.clone()
        } else {
            format!("{}_{}", self.name, self.component)
        }
    }
}

/// The picture that a graph draws.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Columns, of blocks where a block is more than a pixel.
    pub width: u32,
    /// Rows, of blocks.
    pub height: u32,
    /// How many columns and rows of the screen each of its pixels takes: 1 and 1 unless
    /// the picture is computed in blocks ([`crate::passes::pixel_blocks`]).
    pub block: (u32, u32),
    /// Red, green and blue of each ink, dark to light.
    pub palette: Vec<[u8; 3]>,
}

impl Image {
    /// Columns and rows of the screen that the picture takes.
    pub fn on_screen(&self) -> (u32, u32) {
        (self.width * self.block.0, self.height * self.block.1)
    }

    /// What its pixels are called in a program's remarks.
    pub fn unit(&self) -> String {
        match self.block {
            (1, 1) => "pixels".to_owned(),
            (wide, high) => format!("blocks of {wide} x {high} pixels"),
        }
    }
}

/// An effect that the graph calls.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EffectUse {
    /// Its name.
    pub name: String,
    /// How often it was expanded.
    pub calls: u32,
}

/// A scene as one function from pixel and params to ink.
#[derive(Clone, Debug, PartialEq)]
pub struct Graph {
    /// The picture, with the inks of the screen that it is meant for.
    pub image: Image,
    /// The live params, scalar by scalar.
    pub params: Vec<Param>,
    /// The constant tables.
    pub tables: Vec<Table>,
    /// The loops.
    pub loops: Vec<Loop>,
    /// The nodes, operands before users.
    pub nodes: Vec<Node>,
    /// Each node's type; as long as `nodes`.
    pub types: Vec<Type>,
    /// Where each node comes from; as long as `nodes`.
    pub spans: Vec<Span>,
    /// Names that the scene gives to nodes (`let`, params of functions), for
    /// readable output; a node may have none.
    pub names: FxHashMap<NodeId, Arc<str>>,
    /// Components of vectors whose length is known by contract, and that length:
    /// 1 for rays' directions and normals, more where a pass holds them longer.
    /// It may be trusted where no range could be found.
    pub directions: BTreeMap<NodeId, f64>,
    /// Bools that are decided in another way than the comparison that they stand
    /// for and are the same as: which comparison. Its operands' ranges follow from the bool.
    pub claims: BTreeMap<NodeId, (Op, [NodeId; 2])>,
    /// Choices between true and false by a bool that may be taken for false: what it
    /// decides would come out the same without it, but later
    /// ([`crate::passes::branches::early_exit`]).
    pub early: BTreeSet<NodeId>,
    /// Values that are hoisted out of a loop whose turns need them now and then only, as that is
    /// less often ([`crate::passes::loops::licm`]).
    pub hoisted: BTreeSet<(NodeId, LoopId)>,
    /// The pixel's ink, an int in 0..inks-1.
    pub ink: NodeId,
    /// The shade before the dither, if `draw` ends in one. It is looked at,
    /// never computed for its own sake.
    pub shade: Option<NodeId>,
    /// What the pixel sends to later ones, if the dither spreads its error.
    pub diffusion: Option<Diffusion>,
    /// What the pixel leaves to later ones, if some of them are not traced.
    pub refinement: Option<Refinement>,
    /// The effects that were called, by name.
    pub effects: Vec<EffectUse>,
    /// Values that are computed beside the ink and kept where the program
    /// ends: what a test of a single function looks at. None in a picture.
    pub reports: Vec<NodeId>,
}

impl Graph {
    /// The states, each with its value in the next picture; none in a graph of one picture.
    pub fn steps(&self) -> impl Iterator<Item = (ParamId, NodeId)> + '_ {
        let states = (0..).map(ParamId).zip(&self.params);
        let states = states.filter(|(_, p)| p.role == Role::State);
        states.map(|(id, _)| id).zip(self.reports.iter().copied())
    }

    /// Whether the picture moves.
    pub fn is_moving(&self) -> bool {
        self.steps().next().is_some()
    }

    /// What of a player's hands it asks for.
    pub fn buttons(&self) -> impl Iterator<Item = (ParamId, Button)> + '_ {
        let params = (0..).map(ParamId).zip(&self.params);
        params.filter_map(|(id, p)| match p.role {
            Role::Input(button) => Some((id, button)),
            _ => None,
        })
    }

    /// A node; [`Node::Undefined`] for an id that is not of this graph.
    pub fn node(&self, id: NodeId) -> Node {
        self.nodes
            .get(id.0 as usize)
            .copied()
            .unwrap_or(Node::Undefined(Type::Real))
    }

    /// Where a node comes from.
    pub fn span(&self, id: NodeId) -> Span {
        self.spans.get(id.0 as usize).copied().unwrap_or_default()
    }

    /// The ids of all nodes, operands first.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = NodeId> + use<> {
        (0..self.nodes.len() as u32).map(NodeId)
    }

    /// A node's constant, if it is one.
    pub fn constant(&self, id: NodeId) -> Option<Value> {
        match self.node(id) {
            Node::Const(c) => Some(c.value()),
            _ => None,
        }
    }

    /// A node's type.
    pub fn ty(&self, id: NodeId) -> Type {
        self.types.get(id.0 as usize).copied().unwrap_or(Type::Real)
    }

    /// What each node refers to, loops' roots included for their results.
    pub fn references(&self, id: NodeId) -> Vec<NodeId> {
        self.refers(id).collect()
    }

    /// The same, one after the other.
    pub fn refers(&self, id: NodeId) -> impl Iterator<Item = NodeId> + '_ {
        let node = self.node(id);
        let of = match node {
            Node::Result { of, .. } => self.loops.get(of.0 as usize),
            _ => None,
        };
        node.operands().chain(of.into_iter().flat_map(Loop::roots))
    }

    /// Which nodes the outputs can reach; as long as `nodes`.
    pub fn reached(&self) -> Vec<bool> {
        let mut seen = vec![false; self.nodes.len()];
        let mut todo: Vec<NodeId> = self.outputs().collect();
        while let Some(id) = todo.pop() {
            if let Some(flag) = seen.get_mut(id.0 as usize)
                && !*flag
            {
                *flag = true;
                todo.extend(self.refers(id));
            }
        }
        seen
    }

    /// The pixel's ink and shade, what it sends to later pixels, and what is reported.
    pub fn outputs(&self) -> impl Iterator<Item = NodeId> + '_ {
        let pixel = [Some(self.ink), self.shade].into_iter().flatten();
        pixel
            .chain(self.left_to_others())
            .chain(self.reports.iter().copied())
    }

    /// What has to be computed for each pixel: its ink, what it sends, and what is reported.
    pub fn roots(&self) -> impl Iterator<Item = NodeId> + '_ {
        std::iter::once(self.ink)
            .chain(self.left_to_others())
            .chain(self.reports.iter().copied())
    }

    /// What the pixel sends or leaves to later ones.
    pub fn left_to_others(&self) -> impl Iterator<Item = NodeId> + '_ {
        let kept = self.refinement.iter().map(|refinement| refinement.kept);
        self.shares().map(|s| s.node).chain(kept)
    }

    /// Whether a pixel hangs on others, which are drawn before it.
    pub fn is_in_order(&self) -> bool {
        self.diffusion.is_some() || self.refinement.is_some()
    }

    /// Lets each pixel be what it is by itself: none receives what others send or leave.
    pub fn part_pixels(&mut self) {
        self.diffusion = None;
        self.refinement = None;
    }

    /// What the pixel sends to later ones, in order.
    pub fn shares(&self) -> impl Iterator<Item = Share> + '_ {
        self.diffusion.iter().flat_map(|d| d.shares.iter().copied())
    }
}
