//! Which pixels of a picture are traced: one of each block, or those whose neighbours differ.

use super::ScreenArgs;
use crate::failure::{Failure, Outcome};
use serde::{Deserialize, Serialize};
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::ir::refinement::LEVELS;
use slowlight_compiler::passes::pixel_blocks::pixel_blocks;
use slowlight_compiler::passes::refine::{STEPS, TOLERANCE, Unrefined, expected, refine};
use std::fmt::{self, Display};

/// `--refine`: which pixels are traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Refining {
    /// Rows from one that is traced as a whole to the next, a power of two.
    pub step: u32,
    /// By how many levels neighbours of a pixel between them may differ for it not to be.
    pub tolerance: u8,
}

impl Display for Refining {
    /// As the option has it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.step)?;
        match self.tolerance {
            TOLERANCE => Ok(()),
            levels => write!(f, ":{:.3}", f64::from(levels) / f64::from(LEVELS)),
        }
    }
}

/// Reads `--refine`: `8`, or `8:0.05`.
///
/// # Errors
/// Where it is no such thing: what it may be.
pub fn refining(text: &str) -> Result<Refining, String> {
    let share = |text: &str| {
        let share = text.trim().parse::<f64>().ok();
        let share = share.filter(|share| (0.0..=1.0).contains(share))?;
        Some((share * f64::from(LEVELS)).round() as u8)
    };
    let (step, tolerance) = match text.split_once(':') {
        Some((step, tolerance)) => (step, share(tolerance)),
        None => (text, Some(TOLERANCE)),
    };
    let step = step.trim().parse().ok().filter(|step| STEPS.contains(step));
    match (step, tolerance) {
        (Some(step), Some(tolerance)) => Ok(Refining { step, tolerance }),
        _ => Err(
            "so many rows from one that is traced as a whole to the next, 2, 4, 8 or 16, and \
             how far shades may differ for those between not to be traced, from 0 to 1: \
             --refine 8 or --refine 8:0.05"
                .to_owned(),
        ),
    }
}

impl ScreenArgs {
    /// The graph of a picture of which not every pixel is traced, where that is asked for.
    ///
    /// # Errors
    /// Where the picture is not whole blocks, or has no shade of its own.
    pub(super) fn sampled(&self, graph: &Graph) -> Outcome<Graph> {
        let (width, height) = (graph.image.width, graph.image.height);
        let block = self.block.unwrap_or((1, 1));
        if !width.is_multiple_of(block.0) || !height.is_multiple_of(block.1) {
            return Err(Failure::Usage(format!(
                "--block {}x{}: the picture of {width} x {height} pixels is no whole number of \
                 such blocks",
                block.0, block.1
            )));
        }
        let graph = pixel_blocks(graph, block);
        let Some(refining) = self.refine else {
            return Ok(graph);
        };
        let refined = refine(&graph, refining.step, refining.tolerance);
        refined.map(expected).map_err(|why| {
            Failure::Usage(format!(
                "--refine: this picture {}",
                match why {
                    Unrefined::Spreads =>
                        "spreads the error of its dither, so each pixel hangs on the shade of \
                         the one before it; a dither by a matrix (`bayer`) lets pixels be left out",
                    Unrefined::NoShade =>
                        "has inks alone, and nothing lies between two inks; let `draw` end in \
                         one dither of a shade, as in `threshold(shade, bayer(4)[x mod 4, y mod 4])`",
                }
            ))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refining_is_a_step_and_a_tolerance() {
        let whole = |step, tolerance| Ok(Refining { step, tolerance });
        assert_eq!(refining("8"), whole(8, TOLERANCE));
        assert_eq!(refining("2:0"), whole(2, 0));
        assert_eq!(refining("16:0.25"), whole(16, 64));
        for wrong in [
            "", "3", "32", "1", "8:", "8:2", "8:-1", "8:x", "8:nan", ":0.1",
        ] {
            assert!(refining(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn refining_is_read_as_it_is_written() {
        for tolerance in 0..=255 {
            let one = Refining { step: 4, tolerance };
            assert_eq!(refining(&one.to_string()), Ok(one));
        }
    }
}
