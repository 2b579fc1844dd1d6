//! The picture of where two pictures are unlike.

use crate::draw::Drawn;
use crate::failure::Outcome;
use crate::picture::{Picture, png};

/// How far each ink is from the native one: grey where it is the same, red where it is
/// darker than it should be, blue where it is lighter, stronger the further: a PNG.
///
/// # Errors
/// Where it cannot be made.
pub fn difference(picture: &Picture, native: &Drawn) -> Outcome<Vec<u8>> {
    let steps = picture.palette.len().saturating_sub(1).max(1) as i32;
    // Index 0 is equal; then so many steps darker, then lighter.
    let strength = |k: i32| (120 + 135 * k / steps) as u8;
    let mut palette = vec![[235u8; 3]];
    palette.extend((1..=steps).map(|k| [strength(k), 30, 30]));
    palette.extend((1..=steps).map(|k| [30, 60, strength(k)]));
    let data: Vec<u8> = (picture.inks.iter().zip(&native.pixels))
        .map(
            |(ink, pixel)| match i32::from(*ink) - i32::from(pixel.ink) {
                0 => 0,
                darker @ ..0 => (-darker).min(steps) as u8,
                lighter => (steps + lighter.min(steps)) as u8,
            },
        )
        .collect();
    let colours = palette.concat();
    png(picture.width, picture.height, Some(colours), &data)
}
