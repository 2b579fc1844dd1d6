//! The TIA's picture: playfield, colours, blanking, and where the beam is.
//!
//! A line is 228 colour clocks, three to a cycle of the processor: 68 in which nothing is
//! seen, and 160 of picture. A store takes effect where its cycle ends; PF0, PF1 and PF2
//! two clocks later, VBLANK one. The playfield's 20 bits, PF0 from bit 4 up, PF1 from bit 7
//! down and PF2 from bit 0 up, are four clocks wide each, and one is taken at the first of
//! its four clocks; behind the line's middle come the same again, or the other way round
//! where CTRLPF says so in bit 0, which is asked for at the line's first clock and at the
//! last before its middle. Bit 1 of CTRLPF gives the playfield the players' colours, a half
//! of the line each, unless bit 2 gives it priority.

use super::television::{COLUMNS, Television};

/// Waits for the end of the line.
pub const WSYNC: u16 = 0x02;

const VSYNC: u16 = 0x00;
const VBLANK: u16 = 0x01;
const RSYNC: u16 = 0x03;
const COLUP0: u16 = 0x06;
const COLUBK: u16 = 0x09;
const CTRLPF: u16 = 0x0A;
const PF0: u16 = 0x0D;
const PF2: u16 = 0x0F;

/// Clocks of a line, and those at its start in which nothing is seen.
const LINE: u64 = 228;
const BLANK: u64 = 68;
/// Clocks before the line's end at which RSYNC puts the beam.
const RESYNC: u64 = 3;

/// The chip.
#[derive(Clone, Debug)]
pub struct Tia {
    /// What is shown.
    pub television: Television,
    /// What a program has made visible that is not there.
    pub unseen: Option<&'static str>,
    /// Players 0 and 1, playfield, background.
    colours: [u8; 4],
    /// The playfield from left to right, its first bit the lowest.
    bits: u32,
    control: u8,
    /// Whether the right half is the left one the other way round.
    mirrored: bool,
    /// Whether the bit of the playfield that is drawn is set.
    set: bool,
    sync: bool,
    blanked: bool,
    /// Whether the button is held, and was since the latch was opened, where there is one.
    fire: bool,
    latch: Option<bool>,
    /// The clock up to which all is drawn, and which of its line that is.
    drawn: u64,
    beam: u64,
    line: [u8; COLUMNS],
}

impl Default for Tia {
    fn default() -> Self {
        Tia {
            television: Television::default(),
            unseen: None,
            colours: [0; 4],
            bits: 0,
            control: 0,
            mirrored: false,
            set: false,
            sync: false,
            blanked: false,
            fire: false,
            latch: None,
            drawn: 0,
            beam: 0,
            line: [0; COLUMNS],
        }
    }
}

impl Tia {
    /// The bits that it drives of a register that is read.
    pub fn read(&self, address: u16) -> u8 {
        match address & 15 {
            // Fire: 0 where it is held.
            0x0C => u8::from(!self.latch.unwrap_or(self.fire)) << 7,
            0x0D => 0x80,
            _ => 0,
        }
    }

    /// The button is held, or let go.
    pub fn fire(&mut self, held: bool) {
        self.fire = held;
        self.latch = self.latch.map(|latched| latched || held);
    }

    /// The clock at which the line begins that the beam, which is at clock `now`, comes to next
    /// or is at the start of. Up to two clocks more may have been drawn by then, of a store that
    /// takes effect late.
    pub fn next_line(&mut self, now: u64) -> u64 {
        self.draw_to(now);
        let beam = self.beam + LINE - self.drawn.saturating_sub(now);
        now + (2 * LINE - beam) % LINE
    }

    /// What is wrong with the frames where a run is stopped at clock `now`; lines that have not
    /// been drawn by then are only counted.
    pub fn late(&self, now: u64) -> Option<String> {
        let missing = now.saturating_sub(self.drawn) / LINE;
        self.television.late(now / LINE, missing)
    }

    /// A store whose cycle ends before clock `now`; says whether a frame begins with it.
    pub fn store(&mut self, register: u16, value: u8, now: u64) -> bool {
        let delay = match register {
            PF0..=PF2 => 2,
            VBLANK => 1,
            _ => 0,
        };
        self.draw_to(now + delay);
        match register {
            VSYNC => {
                let begins = !self.sync && value & 2 != 0;
                self.sync = value & 2 != 0;
                if begins {
                    self.television.begin();
                }
                return begins;
            }
            VBLANK => {
                self.blanked = value & 2 != 0;
                self.latch = match value & 0x40 {
                    0 => None,
                    _ => Some(self.latch.unwrap_or(self.fire)),
                };
            }
            RSYNC => {
                let column = self.column();
                self.line[column..].fill(0);
                self.beam = LINE - RESYNC;
            }
            COLUP0..=COLUBK => self.colours[usize::from(register - COLUP0)] = value & 0xFE,
            CTRLPF => self.control = value,
            PF0..=PF2 => self.set_bits(register, value),
            0x1B | 0x1C if value != 0 => self.unseen = Some("a player"),
            0x1D | 0x1E if value & 2 != 0 => self.unseen = Some("a missile"),
            0x1F if value & 2 != 0 => self.unseen = Some("the ball"),
            _ => {}
        }
        false
    }

    fn set_bits(&mut self, register: u16, value: u8) {
        let (shift, mask, bits) = match register {
            PF0 => (0, 0xF, value >> 4),
            PF2 => (12, 0xFF, value),
            _ => (4, 0xFF, value.reverse_bits()),
        };
        self.bits = self.bits & !(mask << shift) | u32::from(bits) << shift;
    }

    /// The column that is drawn next; behind the last one there is none.
    fn column(&self) -> usize {
        let clock = self.beam.saturating_sub(BLANK);
        usize::try_from(clock).map_or(COLUMNS, |x| x.min(COLUMNS))
    }

    /// Draws up to a clock.
    pub fn draw_to(&mut self, now: u64) {
        while self.drawn < now {
            if self.beam < BLANK {
                let clocks = (BLANK - self.beam).min(now - self.drawn);
                self.drawn += clocks;
                self.beam += clocks;
                continue;
            }
            self.pixel(self.column());
            self.drawn += 1;
            self.beam += 1;
            if self.beam == LINE {
                self.beam = 0;
                self.television.line(&self.line);
            }
        }
    }

    fn pixel(&mut self, x: usize) {
        const HALF: usize = COLUMNS / 2;
        if x == 0 || x == HALF - 1 {
            self.mirrored = self.control & 1 != 0;
        }
        if x.is_multiple_of(4) {
            let bit = match x / 4 {
                left if x < HALF => left,
                right if self.mirrored => 39 - right,
                right => right - 20,
            };
            self.set = self.bits >> bit & 1 != 0;
        }
        let colour = match (self.set, self.control & 6) {
            (false, _) => self.colours[3],
            (true, 2) => self.colours[usize::from(x >= HALF)],
            (true, _) => self.colours[2],
        };
        if let Some(pixel) = self.line.get_mut(x) {
            *pixel = if self.blanked { 0 } else { colour };
        }
    }
}
