//! Scan conversion as OS 1.20 has it: Bresenham lines, triangles and spans filled along rows.
//!
//! Pixels count from the bottom left of the screen, and each is held against the graphics window
//! by itself. Which pixels a shape has does not depend on the window, so a line that leaves the
//! screen is the line that it would be without an edge.

use super::cost::plot as cost;
use super::display::Display;
use super::pixels::{Pen, Point};

/// A line, and what is left out of it.
#[derive(Clone, Copy)]
pub(crate) struct Line {
    pub from: Point,
    pub to: Point,
    /// Every other point, beginning with the first that is stepped to.
    pub dotted: bool,
    /// Points that are not drawn.
    pub without: [Option<Point>; 2],
}

/// One edge of a triangle, walked upwards a row at a time.
struct Edge {
    x: i32,
    step: i32,
    error: i32,
    run: i32,
    rise: i32,
}

impl Edge {
    /// From the lower end to the higher.
    fn new(low: Point, high: Point) -> Self {
        let (run, rise) = ((high.0 - low.0).abs(), (high.1 - low.1).abs());
        Self {
            x: low.0,
            step: if high.0 < low.0 { -1 } else { 1 },
            error: rise / 2,
            run,
            rise,
        }
    }

    /// One row up: as many steps aside as make up for the run. (Never where both ends are in the
    /// same row: there is no row between them.)
    fn up(&mut self) {
        self.error -= self.run;
        if self.error < 0 && self.rise > 0 {
            let steps = (-self.error + self.rise - 1) / self.rise;
            self.x += self.step * steps;
            self.error += self.rise * steps;
        }
    }
}

impl Display {
    /// Bresenham's line, always stepped to the right or upwards along its longer side; where
    /// both are as long, upwards if that does not turn it round. The error starts at half
    /// of the longer side. Answers cycles.
    pub fn line(&mut self, mem: &mut [u8], pen: Pen, line: Line) -> u64 {
        let back = (line.from.0 - line.to.0, line.from.1 - line.to.1);
        let upright = match back.1.abs().cmp(&back.0.abs()) {
            std::cmp::Ordering::Greater => true,
            std::cmp::Ordering::Equal => back.1 >= 0,
            std::cmp::Ordering::Less => false,
        };
        let (long, short) = match upright {
            true => (back.1, back.0),
            false => (back.0, back.1),
        };
        let (start, end) = match long >= 0 {
            true => (line.to, line.from),
            false => (line.from, line.to),
        };
        if self.outside(start) & self.outside(end) != 0 {
            return 1_000;
        }
        let aside = if (short < 0) == (long < 0) { 1 } else { -1 };
        let (long, short) = (long.abs(), short.abs());
        let (mut error, (mut x, mut y)) = (long / 2, start);
        for i in 0..=long {
            let here = Some((x, y));
            let left_out = line.dotted && i % 2 == 1 || line.without.contains(&here);
            if !left_out {
                self.draw(mem, pen, (x, y));
            }
            error -= short;
            let turn = error < 0;
            if turn {
                error += long;
            }
            let turn = i32::from(turn) * aside;
            (x, y) = match upright {
                true => (x + turn, y + 1),
                false => (x + 1, y + turn),
            };
        }
        1_000 + cost::LINE_POINT * u64::from(long.unsigned_abs() + 1)
    }

    /// All pixels between two of a row, which need not be in order. Answers cycles.
    pub fn span(&mut self, mem: &mut [u8], pen: Pen, (a, b): (i32, i32), y: i32) -> u64 {
        let left = a.min(b).max(self.window.0);
        let right = a.max(b).min(self.window.2);
        if (self.window.1..=self.window.3).contains(&y) {
            for x in left..=right {
                self.draw(mem, pen, (x, y));
            }
        }
        300 + cost::FILL_PIXEL * u64::from((right - left + 1).max(0).unsigned_abs())
    }

    /// A filled triangle, by rows from the lowest corner: on one side the edge from the lowest to
    /// the highest corner, on the other the two edges by way of the middle one. Of corners
    /// in the same row those that came last stay lower. Answers cycles.
    pub fn triangle(&mut self, mem: &mut [u8], pen: Pen, corners: [Point; 3]) -> u64 {
        let [mut middle, mut high, mut low] = corners;
        let order = |below: &mut Point, above: &mut Point| {
            if below.1 >= above.1 {
                std::mem::swap(below, above);
            }
        };
        order(&mut low, &mut middle);
        order(&mut middle, &mut high);
        order(&mut low, &mut middle);
        let mut whole = Edge::new(low, high);
        let mut cycles = 1_500;
        let mut last = low.0;
        for (from, to) in [(low, middle), (middle, high)] {
            let mut part = Edge::new(from, to);
            for y in from.1..to.1 {
                cycles += self.span(mem, pen, (part.x, whole.x), y);
                part.up();
                whole.up();
            }
            last = part.x;
        }
        cycles + self.span(mem, pen, (last, whole.x), high.1)
    }

    /// How far a row goes on from a point while its pixels are (or are not) the paper's, within
    /// the window: the last such point, which is the one before where there is none.
    pub fn reach(&self, mem: &[u8], (mut x, y): Point, step: i32, paper: bool) -> i32 {
        while self.outside((x, y)) == 0 && (self.read_pixel(mem, x, y) == self.paper.ink) == paper {
            x += step;
        }
        x - step
    }
}
