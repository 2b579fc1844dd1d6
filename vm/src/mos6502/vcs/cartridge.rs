//! Cartridges: up to 4K as they are, more in banks that an access to a hotspot chooses, and
//! 128 bytes of RAM in those that have the Superchip.
//!
//! | size | called | banks are chosen by an access to |
//! |---|---|---|
//! | 2K, 4K | | |
//! | 8K | F8 | $1FF8, $1FF9 |
//! | 16K | F6 | $1FF6 to $1FF9 |
//! | 32K | F4 | $1FF4 to $1FFB |
//!
//! Which bank there is when the machine is switched on is chance; here it is the last of an
//! F8 and the first of the others, as in Stella. A program that hangs on it is wrong.
//!
//! With the Superchip, $1000 to $107F store, and $1080 to $10FF read what was stored; a read
//! of the first stores what is on the data lines. Nothing in a file says that it has one: it
//! is taken for that where the first 128 bytes of every bank, which nobody can read then, are
//! the same as the second.

/// Bytes of a bank.
const BANK: usize = 0x1000;

/// A cartridge.
#[derive(Clone, Debug, Default)]
pub struct Cartridge {
    /// Whole banks.
    rom: Vec<u8>,
    /// Where the bank begins that is there.
    bank: usize,
    /// The first hotspot, and how many there are.
    spots: (u16, u16),
    ram: Option<Box<[u8; 0x80]>>,
}

impl Cartridge {
    /// Of a file's bytes.
    ///
    /// # Errors
    /// Where they are of no size that a cartridge has.
    pub fn new(bytes: &[u8]) -> Result<Cartridge, String> {
        let (spots, first) = match bytes.len() {
            0x800 | 0x1000 => ((0, 0), 0),
            0x2000 => ((0x1FF8, 2), BANK),
            0x4000 => ((0x1FF6, 4), 0),
            0x8000 => ((0x1FF4, 8), 0),
            other => {
                return Err(format!(
                    "a cartridge of {other} bytes: there are those of 2,048 and 4,096 bytes, and \
                     with banks those of 8,192 (F8), 16,384 (F6) and 32,768 (F4)"
                ));
            }
        };
        let rom = match bytes.len() {
            0x800 => bytes.repeat(2),
            _ => bytes.to_vec(),
        };
        let unread = |bank: &[u8]| bank.get(..0x80) == bank.get(0x80..0x100);
        let superchip = bytes.len() >= 0x1000 && rom.chunks(BANK).all(unread);
        Ok(Cartridge {
            rom,
            bank: first,
            spots,
            ram: superchip.then(|| Box::new([0; 0x80])),
        })
    }

    /// Whether it has the Superchip, and how many banks.
    pub fn kind(&self) -> (bool, usize) {
        (self.ram.is_some(), self.rom.len() / BANK)
    }

    /// The byte at an address, without effect.
    pub fn peek(&self, address: u16) -> u8 {
        let at = usize::from(address) & (BANK - 1);
        match &self.ram {
            Some(ram) if at < 0x100 => ram[at & 0x7F],
            _ => self.rom.get(self.bank + at).copied().unwrap_or(0),
        }
    }

    #[inline(always)]
    fn choose(&mut self, address: u16) {
        let (first, count) = self.spots;
        let spot = (address & 0x1FFF).wrapping_sub(first);
        if spot < count {
            self.bank = usize::from(spot) * BANK;
        }
    }

    /// Reads a byte while `bus` is what the data lines had before.
    #[inline(always)]
    pub fn read(&mut self, address: u16, bus: u8) -> u8 {
        self.choose(address);
        if let Some(ram) = &mut self.ram
            && address & 0xF80 == 0
        {
            ram[usize::from(address & 0x7F)] = bus;
            return bus;
        }
        self.peek(address)
    }

    /// Stores a byte: to the RAM, where there is one.
    #[inline(always)]
    pub fn write(&mut self, address: u16, value: u8) {
        self.choose(address);
        if let Some(ram) = &mut self.ram
            && address & 0xF80 == 0
        {
            ram[usize::from(address & 0x7F)] = value;
        }
    }
}
