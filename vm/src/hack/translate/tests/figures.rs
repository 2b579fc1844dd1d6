//! What translation costs, pinned: words of ROM, cycles for each VM command.

use super::{jack, link, same};

/// Words of ROM, VM commands and cycles, the first way.
fn figures(program: &crate::hack::vm::Program) -> (usize, u64, u64) {
    let (commands, results) = same(program, true);
    let (translation, cycles) = &results[0];
    (translation.words.len(), commands, *cycles)
}

/// Arithmetic on statics in a row, as a generator makes it that knows what is cheap.
#[test]
fn statics_in_a_row() {
    let body = "push static 0\npush static 1\nadd\npop static 2\n\
        push static 2\npush constant 255\nand\npop static 3\n\
        push static 3\npush static 1\nsub\npop static 1\n\
        push static 2\npush static 2\nadd\npop static 2\n\
        push constant 3000\npush static 3\nadd\npop pointer 1\npush that 0\npop static 4\n";
    let text = format!(
        "function Sys.init 0\n{}call Sys.halt 0\nreturn",
        body.repeat(10)
    );
    // 22 commands a turn, 23 cycles.
    assert_eq!(figures(&link(&[("Sys.vm", &text)])), (232, 222, 230));
}

#[test]
fn an_operating_system_in_jack() {
    let main = "class Main { function void main() {
        var int x, y, sum;
        while (y < 20) {
            let x = 0;
            while (x < 20) { let sum = sum + ((x * y) / 7); let x = x + 1; }
            let y = y + 1;
        }
        do Output.printInt(sum);
        return;
    } }";
    // 1.75 cycles a command: 400 products, and quotients by recursion.
    let program = jack::linked(&[("Main.jack", main)]);
    assert_eq!(figures(&program), (550, 236_439, 414_138));
}

/// What only answers a word is looked at where it is asked for.
#[test]
fn getters_are_not_called() {
    let main = "class Main { function void main() {
        var Point p; var int k, sum;
        let p = Point.new(3, 4);
        while (k < 10) {
            let sum = sum + (p.y() * k) + Point.made() + p.x() + Point.seven();
            let p = Point.other(p);
            do p.move(Point.made(), p.x());
            do p.y();
            let k = k + 1;
        }
        do Output.printInt(sum);
        return;
    } }";
    let point = "class Point {
        field int x, y; static int made;
        constructor Point new(int a, int b) {
            let x = a; let y = b; let made = made + 1; return this;
        }
        method int x() { return x; }
        method int y() { return y; }
        method void move(int a, int b) { let x = x + a; let y = y + b; let made = made + 1; return; }
        function int made() { return made; }
        function int seven() { return 7; }
        function Point other(Point p) { do p.move(1, 2); return p; }
    }";
    let program = jack::linked(&[("Main.jack", main), ("Point.jack", point)]);
    let (_, results) = same(&program, true);
    for (translation, _) in results {
        for getter in ["x", "y", "made", "seven"] {
            let label = format!("(Point.{getter})");
            assert!(!translation.assembly.contains(&label), "{label}");
        }
        assert!(translation.assembly.contains("(Point.other)"));
    }
}
