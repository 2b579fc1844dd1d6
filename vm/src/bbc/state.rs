//! Everything that changes while a program runs: variables, memory, stacks, screen, files.
//!
//! Variables live in typed slots, not in the 64K of memory, so that they are quick; what they
//! would take in the machine is accounted for, in the machine's order and sizes, so that
//! `DIM P%` gives the machine's addresses and what does not fit is "No room". The resident
//! integers can also be reached at &400 by `?` and `!`, as some programs do; other variables
//! and the program's own lines cannot be changed through memory.

use std::collections::VecDeque;

use slowlight_isa::real40::Real40;

use super::ast::{Kind, Slot};
use super::data::DataPointer;
use super::display::Display;
use super::error::Error;
use super::files::Files;
use super::names::{Names, RESIDENT};
use super::profile::Profile;
use super::values::{Array, Frame, Loop, Num, Saved, Scalar, Text, Value, array_index};
use super::{Config, cost};
use crate::Stop;
use crate::keys::Keyboard;

pub(crate) struct State {
    pub config: Config,
    pub names: Names,
    pub ints: Vec<Scalar<i32>>,
    pub reals: Vec<Scalar<Real40>>,
    pub texts: Vec<Text>,
    /// Int, real and string arrays.
    pub arrays: [Vec<Option<Array>>; 3],
    pub mem: Vec<u8>,
    /// The names so far in each list of a first letter.
    pub lists: Vec<Vec<Vec<u8>>>,
    /// FNs and PROCs that have been called: their first call makes an entry in a list, and later
    /// ones cost what finding it there takes.
    pub met: [Vec<Option<u32>>; 2],
    pub page: u32,
    pub top: u32,
    pub lomem: u32,
    /// The end of the variables.
    pub heap: u32,
    /// The bottom of BASIC's stack.
    pub stack: u32,
    pub himem: u32,
    /// The lowest that stack - heap has been.
    pub least_free: u32,
    pub frames: Vec<Frame>,
    pub saved: Vec<Saved>,
    pub loops: Vec<Loop>,
    pub repeats: Vec<u32>,
    pub gosubs: Vec<u32>,
    /// Where READ goes on.
    pub data: DataPointer,
    /// TRACE tells the lines below this number.
    pub trace: u16,
    /// Lines for INPUT.
    pub typed: VecDeque<Vec<u8>>,
    pub on_error: Option<u32>,
    pub err: u8,
    pub error: Error,
    pub erl: u16,
    pub rnd: [u8; 5],
    /// Cycles at which TIME was 0 (may be negative in effect).
    pub time_base: i64,
    pub cycles: u64,
    pub plot_cycles: u64,
    pub next_check: u64,
    pub stop: Option<Stop>,
    /// What a function's `=` gave.
    pub result: Value,
    /// The op being carried out.
    pub op: u32,
    /// Host stack in use by nested FNs, in rough bytes.
    pub host: u32,
    pub text: Vec<u8>,
    pub count: u32,
    pub width: u32,
    pub display: Display,
    pub files: Files,
    /// The keyboard, where there is one.
    pub keyboard: Option<Keyboard>,
    /// Counts by line, where they are wanted.
    pub profile: Option<Box<Profile>>,
}

/// What nested functions may use of the host's stack. Past it: "No room".
pub(crate) const HOST_STACK: u32 = 1_400_000;

impl State {
    pub fn new(config: Config) -> Self {
        let page = u32::from(config.page);
        let display = Display::new(config.dialect);
        let himem = display.himem();
        let mut state = Self {
            page,
            top: page,
            lomem: page,
            heap: page,
            himem,
            stack: himem,
            least_free: himem.saturating_sub(page),
            config,
            names: Names::new(),
            ints: Vec::new(),
            reals: Vec::new(),
            texts: Vec::new(),
            arrays: Default::default(),
            mem: vec![0; 0x10000],
            lists: vec![Vec::new(); 256],
            met: Default::default(),
            frames: Vec::new(),
            saved: Vec::new(),
            loops: Vec::new(),
            repeats: Vec::new(),
            gosubs: Vec::new(),
            data: DataPointer::default(),
            trace: 0,
            typed: VecDeque::new(),
            on_error: None,
            err: 0,
            error: Error::Halt,
            erl: 0,
            rnd: [0x41, 0x52, 0x57, 0, 0],
            time_base: 0,
            cycles: 0,
            plot_cycles: 0,
            next_check: 0,
            stop: None,
            result: Value::Num(Num::Int(0)),
            op: 0,
            host: 0,
            text: Vec::new(),
            count: 0,
            width: 0,
            display,
            files: Files::default(),
            profile: None,
            keyboard: None,
        };
        state.fit_names();
        for v in &mut state.ints {
            v.defined = true;
        }
        if let Some(at) = state.ints.get_mut(0) {
            at.value = 0x90a;
        }
        state
    }

    /// Makes the tables as long as the names.
    pub fn fit_names(&mut self) {
        let n = |kind| self.names.count(kind);
        let scalar = Scalar {
            value: 0,
            defined: false,
            lookup: 0,
        };
        self.ints.resize(n(Kind::Int), scalar);
        let scalar = Scalar {
            value: Real40::ZERO,
            defined: false,
            lookup: 0,
        };
        self.reals.resize(n(Kind::Real), scalar);
        self.texts.resize(n(Kind::Str), Text::default());
        for (i, kind) in [Kind::Ints, Kind::Reals, Kind::Strs]
            .into_iter()
            .enumerate()
        {
            let count = n(kind);
            self.arrays[i].resize(count, None);
        }
        for (i, kind) in [Kind::Fn, Kind::Proc].into_iter().enumerate() {
            let count = n(kind);
            self.met[i].resize(count, None);
        }
    }

    /// Puts a program's bytes at PAGE. Too long a program does not fit.
    pub fn place_program(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let start = self.page as usize;
        let room = self
            .mem
            .get_mut(start..start + bytes.len())
            .ok_or(Error::NoRoom)?;
        room.copy_from_slice(bytes);
        self.top = self.page + bytes.len() as u32;
        self.lomem = self.top;
        self.heap = self.top;
        if self.heap > self.himem {
            return Err(Error::NoRoom);
        }
        self.least_free = self.stack - self.heap;
        Ok(())
    }

    /// CLEAR: no variables but the resident ones.
    pub fn clear(&mut self) {
        for v in self.ints.iter_mut().skip(RESIDENT) {
            v.defined = false;
            v.value = 0;
        }
        for v in &mut self.reals {
            v.defined = false;
            v.value = Real40::ZERO;
        }
        self.texts.fill(Text::default());
        for a in &mut self.arrays {
            a.fill(None);
        }
        for m in &mut self.met {
            m.fill(None);
        }
        self.lists.fill(Vec::new());
        self.heap = self.lomem;
        self.unwind();
        self.data = DataPointer::default();
    }

    /// Empties all stacks, as an error does.
    pub fn unwind(&mut self) {
        self.frames.clear();
        self.saved.clear();
        self.loops.clear();
        self.repeats.clear();
        self.gosubs.clear();
        self.stack = self.himem;
        self.host = 0;
    }

    fn note_free(&mut self) {
        self.least_free = self.least_free.min(self.stack - self.heap);
    }

    /// Takes memory for variables.
    pub fn allocate(&mut self, bytes: u32) -> Result<u32, Error> {
        let start = self.heap;
        if u64::from(start) + u64::from(bytes) > u64::from(self.stack) {
            return Err(Error::NoRoom);
        }
        self.heap += bytes;
        self.note_free();
        Ok(start)
    }

    /// Takes memory on BASIC's stack.
    pub fn push_stack(&mut self, bytes: u32) -> Result<(), Error> {
        if self.stack < self.heap + bytes {
            return Err(Error::NoRoom);
        }
        self.stack -= bytes;
        self.note_free();
        Ok(())
    }

    /// A new entry in the list of a name's first letter: link, rest of the name, zero, value.
    /// Answers what looking it up will cost.
    pub fn enter(&mut self, kind: Kind, slot: Slot) -> Result<u32, Error> {
        let first = self.names.name(kind, slot).first().copied().unwrap_or(0);
        let bytes = self.names.entry_bytes(kind, slot);
        self.allocate(bytes)?;
        // FNs and PROCs have lists of their own.
        let list = match kind {
            Kind::Fn => 1,
            Kind::Proc => 2,
            _ => usize::from(first),
        };
        let name = self.names.spelt(kind, slot);
        let same = |other: &Vec<u8>| {
            let pairs = other.iter().zip(&name).skip(1);
            pairs.take_while(|(a, b)| a == b).count() as u32
        };
        let before = &self.lists[list];
        let passed = before
            .iter()
            .map(|other| cost::PER_LINK + cost::PER_SAME * same(other))
            .sum();
        self.lists[list].push(name);
        self.cycles += cost::CREATE;
        Ok(passed)
    }

    /// Makes a variable exist, as assigning to it does.
    #[inline]
    pub fn define_int(&mut self, slot: Slot) -> Result<(), Error> {
        if !self.ints[slot as usize].defined {
            let lookup = self.enter(Kind::Int, slot)?;
            let v = &mut self.ints[slot as usize];
            v.lookup = lookup;
            v.defined = true;
        }
        Ok(())
    }

    /// The same for a real.
    #[inline]
    pub fn define_real(&mut self, slot: Slot) -> Result<(), Error> {
        if !self.reals[slot as usize].defined {
            let lookup = self.enter(Kind::Real, slot)?;
            let v = &mut self.reals[slot as usize];
            v.lookup = lookup;
            v.defined = true;
        }
        Ok(())
    }

    /// The same for a string.
    pub fn define_text(&mut self, slot: Slot) -> Result<(), Error> {
        if !self.texts[slot as usize].defined {
            let lookup = self.enter(Kind::Str, slot)?;
            let v = &mut self.texts[slot as usize];
            v.lookup = lookup;
            v.defined = true;
        }
        Ok(())
    }

    pub fn array(&self, kind: Kind, slot: Slot) -> Result<&Array, Error> {
        self.arrays
            .get(array_index(kind))
            .and_then(|a| a.get(slot as usize))
            .and_then(Option::as_ref)
            .ok_or(Error::Array)
    }

    pub fn array_mut(&mut self, kind: Kind, slot: Slot) -> Result<&mut Array, Error> {
        self.arrays
            .get_mut(array_index(kind))
            .and_then(|a| a.get_mut(slot as usize))
            .and_then(Option::as_mut)
            .ok_or(Error::Array)
    }

    /// A byte of memory; the resident integers show at &400.
    #[inline]
    pub fn byte(&self, address: u16) -> u8 {
        let offset = usize::from(address).wrapping_sub(0x400);
        if offset < RESIDENT * 4
            && let Some(v) = self.ints.get(offset / 4)
        {
            return v.value.to_le_bytes()[offset & 3];
        }
        self.mem[usize::from(address)]
    }

    #[inline]
    pub fn set_byte(&mut self, address: u16, byte: u8) {
        let offset = usize::from(address).wrapping_sub(0x400);
        if offset < RESIDENT * 4
            && let Some(v) = self.ints.get_mut(offset / 4)
        {
            let mut bytes = v.value.to_le_bytes();
            bytes[offset & 3] = byte;
            v.value = i32::from_le_bytes(bytes);
            return;
        }
        if u32::from(address) >= self.himem && address < 0x8000 {
            self.display.note_poke(u32::from(address));
        }
        // ROM and input/output above &8000 ignore writes here.
        if address < 0x8000 {
            self.mem[usize::from(address)] = byte;
        }
    }

    pub fn word(&self, address: u16) -> i32 {
        i32::from_le_bytes([0, 1, 2, 3].map(|i| self.byte(address.wrapping_add(i))))
    }

    pub fn set_word(&mut self, address: u16, value: i32) {
        for (i, b) in value.to_le_bytes().into_iter().enumerate() {
            self.set_byte(address.wrapping_add(i as u16), b);
        }
    }

    /// TIME, in hundredths of a second.
    pub fn time(&self) -> i32 {
        let cycles = cost::with_interrupts(self.cycles);
        ((cycles as i64 - self.time_base) / 20_000) as i32
    }
}
