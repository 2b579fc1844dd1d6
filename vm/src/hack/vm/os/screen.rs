//! Drawing: 512 x 256 pixels, 32 words a row, the leftmost pixel of a word
//! in its lowest bit, a set bit black. Coordinates outside the screen are
//! errors, as in the official implementation, and lines and circles take
//! the same pixels as its.

use super::{Memory, Os, Trap};
use crate::hack::vm::command::{KEYBOARD, SCREEN};

const WIDTH: i32 = 512;
const HEIGHT: i32 = 256;
/// Words in a row.
const PITCH: i32 = WIDTH / 16;

type Point = (u16, u16);

/// A coordinate as the signed number that it is.
fn signed(word: u16) -> i32 {
    i32::from(word.cast_signed())
}

fn on_screen(x: i32, y: i32) -> bool {
    (0..WIDTH).contains(&x) && (0..HEIGHT).contains(&y)
}

pub(super) fn clear(memory: &mut Memory, os: &mut Os) {
    for address in SCREEN..KEYBOARD {
        os.store(memory, address, 0);
    }
    // Clearing draws no pixel, so it says nothing about how far a picture is.
    os.drawn = None;
    os.effort += u64::from(KEYBOARD - SCREEN);
}

/// Paints the pixels in `mask` of one word of the screen.
fn paint(memory: &mut Memory, os: &mut Os, x: i32, y: i32, mask: u16) {
    // Everything that is drawn has been checked to lie on the screen.
    let address = SCREEN + (y * PITCH + x / 16) as u16;
    let word = memory[usize::from(address)];
    let word = if os.black { word | mask } else { word & !mask };
    os.store(memory, address, word);
    os.effort += 1;
}

fn dot(memory: &mut Memory, os: &mut Os, x: i32, y: i32) {
    paint(memory, os, x, y, 1 << (x & 15));
}

/// Paints the pixels `left..=right` of row `y`.
fn span(memory: &mut Memory, os: &mut Os, left: i32, right: i32, y: i32) {
    let mut x = left;
    while x <= right {
        let word_end = x | 15;
        let upto = word_end.min(right);
        let mask = (0xffff << (x & 15)) & (0xffff >> (word_end - upto));
        paint(memory, os, x, y, mask as u16);
        x = word_end + 1;
    }
}

pub(super) fn pixel(memory: &mut Memory, os: &mut Os, x: u16, y: u16) -> Result<u16, Trap> {
    let (x, y) = (signed(x), signed(y));
    if !on_screen(x, y) {
        return Err(Trap::Error(7, "drawPixel outside the screen"));
    }
    dot(memory, os, x, y);
    Ok(0)
}

/// Bresenham's line, walked along the longer side from its lesser end; on a
/// tie it steps sideways.
pub(super) fn line(memory: &mut Memory, os: &mut Os, from: Point, to: Point) -> Result<u16, Trap> {
    let (x1, y1) = (signed(from.0), signed(from.1));
    let (x2, y2) = (signed(to.0), signed(to.1));
    if !on_screen(x1, y1) || !on_screen(x2, y2) {
        return Err(Trap::Error(8, "drawLine outside the screen"));
    }
    let steep = (x2 - x1).abs() < (y2 - y1).abs();
    // Major and minor coordinates of the two ends, the lesser major first.
    let swap = |x, y| if steep { (y, x) } else { (x, y) };
    let (mut start, mut end) = (swap(x1, y1), swap(x2, y2));
    if end.0 < start.0 {
        (start, end) = (end, start);
    }
    let long = end.0 - start.0;
    let short = (end.1 - start.1).abs();
    let sideways = (end.1 - start.1).signum();
    let mut minor = start.1;
    let mut error = 2 * short - long;
    for major in start.0..=end.0 {
        let (x, y) = swap(major, minor);
        dot(memory, os, x, y);
        if error >= 0 {
            minor += sideways;
            error -= 2 * long;
        }
        error += 2 * short;
    }
    Ok(0)
}

pub(super) fn rectangle(
    memory: &mut Memory,
    os: &mut Os,
    from: Point,
    to: Point,
) -> Result<u16, Trap> {
    let (x1, y1) = (signed(from.0), signed(from.1));
    let (x2, y2) = (signed(to.0), signed(to.1));
    if x1 > x2 || y1 > y2 || !on_screen(x1, y1) || !on_screen(x2, y2) {
        return Err(Trap::Error(
            9,
            "drawRectangle outside the screen or inside out",
        ));
    }
    for y in y1..=y2 {
        span(memory, os, x1, x2, y);
    }
    Ok(0)
}

/// A filled circle by the midpoint algorithm.
pub(super) fn circle(
    memory: &mut Memory,
    os: &mut Os,
    centre: Point,
    radius: u16,
) -> Result<u16, Trap> {
    let (x, y, radius) = (signed(centre.0), signed(centre.1), signed(radius));
    if !on_screen(x, y) {
        return Err(Trap::Error(12, "drawCircle with its centre off the screen"));
    }
    if radius < 0 || !on_screen(x - radius, y - radius) || !on_screen(x + radius, y + radius) {
        return Err(Trap::Error(13, "drawCircle reaching over the screen"));
    }
    // One octant, from the top to the diagonal; each of its points gives four rows.
    let (mut across, mut along) = (0, radius);
    let mut error = 1 - radius;
    loop {
        for (half, row) in [(across, along), (along, across)] {
            span(memory, os, x - half, x + half, y - row);
            span(memory, os, x - half, x + half, y + row);
        }
        if along <= across {
            return Ok(0);
        }
        if error < 0 {
            error += 2 * across + 3;
        } else {
            error += 2 * (across - along) + 5;
            along -= 1;
        }
        across += 1;
    }
}
