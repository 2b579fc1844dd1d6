//! Row buffers of adaptive sampling: what pixels leave to later ones, as a program keeps it.
//!
//! A band is drawn from key row to key row: the key row below it first, then the rows between
//! by halves. Of a band every second row is kept, the key rows around it included: no other has
//! neighbours, and a row between two that are kept writes over the one above it, which nothing
//! reads any more. Behind the band the key row below it becomes the one above the next.
//!
//! All rows of a band and all columns are computed, and only a plan's own are drawn. Before
//! `tree.pixel` each [`Node::Neighbour`] is read, behind it a pixel leaves
//! [`Refinement::kept`].

use super::Plan;
#[cfg(doc)]
use crate::ir::graph::Node;
use crate::ir::graph::Refinement;

/// The rows that a program keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeptRows {
    /// How far key rows are from each other, and what is kept.
    pub refinement: Refinement,
    /// Columns of the picture: bytes of a row.
    pub width: u32,
}

impl KeptRows {
    /// How many rows are kept.
    pub fn rows(&self) -> u32 {
        self.refinement.step / 2 + 1
    }

    /// Bytes of them all.
    pub fn bytes(&self) -> u32 {
        self.rows() * self.width
    }
}

impl Plan {
    /// The rows that are kept, where not all pixels are traced.
    pub fn kept_rows(&self) -> Option<KeptRows> {
        Some(KeptRows {
            refinement: self.graph.refinement?,
            width: self.graph.image.width,
        })
    }

    /// First and last picture column computed: those drawn; all where pixels hang on others,
    /// as what is not seen sends to what is.
    pub fn computed_columns(&self) -> (u32, u32) {
        match self.graph.is_in_order() {
            true => (0, self.graph.image.width.saturating_sub(1)),
            false => self.columns,
        }
    }

    /// First and last picture row that is computed: those drawn; where errors are spread those
    /// above as well, where not all pixels are traced those of whole bands.
    pub fn computed_rows(&self) -> (u32, u32) {
        match (&self.graph.diffusion, self.graph.refinement) {
            (Some(_), _) => (0, self.rows.1),
            (None, Some(refinement)) => refinement.computed(self.rows, self.graph.image.height),
            (None, None) => self.rows,
        }
    }
}
