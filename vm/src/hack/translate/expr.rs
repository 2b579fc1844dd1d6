//! What a stack entry will be: a tree of what has not been computed yet.

use crate::hack::vm::command::{ARG, Binary, CONSTANTS, LCL, RAM_MASK};

/// A word to come. Evaluating it changes nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Expr {
    Const(u16),
    /// The word at an address.
    Cell(u16),
    /// The word at what `base` holds, plus an offset.
    Field {
        base: u16,
        offset: u16,
    },
    /// The stack's word at a height above where the function's begins.
    Stacked(u16),
    /// The word at an address that is computed.
    At(Box<Expr>),
    Neg(Box<Expr>),
    Not(Box<Expr>),
    Binary(Binary, Box<Expr>, Box<Expr>),
}

/// Where a store goes, as far as it matters to what is still to be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Store {
    Cell(u16),
    Field(u16, u16),
    Anywhere,
}

impl Expr {
    pub fn cell(address: u16) -> Expr {
        Expr::Cell(address & RAM_MASK)
    }

    pub fn at(address: Expr) -> Expr {
        match address {
            Expr::Const(address) => Expr::cell(address),
            address => Expr::At(Box::new(address)),
        }
    }

    pub fn neg(x: Expr) -> Expr {
        match x {
            Expr::Const(x) => Expr::Const(x.wrapping_neg()),
            Expr::Neg(x) => *x,
            x => Expr::Neg(Box::new(x)),
        }
    }

    pub fn not(x: Expr) -> Expr {
        match x {
            Expr::Const(x) => Expr::Const(!x),
            Expr::Not(x) => *x,
            x => Expr::Not(Box::new(x)),
        }
    }

    /// The operation on two words, constants folded and to the right.
    pub fn binary(op: Binary, x: Expr, y: Expr) -> Expr {
        use Binary::{Add, And, Eq, Gt, Lt, Or, Sub};
        use Expr::{Const, Neg};
        match (op, x, y) {
            (op, Const(x), Const(y)) => Const(op.apply(x, y)),
            (Add, Const(c), x) => Expr::plus(x, c),
            (Add, x, Const(c)) => Expr::plus(x, c),
            (Sub, x, Const(c)) => Expr::plus(x, c.wrapping_neg()),
            (Sub, Const(0), x) => Expr::neg(x),
            (Add, x, Neg(y)) | (Add, Neg(y), x) => Expr::binary(Sub, x, *y),
            (Sub, x, Neg(y)) => Expr::binary(Add, x, *y),
            (And, Const(0), _) | (And, _, Const(0)) => Const(0),
            (And, Const(u16::MAX), x) | (And, x, Const(u16::MAX)) => x,
            (Or, Const(0), x) | (Or, x, Const(0)) => x,
            (Eq, x, Const(0)) if x.is_bool() => Expr::not(x),
            (Eq, x, Const(u16::MAX)) if x.is_bool() => x,
            (op @ (And | Or | Eq), Const(c), x) => Expr::of(op, x, Const(c)),
            (Lt, Const(c), x) => Expr::of(Gt, x, Const(c)),
            (Gt, Const(c), x) => Expr::of(Lt, x, Const(c)),
            (op, x, y) => Expr::of(op, x, y),
        }
    }

    fn of(op: Binary, x: Expr, y: Expr) -> Expr {
        Expr::Binary(op, Box::new(x), Box::new(y))
    }

    fn plus(x: Expr, c: u16) -> Expr {
        match (x, c) {
            (x, 0) => x,
            (Expr::Const(x), c) => Expr::Const(x.wrapping_add(c)),
            (Expr::Binary(Binary::Add, x, y), c) => match *y {
                Expr::Const(more) => Expr::plus(*x, more.wrapping_add(c)),
                y => Expr::of(Binary::Add, Expr::of(Binary::Add, *x, y), Expr::Const(c)),
            },
            (x, c) => Expr::of(Binary::Add, x, Expr::Const(c)),
        }
    }

    /// Whether it is 0 or -1 for certain.
    pub fn is_bool(&self) -> bool {
        match self {
            Expr::Const(c) => matches!(*c, 0 | u16::MAX),
            Expr::Not(x) => x.is_bool(),
            Expr::Binary(op, x, y) => match op {
                Binary::Eq | Binary::Gt | Binary::Lt => true,
                Binary::And | Binary::Or => x.is_bool() && y.is_bool(),
                Binary::Add | Binary::Sub => false,
            },
            _ => false,
        }
    }

    /// Between which signed numbers it lies.
    pub fn range(&self) -> (i32, i32) {
        const ALL: (i32, i32) = (i16::MIN as i32, i16::MAX as i32);
        let kept = |low: i32, high: i32| {
            if low < ALL.0 || high > ALL.1 {
                ALL
            } else {
                (low, high)
            }
        };
        match self {
            Expr::Const(c) => (i32::from(c.cast_signed()), i32::from(c.cast_signed())),
            Expr::Neg(x) => {
                let (low, high) = x.range();
                kept(-high, -low)
            }
            Expr::Not(x) => {
                let (low, high) = x.range();
                (-1 - high, -1 - low)
            }
            Expr::Binary(op, x, y) => {
                let ((a, b), (c, d)) = (x.range(), y.range());
                match op {
                    Binary::Add => kept(a + c, b + d),
                    Binary::Sub => kept(a - d, b - c),
                    Binary::And if c >= 0 => (0, d),
                    Binary::And if a >= 0 => (0, b),
                    Binary::And | Binary::Or if self.is_bool() => (-1, 0),
                    Binary::And | Binary::Or => ALL,
                    Binary::Eq | Binary::Gt | Binary::Lt => (-1, 0),
                }
            }
            _ => ALL,
        }
    }

    /// Whether it may be another word after a store. Words of the stack are
    /// taken to be reached through LCL, ARG and SP only, where the store is not
    /// through a pointer.
    pub fn is_changed_by(&self, store: Store) -> bool {
        let is_frame = |base: u16| base == LCL || base == ARG;
        match (self, store) {
            (Expr::Const(_), _) => false,
            (Expr::Cell(cell), Store::Cell(to)) => *cell == to,
            (Expr::Cell(_), Store::Field(base, _)) => !is_frame(base),
            (Expr::Field { base, .. }, Store::Cell(to)) => !is_frame(*base) || *base == to,
            (Expr::Field { base, offset }, Store::Field(to, at)) => {
                let other_frame = is_frame(*base) && is_frame(to) && *base != to;
                !other_frame && (*base != to || *offset == at)
            }
            (Expr::Stacked(_), Store::Cell(_)) => false,
            (Expr::Stacked(_), Store::Field(base, _)) => !is_frame(base),
            (Expr::Neg(x) | Expr::Not(x), _) => x.is_changed_by(store),
            (Expr::Binary(_, x, y), _) => x.is_changed_by(store) || y.is_changed_by(store),
            (Expr::At(_), _) | (_, Store::Anywhere) => true,
        }
    }

    /// What a store to this place is.
    pub fn as_store(&self) -> Store {
        match self {
            Expr::Cell(cell) => Store::Cell(*cell),
            Expr::Field { base, offset } => Store::Field(*base, *offset),
            _ => Store::Anywhere,
        }
    }
}

/// A place with a fixed address: its word or constant.
pub(super) fn fixed(offset: u16) -> Expr {
    if offset >= CONSTANTS {
        Expr::Const(offset & RAM_MASK)
    } else {
        Expr::Cell(offset)
    }
}
