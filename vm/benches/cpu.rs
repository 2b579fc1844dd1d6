//! Cycles a second of the Hack CPU: the fast engine and the plain one.
//!
//! `cargo bench -p slowlight-vm --bench cpu`; the throughput is in elements,
//! which are cycles.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use slowlight_vm::hack::asm::assemble;
use slowlight_vm::hack::cpu::Cpu;
use std::hint::black_box;

/// Products by addition and doubling of all pairs up to 255, written over the
/// screen: loads, stores through pointers, conditions that are hard to foresee.
const PRODUCTS: &str = "
    @255
    D=A
    @x
    M=D
(ROW)
    @255
    D=A
    @y
    M=D
(PRODUCT)
    @x
    D=M
    @shifted
    M=D
    @sum
    M=0
    @bit
    M=1
(BIT)
    @bit
    D=M
    @y
    D=D&M
    @SKIP
    D;JEQ
    @shifted
    D=M
    @sum
    M=D+M
(SKIP)
    @shifted
    D=M
    M=D+M
    @bit
    D=M
    MD=D+M
    @256
    D=D-A
    @BIT
    D;JLT
    @y
    D=M
    @SCREEN
    D=D+A
    @at
    M=D
    @sum
    D=M
    @at
    A=M
    M=D
    @y
    MD=M-1
    @PRODUCT
    D;JGT
    @x
    MD=M-1
    @ROW
    D;JGT
(END)
    @END
    0;JMP
";

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group("hack cpu");
    let Ok(program) = assemble(PRODUCTS) else {
        panic!("it does not assemble");
    };
    let Ok(start) = Cpu::new(&program.words) else {
        panic!("it does not fit");
    };
    let count = start.clone().run(u64::MAX, &mut |_| true).cycles;
    group.throughput(Throughput::Elements(count));
    group.bench_function("products, fast", |b| {
        b.iter(|| black_box(start.clone().run(u64::MAX, &mut |_| true)));
    });
    group.bench_function("products, plain", |b| {
        b.iter(|| black_box(start.clone().run_plain(u64::MAX, &mut |_| true)));
    });
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
