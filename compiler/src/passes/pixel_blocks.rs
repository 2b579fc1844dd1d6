//! Lower sampling rate: the same picture, computed once for several pixels of the screen, a
//! block.
//!
//! A block's shade is that of the pixel at its middle; its dither sees the block's own
//! column and row, as it would in a smaller picture. Were it to see the pixel's, only
//! every nth entry of its matrix would ever be met, and those need not have the
//! matrix's mean.

use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::dither::Dither;
use crate::passes::rewrite::rebuild::{End, Rewrite, rebuild_by};
use crate::source::Span;
use slowlight_routine::{Op, Value};

/// The graph of a picture of blocks, each so many columns wide and rows high. Its image
/// counts blocks; both sides of the picture must be whole numbers of them.
pub fn pixel_blocks(graph: &Graph, block: (u32, u32)) -> Graph {
    if block == (1, 1) {
        return graph.clone();
    }
    let mut rewrite = Coarse {
        graph,
        block,
        dither: Dither::of(graph),
    };
    let mut made = rebuild_by(graph, &mut rewrite);
    made.image.width = (graph.image.width / block.0).max(1);
    made.image.height = (graph.image.height / block.1).max(1);
    made.image.block = (graph.image.block.0 * block.0, graph.image.block.1 * block.1);
    made
}

struct Coarse<'g> {
    graph: &'g Graph,
    block: (u32, u32),
    dither: Dither<'g>,
}

impl Coarse<'_> {
    /// The middle of the block: its column or row times its size, and half of that.
    fn middle(&self, b: &mut Builder, axis: Axis, span: Span) -> NodeId {
        let size = match axis {
            Axis::Y => self.block.1,
            _ => self.block.0,
        };
        let own = b.axis(axis, span);
        if size == 1 {
            return own;
        }
        let [size, half] = [size, size / 2].map(|n| b.constant(Value::Int(n as i32), span));
        let first = b.apply(Op::IntMul, &[own, size], span);
        b.apply(Op::IntAdd, &[first, half], span)
    }
}

impl Rewrite for Coarse<'_> {
    fn node(
        &mut self,
        b: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        moved: Node,
        span: Span,
    ) -> Option<NodeId> {
        self.dither.make(b, made, (id, moved), span);
        match moved {
            Node::Axis(axis) => Some(self.middle(b, axis, span)),
            _ => None,
        }
    }

    fn end(
        &mut self,
        _: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        end: End,
    ) -> Option<NodeId> {
        match end {
            End::Ink | End::Output if Some(id) != self.graph.shade => self.dither.seen(made, id),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eval::drawn::{lowered, native};

    /// Shades and inks, row by row.
    fn drawn(graph: &Graph) -> Vec<Vec<(u8, f64)>> {
        let all = native(graph).into_iter();
        all.map(|row| row.iter().map(|p| (p.ink, p.shade)).collect())
            .collect()
    }

    /// The column takes part in the shade and in the dither, by the same expression too.
    const DITHERED: &str = "image 24 x 12 inks black, grey, white;
draw (x, y) = threshold((x mod 8) / 16 + y / 24, bayer(4)[(x mod 8) mod 4, y mod 4]);
";

    #[test]
    fn a_block_has_the_shade_of_its_middle_and_a_dither_of_its_own() {
        let fine = lowered(DITHERED);
        let made = pixel_blocks(&fine, (3, 2));
        assert_eq!((made.image.width, made.image.height), (8, 6));
        assert_eq!(
            (made.image.block, made.image.on_screen()),
            ((3, 2), (24, 12))
        );
        assert_eq!(crate::analysis::verify::verify(&made).err(), None);
        // The same written by hand as a picture of so many pixels.
        let by_hand = "image 8 x 6 inks black, grey, white;
draw (x, y) = threshold(((3 * x + 1) mod 8) / 16 + (2 * y + 1) / 24, bayer(4)[(x mod 8) mod 4, y mod 4]);
";
        assert_eq!(drawn(&made), drawn(&lowered(by_hand)));
    }

    #[test]
    fn blocks_of_one_pixel_and_pictures_without_a_dither() {
        let fine = lowered(DITHERED);
        assert_eq!(pixel_blocks(&fine, (1, 1)), fine);
        let plain = lowered(
            "image 8 x 8 inks black, white;\ndraw (x, y) = ink((x div 4 + y div 4) mod 2);\n",
        );
        let made = drawn(&pixel_blocks(&plain, (2, 2)));
        let inks: Vec<u8> = made[1].iter().map(|(ink, _)| *ink).collect();
        assert_eq!(inks, [0, 0, 1, 1]);
    }

    #[test]
    fn a_graph_of_blocks_is_read_back() {
        let made = pixel_blocks(&lowered(DITHERED), (3, 2));
        let text = made.to_string();
        assert!(text.starts_with("image 8x6 of 3x2 inks"), "{text}");
        let read = crate::ir::read::read(&text).expect("it reads");
        assert_eq!(read.image, made.image);
    }
}
