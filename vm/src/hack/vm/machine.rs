//! The machine's state, and the run that switches between the engines.

use super::command::{
    CONSTANTS, Command, FRAME, HEAP, KEYBOARD, LCL, Memory, RAM_MASK, SCREEN, SP, STACK,
};
use super::fast::Exit;
use super::link::Program;
use super::missing;
use super::os::keyboard::Keys;
use super::os::{self, Heap, Native, Os, Trap};
use super::parse::fault;
use crate::charge::{Charges, Ledger, Roles};
use crate::hack::screen::screen;
use crate::keys::Keyboard;
use crate::{Fault, Progress, Screen, Stop, Watch};

/// How many commands lie between two calls of the watcher.
const WATCH_EVERY: u64 = 10_000_000;

/// Words touched by long native calls that bring the watcher's next call forward.
pub(super) const EFFORT_LIMIT: u64 = 50_000_000;

/// SP, LCL, ARG, THIS and THAT for commands without a function: as the book's tests of
/// chapter 7 set them.
const BARE: [u16; 5] = [STACK, 300, 400, 3000, 3010];

/// A machine with a program in it.
#[derive(Clone, Debug)]
pub struct Machine<'p> {
    pub(super) program: &'p Program,
    pub(super) memory: Box<Memory>,
    pub(super) os: Os,
    /// The next command.
    pub(super) at: u32,
    /// Commands executed.
    pub(super) count: u64,
    stopped: Option<Stop>,
}

/// What a run did.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// Why it ended.
    pub stop: Stop,
    /// VM commands executed; a call of a native function is one.
    pub instructions: u64,
    /// Calls of native functions of the operating system.
    pub os_calls: u64,
    /// The same by full name, for those called at all, in alphabetic order.
    pub os_calls_by_name: Vec<(String, u64)>,
    /// 512 x 256; ink 0 is black (the bit set), ink 1 white.
    pub screen: Screen,
    /// What `Output` printed; at most about a megabyte of it.
    pub text: String,
}

impl<'p> Machine<'p> {
    /// A machine about to start the program, everything else in the RAM zero.
    pub fn new(program: &'p Program) -> Self {
        Machine::with_heap(program, Heap::default())
    }

    /// The same with another operating system's heap.
    pub fn with_heap(program: &'p Program, heap: Heap) -> Self {
        let mut memory: Box<Memory> = Box::new([0; 0x10000]);
        let (_, constants) = memory.split_at_mut(usize::from(CONSTANTS));
        for (word, value) in constants.iter_mut().zip(0..) {
            *word = value;
        }
        if program.native_heap {
            os::init(&mut memory, heap);
        }
        let bases = match program.bare {
            true => BARE,
            // As if something at return site 0 had called the function.
            false => [STACK + FRAME, STACK + FRAME, STACK, 0, 0],
        };
        for (cell, base) in (SP..).zip(bases) {
            memory[usize::from(cell)] = base;
        }
        let start = program.functions.get(program.start as usize);
        let mut os = Os::new(heap);
        os.native_heap = program.native_heap;
        if let Some(fused) = &program.fused {
            os.odd = STACK + FRAME > fused.room(program.start);
        }
        Machine {
            program,
            memory,
            os,
            at: start.map_or(0, |f| f.start + u32::from(program.bare)),
            count: 0,
            stopped: None,
        }
    }

    /// Gives the machine a keyboard, whose keys come by calls or by frames of 250,000
    /// commands, where `Sys.wait` counts a frame for 20 milliseconds. A call is a look at
    /// the keyboard: `Keyboard.keyPressed`, or a read of its word.
    pub fn plug(&mut self, keyboard: Keyboard) {
        self.os.keys = Some(Box::new(Keys::new(keyboard)));
    }

    /// Takes the keyboard away again.
    pub fn unplug(&mut self) -> Option<Keyboard> {
        self.os.keys.take().map(|keys| keys.keyboard)
    }

    /// Runs until the program ends or `limit` commands have been executed in
    /// all. After [`Stop::CycleLimit`] and [`Stop::Interrupted`] a further
    /// call goes on where this one stopped.
    pub fn run(&mut self, limit: u64, watch: Watch) -> Run {
        let stop = match &self.stopped {
            Some(stop) => stop.clone(),
            None => self.go(limit, watch),
        };
        if matches!(stop, Stop::Ended | Stop::Fault(_)) {
            self.stopped = Some(stop.clone());
        }
        self.report(stop)
    }

    /// Runs as [`Machine::run`] does, command by command, and counts what each command takes
    /// by its number in the program, where routines' are charged to the commands that call
    /// them. The charges add up to the commands of this call.
    pub fn charges(&mut self, limit: u64, roles: Roles<'_>, watch: Watch) -> (Run, Charges) {
        let mut ledger = Ledger::new(self.program.commands.len(), roles);
        let mut depth = 0;
        let mut next_watch = self.count.saturating_add(WATCH_EVERY);
        let stop = loop {
            if self.count >= limit {
                break Stop::CycleLimit;
            }
            if self.os.effort >= EFFORT_LIMIT || self.count >= next_watch {
                self.os.effort = 0;
                next_watch = self.count.saturating_add(WATCH_EVERY);
                if !self.watched(&mut *watch) {
                    break Stop::Interrupted;
                }
            }
            let (at, before) = (self.at, self.count);
            let stepped = self.step();
            ledger.step(at, depth, self.count - before, true);
            match self.program.commands.get(at as usize) {
                Some(Command::Call { .. }) => depth += 1,
                Some(Command::Return) => depth = depth.saturating_sub(1),
                _ => {}
            }
            if let Err(trap) = stepped
                && let Some(stop) = self.trap(trap)
            {
                break stop;
            }
        };
        (self.report(stop), ledger.finish())
    }

    /// The word at an address of the RAM (the address is taken modulo 32,768), signed.
    pub fn peek(&self, address: u16) -> i16 {
        self.memory[usize::from(address & RAM_MASK)].cast_signed()
    }

    /// The words on the stack, the lowest first.
    pub fn stack(&self) -> Vec<i16> {
        let top = self.memory[usize::from(SP)].min(HEAP);
        (STACK..top).map(|at| self.peek(at)).collect()
    }

    fn go(&mut self, limit: u64, watch: Watch) -> Stop {
        let fused = self.program.fused.as_ref();
        // Between two of its checks the fused engine runs less than a function.
        let margin = fused.map_or(0, |fused| fused.longest);
        let mut next_watch = self.count.saturating_add(WATCH_EVERY);
        loop {
            if self.os.effort >= EFFORT_LIMIT || self.count >= next_watch {
                self.os.effort = 0;
                next_watch = self.count.saturating_add(WATCH_EVERY);
                if !self.watched(&mut *watch) {
                    return Stop::Interrupted;
                }
            }
            if self.count >= limit {
                return Stop::CycleLimit;
            }
            let pause = next_watch.min(limit.saturating_sub(margin));
            let ready = !self.os.odd && self.count < pause;
            let entry = fused.filter(|_| ready).and_then(|f| f.entry(self.at));
            let result = match (fused, entry) {
                (Some(fused), Some(entry)) => match self.fast(fused, entry, pause) {
                    Exit::Pause => Ok(()),
                    Exit::Plain => self.step(),
                    Exit::Trap(trap) => Err(trap),
                },
                _ => self.plain(next_watch.min(limit), fused.filter(|_| ready)),
            };
            if let Err(trap) = result
                && let Some(stop) = self.trap(trap)
            {
                return stop;
            }
        }
    }

    /// Whether the watcher wants to go on.
    fn watched(&self, watch: Watch) -> bool {
        let row = |address: u16| u32::from((address - SCREEN) / 32);
        watch(Progress {
            cycles: self.count,
            row: self.os.drawn.map(row),
            screen: &|| Some(self.screen()),
        })
    }

    /// What becomes of a command that did not work; `None` if the program's
    /// own `Sys.error` has a say.
    fn trap(&mut self, trap: Trap) -> Option<Stop> {
        match trap {
            Trap::Halt => Some(Stop::Ended),
            Trap::Fault(message) => Some(Stop::Fault(self.fault(message))),
            Trap::Address(address) => {
                let function = self.function();
                let message =
                    format!("{function} uses address {address}, and the memory ends at {KEYBOARD}");
                Some(Stop::Fault(self.fault(message)))
            }
            Trap::Error(number, why) => {
                if let Some(function) = self.program.on_error {
                    return match self.enter_error(function, number) {
                        Ok(()) => None,
                        Err(Trap::Fault(message)) => Some(Stop::Fault(self.fault(message))),
                        Err(_) => Some(Stop::Ended),
                    };
                }
                if self.file() == Some(missing::FILE) {
                    return Some(Stop::Fault(self.absent()));
                }
                let function = self.function();
                let colon = if why.is_empty() { "" } else { ": " };
                let number = number.cast_signed();
                let message = format!("Sys.error({number}) in {function}{colon}{why}");
                Some(Stop::Fault(self.fault(message)))
            }
        }
    }

    /// The name of the function that the next command belongs to.
    pub(super) fn function(&self) -> &str {
        let function = self.program.function_at(self.at);
        function.map_or("(no function)", |function| &function.name)
    }

    /// The file that a command comes from, and its line there.
    fn origin(&self, at: u32) -> Option<(&str, u32)> {
        let (file, line) = self.program.origins.get(at as usize)?;
        Some((self.program.files.get(*file as usize)?, *line))
    }

    /// The file of the next command.
    fn file(&self) -> Option<&str> {
        self.origin(self.at).map(|(file, _)| file)
    }

    /// A fault of whoever called the function that the next command belongs to: there is
    /// none of that name.
    fn absent(&self) -> Fault {
        let frame = self.memory[usize::from(LCL)];
        let site = self.peek(frame.wrapping_sub(FRAME)).cast_unsigned();
        let back = self.program.sites.get(usize::from(site));
        let origin = back.and_then(|back| self.origin(back.checked_sub(1)?));
        let message = format!("there is no function {}", self.function());
        match origin {
            Some((file, line)) => fault(file, line, message),
            None => self.fault(message),
        }
    }

    /// A fault at the next command.
    fn fault(&self, message: String) -> Fault {
        match self.origin(self.at) {
            Some((file, line)) => fault(file, line, message),
            _ => Fault {
                message,
                file: None,
                line: None,
                column: None,
            },
        }
    }

    fn report(&self, stop: Stop) -> Run {
        let mut by_name: Vec<(String, u64)> = Native::ALL
            .iter()
            .zip(self.os.calls)
            .filter(|(_, count)| *count > 0)
            .map(|(native, count)| (native.name().to_owned(), count))
            .collect();
        by_name.sort();
        Run {
            stop,
            instructions: self.count,
            os_calls: self.os.calls.iter().sum(),
            os_calls_by_name: by_name,
            screen: self.screen(),
            text: self.os.text.clone(),
        }
    }

    /// What the screen shows now.
    pub fn screen(&self) -> Screen {
        let words = self.memory.get(usize::from(SCREEN)..usize::from(KEYBOARD));
        screen(words.unwrap_or(&[]))
    }
}
