//! PLOT: points, lines, horizontal fills, triangles and (beyond the Micro) rectangles.

use super::Dialect;
use super::cost::plot as cost;
use super::display::Display;
use super::modes::Layout;

type Point = (i32, i32);

impl Display {
    /// PLOT k, x, y; answers its cycles.
    ///
    /// The low three bits of k say what: bit 2 absolute, bits 0-1 nothing, ink, inverse,
    /// paper. The rest say how: 0-63 lines, 64 points, 72 fill along the row, 80 triangles,
    /// 96 rectangles. Of what else later machines have, nothing is drawn.
    pub fn plot(&mut self, mem: &mut [u8], k: u8, x: i32, y: i32) -> u64 {
        // Coordinates are 16-bit.
        let (x, y) = (i32::from(x as i16), i32::from(y as i16));
        let at = if k & 4 != 0 {
            (x + self.origin.0, y + self.origin.1)
        } else {
            (x + self.points[0].0, y + self.points[0].1)
        };
        let at = (i32::from(at.0 as i16), i32::from(at.1 as i16));
        self.points = [at, self.points[0], self.points[1]];
        if k & 3 == 0 || self.mode.layout == Layout::Text {
            return 300;
        }
        let here = self.to_pixel(at.0, at.1);
        let before = self.to_pixel(self.points[1].0, self.points[1].1);
        match k >> 3 {
            0..=7 => self.line(mem, k, before, here),
            8 => {
                self.point_at(mem, k, here);
                cost::POINT
            }
            9 => self.row_fill(mem, k, here),
            10 => {
                let first = self.to_pixel(self.points[2].0, self.points[2].1);
                self.triangle(mem, k, [first, before, here])
            }
            12 if self.dialect() != Dialect::Micro => self.rectangle(mem, k, before, here),
            _ => 300,
        }
    }

    /// POINT(x, y): the ink there, -1 outside the window.
    pub fn point(&self, mem: &[u8], x: i32, y: i32) -> i32 {
        let (x, y) = (i32::from(x as i16), i32::from(y as i16));
        let (px, py) = self.to_pixel(x + self.origin.0, y + self.origin.1);
        if !self.inside(px, py) || self.mode.layout == Layout::Text {
            return -1;
        }
        i32::from(self.read_pixel(mem, px, py))
    }

    fn inside(&self, x: i32, y: i32) -> bool {
        let (l, b, r, t) = self.window;
        (l..=r).contains(&x) && (b..=t).contains(&y)
    }

    #[inline]
    fn point_at(&mut self, mem: &mut [u8], k: u8, (x, y): Point) {
        if !self.inside(x, y) {
            return;
        }
        let (action, ink) = match k & 3 {
            1 => (self.action, self.ink),
            2 => (4, 0),
            _ => (self.paper_action, self.paper),
        };
        let ink = if action == 0 {
            ink
        } else {
            let old = self.read_pixel(mem, x, y);
            match action {
                1 => old | ink,
                2 => old & ink,
                3 => old ^ ink,
                4 => old ^ self.top_ink(),
                _ => ink,
            }
        };
        self.write_pixel(mem, x, y, ink);
    }

    /// Bresenham's line. Codes 8 to 15 leave out the last point, 16 to 31 every other.
    fn line(&mut self, mem: &mut [u8], k: u8, from: Point, to: Point) -> u64 {
        let dx = (to.0 - from.0).abs();
        let dy = -(to.1 - from.1).abs();
        let step = ((to.0 - from.0).signum(), (to.1 - from.1).signum());
        let (mut x, mut y) = from;
        let mut error = dx + dy;
        let mut count = 0u64;
        loop {
            let last = (x, y) == to;
            let skipped = (k & 0x30 == 0x10 && count % 2 == 1) || (k & 8 != 0 && last);
            if !skipped {
                self.point_at(mem, k, (x, y));
            }
            count += 1;
            if last {
                return 1_000 + cost::LINE_POINT * count;
            }
            let twice = 2 * error;
            if twice >= dy {
                error += dy;
                x += step.0;
            }
            if twice <= dx {
                error += dx;
                y += step.1;
            }
        }
    }

    /// PLOT 72: both ways from the point as far as the paper's ink goes.
    fn row_fill(&mut self, mem: &mut [u8], k: u8, (x, y): Point) -> u64 {
        if !self.inside(x, y) || self.read_pixel(mem, x, y) != self.paper {
            return 600;
        }
        let (mut left, mut right) = (x, x);
        while self.inside(left - 1, y) && self.read_pixel(mem, left - 1, y) == self.paper {
            left -= 1;
        }
        while self.inside(right + 1, y) && self.read_pixel(mem, right + 1, y) == self.paper {
            right += 1;
        }
        self.span(mem, k, left, right, y)
    }

    /// One row of pixels.
    fn span(&mut self, mem: &mut [u8], k: u8, left: i32, right: i32, y: i32) -> u64 {
        let left = left.max(self.window.0);
        let right = right.min(self.window.2);
        for x in left..=right {
            self.point_at(mem, k, (x, y));
        }
        300 + cost::FILL_PIXEL * u64::from((right - left + 1).max(0).unsigned_abs())
    }

    /// All pixels between the edges, edges included, row by row.
    fn triangle(&mut self, mem: &mut [u8], k: u8, mut p: [Point; 3]) -> u64 {
        p.sort_by_key(|p| (p.1, p.0));
        let [a, b, c] = p;
        let mut cycles = 1_500;
        // Where the edge from p to q crosses row y, rounded.
        let cross = |p: Point, q: Point, y: i32| -> i32 {
            if q.1 == p.1 {
                return q.0;
            }
            let (rise, run) = (i64::from(q.1 - p.1), i64::from(q.0 - p.0));
            p.0 + (2 * run * i64::from(y - p.1) + rise).div_euclid(2 * rise) as i32
        };
        for y in a.1.max(self.window.1)..=c.1.min(self.window.3) {
            let long = cross(a, c, y);
            let (low, high) = if y < b.1 { (a, b) } else { (b, c) };
            let short = cross(low, high, y);
            let (mut left, mut right) = (long.min(short), long.max(short));
            if y == b.1 {
                left = left.min(b.0);
                right = right.max(b.0);
            }
            if a.1 == c.1 {
                left = a.0.min(b.0).min(c.0);
                right = a.0.max(b.0).max(c.0);
            }
            cycles += self.span(mem, k, left, right, y);
        }
        cycles
    }

    fn rectangle(&mut self, mem: &mut [u8], k: u8, a: Point, b: Point) -> u64 {
        let (low, high) = (a.1.min(b.1), a.1.max(b.1));
        let mut cycles = 1_000;
        for y in low.max(self.window.1)..=high.min(self.window.3) {
            cycles += self.span(mem, k, a.0.min(b.0), a.0.max(b.0), y);
        }
        cycles
    }
}
