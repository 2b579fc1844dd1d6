//! Cycles a second of the Hack CPU: the fast engine and the plain one, on assembly
//! written by hand and on a translated Jack program.
//!
//! `cargo bench -p slowlight-vm --bench cpu`; the throughput is in elements,
//! which are cycles.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use slowlight_vm::hack::asm::assemble;
use slowlight_vm::hack::cpu::Cpu;
use slowlight_vm::hack::jack::compile;
use slowlight_vm::hack::translate::{Options, translate};
use slowlight_vm::hack::vm::Program;
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

/// Arrays, loops, calls and recursion, to be translated.
const SIEVE: &str = "class Main {
    static Array composite; static int count;
    function void main() {
        var int round;
        let composite = 3000;
        let round = 0;
        while (round < 20) { do Main.sieve(8000); let round = round + 1; }
        let count = Main.fibonacci(18);
        return;
    }
    function void sieve(int size) {
        var int i, j;
        while (i < size) { let composite[i] = false; let i = i + 1; }
        let i = 2;
        while (i < 90) {
            if (~composite[i]) {
                let j = i + i;
                while (j < size) { let composite[j] = true; let j = j + i; }
            }
            let i = i + 1;
        }
        return;
    }
    function int fibonacci(int n) {
        if (n < 2) { return n; }
        return Main.fibonacci(n - 1) + Main.fibonacci(n - 2);
    }
}";

/// The words of a Jack program that needs no operating system.
fn translated(source: &str) -> Vec<u16> {
    let classes = compile(&[("Main.jack".to_owned(), source.to_owned())]);
    let files = classes.map(|all| {
        all.into_iter()
            .map(|c| (c.name, c.text))
            .collect::<Vec<_>>()
    });
    let program = files.and_then(|files| Program::link(&files));
    match program.and_then(|program| translate(&program, Options::default())) {
        Ok(translation) => translation.words,
        Err(faults) => panic!("{faults:?}"),
    }
}

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group("hack cpu");
    let products = match assemble(PRODUCTS) {
        Ok(program) => program.words,
        Err(faults) => panic!("{faults:?}"),
    };
    for (name, words) in [("products", products), ("sieve", translated(SIEVE))] {
        let Ok(start) = Cpu::new(&words) else {
            panic!("{name} does not fit");
        };
        let count = start.clone().run(u64::MAX, &mut |_| true).cycles;
        group.throughput(Throughput::Elements(count));
        group.bench_function(format!("{name}, fast"), |b| {
            b.iter(|| black_box(start.clone().run(u64::MAX, &mut |_| true)));
        });
        group.bench_function(format!("{name}, plain"), |b| {
            b.iter(|| black_box(start.clone().run_plain(u64::MAX, &mut |_| true)));
        });
    }
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
