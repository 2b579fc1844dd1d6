//! A graph's nodes: one scalar operation each, on nodes made before it.

use slowlight_routine::{Op, Type, Value};

/// Which node; an index into the graph's arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub u32);

/// Which loop; an index into [`Graph::loops`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LoopId(pub u32);

/// Which table; an index into [`Graph::tables`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TableId(pub u32);

/// Which scalar of which param; an index into [`Graph::params`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ParamId(pub u32);

/// A pixel's coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Axis {
    /// The column, from 0 at the left.
    X,
    /// The row, from 0 at the top.
    Y,
    /// The column modulo so many, 2 or more: a row is drawn in as many passes,
    /// each over every so manyth column. All of a graph's have the same number.
    Pass(u32),
    /// The column where the pixel's run of columns begins ([`Node::Stepped`]). To
    /// evaluations a run begins at every pixel.
    Run,
}

/// A pixel that was drawn before this one, where some are not traced
/// ([`super::refinement`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Neighbour {
    /// In the same column, as many rows up as the row's number can be halved.
    Above,
    /// In the same column, as many rows down.
    Below,
    /// In the same row, the column before; at the first column the one above.
    Left,
}

/// A scalar constant that can be a key: reals by their bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Constant {
    Bool(bool),
    Int(i32),
    /// The bits of an `f64` that is neither NaN nor -0.
    Real(u64),
}

impl Constant {
    /// From a value; -0 becomes 0.
    pub fn new(value: Value) -> Constant {
        match value {
            Value::Bool(b) => Constant::Bool(b),
            Value::Int(i) => Constant::Int(i),
            Value::Real(r) => Constant::Real((r + 0.0).to_bits()),
        }
    }

    /// The value.
    pub fn value(self) -> Value {
        match self {
            Constant::Bool(b) => Value::Bool(b),
            Constant::Int(i) => Value::Int(i),
            Constant::Real(bits) => Value::Real(f64::from_bits(bits)),
        }
    }
}

/// A scalar value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// Known at compile time.
    Const(Constant),
    /// A scalar of a param.
    Param(ParamId),
    /// The pixel's column or row, an int.
    Axis(Axis),
    /// An operation; unused arguments repeat the first.
    Apply(Op, [NodeId; 2]),
    /// `yes` where `cond` holds, else `no`; only that one is needed.
    Select {
        cond: NodeId,
        yes: NodeId,
        no: NodeId,
    },
    /// An entry of a table; both indices are ints and clamp to the table.
    Lookup {
        table: TableId,
        column: NodeId,
        row: NodeId,
    },
    /// An int that is `first` in the first `stride` columns and grows by `step`
    /// from each column to the one `stride` further, in 32 bits that wrap. `first`
    /// is the same for the whole pass, and so is `step`, or it is another ramp of the
    /// same stride ([`super::ramp`]).
    Ramp {
        first: NodeId,
        step: NodeId,
        stride: u32,
    },
    /// An int that is stepped from pixel to pixel of a run of columns: the sum of
    /// `first` and `step`, which stays within 32 bits. `first` is what it is a pixel
    /// before the run's first, made of [`Axis::Run`], and `step` by how much it has
    /// grown since the pixel before ([`crate::passes::loops::strength_reduction::runs`]).
    Stepped { first: NodeId, step: NodeId },
    /// A value that hangs on no axis but the column, out of an array of as many entries
    /// as the picture has columns; the program fills it before the first row
    /// ([`crate::passes::loops::scalar_expansion`]).
    Tabulated(NodeId),
    /// A carried value of a loop, in its body.
    Carried { of: LoopId, index: u32 },
    /// What the last `next` gave, in the loop's `else`.
    Last { of: LoopId, index: u32 },
    /// A result of a loop.
    Result { of: LoopId, index: u32 },
    /// What earlier pixels sent to this one ([`Graph::diffusion`]); a real, 0
    /// where none did.
    Received,
    /// What a neighbour left ([`Graph::refinement`]); an int.
    Neighbour(Neighbour),
    /// A home that is only set: what a subroutine is given, or leaves behind
    /// on one of several ways. None in a graph before [`crate::schedule::outline`].
    Slot(Type),
    /// Never needed.
    Undefined(Type),
}

impl Node {
    /// The nodes that it refers to directly (a loop's results: none; see [`Loop::roots`]).
    pub fn operands(&self) -> impl Iterator<Item = NodeId> + use<> {
        let list: [Option<NodeId>; 3] = match *self {
            Node::Apply(op, [a, b]) => [Some(a), (op.arity() > 1).then_some(b), None],
            Node::Select { cond, yes, no } => [Some(cond), Some(yes), Some(no)],
            Node::Lookup { column, row, .. } => [Some(column), Some(row), None],
            Node::Ramp { first, step, .. } | Node::Stepped { first, step } => {
                [Some(first), Some(step), None]
            }
            Node::Tabulated(value) => [Some(value), None, None],
            _ => [None; 3],
        };
        list.into_iter().flatten()
    }

    /// What computing it reads: its operands, but of what is tabulated its entry alone.
    pub fn inputs(&self) -> impl Iterator<Item = NodeId> + use<> {
        let tabulated = matches!(self, Node::Tabulated(_));
        self.operands().filter(move |_| !tabulated)
    }

    /// The same with other operands.
    pub fn with(self, at: impl Fn(NodeId) -> NodeId) -> Node {
        match self {
            Node::Apply(op, args) => Node::Apply(op, args.map(at)),
            Node::Select { cond, yes, no } => Node::Select {
                cond: at(cond),
                yes: at(yes),
                no: at(no),
            },
            Node::Lookup { table, column, row } => Node::Lookup {
                table,
                column: at(column),
                row: at(row),
            },
            Node::Ramp {
                first,
                step,
                stride,
            } => Node::Ramp {
                first: at(first),
                step: at(step),
                stride,
            },
            Node::Stepped { first, step } => Node::Stepped {
                first: at(first),
                step: at(step),
            },
            Node::Tabulated(value) => Node::Tabulated(at(value)),
            other => other,
        }
    }
}
