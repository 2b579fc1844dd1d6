//! Compiled programs on the VM: what they print.

use super::compiled;
use crate::Stop;
use crate::hack::vm::{Machine, Program};
use proptest::prelude::*;

/// A number and a blank.
const OUT: &str = "class Out {
    function void n(int n) {
        do Output.printInt(n);
        do Output.printChar(32);
        return;
    }
}";

/// Runs a program to its end, and answers what it printed.
fn printed(files: &[(&str, &str)]) -> String {
    let code: Vec<_> = compiled(files)
        .unwrap()
        .into_iter()
        .map(|file| (file.name, file.text))
        .collect();
    let program = Program::link(&code).unwrap();
    let run = Machine::new(&program).run(10_000_000, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended, "after {}", run.text);
    run.text
}

/// What a program prints with `do Out.n(...)`.
fn numbers(files: &[(&str, &str)]) -> Vec<i16> {
    let files: Vec<_> = files.iter().copied().chain([("Out.jack", OUT)]).collect();
    let words = printed(&files);
    words
        .split_whitespace()
        .map(|word| word.parse().unwrap())
        .collect()
}

/// The same of class Main's text.
fn main_numbers(text: &str) -> Vec<i16> {
    numbers(&[("Main.jack", text)])
}

#[test]
fn operators() {
    let shown = main_numbers(
        "class Main { function void main() {
            do Out.n(2 + 3 * 4);
            do Out.n(2 + (3 * 4));
            do Out.n(10 - 3 - 2);
            do Out.n(100 / 7 / 2);
            do Out.n(32767 + 1);
            do Out.n(-3 * 5);
            do Out.n(~0);
            do Out.n(-~5);
            do Out.n(12 & 10 | 1);
            do Out.n(1 < 2);
            do Out.n(2 > 2);
            do Out.n(-1 < 1 = true);
            do Out.n(null);
            do Out.n(~false);
            return;
        } }",
    );
    let expected = [20, 14, 5, 7, -32768, -15, -1, 6, 9, -1, 0, -1, 0, -1];
    assert_eq!(shown, expected);
}

#[test]
fn elements_of_elements() {
    let shown = main_numbers(
        "class Main { function void main() {
            var Array a, b; var int i;
            let a = Array.new(8); // 0 3 6 1 4 7 2 5
            let b = Array.new(8); // 7 6 5 4 3 2 1 0
            while (i < 8) { let a[i] = i * 3 & 7; let b[i] = 7 - i; let i = i + 1; }
            let i = 2;
            do Out.n(a[b[i]]);
            do Out.n(a[b[a[b[i]]]] + b[a[i]]);
            let a[i] = a[b[1]];
            do Out.n(a[2]);
            let a[a[i]] = b[a[7]] + a[a[0]];
            do Out.n(a[a[i]]);
            let b[0] = a;
            let i = b[0];
            do Out.n(i = a);
            let a[3] = Math.max(a[4], b[b[3]]);
            do Out.n(a[3]);
            return;
        } }",
    );
    assert_eq!(shown, [7, 1, 2, 2, -1, 4]);
}

#[test]
fn branches_loops_and_recursion() {
    let shown = main_numbers(
        "class Main {
            function void main() {
                do Out.n(Main.sign(-5)); do Out.n(Main.sign(0)); do Out.n(Main.sign(9));
                do Out.n(Main.collatz(27));
                do Out.n(Main.found(42)); do Out.n(Main.found(11));
                do Out.n(Main.fib(15));
                return;
            }
            function int sign(int n) {
                if (n < 0) { return -1; } else { if (n > 0) { return 1; } }
                return 0;
            }
            function int collatz(int n) {
                var int steps;
                while (~(n = 1)) {
                    if (n & 1 = 1) { let n = 3 * n + 1; } else { let n = n / 2; }
                    let steps = steps + 1;
                }
                return steps;
            }
            /** The first i, j with the product wanted. */
            function int found(int wanted) {
                var int i, j;
                while (i < 10) {
                    let j = 0;
                    while (j < 10) {
                        if (i * j = wanted) { return i * 10 + j; }
                        let j = j + 1;
                    }
                    let i = i + 1;
                }
                return -1;
            }
            function int fib(int n) {
                if (n < 2) { return n; }
                return Main.fib(n - 1) + Main.fib(n - 2);
            }
        }",
    );
    assert_eq!(shown, [-1, 0, 1, 111, 67, -1, 610]);
}

#[test]
fn objects_keep_their_fields_and_classes_their_statics() {
    let list = "class List {
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
    }";
    let main = "class Main {
        static int made; static List kept;
        function void main() {
            var List list;
            let made = 77;
            let kept = List.new(1, List.new(20, List.new(300, null)));
            do Out.n(kept.sum());
            let list = kept.reversed();
            do Out.n(list.at(0)); do Out.n(list.at(1)); do Out.n(list.at(2));
            do Out.n(kept.at(0));
            do Out.n(List.made());
            do Out.n(made);
            return;
        }
    }";
    let shown = numbers(&[("List.jack", list), ("Main.jack", main)]);
    assert_eq!(shown, [321, 300, 20, 1, 1, 6, 77]);
}

#[test]
fn calls_do_not_disturb_what_is_half_computed() {
    let shown = main_numbers(
        "class Main {
            field Array inner;
            static int calls;
            constructor Main new(int n) {
                let inner = Array.new(2); let inner[0] = n; let inner[1] = n + 1;
                return this;
            }
            method int get(int i) {
                let calls = calls + 1;
                return inner[i] + (0 * inner[1 - i]);
            }
            method Main set(int i, int n) { let inner[i] = n; return this; }
            function void main() {
                var Array a; var Main x, y;
                let a = Array.new(4);
                let x = Main.new(10); let y = Main.new(20);
                let a[x.get(0) - 10] = y.get(x.get(1) - 10);
                do Out.n(a[0]);
                let a[y.get(0) - x.get(1) - 6] = a[0] - (x.get(0) + a[x.get(0) - 10]);
                do Out.n(a[3]);
                let y = x.set(0, y.get(1) * 2 - x.get(1));
                do Out.n(x.get(0)); do Out.n(y = x); do Out.n(calls);
                return;
            }
        }",
    );
    assert_eq!(shown, [21, -10, 31, -1, 10]);
}

#[test]
fn strings_are_made_each_time() {
    let text = "class Main {
        function String name() { return \"Slow \"; }
        constructor Main new() { return this; }
        function void main() {
            var String s; var Main m, n;
            let s = Main.name();
            do s.setCharAt(4, 33);
            do Output.printString(s);
            do Output.printString(Main.name());
            do Output.printInt(s.length());
            do Output.printString(\"\");
            let m = Main.new(); let n = Main.new();
            if (m = n) { do Output.printString(\" same\"); }
            return;
        }
    }";
    assert_eq!(printed(&[("Main.jack", text)]), "Slow!Slow 5");
}

#[test]
fn a_replaced_os_class_is_called() {
    let math = "class Math { function int multiply(int a, int b) { return a - b; } }";
    let main = "class Main { function void main() { do Out.n(2 * 3); return; } }";
    let shown = numbers(&[("Math.jack", math), ("Main.jack", main)]);
    assert_eq!(shown, [-1]);
}

/// A random value, as Jack writes it and as Jack computes it.
#[derive(Clone, Debug)]
enum Value {
    Constant(i16),
    Variable(usize),
    /// `a[i & 7]`
    Element(Box<Value>),
    Negative(Box<Value>),
    Not(Box<Value>),
    /// `Main.f(x, y)`, which is x - y - y.
    Call(Box<Value>, Box<Value>),
    /// `(x op y op z)`, from left to right.
    Chain(Box<Value>, Vec<(char, Value)>),
}

const VARIABLES: [i16; 4] = [0, 1, -12345, 32767];
const ELEMENTS: [i16; 8] = [5, 0, 7, -1, 32767, 300, -32768, 2];

impl Value {
    fn text(&self) -> String {
        match self {
            Value::Constant(value) => value.to_string(),
            Value::Variable(index) => format!("v{index}"),
            Value::Element(index) => format!("a[{}&7]", index.text()),
            Value::Negative(inner) => format!("-{}", inner.text()),
            Value::Not(inner) => format!("~{}", inner.text()),
            Value::Call(x, y) => format!("Main.f({}, {})", x.text(), y.text()),
            Value::Chain(first, rest) => {
                let mut text = first.text();
                for (operator, value) in rest {
                    text += &format!(" {operator} {}", value.text());
                }
                format!("({text})")
            }
        }
    }

    fn value(&self) -> i16 {
        match self {
            Value::Constant(value) => *value,
            Value::Variable(index) => VARIABLES[*index],
            Value::Element(index) => ELEMENTS[(index.value() & 7) as usize],
            Value::Negative(inner) => inner.value().wrapping_neg(),
            Value::Not(inner) => !inner.value(),
            Value::Call(x, y) => {
                let y = y.value();
                x.value().wrapping_sub(y).wrapping_sub(y)
            }
            Value::Chain(first, rest) => rest.iter().fold(first.value(), |x, (operator, y)| {
                let (y, truth) = (y.value(), |b: bool| if b { -1 } else { 0 });
                match operator {
                    '+' => x.wrapping_add(y),
                    '-' => x.wrapping_sub(y),
                    '*' => x.wrapping_mul(y),
                    '&' => x & y,
                    '|' => x | y,
                    '<' => truth(x < y),
                    '>' => truth(x > y),
                    _ => truth(x == y),
                }
            }),
        }
    }
}

fn value() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        (0..=32767_i16).prop_map(Value::Constant),
        (0..4_usize).prop_map(Value::Variable),
    ];
    leaf.prop_recursive(6, 40, 4, |inner| {
        let operator = prop::sample::select("+-*&|<>=".chars().collect::<Vec<_>>());
        let boxed = inner.clone().prop_map(Box::new);
        prop_oneof![
            boxed.clone().prop_map(Value::Element),
            boxed.clone().prop_map(Value::Negative),
            boxed.clone().prop_map(Value::Not),
            (boxed.clone(), boxed.clone()).prop_map(|(x, y)| Value::Call(x, y)),
            (boxed, prop::collection::vec((operator, inner), 1..4))
                .prop_map(|(first, rest)| Value::Chain(first, rest)),
        ]
    })
}

proptest! {
    #[test]
    fn random_expressions(values in prop::collection::vec(value(), 1..6)) {
        let mut body = String::new();
        let number = |n: i16| if n == i16::MIN { "~32767".to_string() } else { n.to_string() };
        for (index, n) in VARIABLES.into_iter().enumerate() {
            body += &format!("let v{index} = {};\n", number(n));
        }
        for (index, n) in ELEMENTS.into_iter().enumerate() {
            body += &format!("let a[{index}] = {};\n", number(n));
        }
        for value in &values {
            // Stored through an element, so that the address waits on the stack.
            body += &format!("let b[v1] = {};\ndo Out.n(b[1]);\n", value.text());
        }
        let main = format!(
            "class Main {{
                function int f(int x, int y) {{ return x - y - y; }}
                function void main() {{
                    var int v0, v1, v2, v3; var Array a, b;
                    let a = Array.new(8); let b = Array.new(2);
                    {body} return;
                }}
            }}"
        );
        let expected: Vec<_> = values.iter().map(Value::value).collect();
        prop_assert_eq!(main_numbers(&main), expected);
    }
}
