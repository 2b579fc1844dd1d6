//! Any bytes as a program of the 6502: as assembly in both dialects, and as a memory that
//! is run as it is, with undocumented opcodes and all.
//!
//! What is held: no panic, no hang (`-timeout`), no unbounded memory
//! (`-rss_limit_mb`); what is assembled runs on all three machines; the processor makes
//! the accesses to the bus, one by one, that the crate `robo6502` makes.
#![no_main]

use libfuzzer_sys::fuzz_target;
use robo6502::{Cpu as _, Nmos, Sys};
use slowlight_vm::mos6502::cpu::{Bus, Cpu, Step};
use slowlight_vm::mos6502::{Bbc, C64, Dialect, Machine, Plain, assemble_as};

const CYCLES: u64 = 20_000;
const STEPS: usize = 500;

/// Opcodes that jam, that depend on a constant of the chip, or whose Z the peer leaves
/// alone.
const APART: [u8; 15] = [
    0x02, 0x12, 0x22, 0x32, 0x42, 0x52, 0x62, 0x72, 0x92, 0xB2, 0xD2, 0xF2, 0x8B, 0xAB, 0xBB,
];

/// 64K that the input fills again and again, and the accesses since it was last asked.
struct Memory {
    ram: Vec<u8>,
    accesses: Vec<(bool, u16, u8)>,
}

impl Memory {
    fn new(bytes: &[u8]) -> Memory {
        Memory {
            ram: bytes.iter().copied().cycle().take(0x1_0000).collect(),
            accesses: Vec::new(),
        }
    }
}

impl Bus for Memory {
    fn read(&mut self, address: u16) -> u8 {
        let value = self.ram[usize::from(address)];
        self.accesses.push((false, address, value));
        value
    }

    fn write(&mut self, address: u16, value: u8) {
        self.ram[usize::from(address)] = value;
        self.accesses.push((true, address, value));
    }
}

impl Sys for Memory {
    fn read(&mut self, address: u16) -> Option<u8> {
        Some(Bus::read(self, address))
    }

    fn write(&mut self, address: u16, value: u8) -> Option<()> {
        Bus::write(self, address, value);
        Some(())
    }
}

/// Runs a memory on the processor and on the peer.
fn random_memory(bytes: &[u8]) {
    let [low, high, status, bytes @ ..] = bytes else {
        return;
    };
    if bytes.is_empty() {
        return;
    }
    let start = u16::from_le_bytes([*low, *high]);
    let (mut here, mut there) = (Memory::new(bytes), Memory::new(bytes));
    let (mut ours, mut theirs) = (Cpu::new(start), Nmos::standard());
    ours.set_status(*status);
    theirs.set_status(*status);
    theirs.set_pc(start);
    theirs.set_sp(ours.sp);
    for _ in 0..STEPS {
        if APART.contains(&here.ram[usize::from(ours.pc)]) {
            break;
        }
        let step = ours.step(&mut here);
        assert_ne!(step, Step::Jammed);
        theirs.run_instruction(&mut there).expect("a step");
        assert_eq!(here.accesses, there.accesses);
        assert_eq!(
            (ours.a, ours.x, ours.y, ours.sp, ours.pc),
            (theirs.a(), theirs.x(), theirs.y(), theirs.sp(), theirs.pc())
        );
        assert_eq!(ours.status(), theirs.status() | 0x30);
        here.accesses.clear();
        there.accesses.clear();
    }
}

fn runs(machine: &mut dyn Machine, image: &[u8]) {
    if machine.load(image).is_ok() {
        machine.run(CYCLES, &mut |_| true);
    }
}

fuzz_target!(|bytes: &[u8]| {
    random_memory(bytes);
    let text = String::from_utf8_lossy(bytes);
    let images = [Dialect::Common, Dialect::Beebasm]
        .into_iter()
        .filter_map(|dialect| assemble_as(&text, dialect).ok())
        .map(|assembly| assembly.image());
    for image in images.chain([bytes.to_vec()]) {
        runs(&mut Plain::new(), &image);
        runs(&mut Bbc::new(), &image);
        runs(&mut C64::new(), &image);
    }
});
