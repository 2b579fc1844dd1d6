//! Programs in Jack with an operating system in Jack, on both machines.

use super::same;
use crate::hack::jack::compile;
use crate::hack::vm::Program;

/// As much of the operating system as the programs here ask for.
const OS: &[(&str, &str)] = &[
    (
        "Sys.jack",
        "class Sys {
            function void init() { do Memory.init(); do Math.init(); do Screen.init();
                do Main.main(); do Sys.halt(); return; }
            function void halt() { while (true) { } return; }
            function void error(int code) { do Memory.poke(2048, code); do Sys.halt(); return; }
        }",
    ),
    (
        "Memory.jack",
        "class Memory {
            static Array ram; static int next;
            function void init() { let ram = 0; let next = 3000; return; }
            function int peek(int at) { return ram[at]; }
            function void poke(int at, int value) { let ram[at] = value; return; }
            function int alloc(int size) { let next = next + size; return next - size; }
            function void deAlloc(Array it) { return; }
        }",
    ),
    (
        "Array.jack",
        "class Array {
            function Array new(int size) { return Memory.alloc(size); }
            method void dispose() { do Memory.deAlloc(this); return; }
        }",
    ),
    (
        "Math.jack",
        "class Math {
            static Array powers; static int rest;
            function void init() {
                var int k;
                let powers = Array.new(16); let powers[0] = 1;
                while (k < 15) { let k = k + 1; let powers[k] = powers[k - 1] + powers[k - 1]; }
                return;
            }
            function int abs(int x) { if (x < 0) { return -x; } return x; }
            function int multiply(int x, int y) {
                var int sum, k;
                while (k < 16) {
                    if (~((y & powers[k]) = 0)) { let sum = sum + x; }
                    let x = x + x; let k = k + 1;
                }
                return sum;
            }
            function int divide(int x, int y) {
                var int q;
                let q = Math.part(Math.abs(x), Math.abs(y));
                if ((x < 0) = (y < 0)) { return q; }
                return -q;
            }
            function int part(int x, int y) {
                var int q;
                if ((y > x) | (y < 0)) { let rest = x; return 0; }
                let q = Math.part(x, y + y);
                if (rest < y) { return q + q; }
                let rest = rest - y;
                return q + q + 1;
            }
        }",
    ),
    (
        "Screen.jack",
        "class Screen {
            static boolean black; static Array bits, screen;
            function void init() {
                var int k, bit;
                let screen = 16384; let black = true; let bits = Array.new(16); let bit = 1;
                while (k < 16) { let bits[k] = bit; let bit = bit + bit; let k = k + 1; }
                return;
            }
            function void setColor(boolean b) { let black = b; return; }
            function void drawPixel(int x, int y) {
                var int at;
                let at = (32 * y) + (x / 16);
                if (black) { let screen[at] = screen[at] | bits[x & 15]; }
                else { let screen[at] = screen[at] & (~bits[x & 15]); }
                return;
            }
        }",
    ),
    (
        "Output.jack",
        "class Output {
            static int at;
            function void printInt(int n) {
                let at = at + 1;
                do Memory.poke(9000 + at, n);
                return;
            }
        }",
    ),
];

/// Compiles a program with the operating system.
pub(super) fn linked(files: &[(&str, &str)]) -> Program {
    let files: Vec<_> = files.iter().chain(OS).collect();
    let owned = files
        .iter()
        .map(|(name, text)| ((*name).to_owned(), (*text).to_owned()));
    let compiled = compile(&owned.collect::<Vec<_>>()).unwrap();
    let files: Vec<_> = compiled.into_iter().map(|f| (f.name, f.text)).collect();
    Program::link(&files).unwrap()
}

fn runs(files: &[(&str, &str)]) {
    same(&linked(files), true);
}

#[test]
fn objects_and_lists() {
    runs(&[
        (
            "List.jack",
            "class List {
                field int head; field List tail;
                static int made;
                constructor List new(int first, List rest) {
                    let head = first; let tail = rest; let made = made + 1;
                    return this;
                }
                method int sum() {
                    if (tail = null) { return head; }
                    return head + tail.sum() + (0 * head);
                }
                method List reversed() { return onto(null); }
                method List onto(List other) {
                    let other = List.new(head, other);
                    if (tail = null) { return other; }
                    return tail.onto(other);
                }
                method int at(int i) {
                    var List at;
                    let at = this;
                    while (i > 0) { let at = at.tail(); let i = i - 1; }
                    return at.head();
                }
                method int head() { return head; }
                method List tail() { return tail; }
                function int made() { return made; }
            }",
        ),
        (
            "Main.jack",
            "class Main {
                static List kept;
                function void main() {
                    var List list;
                    let kept = List.new(1, List.new(20, List.new(300, null)));
                    do Output.printInt(kept.sum());
                    let list = kept.reversed();
                    do Output.printInt(list.at(0)); do Output.printInt(list.at(2));
                    do Output.printInt(List.made());
                    return;
                }
            }",
        ),
    ]);
}

#[test]
fn arithmetic_arrays_and_the_screen() {
    runs(&[(
        "Main.jack",
        "class Main {
            static int last;
            function void main() {
                var Array a, b; var int i, x, y;
                let a = Array.new(8); let b = Array.new(8);
                while (i < 8) { let a[i] = i * 3 & 7; let b[i] = 7 - i; let i = i + 1; }
                let i = 2;
                do Output.printInt(a[b[i]]);
                do Output.printInt(a[b[a[b[i]]]] + b[a[i]]);
                let a[a[i]] = b[a[7]] + a[a[0]];
                let i = 0;
                while (i < 8) { do Output.printInt(a[i] - (b[i] * i)); let i = i + 1; }
                do Output.printInt(-1234 / 7); do Output.printInt(-3 * (-5));
                do Output.printInt(32767 / 181); do Output.printInt(Main.fib(12));
                let y = 0;
                while (y < 24) {
                    let x = 0;
                    while (x < 40) {
                        if (((x - 20) * (x - 20)) + ((y - 12) * (y - 12)) < 100)
                            { do Screen.drawPixel(x, y); }
                        let x = x + 1;
                    }
                    let y = y + 1;
                }
                do Screen.setColor(false);
                do Screen.drawPixel(20, 12);
                return;
            }
            function int fib(int n) {
                if (n < 2) { return n; }
                return Main.fib(n - 1) + Main.fib(n - 2);
            }
        }",
    )]);
}
