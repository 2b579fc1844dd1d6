//! The screen: modes, palette, the VDU queue, and reading the picture.
//!
//! On the Micro the picture is in the 64K of memory, so pokes draw. A byte holds eight pixels
//! of one bit, four of two or two of four; the bits of pixel j lie at j, j + n, ... from the
//! top, n being the pixels in a byte. Text is not drawn (there is no font here): it is
//! captured by the machine instead.

use super::Dialect;
use super::modes::{Layout, Mode, find, first, palette, physical};
use crate::Screen;

/// Bytes that follow each VDU code below 32.
const QUEUE: [u8; 32] = [
    0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 5, 0, 0, 1, 9, 8, 5, 0, 0, 4, 4, 0, 2,
];

pub(crate) struct Display {
    dialect: Dialect,
    pub mode: Mode,
    pub palette: Vec<[u8; 3]>,
    /// The pixels of a mode whose screen is not in memory.
    pub pixels: Vec<u8>,
    pub action: u8,
    pub ink: u8,
    pub paper_action: u8,
    pub paper: u8,
    /// The origin, in graphics units.
    pub origin: (i32, i32),
    /// The graphics cursor and the two points before it, in graphics units from the corner.
    pub points: [(i32, i32); 3],
    /// The graphics window in pixels from the bottom left: left, bottom, right, top, inclusive.
    pub window: (i32, i32, i32, i32),
    /// Row of the last point drawn or byte poked, from the top.
    pub row: Option<u32>,
    queue: Vec<u8>,
    x: u32,
    y: u32,
}

impl Display {
    pub fn new(dialect: Dialect) -> Self {
        let mut display = Self {
            dialect,
            mode: *first(dialect),
            palette: Vec::new(),
            pixels: Vec::new(),
            action: 0,
            ink: 0,
            paper_action: 0,
            paper: 0,
            origin: (0, 0),
            points: [(0, 0); 3],
            window: (0, 0, 0, 0),
            row: None,
            queue: Vec::new(),
            x: 0,
            y: 0,
        };
        display.reset();
        display
    }

    pub fn dialect(&self) -> Dialect {
        self.dialect
    }

    /// Everything as a mode change leaves it.
    fn reset(&mut self) {
        let m = self.mode;
        self.palette = palette(m.inks);
        self.pixels = match m.layout {
            Layout::Apart => vec![0; (m.width * m.height) as usize],
            _ => Vec::new(),
        };
        self.action = 0;
        self.paper_action = 0;
        self.ink = self.top_ink().min(7);
        self.paper = 0;
        self.origin = (0, 0);
        self.points = [(0, 0); 3];
        self.window = (0, 0, m.width as i32 - 1, m.height as i32 - 1);
        self.x = 0;
        self.y = 0;
    }

    pub fn top_ink(&self) -> u8 {
        (self.mode.inks - 1) as u8
    }

    pub fn himem(&self) -> u32 {
        self.mode.himem
    }

    pub fn himem_of(&self, mode: u8) -> Option<u32> {
        find(self.dialect, mode).map(|m| m.himem)
    }

    pub fn set_mode(&mut self, mem: &mut [u8], mode: u8) {
        if let Some(m) = find(self.dialect, mode) {
            self.mode = *m;
            self.reset();
            if m.layout != Layout::Apart
                && let Some(screen) = mem.get_mut(m.himem as usize..0x8000)
            {
                screen.fill(if m.number == 7 { 32 } else { 0 });
            }
        }
    }

    /// The text cursor: column and row.
    pub fn cursor(&self) -> (u32, u32) {
        (self.x, self.y)
    }

    pub fn last_row(&self) -> Option<u32> {
        self.row
    }

    /// Whether an address is in the memory that the screen shows.
    pub fn is_shown(&self, address: u32) -> bool {
        self.mode.layout == Layout::Memory && (self.mode.himem..0x8000).contains(&address)
    }

    /// A byte of screen memory was written.
    pub fn note_poke(&mut self, address: u32) {
        if self.mode.layout == Layout::Memory {
            let (row_bytes, _) = self.shape();
            let offset = address.wrapping_sub(self.mode.himem);
            self.row = Some((offset / row_bytes * 8 + offset % 8).min(self.mode.height - 1));
        }
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

    /// In the middle of a VDU command?
    pub fn is_waiting(&self) -> bool {
        !self.queue.is_empty()
    }

    /// One byte to the queue. Answers a command when it is complete.
    pub fn take(&mut self, byte: u8) -> Option<Vec<u8>> {
        self.queue.push(byte);
        let code = *self.queue.first()?;
        let wanted = 1 + usize::from(QUEUE.get(usize::from(code)).copied().unwrap_or(0));
        if self.queue.len() < wanted {
            return None;
        }
        Some(std::mem::take(&mut self.queue))
    }

    /// Carries out a complete command other than MODE and PLOT.
    pub fn command(&mut self, mem: &mut [u8], command: &[u8]) {
        let word = |a: u8, b: u8| i32::from(i16::from_le_bytes([a, b]));
        match *command {
            [8] => self.x = self.x.saturating_sub(1),
            [9] => self.forward(),
            [10] => self.y = (self.y + 1).min(u32::from(self.mode.rows) - 1),
            [11] => self.y = self.y.saturating_sub(1),
            [12] => {
                self.clear(
                    mem,
                    (
                        0,
                        0,
                        self.mode.width as i32 - 1,
                        self.mode.height as i32 - 1,
                    ),
                    0,
                );
                (self.x, self.y) = (0, 0);
            }
            [13] => self.x = 0,
            [16] => self.clear(mem, self.window, self.paper),
            [18, action, ink] => self.gcol(action, ink),
            [19, ink, colour, r, g, b] => self.define(ink, colour, [r, g, b]),
            [20] => {
                self.palette = palette(self.mode.inks);
                self.ink = self.top_ink().min(7);
                self.paper = 0;
            }
            [24, a, b, c, d, e, f, g, h] => {
                self.set_window(word(a, b), word(c, d), word(e, f), word(g, h));
            }
            [26] => {
                self.window = (
                    0,
                    0,
                    self.mode.width as i32 - 1,
                    self.mode.height as i32 - 1,
                );
                self.origin = (0, 0);
                self.points = [(0, 0); 3];
                (self.x, self.y) = (0, 0);
            }
            [29, a, b, c, d] => self.origin = (word(a, b), word(c, d)),
            [30] => (self.x, self.y) = (0, 0),
            [31, x, y] if x < self.mode.columns && y < self.mode.rows => {
                (self.x, self.y) = (u32::from(x), u32::from(y));
            }
            [c] if c >= 32 && c != 127 => self.forward(),
            _ => {}
        }
    }

    fn forward(&mut self) {
        self.x += 1;
        if self.x >= u32::from(self.mode.columns) {
            self.x = 0;
            self.y = (self.y + 1).min(u32::from(self.mode.rows) - 1);
        }
    }

    /// VDU 19: a logical ink gets a physical colour (16 and more: the red, green, blue given).
    fn define(&mut self, ink: u8, colour: u8, rgb: [u8; 3]) {
        let ink = usize::from(ink & self.top_ink());
        let value = if colour < 16 { physical(colour) } else { rgb };
        if let Some(entry) = self.palette.get_mut(ink) {
            *entry = value;
        }
    }

    /// GCOL: inks of 128 and more are the background's.
    pub fn gcol(&mut self, action: u8, ink: u8) {
        if ink < 128 {
            self.action = action;
            self.ink = ink & self.top_ink();
        } else {
            self.paper_action = action;
            self.paper = ink & self.top_ink();
        }
    }

    fn set_window(&mut self, left: i32, bottom: i32, right: i32, top: i32) {
        let (l, b) = self.to_pixel(left + self.origin.0, bottom + self.origin.1);
        let (r, t) = self.to_pixel(right + self.origin.0, top + self.origin.1);
        let (w, h) = (self.mode.width as i32, self.mode.height as i32);
        // A window that does not fit the screen is ignored, as in the machine.
        if l >= 0 && b >= 0 && r < w && t < h && l < r && b < t {
            self.window = (l, b, r, t);
        }
    }

    fn clear(&mut self, mem: &mut [u8], area: (i32, i32, i32, i32), ink: u8) {
        for y in area.1..=area.3 {
            for x in area.0..=area.2 {
                self.write_pixel(mem, x, y, ink);
            }
        }
    }

    /// Graphics units (1280 by 1024, y up) to pixels from the bottom left, rounding down.
    #[inline]
    pub fn to_pixel(&self, x: i32, y: i32) -> (i32, i32) {
        let m = &self.mode;
        if m.layout == Layout::Apart && m.height == 240 {
            // 1024 units over 240 rows.
            return (
                x.div_euclid((1280 / m.width.max(1)).max(1) as i32),
                (y * 15).div_euclid(64),
            );
        }
        (
            (x * m.width as i32).div_euclid(1280),
            (y * m.height as i32).div_euclid(1024),
        )
    }

    /// Where a pixel is: its byte's address, and the shift of its lowest bit.
    #[inline]
    fn place(&self, x: i32, y: i32) -> Option<(usize, u32, u32)> {
        let (row_bytes, bits) = self.shape();
        let per_byte = 8 / bits;
        let (x, row) = (x as u32, self.mode.height - 1 - y as u32);
        let address = self.mode.himem + row / 8 * row_bytes + x / per_byte * 8 + row % 8;
        (address < 0x8000).then_some((address as usize, per_byte - 1 - x % per_byte, per_byte))
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
