//! Boards: what is around a 6502.

use super::File;
use super::dfs::{self, DISC_PAGE};
use slowlight_vm::mos6502::{Bbc, C64, Dialect, Machine, Plain, Vcs};

/// Where the first bank of a VCS's cartridge is, and how long each is.
const CARTRIDGE: u16 = 0x1000;
const BANK: usize = 0x1000;

/// Which machine, how its assembly is written, and where binaries lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Config {
    /// The machine.
    pub board: Board,
    /// How assembly is written.
    pub dialect: Dialect,
    /// Where a binary is loaded, where it does not say so itself.
    pub at: Option<u16>,
    /// Where the program begins, if not where the machine would begin it.
    pub start: Option<u16>,
}

/// What is around the processor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Board {
    /// Memory, and ports that draw.
    #[default]
    Plain,
    /// A BBC Micro.
    Bbc,
    /// A Commodore 64.
    C64,
    /// An Atari VCS.
    Vcs,
}

impl Board {
    pub(super) fn machine(self) -> Box<dyn Machine> {
        match self {
            Board::Plain => Box::new(Plain::new()),
            Board::Bbc => Box::new(Bbc::new()),
            Board::C64 => Box::new(C64::new()),
            Board::Vcs => Box::new(Vcs::new()),
        }
    }

    /// Assembled code as it is loaded, its load address first.
    /// A program for a lower place in a BBC Micro is loaded where the disc leaves memory.
    pub(super) fn loaded(self, image: &[u8]) -> Vec<u8> {
        let [lo, hi, bytes @ ..] = image else {
            return image.to_vec();
        };
        let at = u16::from_le_bytes([*lo, *hi]);
        match self {
            // Banks of 4K that stand 8K apart, as the machine's addresses repeat.
            Board::Vcs if at == CARTRIDGE && bytes.len() > BANK => {
                let banks = bytes.chunks(2 * BANK).flat_map(|two| two.iter().take(BANK));
                [*lo, *hi].into_iter().chain(banks.copied()).collect()
            }
            Board::Bbc if at < DISC_PAGE => {
                let mut moved = DISC_PAGE.to_le_bytes().to_vec();
                moved.extend(bytes);
                moved
            }
            _ => image.to_vec(),
        }
    }

    /// The files that a machine is given: the binary, a disc.
    pub(super) fn files(self, stem: &str, image: Vec<u8>) -> Vec<File> {
        let named = |extension: &str, bytes| File {
            name: format!("{stem}.{extension}"),
            bytes,
        };
        let mut loaded = self.loaded(&image);
        if self == Board::Vcs {
            // A cartridge says nowhere where it lies.
            return vec![named("a26", loaded.split_off(2.min(loaded.len())))];
        }
        let disc = match self {
            Board::Bbc => dfs::bootable_code(stem, &loaded),
            Board::Plain | Board::C64 | Board::Vcs => None,
        };
        let mut files = vec![named("prg", loaded)];
        files.extend(disc.map(|bytes| named("ssd", bytes)));
        files
    }
}
