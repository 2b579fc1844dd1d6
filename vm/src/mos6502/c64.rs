//! A Commodore 64 (PAL) as programs see it that draw a bitmap: 64K of RAM, the
//! processor's port that lays ROMs and hardware over it, and the video chip's bitmaps.
//!
//! A program that is loaded to $0801 begins with a line of BASIC, `SYS` and an
//! address, and is entered there as `RUN` does; any other is entered where it is loaded, or
//! where it is told ([`super::Machine::load_at`]).
//! The ROMs are not bundled. Where they lie over the RAM, what is read there ends the
//! run with a fault, and so does what is called, but for CHROUT ($FFD2), which prints,
//! CINT ($FF81), and the return to BASIC, which **ends** the program. So does a look at
//! the keyboard ($DC01) where there is none: nobody presses a key, unless [`C64::press`]
//! says so. With a keyboard ([`keyboard`]), $DC01 reads the matrix as $DC00 selects it,
//! $DC00 a joystick in port 2 where the program has stored ones to it, and GETIN ($FFE4), CHRIN ($FFCF) and SCNKEY ($FF9F, which has nothing to do) are there.
//!
//! # Cycles
//! Of the PAL machine's 985,248 Hz, 63 to a line, 312 lines to a picture. The video
//! chip reads a row of characters' colours in the first of its eight lines, 25 a picture:
//! there the processor waits at the first thing that it reads from cycle 12 on, to
//! cycle 55, so 40 to 43 cycles are lost, and what it stores meanwhile is not late. That
//! is counted cycle by cycle; a program begins at the top of a picture. Interrupts are
//! not counted: where they are masked there are none.
//!
//! Source: Christian Bauer, "The MOS 6567/6569 video controller (VIC-II) and its
//! application in the Commodore 64" (1996).

mod keyboard;

use super::computer::{Board, Computer, fault, return_from};
use super::cpu::{Bus, Cpu};
use crate::keys::Keyboard;
use crate::{Fault, Screen, Stop};
use keyboard::Keys;
use slowlight_isa::c64::COLOURS;

/// The machine.
pub type C64 = Computer<Circuits>;

/// Cycles of a line and of a picture.
const LINE: u64 = 63;
const FRAME: u64 = LINE * 312;
/// The first line in which the processor waits, how many there are, and how far apart.
const FIRST: u64 = 51;
const ROWS: u64 = 25;
const APART: u64 = 8 * LINE;
/// From which cycle of it on it waits (counted from 0), and how long at most.
const FROM: u64 = 11;
const WAITS: u64 = 43;
/// Rows of a bitmap, and bytes of a row of its characters.
const HEIGHT: u32 = 200;
const ROW_BYTES: u32 = 320;
/// Where BASIC's programs begin.
const BASIC: u16 = 0x0801;
/// BASIC's number for SYS.
const SYS: u8 = 0x9E;
/// Where a program returns to: BASIC's ROM.
const RETURN: u16 = 0xA000;

/// What a page shows the processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Page {
    Ram,
    Rom,
    Hardware,
}

/// The memory and what lies over it.
#[derive(Clone, Debug)]
pub struct Circuits {
    ram: Box<[u8; 0x1_0000]>,
    /// What was stored to $D000 to $DFFF while the hardware is there.
    hardware: Box<[u8; 0x1000]>,
    pages: [Page; 256],
    cycles: u64,
    /// When the processor has to wait next.
    wait: u64,
    text: Vec<u8>,
    /// Where a byte was stored last, if that may be the bitmap.
    last: u16,
    pressed: bool,
    keys: Option<Box<Keys>>,
    stop: Option<Stop>,
}

impl Default for Circuits {
    fn default() -> Self {
        let mut circuits = Circuits {
            ram: Box::new([0; 0x1_0000]),
            hardware: Box::new([0; 0x1000]),
            pages: [Page::Ram; 256],
            cycles: 0,
            wait: FIRST * LINE + FROM,
            text: Vec::new(),
            last: 0,
            pressed: false,
            keys: None,
            stop: None,
        };
        // As the machine starts: all ROMs, and a screen of text.
        circuits.ram[1] = 0x37;
        circuits.lay();
        for (register, value) in [(0xD011, 0x1B), (0xD016, 0xC8), (0xD018, 0x15), (0xDD00, 3)] {
            circuits.hardware[register - 0xD000] = value;
        }
        circuits
    }
}

impl Bus for Circuits {
    #[inline(always)]
    fn read(&mut self, address: u16) -> u8 {
        if self.cycles >= self.wait {
            self.waits();
        }
        self.cycles += 1;
        if self.pages[usize::from(address >> 8)] != Page::Ram {
            return self.behind(address);
        }
        self.ram[usize::from(address)]
    }

    #[inline(always)]
    fn write(&mut self, address: u16, value: u8) {
        self.cycles += 1;
        if self.pages[usize::from(address >> 8)] == Page::Hardware {
            self.hardware[usize::from(address & 0xFFF)] = value;
            return;
        }
        self.ram[usize::from(address)] = value;
        if address < 2 {
            self.lay();
        } else if address >= 0x2000 {
            self.last = address;
        }
    }
}

impl Circuits {
    /// The processor wants to read while, or after, the video chip does.
    #[cold]
    fn waits(&mut self) {
        let shown = self.register(0xD011) & 0x10 != 0;
        if shown && self.cycles < self.wait + WAITS {
            self.cycles = self.wait + WAITS;
        }
        while self.wait <= self.cycles {
            let row = (self.wait % FRAME / LINE - FIRST) / 8 + 1;
            self.wait += match row {
                ROWS => FRAME - (ROWS - 1) * APART,
                _ => APART,
            };
        }
    }

    /// What is read where something lies over the RAM.
    #[cold]
    fn behind(&mut self, address: u16) -> u8 {
        if self.pages[usize::from(address >> 8)] == Page::Rom {
            self.absent("reads", address);
            return 0;
        }
        match address {
            0xDC00 if self.keys.is_some() && self.register(address) & 31 == 31 => self.stick(),
            0xDC01 if self.keys.is_some() => self.rows(),
            0xDC01 if self.pressed => 0xFE,
            0xDC01 => {
                self.stop.get_or_insert(Stop::Ended);
                0xFF
            }
            0xD800..=0xDBFF => self.register(address) & 15,
            _ => self.register(address),
        }
    }

    fn register(&self, address: u16) -> u8 {
        self.hardware[usize::from(address & 0xFFF)]
    }

    fn absent(&mut self, does: &str, address: u16) {
        self.fail(format!(
            "the program {does} ${address:04X}, in a ROM: of those only CHROUT, CINT and the \
             return to BASIC are bundled"
        ));
    }

    /// Lays over the RAM what the processor's port says.
    fn lay(&mut self) {
        let bits = self.ram[1];
        let (basic, kernal) = (bits & 3 == 3, bits & 2 != 0);
        let over = match (bits & 3, bits & 4) {
            (0, _) => Page::Ram,
            (_, 0) => Page::Rom,
            _ => Page::Hardware,
        };
        let rom = |is: bool| if is { Page::Rom } else { Page::Ram };
        self.pages[0xA0..0xC0].fill(rom(basic));
        self.pages[0xD0..0xE0].fill(over);
        self.pages[0xE0..].fill(rom(kernal));
    }

    /// Does what a ROM would do at the processor's address.
    #[cold]
    fn call(&mut self, cpu: &mut Cpu) {
        match cpu.pc {
            0xFFD2 => self.text.push(match cpu.a {
                13 => b'\n',
                letter => letter.to_ascii_lowercase(),
            }),
            // All registers of the video chip, as they are at a start.
            0xFF81 => {
                self.hardware[0x11] = 0x1B;
                self.hardware[0x16] = 0xC8;
                self.hardware[0x18] = 0x15;
            }
            0xFFE4 if self.keys.is_some() => self.get(cpu),
            0xFFCF if self.keys.is_some() => self.next_of_line(cpu),
            0xFF9F if self.keys.is_some() => {}
            RETURN => return self.end(),
            at => self.absent("calls", at),
        }
        return_from(cpu, &self.ram);
    }

    fn end(&mut self) {
        let said = String::from_utf8_lossy(&self.text).trim().to_owned();
        self.stop.get_or_insert(match said.is_empty() {
            true => Stop::Ended,
            false => Stop::Fault(fault(said)),
        });
    }

    /// Where the video chip's memory begins that it is told to look at.
    fn bank(&self) -> usize {
        usize::from(3 - (self.register(0xDD00) & 3)) << 14
    }

    fn bitmap(&self) -> usize {
        self.bank() + (usize::from(self.register(0xD018) & 8) << 10)
    }

    /// The colours of a character's inks.
    fn colours(&self, many: bool, cell: usize) -> Vec<u8> {
        let matrix = self.bank() + (usize::from(self.register(0xD018) >> 4) << 10);
        let pair = self.ram[matrix + cell];
        match many {
            false => vec![pair & 15, pair >> 4],
            true => vec![
                self.register(0xD021) & 15,
                pair >> 4,
                pair & 15,
                self.hardware[0x800 + cell] & 15,
            ],
        }
    }
}

impl Board for Circuits {
    fn peek(&self, address: u16) -> u8 {
        self.ram[usize::from(address)]
    }

    fn poke(&mut self, address: u16, value: u8) {
        self.ram[usize::from(address)] = value;
    }

    fn room(&self) -> (u16, &'static str) {
        (0xD000, "the circuits")
    }

    fn ready(&mut self) {
        // Where an empty stack returns to.
        let [lo, hi] = (RETURN - 1).to_le_bytes();
        self.ram[0x100..0x102].copy_from_slice(&[lo, hi]);
    }

    fn entry(&self, loaded: u16) -> Result<u16, Fault> {
        if loaded != BASIC {
            return Ok(loaded);
        }
        let said: String = self.ram[usize::from(BASIC) + 4..]
            .iter()
            .take_while(|c| **c != 0)
            .filter(|c| **c != b' ')
            .map(|c| char::from(*c))
            .collect();
        let number = said.strip_prefix(char::from(SYS)).unwrap_or_default();
        number.parse().map_err(|_| {
            fault("a program at $0801 begins with a line of BASIC like 10 SYS 2061".to_owned())
        })
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

    #[inline(always)]
    fn firmware(&mut self, cpu: &mut Cpu) {
        if self.pages[usize::from(cpu.pc >> 8)] == Page::Rom {
            self.call(cpu);
        }
    }

    fn row(&self) -> Option<u32> {
        let at = usize::from(self.last).checked_sub(self.bitmap())? as u32;
        let row = at / ROW_BYTES * 8 + at % 8;
        (row < HEIGHT).then_some(row)
    }

    fn screen(&self) -> Option<Screen> {
        if self.register(0xD011) & 0x20 == 0 {
            return None;
        }
        let many = self.register(0xD016) & 0x10 != 0;
        let bits = 1 + u32::from(many);
        let width = 320 / bits;
        let first = self.colours(many, 0);
        // Where characters have colours of their own, an ink is a colour's number.
        let same = (0..1000).all(|cell| self.colours(many, cell) == first);
        let ink = |x: u32, y: u32| {
            let place = x * bits;
            let at = y / 8 * ROW_BYTES + place / 8 * 8 + y % 8;
            let byte = self.ram[self.bitmap() + at as usize];
            let pattern = byte >> (8 - bits - place % 8) & ((1 << bits) - 1);
            match same {
                true => pattern,
                false => {
                    let cell = (y / 8 * 40 + place / 8) as usize;
                    self.colours(many, cell)[usize::from(pattern)]
                }
            }
        };
        let places = (0..HEIGHT).flat_map(|y| (0..width).map(move |x| (x, y)));
        Some(Screen {
            width,
            height: HEIGHT,
            pixels: places.map(|(x, y)| ink(x, y)).collect(),
            palette: match same {
                true => first.iter().map(|c| COLOURS[usize::from(*c)]).collect(),
                false => COLOURS.to_vec(),
            },
        })
    }

    fn output(&self) -> Vec<u8> {
        self.text.clone()
    }

    fn plug(&mut self, keyboard: Keyboard) -> bool {
        self.keys = Some(Box::new(Keys::new(keyboard)));
        true
    }

    fn unplug(&mut self) -> Option<Keyboard> {
        self.keys.take().map(|keys| keys.keyboard)
    }
}

impl C64 {
    /// Presses a key, and keeps it pressed: a program that waited for one goes on.
    pub fn press(&mut self) {
        self.board.pressed = true;
        if self.board.stop == Some(Stop::Ended) {
            self.board.stop = None;
        }
    }

    /// What was stored to a register of the hardware.
    pub fn register(&self, address: u16) -> u8 {
        self.board.register(address)
    }
}

#[cfg(test)]
mod tests;
