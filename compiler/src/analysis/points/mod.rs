//! Binary points: where each real of a graph has its point, in formats that leave that to the
//! plan ([`Format::Scaled`]), and what that does to bits and ranges. Which point suits each is
//! found by [`crate::wordlength`].

pub(crate) mod bounds;
pub(crate) mod unify;
pub mod widths;

use crate::ir::graph::*;
use crate::ir::tree::Place;
use slowlight_routine::scale::{self, Scales, fitting};
use slowlight_routine::{Bits, Format, Type};
use widths::Widths;

/// What a pixel receives from others is held to so much: fraction bits in 16.
pub(crate) const RECEIVED: f64 = 3.9;

/// Where the points of a graph's reals are.
#[derive(Clone, Debug)]
pub struct Points {
    /// Bits of each real.
    pub(crate) widths: Widths,
    /// How it is read at another scale.
    pub(crate) shifted: fn(i64, i32, u8) -> i64,
    /// Each node's, those of constants as near as they can be held; 0 for ints.
    pub(crate) own: Vec<i8>,
    /// Each carried value's, by loop.
    pub(crate) carried: Vec<Vec<i8>>,
    /// Each operation's.
    pub(crate) scales: Vec<Scales>,
}

impl Points {
    /// A node's fraction bits.
    pub fn own(&self, id: NodeId) -> i8 {
        self.own.get(id.0 as usize).copied().unwrap_or(0)
    }

    /// Where the points of an operation's operands and result are.
    pub fn scales(&self, id: NodeId) -> Scales {
        self.scales.get(id.0 as usize).copied().unwrap_or_default()
    }

    /// The fraction bits of what a place holds.
    pub fn place(&self, place: Place) -> i8 {
        match place {
            Place::Node(id) => self.own(id),
            Place::Carried(l, k) | Place::Scratch(l, k) => {
                let found = self.carried.get(l.0 as usize);
                found.and_then(|l| l.get(k as usize)).copied().unwrap_or(0)
            }
        }
    }

    /// The format of a node's value.
    pub fn format(&self, id: NodeId) -> Format {
        self.format_in(Place::Node(id), self.own(id))
    }

    /// The format of what a place holds.
    pub fn place_format(&self, place: Place) -> Format {
        self.format_in(place, self.place(place))
    }

    fn format_in(&self, place: Place, frac: i8) -> Format {
        let bits = self.widths.place(place);
        Format::Fixed { bits, frac }
    }

    /// The fraction bits of what a pixel receives.
    pub fn received(&self) -> i8 {
        fitting(RECEIVED, self.widths.most())
    }

    /// A node's bits read at a scale in some width.
    pub fn read(&self, graph: &Graph, id: NodeId, bits: Bits, (to, width): (i8, u8)) -> Bits {
        match graph.constant(id) {
            Some(value) if graph.ty(id) == Type::Real => scale::nearest(value.real(), to, width),
            _ => self.moved(bits, self.own(id), (to, width)),
        }
    }

    /// Bits of one scale at another, in some width.
    pub fn moved(&self, bits: Bits, from: i8, (to, width): (i8, u8)) -> Bits {
        (self.shifted)(bits as i64, i32::from(to) - i32::from(from), width) as Bits
    }
}
