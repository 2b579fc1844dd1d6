//! Keys of a BBC Micro in machine code: OSRDCH, and INKEY by OSBYTE 129.

use super::{Cpu, Micro};
use crate::Stop;
use crate::bbc::cost;
use crate::bbc::keyboard::{FRAME, code, is_held};
use crate::keys::{Keyboard, Next, Seen, Unit, never};
use crate::mos6502::computer::Board;
use crate::mos6502::cpu::flag;

impl Micro {
    /// Plays the keyboard, which is taken out for as long: it looks at the screen.
    fn with_keyboard<T>(
        &mut self,
        play: impl FnOnce(&mut Keyboard, u64, &Micro) -> T,
    ) -> Option<T> {
        let mut keyboard = self.keyboard.take()?;
        let frame = cost::with_interrupts(self.cycles) / FRAME;
        let played = play(&mut keyboard, frame, self);
        self.keyboard = Some(keyboard);
        Some(played)
    }

    /// OSRDCH: waits for a key; its code in A, C clear.
    pub(super) fn read_key(&mut self, cpu: &mut Cpu) {
        while self.stop.is_none() {
            let next =
                self.with_keyboard(|keys, frame, micro| keys.wait(frame, "", || micro.screen()));
            match next {
                Some(Next::Key(key, frames)) => {
                    self.cycles += cost::without_interrupts(frames * FRAME);
                    if let Some(code) = code(key) {
                        cpu.a = code;
                        set_carry(cpu, false);
                        return;
                    }
                }
                Some(Next::Never) => self.fail(never("OSRDCH")),
                Some(Next::Quit) | None => {
                    self.stop.get_or_insert(Stop::Ended);
                }
            }
        }
    }

    /// OSBYTE 129: with Y up to 127 a key within X + 256 Y hundredths of a second, its code in
    /// X and C clear, or Y 255 and C set; else whether the key of the number X is held.
    pub(super) fn inkey(&mut self, cpu: &mut Cpu) {
        if cpu.y >= 128 {
            let seen = self.with_keyboard(|keys, frame, micro| {
                let cycles = cost::with_interrupts(micro.cycles);
                keys.remember(cycles, || {
                    micro.ram.iter().map(|byte| i16::from(*byte)).collect()
                });
                keys.look(frame, || micro.screen())
            });
            let held = seen.is_some_and(|seen| self.goes_on(seen) && is_held(seen, !cpu.x));
            (cpu.x, cpu.y) = if held { (255, 255) } else { (0, 0) };
            return set_carry(cpu, false);
        }
        let hundredths = u64::from(u16::from_le_bytes([cpu.x, cpu.y]));
        let end = self.cycles + hundredths * FRAME / 2;
        while self.stop.is_none() {
            let seen = self.with_keyboard(|keys, frame, micro| {
                (keys.take(frame, || micro.screen()), frame, keys.unit())
            });
            let Some((seen, frame, unit)) = seen else {
                break;
            };
            if let (true, Seen::Key(key)) = (self.goes_on(seen), seen)
                && let Some(code) = code(key)
            {
                (cpu.x, cpu.y) = (code, 0);
                return set_carry(cpu, false);
            }
            let next = cost::without_interrupts((frame + 1) * FRAME) + 1;
            if unit == Unit::Calls || next > end {
                break;
            }
            self.cycles = next.max(self.cycles);
        }
        self.cycles = end.max(self.cycles);
        cpu.y = 255;
        set_carry(cpu, true);
    }

    /// Ends the run where the script says so.
    fn goes_on(&mut self, seen: Seen) -> bool {
        if seen == Seen::Quit {
            self.stop.get_or_insert(Stop::Ended);
        }
        seen != Seen::Quit
    }
}

fn set_carry(cpu: &mut Cpu, set: bool) {
    let carry = if set { flag::C } else { 0 };
    cpu.set_status(cpu.status() & !flag::C | carry);
}
