//! The Hack CPU (*The Elements of Computing Systems*, chapters 4 and 5) on an
//! image of its ROM.
//!
//! ```
//! use slowlight_vm::hack::{asm::assemble, cpu::Cpu};
//! let program = assemble("@6\nD=A\n@7\nD=D+A\n@R0\nM=D\n(END)\n@END\n0;JMP")?;
//! let mut cpu = Cpu::new(&program.words).map_err(|fault| vec![fault])?;
//! let run = cpu.run(1_000, &mut |_| true);
//! assert_eq!(run.cycles, 6);
//! assert_eq!(cpu.peek(0), 13);
//! # Ok::<(), Vec<slowlight_vm::Fault>>(())
//! ```
//!
//! The RAM has 32,768 words, zero at first: the screen from 16384, the keyboard
//! at 24576. Nothing is said by the book of what lies above; here it is memory
//! like any other. Addresses are A without its highest bit. An instruction takes
//! one cycle.
//!
//! A run ends at a loop of two instructions that does nothing, `(END) @END 0;JMP`,
//! which is how programs of this computer stop; its own cycles are not counted.
//! Running past the last instruction of the image is a fault.
//!
//! # How it is fast
//!
//! Each address of the ROM has an operation ([`ops`]) made in advance of the
//! instructions from there, up to six of them: the runs that programs are mostly
//! made of, such as `@x D=M @y D=D+M @z M=D`. The [`plain`] engine decodes each
//! word as it goes and defines what it does; the fast one is held to it, and
//! leaves it the last cycles before a limit.

mod fast;
mod ops;
mod plain;
#[cfg(test)]
mod tests;

use super::asm::{ROM_WORDS, overflow};
use super::keyboard::{CPU_FRAME, code};
use super::screen::screen;
use crate::keys::{Keyboard, Seen, Still, never};
use crate::{Fault, Progress, Screen, Stop, Watch};
use fast::Exit;
use ops::Op;
use plain::Registers;

/// How many cycles lie between two calls of the watcher.
const WATCH_EVERY: u64 = 50_000_000;

/// Cycles by which the plain engine takes its turn to see whether a program waits for a key.
const PROBE: u64 = 1 << 16;

/// Words of the RAM.
const RAM_WORDS: usize = 0x8000;

/// The bits of an address.
const ADDRESS: u16 = 0x7fff;

/// Where the screen and the keyboard are.
const SCREEN: usize = 16_384;
const KEYBOARD: usize = 24_576;

type Memory = [u16; RAM_WORDS];
type Ops = [Op; ROM_WORDS];

/// A CPU with its ROM and RAM.
#[derive(Clone, Debug)]
pub struct Cpu {
    rom: Vec<u16>,
    ops: Box<Ops>,
    memory: Box<Memory>,
    registers: Registers,
    /// Cycles so far.
    count: u64,
    stopped: Option<Stop>,
    keyboard: Option<Box<Keyboard>>,
    still: Still<u16>,
    /// The screen when the watcher was last called, and the row that changed last.
    seen: Vec<u16>,
    row: Option<u32>,
}

/// What a run did.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// Why it ended.
    pub stop: Stop,
    /// Instructions executed since the CPU was made.
    pub cycles: u64,
    /// 512 x 256; ink 0 is black (the bit set), ink 1 white.
    pub screen: Screen,
}

impl Cpu {
    /// A CPU about to execute the first word of an image.
    ///
    /// # Errors
    /// The image is larger than the ROM.
    pub fn new(rom: &[u16]) -> Result<Cpu, Fault> {
        if let Some(message) = overflow(rom.len()) {
            return Err(fault(message));
        }
        Ok(Cpu {
            rom: rom.to_vec(),
            ops: ops::join(rom),
            memory: Box::new([0; RAM_WORDS]),
            registers: Registers::default(),
            count: 0,
            stopped: None,
            keyboard: None,
            still: Still::default(),
            seen: vec![0; KEYBOARD - SCREEN],
            row: None,
        })
    }

    /// Runs until the program ends or `limit` cycles have passed in all. After
    /// [`Stop::CycleLimit`] and [`Stop::Interrupted`] a further call goes on
    /// where this one stopped.
    pub fn run(&mut self, limit: u64, watch: Watch) -> Run {
        self.run_on(limit, watch, Cpu::go_fast)
    }

    /// The same, by the engine that decodes as it goes: what the other is
    /// measured against.
    pub fn run_plain(&mut self, limit: u64, watch: Watch) -> Run {
        self.run_on(limit, watch, Cpu::go_plain)
    }

    /// The word at an address of the RAM (the address is taken modulo 32,768), signed.
    pub fn peek(&self, address: u16) -> i16 {
        self.memory[usize::from(address & ADDRESS)].cast_signed()
    }

    /// Presses a key, by its code in the book's table; 0 lets it go.
    pub fn press(&mut self, key: u16) {
        self.memory[KEYBOARD] = key;
    }

    /// Gives the computer a keyboard, whose keys come by calls or by frames of 144,000
    /// cycles. A call is a read of the keyboard's word.
    pub fn plug(&mut self, keyboard: Keyboard) {
        self.keyboard = Some(Box::new(keyboard));
        self.still = Still::default();
    }

    /// Takes the keyboard away again.
    pub fn unplug(&mut self) -> Option<Keyboard> {
        self.keyboard.take().map(|keyboard| *keyboard)
    }

    /// The program is about to read the keyboard's word.
    #[cold]
    fn look(&mut self) -> Option<Exit> {
        let keyboard = self.keyboard.as_mut()?;
        let memory = &self.memory;
        let shown = || Some(screen(memory.get(SCREEN..KEYBOARD).unwrap_or(&[])));
        let word = match keyboard.look(self.count / CPU_FRAME, shown) {
            Seen::Nothing => 0,
            Seen::Key(key) => code(key),
            Seen::Quit => return Some(Exit::Ended),
        };
        self.memory[KEYBOARD] = word;
        let Registers { a, d, at } = self.registers;
        let place = [a, d, at]
            .iter()
            .fold(0, |all, n| all << 16 | u64::from(*n));
        let waits = keyboard.is_over() && self.still.again(place, self.memory.as_slice());
        waits.then_some(Exit::Waits)
    }

    fn run_on(&mut self, limit: u64, watch: Watch, go: fn(&mut Cpu, u64) -> Exit) -> Run {
        let stop = match &self.stopped {
            Some(stop) => stop.clone(),
            None => self.watched(limit, watch, go),
        };
        if matches!(stop, Stop::Ended | Stop::Fault(_)) {
            self.stopped = Some(stop.clone());
        }
        Run {
            stop,
            cycles: self.count,
            screen: screen(self.screen_words()),
        }
    }

    fn watched(&mut self, limit: u64, watch: Watch, go: fn(&mut Cpu, u64) -> Exit) -> Stop {
        // Only the plain engine looks at keys. Where none is ever pressed, it need not do
        // so but now and then, to find out whether the program waits for one.
        let (plain, scripted) = (
            Cpu::go_plain as fn(&mut Cpu, u64) -> Exit,
            self.is_scripted(),
        );
        let mut turns = [(go, WATCH_EVERY), (plain, PROBE)];
        if scripted {
            turns = [(plain, WATCH_EVERY); 2];
        }
        let count = 1 + usize::from(self.keyboard.is_some());
        for (go, cycles) in turns.into_iter().take(count).cycle() {
            let pause = limit.min(self.count.saturating_add(cycles));
            match go(self, pause) {
                Exit::Ended => return Stop::Ended,
                Exit::Waits => return Stop::Fault(fault(never("the program"))),
                Exit::Away => {
                    let last = self.rom.len().saturating_sub(1);
                    let message = format!(
                        "the program has no instruction {}: its last is {last}",
                        self.registers.at
                    );
                    return Stop::Fault(fault(message));
                }
                Exit::Pause if self.count >= limit => return Stop::CycleLimit,
                Exit::Pause => {}
            }
            self.find_row();
            let progress = Progress {
                cycles: self.count,
                row: self.row,
                screen: &|| Some(screen(self.screen_words())),
            };
            if !watch(progress) {
                break;
            }
        }
        Stop::Interrupted
    }

    fn is_scripted(&self) -> bool {
        let keyboard = self.keyboard.as_ref();
        keyboard.is_some_and(|keyboard| keyboard.is_scripted())
    }

    fn screen_words(&self) -> &[u16] {
        self.memory.get(SCREEN..KEYBOARD).unwrap_or(&[])
    }

    /// Stores are not watched: the row is the last one that has changed since
    /// the last call.
    fn find_row(&mut self) {
        let now = self.memory.get(SCREEN..KEYBOARD).unwrap_or(&[]);
        let changed = now.iter().zip(&self.seen).rposition(|(a, b)| a != b);
        if let Some(word) = changed {
            self.row = Some(word as u32 / 32);
            self.seen.copy_from_slice(now);
        }
    }
}

fn fault(message: String) -> Fault {
    Fault {
        message,
        file: None,
        line: None,
        column: None,
    }
}
