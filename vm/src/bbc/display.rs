//! The screen: modes, palette, the VDU queue and what its commands do.
//!
//! On the Micro the picture is in the 64K of memory, so pokes draw. A byte holds eight pixels
//! of one bit, four of two or two of four; the bits of pixel j lie at j, j + n, ... from the
//! top, n being the pixels in a byte.

use super::Dialect;
use super::modes::{Layout, Mode, find, first, palette, physical};
use super::pixels::{Pen, Point};
use super::text::{Text, UPPER};

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
    /// Bytes from HIMEM to the screen's first, on from which it goes round.
    pub scrolled: u32,
    pub ink: Pen,
    pub paper: Pen,
    /// The origin, in graphics units.
    pub origin: Point,
    /// The graphics cursor and the place before it, in pixels from the bottom left.
    pub cursor: Point,
    pub before: Point,
    /// What relative coordinates are added to, in graphics units from the origin.
    pub place: Point,
    /// The graphics window in pixels from the bottom left: left, bottom, right, top, inclusive.
    pub window: (i32, i32, i32, i32),
    pub text: Text,
    /// Groups of characters whose shapes programs have defined.
    pub shaped: u8,
    /// Row of the last point drawn or byte poked, from the top.
    pub row: Option<u32>,
    queue: Vec<u8>,
}

impl Display {
    pub fn new(dialect: Dialect) -> Self {
        let mut display = Self {
            dialect,
            mode: *first(dialect),
            palette: Vec::new(),
            pixels: Vec::new(),
            scrolled: 0,
            ink: Pen::NOTHING,
            paper: Pen::NOTHING,
            origin: (0, 0),
            cursor: (0, 0),
            before: (0, 0),
            place: (0, 0),
            window: (0, 0, 0, 0),
            text: Text::default(),
            shaped: UPPER,
            row: None,
            queue: Vec::new(),
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
        self.pixels = match m.layout {
            Layout::Apart => vec![0; (m.width * m.height) as usize],
            _ => Vec::new(),
        };
        self.scrolled = 0;
        self.text.graphics = false;
        self.default_colours();
        self.default_windows();
    }

    /// VDU 20.
    fn default_colours(&mut self) {
        self.palette = palette(self.mode.inks);
        let ink = self.top_ink().min(7);
        (self.ink, self.paper) = (Pen::setting(ink), Pen::setting(0));
        (self.text.ink, self.text.paper) = (ink, 0);
    }

    /// VDU 26.
    fn default_windows(&mut self) {
        let m = self.mode;
        self.window = (0, 0, m.width as i32 - 1, m.height as i32 - 1);
        self.origin = (0, 0);
        (self.cursor, self.before, self.place) = ((0, 0), (0, 0), (0, 0));
        let (columns, rows) = (i32::from(m.columns), i32::from(m.rows));
        self.text.window = (0, rows - 1, columns - 1, 0);
        self.text.windowed = false;
        self.text.at = (0, 0);
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

    /// The text cursor in its window: column and row.
    pub fn cursor(&self) -> (u32, u32) {
        let (x, y) = self.text.at;
        let (left, _, _, top) = self.text.window;
        ((x - left).unsigned_abs(), (y - top).unsigned_abs())
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
            self.row = Some(self.row_of(address));
        }
    }

    /// Is a byte no text: in the middle of a VDU command, drawn at the graphics cursor, or
    /// unseen with the screen off?
    pub fn is_waiting(&self) -> bool {
        !self.queue.is_empty() || self.text.graphics || self.text.off
    }

    /// One byte to the queue. Answers a command when it is complete.
    pub fn take(&mut self, byte: u8) -> Option<Vec<u8>> {
        self.queue.push(byte);
        let code = *self.queue.first()?;
        let wanted = 1 + usize::from(QUEUE.get(usize::from(code)).copied().unwrap_or(0));
        if self.queue.len() < wanted {
            return None;
        }
        let command = std::mem::take(&mut self.queue);
        if self.text.off && command != [6] {
            return None;
        }
        Some(command)
    }

    /// Carries out a complete command other than MODE and PLOT.
    pub fn command(&mut self, mem: &mut [u8], command: &[u8]) {
        let word = |a: u8, b: u8| i32::from(i16::from_le_bytes([a, b]));
        match *command {
            [4] => self.text.graphics = false,
            [5] => self.text.graphics = self.mode.layout == Layout::Memory,
            [6] => self.text.off = false,
            [8] => self.backward(mem),
            [9] => self.forward(mem),
            [10] => self.down(mem),
            [11] => self.up(mem),
            [12] => self.clear_text(mem),
            [13] => self.carriage_return(),
            [16] => self.clear_window(mem),
            [17, ink] => self.colour(ink),
            [18, action, ink] => self.gcol(action, ink),
            [19, ink, colour, r, g, b] => self.define(ink, colour, [r, g, b]),
            [20] => self.default_colours(),
            [21] => self.text.off = true,
            [23, c, a, b, d, e, f, g, h, i] if c >= 32 => {
                self.define_shape(mem, c, [a, b, d, e, f, g, h, i]);
            }
            [24, a, b, c, d, e, f, g, h] => {
                self.set_window([word(a, b), word(c, d), word(e, f), word(g, h)]);
            }
            [26] => self.default_windows(),
            [28, left, bottom, right, top] => self.set_text_window([left, bottom, right, top]),
            [29, a, b, c, d] => self.set_origin((word(a, b), word(c, d))),
            [30] => self.home(),
            [31, x, y] => self.tab(x, y),
            [127] => self.delete(mem),
            [c] if c >= 32 => self.character(mem, c),
            _ => {}
        }
    }

    /// VDU 19: a logical ink gets a physical colour (16 and more: the red, green, blue given).
    fn define(&mut self, ink: u8, colour: u8, rgb: [u8; 3]) {
        let ink = usize::from(ink & self.top_ink());
        let value = match colour {
            _ if self.dialect == Dialect::Micro => physical(colour & 15),
            0..16 => physical(colour),
            _ => rgb,
        };
        if let Some(entry) = self.palette.get_mut(ink) {
            *entry = value;
        }
    }

    /// COLOUR, as GCOL.
    fn colour(&mut self, ink: u8) {
        let top = self.top_ink();
        let which = match ink < 128 {
            true => &mut self.text.ink,
            false => &mut self.text.paper,
        };
        *which = ink & top;
    }

    /// GCOL: inks of 128 and more are the background's.
    pub fn gcol(&mut self, action: u8, ink: u8) {
        let pen = Pen {
            action,
            ink: ink & self.top_ink(),
        };
        match ink < 128 {
            _ if self.text.off => {}
            true => self.ink = pen,
            false => self.paper = pen,
        }
    }

    /// Graphics units (1280 by 1024, y up) to pixels from the bottom left, rounding down.
    #[inline]
    pub fn to_pixel(&self, x: i32, y: i32) -> Point {
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
}
