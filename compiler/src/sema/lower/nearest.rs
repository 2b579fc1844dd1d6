//! What is told of a palette, for an ordered dither between its colours: the ink that is nearest
//! to each cell of a cube of colours, and how far its levels of a primary are apart.

use super::value::{Table, Val};
use super::{Found, Lower};
use crate::sema::program::*;
use crate::source::Span;
use std::rc::Rc;

/// The cells along red, green and blue.
const SIDES: std::ops::RangeInclusive<i32> = 2..=8;

/// What counts of red, green and blue (Rec. 601).
const WEIGHTS: [f64; 3] = [0.299, 0.587, 0.114];

/// The inks that are nearest to the middles of all cells, red first; of two as near the first.
fn nearest(palette: &[[u8; 3]], side: u32) -> Vec<usize> {
    let middle = |cell: u32| (f64::from(cell) + 0.5) / f64::from(side);
    let off = |colour: [f64; 3], ink: &[u8; 3]| -> f64 {
        let parts = colour.iter().zip(ink).zip(WEIGHTS);
        parts
            .map(|((a, b), weight)| (a - f64::from(*b) / 255.0).powi(2) * weight)
            .sum()
    };
    let near = |cell: [u32; 3]| {
        let colour = cell.map(middle);
        let inks = palette.iter().enumerate();
        let least = inks.min_by(|a, b| off(colour, a.1).total_cmp(&off(colour, b.1)));
        least.map_or(0, |(ink, _)| ink)
    };
    let rows = (0..side).flat_map(|z| (0..side).map(move |y| (y, z)));
    let cells = rows.flat_map(|(y, z)| (0..side).map(move |x| [x, y, z]));
    cells.map(near).collect()
}

/// How far a primary's levels in a palette are apart, as if they were evenly so: of two 1.
fn step(palette: &[[u8; 3]], primary: usize) -> f64 {
    let mut levels: Vec<u8> = palette.iter().map(|rgb| rgb[primary]).collect();
    levels.sort_unstable();
    levels.dedup();
    match levels.len() {
        0 | 1 => 0.0,
        n => 1.0 / (n - 1) as f64,
    }
}

impl<'a> Lower<'a> {
    /// A table over so many cells along each primary.
    pub(super) fn nearest_inks(&mut self, side: &'a Expr, span: Span) -> Found<Val> {
        let cells = self.known_int(side, "the cells along each primary")?;
        if !SIDES.contains(&cells) {
            let error = self.error(side.span, format!("no cube of colours has {cells} cells"));
            let (least, most) = (SIDES.start(), SIDES.end());
            let help = format!("it has {least} to {most} along each primary");
            return Err(Box::new(error.help(help)));
        }
        if let Some(found) = self.tables.nearest.get(&cells) {
            return Ok(Val::Table(found.clone()));
        }
        let found = nearest(&self.image.palette, cells.unsigned_abs());
        let entries: Vec<Val> = (found.iter())
            .map(|ink| Val::Node(self.int(*ink as i32, span)))
            .collect();
        let table = Rc::new(Table {
            name: "nearest_inks".to_owned(),
            width: entries.len(),
            entries,
        });
        self.tables.nearest.insert(cells, table.clone());
        Ok(Val::Table(table))
    }

    /// How far a primary's levels are apart.
    pub(super) fn ink_step(&mut self, primary: &'a Expr, span: Span) -> Found<Val> {
        let number = self.known_int(primary, "the number of a primary")?;
        match usize::try_from(number).ok().filter(|number| *number < 3) {
            Some(number) => {
                let step = step(&self.image.palette, number);
                Ok(Val::Node(self.real(step, span)))
            }
            None => {
                let error = self.error(primary.span, format!("there is no primary {number}"));
                Err(Box::new(error.help("red is 0, green 1 and blue 2")))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK: [u8; 3] = [0; 3];
    const GREY: [u8; 3] = [128; 3];
    const WHITE: [u8; 3] = [255; 3];
    const RED: [u8; 3] = [255, 0, 0];

    #[test]
    fn cells_have_the_ink_that_is_nearest_to_their_middles() {
        let of = |palette: &[[u8; 3]], side: u32, cell: [u32; 3]| {
            let [x, y, z] = cell;
            nearest(palette, side)[(x + side * (y + side * z)) as usize]
        };
        let inks = [BLACK, RED, WHITE];
        for side in [2, 4, 7] {
            let last = side - 1;
            assert_eq!(of(&inks, side, [0, 0, 0]), 0);
            assert_eq!(of(&inks, side, [last, 0, 0]), 1);
            assert_eq!(of(&inks, side, [last; 3]), 2);
        }
        let greys = (0..4).map(|k| of(&[BLACK, GREY, WHITE], 4, [k; 3]));
        assert_eq!(greys.collect::<Vec<usize>>(), [0, 1, 1, 2]);
    }

    #[test]
    fn levels_are_as_many_as_differ() {
        assert_eq!(step(&[BLACK, WHITE], 0), 1.0);
        assert_eq!(step(&[BLACK, GREY, RED, WHITE], 0), 0.5);
        assert_eq!(step(&[BLACK, RED], 1), 0.0);
    }
}
