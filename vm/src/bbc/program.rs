//! A decoded program: its statements in one list, and where its lines, DEFs and DATA are.

use super::ast::{Place, Stmt};
use super::error::Error;

/// A statement, what it costs apart from its values, and its line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Op {
    pub stmt: Stmt,
    pub cost: u32,
    /// Index into [`Program::lines`].
    pub line: u32,
    /// Index into [`Program::statements`].
    pub statement: u32,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    pub number: u16,
    /// Its first op.
    pub op: u32,
}

/// A DEF: where its body starts.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Def {
    pub op: u32,
    /// What getting from its head to its first statement costs.
    pub cost: u32,
    pub params: Result<Box<[Place]>, Error>,
}

/// A DATA line: its index, and its text with a comma before each item, the first one also.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DataLine {
    pub line: u32,
    pub text: Box<[u8]>,
}

/// Where a statement begins; empty ones count.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Statement {
    /// Index into [`Program::lines`].
    pub line: u32,
    /// Which of its statements, from 0.
    pub statement: u32,
    /// Its first op, if it has any.
    pub op: u32,
    /// Its first byte in the line's text.
    pub at: u32,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Program {
    /// Ends with an `End` that belongs to the last line.
    pub ops: Vec<Op>,
    pub lines: Vec<Line>,
    /// Line by line.
    pub statements: Vec<Statement>,
    /// By the slots of [`Kind::Fn`] and [`Kind::Proc`].
    pub fns: Vec<Option<Def>>,
    pub procs: Vec<Option<Def>>,
    pub data: Vec<DataLine>,
}
