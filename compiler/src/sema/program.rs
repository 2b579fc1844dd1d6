//! The program: what a scene says once every name, type and argument is known.
//!
//! Items live in lists and are known by their number. Expressions carry their
//! type and span; widenings are explicit ([`ExprKind::Convert`]); a call's
//! arguments stand in the order of its parameters, and what a call leaves out
//! is `None` (the callee's default). Locals are slots of their function's frame.

pub use super::expr::*;
pub use super::ids::*;
use super::ty::Ty;
use crate::source::Span;

/// A local name: an argument, a `let`, a carried value.
#[derive(Clone, Debug, PartialEq)]
pub struct Local {
    /// Its name in the source.
    pub name: String,
    /// Its type.
    pub ty: Ty,
}

/// An expression and the locals that it uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The frame: arguments first.
    pub locals: Vec<Local>,
    /// The value.
    pub value: Expr,
}

/// A parameter of something that can be called.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name, for named arguments.
    pub name: String,
    /// Its type.
    pub ty: Ty,
    /// Whether a call may leave it out.
    pub optional: bool,
    /// What stands in then.
    pub default: Option<Body>,
}

/// What kind of function.
#[derive(Clone, Debug, PartialEq)]
pub enum FunctionKind {
    /// `fn`
    Plain,
    /// `effect`, with what replaces it when it is left out.
    Effect { otherwise: Body },
    /// `dither`
    Dither,
}

/// A function, effect or dither.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// Whether the library defines it.
    pub library: bool,
    /// What kind.
    pub kind: FunctionKind,
    /// Its parameters; the first locals of the body's frame.
    pub params: Vec<Parameter>,
    /// Its result's type.
    pub result: Ty,
    /// What it computes.
    pub body: Body,
    /// Where its name stands.
    pub span: Span,
}

/// A constant.
#[derive(Clone, Debug, PartialEq)]
pub struct Const {
    /// Its name.
    pub name: String,
    /// Whether the library defines it.
    pub library: bool,
    /// Its value, of the constant's type.
    pub body: Body,
    /// Where its name stands.
    pub span: Span,
}

/// A param, or a state: what a param is to one picture, and what it is to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    /// Its name.
    pub name: String,
    /// A scalar, `vec2` or `vec3`.
    pub ty: Ty,
    /// Its default.
    pub value: Body,
    /// Lowest and highest, of the same type.
    pub range: Option<(Body, Body)>,
    /// A state's value in the next picture.
    pub next: Option<Body>,
    /// Where its name stands.
    pub span: Span,
}

impl Param {
    /// What it is called in messages.
    pub fn what(&self) -> &'static str {
        match self.next {
            Some(_) => "state",
            None => "param",
        }
    }
}

impl Program {
    /// What its params and states are called together.
    pub fn declared(&self) -> &'static str {
        let is_state = |param: &Param| param.next.is_some();
        match (
            self.params.iter().any(is_state),
            self.params.iter().all(is_state),
        ) {
            (true, true) => "state",
            (true, false) => "param or state",
            (false, _) => "param",
        }
    }
}

/// A facet's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FacetKind {
    /// Signed distance of a point.
    Dist,
    /// Implicit function of a point, positive outside.
    Implicit,
    /// Distance along a ray, if it hits.
    Hit,
    /// Distance along a ray before which it meets no surface that the shape is made of.
    Crossing,
    /// Unit normal at a point of the surface.
    Normal,
    /// A shape that encloses this one.
    Bound,
    /// In how many steps roots of `f` are looked for within the bound.
    Steps,
}

impl FacetKind {
    /// How the language writes it.
    pub fn name(self) -> &'static str {
        match self {
            FacetKind::Dist => "dist",
            FacetKind::Implicit => "f",
            FacetKind::Hit => "hit",
            FacetKind::Crossing => "crossing",
            FacetKind::Normal => "normal",
            FacetKind::Bound => "bound",
            FacetKind::Steps => "steps",
        }
    }
}

/// A facet of a shape; its frame holds the shape's parameters, then the argument.
#[derive(Clone, Debug, PartialEq)]
pub struct Facet {
    /// Which.
    pub kind: FacetKind,
    /// What it computes.
    pub body: Body,
    /// Where its name stands.
    pub span: Span,
}

/// A shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Its name.
    pub name: String,
    /// Whether the library defines it.
    pub library: bool,
    /// Its parameters.
    pub params: Vec<Parameter>,
    /// What it says of itself.
    pub facets: Vec<Facet>,
    /// Where its name stands.
    pub span: Span,
}

/// A member of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Member {
    /// A shape; its first locals are the counters of the `each`s around it. The tag's are `p`,
    /// the point hit, and then these.
    One { shape: Body, tag: Option<Body> },
    /// `each k in low .. high { .. }`; the first locals of the bounds are the counters around it.
    Each {
        name: String,
        low: Body,
        high: Body,
        members: Vec<Member>,
        span: Span,
    },
}

/// A scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// Its tags' type, if it has tags.
    pub tag: Option<Ty>,
    /// Its shapes; some may stand for several.
    pub members: Vec<Member>,
    /// Where its name stands.
    pub span: Span,
}

/// A record's type.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Its name.
    pub name: String,
    /// Whether the library defines it.
    pub library: bool,
    /// Its parts.
    pub fields: Vec<Parameter>,
    /// Where its name stands.
    pub span: Span,
}

/// A grid of small integers.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Its name.
    pub name: String,
    /// Columns; at least 1.
    pub width: usize,
    /// Rows; at least 1.
    pub height: usize,
    /// The cells, row by row.
    pub cells: Vec<i32>,
    /// Where its name stands.
    pub span: Span,
}

/// The picture's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Columns, 1 to 4096.
    pub width: u32,
    /// Rows, 1 to 4096.
    pub height: u32,
    /// Red, green and blue of each ink, dark to light; 2 to 256.
    pub palette: Vec<[u8; 3]>,
    /// Where it is written.
    pub span: Span,
}

/// The picture; locals 0 and 1 are its column and row.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// An ink.
    pub body: Body,
    /// Where it is written.
    pub span: Span,
}

/// A checked scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// The frame; there is one if no error was reported.
    pub image: Option<Image>,
    /// Params, in source order.
    pub params: Vec<Param>,
    /// Constants.
    pub consts: Vec<Const>,
    /// Functions, effects and dithers.
    pub functions: Vec<Function>,
    /// Shapes.
    pub shapes: Vec<Shape>,
    /// Scenes.
    pub scenes: Vec<Scene>,
    /// Records.
    pub records: Vec<Record>,
    /// Maps.
    pub maps: Vec<Map>,
    /// The picture; there is one if no error was reported.
    pub draw: Option<Draw>,
    /// Which files (by number) are the library's.
    pub library_files: Vec<u16>,
}
