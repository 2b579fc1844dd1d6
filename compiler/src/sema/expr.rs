//! Expressions of a checked program: typed, names resolved.

use super::builtins::Builtin;
use super::ids::*;
use super::ty::Ty;
use crate::source::Span;
use crate::syntax::tree::{BinaryOp, Claim, UnaryOp};

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
    /// The format's unit roundoff.
    Epsilon,
    /// Whether the format's reals have an exponent.
    Floats,
    /// Whether they have a mantissa beside it: a logarithm has none.
    Mantissas,
    /// The format's self-intersection offset.
    Offset,
    /// How many rays a pixel may have; the largest int where nobody says less.
    Samples,
    /// How many pictures there were before this one.
    Picture,
    /// What a player holds between two pictures: the library's record of it.
    Input,
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
    Spread {
        /// The error.
        value: Expr,
        /// Columns right, rows down, and the weight.
        to: Vec<(i32, i32, Expr)>,
        span: Span,
    },
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
    /// `union each k in 0 .. 9 { .. }`
    Each(Box<Each>),
    /// Values for the innermost loop's carried locals.
    Next(Vec<Expr>),
    Block {
        statements: Vec<Statement>,
        result: Box<Expr>,
    },
}

/// `union each k in low .. high { body }`
#[derive(Clone, Debug, PartialEq)]
pub struct Each {
    /// What is counted; an int.
    pub counter: LocalId,
    /// Its first number, and its last.
    pub low: Expr,
    pub high: Expr,
    /// What is made for each number.
    pub body: Expr,
    /// Two of these, of the body's type.
    pub left: LocalId,
    pub right: LocalId,
    /// Both joined, of the same type.
    pub join: Expr,
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
