//! A routine in a program of its own, run again and again on the processor.

use slowlight_routine::{Format, Routine, Source};
use slowlight_vm::mos6502::assemble;
use slowlight_vm::mos6502::cpu::{Bus, Cpu, Step};
use slowlight_vm::mos6502::worst::Question;
use std::collections::BTreeSet;

use crate::FIXED16_16 as RUNTIME;
use crate::write::{Goal, Place, Use, instructions};
use slowlight_routine::Runtime;

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

/// Instructions that are interpreted for a bound: what has none is found out soon.
const FUEL: u64 = 20_000;

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
fn parts(runtime: &Runtime, names: &[&str]) -> (String, bool) {
    let mut text = String::new();
    // Logarithms have a page of their own, which names the same.
    let page = match runtime.real {
        Format::Log { .. } => "log_page",
        Format::Real40 => "float_page",
        _ => "scaled24_page",
    };
    let closure = runtime.closure(names.iter().copied().chain([page]));
    for part in &closure {
        let source = match part.source {
            Source::Text(source) => source.to_owned(),
            Source::Made(write) => write(),
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
pub fn part_bytes(runtime: &Runtime, name: &str) -> u32 {
    let (text, _) = parts(runtime, &[name]);
    let program = assemble(&format!("* = $0a00\n{text}")).unwrap();
    let at = |label: &str| program.symbols[&format!("{label}_{name}")];
    let tables = if name == "squares" { 2048 } else { 0 };
    u32::try_from(at("end") - at("begin")).unwrap() + tables
}

/// How operands are kept.
#[derive(Clone, Copy)]
pub struct Setting {
    pub runtime: &'static Runtime,
    /// Bytes of a real and its result.
    pub sizes: u8,
}

pub struct Bench {
    ram: Ram,
    name: &'static str,
    /// Bytes of the result.
    size: u8,
    start: u16,
    end: u16,
    /// Bytes of the use.
    pub bytes: u32,
    /// Cycles of what stands before it.
    pub prepared: u64,
    /// The most cycles of a use, found from the program, where all its loops are bounded: every
    /// run is held against it.
    pub worst: Option<u64>,
}

const FIRST: u16 = 0x80;
const SECOND: u16 = 0x88;
const RESULT: u16 = 0x90;

impl Bench {
    /// The routine with its arguments at `places`, or all in the zero page if there are none.
    pub fn new(routine: &Routine, places: &[Place]) -> Bench {
        let setting = Setting {
            runtime: &RUNTIME,
            sizes: 4,
        };
        Bench::of(setting, routine, places, 0)
    }

    /// The same of a runtime's, with what it has to know of scales.
    pub fn of(setting: Setting, routine: &Routine, places: &[Place], number: i32) -> Bench {
        Bench::used(setting, routine, (places, number), false)
    }

    /// The same where what may be written out is called, or not.
    pub fn used(
        setting: Setting,
        routine: &Routine,
        (places, number): (&[Place], i32),
        calls: bool,
    ) -> Bench {
        let names = ["first_operand", "second_operand_value"];
        let zero_page = names.map(|name| Place::At(name.into()));
        let places = if places.is_empty() {
            &zero_page[..routine.args.len()]
        } else {
            places
        };
        let size = match routine.result {
            Format::Bool => 1,
            Format::Int { .. } => 4,
            _ => setting.sizes,
        };
        let goal = Goal::At("result");
        let write = |lines: &mut Vec<String>| {
            let used = Use {
                routine,
                args: places,
                goal: &goal,
                serial: 1,
                number,
                calls,
            };
            let mut needs = routine.needs.to_vec();
            needs.extend(instructions(used, lines));
            needs
        };
        Bench {
            name: routine.name,
            size,
            ..Bench::written(setting.runtime, &write)
        }
    }

    /// Instructions by themselves, and the parts that they need.
    pub fn written(
        runtime: &'static Runtime,
        write: &dyn Fn(&mut Vec<String>) -> Vec<&'static str>,
    ) -> Bench {
        let mut lines = Vec::new();
        let needs = write(&mut lines);
        let (parts, squares) = parts(runtime, &needs);
        let mut prepare = if squares { "jsr make_squares" } else { "" }.to_owned();
        if parts.contains("set_squares24:") {
            prepare += " | jsr set_squares24";
        }
        for set in ["set_squares", "set_sums", "set_lost", "set_parts"] {
            if parts.contains(&format!("{set}:")) {
                prepare += &format!(" | jsr {set}");
            }
        }
        let prepare = prepare.replace('|', "\n        ");
        let source = format!(
            "* = $0a00\nfirst_operand = ${FIRST:02x}\nsecond_operand_value = ${SECOND:02x}\nresult = ${RESULT:02x}\n{parts}
             prepare: {prepare}\nstart:\n{}\nend: nop\n",
            lines.join("\n")
        );
        let program = assemble(&source).unwrap_or_else(|f| panic!("{}\n{source}", f[0]));
        let at = |label: &str| u16::try_from(program.symbols[label]).unwrap();
        let mut ram = Ram {
            bytes: vec![0; 0x1_0000],
            cycles: 0,
        };
        let origin = usize::from(program.origin);
        ram.bytes[origin..origin + program.bytes.len()].copy_from_slice(&program.bytes);
        let mut bench = Bench {
            ram,
            name: "read",
            size: 4,
            start: at("prepare"),
            end: at("start"),
            bytes: u32::from(at("end") - at("start")),
            prepared: 0,
            worst: None,
        };
        bench.prepared = bench.go();
        (bench.start, bench.end) = (at("start"), at("end"));
        let question = Question {
            assembly: &program,
            ram: 0..=0xFF,
            mirrored: false,
            turns: Question::turns_of(&program, &source),
            ends: BTreeSet::from([bench.end]),
            exit: None,
        };
        bench.worst = question.worst_within(bench.start, FUEL).ok();
        bench
    }

    /// The same with a result of so many bytes.
    pub fn sized(self, size: u8) -> Bench {
        Bench { size, ..self }
    }

    /// What is in memory from an address on.
    pub fn memory(&self, from: usize) -> &[u8] {
        &self.ram.bytes[from..]
    }

    /// Runs from `start` until `end` is reached; answers the cycles.
    fn go(&mut self) -> u64 {
        let mut cpu = Cpu::new(self.start);
        self.ram.cycles = 0;
        while cpu.pc != self.end {
            assert_eq!(cpu.step(&mut self.ram), Step::Ran);
            assert!(self.ram.cycles < 100_000, "{} does not end", self.name);
        }
        assert_eq!(cpu.sp, 0xFF, "{} leaves the stack as it was", self.name);
        let (took, most) = (self.ram.cycles, self.worst.unwrap_or(u64::MAX));
        assert!(took <= most, "{} took {took} cycles of {most}", self.name);
        self.ram.cycles
    }

    /// The result for these operands, and the cycles of the use.
    pub fn run(&mut self, args: &[i32]) -> (i32, u64) {
        let wide: Vec<u64> = args.iter().map(|a| *a as u64).collect();
        let (bits, cycles) = self.run_bits(&wide);
        let result = match self.size {
            1 => bits as u8 as i32,
            2 => i32::from(bits as u16 as i16),
            3 => (bits as u32 as i32) << 8 >> 8,
            _ => bits as u32 as i32,
        };
        (result, cycles)
    }

    /// The same of numbers of up to eight bytes; those of the result, no more.
    pub fn run_bits(&mut self, args: &[u64]) -> (u64, u64) {
        for (value, at) in args.iter().zip([FIRST, SECOND]) {
            let at = usize::from(at);
            self.ram.bytes[at..at + 8].copy_from_slice(&value.to_le_bytes());
        }
        let cycles = self.go();
        let at = usize::from(RESULT);
        let mut bytes = [0; 8];
        let size = usize::from(self.size);
        bytes[..size].copy_from_slice(&self.ram.bytes[at..at + size]);
        (u64::from_le_bytes(bytes), cycles)
    }
}
