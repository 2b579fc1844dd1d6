//! Error diffusion weights: errors that pixels send to later ones.

#[cfg(doc)]
use super::node::Node;
use super::node::NodeId;
use crate::source::Span;

/// What a pixel sends to one that the scan reaches later.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    /// Columns to the right; negative to the left, and then `dy` is above 0.
    pub dx: i32,
    /// Rows down, at least 0.
    pub dy: i32,
    /// What is sent: a real, the weight times the error.
    pub node: NodeId,
}

/// Error diffusion: the pixels are drawn row by row, each from left to right,
/// and each sends a part of its error to pixels still to come (Floyd and
/// Steinberg, An Adaptive Algorithm for Spatial Greyscale, 1976).
///
/// **Order of accumulation**: a pixel's [`Node::Received`] starts at 0, and every
/// share is added to it on the right (received + share) when its sender is
/// drawn: senders in scan order, a sender's shares in the order of `shares`. A
/// share for a pixel outside of the picture is dropped.
#[derive(Clone, Debug, PartialEq)]
pub struct Diffusion {
    /// What a pixel sends, in the order of the scene.
    pub shares: Vec<Share>,
    /// The `spread` in the scene.
    pub span: Span,
}

impl Diffusion {
    /// How many rows down the furthest share goes.
    pub fn reach(&self) -> usize {
        let downs = self.shares.iter().map(|s| usize::try_from(s.dy));
        downs.filter_map(Result::ok).max().unwrap_or(0)
    }
}
