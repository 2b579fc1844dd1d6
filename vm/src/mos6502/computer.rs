//! A processor on a board: what all machines around a 6502 do alike.
//!
//! A [`Board`] is the memory, what else answers at addresses, and the clock; a
//! [`Computer`] loads a program into it and runs it, bounded and watched.

use super::cpu::{Bus, Cpu, Step};
use crate::charge::{Charges, Ledger, Roles};
use crate::keys::Keyboard;
use crate::{Fault, Progress, Screen, Stop, Watch};

/// Cycles between two calls of the watcher.
const WATCH: u64 = 10_000_000;

/// How a run went.
#[derive(Clone, Debug)]
pub struct Run {
    /// Why it ended.
    pub stop: Stop,
    /// Cycles of the machine's clock: each access to the bus is one, and boards
    /// may add what the processor has to wait.
    pub cycles: u64,
    /// Instructions that were begun.
    pub instructions: u64,
    /// Inks stored, where the board counts them.
    pub plots: u64,
    /// The picture; `None` where the program opened none.
    pub screen: Option<Screen>,
    /// What was printed as text.
    pub output: Vec<u8>,
}

/// What a processor is put on.
pub trait Board: Bus + Default {
    /// Whether pixels are no part of the memory.
    const DRAWS_APART: bool = false;
    /// A byte of memory, for whoever looks on: neither a cycle nor an effect.
    fn peek(&self, address: u16) -> u8;
    /// Changes a byte of memory from outside: neither a cycle nor an effect.
    fn poke(&mut self, address: u16, value: u8);
    /// The first address that no program may be loaded to, and what is there.
    fn room(&self) -> (u16, &'static str);
    /// Puts a program where it belongs.
    ///
    /// # Errors
    /// Where there is no room for it.
    fn place(&mut self, at: u16, bytes: &[u8]) -> Result<(), Fault> {
        let (limit, what) = self.room();
        let begin = usize::from(at);
        if begin + bytes.len() > usize::from(limit) {
            let end = begin + bytes.len() - 1;
            return Err(fault(format!(
                "the program lies at ${begin:04X} to ${end:04X}, but {what} begin at ${limit:04X}"
            )));
        }
        for (address, byte) in (at..).zip(bytes) {
            self.poke(address, *byte);
        }
        Ok(())
    }
    /// Where a program that was loaded at an address is entered, where nobody says.
    ///
    /// # Errors
    /// Where the program does not say what the machine must know.
    fn entry(&self, loaded: u16) -> Result<u16, Fault> {
        Ok(loaded)
    }
    /// Gets ready what a program finds when it is entered: what it returns to.
    fn ready(&mut self) {}
    /// Cycles since the machine was made.
    fn cycles(&self) -> u64;
    /// Cycles as the machine's clock shows them after so many; never less than those.
    fn shown(cycles: u64) -> u64 {
        cycles
    }
    /// The cycles after which the clock shows so many.
    fn unshown(cycles: u64) -> u64 {
        cycles
    }
    /// Why the program has stopped, if it has.
    fn stop(&self) -> Option<&Stop>;
    /// Stops with a fault, unless the program has stopped already.
    fn fail(&mut self, message: String);
    /// What is wrong with a program that is stopped at its limit of cycles, beside that.
    fn late(&self) -> Option<String> {
        None
    }
    /// Does what the machine's own programs would do at the processor's address,
    /// before an instruction there is begun.
    #[inline(always)]
    fn firmware(&mut self, _: &mut Cpu) {}
    /// The row of the last pixel drawn.
    fn row(&self) -> Option<u32>;
    /// Inks stored.
    fn plots(&self) -> u64 {
        0
    }
    /// What the screen shows; none where the program has opened none.
    fn screen(&self) -> Option<Screen>;
    /// What was printed as text.
    fn output(&self) -> Vec<u8> {
        Vec::new()
    }
    /// Gives it a keyboard; answers whether it has a place for one.
    fn plug(&mut self, _: Keyboard) -> bool {
        false
    }
    /// Takes the keyboard away again.
    fn unplug(&mut self) -> Option<Keyboard> {
        None
    }
}

/// A machine that runs programs, whatever board it has.
pub trait Machine {
    /// Loads a program: two bytes of load address, low byte first, then what goes there.
    ///
    /// # Errors
    /// Where there is no program, or no room for it.
    fn load(&mut self, image: &[u8]) -> Result<(), Fault>;
    /// Loads bytes to an address, and enters them at `start`: where it is not said, where the
    /// machine would.
    ///
    /// # Errors
    /// Where there are no bytes, or no room for them, or `start` is outside memory that
    /// programs may have.
    fn load_at(&mut self, at: u16, bytes: &[u8], start: Option<u16>) -> Result<(), Fault>;
    /// Whether pixels are no part of the memory.
    fn draws_apart(&self) -> bool;
    /// A byte of memory, for whoever looks on: neither a cycle nor an effect.
    fn peek(&self, address: u16) -> u8;
    /// Gives the machine a keyboard, whose keys come by its frames, or by looks at the
    /// keyboard; answers whether it has a place for one.
    fn plug(&mut self, keyboard: Keyboard) -> bool;
    /// Takes the keyboard away again.
    fn unplug(&mut self) -> Option<Keyboard>;
    /// Runs until the program ends, the watcher says stop, or `limit` cycles have
    /// passed since the machine was made (checked between instructions).
    /// May be called again, with a greater limit, to go on.
    fn run(&mut self, limit: u64, watch: Watch<'_>) -> Run;
    /// Runs as [`Machine::run`] does, and counts what each address takes, where routines'
    /// are charged to the addresses that call them. The charges add up
    /// to the cycles of this call.
    fn charges(&mut self, limit: u64, roles: Roles<'_>, watch: Watch<'_>) -> (Run, Charges);
}

/// A machine. [`Computer::load`] a program, then [`Computer::run`] it.
#[derive(Clone, Debug)]
pub struct Computer<B> {
    cpu: Cpu,
    pub(super) board: B,
    instructions: u64,
}

/// A fault of a program, which has no source line that the machine knows.
pub(super) fn fault(message: String) -> Fault {
    Fault {
        message,
        file: None,
        line: None,
        column: None,
    }
}

impl<B: Board> Default for Computer<B> {
    fn default() -> Self {
        Self::new()
    }
}

impl<B: Board> Computer<B> {
    /// A machine with empty memory.
    pub fn new() -> Self {
        Computer {
            cpu: Cpu::new(0),
            board: B::default(),
            instructions: 0,
        }
    }

    /// Loads a program; see [`Machine::load`].
    ///
    /// # Errors
    /// Where there is no program, or no room for it.
    pub fn load(&mut self, image: &[u8]) -> Result<(), Fault> {
        let [lo, hi, bytes @ ..] = image else {
            return Err(fault(
                "a program begins with two bytes of load address".to_owned(),
            ));
        };
        if bytes.is_empty() {
            return Err(fault(
                "the program has no bytes behind its load address".to_owned(),
            ));
        }
        self.load_at(u16::from_le_bytes([*lo, *hi]), bytes, None)
    }

    /// Loads bytes to an address; see [`Machine::load_at`].
    ///
    /// # Errors
    /// Where there are no bytes, or no room for them, or no program could be at `start`.
    pub fn load_at(&mut self, at: u16, bytes: &[u8], start: Option<u16>) -> Result<(), Fault> {
        if bytes.is_empty() {
            return Err(fault("the program has no bytes".to_owned()));
        }
        self.board.place(at, bytes)?;
        let (limit, what) = self.board.room();
        let start = match start {
            Some(start) if start >= limit => {
                return Err(fault(format!(
                    "no program begins at ${start:04X}: {what} begin at ${limit:04X}"
                )));
            }
            Some(start) => start,
            None => self.board.entry(at)?,
        };
        self.board.ready();
        self.cpu = Cpu::new(start);
        Ok(())
    }

    /// A byte of memory, for whoever looks on: neither a cycle nor an effect.
    pub fn peek(&self, address: u16) -> u8 {
        self.board.peek(address)
    }

    /// Changes a byte of memory from outside: neither a cycle nor an effect.
    pub fn poke(&mut self, address: u16, value: u8) {
        self.board.poke(address, value);
    }

    /// The processor, to set up or to look at.
    pub fn cpu(&mut self) -> &mut Cpu {
        &mut self.cpu
    }

    /// Runs; see [`Machine::run`].
    pub fn run(&mut self, limit: u64, watch: Watch<'_>) -> Run {
        self.run_looking(limit, watch, &mut |_, _, _| {})
    }

    /// Runs and counts; see [`Machine::charges`].
    pub fn charges(&mut self, limit: u64, roles: Roles<'_>, watch: Watch<'_>) -> (Run, Charges) {
        let mut ledger = Ledger::new(0x1_0000, roles);
        let before = self.board.cycles();
        let run = self.run_looking(limit, watch, &mut |pc, sp, cycles| {
            ledger.step(u32::from(pc), u32::from(!sp), cycles, true);
        });
        // Each has its share of what is added to all, so that they add up to the run.
        (run, ledger.finish().shared(before, B::shown))
    }

    fn run_looking(
        &mut self,
        limit: u64,
        watch: Watch<'_>,
        look: &mut impl FnMut(u16, u8, u64),
    ) -> Run {
        let end = B::unshown(limit);
        let stop = loop {
            let until = end.min(self.board.cycles().saturating_add(WATCH));
            if let Some(stop) = self.slice(until, look) {
                break stop;
            }
            if self.board.cycles() >= end {
                let late = self.board.late();
                break late.map_or(Stop::CycleLimit, |message| Stop::Fault(fault(message)));
            }
            let progress = Progress {
                cycles: B::shown(self.board.cycles()),
                row: self.board.row(),
                screen: &|| self.board.screen(),
            };
            if !watch(progress) {
                break Stop::Interrupted;
            }
        };
        Run {
            stop,
            cycles: B::shown(self.board.cycles()),
            instructions: self.instructions,
            plots: self.board.plots(),
            screen: self.board.screen(),
            output: self.board.output(),
        }
    }

    /// Runs until the cycle count reaches `until`; answers a stop if there was one.
    /// `look` is told of each instruction: its address, the stack pointer before it, its cycles.
    fn slice(&mut self, until: u64, look: &mut impl FnMut(u16, u8, u64)) -> Option<Stop> {
        // A copy that the optimiser can keep in registers.
        let mut cpu = self.cpu;
        let mut instructions = 0;
        while self.board.cycles() < until && self.board.stop().is_none() {
            instructions += 1;
            let (pc, sp, begun) = (cpu.pc, cpu.sp, self.board.cycles());
            self.board.firmware(&mut cpu);
            if self.board.stop().is_some() {
                look(pc, sp, self.board.cycles() - begun);
                break;
            }
            let step = cpu.step(&mut self.board);
            look(pc, sp, self.board.cycles() - begun);
            match step {
                Step::Ran => {}
                Step::Jammed => {
                    let at = cpu.pc.wrapping_sub(1);
                    let opcode = self.peek(at);
                    self.board.fail(format!(
                        "opcode ${opcode:02X} at ${at:04X} stops the processor"
                    ));
                }
                Step::Brk => {
                    let [lo, hi] = [0xFFFE, 0xFFFF].map(|at| self.peek(at));
                    if (lo, hi) == (0, 0) {
                        let at = self.return_address(cpu.sp).wrapping_sub(2);
                        let message = format!("brk at ${at:04X}, and no handler at $FFFE");
                        self.board.fail(message);
                    }
                }
            }
        }
        self.cpu = cpu;
        self.instructions += instructions;
        self.board.stop().cloned()
    }

    /// The address that an interrupt has just pushed below the status.
    fn return_address(&self, sp: u8) -> u16 {
        let byte = |n: u8| self.peek(0x0100 | u16::from(sp.wrapping_add(n)));
        u16::from_le_bytes([byte(2), byte(3)])
    }
}

impl<B: Board> Machine for Computer<B> {
    fn load(&mut self, image: &[u8]) -> Result<(), Fault> {
        Computer::load(self, image)
    }

    fn load_at(&mut self, at: u16, bytes: &[u8], start: Option<u16>) -> Result<(), Fault> {
        Computer::load_at(self, at, bytes, start)
    }

    fn draws_apart(&self) -> bool {
        B::DRAWS_APART
    }

    fn peek(&self, address: u16) -> u8 {
        Computer::peek(self, address)
    }

    fn plug(&mut self, keyboard: Keyboard) -> bool {
        self.board.plug(keyboard)
    }

    fn unplug(&mut self) -> Option<Keyboard> {
        self.board.unplug()
    }

    fn run(&mut self, limit: u64, watch: Watch<'_>) -> Run {
        Computer::run(self, limit, watch)
    }

    fn charges(&mut self, limit: u64, roles: Roles<'_>, watch: Watch<'_>) -> (Run, Charges) {
        Computer::charges(self, limit, roles, watch)
    }
}

/// The routine that the processor is about to begin returns at once to who called it.
pub(super) fn return_from(cpu: &mut Cpu, ram: &[u8; 0x1_0000]) {
    let byte = |n: u8| ram[0x100 | usize::from(cpu.sp.wrapping_add(n))];
    let back = u16::from_le_bytes([byte(1), byte(2)]);
    cpu.sp = cpu.sp.wrapping_add(2);
    cpu.pc = back.wrapping_add(1);
}
