//! Ink numbers that a screen with fewer inks cannot show: clipped to its last ink, they
//! all look alike.
//!
//! Pixels spread over the picture are evaluated natively with ink numbers as the scene
//! writes them. A dither counts in the screen's own inks, so its numbers are all there.

use crate::eval::native::Native;
use crate::ir::graph::*;
use crate::source::Span;
use slowlight_routine::Value;

/// How many operations are run: what pixels come to by then is the sample.
const PATIENCE: u64 = 10_000_000;

/// What was found among the pixels looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Beyond {
    /// The greatest number of an ink.
    pub greatest: i32,
    /// How many pixels have a number that is not shown.
    pub pixels: usize,
    /// Of how many.
    pub looked: usize,
    /// Where the first of them has its ink from.
    pub span: Span,
}

/// Looks for ink numbers beyond a screen's inks at some pixels; none where there are none. The graph is one lowered
/// for that screen with [`all_inks`](crate::sema::Options::all_inks); what earlier pixels
/// send is left out.
pub fn beyond(graph: &Graph, places: &[(i32, i32)]) -> Option<Beyond> {
    let last = graph.image.palette.len() as i32 - 1;
    let mut graph = graph.clone();
    graph.part_pixels();
    graph.reports = vec![graph.ink];
    let mut native = Native::within(&graph, PATIENCE);
    let mut looked = 0;
    let mut found: Vec<(i32, (i32, i32))> = Vec::new();
    for &(x, y) in places {
        native.pixel(x, y);
        if native.spent() {
            break;
        }
        looked += 1;
        if let Some(&Value::Int(ink)) = native.reports().first()
            && ink > last
        {
            found.push((ink, (x, y)));
        }
    }
    let &(_, first) = found.first()?;
    Some(Beyond {
        greatest: found.iter().map(|(ink, _)| *ink).max()?,
        pixels: found.len(),
        looked,
        span: graph.span(source(&graph, first)),
    })
}

/// The node that gives a pixel its ink, behind the conditions that choose it.
fn source(graph: &Graph, (x, y): (i32, i32)) -> NodeId {
    let mut at = graph.ink;
    while let Node::Select { cond, yes, no } = graph.node(at) {
        let mut asked = graph.clone();
        asked.reports = vec![cond];
        let mut native = Native::within(&asked, PATIENCE);
        native.pixel(x, y);
        let held = native.reports().first().is_some_and(|v| v.truth());
        at = if held { yes } else { no };
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sema::{Options, lower};

    /// What is found on a screen of so many inks, and the text that it points at.
    fn found(draw: &str, inks: u32) -> Option<(Beyond, String)> {
        let text = format!("image 16 x 8 inks black, #555555, #aaaaaa, white;\n{draw}");
        let scene = crate::scene::load("a.scn", &text, None, &mut |_, _| Err(String::new()));
        assert!(scene.is_right(), "{:?}", scene.diagnostics);
        let options = Options {
            inks: Some(inks),
            all_inks: true,
            ..Options::default()
        };
        let graph = lower(&scene.program, &options).expect("a graph");
        let places: Vec<(i32, i32)> = (0..128).map(|k| (k % 16, k / 16)).collect();
        let beyond = beyond(&graph, &places)?;
        Some((beyond, scene.sources.text(beyond.span).to_owned()))
    }

    #[test]
    fn numbers_that_are_cut_are_counted_where_they_are_written() {
        let plain = "draw (x, y) = ink(1 + x mod 4);";
        let (beyond, text) = found(plain, 2).expect("numbers beyond");
        assert_eq!(
            (beyond.greatest, beyond.pixels, beyond.looked),
            (4, 96, 128)
        );
        assert_eq!(text, "ink(1 + x mod 4)");
        let (beyond, _) = found(plain, 4).expect("numbers beyond the picture's own");
        assert_eq!((beyond.greatest, beyond.pixels), (4, 32));
        let chosen =
            "draw (x, y) = if x < 4 then ink(y div 8) else if y > 3 then ink(2) else ink(1);";
        let (beyond, text) = found(chosen, 2).expect("numbers beyond");
        assert_eq!((beyond.greatest, beyond.pixels), (2, 48));
        assert_eq!(text, "ink(2)");
        // The same number elsewhere is another's.
        let shared = "draw (x, y) = if x mod 2 + 2 > 2 then ink(2) else ink(1);";
        let (_, text) = found(shared, 2).expect("numbers beyond");
        assert_eq!(text, "ink(2)");
        assert!(found(chosen, 3).is_none());
    }

    #[test]
    fn a_dither_counts_in_the_screens_inks() {
        for draw in [
            "draw (x, y) = threshold(x / 15, bayer(4)[x mod 4, y mod 4]);",
            "draw (x, y) = floyd(x / 10, x, y);",
            "draw (x, y) = ink(x mod inks);",
        ] {
            for inks in [2, 3, 4] {
                assert_eq!(found(draw, inks), None, "{draw}");
            }
        }
    }
}
