//! The program: what a scene says once every name, type and argument is known.
//!
//! Items live in lists and are known by their number. Expressions carry their
//! type and span; widenings are explicit ([`ExprKind::Convert`]); a call's
//! arguments stand in the order of its parameters, and what a call leaves out
//! is `None` (the callee's default). Locals are slots of their function's frame.

use super::builtins::Builtin;
use super::ty::Ty;
use crate::source::Span;
use crate::syntax::tree::{BinaryOp, Claim, UnaryOp};

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident)*) => {
        $($(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub usize);)*
    };
}

ids! {
    /// A function, dither or effect of [`Program::functions`].
    FunctionId
    /// A constant of [`Program::consts`].
    ConstId
    /// A param of [`Program::params`].
    ParamId
    /// A shape of [`Program::shapes`].
    ShapeId
    /// A scene of [`Program::scenes`].
    SceneId
    /// A record of [`Program::records`].
    RecordId
    /// A map of [`Program::maps`].
    MapId
    /// A slot of the enclosing function's frame.
    LocalId
}

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

/// A param.
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
    /// Where its name stands.
    pub span: Span,
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
    /// Unit normal at a point of the surface.
    Normal,
    /// A shape that encloses this one.
    Bound,
}

impl FacetKind {
    /// How the language writes it.
    pub fn name(self) -> &'static str {
        match self {
            FacetKind::Dist => "dist",
            FacetKind::Implicit => "f",
            FacetKind::Hit => "hit",
            FacetKind::Normal => "normal",
            FacetKind::Bound => "bound",
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
pub struct Member {
    /// The shape; its frame is empty at the start.
    pub shape: Body,
    /// The tag; local 0 is `p`, the point hit.
    pub tag: Option<Body>,
}

/// A scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// Its tags' type, if it has tags.
    pub tag: Option<Ty>,
    /// Its shapes.
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

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// The type of its value.
    pub ty: Ty,
    /// Where it is written.
    pub span: Span,
}

/// A value that the language knows by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// How many inks the picture has on its screen.
    Inks,
    /// Columns of the image.
    Width,
    /// Rows of the image.
    Height,
    /// The format's self-intersection offset.
    Offset,
}

/// What a call calls.
#[derive(Clone, Debug, PartialEq)]
pub enum Callee {
    /// A function, effect or dither.
    Function(FunctionId),
    /// An operation of the language.
    Builtin(Builtin),
    /// Makes a shape.
    Shape(ShapeId),
    /// Makes a record.
    Record(RecordId),
    /// A function that was given as an argument.
    Local(LocalId),
}

/// A statement of a block.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// A `let`, with its claim.
    Let {
        claim: Option<(Claim, Span)>,
        local: LocalId,
        value: Expr,
    },
    /// Gives a part of an error to pixels that come later.
    Spread { span: Span },
}

/// The forms of an expression.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// Already reported.
    Error,
    /// Of type int.
    Int(i32),
    /// Of type real or angle.
    Real(f64),
    Bool(bool),
    /// No value.
    None,
    Local(LocalId),
    Param(ParamId),
    Const(ConstId),
    Map(MapId),
    Scene(SceneId),
    Known(Known),
    /// A function as a value.
    Function(Callee),
    /// A vector; 2 or 3 reals.
    Tuple(Vec<Expr>),
    /// Entries of one type, row by row; `width` divides their number.
    Table {
        width: usize,
        entries: Vec<Expr>,
    },
    /// To the type of this expression, which the inner one fits.
    Convert(Box<Expr>),
    /// The operand has this expression's type.
    Unary(UnaryOp, Box<Expr>),
    /// Operands as the checker's rules for the operator have them.
    Binary(BinaryOp, Box<Expr>, Box<Expr>),
    /// Arguments in the order of the parameters.
    Call {
        callee: Callee,
        args: Vec<Option<Expr>>,
    },
    /// A part of a ray, hit or record, by its place.
    Part(Box<Expr>, usize),
    /// Components of a vector; one makes a real, more make a vector.
    Swizzle(Box<Expr>, Vec<usize>),
    /// An entry of a table or map.
    Index(Box<Expr>, Vec<Expr>),
    If {
        condition: Box<Expr>,
        yes: Box<Expr>,
        no: Box<Expr>,
    },
    /// The condition is optional; `local` is bound where it has a value.
    IfLet {
        local: LocalId,
        condition: Box<Expr>,
        yes: Box<Expr>,
        no: Box<Expr>,
    },
    /// The carried locals have the loop's joined types.
    Loop {
        carried: Vec<(LocalId, Expr)>,
        max: Box<Expr>,
        body: Box<Expr>,
        otherwise: Box<Expr>,
    },
    /// Values for the innermost loop's carried locals.
    Next(Vec<Expr>),
    Block {
        statements: Vec<Statement>,
        result: Box<Expr>,
    },
}

impl Expr {
    /// What stands where an error was reported.
    pub fn error(span: Span) -> Expr {
        Expr {
            kind: ExprKind::Error,
            ty: Ty::Error,
            span,
        }
    }
}

/// Parts of a ray and of a hit, in their order.
pub const RAY_PARTS: [&str; 2] = ["from", "dir"];
/// Parts of a hit; the tag only where it has one.
pub const HIT_PARTS: [&str; 4] = ["point", "normal", "t", "tag"];
