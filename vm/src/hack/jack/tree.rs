//! The tree of a class: what the parser builds and the emitter walks.
//!
//! Names borrow from the text and keep their places. Its depth is at most
//! [`super::NESTING`], so walking it by recursion is safe.

use super::Place;

/// A name in the text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Name<'a> {
    pub text: &'a str,
    pub place: Place,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Type<'a> {
    /// `int`, `char` or `boolean`: a word without methods.
    Plain(&'a str),
    /// The address of an object.
    Class(Name<'a>),
}

/// A variable's declaration; parameters and locals alike.
#[derive(Clone, Copy, Debug)]
pub(super) struct Variable<'a> {
    pub kind: Kind,
    pub of: Type<'a>,
    pub name: Name<'a>,
}

/// Where a variable lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Static,
    Field,
    Parameter,
    Local,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Call {
    /// Makes the object `this` and returns it.
    Constructor,
    /// Has no `this`.
    Function,
    /// Takes `this` as its argument 0, before the written ones.
    Method,
}

#[derive(Debug)]
pub(super) struct Class<'a> {
    pub name: Name<'a>,
    /// Statics and fields, as declared.
    pub variables: Vec<Variable<'a>>,
    pub subroutines: Vec<Subroutine<'a>>,
}

#[derive(Debug)]
pub(super) struct Subroutine<'a> {
    pub kind: Call,
    /// `None` is `void`.
    pub returns: Option<Type<'a>>,
    pub name: Name<'a>,
    pub parameters: Vec<Variable<'a>>,
    pub locals: Vec<Variable<'a>>,
    pub body: Vec<Statement<'a>>,
    /// The closing brace.
    pub end: Place,
}

#[derive(Debug)]
pub(super) enum Statement<'a> {
    Let {
        target: Name<'a>,
        /// Of `let target[index] = value`.
        index: Option<Expression<'a>>,
        value: Expression<'a>,
    },
    If {
        place: Place,
        condition: Expression<'a>,
        then: Vec<Statement<'a>>,
        otherwise: Option<Vec<Statement<'a>>>,
    },
    While {
        place: Place,
        condition: Expression<'a>,
        body: Vec<Statement<'a>>,
    },
    Do(Invocation<'a>),
    Return {
        place: Place,
        value: Option<Expression<'a>>,
    },
}

impl Statement<'_> {
    /// Where it begins, or hardly behind.
    pub fn place(&self) -> Place {
        match self {
            Statement::Let { target, .. } => target.place,
            Statement::If { place, .. }
            | Statement::While { place, .. }
            | Statement::Return { place, .. } => *place,
            Statement::Do(call) => call.receiver.as_ref().unwrap_or(&call.name).place,
        }
    }
}

/// A first term and the operators applied to it, from left to right.
#[derive(Debug)]
pub(super) struct Expression<'a> {
    pub first: Term<'a>,
    pub rest: Vec<(Operator, Place, Term<'a>)>,
}

/// The operators between two terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    And,
    Or,
    Less,
    Greater,
    Equal,
}

#[derive(Debug)]
pub(super) enum Term<'a> {
    Integer(u16),
    Text(Name<'a>),
    True,
    /// `false`, `null`.
    Zero,
    This(Place),
    Variable(Name<'a>),
    Element(Name<'a>, Box<Expression<'a>>),
    Call(Invocation<'a>),
    Group(Box<Expression<'a>>),
    /// `-`
    Negative(Box<Term<'a>>),
    /// `~`
    Not(Box<Term<'a>>),
}

/// `name(...)` or `receiver.name(...)`.
#[derive(Debug)]
pub(super) struct Invocation<'a> {
    pub receiver: Option<Name<'a>>,
    pub name: Name<'a>,
    pub arguments: Vec<Expression<'a>>,
}
