//! A 6502 with 64K of RAM and a page of ports: the least machine that can show a picture.
//!
//! A program is entered at its first byte with A, X and Y 0, the stack empty,
//! interrupts masked and decimal mode off; memory is 0 but for the program.
//! Every address is RAM. The ports are the addresses of the page $FF00 that also
//! do something when they are stored to (reading gives the byte last stored):
//!
//! | address | name | storing to it |
//! |---|---|---|
//! | $FF00, $FF01 | WIDTH | the picture's width, 1 to 4096, low byte first |
//! | $FF02, $FF03 | HEIGHT | its height, 1 to 4096 |
//! | $FF04 | INKS | the number of inks, 2 to 255 (0 means 256); **opens the picture**: all pixels ink 0, position (0, 0) |
//! | $FF05, $FF06 | X | column of the next pixel |
//! | $FF07, $FF08 | Y | row of the next pixel, from the top |
//! | $FF09 | INK | the pixel's ink; then X + 1, and at the row's end X = 0, Y + 1 |
//! | $FF0A | EXIT | ends the program: 0 is success, another status a fault with that number |
//! | $FF0B | PALETTE | red, green and blue of ink 0, then of ink 1, and so on |
//! | $FF0C | HANDS | **the picture is done**: what a player holds then is to be read at $FF0D, left 1, right 2, up 4, down 8 and fire 16 |
//!
//! X and Y follow the position: they can be read back. Inks that are not told
//! are greys from black to white. Every access is a cycle, as on every 6502;
//! the ports cost nothing more. Indexed stores to the ports are as good as
//! absolute ones; a read-modify-write stores twice.
//!
//! What ends a run with a fault: an ink outside the picture or not below INKS, a
//! size out of range, a second picture, an opcode that jams, and `brk` while the vector at $FFFE
//! holds 0 (running into empty memory, mostly).

use super::computer::{Board, Computer, fault};
use super::cpu::Bus;
use crate::keys::{Key, Keyboard, Seen};
use crate::{Screen, Stop};

/// The ports' addresses.
pub mod port {
    /// Width of the picture, low byte.
    pub const WIDTH: u16 = 0xFF00;
    /// Height of the picture, low byte.
    pub const HEIGHT: u16 = 0xFF02;
    /// Number of inks; opens the picture.
    pub const INKS: u16 = 0xFF04;
    /// Column of the next pixel, low byte.
    pub const X: u16 = 0xFF05;
    /// Row of the next pixel, low byte.
    pub const Y: u16 = 0xFF07;
    /// Ink of the pixel at X, Y.
    pub const INK: u16 = 0xFF09;
    /// Ends the program.
    pub const EXIT: u16 = 0xFF0A;
    /// The palette, a byte at a time.
    pub const PALETTE: u16 = 0xFF0B;
    /// A picture is done, and the next may hang on what is held.
    pub const HANDS: u16 = 0xFF0C;
    /// What is held, once that was asked for.
    pub const HELD: u16 = 0xFF0D;
}

/// Cycles of a frame, where keys come by frames: a fiftieth of a second at 2 MHz.
const FRAME: u64 = 40_000;

/// The greatest width and height.
const SIDE: u16 = 4096;

/// The machine.
pub type Plain = Computer<Ports>;

/// The memory and its ports.
#[derive(Clone, Debug)]
pub struct Ports {
    ram: Box<[u8; 0x1_0000]>,
    cycles: u64,
    plots: u64,
    screen: Option<Screen>,
    inks: u16,
    palette_bytes: usize,
    row: Option<u32>,
    keyboard: Option<Box<Keyboard>>,
    /// Set where the program has ended, by itself or by a fault at a port.
    stop: Option<Stop>,
}

impl Bus for Ports {
    #[inline(always)]
    fn read(&mut self, address: u16) -> u8 {
        self.cycles += 1;
        self.ram[usize::from(address)]
    }

    #[inline(always)]
    fn write(&mut self, address: u16, value: u8) {
        self.cycles += 1;
        self.ram[usize::from(address)] = value;
        if address >= port::WIDTH {
            self.port(address, value);
        }
    }
}

impl Ports {
    fn word(&self, at: u16) -> u16 {
        let [lo, hi] = [at, at.wrapping_add(1)].map(|a| self.ram[usize::from(a)]);
        u16::from_le_bytes([lo, hi])
    }

    fn set_word(&mut self, at: u16, value: u16) {
        let [lo, hi] = value.to_le_bytes();
        self.ram[usize::from(at)] = lo;
        self.ram[usize::from(at.wrapping_add(1))] = hi;
    }

    #[cold]
    fn port(&mut self, address: u16, value: u8) {
        match address {
            port::INKS => self.open(value),
            port::INK => self.plot(value),
            port::PALETTE => self.palette(value),
            port::HANDS => self.look(),
            port::EXIT if value == 0 => {
                self.stop.get_or_insert(Stop::Ended);
            }
            port::EXIT => self.fail(format!("the program ended with status {value}")),
            _ => {}
        }
    }

    /// Looks at what is held; nothing is where there is no keyboard.
    fn look(&mut self) {
        let Some(mut keyboard) = self.keyboard.take() else {
            self.ram[usize::from(port::HELD)] = 0;
            return;
        };
        keyboard.remember(self.cycles, || {
            self.ram.iter().map(|byte| i16::from(*byte)).collect()
        });
        let held = match keyboard.look(self.cycles / FRAME, || self.screen.clone()) {
            Seen::Key(Key::Left) => 1,
            Seen::Key(Key::Right) => 2,
            Seen::Key(Key::Up) => 4,
            Seen::Key(Key::Down) => 8,
            Seen::Key(Key::Char(b' ')) => 16,
            Seen::Key(_) | Seen::Nothing => 0,
            Seen::Quit => {
                self.stop.get_or_insert(Stop::Ended);
                0
            }
        };
        self.ram[usize::from(port::HELD)] = held;
        self.keyboard = Some(keyboard);
    }

    fn open(&mut self, inks: u8) {
        if self.screen.is_some() {
            return self.fail("the picture is opened twice".to_owned());
        }
        let (width, height) = (self.word(port::WIDTH), self.word(port::HEIGHT));
        self.inks = if inks == 0 { 256 } else { u16::from(inks) };
        if width == 0 || width > SIDE || height == 0 || height > SIDE || self.inks < 2 {
            let inks = self.inks;
            self.fail(format!(
                "no picture of {width} x {height} pixels in {inks} inks: 1 to {SIDE} a side and 2 to 256 inks"
            ));
            return;
        }
        let white = u32::from(self.inks) - 1;
        let grey = |ink: u32| [u8::try_from(ink * 255 / white).unwrap_or(255); 3];
        self.screen = Some(Screen {
            width: u32::from(width),
            height: u32::from(height),
            pixels: vec![0; usize::from(width) * usize::from(height)],
            palette: (0..=white).map(grey).collect(),
        });
        self.set_word(port::X, 0);
        self.set_word(port::Y, 0);
    }

    fn plot(&mut self, ink: u8) {
        let (x, y) = (self.word(port::X), self.word(port::Y));
        let Some(screen) = &mut self.screen else {
            return self.fail("an ink is stored before the picture is opened".to_owned());
        };
        let (column, row) = (u32::from(x), u32::from(y));
        let at = (row * screen.width + column) as usize;
        match screen.pixels.get_mut(at) {
            Some(pixel) if column < screen.width && u16::from(ink) < self.inks => *pixel = ink,
            Some(_) if column < screen.width => {
                let inks = self.inks;
                return self.fail(format!(
                    "ink {ink} at ({x}, {y}), but there are {inks} inks"
                ));
            }
            _ => return self.fail(format!("an ink at ({x}, {y}), outside the picture")),
        }
        self.plots += 1;
        self.row = Some(row);
        if column + 1 < screen.width {
            self.set_word(port::X, x + 1);
        } else {
            self.set_word(port::X, 0);
            self.set_word(port::Y, y + 1);
        }
    }

    fn palette(&mut self, value: u8) {
        let at = self.palette_bytes;
        let Some(screen) = &mut self.screen else {
            return self.fail("a colour is stored before the picture is opened".to_owned());
        };
        match screen
            .palette
            .get_mut(at / 3)
            .and_then(|colour| colour.get_mut(at % 3))
        {
            Some(part) => *part = value,
            None => return self.fail("more colours than inks".to_owned()),
        }
        self.palette_bytes += 1;
    }
}

impl Default for Ports {
    fn default() -> Self {
        Ports {
            ram: Box::new([0; 0x1_0000]),
            cycles: 0,
            plots: 0,
            screen: None,
            inks: 0,
            palette_bytes: 0,
            row: None,
            keyboard: None,
            stop: None,
        }
    }
}

impl Board for Ports {
    const DRAWS_APART: bool = true;

    fn peek(&self, address: u16) -> u8 {
        self.ram[usize::from(address)]
    }

    fn poke(&mut self, address: u16, value: u8) {
        self.ram[usize::from(address)] = value;
    }

    fn room(&self) -> (u16, &'static str) {
        (port::WIDTH, "the ports")
    }

    #[inline(always)]
    fn cycles(&self) -> u64 {
        self.cycles
    }

    #[inline(always)]
    fn stop(&self) -> Option<&Stop> {
        self.stop.as_ref()
    }

    fn fail(&mut self, message: String) {
        self.stop.get_or_insert(Stop::Fault(fault(message)));
    }

    fn row(&self) -> Option<u32> {
        self.row
    }

    fn plots(&self) -> u64 {
        self.plots
    }

    fn screen(&self) -> Option<Screen> {
        self.screen.clone()
    }

    fn plug(&mut self, keyboard: Keyboard) -> bool {
        self.keyboard = Some(Box::new(keyboard));
        true
    }

    fn unplug(&mut self) -> Option<Keyboard> {
        self.keyboard.take().map(|keyboard| *keyboard)
    }
}

#[cfg(test)]
mod tests;
