//! Characters on graphics screens: at the text cursor (VDU 4) in the text window (VDU 28), with
//! scrolling, or at the graphics cursor (VDU 5); and their shapes (VDU 23).
//!
//! OS 1.20 keeps one page for shapes that programs define: in it lie the characters 128 to 159,
//! 160 to 191, 192 to 223 and 224 to 255, all four in the same bytes; and those of a group below,
//! all of them, once one has been defined.

use super::display::Display;
use super::font::FONT;
use super::modes::Layout;
use super::pixels::{Pen, Point};

/// The page of shapes.
const SHAPES: usize = 0xc00;
/// Shapes have eight rows of eight pixels.
const SIDE: i32 = 8;

/// Where text goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Text {
    /// The cursor's column and row, from the screen's top left.
    pub at: Point,
    /// The window in columns and rows: left, bottom, right, top, inclusive.
    pub window: (i32, i32, i32, i32),
    /// A window has been defined: what scrolls is its contents, not the screen.
    pub windowed: bool,
    pub ink: u8,
    pub paper: u8,
    /// Characters go to the graphics cursor.
    pub graphics: bool,
    /// VDU 21: nothing is shown until VDU 6.
    pub off: bool,
}

/// The groups of 32 characters whose shapes are in the page, a bit each from the top: at first
/// the upper four.
pub(crate) const UPPER: u8 = 0x0f;

fn group(character: u8) -> u8 {
    0x80 >> (character >> 5)
}

/// The shape that a character has before one is defined.
fn original(character: u8) -> [u8; 8] {
    let index = usize::from(character).wrapping_sub(32);
    FONT.get(index).copied().unwrap_or_default()
}

impl Display {
    fn has_pixels(&self) -> bool {
        self.mode.layout == Layout::Memory
    }

    /// VDU 23 for a character.
    pub fn define_shape(&mut self, mem: &mut [u8], character: u8, rows: [u8; 8]) {
        let mut put = |c: u8, rows: [u8; 8]| {
            let at = SHAPES + 8 * usize::from(c & 31);
            if let Some(bytes) = mem.get_mut(at..at + 8) {
                bytes.copy_from_slice(&rows);
            }
        };
        if self.shaped & group(character) == 0 {
            self.shaped |= group(character);
            let first = character & !31;
            (first..=first | 31).for_each(|c| put(c, original(c)));
        }
        put(character, rows);
    }

    fn shape_of(&self, mem: &[u8], character: u8) -> [u8; 8] {
        if self.shaped & group(character) == 0 {
            return original(character);
        }
        let at = SHAPES + 8 * usize::from(character & 31);
        let bytes = mem.get(at..at + 8).and_then(|b| b.try_into().ok());
        bytes.unwrap_or_default()
    }

    /// A character, and the cursor goes on.
    pub fn character(&mut self, mem: &mut [u8], character: u8) {
        if self.text.graphics {
            let shape = self.shape_of(mem, character);
            self.stamp(mem, self.ink, shape);
        } else if self.has_pixels() {
            let shape = self.shape_of(mem, character);
            self.letter(mem, shape);
        }
        self.forward(mem);
    }

    /// VDU 127: the character before is removed.
    pub fn delete(&mut self, mem: &mut [u8]) {
        self.backward(mem);
        if self.text.graphics {
            let shape = self.shape_of(mem, 127);
            self.stamp(mem, Pen::setting(self.paper.ink), shape);
        } else if self.has_pixels() {
            self.letter(mem, original(b' '));
        }
    }

    /// A shape in text's colours at the text cursor.
    fn letter(&mut self, mem: &mut [u8], shape: [u8; 8]) {
        let (x, y) = (self.text.at.0 * SIDE, self.text.at.1 * SIDE);
        let top = self.mode.height as i32 - 1 - y;
        for (row, bits) in (0..).zip(shape) {
            for column in 0..SIDE {
                let set = bits << column & 0x80 != 0;
                let ink = if set { self.text.ink } else { self.text.paper };
                self.write_pixel(mem, x + column, top - row, ink);
            }
        }
    }

    /// A shape's set pixels, its top left corner at the graphics cursor.
    fn stamp(&mut self, mem: &mut [u8], pen: Pen, shape: [u8; 8]) {
        let (x, y) = self.cursor;
        for (row, bits) in (0..).zip(shape) {
            for column in 0..SIDE {
                if bits << column & 0x80 != 0 {
                    self.draw(mem, pen, (x + column, y - row));
                }
            }
        }
    }

    /// VDU 8.
    pub fn backward(&mut self, mem: &mut [u8]) {
        if self.text.graphics {
            return self.step(-1, 0);
        }
        self.text.at.0 -= 1;
        if self.text.at.0 < self.text.window.0 {
            self.text.at.0 = self.text.window.2;
            self.up(mem);
        }
    }

    /// VDU 9.
    pub fn forward(&mut self, mem: &mut [u8]) {
        if self.text.graphics {
            return self.step(1, 0);
        }
        if self.text.at.0 < self.text.window.2 {
            self.text.at.0 += 1;
        } else {
            self.text.at.0 = self.text.window.0;
            self.down(mem);
        }
    }

    /// VDU 10.
    pub fn down(&mut self, mem: &mut [u8]) {
        if self.text.graphics {
            return self.step(0, -1);
        }
        if self.text.at.1 < self.text.window.1 {
            self.text.at.1 += 1;
        } else {
            self.scroll(mem, 1);
        }
    }

    /// VDU 11.
    pub fn up(&mut self, mem: &mut [u8]) {
        if self.text.graphics {
            return self.step(0, 1);
        }
        if self.text.at.1 == self.text.window.3 {
            self.scroll(mem, -1);
        } else {
            self.text.at.1 -= 1;
        }
    }

    /// VDU 13.
    pub fn carriage_return(&mut self) {
        if self.text.graphics {
            self.cursor.0 = self.window.0;
            self.place_cursor();
        } else {
            self.text.at.0 = self.text.window.0;
        }
    }

    /// VDU 30.
    pub fn home(&mut self) {
        if self.text.graphics {
            self.cursor.1 = self.window.3;
            self.carriage_return();
        } else {
            self.text.at = (self.text.window.0, self.text.window.3);
        }
    }

    /// VDU 31, from the window's corner. A place outside the window is ignored.
    pub fn tab(&mut self, x: u8, y: u8) {
        let (left, bottom, right, top) = self.text.window;
        let at = (left + i32::from(x), top + i32::from(y));
        if !self.text.graphics && at.0 <= right && at.1 <= bottom {
            self.text.at = at;
        }
    }

    /// VDU 12.
    pub fn clear_text(&mut self, mem: &mut [u8]) {
        if self.text.graphics {
            self.home();
            return self.clear_window(mem);
        }
        if !self.text.windowed {
            self.scrolled = 0;
        }
        let (_, bottom, _, top) = self.text.window;
        self.clear_rows(mem, top, bottom);
        self.home();
    }

    /// VDU 28. A window that does not fit the screen is ignored.
    pub fn set_text_window(&mut self, [left, bottom, right, top]: [u8; 4]) {
        let fits = bottom >= top && bottom < self.mode.rows && right < self.mode.columns;
        if !fits || left > right {
            return;
        }
        self.text.windowed = true;
        let [left, bottom, right, top] = [left, bottom, right, top].map(i32::from);
        self.text.window = (left, bottom, right, top);
        let (x, y) = self.text.at;
        if !(left..=right).contains(&x) || !(top..=bottom).contains(&y) {
            self.home();
        }
    }

    /// The text window's rows from one to another, cleared to text's paper.
    fn clear_rows(&mut self, mem: &mut [u8], top: i32, bottom: i32) {
        if self.mode.layout == Layout::Text {
            return;
        }
        let (left, _, right, _) = self.text.window;
        let height = self.mode.height as i32;
        let width = self.mode.width as i32;
        // Outside the Micro a row of characters may be higher than what is left of the screen.
        let area = (
            left * SIDE,
            (height - (bottom + 1) * SIDE).max(0),
            ((right + 1) * SIDE).min(width) - 1,
            height - 1 - top * SIDE,
        );
        self.fill(mem, area, self.text.paper);
    }

    /// One row up (1) or down (-1), and the row that is new cleared: the whole screen by its start
    /// in memory, a window's contents pixel by pixel.
    fn scroll(&mut self, mem: &mut [u8], rows: i32) {
        if !self.has_pixels() {
            return;
        }
        let (left, bottom, right, top) = self.text.window;
        if self.text.windowed {
            let lines = (bottom - top) * SIDE;
            let (first, last) = (top * SIDE, (bottom + 1) * SIDE - 1);
            for i in 0..lines {
                let (from, to) = match rows > 0 {
                    true => (first + i + SIDE, first + i),
                    false => (last - i - SIDE, last - i),
                };
                let y = |row: i32| self.mode.height as i32 - 1 - row;
                let (from, to) = (y(from), y(to));
                for x in left * SIDE..(right + 1) * SIDE {
                    let ink = self.read_pixel(mem, x, from);
                    self.write_pixel(mem, x, to, ink);
                }
            }
        } else {
            let row = self.row_bytes();
            let size = u32::from(self.mode.rows) * row;
            let by = if rows > 0 { row } else { size - row };
            self.scrolled = (self.scrolled + by) % size;
        }
        let new = if rows > 0 { bottom } else { top };
        self.clear_rows(mem, new, new);
    }

    /// The graphics cursor eight pixels aside or up or down. Where that leaves the window it goes on
    /// at the other side, and from the ends of a row in the next.
    fn step(&mut self, x: i32, y: i32) {
        let was_inside = self.outside(self.cursor) == 0;
        self.cursor.0 += x * SIDE;
        self.cursor.1 += y * SIDE;
        let (left, bottom, right, top) = self.window;
        if was_inside && self.outside(self.cursor) != 0 {
            match (x, y) {
                (1, _) => self.cursor.0 = left,
                (-1, _) => self.cursor.0 = right - (SIDE - 1),
                (_, 1) => self.cursor.1 = bottom + (SIDE - 1),
                _ => self.cursor.1 = top,
            }
            if x != 0 {
                return self.step(0, -x);
            }
        }
        self.place_cursor();
    }
}
