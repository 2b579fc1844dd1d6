//! What an instruction reads and what it changes, after the MOS data sheet.

use super::code::{Instruction, Operand, is_branch};
use rustc_hash::FxHashMap;

/// A register, a flag, or a byte of memory that is told apart.
pub(super) type Place = usize;

pub(super) const A: Place = 0;
pub(super) const X: Place = 1;
pub(super) const Y: Place = 2;
/// The carry.
pub(super) const C: Place = 3;
/// The zero and the negative flag, which all that sets one sets.
pub(super) const NZ: Place = 4;
/// The overflow flag.
pub(super) const V: Place = 5;
/// How many these are; bytes of memory come behind them.
pub(super) const REGISTERS: usize = 6;

/// The bytes that a program's instructions name, as places: first those that have an
/// instruction to themselves, behind them those that are only met by an index or a pointer.
#[derive(Default)]
pub(super) struct Space {
    places: FxHashMap<u16, Place>,
    addresses: Vec<u16>,
    /// How each byte is written.
    names: FxHashMap<u16, String>,
    /// The registers and the first bytes.
    cells: usize,
}

/// What one instruction does.
#[derive(Clone, Debug, Default)]
pub(super) struct Effects {
    pub reads: Vec<Place>,
    pub writes: Vec<Place>,
    /// What it may change or may leave.
    pub may: Vec<Place>,
    /// It does something beside that: it writes to the screen, uses the stack, goes elsewhere.
    pub more: bool,
    /// Nothing is known of what it reads and changes.
    pub unknown: bool,
}

impl Space {
    pub fn of<'a>(code: impl Iterator<Item = &'a Instruction> + Clone) -> Space {
        let mut space = Space::default();
        for instruction in code.clone() {
            if let Operand::Cell(at, text) = &instruction.operand {
                space.add(*at);
                space.names.entry(*at).or_insert_with(|| text.clone());
            }
        }
        space.cells = space.len();
        for instruction in code {
            match &instruction.operand {
                Operand::Pointed(at, _) => (0..2).for_each(|k| space.add(at.wrapping_add(k))),
                Operand::Region(range, _) => range.clone().for_each(|at| space.add(at)),
                _ => {}
            }
        }
        space
    }

    fn add(&mut self, at: u16) {
        let next = self.len();
        self.places.entry(at).or_insert_with(|| {
            self.addresses.push(at);
            next
        });
    }

    /// How many places there are.
    pub fn len(&self) -> usize {
        REGISTERS + self.places.len()
    }

    /// How many of them it is worth to know what they hold.
    pub fn cells(&self) -> usize {
        self.cells
    }

    pub fn place(&self, at: u16) -> Option<Place> {
        self.places.get(&at).copied()
    }

    /// Where a place is in memory.
    pub fn address(&self, place: Place) -> Option<u16> {
        self.addresses.get(place.checked_sub(REGISTERS)?).copied()
    }

    /// How a byte is written.
    pub fn name(&self, at: u16) -> Option<&str> {
        self.names.get(&at).map(String::as_str)
    }

    /// The places that an operand may be, and those that say where it is.
    fn operand(&self, operand: &Operand) -> (Vec<Place>, Vec<Place>) {
        let of = |range: std::ops::Range<u16>| range.filter_map(|at| self.place(at)).collect();
        match operand {
            Operand::Cell(at, _) => (of(*at..at.saturating_add(1)), Vec::new()),
            Operand::Region(range, text) => (of(range.clone()), vec![index(text)]),
            Operand::Pointed(at, text) => {
                let mut by: Vec<Place> = of(*at..at.saturating_add(2));
                by.push(index(text));
                (Vec::new(), by)
            }
            Operand::Table(text) => (Vec::new(), vec![index(text)]),
            Operand::Other(text) if text.ends_with(",x") || text.ends_with(",y") => {
                (Vec::new(), vec![index(text)])
            }
            _ => (Vec::new(), Vec::new()),
        }
    }

    pub fn effects(&self, instruction: &Instruction) -> Effects {
        let (name, operand) = (instruction.name.as_str(), &instruction.operand);
        let (at, by) = self.operand(operand);
        let mut effects = Effects {
            reads: by,
            ..Effects::default()
        };
        let Some((reads, writes, memory)) = shape(name, operand) else {
            effects.unknown = true;
            effects.more = true;
            return effects;
        };
        effects.reads.extend(reads);
        effects.writes.extend(writes);
        let sure = matches!(operand, Operand::Cell(..));
        if matches!(memory, Memory::Read | Memory::Change) {
            effects.reads.extend(&at);
        }
        if matches!(memory, Memory::Write | Memory::Change) {
            match sure {
                true => effects.writes.extend(&at),
                false => effects.may.extend(&at),
            }
            effects.more = !sure && !matches!(operand, Operand::Region(..));
        }
        effects.more |= is_branch(name) || matches!(name, "jmp" | "jsr" | "rts");
        if let Operand::Other(text) = operand {
            // A port may be read for what that does; a plain number with an index may be
            // any byte.
            effects.more = true;
            effects.unknown = text.starts_with(['$', '(', '0', '1', '2', '3', '4', '5'])
                || text.starts_with(['6', '7', '8', '9']);
        }
        effects
    }
}

/// The register that an operand is indexed by.
fn index(text: &str) -> Place {
    if text.ends_with(",x") { X } else { Y }
}

/// What becomes of the operand.
#[derive(Clone, Copy)]
enum Memory {
    No,
    Read,
    Write,
    Change,
}

type Shape = (&'static [Place], &'static [Place], Memory);

/// Registers and flags that an instruction reads and writes, and what it does to memory; none
/// for one that is not known here.
fn shape(name: &str, operand: &Operand) -> Option<Shape> {
    let accumulator = *operand == Operand::None;
    Some(match name {
        "lda" => (&[], &[A, NZ], Memory::Read),
        "ldx" => (&[], &[X, NZ], Memory::Read),
        "ldy" => (&[], &[Y, NZ], Memory::Read),
        "sta" => (&[A], &[], Memory::Write),
        "stx" => (&[X], &[], Memory::Write),
        "sty" => (&[Y], &[], Memory::Write),
        "tax" => (&[A], &[X, NZ], Memory::No),
        "tay" => (&[A], &[Y, NZ], Memory::No),
        "txa" => (&[X], &[A, NZ], Memory::No),
        "tya" => (&[Y], &[A, NZ], Memory::No),
        "and" | "ora" | "eor" => (&[A], &[A, NZ], Memory::Read),
        "adc" | "sbc" => (&[A, C], &[A, C, NZ, V], Memory::Read),
        "cmp" => (&[A], &[C, NZ], Memory::Read),
        "cpx" => (&[X], &[C, NZ], Memory::Read),
        "cpy" => (&[Y], &[C, NZ], Memory::Read),
        "bit" => (&[A], &[NZ, V], Memory::Read),
        "asl" | "lsr" if accumulator => (&[A], &[A, C, NZ], Memory::No),
        "rol" | "ror" if accumulator => (&[A, C], &[A, C, NZ], Memory::No),
        "asl" | "lsr" => (&[], &[C, NZ], Memory::Change),
        "rol" | "ror" => (&[C], &[C, NZ], Memory::Change),
        "inc" | "dec" => (&[], &[NZ], Memory::Change),
        "inx" | "dex" => (&[X], &[X, NZ], Memory::No),
        "iny" | "dey" => (&[Y], &[Y, NZ], Memory::No),
        "clc" | "sec" => (&[], &[C], Memory::No),
        "clv" => (&[], &[V], Memory::No),
        "bcc" | "bcs" => (&[C], &[], Memory::No),
        "beq" | "bne" | "bmi" | "bpl" => (&[NZ], &[], Memory::No),
        "bvc" | "bvs" => (&[V], &[], Memory::No),
        "jmp" | "jsr" | "rts" => (&[], &[], Memory::No),
        _ => return None,
    })
}
