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
//! | &FFF4 | OSBYTE | 119, 124 and 21, of which nothing is seen here; 154, the video ULA's control |
//! | &FFF4 | OSBYTE | 129 (INKEY), where there is a keyboard |
//! | &FFE0 | OSRDCH | the next key, where there is a keyboard; else nobody presses one: the program has **ended** |
//! | &FFF7 | OSCLI | `*BASIC`: the program has ended |
//!
//! A program that ends in MODE 7 and has printed something ends with that as a fault.
//! Of the hardware what makes the screen may be set: the 6845's registers by &FE00 and &FE01, the
//! video ULA's at &FE20 and &FE21. Everything else is not there: what calls, reads or sets
//! it ends the run with a fault. Programs that return end, too.
//!
//! # Cycles
//! Of 2 MHz. RAM takes no longer, the screen's included, so every access is one; the
//! hardware at &FC00 to &FEFF, part of which takes longer, is out of programs' reach.
//! The interrupts of a real machine take the share that they take from BASIC
//! (`bbc::cost` says what it is); a call of the system takes what it takes on the
//! genuine one, to a few per cent ([`MODE_CYCLES`]).

mod keyboard;
mod video;

use super::computer::{Board, Computer, fault, return_from};
use super::cpu::{Bus, Cpu};
use crate::bbc::cost;
use crate::keys::Keyboard;
use crate::{Screen, Stop};
use video::{MODES, Mode, Video};

/// The machine.
pub type Bbc = Computer<Micro>;

/// Where RAM ends.
const RAM: u16 = 0x8000;
/// Where the screen of MODE 7 begins.
const TEXT: u16 = 0x7C00;
/// Where a program returns to.
const RETURN: u16 = RAM;

/// Cycles of VDU 22, which clears the screen, for 20K of it and for 10K.
pub const MODE_CYCLES: [u64; 2] = [111_000, 60_500];
/// Cycles of any other byte that OSWRCH takes, and of any other call.
const CALL_CYCLES: u64 = 150;

/// The memory, and what the operating system knows.
#[derive(Clone, Debug)]
pub struct Micro {
    ram: Box<[u8; 0x1_0000]>,
    cycles: u64,
    video: Video,
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
            video: Video::default(),
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
            self.set(address, value);
        }
    }
}

impl Micro {
    /// Sets a register of the hardware.
    #[cold]
    fn set(&mut self, address: u16, value: u8) {
        if !self.video.write(address, value) {
            return self.absent("sets", address);
        }
        // The 6845 is on the bus of 1 MHz: the processor waits for that.
        if address < 0xFE20 {
            self.cycles += 1;
        }
    }

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
            0xFFF4 if cpu.a == 154 => self.video.set_control(cpu.x),
            0xFFF4 if cpu.a == 129 && self.keyboard.is_some() => self.inkey(cpu),
            0xFFE0 if self.keyboard.is_some() => self.read_key(cpu),
            0xFFF4 => self.fail(format!(
                "the program calls OSBYTE {}, which is not bundled",
                cpu.a
            )),
            0xFFE0 | RETURN => return self.end(),
            0xFFF7 if self.command(cpu) == b"BASIC" => return self.end(),
            at => self.fail(format!(
                "the program calls &{at:04X}: of the machine's ROMs only OSWRCH, OSASCI, OSNEWL, \
                 OSBYTE, OSRDCH and *BASIC are bundled"
            )),
        }
        return_from(cpu, &self.ram);
    }

    /// A command of the operating system's, as X and Y say where it stands.
    fn command(&self, cpu: &Cpu) -> &[u8] {
        let from = self
            .ram
            .get(usize::from(u16::from_le_bytes([cpu.x, cpu.y]))..);
        let mut lines = from.unwrap_or_default().split(|byte| *byte == 13);
        lines.next().unwrap_or_default()
    }

    fn end(&mut self) {
        let said = String::from_utf8_lossy(&self.text).trim().to_owned();
        self.stop.get_or_insert(match self.video.is_graphic() {
            false if !said.is_empty() => Stop::Fault(fault(said)),
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
            (19, &[ink, colour, _, _, _]) => self.video.colour(ink, colour),
            (23, [1, ..]) => {}
            (10 | 13 | 32..=126, []) if !self.video.is_graphic() => {
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
        let number = number & 0x7F;
        let found: Option<Mode> = MODES.iter().find(|m| m.number == number).copied();
        if found.is_none() && number != 7 {
            return self.fail(format!(
                "MODE {number} is not bundled: 0, 1, 2, 4, 5 and 7 are"
            ));
        }
        let start = found.map_or(TEXT, |mode| mode.start);
        self.video.enter(found);
        self.cycles += MODE_CYCLES[usize::from(start > 0x3000)];
        self.ram[usize::from(start)..usize::from(RAM)].fill(0);
    }
}

impl Board for Micro {
    fn peek(&self, address: u16) -> u8 {
        self.ram[usize::from(address)]
    }

    fn poke(&mut self, address: u16, value: u8) {
        self.ram[usize::from(address)] = value;
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
        self.video.line(self.last)
    }

    fn screen(&self) -> Option<Screen> {
        self.video.screen(&self.ram[..usize::from(RAM)])
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
