//! Viewport: where a picture stands on a screen of another size.

use crate::ir::graph::Image;
use crate::targets::Mode;

/// Where the picture stands on the screen, and which of it is seen: centred
/// where the screen is larger, cropped where it is smaller.
pub(crate) fn placed(image: &Image, mode: &Mode) -> ((i32, i32), (u32, u32), (u32, u32)) {
    let axis = |count: u32, block: u32, screen: u32| {
        let (count, block, screen) = (i64::from(count), i64::from(block), i64::from(screen));
        let offset = (screen - count * block).div_euclid(2);
        // Whole blocks only.
        let first = (-offset).max(0).div_euclid(block) + i64::from((-offset).max(0) % block > 0);
        let last = ((screen - offset).div_euclid(block) - 1).min(count - 1);
        (offset as i32, (first as u32, last.max(first) as u32))
    };
    let (left, columns) = axis(image.width, image.block.0, mode.width);
    let (top, rows) = axis(image.height, image.block.1, mode.height);
    ((left, top), columns, rows)
}
