//! PLOT and the graphics cursor: coordinates, code groups, the graphics window, POINT and CLG.
//!
//! Three things move: the cursor in pixels, the one before it, and the cursor in graphics units
//! from the origin, to which relative coordinates are added. They part where OS 1.20 lets them.

use super::Dialect;
use super::cost::plot as cost;
use super::display::Display;
use super::modes::Layout;
use super::pixels::{Pen, Point};
use super::raster::Line;

/// 16 bits with sign, as the operating system counts.
fn wrap(n: i32) -> i32 {
    i32::from(n as i16)
}

impl Display {
    /// PLOT k, x, y; answers its cycles.
    ///
    /// The low three bits of k say what: bit 2 absolute, bits 0-1 nothing, ink, inverse,
    /// paper. The rest say how: 0-31 lines, 64 points, 72 fill along the row, 80 triangles, 88
    /// fill to the right; with later machines 32-63 lines and 96 rectangles.
    pub fn plot(&mut self, mem: &mut [u8], k: u8, x: i32, y: i32) -> u64 {
        if self.text.off {
            return 300;
        }
        let here = self.locate(k & 4 != 0, (x, y));
        let micro = self.dialect() == Dialect::Micro;
        if k == 4 || self.mode.layout == Layout::Text {
            self.move_to(here);
            return 300;
        }
        let pen = match k & 3 {
            0 => Pen::NOTHING,
            1 => self.ink,
            2 => Pen::INVERTING,
            _ => self.paper,
        };
        match k >> 3 {
            0..=3 => self.plot_line(mem, pen, k, here),
            4..=7 if !micro => self.plot_line(mem, pen, k, here),
            8 => {
                self.draw(mem, pen, here);
                self.move_to(here);
                cost::POINT
            }
            9 => self.fill_both_ways(mem, pen, here),
            10 => {
                let corners = [self.before, self.cursor, here];
                let cycles = self.triangle(mem, pen, corners);
                self.move_to(here);
                cycles
            }
            11 => self.fill_right(mem, pen, here),
            12 if !micro => {
                let from = self.cursor;
                self.move_to(here);
                self.rectangle(mem, pen, from, here)
            }
            _ => {
                // Codes that OS 1.20 leaves to others have got half way by then.
                match k >> 3 {
                    12..=15 if micro => self.cursor = here,
                    _ if micro => {}
                    _ => self.move_to(here),
                }
                300
            }
        }
    }

    /// POINT(x, y): the ink there, -1 outside the window. OS 1.20 keeps the place for
    /// coordinates relative to it.
    pub fn point(&mut self, mem: &[u8], x: i32, y: i32) -> i32 {
        let here = self.locate(true, (x, y));
        if self.outside(here) != 0 || self.mode.layout == Layout::Text {
            return -1;
        }
        i32::from(self.read_pixel(mem, here.0, here.1))
    }

    /// The pixel of coordinates in graphics units, which relative ones are added to next.
    fn locate(&mut self, absolute: bool, (x, y): Point) -> Point {
        let from = if absolute { (0, 0) } else { self.place };
        self.place = (wrap(x + from.0), wrap(y + from.1));
        self.pixel_of(self.place)
    }

    /// The pixel of a place in graphics units from the origin.
    fn pixel_of(&self, (x, y): Point) -> Point {
        self.to_pixel(wrap(x + self.origin.0), wrap(y + self.origin.1))
    }

    fn move_to(&mut self, here: Point) {
        self.before = self.cursor;
        self.cursor = here;
    }

    /// The place in graphics units becomes that of the cursor's pixel.
    pub fn place_cursor(&mut self) {
        let m = &self.mode;
        if m.layout != Layout::Text {
            let x = self.cursor.0 * 1280 / m.width as i32 - self.origin.0;
            let y = self.cursor.1 * 1024 / m.height as i32 - self.origin.1;
            self.place = (wrap(x), wrap(y));
        }
    }

    /// VDU 29.
    pub fn set_origin(&mut self, origin: Point) {
        self.origin = origin;
        self.place_cursor();
    }

    /// VDU 24. A window that does not fit the screen, or has a side before the other, is ignored.
    pub fn set_window(&mut self, [left, bottom, right, top]: [i32; 4]) {
        let (l, b) = self.pixel_of((left, bottom));
        let (r, t) = self.pixel_of((right, top));
        let (w, h) = (self.mode.width as i32, self.mode.height as i32);
        let in_order = wrap(right - left) >= 0 && wrap(top - bottom) >= 0;
        if in_order && l >= 0 && b >= 0 && (0..w).contains(&r) && (0..h).contains(&t) {
            self.window = (l, b, r, t);
        }
    }

    /// CLG, with the paper's action.
    pub fn clear_window(&mut self, mem: &mut [u8]) {
        let (left, bottom, right, top) = self.window;
        for y in bottom..=top {
            self.span(mem, self.paper, (left, right), y);
        }
    }

    /// Codes 8 to 15 and 24 to 31 draw the last point once more (so that it comes out as it was
    /// where pixels are inverted); later machines leave it out, and from 32 on the first.
    fn plot_line(&mut self, mem: &mut [u8], pen: Pen, k: u8, to: Point) -> u64 {
        let micro = self.dialect() == Dialect::Micro;
        let mut line = Line {
            from: self.cursor,
            to,
            dotted: k & 0x10 != 0,
            without: [None; 2],
        };
        if micro && k & 8 != 0 {
            self.draw(mem, pen, to);
        } else if !micro {
            line.without = [
                (k & 8 != 0).then_some(to),
                (k & 0x20 != 0).then_some(line.from),
            ];
        }
        self.move_to(to);
        self.line(mem, pen, line)
    }

    /// PLOT 72: both ways from the point as far as pixels are the paper's. The ends are the last
    /// two places then.
    fn fill_both_ways(&mut self, mem: &mut [u8], pen: Pen, here: Point) -> u64 {
        if self.outside(here) != 0 || self.read_pixel(mem, here.0, here.1) != self.paper.ink {
            return self.fill_nothing(here);
        }
        let left = self.reach(mem, here, -1, true);
        let right = self.reach(mem, here, 1, true);
        self.filled(mem, pen, (left, right), here.1)
    }

    /// PLOT 88: to the right as far as pixels are not the paper's.
    fn fill_right(&mut self, mem: &mut [u8], pen: Pen, here: Point) -> u64 {
        if self.outside(here) != 0 {
            return self.fill_nothing(here);
        }
        let right = self.reach(mem, here, 1, false);
        self.filled(mem, pen, (here.0, right), here.1)
    }

    /// Where nothing is to fill, the place before becomes the one above (within its low byte).
    fn fill_nothing(&mut self, here: Point) -> u64 {
        let above = here.1 & !0xff | (here.1 + 1) & 0xff;
        self.before = (here.0, above);
        self.cursor = here;
        self.place_cursor();
        600
    }

    fn filled(&mut self, mem: &mut [u8], pen: Pen, (left, right): (i32, i32), y: i32) -> u64 {
        self.before = (left, y);
        self.cursor = (right, y);
        self.place_cursor();
        if left > right {
            return 600;
        }
        self.span(mem, pen, (left, right), y)
    }

    fn rectangle(&mut self, mem: &mut [u8], pen: Pen, a: Point, b: Point) -> u64 {
        let (low, high) = (a.1.min(b.1), a.1.max(b.1));
        let mut cycles = 1_000;
        for y in low.max(self.window.1)..=high.min(self.window.3) {
            cycles += self.span(mem, pen, (a.0, b.0), y);
        }
        cycles
    }
}
