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
//!
//! X and Y follow the position: they can be read back. Inks that are not told
//! are greys from black to white. Every access is a cycle, as on every 6502;
//! the ports cost nothing more. Indexed stores to the ports are as good as
//! absolute ones; a read-modify-write stores twice.
//!
//! What ends a run with a fault: an ink outside the picture or not below INKS, a
//! size out of range, a second picture, an opcode that jams, and `brk` while the vector at $FFFE
//! holds 0 (running into empty memory, mostly).

use super::cpu::{Bus, Cpu, Step};
use crate::charge::{Charge, Ledger};
use crate::{Fault, Progress, Screen, Stop, Watch};

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
}

/// Cycles between two calls of the watcher.
const WATCH: u64 = 10_000_000;
/// The greatest width and height.
const SIDE: u16 = 4096;

/// How a run went.
#[derive(Clone, Debug)]
pub struct Run {
    /// Why it ended.
    pub stop: Stop,
    /// Processor cycles, each one access to the bus.
    pub cycles: u64,
    /// Instructions that were begun.
    pub instructions: u64,
    /// Inks stored.
    pub plots: u64,
    /// The picture; `None` where the program opened none.
    pub screen: Option<Screen>,
}

/// The machine. [`Plain::load`] a program, then [`Plain::run`] it.
#[derive(Clone, Debug)]
pub struct Plain {
    cpu: Cpu,
    memory: Memory,
    instructions: u64,
}

#[derive(Clone, Debug)]
struct Memory {
    ram: Box<[u8; 0x1_0000]>,
    cycles: u64,
    plots: u64,
    screen: Option<Screen>,
    inks: u16,
    palette_bytes: usize,
    row: Option<u32>,
    /// Set where the program has ended, by itself or by a fault at a port.
    stop: Option<Stop>,
}

impl Bus for Memory {
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

/// A fault of a program, which has no source line that the machine knows.
fn fault(message: String) -> Fault {
    Fault {
        message,
        file: None,
        line: None,
        column: None,
    }
}

impl Memory {
    fn word(&self, at: u16) -> u16 {
        let [lo, hi] = [at, at.wrapping_add(1)].map(|a| self.ram[usize::from(a)]);
        u16::from_le_bytes([lo, hi])
    }

    fn set_word(&mut self, at: u16, value: u16) {
        let [lo, hi] = value.to_le_bytes();
        self.ram[usize::from(at)] = lo;
        self.ram[usize::from(at.wrapping_add(1))] = hi;
    }

    /// Stops with a fault, unless the program has stopped already.
    fn fail(&mut self, message: String) {
        self.stop.get_or_insert(Stop::Fault(fault(message)));
    }

    #[cold]
    fn port(&mut self, address: u16, value: u8) {
        match address {
            port::INKS => self.open(value),
            port::INK => self.plot(value),
            port::PALETTE => self.palette(value),
            port::EXIT if value == 0 => {
                self.stop.get_or_insert(Stop::Ended);
            }
            port::EXIT => self.fail(format!("the program ended with status {value}")),
            _ => {}
        }
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

impl Default for Plain {
    fn default() -> Self {
        Self::new()
    }
}

impl Plain {
    /// A machine with empty memory.
    pub fn new() -> Self {
        Plain {
            cpu: Cpu::new(0),
            memory: Memory {
                ram: Box::new([0; 0x1_0000]),
                cycles: 0,
                plots: 0,
                screen: None,
                inks: 0,
                palette_bytes: 0,
                row: None,
                stop: None,
            },
            instructions: 0,
        }
    }

    /// Loads a program: two bytes of load address, low byte first, then what goes
    /// there. It will be entered at the load address.
    ///
    /// # Errors
    /// Where there is no program, or it reaches into the page of the ports.
    pub fn load(&mut self, image: &[u8]) -> Result<(), Fault> {
        let [lo, hi, bytes @ ..] = image else {
            return Err(fault(
                "a program begins with two bytes of load address".to_owned(),
            ));
        };
        let origin = u16::from_le_bytes([*lo, *hi]);
        let start = usize::from(origin);
        if bytes.is_empty() {
            return Err(fault(
                "the program has no bytes behind its load address".to_owned(),
            ));
        }
        let room = self.memory.ram.get_mut(start..usize::from(port::WIDTH));
        match room.and_then(|room| room.get_mut(..bytes.len())) {
            Some(room) => room.copy_from_slice(bytes),
            None => {
                let end = start + bytes.len() - 1;
                return Err(fault(format!(
                    "the program lies at ${start:04X} to ${end:04X}, but the ports begin at $FF00"
                )));
            }
        }
        self.cpu = Cpu::new(origin);
        Ok(())
    }

    /// A byte of memory, for whoever looks on: neither a cycle nor an effect.
    pub fn peek(&self, address: u16) -> u8 {
        self.memory.ram[usize::from(address)]
    }

    /// Changes a byte of memory from outside: neither a cycle nor an effect.
    pub fn poke(&mut self, address: u16, value: u8) {
        self.memory.ram[usize::from(address)] = value;
    }

    /// The processor, to set up or to look at.
    pub fn cpu(&mut self) -> &mut Cpu {
        &mut self.cpu
    }

    /// Runs until the program ends, the watcher says stop, or `limit` cycles have
    /// passed since the machine was made (checked between instructions).
    /// May be called again, with a greater limit, to go on.
    pub fn run(&mut self, limit: u64, watch: Watch<'_>) -> Run {
        self.run_looking(limit, watch, &mut |_, _, _| {})
    }

    /// Runs as [`Plain::run`] does, and counts what each address takes, where those that
    /// `routine` knows are charged to the addresses that call them. The charges add up
    /// to the cycles of this call.
    pub fn charges(
        &mut self,
        limit: u64,
        routine: &dyn Fn(u32) -> bool,
        watch: Watch<'_>,
    ) -> (Run, Vec<Charge>) {
        let mut ledger = Ledger::new(0x1_0000, routine);
        let run = self.run_looking(limit, watch, &mut |pc, sp, cycles| {
            ledger.step(u32::from(pc), u32::from(!sp), cycles, true);
        });
        (run, ledger.finish())
    }

    fn run_looking(
        &mut self,
        limit: u64,
        watch: Watch<'_>,
        look: &mut impl FnMut(u16, u8, u64),
    ) -> Run {
        let stop = loop {
            let until = limit.min(self.memory.cycles.saturating_add(WATCH));
            if let Some(stop) = self.slice(until, look) {
                break stop;
            }
            if self.memory.cycles >= limit {
                break Stop::CycleLimit;
            }
            let progress = Progress {
                cycles: self.memory.cycles,
                row: self.memory.row,
            };
            if !watch(progress) {
                break Stop::Interrupted;
            }
        };
        Run {
            stop,
            cycles: self.memory.cycles,
            instructions: self.instructions,
            plots: self.memory.plots,
            screen: self.memory.screen.clone(),
        }
    }

    /// Runs until the cycle count reaches `until`; answers a stop if there was one.
    /// `look` is told of each instruction: its address, the stack pointer before it, its cycles.
    fn slice(&mut self, until: u64, look: &mut impl FnMut(u16, u8, u64)) -> Option<Stop> {
        // A copy that the optimiser can keep in registers.
        let mut cpu = self.cpu;
        let mut instructions = 0;
        while self.memory.cycles < until && self.memory.stop.is_none() {
            instructions += 1;
            let (pc, sp, begun) = (cpu.pc, cpu.sp, self.memory.cycles);
            let step = cpu.step(&mut self.memory);
            look(pc, sp, self.memory.cycles - begun);
            match step {
                Step::Ran => {}
                Step::Jammed => {
                    let at = cpu.pc.wrapping_sub(1);
                    let opcode = self.peek(at);
                    self.memory.fail(format!(
                        "opcode ${opcode:02X} at ${at:04X} stops the processor"
                    ));
                }
                Step::Brk => {
                    if self.memory.word(0xFFFE) == 0 {
                        let at = self.return_address(cpu.sp).wrapping_sub(2);
                        let message = format!("brk at ${at:04X}, and no handler at $FFFE");
                        self.memory.fail(message);
                    }
                }
            }
        }
        self.cpu = cpu;
        self.instructions += instructions;
        self.memory.stop.clone()
    }

    /// The address that an interrupt has just pushed below the status.
    fn return_address(&self, sp: u8) -> u16 {
        let byte = |n: u8| self.peek(0x0100 | u16::from(sp.wrapping_add(n)));
        u16::from_le_bytes([byte(2), byte(3)])
    }
}

#[cfg(test)]
mod tests;
