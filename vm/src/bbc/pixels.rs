//! Pixels in the frame buffer: where they lie in memory, and GCOL's raster operations on them.

use super::display::Display;
use super::modes::Layout;
use crate::Screen;

/// A pixel's place, from the bottom left.
pub(crate) type Point = (i32, i32);

/// What is done to a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Pen {
    /// GCOL's first number: 0 set, 1 OR, 2 AND, 3 exclusive OR, 4 inverted. With any other a pixel
    /// stays as it is. (So it is with 5 in OS 1.20, which looks up what follows its table for more.)
    pub action: u8,
    pub ink: u8,
}

impl Pen {
    pub const NOTHING: Self = Self { action: 5, ink: 0 };
    pub const INVERTING: Self = Self { action: 4, ink: 0 };

    pub const fn setting(ink: u8) -> Self {
        Self { action: 0, ink }
    }

    fn on(self, old: u8, top: u8) -> u8 {
        match self.action {
            0 => self.ink,
            1 => old | self.ink,
            2 => old & self.ink,
            3 => old ^ self.ink,
            4 => old ^ top,
            _ => old,
        }
    }
}

impl Display {
    /// On which sides a pixel is outside the graphics window: a bit each for left, right, below
    /// and above, at most one of each pair.
    pub fn outside(&self, (x, y): Point) -> u8 {
        let (left, bottom, right, top) = self.window;
        u8::from(x < left)
            | u8::from(x > right) << 1
            | u8::from(y < bottom) << 2
            | u8::from(y > top) << 3
    }

    /// A pixel, if it is inside the window.
    #[inline]
    pub fn draw(&mut self, mem: &mut [u8], pen: Pen, (x, y): Point) {
        if self.outside((x, y)) != 0 {
            return;
        }
        let ink = match pen.action {
            0 => pen.ink,
            _ => pen.on(self.read_pixel(mem, x, y), self.top_ink()),
        };
        self.write_pixel(mem, x, y, ink);
    }

    /// Bytes in a row of characters, and bits of a pixel.
    fn shape(&self) -> (u32, u32) {
        let bits = match self.mode.inks {
            2 => 1,
            4 => 2,
            _ => 4,
        };
        (self.mode.width * bits, bits)
    }

    /// Bytes in a row of characters.
    pub fn row_bytes(&self) -> u32 {
        self.shape().0
    }

    /// Where a pixel is: its byte's address, and the shift of its lowest bit.
    #[inline]
    fn place(&self, x: i32, y: i32) -> Option<(usize, u32, u32)> {
        let (row_bytes, bits) = self.shape();
        let per_byte = 8 / bits;
        let (x, row) = (x as u32, self.mode.height - 1 - y as u32);
        let offset = row / 8 * row_bytes + x / per_byte * 8 + row % 8 + self.scrolled;
        let size = self.mode.height / 8 * row_bytes;
        let offset = if offset >= size {
            offset - size
        } else {
            offset
        };
        let address = self.mode.himem + offset;
        (address < 0x8000).then_some((address as usize, per_byte - 1 - x % per_byte, per_byte))
    }

    /// The row, from the top, of a byte of the screen's memory.
    pub fn row_of(&self, address: u32) -> u32 {
        let (row_bytes, _) = self.shape();
        let size = self.mode.height / 8 * row_bytes;
        let offset = address.wrapping_sub(self.mode.himem) + size - self.scrolled;
        let offset = if offset >= size {
            offset - size
        } else {
            offset
        };
        (offset / row_bytes * 8 + offset % 8).min(self.mode.height - 1)
    }

    /// A pixel from the bottom left; inside the screen.
    pub fn read_pixel(&self, mem: &[u8], x: i32, y: i32) -> u8 {
        match self.mode.layout {
            Layout::Text => 0,
            Layout::Apart => {
                let row = self.mode.height as i32 - 1 - y;
                let at = row as usize * self.mode.width as usize + x as usize;
                self.pixels.get(at).copied().unwrap_or(0)
            }
            Layout::Memory => {
                let Some((address, shift, step)) = self.place(x, y) else {
                    return 0;
                };
                let byte = mem.get(address).copied().unwrap_or(0) >> shift;
                let bits = 8 / step;
                (0..bits).fold(0, |ink, i| ink | (byte >> (i * step) & 1) << i)
            }
        }
    }

    pub fn write_pixel(&mut self, mem: &mut [u8], x: i32, y: i32, ink: u8) {
        self.row = Some((self.mode.height as i32 - 1 - y).max(0) as u32);
        match self.mode.layout {
            Layout::Text => {}
            Layout::Apart => {
                let row = self.mode.height as i32 - 1 - y;
                let at = row as usize * self.mode.width as usize + x as usize;
                if let Some(p) = self.pixels.get_mut(at) {
                    *p = ink;
                }
            }
            Layout::Memory => {
                let Some((address, shift, step)) = self.place(x, y) else {
                    return;
                };
                let bits = 8 / step;
                let mut mask = 0;
                let mut value = 0;
                for i in 0..bits {
                    mask |= 1 << (shift + i * step);
                    value |= (ink >> i & 1) << (shift + i * step);
                }
                if let Some(byte) = mem.get_mut(address) {
                    *byte = *byte & !mask | value;
                }
            }
        }
    }

    /// A rectangle of one ink: left, bottom, right, top, inclusive, inside the screen.
    pub fn fill(&mut self, mem: &mut [u8], area: (i32, i32, i32, i32), ink: u8) {
        for y in area.1..=area.3 {
            for x in area.0..=area.2 {
                self.write_pixel(mem, x, y, ink);
            }
        }
    }

    /// The whole picture. A text mode has none: no pixels.
    pub fn screen(&self, mem: &[u8]) -> Screen {
        let m = &self.mode;
        let (w, h) = match m.layout {
            Layout::Text => (0, 0),
            _ => (m.width, m.height),
        };
        let pixels = (0..h as i32)
            .rev()
            .flat_map(|y| (0..w as i32).map(move |x| (x, y)))
            .map(|(x, y)| self.read_pixel(mem, x, y))
            .collect();
        Screen {
            width: w,
            height: h,
            pixels,
            palette: self.palette.clone(),
        }
    }
}
