//! The screen of a BBC Micro: the 6845's registers and the video ULA's, as far as pictures
//! need them (Bray, Dickens and Holmes, *The Advanced User Guide*, chapters 18 and 19).
//!
//! Where memory begins that is shown, how many bytes stand side by side and how many rows of
//! eight lines there are say the 6845's registers; how many pixels a byte has, the ULA's. An
//! ink is a pixel's bits; its colour is what the palette has for the pattern that the ULA sees
//! when a pixel comes out first of its byte.

use crate::Screen;

/// The registers of the 6845 that are read here: bytes side by side, rows of characters, lines
/// of one less one, and where the screen's memory begins, in eights, the high byte first.
const ACROSS: usize = 1;
const DOWN: usize = 6;
const LINES: usize = 9;
const START: usize = 12;

/// A mode as the operating system sets it up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mode {
    pub number: u8,
    /// Bits of a pixel.
    pub bits: u32,
    /// Where its memory begins; it ends at &8000.
    pub start: u16,
    /// The ULA's control register.
    control: u8,
}

pub(super) const MODES: [Mode; 5] = [
    mode(0, 1, 0x3000, 0x9C),
    mode(1, 2, 0x3000, 0xD8),
    mode(2, 4, 0x3000, 0xF4),
    mode(4, 1, 0x5800, 0x88),
    mode(5, 2, 0x5800, 0xC4),
];

const fn mode(number: u8, bits: u32, start: u16, control: u8) -> Mode {
    Mode {
        number,
        bits,
        start,
        control,
    }
}

/// The control register in MODE 7, whose characters come from elsewhere.
const TELETEXT: u8 = 0x4B;
/// The bit that says so.
const IS_TELETEXT: u8 = 2;

/// The registers.
#[derive(Clone, Debug)]
pub(super) struct Video {
    /// Which of the 6845's registers is written next.
    chosen: u8,
    shape: [u8; 18],
    control: u8,
    /// For each pattern of a byte's bits 7, 5, 3 and 1 a colour.
    palette: [u8; 16],
    /// The mode that the operating system entered last; none in MODE 7.
    entered: Option<Mode>,
}

impl Default for Video {
    fn default() -> Self {
        Video {
            chosen: 0,
            shape: [0; 18],
            control: TELETEXT,
            palette: [0; 16],
            entered: None,
        }
    }
}

impl Video {
    /// Writes a register of the hardware; false where none is there.
    pub fn write(&mut self, address: u16, value: u8) -> bool {
        match address {
            0xFE00 => self.chosen = value & 0x1F,
            0xFE01 => {
                if let Some(register) = self.shape.get_mut(usize::from(self.chosen)) {
                    *register = value;
                }
            }
            0xFE20 => self.control = value,
            0xFE21 => self.palette[usize::from(value >> 4)] = value & 7 ^ 7,
            _ => return false,
        }
        true
    }

    /// Sets the ULA's control register.
    pub fn set_control(&mut self, value: u8) {
        self.control = value;
    }

    /// What the operating system sets for a mode, or for MODE 7.
    pub fn enter(&mut self, mode: Option<Mode>) {
        self.entered = mode;
        let Some(mode) = mode else {
            self.control = TELETEXT;
            return;
        };
        self.control = mode.control;
        let bytes = (0x8000 - u32::from(mode.start)) / 256;
        let [low, high] = (mode.start / 8).to_le_bytes();
        (self.shape[ACROSS], self.shape[DOWN]) = (bytes as u8, 32);
        (self.shape[LINES], self.shape[START], self.shape[START + 1]) = (7, high, low);
        for ink in 0..1 << mode.bits {
            self.colour(
                ink,
                match mode.bits {
                    1 => [0, 7][usize::from(ink & 1)],
                    2 => [0, 1, 3, 7][usize::from(ink & 3)],
                    _ => ink & 7,
                },
            );
        }
    }

    /// Gives an ink of the mode that was entered a colour.
    pub fn colour(&mut self, ink: u8, colour: u8) {
        let Some(mode) = self.entered else {
            return;
        };
        for (pattern, own) in (0..).zip(&mut self.palette) {
            if ink_of(pattern, mode.bits) == ink {
                *own = colour & 7;
            }
        }
    }

    /// Whether pixels are shown, not text.
    pub fn is_graphic(&self) -> bool {
        self.control & IS_TELETEXT == 0
    }

    /// Bits of a pixel, where they are shown.
    fn bits(&self) -> Option<u32> {
        // Pixels of a line of 40 microseconds by the clock that reads bytes: 80 or 40.
        let pixels = 80 << (self.control >> 2 & 3);
        let bytes = if self.control & 0x10 != 0 { 80 } else { 40 };
        match pixels / bytes {
            _ if !self.is_graphic() => None,
            2 => Some(4),
            4 => Some(2),
            8 => Some(1),
            _ => None,
        }
    }

    fn start(&self) -> u16 {
        u16::from_be_bytes([self.shape[START], self.shape[START + 1]]) << 3
    }

    /// The line of a byte of memory.
    pub fn line(&self, address: u16) -> Option<u32> {
        self.bits()?;
        let at = u32::from(address.checked_sub(self.start())?);
        Some(at / (8 * u32::from(self.shape[ACROSS].max(1))) * 8 + at % 8)
    }

    /// The picture.
    pub fn screen(&self, ram: &[u8]) -> Option<Screen> {
        let bits = self.bits()?;
        let pixels = 8 / bits;
        let (across, down) = (u32::from(self.shape[ACROSS]), u32::from(self.shape[DOWN]));
        if self.shape[LINES] != 7 {
            return None;
        }
        let (width, height) = (across * pixels, down * 8);
        let ink = |x: u32, y: u32| {
            let at = y / 8 * across * 8 + x / pixels * 8 + y % 8;
            let byte = ram.get(usize::from(self.start()) + at as usize);
            // The ULA shifts a byte's pixels out, the left one first.
            let shifted = byte.copied().unwrap_or(0) << (x % pixels);
            let bit = |k: u32| shifted >> (7 - k * pixels) & 1;
            (0..bits).fold(0, |ink, k| ink << 1 | bit(k))
        };
        let rows = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let rgb = |c: u8| [1, 2, 4].map(|bit| if c & bit == 0 { 0 } else { 255 });
        let colour = |ink: u8| {
            let mut patterns = (0..16).filter(|p| ink_of(*p, bits) == ink);
            rgb(patterns.next().map_or(0, |p| self.palette[usize::from(p)]))
        };
        Some(Screen {
            width,
            height,
            pixels: rows.map(|(x, y)| ink(x, y)).collect(),
            palette: (0..1 << bits).map(colour).collect(),
        })
    }
}

/// The ink that a pattern of a byte's bits 7, 5, 3 and 1 is: of two inks the first bit tells, of
/// four the first and the third.
fn ink_of(pattern: u8, bits: u32) -> u8 {
    match bits {
        1 => pattern >> 3,
        2 => pattern >> 3 << 1 | pattern >> 1 & 1,
        _ => pattern,
    }
}
