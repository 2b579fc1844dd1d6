//! A routine in a program of its own, run again and again on the processor.

use slowlight_routine::{Format, Routine, Source};
use slowlight_vm::mos6502::assemble;
use slowlight_vm::mos6502::cpu::{Bus, Cpu, Step};

use crate::FIXED16_16 as RUNTIME;
use crate::write::{Goal, Place, instructions};

/// xorshift32.
pub struct Random(pub u32);

impl Random {
    pub fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }
}

struct Ram {
    bytes: Vec<u8>,
    cycles: u64,
}

impl Bus for Ram {
    fn read(&mut self, address: u16) -> u8 {
        self.cycles += 1;
        self.bytes[usize::from(address)]
    }
    fn write(&mut self, address: u16, value: u8) {
        self.cycles += 1;
        self.bytes[usize::from(address)] = value;
    }
}

/// The parts that are needed, each between two labels.
fn parts(names: &[&str]) -> (String, bool) {
    let mut text = String::new();
    let closure = RUNTIME.closure(names.iter().copied());
    for part in &closure {
        let source = match part.source {
            Source::Text(source) => source.to_owned(),
            Source::Table(make) => {
                let bytes: Vec<String> = make().iter().map(|b| b.to_string()).collect();
                format!("{}:\n        .byte {}", part.name, bytes.join(", "))
            }
        };
        text += &format!("begin_{0}:\n{source}\nend_{0}:\n", part.name);
    }
    (text, closure.iter().any(|p| p.name == "squares"))
}

/// Bytes of a part: its code and its tables in memory.
pub fn part_bytes(name: &str) -> u32 {
    let (text, _) = parts(&[name]);
    let program = assemble(&format!("* = $0a00\n{text}")).unwrap();
    let at = |label: &str| program.symbols[&format!("{label}_{name}")];
    let tables = if name == "squares" { 2048 } else { 0 };
    u32::try_from(at("end") - at("begin")).unwrap() + tables
}

pub struct Bench {
    ram: Ram,
    routine: Routine,
    start: u16,
    end: u16,
    /// Bytes of the use.
    pub bytes: u32,
}

const FIRST: u16 = 0x80;
const SECOND: u16 = 0x84;
const RESULT: u16 = 0x88;

impl Bench {
    /// The routine with its arguments at `places`, or all in the zero page if there are none.
    pub fn new(routine: &Routine, places: &[Place]) -> Bench {
        let zero_page = [Place::At("first".into()), Place::At("second".into())];
        let places = if places.is_empty() {
            &zero_page[..routine.args.len()]
        } else {
            places
        };
        let mut lines = Vec::new();
        instructions(routine, places, &Goal::At("result"), 1, &mut lines);
        let (parts, squares) = parts(routine.needs);
        let prepare = if squares { "jsr make_squares" } else { "" };
        let source = format!(
            "* = $0a00\nfirst = ${FIRST:02x}\nsecond = ${SECOND:02x}\nresult = ${RESULT:02x}\n{parts}
             prepare: {prepare}\nstart:\n{}\nend: nop\n",
            lines.join("\n")
        );
        let program =
            assemble(&source).unwrap_or_else(|f| panic!("{}: {}\n{source}", routine.name, f[0]));
        let at = |label: &str| u16::try_from(program.symbols[label]).unwrap();
        let mut ram = Ram {
            bytes: vec![0; 0x1_0000],
            cycles: 0,
        };
        let origin = usize::from(program.origin);
        ram.bytes[origin..origin + program.bytes.len()].copy_from_slice(&program.bytes);
        let mut bench = Bench {
            ram,
            routine: *routine,
            start: at("prepare"),
            end: at("start"),
            bytes: u32::from(at("end") - at("start")),
        };
        bench.go();
        (bench.start, bench.end) = (at("start"), at("end"));
        bench
    }

    /// Runs from `start` until `end` is reached; answers the cycles.
    fn go(&mut self) -> u64 {
        let mut cpu = Cpu::new(self.start);
        self.ram.cycles = 0;
        while cpu.pc != self.end {
            assert_eq!(cpu.step(&mut self.ram), Step::Ran);
            assert!(
                self.ram.cycles < 100_000,
                "{} does not end",
                self.routine.name
            );
        }
        assert_eq!(
            cpu.sp, 0xFF,
            "{} leaves the stack as it was",
            self.routine.name
        );
        self.ram.cycles
    }

    /// The result for these operands, and the cycles of the use.
    pub fn run(&mut self, args: &[i32]) -> (i32, u64) {
        for (value, at) in args.iter().zip([FIRST, SECOND]) {
            let at = usize::from(at);
            self.ram.bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        }
        let cycles = self.go();
        let at = usize::from(RESULT);
        let bytes: [u8; 4] = self.ram.bytes[at..at + 4].try_into().unwrap();
        let result = match self.routine.result {
            Format::Bool => i32::from(bytes[0]),
            _ => i32::from_le_bytes(bytes),
        };
        (result, cycles)
    }
}
