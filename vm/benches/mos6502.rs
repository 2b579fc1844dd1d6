//! Cycles a second of the 6502, beside the crate `robo6502`, both with every access to
//! the bus visible: programs by hand, until they store to the port that ends them.
//!
//! `cargo bench -p slowlight-vm --bench mos6502`; the throughput is in elements,
//! which are cycles of the machine.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use robo6502::{Cpu as _, Nmos, Sys};
use slowlight_vm::Stop;
use slowlight_vm::mos6502::{Plain, assemble, plain::port};
use std::hint::black_box;

/// Where the programs lie.
const ORIGIN: u16 = 0x0800;

/// The sieve of Eratosthenes over $2000 to $3FFF, twenty times: pointers and loops.
const SIEVE: &str = "
    exit = $FF0A
    at = $10
    step = $12
    round = $14
    * = $0800
      lda #20
      sta round
    again: lda #0
      sta at
      lda #$20
      sta at + 1
      lda #1
      ldy #0
    fill: sta (at),y
      iny
      bne fill
      inc at + 1
      ldx at + 1
      cpx #$40
      bne fill
      ldx #2
    next: stx step
      txa
      clc
      adc step
      sta at
      lda #$20
      adc #0
      sta at + 1
    strike: ldy #0
      tya
      sta (at),y
      clc
      lda at
      adc step
      sta at
      bcc strike
      inc at + 1
      lda at + 1
      cmp #$40
      bcc strike
      ldx step
      inx
      cpx #90
      bne next
      dec round
      bne again
      lda #0
      sta exit
";

/// Products of all pairs of bytes by shifts and additions, over a page: branches that
/// are hard to foresee, indexed stores, subroutines, the stack.
const PRODUCTS: &str = "
    exit = $FF0A
    left = $10
    right = $11
    page = $2000
    * = $0800
      ldx #0
    row: ldy #0
    product: stx left
      sty right
      txa
      pha
      jsr times
      ldy right
      eor page,y
      sta page,y
      pla
      tax
      iny
      bne product
      inx
      bne row
      lda #0
      sta exit
    times: lda #0
      ldx #8
      lsr left
    digit: bcc shift
      clc
      adc right
    shift: ror
      ror left
      dex
      bne digit
      rts
";

/// A flat memory for the peer.
struct Flat {
    ram: Box<[u8; 0x1_0000]>,
    cycles: u64,
    ended: bool,
}

impl Sys for Flat {
    #[inline(always)]
    fn read(&mut self, address: u16) -> Option<u8> {
        self.cycles += 1;
        Some(self.ram[usize::from(address)])
    }

    #[inline(always)]
    fn write(&mut self, address: u16, value: u8) -> Option<()> {
        self.cycles += 1;
        self.ram[usize::from(address)] = value;
        self.ended |= address == port::EXIT;
        Some(())
    }
}

/// Runs a program on our machine; its cycles.
fn ours(image: &[u8]) -> u64 {
    let mut machine = Plain::new();
    if let Err(fault) = machine.load(image) {
        panic!("{fault}");
    }
    let run = machine.run(u64::MAX, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended);
    run.cycles
}

/// Runs a program on the peer; its cycles.
fn theirs(image: &[u8]) -> u64 {
    let mut flat = Flat {
        ram: Box::new([0; 0x1_0000]),
        cycles: 0,
        ended: false,
    };
    let (start, bytes) = (usize::from(ORIGIN), &image[2..]);
    flat.ram[start..start + bytes.len()].copy_from_slice(bytes);
    let mut cpu = Nmos::standard();
    cpu.set_pc(ORIGIN);
    cpu.set_sp(0xFF);
    cpu.set_status(0x24);
    while !flat.ended {
        cpu.run_instruction(&mut flat);
    }
    flat.cycles
}

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group("6502");
    for (name, source) in [("sieve", SIEVE), ("products", PRODUCTS)] {
        let image = match assemble(source) {
            Ok(assembly) => assembly.image(),
            Err(faults) => panic!("{faults:?}"),
        };
        let cycles = ours(&image);
        assert_eq!(cycles, theirs(&image), "the same cycles");
        group.throughput(Throughput::Elements(cycles));
        group.bench_function(format!("{name}, ours"), |b| {
            b.iter(|| black_box(ours(&image)));
        });
        group.bench_function(format!("{name}, robo6502"), |b| {
            b.iter(|| black_box(theirs(&image)));
        });
    }
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
