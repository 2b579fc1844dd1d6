//! Both sides of every rule for all bytes, and programs at random, on the processor.

#![allow(clippy::unwrap_used)]

use super::super::effects::{A, C, NZ, V, X};
use super::super::tests::{SYMBOLS_END, at_random, run};
use super::rules::{self, Bound, Rule};
use super::undocumented;
use slowlight_isa::opcodes::{OPCODES, Trust};
use slowlight_vm::mos6502::assemble;
use slowlight_vm::mos6502::cpu::{Bus, Cpu};

/// A few bytes of memory: `m`, `n`, and instructions.
struct Ram([u8; 64]);

impl Bus for Ram {
    fn read(&mut self, address: u16) -> u8 {
        self.0[usize::from(address) % 64]
    }
    fn write(&mut self, address: u16, value: u8) {
        self.0[usize::from(address) % 64] = value;
    }
}

/// Where `m` and `n` are, and the instructions.
const M: usize = 0x10;
const N: usize = 0x11;
const CODE: usize = 0x20;

/// What registers, flags and memory are before: A, X, `m`, `n`, the carry.
type Before = ([u8; 4], bool);

struct Side {
    ram: Ram,
    end: u16,
}

impl Side {
    fn new(rule: &Bound, side: &[(&str, &str)]) -> (Side, usize) {
        let code = rule.written(side).join("\n ");
        let program = assemble(&format!("* = $0020\n {code}\n")).unwrap();
        let mut ram = Ram([0; 64]);
        let length = program.bytes.len();
        ram.0[CODE..CODE + length].copy_from_slice(&program.bytes);
        for opcode in &program.bytes[..1] {
            assert_ne!(OPCODES[usize::from(*opcode)].trust, Trust::Unstable);
        }
        let end = (CODE + length) as u16;
        (Side { ram, end }, length)
    }

    /// Everything that can be seen behind it but what `loses` says.
    fn after(&mut self, ([a, x, m, n], carry): Before, loses: &[usize]) -> [u8; 8] {
        let mut cpu = Cpu::new(CODE as u16);
        (cpu.a, cpu.x, cpu.y) = (a, x, 77);
        cpu.set_status(0x24 | u8::from(carry));
        (self.ram.0[M], self.ram.0[N]) = (m, n);
        while cpu.pc != self.end {
            cpu.step(&mut self.ram);
        }
        let flags = cpu.status();
        let of = |place, value| if loses.contains(&place) { 0 } else { value };
        [
            of(A, cpu.a),
            of(X, cpu.x),
            cpu.y,
            self.ram.0[M],
            self.ram.0[N],
            of(C, flags & 0x01),
            of(NZ, flags & 0x82),
            of(V, flags & 0x40),
        ]
    }
}

/// Where a carry or a sign may change.
const EDGES: [u8; 6] = [0, 1, 0x7F, 0x80, 0xC5, 0xFF];

/// All pairs of two of the four bytes, the rest at edges.
fn held(rule: &Rule, number: u8) {
    let bound = Bound::sample(number);
    let (mut from, long) = Side::new(&bound, &rule.from);
    let (mut to, short) = Side::new(&bound, &rule.to);
    assert!(short <= long, "{:?}", rule.from);
    let uses = |letter: &str| rule.from.iter().any(|code| code.1 == letter);
    // Which bytes matter: A and X always, unless they are set first.
    let swept: (usize, usize) = match (uses("m") || uses("p"), uses("n")) {
        (true, true) => (2, 3),
        (true, false) => (0, 2),
        (false, true) => (1, 3),
        (false, false) => (0, 1),
    };
    let rest: Vec<usize> = (0..4).filter(|k| *k != swept.0 && *k != swept.1).collect();
    for pair in 0..=0xFFFF_u16 {
        let edge = EDGES[usize::from(pair) % EDGES.len()];
        let other = EDGES[usize::from(pair >> 8) % EDGES.len()];
        let mut bytes = [0; 4];
        [bytes[swept.0], bytes[swept.1]] = pair.to_le_bytes();
        (bytes[rest[0]], bytes[rest[1]]) = (edge, other);
        for carry in [false, true] {
            let [was, now] = [&mut from, &mut to].map(|s| s.after((bytes, carry), rule.loses));
            assert_eq!(was, now, "{:?}, {number}, {bytes:?}, {carry}", rule.from);
        }
    }
}

#[test]
fn rules_do_the_same_for_all_bytes() {
    for rule in rules::all() {
        let over = |letter: &str| rule.from.iter().any(|code| code.1 == letter);
        if over("#k") || over("#j") {
            let most = if over("#j") { 127 } else { 255 };
            // All numbers, with a byte of A and X each; and three with all of them.
            (1..=most).for_each(|number| numbers(&rule, number));
            [1, 2, most]
                .into_iter()
                .for_each(|number| held(&rule, number));
        } else {
            held(&rule, 0);
        }
    }
}

/// All of A for a number, X and memory at edges.
fn numbers(rule: &Rule, number: u8) {
    let bound = Bound::sample(number);
    let (mut from, _) = Side::new(&bound, &rule.from);
    let (mut to, _) = Side::new(&bound, &rule.to);
    for byte in 0..=255 {
        for edge in EDGES {
            let before = ([byte, byte ^ edge, byte.wrapping_add(edge), edge], edge > 3);
            let [was, now] = [&mut from, &mut to].map(|s| s.after(before, rule.loses));
            assert_eq!(was, now, "{:?}, {number}, {before:?}", rule.from);
        }
    }
}

#[test]
fn programs_at_random_do_the_same_with_them() {
    let (mut put, mut shorter) = (0, 0);
    for seed in 1..500_u32 {
        let (lines, from) = at_random(seed);
        let mut with: Vec<(String, ())> = lines.iter().map(|line| (line.clone(), ())).collect();
        undocumented(&mut with, &(0..SYMBOLS_END), from);
        let with: Vec<String> = with.into_iter().map(|(line, ())| line).collect();
        let Ok(plain) = assemble(&lines.join("\n")) else {
            continue;
        };
        let both = assemble(&with.join("\n")).unwrap();
        put += u32::from(with != lines);
        shorter += plain.bytes.len() - both.bytes.len();
        for start in 1..6_u32 {
            let was = run(&plain, seed * 8 + start).0;
            let now = run(&both, seed * 8 + start).0;
            let texts = [lines.join("\n"), with.join("\n")];
            assert_eq!(
                was, now,
                "{seed}, {start}\n{}\n-----\n{}",
                texts[0], texts[1]
            );
        }
    }
    assert!(
        put > 100 && shorter > 100,
        "{put} programs, {shorter} bytes"
    );
}

#[test]
fn x_holds_one_byte_at_a_time() {
    let of = |code: &str| {
        let symbols = [
            "one = $12",
            "two = $13",
            "three = $14",
            "seen = $15",
            "behind = $16",
            "* = $0800",
        ];
        let code = code.split('|').chain(["jmp halt"]);
        let code = code.map(|code| format!("        {code}"));
        let lines = symbols
            .map(str::to_owned)
            .into_iter()
            .chain(["halt:".to_owned()]);
        let mut lines: Vec<(String, ())> = lines.chain(code).map(|line| (line, ())).collect();
        undocumented(&mut lines, &(0..5), 6);
        let code = lines.iter().skip(7).map(|(line, ())| line.trim());
        code.collect::<Vec<_>>().join("|")
    };
    for (from, to) in [
        // The same byte again and again.
        (
            "lda one|asl|sta three|lda one|lsr|sta three|lda one|sta seen",
            "lax one|asl|sta three|txa|lsr|sta three|txa|sta seen",
        ),
        // Two bytes in turns: one of them.
        (
            "lda one|asl|lda two|sta three|lda one|rol|sta seen|lda two|sta seen",
            "lax one|asl|lda two|sta three|txa|rol|sta seen|lda two|sta seen",
        ),
        // It is another byte by then, or X is wanted.
        ("lda one|asl|sta one|lda one|rol|sta seen", ""),
        ("lda one|asl|stx seen|lda one|sta seen", ""),
        // Flags of something else.
        ("lda one|cmp #$07|tax|beq halt|stx seen", ""),
        (
            "lda one|sta two|tax|beq halt|stx seen",
            "lax one|sta two|beq halt|stx seen",
        ),
    ] {
        let wanted = if to.is_empty() { from } else { to };
        assert_eq!(of(from), format!("{wanted}|jmp halt"));
    }
}
