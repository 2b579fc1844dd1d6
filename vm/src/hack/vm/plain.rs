//! The plain engine: one command a step, everything checked. What a command
//! means is what it does here; the fused engine is held to it.

use super::command::Place;
use super::command::{ARG, CONSTANTS, Command, FRAME, HEAP, KEYBOARD, LCL, RAM_MASK};
use super::command::{SP, STACK, THAT, THIS};
use super::fuse::Fused;
use super::machine::{EFFORT_LIMIT, Machine};
use super::os::{self, Native, Trap};

/// The return sites that are not commands.
pub(super) const SITE_END: u16 = 0;
pub(super) const SITE_ERROR: u16 = 1;

impl Machine<'_> {
    /// Steps until `until` commands have been executed, or to a command
    /// where `fused` can take over.
    pub(super) fn plain(&mut self, until: u64, fused: Option<&Fused>) -> Result<(), Trap> {
        while self.count < until && self.os.effort < EFFORT_LIMIT {
            self.step()?;
            if let Some(fused) = fused
                && (self.os.odd || fused.entry(self.at).is_some())
            {
                break;
            }
        }
        Ok(())
    }

    /// Executes one command. After an error the command is still the next
    /// one, though it is counted.
    pub(super) fn step(&mut self) -> Result<(), Trap> {
        let at = self.at;
        let Some(command) = self.program.commands.get(at as usize) else {
            return Err(Trap::Fault("the program has run away".to_owned()));
        };
        self.count += 1;
        let mut next = at + 1;
        match *command {
            Command::Push(place) => {
                let address = self.address(place)?;
                if address == KEYBOARD {
                    self.told(at);
                    os::keyboard::look(&mut self.memory, &mut self.os)?;
                }
                self.push(self.memory[usize::from(address)])?;
            }
            Command::Pop(place) => {
                let value = self.pop()?;
                let address = self.address(place)?;
                if place.is_field() {
                    self.os.store(&mut self.memory, address, value);
                } else {
                    self.memory[usize::from(address)] = value;
                }
            }
            Command::Binary(binary) => {
                let y = self.pop()?;
                let x = self.pop()?;
                self.push(binary.apply(x, y))?;
            }
            Command::Neg => {
                let x = self.pop()?;
                self.push(x.wrapping_neg())?;
            }
            Command::Not => {
                let x = self.pop()?;
                self.push(!x)?;
            }
            Command::Goto(target) if target == at => {
                // An empty endless loop: nothing will ever change again.
                return Err(Trap::Halt);
            }
            Command::Goto(target) => next = target,
            Command::IfGoto(target) => {
                if self.pop()? != 0 {
                    next = target;
                }
            }
            Command::Call {
                function,
                arguments,
                site,
            } => next = self.enter(function, arguments, site)?,
            Command::Native(native) => self.native(native)?,
            Command::Function { locals } => {
                for _ in 0..locals {
                    self.push(0)?;
                }
            }
            Command::Return if self.program.bare => return Err(Trap::Halt),
            Command::Return => next = self.leave()?,
            Command::FunctionEnd => {
                self.count -= 1;
                if self.program.bare {
                    return Err(Trap::Halt);
                }
                return Err(Trap::Fault(format!(
                    "{} has come to its end without a return",
                    self.function()
                )));
            }
        }
        self.at = next;
        Ok(())
    }

    /// The address of an operand.
    fn address(&self, place: Place) -> Result<u16, Trap> {
        if place.base == CONSTANTS {
            Ok(place.offset)
        } else {
            os::inside(self.memory[usize::from(place.base)].wrapping_add(place.offset))
        }
    }

    fn push(&mut self, value: u16) -> Result<(), Trap> {
        let sp = self.memory[usize::from(SP)];
        if sp >= HEAP {
            return Err(Trap::Fault(format!(
                "stack overflow in {}: the stack ends at {}",
                self.function(),
                HEAP - 1
            )));
        }
        if sp < STACK {
            return Err(self.underflow());
        }
        self.memory[usize::from(sp)] = value;
        self.memory[usize::from(SP)] = sp + 1;
        Ok(())
    }

    fn pop(&mut self) -> Result<u16, Trap> {
        let sp = self.memory[usize::from(SP)];
        if sp <= STACK || sp > HEAP {
            return Err(self.underflow());
        }
        self.memory[usize::from(SP)] = sp - 1;
        Ok(self.memory[usize::from(sp - 1)])
    }

    fn underflow(&self) -> Trap {
        let sp = self.memory[usize::from(SP)];
        Trap::Fault(format!(
            "stack underflow in {}: SP is {sp}, and the stack starts at {STACK}",
            self.function()
        ))
    }

    /// Calls a function of the program: saves the frame, answers where it starts.
    fn enter(&mut self, function: u32, arguments: u16, site: u16) -> Result<u32, Trap> {
        let first = self.memory[usize::from(SP)].wrapping_sub(arguments);
        if !(STACK..=HEAP).contains(&first) {
            return Err(self.underflow());
        }
        self.push(site)?;
        for cell in [LCL, ARG, THIS, THAT] {
            self.push(self.memory[usize::from(cell)])?;
        }
        let sp = self.memory[usize::from(SP)];
        self.memory[usize::from(ARG)] = first;
        self.memory[usize::from(LCL)] = sp;
        if let Some(fused) = &self.program.fused
            && sp > fused.room(function)
        {
            // The fused engine counts on room for all that the function pushes.
            self.os.odd = true;
        }
        let callee = self.program.functions.get(function as usize);
        Ok(callee.map_or(u32::MAX, |callee| callee.start))
    }

    /// Returns from a function: answers where to.
    fn leave(&mut self) -> Result<u32, Trap> {
        let frame = self.memory[usize::from(LCL)];
        let saved = |memory: &super::command::Memory, back: u16| {
            memory[usize::from(frame.wrapping_sub(back) & RAM_MASK)]
        };
        let site = saved(&self.memory, FRAME);
        let value = self.pop()?;
        let argument = self.memory[usize::from(ARG)];
        self.memory[usize::from(argument & RAM_MASK)] = value;
        for (back, cell) in [(1, THAT), (2, THIS), (3, ARG), (4, LCL)] {
            self.memory[usize::from(cell)] = saved(&self.memory, back);
        }
        self.memory[usize::from(SP)] = (argument & RAM_MASK) + 1;
        match (site, self.program.sites.get(usize::from(site))) {
            (SITE_END, _) => Err(Trap::Halt),
            (SITE_ERROR, _) => Err(Trap::Fault(
                "Sys.error returned, but what failed cannot go on".to_owned(),
            )),
            (_, Some(next)) => Ok(*next),
            (_, None) => Err(Trap::Fault(format!(
                "{} returns to nowhere: its frame was overwritten",
                self.function()
            ))),
        }
    }

    /// Tells the operating system where the program is.
    fn told(&mut self, at: u32) {
        self.os.now = self.count;
        // The fused engine has numbers of its own.
        self.os.place = u64::from(at) | 1 << 32;
    }

    /// Calls a native function, with its arguments on the stack.
    fn native(&mut self, native: Native) -> Result<(), Trap> {
        let sp = self.memory[usize::from(SP)];
        let first = sp.wrapping_sub(native.arguments());
        if !(STACK..=HEAP).contains(&first) || sp > HEAP {
            return Err(self.underflow());
        }
        self.told(self.at);
        let result = os::call(native, &mut self.memory, &mut self.os)?;
        // A native function may have moved SP by a poke; its result goes
        // where the call's arguments were all the same.
        self.memory[usize::from(SP)] = first;
        self.push(result)
    }

    /// Calls the program's own `Sys.error` for a native function that gave up.
    pub(super) fn enter_error(&mut self, function: u32, number: u16) -> Result<(), Trap> {
        self.push(number)?;
        // The height is no longer what the fused engine expects after the call.
        self.os.odd = true;
        self.at = self.enter(function, 1, SITE_ERROR)?;
        Ok(())
    }
}
