//! VM commands a second on programs as Jack compilers emit them, of the machine and of
//! a straightforward interpreter, its yardstick.
//!
//! `cargo bench -p slowlight-vm --bench hack`; the throughput is in elements,
//! which are VM commands.

mod yardstick;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use slowlight_vm::hack::jack;
use slowlight_vm::hack::vm::{Machine, Program};
use std::hint::black_box;
use yardstick::Straight;

/// Arrays and loops: the sieve of Eratosthenes, over and over.
const SIEVE: &str = "class Main {
    static Array composite;
    function void main() {
        var int round;
        let composite = Array.new(8000);
        let round = 0;
        while (round < 20) { do Main.sieve(8000); let round = round + 1; }
        return;
    }
    function void sieve(int size) {
        var int i, j;
        let i = 0;
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
}";

/// Objects, small methods and recursion.
const CALLS: &str = "class Main {
    field int value;
    constructor Main new(int v) { let value = v; return this; }
    method int get() { return value; }
    method void set(int v) { let value = v; return; }
    function int fibonacci(int n) {
        if (n < 2) { return n; }
        return Main.fibonacci(n - 1) + Main.fibonacci(n - 2);
    }
    function void main() {
        var Main a;
        var int i;
        let a = Main.new(3);
        let i = 0;
        while (i < 20000) { do a.set(a.get() + i); let i = i + 1; }
        do Output.printInt(Main.fibonacci(22));
        return;
    }
}";

/// Fixed-point arithmetic on locals, with products and quotients.
const MANDELBROT: &str = "class Main {
    function void main() {
        var int x, y, a, b, aa, bb, n, cx, cy;
        let y = 0;
        while (y < 64) {
            let x = 0;
            let cy = (y - 32) * 4;
            while (x < 128) {
                let cx = (x * 3) - 256;
                let a = 0; let b = 0; let n = 0; let aa = 0; let bb = 0;
                while ((n < 24) & ((aa + bb) < 512)) {
                    let b = ((a * b) / 64) + cy;
                    let a = (aa - bb) + cx;
                    if ((a > 300) | (a < (-300)) | (b > 300) | (b < (-300))) { let n = 99; }
                    else { let aa = (a * a) / 128; let bb = (b * b) / 128; let n = n + 1; }
                }
                if (n = 24) { do Screen.drawPixel(x, y); }
                let x = x + 1;
            }
            let y = y + 1;
        }
        return;
    }
}";

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group("hack vm");
    for (name, source) in [
        ("sieve", SIEVE),
        ("calls", CALLS),
        ("mandelbrot", MANDELBROT),
    ] {
        let files = [("Main.jack".to_owned(), source.to_owned())];
        let Ok(compiled) = jack::compile(&files) else {
            panic!("{name} does not compile");
        };
        let files: Vec<_> = compiled.into_iter().map(|f| (f.name, f.text)).collect();
        let Ok(program) = Program::link(&files) else {
            panic!("{name} does not link");
        };
        let mut machine = Machine::new(&program);
        let count = machine.run(u64::MAX, &mut |_| true).instructions;
        let Some(straight) = Straight::read(&files) else {
            panic!("{name} is not read");
        };
        let left = straight.run();
        assert_eq!(left.commands, count, "{name}");
        let screen = (16384..24576).map(|address| machine.peek(address));
        assert!(
            screen.eq(left.memory[16384..24576].iter().copied()),
            "{name}"
        );
        group.throughput(Throughput::Elements(count));
        group.bench_function(name, |b| {
            b.iter(|| black_box(Machine::new(&program).run(u64::MAX, &mut |_| true)));
        });
        group.bench_function(format!("{name}, straightforward"), |b| {
            b.iter(|| black_box(straight.run().commands));
        });
    }
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
