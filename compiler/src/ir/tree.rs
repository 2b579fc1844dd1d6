//! The statement tree: when each value of a graph is computed.
//!
//! A picture is drawn by nested blocks: `frame` runs once, `row` before
//! each row's pixels, `pass` before each of the passes over every nth column in
//! which a row may be drawn, `segment` where a run of columns begins in which no
//! comparison of the column with what the row knows changes (so it may run at
//! every pixel, with the same result), `pixel` for each pixel, which then plots the ink. Every
//! value that needs computing has one place where it is computed:
//!
//! - [`Statement::Let`] computes an operation, a lookup into its home;
//! - [`Statement::Set`] assigns a select (in either arm), a loop's carried
//!   value or a loop's result;
//! - constants, params and the axes need no statement.
//!
//! What is written down several times may be a [`Subroutine`] instead
//! ([`crate::schedule::outline`]): a block over nodes of its own, which a
//! [`Statement::Call`] runs. It is given values in homes of its own that are
//! set before the call ([`Node::Slot`]), and what it leaves is read from its
//! nodes' homes after. Subroutines call others, never themselves.
//!
//! A value's home keeps it from there on: an `If` on a condition may leave
//! values behind that a later `If` on the same condition uses.

use super::graph::*;
use crate::source::Span;
use slowlight_routine::Value;
use std::fmt::{self, Display};

/// Statements in order.
pub type Block = Vec<Statement>;

/// Which subroutine; an index into [`Tree::subroutines`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SubroutineId(pub u32);

/// Statements that stand once and run wherever they are called.
#[derive(Clone, Debug, PartialEq)]
pub struct Subroutine {
    /// What it does, after the scene's source; not unique, may be empty.
    pub name: String,
    /// Where the source has what it was first made from.
    pub span: Span,
    /// The statements.
    pub body: Block,
}

impl Subroutine {
    /// Its name as an identifier in small letters; `part` where it has none.
    pub fn label(&self) -> String {
        let plain = |c: char| match c {
            c if c.is_ascii_alphanumeric() => c.to_ascii_lowercase(),
            _ => '_',
        };
        let name: String = self.name.chars().map(plain).take(16).collect();
        match name.starts_with(|c: char| c.is_ascii_lowercase()) {
            true => name,
            false => format!("part{name}"),
        }
    }
}

/// What a [`Statement::Set`] assigns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Place {
    /// A select's or a loop result's home.
    Node(NodeId),
    /// A carried value's home; [`Node::Last`] reads the same home.
    Carried(LoopId, u32),
    /// A second home of a carried value, for exchanges.
    Scratch(LoopId, u32),
}

impl Place {
    /// Where a computed node is kept: what is stepped, where its first value is.
    pub fn of(graph: &Graph, id: NodeId) -> Place {
        match graph.node(id) {
            Node::Stepped { first, .. } => Place::Node(first),
            _ => Place::Node(id),
        }
    }
}

/// Where a [`Statement::Set`] reads from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A node's value.
    Node(NodeId),
    /// What was put into a scratch home.
    Scratch(LoopId, u32),
}

/// One step of a program.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// Computes a node into its home.
    Let(NodeId),
    /// Assigns a home.
    Set { place: Place, from: Origin },
    /// Takes one of two ways; at least one of them does something.
    If { cond: NodeId, yes: Block, no: Block },
    /// A bounded loop; there are few, so statements are not as large as these.
    Loop(Box<Turns>),
    /// Runs a subroutine.
    Call(SubroutineId),
}

impl Statement {
    /// Where in the scene it comes from: what it computes, sets or asks.
    pub fn span(&self, graph: &Graph, tree: &Tree) -> Span {
        let of_loop = |of: LoopId| {
            graph
                .loops
                .get(of.0 as usize)
                .map_or(Span::default(), |l| l.span)
        };
        match self {
            Statement::Let(id)
            | Statement::Set {
                place: Place::Node(id),
                ..
            }
            | Statement::If { cond: id, .. } => graph.span(*id),
            Statement::Set {
                place: Place::Carried(of, _) | Place::Scratch(of, _),
                ..
            } => of_loop(*of),
            Statement::Loop(turns) => of_loop(turns.of),
            Statement::Call(id) => {
                let subroutine = tree.subroutines.get(id.0 as usize);
                subroutine.map_or(Span::default(), |s| s.span)
            }
        }
    }
}

/// The turns of a bounded loop: `start`, then `body` up to [`Loop::max`]
/// times. After each `body`, `again` decides between `next` and another turn,
/// and `done`, which ends the loop. Where a `next` was the last one allowed,
/// `otherwise` ends it instead.
#[derive(Clone, Debug, PartialEq)]
pub struct Turns {
    /// The loop in the graph: its limit, its names, its span.
    pub of: LoopId,
    /// Sets the carried values for the first turn.
    pub start: Block,
    /// Computes what `again`, and both ways after it, need.
    pub body: Block,
    /// Whether to go on; read once a turn, after `body`.
    pub again: NodeId,
    /// Sets the carried values for another turn.
    pub next: Block,
    /// Sets the results where the loop ends by itself.
    pub done: Block,
    /// Sets the results where no turn is left.
    pub otherwise: Block,
}

impl Turns {
    /// Whether it never ends by itself.
    pub fn always(&self, graph: &Graph) -> bool {
        graph.constant(self.again).is_some_and(Value::truth)
    }

    /// The blocks, in the order in which they are written down.
    pub fn blocks(&self) -> [&Block; 5] {
        [
            &self.start,
            &self.body,
            &self.next,
            &self.done,
            &self.otherwise,
        ]
    }

    /// The same, to be changed.
    pub fn blocks_mut(&mut self) -> [&mut Block; 5] {
        [
            &mut self.start,
            &mut self.body,
            &mut self.next,
            &mut self.done,
            &mut self.otherwise,
        ]
    }
}

/// A picture's statements.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tree {
    /// Once a picture.
    pub frame: Block,
    /// Once a column, after that and before the first row, where something is tabulated by
    /// columns ([`Node::Tabulated`]). It ends by setting each such value; the pixel's `Let`
    /// of one reads it again.
    pub column: Block,
    /// Once a row.
    pub row: Block,
    /// Once a pass over a row's columns, where the graph has such ([`Axis::Pass`]).
    pub pass: Block,
    /// Once a run of columns, where the schedule has such; before its first pixel.
    pub segment: Block,
    /// Once a pixel; after it the ink is known.
    pub pixel: Block,
    /// Behind a picture that moves: what only the states' next values need
    /// ([`crate::schedule::step`]).
    pub step: Block,
    /// What these call, and what they call themselves; none reaches itself.
    pub subroutines: Vec<Subroutine>,
}

impl Tree {
    /// The blocks around all others, outermost first.
    pub fn outer(&self) -> [&Block; 7] {
        let Tree {
            frame,
            column,
            row,
            pass,
            segment,
            pixel,
            step,
            ..
        } = self;
        [frame, column, row, pass, segment, pixel, step]
    }

    /// Every block that is written down: those, then the subroutines'.
    pub fn blocks(&self) -> impl Iterator<Item = &Block> {
        self.outer()
            .into_iter()
            .chain(self.subroutines.iter().map(|s| &s.body))
    }

    /// The same, to be changed.
    pub fn blocks_mut(&mut self) -> impl Iterator<Item = &mut Block> {
        let Tree {
            frame,
            column,
            row,
            pass,
            segment,
            pixel,
            step,
            subroutines,
        } = self;
        [frame, column, row, pass, segment, pixel, step]
            .into_iter()
            .chain(subroutines.iter_mut().map(|s| &mut s.body))
    }

    /// How many calls of a subroutine are written down.
    pub fn calls(&self, id: SubroutineId) -> usize {
        let mut calls = 0;
        for block in self.blocks() {
            walk(block, &mut |s| {
                calls += usize::from(*s == Statement::Call(id))
            });
        }
        calls
    }

    /// What a call runs; nothing where there is no such subroutine.
    pub fn body(&self, id: SubroutineId) -> &[Statement] {
        self.subroutines
            .get(id.0 as usize)
            .map_or(&[][..], |s| &s.body)
    }
}

/// Calls `visit` for every statement of a block, in order, inner ones after
/// the statement that holds them.
pub fn walk<'t>(block: &'t [Statement], visit: &mut dyn FnMut(&'t Statement)) {
    for statement in block {
        visit(statement);
        for inner in inner(statement) {
            walk(inner, visit);
        }
    }
}

/// The values that the column's block leaves for pixels ([`Node::Tabulated`]).
pub fn tabulated(graph: &Graph, tree: &Tree) -> Vec<NodeId> {
    let mut found = Vec::new();
    walk(&tree.column, &mut |statement| {
        if let Statement::Set {
            place: Place::Node(id),
            ..
        } = statement
            && matches!(graph.node(*id), Node::Tabulated(_))
        {
            found.push(*id);
        }
    });
    found
}

/// The blocks inside a statement.
pub fn inner(statement: &Statement) -> Vec<&Block> {
    match statement {
        Statement::Let(_) | Statement::Set { .. } | Statement::Call(_) => Vec::new(),
        Statement::If { yes, no, .. } => vec![yes, no],
        Statement::Loop(turns) => turns.blocks().to_vec(),
    }
}

impl Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Node(id) => write!(f, "{id}"),
            Place::Carried(l, k) => write!(f, "carried {}.{k}", l.0),
            Place::Scratch(l, k) => write!(f, "scratch {}.{k}", l.0),
        }
    }
}

impl Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Origin::Node(id) => write!(f, "{id}"),
            Origin::Scratch(l, k) => write!(f, "scratch {}.{k}", l.0),
        }
    }
}

fn block(f: &mut fmt::Formatter<'_>, statements: &[Statement], depth: usize) -> fmt::Result {
    let pad = "  ".repeat(depth);
    let part = |f: &mut fmt::Formatter<'_>, name: &str, inner: &Block| -> fmt::Result {
        if inner.is_empty() {
            return Ok(());
        }
        writeln!(f, "{pad}{name}")?;
        block(f, inner, depth + 1)
    };
    for statement in statements {
        match statement {
            Statement::Let(id) => writeln!(f, "{pad}let {id}")?,
            Statement::Set { place, from } => writeln!(f, "{pad}set {place} := {from}")?,
            Statement::Call(id) => writeln!(f, "{pad}call {}", id.0)?,
            Statement::If { cond, yes, no } => {
                part(f, &format!("if {cond}"), yes)?;
                let name = if yes.is_empty() {
                    format!("unless {cond}")
                } else {
                    "else".to_owned()
                };
                part(f, &name, no)?;
            }
            Statement::Loop(turns) => {
                part(f, &format!("start {}", turns.of.0), &turns.start)?;
                writeln!(f, "{pad}loop {}", turns.of.0)?;
                block(f, &turns.body, depth + 1)?;
                part(f, &format!("again {}: next", turns.again), &turns.next)?;
                part(f, "done", &turns.done)?;
                part(f, "exhausted", &turns.otherwise)?;
            }
        }
    }
    Ok(())
}

impl Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, statements) in [
            ("frame", &self.frame),
            ("column", &self.column),
            ("row", &self.row),
            ("pass", &self.pass),
            ("segment", &self.segment),
            ("pixel", &self.pixel),
            ("step", &self.step),
        ] {
            if matches!(name, "column" | "pass" | "segment" | "step") && statements.is_empty() {
                continue;
            }
            writeln!(f, "{name}:")?;
            block(f, statements, 1)?;
        }
        for (k, subroutine) in self.subroutines.iter().enumerate() {
            writeln!(f, "subroutine {k} {}:", subroutine.name)?;
            block(f, &subroutine.body, 1)?;
        }
        Ok(())
    }
}
