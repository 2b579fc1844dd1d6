//! Values, variables, and what the stacks hold.

use slowlight_isa::real40::Real40;

use super::ast::{Kind, Place, Slot};
use super::error::Error;

/// A number: BASIC keeps integers as integers until an operation needs a real.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Num {
    Int(i32),
    Real(Real40),
}

impl Num {
    #[inline]
    pub fn real(self) -> Real40 {
        match self {
            Self::Int(n) => Real40::from_i32(n),
            Self::Real(x) => x,
        }
    }

    #[inline]
    pub fn int(self) -> Result<i32, Error> {
        match self {
            Self::Int(n) => Ok(n),
            Self::Real(x) => Ok(x.to_i32()?),
        }
    }
}

/// A number or a string.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Value {
    Num(Num),
    Str(Vec<u8>),
}

/// A variable: what it holds, whether it exists yet, and what finding it costs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scalar<T> {
    pub value: T,
    pub defined: bool,
    pub lookup: u32,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Text {
    pub value: Vec<u8>,
    /// Bytes set aside for it.
    pub room: usize,
    pub defined: bool,
    pub lookup: u32,
}

#[derive(Clone, Debug)]
pub(crate) enum Elements {
    Int(Vec<i32>),
    Real(Vec<Real40>),
    Str(Vec<Vec<u8>>),
}

#[derive(Clone, Debug)]
pub(crate) struct Array {
    /// Elements in each dimension: the bound + 1.
    pub dims: Vec<usize>,
    pub elements: Elements,
    pub lookup: u32,
}

/// What LOCAL and parameters put back at the end.
#[derive(Clone, Debug)]
pub(crate) struct Saved {
    pub place: Home,
    pub value: Value,
}

/// A [`Place`] with its subscripts and addresses worked out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Home {
    Int(Slot),
    Real(Slot),
    Str(Slot),
    Element(Kind, Slot, usize),
    Byte(u16),
    Word(u16),
    Text(u16),
}

impl Home {
    /// Does it hold reals?
    pub fn is_real(self) -> bool {
        matches!(self, Self::Real(_) | Self::Element(Kind::Reals, ..))
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub function: bool,
    /// Where a procedure goes on.
    pub back: u32,
    /// Height of the saved values below this frame's.
    pub saved: usize,
    /// BASIC's stack pointer before the call.
    pub stack: u32,
    /// Were there arguments for a procedure that takes none?
    pub excess: bool,
}

#[derive(Clone, Debug)]
pub(crate) struct Loop {
    pub home: Home,
    pub to: Num,
    pub step: Num,
    /// The op after FOR.
    pub body: u32,
}

pub(crate) fn array_index(kind: Kind) -> usize {
    match kind {
        Kind::Ints => 0,
        Kind::Reals => 1,
        _ => 2,
    }
}

/// Is a variable numeric?
pub(crate) fn is_numeric(place: &Place) -> bool {
    !matches!(
        place,
        Place::Str(_) | Place::Element(Kind::Strs, ..) | Place::Text(_)
    )
}
