//! The RIOT (MOS 6532): 128 bytes of RAM, an interval timer, and two ports.
//!
//! A store to TIM1T ($294), TIM8T, TIM64T or TIM1024T ($297) starts the timer: the cycle after
//! it INTIM ($284) is one less, and from then on one less every 1, 8, 64 or 1,024 cycles.
//! Where it goes below 0 it is 255, the flag in bit 7 of $285 is set, and it goes on by one a
//! cycle, until INTIM is read in another cycle than that in which it reached 255: that clears
//! the flag, and the timer goes on by its interval.
//!
//! SWCHA ($280) reads the joysticks, a bit 0 where a direction is held, and SWCHB ($282) the
//! switches: nothing pressed, colour, both difficulties B. The bits that SWACNT and SWBCNT
//! make outputs read what was stored to them, where nobody pulls them down.

/// The chip.
#[derive(Clone, Debug)]
pub struct Riot {
    /// Its RAM.
    pub ram: [u8; 0x80],
    /// What the joysticks pull down is 0.
    pub stick: u8,
    /// What is stored to the ports, and which of their bits are outputs.
    out: [u8; 2],
    outputs: [u8; 2],
    timer: u8,
    /// Cycles of the interval that have passed, and how long it is.
    part: u64,
    interval: u64,
    flag: bool,
    /// Whether the timer reached 255 in the cycle up to which it was followed.
    wrapped: bool,
    /// The cycle up to which it was followed.
    until: u64,
}

/// What SWCHB reads where nobody touches a switch: 0 in the bits of the two difficulties.
const SWITCHES: u8 = 0x3F;

impl Default for Riot {
    fn default() -> Self {
        Riot {
            ram: [0; 0x80],
            stick: 0xFF,
            out: [0; 2],
            outputs: [0; 2],
            timer: 0,
            part: 0,
            interval: 1024,
            flag: false,
            wrapped: false,
            until: 0,
        }
    }
}

impl Riot {
    /// What a read gives that ends with cycle `now`.
    #[inline(always)]
    pub fn read(&mut self, address: u16, now: u64) -> u8 {
        if address & 0x200 == 0 {
            return self.ram[usize::from(address & 0x7F)];
        }
        self.port(address, now)
    }

    /// A store that ends with cycle `now`.
    #[inline(always)]
    pub fn write(&mut self, address: u16, value: u8, now: u64) {
        if address & 0x200 == 0 {
            self.ram[usize::from(address & 0x7F)] = value;
        } else {
            self.set(address, value, now);
        }
    }

    #[cold]
    fn port(&mut self, address: u16, now: u64) -> u8 {
        self.follow(now);
        match address & 7 {
            0 => (self.out[0] | !self.outputs[0]) & self.stick,
            2 => (self.out[1] | !self.outputs[1]) & (SWITCHES | self.outputs[1]),
            1 => self.outputs[0],
            3 => self.outputs[1],
            4 | 6 => {
                if !self.wrapped {
                    self.flag = false;
                }
                self.timer
            }
            _ => u8::from(self.flag) << 7,
        }
    }

    #[cold]
    fn set(&mut self, address: u16, value: u8, now: u64) {
        self.follow(now);
        let port = usize::from(address >> 1 & 1);
        match (address & 4 != 0, address & 1 != 0) {
            (false, false) => self.out[port] = value,
            (false, true) => self.outputs[port] = value,
            (true, _) if address & 0x10 != 0 => {
                self.timer = value;
                self.interval = [1, 8, 64, 1024][usize::from(address & 3)];
                self.part = self.interval - 1;
                if !self.wrapped {
                    self.flag = false;
                }
            }
            // Which edge of PA7 is looked for: nobody is interrupted by it.
            (true, _) => {}
        }
    }

    /// Lets the timer go on to a cycle.
    fn follow(&mut self, now: u64) {
        let mut cycles = now - self.until;
        if cycles == 0 {
            return;
        }
        self.until = now;
        self.wrapped = false;
        let passed = self.part + cycles;
        self.part = passed % self.interval;
        if !self.flag {
            let ticks = passed / self.interval;
            let timer = u64::from(self.timer);
            if ticks <= timer {
                self.timer = u8::try_from(timer - ticks).unwrap_or(0);
                return;
            }
            self.flag = true;
            self.timer = 0xFF;
            // What is left since it was 255.
            cycles = passed - (timer + 1) * self.interval;
        }
        let steps = u8::try_from(cycles % 0x100).unwrap_or(0);
        self.timer = self.timer.wrapping_sub(steps);
        self.wrapped = self.timer == 0xFF;
    }
}
