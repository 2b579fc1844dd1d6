//! Programs at random, before and after, on the processor.

#![allow(clippy::unwrap_used)]

use super::tidy;
use crate::tests::bench::Random;
use slowlight_vm::mos6502::cpu::{Bus, Cpu};
use slowlight_vm::mos6502::{Assembly, assemble};

/// The bytes that programs have names for: four in the zero page, two elsewhere.
const SYMBOLS: &str = "\
counter = $10
turns = $11
one = $12
two = $13
three = $14
word = $15
list = $18
pointer = $1c
nothing = $1e
far = $0300
away = $0302
behind = $0304";

/// All of them, and what a word's upper byte is called.
const CELLS: [&str; 7] = ["one", "two", "three", "word", "word+1", "far", "away+1"];

/// Where programs leave what can be seen of them.
const SEEN: u16 = 0x4000;

struct Ram(Vec<u8>);

impl Bus for Ram {
    fn read(&mut self, address: u16) -> u8 {
        self.0[usize::from(address)]
    }
    fn write(&mut self, address: u16, value: u8) {
        self.0[usize::from(address)] = value;
    }
}

struct Builder {
    random: Random,
    lines: Vec<String>,
    labels: u32,
}

impl Builder {
    fn below(&mut self, count: u32) -> usize {
        ((self.random.next() >> 8) % count) as usize
    }

    fn any<'a>(&mut self, of: &[&'a str]) -> &'a str {
        of[self.below(of.len() as u32)]
    }

    fn code(&mut self, text: &str) {
        self.lines.push(format!("        {text}"));
    }

    fn label(&mut self) -> String {
        self.labels += 1;
        format!("label{}", self.labels)
    }

    fn operand(&mut self) -> String {
        match self.below(6) {
            0 => format!("#{}", [0, 1, 127, 128, 255][self.below(5)]),
            1 => "(pointer),y".to_owned(),
            2 => "list+1".to_owned(),
            _ => self.any(&CELLS).to_owned(),
        }
    }

    fn instruction(&mut self) {
        let cell = self.any(&CELLS).to_owned();
        match self.below(24) {
            0..=4 => {
                let operand = self.operand();
                self.code(&format!("lda {operand}"));
            }
            5..=8 => self.code(&format!("sta {cell}")),
            9 | 10 => {
                let name = self.any(&["adc", "sbc", "and", "ora", "eor", "cmp"]);
                let operand = self.operand();
                self.code(&format!("{name} {operand}"));
            }
            11 => {
                let name = self.any(&["inc", "dec", "asl", "lsr", "rol", "ror"]);
                self.code(&format!("{name} {cell}"));
            }
            12 | 13 => {
                let name = self.any(&["ldx", "ldy", "stx", "sty", "cpx", "cpy", "bit", "bit"]);
                self.code(&format!("{name} {cell}"));
            }
            14 => {
                for code in ["txa", "and #3", "tax"] {
                    self.code(code);
                }
                let name = self.any(&["sta", "lda", "adc", "rol", "inc"]);
                self.code(&format!("{name} list,x"));
            }
            _ => {
                let name = self.any(&[
                    "clc", "sec", "tax", "tay", "txa", "tya", "inx", "dex", "iny", "dey", "asl",
                    "rol", "lsr", "ror",
                ]);
                self.code(name);
            }
        }
    }

    fn body(&mut self, depth: u32, calls: bool) {
        for _ in 0..2 + self.below(7) {
            match self.below(if depth == 0 { 7 } else { 11 }) {
                7 | 8 => self.choice(depth, calls),
                9 if depth == 2 => self.turns(calls),
                10 if calls => {
                    let name = self.any(&["sub_1", "sub_2"]);
                    self.code(&format!("jsr {name}"));
                }
                _ => self.instruction(),
            }
        }
    }

    /// One way or the other, or one or none; at times around a jump.
    fn choice(&mut self, depth: u32, calls: bool) {
        let branch = self.any(&["bcc", "bcs", "beq", "bne", "bmi", "bpl", "bvc", "bvs"]);
        let [other, end, over] = [(); 3].map(|()| self.label());
        if self.below(3) == 0 {
            self.code(&format!("{branch} {over}"));
            self.code(&format!("jmp {other}"));
            self.lines.push(format!("{over}:"));
        } else {
            self.code(&format!("{branch} {other}"));
        }
        self.body(depth - 1, calls);
        if self.below(2) == 0 {
            self.code(&format!("jmp {end}"));
            self.lines.push(format!("{other}:"));
            self.body(depth - 1, calls);
            self.lines.push(format!("{end}:"));
        } else {
            self.lines.push(format!("{other}:"));
        }
    }

    fn turns(&mut self, calls: bool) {
        let again = self.label();
        let done = self.label();
        let count = 1 + self.below(3);
        self.code(&format!("lda #{count}"));
        self.code("sta counter");
        self.lines.push(format!("{again}:"));
        self.body(1, calls);
        self.code("dec counter");
        self.code(&format!("beq {done}"));
        self.code(&format!("jmp {again}"));
        self.lines.push(format!("{done}:"));
    }

    /// A program that leaves some of its bytes and registers where all can see them.
    fn program(mut self) -> (Vec<String>, std::ops::Range<usize>) {
        self.lines = SYMBOLS.lines().map(str::to_owned).collect();
        self.lines.push("* = $0800".to_owned());
        let own = self.lines.len();
        self.lines.push("start:".to_owned());
        self.body(2, true);
        for (k, register) in ["sta", "stx", "sty"].iter().enumerate() {
            if self.below(2) == 0 {
                self.code(&format!("{register} ${:04x}", SEEN + k as u16));
            }
        }
        if self.below(2) == 0 {
            let set = self.label();
            let branch = self.any(&["bcc", "bne", "bpl", "bvc"]);
            self.code(&format!("{branch} {set}"));
            self.code(&format!("inc ${:04x}", SEEN + 3));
            self.lines.push(format!("{set}:"));
        }
        for (k, cell) in CELLS.iter().enumerate() {
            if self.below(3) == 0 {
                self.code(&format!("lda {cell}"));
                self.code(&format!("sta ${:04x}", SEEN + 4 + k as u16));
            }
        }
        self.lines.push("halt:".to_owned());
        self.code("jmp halt");
        for name in ["sub_1", "sub_2"] {
            self.lines.push(format!("{name}:"));
            self.body(1, false);
            self.code("rts");
        }
        let end = self.lines.len();
        (self.lines, own..end)
    }
}

/// Lines at a program's beginning that name bytes.
pub(super) const SYMBOLS_END: usize = 11;

/// The program of a seed, and where its instructions begin.
pub(super) fn at_random(seed: u32) -> (Vec<String>, usize) {
    let builder = Builder {
        random: Random(seed.wrapping_mul(2_654_435_761) | 1),
        lines: Vec::new(),
        labels: 0,
    };
    let (lines, own) = builder.program();
    (lines, own.start)
}

/// What is left to be seen, from bytes and registers at random; and the cycles.
pub(super) fn run(program: &Assembly, seed: u32) -> (Vec<u8>, u32) {
    let mut random = Random(seed);
    let mut ram = Ram(vec![0; 0x1_0000]);
    for at in (0x10..0x20).chain(0x300..0x310) {
        ram.0[at] = random.next() as u8;
    }
    let (image, halt) = (&program.bytes, program.symbols["halt"] as u16);
    let from = usize::from(program.origin);
    ram.0[from..from + image.len()].copy_from_slice(image);
    // Where nobody writes.
    [ram.0[0x1C], ram.0[0x1D]] = [0, 0x80];
    for at in 0x8000..0x8100 {
        ram.0[at] = (at as u8).wrapping_mul(37);
    }
    let mut cpu = Cpu::new(program.origin);
    cpu.a = random.next() as u8;
    cpu.x = random.next() as u8;
    cpu.y = random.next() as u8;
    // Flags as some byte leaves them: it is not 0 and negative.
    let flags = random.next() as u8 & 0xC3 | 0x24;
    cpu.set_status(if flags & 0x80 != 0 { flags & !2 } else { flags });
    let mut steps = 0;
    while cpu.pc != halt && steps < 20_000 {
        cpu.step(&mut ram);
        steps += 1;
    }
    let seen = usize::from(SEEN);
    (ram.0[seen..seen + 16].to_vec(), steps)
}

#[test]
fn programs_at_random_do_the_same() {
    let (mut before, mut after) = (0, 0);
    for seed in 1..1500_u32 {
        let (lines, from) = at_random(seed);
        let own = from..lines.len();
        let mut tidied: Vec<(String, ())> = lines.iter().map(|line| (line.clone(), ())).collect();
        tidy(&mut tidied, &(0..own.start), &own);
        let tidied: Vec<String> = tidied.into_iter().map(|(line, ())| line).collect();
        // A branch may be too long.
        let Ok(plain) = assemble(&lines.join("\n")) else {
            continue;
        };
        let short = assemble(&tidied.join("\n")).unwrap();
        for start in 1..6_u32 {
            let (was, steps) = run(&plain, seed * 8 + start);
            let (now, fewer) = run(&short, seed * 8 + start);
            assert_eq!(
                was,
                now,
                "seed {seed}, {start}\n{}\n-----\n{}",
                lines.join("\n"),
                tidied.join("\n")
            );
            assert!(fewer <= steps, "seed {seed}: {fewer} steps of {steps}");
            before += steps;
            after += fewer;
        }
    }
    assert!(after * 10 < before * 9, "{after} of {before}");
}
