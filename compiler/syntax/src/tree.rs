//! The syntax tree: what the parser makes of a scene file.
//!
//! Every node carries its [`Span`]. Parsing is total: what could not be read
//! stands in the tree as [`ExprKind::Error`] (already reported), so that later
//! stages can go on and report more. The tree knows nothing of types or names.

use crate::source::Span;

/// A name where it is written.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Name {
    /// The identifier.
    pub text: String,
    /// Where.
    pub span: Span,
}

/// A file: items in any order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct File {
    /// The items that could be read.
    pub items: Vec<Item>,
}

/// One top-level item.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// What it is.
    pub kind: ItemKind,
    /// From its keyword to its end.
    pub span: Span,
}

/// The kinds of item (LANGUAGE: "A file is a list of items").
#[derive(Clone, Debug, PartialEq)]
pub enum ItemKind {
    /// `image 320 x 240 inks black, red;`
    Image(Image),
    /// `param eye: vec3 = (0, 0, 3) in (..) .. (..);`, or
    /// `state eye: vec3 = (0, 0, 3) in (..) .. (..) -> eye + (0, 0, 1);`
    Param(Param),
    /// `const bayer4 = [0, 24; 36, 12];`
    Const { name: Name, value: Expr },
    /// `fn name(..) -> T = expr;`
    Fn(Function),
    /// `effect name(..) -> T else expr = expr;`
    Effect { function: Function, otherwise: Expr },
    /// `shape name(..) { facet(p) = expr; bound = expr; }`
    Shape {
        name: Name,
        params: Vec<Binding>,
        facets: Vec<Facet>,
    },
    /// `scene name { shape is tag; .. }`
    Scene { name: Name, members: Vec<Member> },
    /// `record name { field: T, .. }`
    Record { name: Name, fields: Vec<Binding> },
    /// `map name { "##" "#." } where '#' => 1, '.' => 0;`
    Map {
        name: Name,
        rows: Vec<(String, Span)>,
        cells: Vec<(char, Expr)>,
    },
    /// `dither name(v: real, x: int, y: int) -> ink = expr;`
    Dither(Function),
    /// `draw (x, y) = expr;`
    Draw { x: Name, y: Name, body: Expr },
    /// `use "file.scn";`
    Use { path: String, path_span: Span },
}

/// The picture's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Columns, as written (checked later).
    pub width: Expr,
    /// Rows, as written (checked later).
    pub height: Expr,
    /// The palette, dark to light.
    pub inks: Vec<InkColour>,
}

/// A colour of the palette as written: `red` or `#ff0000`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InkColour {
    /// The name, `#rrggbb` or `#rgb`.
    pub text: String,
    /// Where.
    pub span: Span,
}

/// A value that stays changeable in the generated program, or moves from picture to picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    /// Its name.
    pub name: Name,
    /// Its type.
    pub ty: Type,
    /// Its default.
    pub value: Expr,
    /// The range that may be trusted, lowest and highest, component by component.
    pub range: Option<(Expr, Expr)>,
    /// A state's value in the next picture; none of a param.
    pub next: Option<Box<Expr>>,
}

/// A pure function's head and body (also a dither's and an effect's).
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Its name.
    pub name: Name,
    /// Its parameters.
    pub params: Vec<Binding>,
    /// Its result.
    pub result: Type,
    /// Its body.
    pub body: Expr,
}

/// `name: T`, with a default where the grammar allows one.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// The name.
    pub name: Name,
    /// The type.
    pub ty: Type,
    /// `= expr` after the type: used when a call leaves the argument out.
    pub default: Option<Expr>,
}

/// One facet of a shape: `dist(p) = expr;` or `bound = expr;`.
#[derive(Clone, Debug, PartialEq)]
pub struct Facet {
    /// `dist`, `f`, `hit`, `normal` or `bound`.
    pub name: Name,
    /// The argument's name, if there is one.
    pub argument: Option<Name>,
    /// The body.
    pub body: Expr,
}

/// A member of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Member {
    /// `shape is tag;`; the tag may use `p`, the point hit.
    One { shape: Expr, tag: Option<Expr> },
    /// `each k in 0 .. 9 { shape is tag; .. }`
    Each {
        counter: Counter,
        members: Vec<Member>,
    },
}

/// `k in 0 .. 9`: what an `each` counts, from the first to the last.
#[derive(Clone, Debug, PartialEq)]
pub struct Counter {
    /// Its name.
    pub name: Name,
    /// The first number.
    pub low: Expr,
    /// The last number.
    pub high: Expr,
    /// From `each` to the last number.
    pub span: Span,
}

/// `union each k in 0 .. 9 { shape }`
#[derive(Clone, Debug, PartialEq)]
pub struct Each {
    /// The function that joins two.
    pub name: Name,
    /// Its arguments behind these two.
    pub args: Vec<Argument>,
    /// What is counted.
    pub counter: Counter,
    /// What is made for each number.
    pub body: Expr,
}

/// A type as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Type {
    /// What it is.
    pub kind: TypeKind,
    /// Where.
    pub span: Span,
}

/// The forms of a type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TypeKind {
    /// `real`, `vec3`, a record's name.
    Name(String),
    /// `[T]`
    Table(Box<Type>),
    /// `T?`
    Optional(Box<Type>),
    /// `fn(T, ..) -> T`
    Function(Vec<Type>, Box<Type>),
    /// What could not be read; already reported.
    Error,
}

/// An expression with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Where.
    pub span: Span,
}

/// Units of an angle literal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngleUnit {
    /// Degrees, 360 a turn.
    Deg,
    /// Turns.
    Turn,
    /// Radians.
    Rad,
}

/// An operator with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnaryOp {
    /// `-a`
    Neg,
    /// `not a`
    Not,
}

/// An operator with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BinaryOp {
    Or,
    And,
    Eq,
    Ne,
    Lt,
    Le,
    Gt,
    Ge,
    Add,
    Sub,
    Mul,
    /// `/`, always real.
    Div,
    /// `mod`, flooring.
    Mod,
    /// `div`, flooring.
    IntDiv,
    /// `^`, groups right.
    Pow,
}

/// An argument of a call; named ones may come in any order after the others.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument {
    /// `far` in `far: 12`.
    pub name: Option<Name>,
    /// The value.
    pub value: Expr,
}

/// How often a `let` is said to change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// Once a picture.
    Frame,
    /// Once a row (may depend on y).
    Row,
    /// Once a column (may depend on x).
    Column,
}

/// A statement of a block.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// `[frame|row|column] let name = value;`
    Let {
        claim: Option<(Claim, Span)>,
        name: Name,
        value: Expr,
    },
    /// `spread value to { (1, 0): 7/16, .. };`
    Spread {
        value: Expr,
        to: Vec<(Expr, Expr)>,
        span: Span,
    },
}

/// The forms of an expression.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// What could not be read; already reported.
    Error,
    /// `12`: the value may be too large for an int; the checker says so.
    Int(f64),
    /// `1.5`
    Real(f64),
    /// `90deg`
    Angle(f64, AngleUnit),
    /// `true`, `false`
    Bool(bool),
    /// `none`
    None,
    /// A name.
    Name(String),
    /// `(a, b, c)`: a vector.
    Tuple(Vec<Expr>),
    /// `[a, b; c, d]`: rows of a table. A single row stands for a list.
    Table(Vec<Vec<Expr>>),
    /// `-a`, `not a`
    Unary(UnaryOp, Box<Expr>),
    /// `a + b`
    Binary(BinaryOp, Box<Expr>, Box<Expr>),
    /// `f(a, far: b)`
    Call { name: Name, args: Vec<Argument> },
    /// `a.f(b)`
    Method {
        receiver: Box<Expr>,
        name: Name,
        args: Vec<Argument>,
    },
    /// `a.x`
    Field { base: Box<Expr>, name: Name },
    /// `a[x, y]`
    Index { base: Box<Expr>, indices: Vec<Expr> },
    /// `if c then a else b`; with `binding`, `if let binding = c then a else b`.
    If {
        binding: Option<Name>,
        condition: Box<Expr>,
        yes: Box<Expr>,
        no: Box<Expr>,
    },
    /// `loop (a = 1, b = 2) max 12 { .. } else e`
    Loop {
        carried: Vec<(Name, Expr)>,
        max: Box<Expr>,
        body: Box<Expr>,
        otherwise: Box<Expr>,
    },
    /// `union each k in 0 .. 9 { shape }`
    Each(Box<Each>),
    /// `next(a, b)`
    Next(Vec<Expr>),
    /// `{ let a = b; c }`
    Block {
        statements: Vec<Statement>,
        result: Box<Expr>,
    },
}
