//! A BBC Micro, model B, as programs in machine code see it: 32K of RAM, part of which
//! is the screen, and the operating system's calls.
//!
//! A program is loaded where its first two bytes say and entered there, or as it is told
//! ([`super::Machine::load_at`]): a disc's catalogue says both for `*RUN`.
//! The operating system is not bundled. Of its calls these are done here:
//!
//! | address | name | here |
//! |---|---|---|
//! | &FFEE | OSWRCH | VDU 22 chooses a mode, VDU 19 gives an ink its colour, VDU 23,1 hides the cursor; in MODE 7, text |
//! | &FFE3, &FFE7 | OSASCI, OSNEWL | text, and the end of a line |
//! | &FFF4 | OSBYTE | 119, 124 and 21, of which nothing is seen here |
//! | &FFF4 | OSBYTE | 129 (INKEY), where there is a keyboard |
//! | &FFE0 | OSRDCH | the next key, where there is a keyboard; else nobody presses one: the program has **ended** |
//!
//! A program that ends in MODE 7 and has printed something ends with that as a fault.
//! Everything else there and all other hardware is not there: what calls, reads or sets
//! it ends the run with a fault. Programs that return end, too.
//!
//! # Cycles
//! Of 2 MHz. RAM takes no longer, the screen's included, so every access is one; the
//! hardware at &FC00 to &FEFF, part of which takes longer, is out of programs' reach.
//! The interrupts of a real machine take the share that they take from BASIC
//! (`bbc::cost` says what it is); a call of the system takes what it takes on the
//! genuine one, to a few per cent ([`MODE_CYCLES`]).

mod keyboard;

use super::computer::{Board, Computer, fault, return_from};
use super::cpu::{Bus, Cpu};
use crate::bbc::cost;
use crate::keys::Keyboard;
use crate::{Screen, Stop};

/// The machine.
pub type Bbc = Computer<Micro>;

/// Where RAM ends.
const RAM: u16 = 0x8000;
/// Where a program returns to.
const RETURN: u16 = RAM;

/// A graphics mode.
#[derive(Clone, Copy, Debug)]
struct Mode {
    number: u8,
    width: u32,
    /// Bits of a pixel.
    bits: u8,
    /// Where its memory begins; it ends at &8000.
    start: u16,
}

const MODES: [Mode; 5] = [
    mode(0, 640, 1, 0x3000),
    mode(1, 320, 2, 0x3000),
    mode(2, 160, 4, 0x3000),
    mode(4, 320, 1, 0x5800),
    mode(5, 160, 2, 0x5800),
];

const fn mode(number: u8, width: u32, bits: u8, start: u16) -> Mode {
    Mode {
        number,
        width,
        bits,
        start,
    }
}

/// Rows of every mode.
const HEIGHT: u32 = 256;

/// Cycles of VDU 22, which clears the screen, for 20K of it and for 10K.
pub const MODE_CYCLES: [u64; 2] = [111_000, 60_500];
/// Cycles of any other byte that OSWRCH takes, and of any other call.
const CALL_CYCLES: u64 = 150;

/// The memory, and what the operating system knows.
#[derive(Clone, Debug)]
pub struct Micro {
    ram: Box<[u8; 0x1_0000]>,
    cycles: u64,
    mode: Option<Mode>,
    /// The physical colour of each ink.
    colours: [u8; 16],
    /// A VDU command whose bytes have not all come.
    vdu: Vec<u8>,
    text: Vec<u8>,
    /// Where a byte was stored last, if that may be the screen.
    last: u16,
    keyboard: Option<Box<Keyboard>>,
    stop: Option<Stop>,
}

impl Default for Micro {
    fn default() -> Self {
        Micro {
            ram: Box::new([0; 0x1_0000]),
            cycles: 0,
            mode: None,
            colours: [0; 16],
            vdu: Vec::new(),
            text: Vec::new(),
            last: 0,
            keyboard: None,
            stop: None,
        }
    }
}

impl Bus for Micro {
    #[inline(always)]
    fn read(&mut self, address: u16) -> u8 {
        self.cycles += 1;
        if address >= RAM {
            self.absent("reads", address);
        }
        self.ram[usize::from(address)]
    }

    #[inline(always)]
    fn write(&mut self, address: u16, value: u8) {
        self.cycles += 1;
        if address < RAM {
            self.ram[usize::from(address)] = value;
            if address >= 0x3000 {
                self.last = address;
            }
        } else {
            self.absent("sets", address);
        }
    }
}

impl Micro {
    #[cold]
    fn absent(&mut self, does: &str, address: u16) {
        // The vector of `brk`: who takes it says so.
        if address < 0xFFFE {
            self.fail(format!(
                "the program {does} &{address:04X}: of the machine's ROMs and hardware only some \
                 calls of the operating system are bundled"
            ));
        }
    }

    /// Does a call of the operating system.
    #[cold]
    fn call(&mut self, cpu: &mut Cpu) {
        self.cycles += CALL_CYCLES;
        match cpu.pc {
            0xFFEE => self.write_vdu(cpu.a),
            0xFFE3 if cpu.a == 13 => [10, 13].into_iter().for_each(|c| self.write_vdu(c)),
            0xFFE3 => self.write_vdu(cpu.a),
            0xFFE7 => [10, 13].into_iter().for_each(|c| self.write_vdu(c)),
            0xFFF4 if matches!(cpu.a, 21 | 119 | 124) => {}
            0xFFF4 if cpu.a == 129 && self.keyboard.is_some() => self.inkey(cpu),
            0xFFE0 if self.keyboard.is_some() => self.read_key(cpu),
            0xFFF4 => self.fail(format!(
                "the program calls OSBYTE {}, which is not bundled",
                cpu.a
            )),
            0xFFE0 | RETURN => return self.end(),
            at => self.fail(format!(
                "the program calls &{at:04X}: of the machine's ROMs only OSWRCH, OSASCI, OSNEWL, \
                 OSBYTE and OSRDCH are bundled"
            )),
        }
        return_from(cpu, &self.ram);
    }

    fn end(&mut self) {
        let said = String::from_utf8_lossy(&self.text).trim().to_owned();
        self.stop.get_or_insert(match self.mode {
            None if !said.is_empty() => Stop::Fault(fault(said)),
            _ => Stop::Ended,
        });
    }

    /// Takes a byte of the VDU's.
    fn write_vdu(&mut self, byte: u8) {
        self.vdu.push(byte);
        let vdu = std::mem::take(&mut self.vdu);
        let [first, rest @ ..] = vdu.as_slice() else {
            return;
        };
        // How many bytes follow the first.
        let follow = match first {
            22 => 1,
            19 => 5,
            23 => 9,
            _ => 0,
        };
        match (*first, rest) {
            _ if rest.len() < follow => self.vdu = vdu,
            (22, &[number]) => self.choose(number),
            (19, &[ink, colour, _, _, _]) => {
                if let Some(own) = self.colours.get_mut(usize::from(ink)) {
                    *own = colour & 7;
                }
            }
            (23, [1, ..]) => {}
            (10 | 13 | 32..=126, []) if self.mode.is_none() => {
                if byte != 13 {
                    self.text.push(byte);
                }
            }
            (code, _) => {
                let message =
                    format!("VDU {code} is not bundled: modes, colours and, in MODE 7, text are");
                self.fail(message);
            }
        }
    }

    fn choose(&mut self, number: u8) {
        let found = MODES.iter().find(|m| m.number == number & 0x7F);
        let Some(&mode) = found else {
            return self.fail(format!(
                "MODE {number} is not bundled: 0, 1, 2, 4 and 5 are"
            ));
        };
        self.mode = Some(mode);
        self.cycles += MODE_CYCLES[usize::from(mode.start > 0x3000)];
        self.ram[usize::from(mode.start)..usize::from(RAM)].fill(0);
        for (ink, colour) in (0..).zip(&mut self.colours) {
            *colour = match mode.bits {
                1 => [0, 7][ink & 1],
                2 => [0, 1, 3, 7][ink & 3],
                _ => (ink & 7) as u8,
            };
        }
    }

    /// Bytes of a row of characters.
    fn row_bytes(mode: Mode) -> u32 {
        mode.width * u32::from(mode.bits)
    }

    /// The ink of a pixel: a byte's pixels stand side by side in each of its bits.
    fn ink(&self, mode: Mode, x: u32, y: u32) -> u8 {
        let pixels = 8 / u32::from(mode.bits);
        let at = y / 8 * Self::row_bytes(mode) + x / pixels * 8 + y % 8;
        let byte = self.ram.get(usize::from(mode.start) + at as usize);
        let byte = byte.copied().unwrap_or(0);
        let bit = |k: u32| byte >> (7 - x % pixels - k * pixels) & 1;
        (0..u32::from(mode.bits)).fold(0, |ink, k| ink << 1 | bit(k))
    }
}

impl Board for Micro {
    fn ram(&self) -> &[u8; 0x1_0000] {
        &self.ram
    }

    fn ram_mut(&mut self) -> &mut [u8; 0x1_0000] {
        &mut self.ram
    }

    fn room(&self) -> (u16, &'static str) {
        (RAM, "the ROMs")
    }

    fn ready(&mut self) {
        // Where an empty stack returns to.
        let [lo, hi] = (RETURN - 1).to_le_bytes();
        self.ram[0x100..0x102].copy_from_slice(&[lo, hi]);
    }

    #[inline(always)]
    fn cycles(&self) -> u64 {
        self.cycles
    }

    fn shown(cycles: u64) -> u64 {
        cost::with_interrupts(cycles)
    }

    fn unshown(cycles: u64) -> u64 {
        cost::without_interrupts(cycles)
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
        if cpu.pc >= RAM {
            self.call(cpu);
        }
    }

    fn row(&self) -> Option<u32> {
        let mode = self.mode?;
        let at = u32::from(self.last.checked_sub(mode.start)?);
        Some(at / Self::row_bytes(mode) * 8 + at % 8)
    }

    fn screen(&self) -> Option<Screen> {
        let mode = self.mode?;
        let rows = (0..HEIGHT).flat_map(|y| (0..mode.width).map(move |x| (x, y)));
        let colour = |c: &u8| [1, 2, 4].map(|bit| if c & bit == 0 { 0 } else { 255 });
        Some(Screen {
            width: mode.width,
            height: HEIGHT,
            pixels: rows.map(|(x, y)| self.ink(mode, x, y)).collect(),
            palette: self
                .colours
                .iter()
                .take(1 << mode.bits)
                .map(colour)
                .collect(),
        })
    }

    fn output(&self) -> Vec<u8> {
        self.text.clone()
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
