//! An Atari VCS (2600): a 6502 of 13 address lines, 128 bytes of RAM, a timer, and a video
//! chip that knows one line of the picture, which the program changes while it is drawn.
//!
//! | addresses | what is there |
//! |---|---|
//! | $0000 to $003F | the TIA ([`tia`]): the picture, and the fire buttons |
//! | $0080 to $00FF | the RAM; the stack's page is the same |
//! | $0280 to $0297 | the RIOT ([`riot`]): timer, joysticks, switches |
//! | $1000 to $1FFF | the cartridge ([`cartridge`]) |
//!
//! All of them appear many times over, as only some of the address lines are looked at.
//! Programs end never: a run ends at its limit of cycles, or at the frame in which a
//! keyboard's script says `quit`. The keyboard is looked at once a frame, when the vertical
//! sync begins: the arrows and the space bar are the left joystick and its button. One that
//! keeps the memory at each look is asked where the program reads SWCHA, and its pictures are
//! what the beam has drawn when the picture is blanked next.
//!
//! **Every frame is counted in lines.** The first that has nearer to 262 than to 312 makes
//! the television one for NTSC, else it is one for PAL; a run that ends by its script ends
//! with a fault where any frame has another number of lines than its television wants. So does
//! one that comes to its limit, and also where a vertical sync is long overdue then.
//!
//! Not there: players, missiles and the ball, which are said to be missing where a program
//! shows one, collisions, and sound.
//!
//! Sources: Steve Wright, "Stella Programmer's Guide" (1979); the data sheet of the MOS 6532;
//! which clock of a line a store takes effect at, and what the timer reads, is as the
//! emulator Stella has it.

pub mod cartridge;
pub mod riot;
pub mod television;
pub mod tia;

use super::computer::{Board, Computer, fault};
use super::cpu::Bus;
use crate::keys::{Key, Keyboard, Seen};
use crate::{Fault, Screen, Stop};
use cartridge::Cartridge;
use riot::Riot;
use tia::Tia;

/// The machine.
pub type Vcs = Computer<Console>;

/// Colour clocks of a cycle of the processor.
const CLOCKS: u64 = 3;

/// All that is on the bus.
#[derive(Clone, Debug, Default)]
pub struct Console {
    cycles: u64,
    /// What was last on the data lines: where nobody drives them it is still there.
    bus: u8,
    /// Whether the processor waits, when it next reads, for the line's end.
    waits: bool,
    cartridge: Cartridge,
    riot: Riot,
    tia: Tia,
    keyboard: Option<Box<Keyboard>>,
    /// Pictures of the keyboard's that are taken when the beam has drawn them.
    pending: Vec<usize>,
    /// Whether the script is at its end but for those.
    quits: bool,
    stop: Option<Stop>,
}

/// Where a cartridge's own RAM is.
const CHIP: u16 = 0x1000;

/// SWCHA, where programs look at the joysticks.
const STICKS: u16 = 0x0280;

/// The register that blanks the picture, and its bit that does.
const VBLANK: u16 = 0x01;
const BLANKS: u8 = 2;

impl Bus for Console {
    #[inline(always)]
    fn read(&mut self, address: u16) -> u8 {
        if self.waits {
            self.wait();
        }
        self.cycles += 1;
        self.bus = if address & 0x1000 != 0 {
            self.cartridge.read(address, self.bus)
        } else if address & 0x80 == 0 {
            self.tia.read(address) | self.bus & 0x3F
        } else {
            if address & 0x1287 == STICKS {
                self.look();
            }
            self.riot.read(address, self.cycles)
        };
        self.bus
    }

    #[inline(always)]
    fn write(&mut self, address: u16, value: u8) {
        self.cycles += 1;
        self.bus = value;
        if address & 0x1000 != 0 {
            self.cartridge.write(address, value);
        } else if address & 0x80 == 0 {
            self.store(address, value);
        } else {
            self.riot.write(address, value, self.cycles);
        }
    }
}

impl Console {
    /// The processor reads, and has to wait for the next line where this one has begun.
    fn wait(&mut self) {
        self.waits = false;
        let next = self.tia.next_line(self.cycles * CLOCKS);
        self.cycles = next.div_ceil(CLOCKS).max(self.cycles);
    }

    fn store(&mut self, address: u16, value: u8) {
        match address & 0x3F {
            tia::WSYNC => self.waits = true,
            register => {
                let begins = self.tia.store(register, value, self.cycles * CLOCKS);
                if begins {
                    self.frame();
                }
                if register == VBLANK && value & BLANKS != 0 && !self.pending.is_empty() {
                    self.shown();
                }
            }
        }
    }

    /// A frame begins: what is held now is held all through it.
    fn frame(&mut self) {
        let by_frames = |keyboard: &mut Box<Keyboard>| !keyboard.remembers();
        let Some(mut keyboard) = self.keyboard.take_if(by_frames) else {
            return;
        };
        let frames = self.tia.television.frames();
        let held = match keyboard.look(frames, || self.tia.television.screen()) {
            Seen::Key(key) => Some(key),
            Seen::Nothing => None,
            Seen::Quit => {
                self.quit();
                None
            }
        };
        self.hold(held);
        self.keyboard = Some(keyboard);
    }

    /// The script is at its end.
    fn quit(&mut self) {
        let wrong = self.tia.television.complaint();
        let stop = wrong.map_or(Stop::Ended, |message| Stop::Fault(fault(message)));
        self.stop.get_or_insert(stop);
    }

    /// The program looks at the joystick, which a keyboard that keeps the memory holds from now
    /// to the next look. What it shows now is what the beam draws next.
    fn look(&mut self) {
        let by_looks = |keyboard: &mut Box<Keyboard>| keyboard.remembers();
        let Some(mut keyboard) = self.keyboard.take_if(by_looks) else {
            return;
        };
        let last = CHIP + 0x80;
        let memory = || (0..last).map(|at| i16::from(self.peek(at))).collect();
        keyboard.remember(self.cycles, memory);
        let before = keyboard.shots().len();
        let seen = keyboard.look(self.tia.television.frames(), || None);
        self.pending.extend(before..keyboard.shots().len());
        match seen {
            Seen::Key(key) => self.hold(Some(key)),
            Seen::Nothing => self.hold(None),
            Seen::Quit => {
                self.hold(None);
                self.quits = true;
            }
        }
        self.keyboard = Some(keyboard);
        if self.quits && self.pending.is_empty() {
            self.quit();
        }
    }

    /// The beam has drawn a picture.
    fn shown(&mut self) {
        let screen = self.tia.television.drawn();
        for at in std::mem::take(&mut self.pending) {
            if let Some(keyboard) = &mut self.keyboard {
                keyboard.retake(at, screen.clone());
            }
        }
        if self.quits {
            self.quit();
        }
    }

    /// The joystick is held so.
    fn hold(&mut self, held: Option<Key>) {
        self.riot.stick = match held {
            Some(Key::Up) => 0xEF,
            Some(Key::Down) => 0xDF,
            Some(Key::Left) => 0xBF,
            Some(Key::Right) => 0x7F,
            _ => 0xFF,
        };
        self.tia.fire(held == Some(Key::Char(b' ')));
    }
}

impl Board for Console {
    const DRAWS_APART: bool = false;

    fn peek(&self, address: u16) -> u8 {
        match address {
            _ if address & 0x1000 != 0 => self.cartridge.peek(address),
            _ if address & 0x280 == 0x80 => self.riot.ram[usize::from(address & 0x7F)],
            _ => 0,
        }
    }

    fn poke(&mut self, address: u16, value: u8) {
        if address & 0x1280 == 0x80 {
            self.riot.ram[usize::from(address & 0x7F)] = value;
        }
    }

    fn room(&self) -> (u16, &'static str) {
        (0xFFFF, "the vectors")
    }

    fn place(&mut self, _: u16, bytes: &[u8]) -> Result<(), Fault> {
        self.cartridge = Cartridge::new(bytes).map_err(fault)?;
        Ok(())
    }

    fn entry(&self, _: u16) -> Result<u16, Fault> {
        let byte = |at: u16| self.cartridge.peek(at);
        Ok(u16::from_le_bytes([byte(0x1FFC), byte(0x1FFD)]))
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

    fn late(&self) -> Option<String> {
        self.tia.late(self.cycles * CLOCKS)
    }

    fn row(&self) -> Option<u32> {
        self.tia.television.row()
    }

    fn screen(&self) -> Option<Screen> {
        self.tia.television.screen()
    }

    fn output(&self) -> Vec<u8> {
        let mut said = self.tia.television.summary();
        if let Some(what) = self.tia.unseen {
            said.push_str(&format!("not shown here: {what}\n"));
        }
        said.into_bytes()
    }

    fn plug(&mut self, keyboard: Keyboard) -> bool {
        self.keyboard = Some(Box::new(keyboard));
        true
    }

    fn unplug(&mut self) -> Option<Keyboard> {
        self.keyboard.take().map(|keyboard| *keyboard)
    }
}

impl Vcs {
    /// The lines of every frame so far, from one vertical sync to the next.
    pub fn frames(&self) -> &[u32] {
        self.board.tia.television.lines()
    }

    /// The frame that was last complete, a colour a byte as programs store it: line by line
    /// from the vertical sync on, 160 a line, black where the picture is blanked.
    pub fn lines(&self) -> &[u8] {
        self.board.tia.television.last()
    }

    /// Whether the cartridge has the 128 bytes of RAM that are called Superchip, and how many
    /// banks of 4K it has.
    pub fn cartridge(&self) -> (bool, usize) {
        self.board.cartridge.kind()
    }
}

#[cfg(test)]
mod tests;
