//! What the processor does, said without an oracle.

use super::*;

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

/// Memory with some bytes set, and a processor about to run at $0200.
fn machine(code: &[u8]) -> (Cpu, Ram) {
    let mut bytes = vec![0; 0x1_0000];
    bytes[0x200..0x200 + code.len()].copy_from_slice(code);
    (Cpu::new(0x0200), Ram { bytes, cycles: 0 })
}

fn cycles_of(code: &[u8], prepare: impl FnOnce(&mut Cpu, &mut Ram)) -> u64 {
    let (mut cpu, mut ram) = machine(code);
    prepare(&mut cpu, &mut ram);
    cpu.step(&mut ram);
    ram.cycles
}

#[test]
fn an_index_over_a_page_costs_a_cycle_where_it_is_only_read() {
    assert_eq!(cycles_of(&[0xBD, 0xF0, 0x03], |c, _| c.x = 0x0F), 4);
    assert_eq!(cycles_of(&[0xBD, 0xF0, 0x03], |c, _| c.x = 0x10), 5);
    assert_eq!(cycles_of(&[0x9D, 0xF0, 0x03], |c, _| c.x = 0x0F), 5);
    assert_eq!(cycles_of(&[0xFE, 0xF0, 0x03], |c, _| c.x = 0x10), 7);
    let pointer = |c: &mut Cpu, r: &mut Ram| {
        c.y = 0x10;
        r.bytes[0x80] = 0xF0;
    };
    assert_eq!(cycles_of(&[0xB1, 0x80], pointer), 6);
    assert_eq!(cycles_of(&[0x91, 0x80], pointer), 6);
}

#[test]
fn a_branch_costs_two_three_or_four_cycles() {
    assert_eq!(cycles_of(&[0xB0, 0x10], |_, _| {}), 2);
    assert_eq!(cycles_of(&[0x90, 0x10], |_, _| {}), 3);
    assert_eq!(cycles_of(&[0x90, 0x80], |_, _| {}), 4);
}

fn decimal(opcode: u8, a: u8, value: u8, carry: bool) -> (u8, u8) {
    let (mut cpu, mut ram) = machine(&[opcode, value]);
    cpu.a = a;
    cpu.set_status(flag::D | u8::from(carry));
    cpu.step(&mut ram);
    (
        cpu.a,
        cpu.status() & (flag::N | flag::V | flag::Z | flag::C),
    )
}

#[test]
fn decimal_sums_and_differences_are_those_of_decimal_numbers() {
    let bcd = |n: u8| ((n / 10) << 4) + n % 10;
    for a in 0..100 {
        for b in 0..100 {
            let (sum, p) = decimal(0x69, bcd(a), bcd(b), false);
            assert_eq!((sum, p & flag::C != 0), (bcd((a + b) % 100), a + b > 99));
            let (difference, p) = decimal(0xE9, bcd(a), bcd(b), true);
            assert_eq!(
                (difference, p & flag::C != 0),
                (bcd((100 + a - b) % 100), a >= b)
            );
        }
    }
}

#[test]
fn decimal_flags_are_the_nmos_ones() {
    // 99 + 1: the result is 0, but Z comes from the binary sum $9A, N from before the correction.
    assert_eq!(decimal(0x69, 0x99, 0x01, false), (0x00, flag::N | flag::C));
    // 79 + 1 = 80: overflow as if the digits were signed.
    assert_eq!(decimal(0x69, 0x79, 0x01, false), (0x80, flag::N | flag::V));
    // An invalid digit: $0F + 1.
    assert_eq!(decimal(0x69, 0x0F, 0x01, false), (0x16, 0));
    // 0 - 1 = 99 with a borrow.
    assert_eq!(decimal(0xE9, 0x00, 0x01, true), (0x99, flag::N));
}

#[test]
fn an_indirect_jump_wraps_within_its_page() {
    let (mut cpu, mut ram) = machine(&[0x6C, 0xFF, 0x03]);
    ram.bytes[0x3FF] = 0x34;
    ram.bytes[0x300] = 0x12;
    ram.bytes[0x400] = 0x99;
    cpu.step(&mut ram);
    assert_eq!((cpu.pc, ram.cycles), (0x1234, 5));
}

#[test]
fn ane_and_lxa_use_the_documented_constant() {
    let (mut cpu, mut ram) = machine(&[0x8B, 0xFF, 0xAB, 0x1F]);
    cpu.x = 0x37;
    cpu.step(&mut ram);
    assert_eq!(cpu.a, 0xEE & 0x37);
    cpu.step(&mut ram);
    assert_eq!((cpu.a, cpu.x), (0x0E, 0x0E));
}

#[test]
fn las_loads_three_registers_with_memory_and_the_stack_pointer() {
    let (mut cpu, mut ram) = machine(&[0xBB, 0x00, 0x03]);
    ram.bytes[0x310] = 0x0F;
    cpu.y = 0x10;
    cpu.sp = 0xF1;
    cpu.step(&mut ram);
    assert_eq!((cpu.a, cpu.x, cpu.sp, ram.cycles), (0x01, 0x01, 0x01, 4));
    assert_eq!(cpu.status() & (flag::Z | flag::N), 0);
}

#[test]
fn all_twelve_jams_stop() {
    let jams = [
        0x02, 0x12, 0x22, 0x32, 0x42, 0x52, 0x62, 0x72, 0x92, 0xB2, 0xD2, 0xF2,
    ];
    for opcode in 0..=255u8 {
        let (mut cpu, mut ram) = machine(&[opcode]);
        assert_eq!(
            cpu.step(&mut ram) == Step::Jammed,
            jams.contains(&opcode),
            "{opcode:02X}"
        );
    }
}

#[test]
fn interrupts_take_seven_cycles_and_come_back() {
    let (mut cpu, mut ram) = machine(&[0x58, 0xEA]);
    ram.bytes[0xFFFE] = 0x00;
    ram.bytes[0xFFFF] = 0x03;
    ram.bytes[0x300] = 0x40;
    assert!(
        !cpu.interrupt(&mut ram, Interrupt::Irq),
        "masked at the start"
    );
    assert_eq!(ram.cycles, 0);
    cpu.step(&mut ram);
    let before = cpu;
    ram.cycles = 0;
    assert!(cpu.interrupt(&mut ram, Interrupt::Irq));
    assert_eq!((ram.cycles, cpu.pc), (7, 0x0300));
    assert_eq!(ram.bytes[0x1FD] & flag::B, 0, "an interrupt pushes B clear");
    assert!(
        !cpu.interrupt(&mut ram, Interrupt::Irq),
        "masked inside the handler"
    );
    cpu.step(&mut ram);
    assert_eq!(
        (cpu.pc, cpu.sp, cpu.status()),
        (before.pc, before.sp, before.status())
    );
    assert!(cpu.interrupt(&mut ram, Interrupt::Nmi), "never masked");
    assert_eq!(cpu.pc, 0);
}
