//! Random programs: the engines agree, and nothing panics or hangs.

use super::{both, link};
use crate::hack::vm::{Machine, Program};
use proptest::prelude::*;

/// Any words where commands stand; some of them right.
fn any_text() -> impl Strategy<Value = String> {
    let word = prop::sample::select(vec![
        "push",
        "pop",
        "add",
        "sub",
        "neg",
        "eq",
        "gt",
        "lt",
        "and",
        "or",
        "not",
        "label",
        "goto",
        "if-goto",
        "function",
        "call",
        "return",
        "constant",
        "local",
        "argument",
        "this",
        "that",
        "static",
        "temp",
        "pointer",
        "0",
        "1",
        "2",
        "7",
        "16",
        "256",
        "2048",
        "16384",
        "32767",
        "99999",
        "-1",
        "Main.main",
        "Main.f",
        "Sys.init",
        "Memory.poke",
        "Memory.alloc",
        "L",
        "\n",
        "\n",
        "\n",
        "//",
        "/*",
        "*/",
        "\u{e9}",
    ]);
    prop::collection::vec(word, 0..60).prop_map(|words| words.join(" "))
}

/// A whole command, right by itself; often nonsense where it stands.
pub(in crate::hack) fn any_command() -> impl Strategy<Value = String> {
    let number = prop::sample::select(vec![
        0, 1, 2, 3, 5, 7, 16, 255, 256, 261, 2047, 2048, 16384, 24575, 32767,
    ]);
    let segment = prop::sample::select(vec![
        "constant", "constant", "constant", "local", "argument", "this", "that",
    ]);
    let fixed = prop::sample::select(vec![
        "push pointer 0",
        "push pointer 1",
        "pop pointer 0",
        "pop pointer 1",
        "push temp 0",
        "pop temp 0",
        "push static 0",
        "pop static 0",
        "pop static 1",
        "add",
        "sub",
        "neg",
        "eq",
        "gt",
        "lt",
        "and",
        "or",
        "not",
        "return",
        "goto L",
        "if-goto L",
        "goto M",
        "if-goto M",
        "label L",
        "label M",
        "call Main.main 0",
        "call Main.f 1",
        "call Main.f 0",
        "call Main.f 3",
        "function Main.f 1",
        "call Memory.poke 2",
        "call Memory.peek 1",
        "call Memory.alloc 1",
        "call Memory.deAlloc 1",
        "call Math.multiply 2",
        "call Math.divide 2",
        "call Math.sqrt 1",
        "call Array.new 1",
        "call String.new 1",
        "call String.appendChar 2",
        "call String.setInt 2",
        "call String.intValue 1",
        "call String.charAt 2",
        "call Output.printString 1",
        "call Output.printInt 1",
        "call Output.printChar 1",
        "call Screen.drawPixel 2",
        "call Screen.drawLine 4",
        "call Screen.drawRectangle 4",
        "call Screen.drawCircle 3",
        "call Sys.wait 1",
        "call Sys.init 0",
    ]);
    prop_oneof![
        3 => (segment, number.clone()).prop_map(|(segment, n)| format!("push {segment} {n}")),
        1 => (prop::sample::select(vec!["local", "argument", "this", "that"]), number)
            .prop_map(|(segment, n)| format!("pop {segment} {n}")),
        4 => fixed.prop_map(str::to_owned),
    ]
}

/// Statements as Jack compilers emit them: each leaves the stack as it was.
#[derive(Clone, Debug)]
enum Statement {
    Set(usize, Expression),
    SetElement(Expression, Expression),
    If(Expression, Vec<Statement>, Vec<Statement>),
    Repeat(u16, Vec<Statement>),
    /// Stores to, and reads, the word at an address among temps and statics
    /// through `that`, which the fused engine leaves to the plain one.
    Low(u16, Expression),
}

#[derive(Clone, Debug)]
enum Expression {
    Constant(u16),
    Variable(usize),
    Element(Box<Expression>),
    Unary(&'static str, Box<Expression>),
    Binary(&'static str, Box<Expression>, Box<Expression>),
    Call(Box<Expression>, Box<Expression>),
}

/// What a variable may be; all but the last two are plain places.
const VARIABLES: [&str; 9] = [
    "local 0",
    "local 1",
    "local 2",
    "argument 0",
    "argument 1",
    "static 0",
    "temp 3",
    "this 0",
    "this 2",
];

fn expression() -> impl Strategy<Value = Expression> {
    use Expression::{Binary, Call, Constant, Element, Unary, Variable};
    let constant = prop_oneof![0..300u16, Just(32767)];
    let leaf = prop_oneof![
        constant.prop_map(Constant),
        (0..VARIABLES.len()).prop_map(Variable)
    ];
    leaf.prop_recursive(3, 12, 2, |inner| {
        let binary = prop::sample::select(vec![
            "add",
            "sub",
            "and",
            "or",
            "eq",
            "lt",
            "gt",
            "call Math.multiply 2",
            "call Math.divide 2",
            "call Math.max 2",
        ]);
        let unary = prop::sample::select(vec!["neg", "not", "call Math.abs 1"]);
        let boxed = inner.prop_map(Box::new);
        prop_oneof![
            1 => boxed.clone().prop_map(Element),
            1 => (unary, boxed.clone()).prop_map(|(op, x)| Unary(op, x)),
            5 => (binary, boxed.clone(), boxed.clone()).prop_map(|(op, x, y)| Binary(op, x, y)),
            1 => (boxed.clone(), boxed).prop_map(|(x, y)| Call(x, y)),
        ]
    })
}

fn statements() -> impl Strategy<Value = Vec<Statement>> {
    let leaf = prop_oneof![
        ((0..VARIABLES.len()), expression()).prop_map(|(to, value)| Statement::Set(to, value)),
        (expression(), expression()).prop_map(|(at, value)| Statement::SetElement(at, value)),
        ((5..40u16), expression()).prop_map(|(at, value)| Statement::Low(at, value)),
    ];
    let statement = leaf.prop_recursive(3, 24, 4, |inner| {
        let block = prop::collection::vec(inner, 0..4);
        prop_oneof![
            (expression(), block.clone(), block.clone())
                .prop_map(|(test, then, other)| Statement::If(test, then, other)),
            (1..5u16, block).prop_map(|(times, block)| Statement::Repeat(times, block)),
        ]
    });
    prop::collection::vec(statement, 1..8)
}

/// Emits commands and makes fresh labels.
#[derive(Default)]
struct Emitter {
    text: String,
    labels: usize,
}

impl Emitter {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn expression(&mut self, expression: &Expression) {
        match expression {
            Expression::Constant(value) => self.line(&format!("push constant {value}")),
            Expression::Variable(index) => self.line(&format!("push {}", VARIABLES[*index])),
            Expression::Element(at) => {
                self.line("push local 3");
                self.expression(at);
                self.line("add\npop pointer 1\npush that 0");
            }
            Expression::Unary(op, x) => {
                self.expression(x);
                self.line(op);
            }
            Expression::Binary(op, x, y) => {
                self.expression(x);
                self.expression(y);
                self.line(op);
            }
            Expression::Call(x, y) => {
                self.expression(x);
                self.expression(y);
                self.line("call Main.f 2");
            }
        }
    }

    fn block(&mut self, block: &[Statement]) {
        for statement in block {
            let label = self.labels;
            self.labels += 2;
            match statement {
                Statement::Set(to, value) => {
                    self.expression(value);
                    self.line(&format!("pop {}", VARIABLES[*to]));
                }
                Statement::SetElement(at, value) => {
                    self.line("push local 3");
                    self.expression(at);
                    self.line("add");
                    self.expression(value);
                    self.line("pop temp 0\npop pointer 1\npush temp 0\npop that 0");
                }
                Statement::Low(at, value) => {
                    self.expression(value);
                    self.line(&format!("push constant {}\npop pointer 1", at - 3));
                    self.line("pop that 3\npush that 3\npop local 2");
                }
                Statement::If(test, then, other) => {
                    self.expression(test);
                    self.line(&format!("not\nif-goto L{label}"));
                    self.block(then);
                    self.line(&format!("goto L{}\nlabel L{label}", label + 1));
                    self.block(other);
                    self.line(&format!("label L{}", label + 1));
                }
                Statement::Repeat(times, block) => {
                    self.line(&format!("push constant {times}\npop local {}", 4 + label));
                    self.line(&format!("label L{label}\npush local {}", 4 + label));
                    self.line(&format!("push constant 0\ngt\nnot\nif-goto L{}", label + 1));
                    self.block(block);
                    self.line(&format!("push local {}\npush constant 1\nsub", 4 + label));
                    self.line(&format!(
                        "pop local {}\ngoto L{label}\nlabel L{}",
                        4 + label,
                        label + 1
                    ));
                }
            }
        }
    }
}

/// A `Main.main` with two arguments' worth of work around `statements`.
fn program(main: &[Statement], function: &[Statement]) -> String {
    let mut text = String::from(
        "function Main.main 0\npush constant 3\npush constant 4\ncall Main.g 2\nreturn\n",
    );
    for (name, block) in [("Main.g", main), ("Main.f", function)] {
        let mut emitter = Emitter::default();
        // local 3 is an array of 400 words, `this` an object of 5.
        emitter.line("push constant 400\ncall Array.new 1\npop local 3");
        emitter.line("push constant 5\ncall Memory.alloc 1\npop pointer 0");
        emitter.block(block);
        emitter.line("push local 3\ncall Array.dispose 1\npop temp 0");
        emitter.line("push pointer 0\ncall Memory.deAlloc 1\npop temp 0");
        emitter.line("push local 0\nreturn");
        text.push_str(&format!(
            "function {name} {}\n{}",
            emitter.labels + 6,
            emitter.text
        ));
    }
    text
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn any_text_is_refused_or_runs_to_an_end(text in any_text()) {
        if let Ok(program) = Program::link(&[("Main.vm".to_owned(), text)]) {
            let run = Machine::new(&program).run(2_000, &mut |_| true);
            prop_assert!(run.instructions <= 2_000);
        }
    }

    #[test]
    fn any_commands_run_to_an_end(commands in prop::collection::vec(any_command(), 1..60)) {
        let text = format!("function Main.main 2\n{}", commands.join("\n"));
        if let Ok(program) = Program::link(&[("Main.vm".to_owned(), text)]) {
            let run = Machine::new(&program).run(5_000, &mut |_| true);
            prop_assert!(run.instructions <= 5_000);
        }
    }

    #[test]
    fn the_engines_agree(main in statements(), function in statements(), limit in 1..30_000u64) {
        let text = program(&main, &function);
        let program = link(&[("Main.vm", &text)]);
        prop_assert!(program.fused.is_some());
        let mut plain = program.clone();
        both(&program, &mut plain, limit);
    }
}
