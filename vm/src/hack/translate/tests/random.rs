//! Programs at random, as Jack compilers make them and beyond.

use super::{link, same, ways};
use crate::hack::cpu::Cpu;
use crate::hack::translate::translate;
use crate::hack::vm::Program;
use crate::hack::vm::tests::engines::any_command;
use proptest::prelude::*;

#[derive(Clone, Debug)]
enum Statement {
    Set(usize, Expression),
    /// An element, in one of two ways of compilers, or by `Memory.poke`.
    SetElement(u8, Expression, Expression),
    If(bool, Expression, Vec<Statement>, Vec<Statement>),
    Repeat(u16, Vec<Statement>),
    Return(Expression, Expression),
}

#[derive(Clone, Debug)]
enum Expression {
    Constant(u16),
    Variable(usize),
    Element(bool, Box<Expression>),
    Unary(&'static str, Box<Expression>),
    Binary(&'static str, Box<Expression>, Box<Expression>),
    Call(usize, Box<Expression>, Box<Expression>),
    /// Two ways to one value, which waits on the stack.
    Choice(Box<Expression>, Box<Expression>, Box<Expression>),
}

const VARIABLES: [&str; 13] = [
    "local 0",
    "local 1",
    "local 2",
    "argument 0",
    "argument 1",
    "static 0",
    "static 1",
    "static 2",
    "temp 3",
    "this 0",
    "this 2",
    "this 9",
    "pointer 0",
];

/// The last of them may be read, not written.
const WRITTEN: usize = VARIABLES.len() - 1;

/// Each may call those behind it; the last calls itself while its second
/// argument, made small, lasts.
const FUNCTIONS: [&str; 4] = ["Main.f", "Other.g", "Other.h", "Main.again"];

fn expression() -> impl Strategy<Value = Expression> {
    use Expression::{Binary, Call, Choice, Constant, Element, Unary, Variable};
    let constant = prop_oneof![4 => 0..4u16, 2 => 0..300u16, 1 => Just(32767)];
    let leaf = prop_oneof![
        constant.prop_map(Constant),
        (0..VARIABLES.len()).prop_map(Variable)
    ];
    leaf.prop_recursive(4, 16, 2, |inner| {
        let binary = prop::sample::select(vec!["add", "sub", "and", "or", "eq", "lt", "gt"]);
        let unary = prop::sample::select(vec!["neg", "not"]);
        let boxed = inner.prop_map(Box::new);
        // Often a field that is not among the first few.
        let argument = prop_oneof![boxed.clone(), Just(Box::new(Variable(11)))];
        prop_oneof![
            1 => (any::<bool>(), boxed.clone()).prop_map(|(peek, x)| Element(peek, x)),
            2 => (unary, boxed.clone()).prop_map(|(op, x)| Unary(op, x)),
            6 => (binary, boxed.clone(), boxed.clone()).prop_map(|(op, x, y)| Binary(op, x, y)),
            1 => (0..FUNCTIONS.len(), argument.clone(), argument)
                .prop_map(|(f, x, y)| Call(f, x, y)),
            1 => (boxed.clone(), boxed.clone(), boxed)
                .prop_map(|(test, x, y)| Choice(test, x, y)),
        ]
    })
}

fn statements() -> impl Strategy<Value = Vec<Statement>> {
    let leaf = prop_oneof![
        8 => (0..WRITTEN, expression()).prop_map(|(to, value)| Statement::Set(to, value)),
        3 => (0..4u8, expression(), expression())
            .prop_map(|(way, at, value)| Statement::SetElement(way, at, value)),
        1 => (expression(), expression())
            .prop_map(|(test, value)| Statement::Return(test, value)),
    ];
    let statement = leaf.prop_recursive(3, 16, 4, |inner| {
        let block = prop::collection::vec(inner, 0..4);
        prop_oneof![
            (any::<bool>(), expression(), block.clone(), block.clone())
                .prop_map(|(way, test, then, other)| Statement::If(way, test, then, other)),
            (1..4u16, block).prop_map(|(times, block)| Statement::Repeat(times, block)),
        ]
    });
    prop::collection::vec(statement, 1..6)
}

/// Emits commands and makes fresh labels.
struct Emitter {
    text: String,
    labels: usize,
    /// Which of the functions it is.
    index: usize,
}

impl Emitter {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn fresh(&mut self) -> usize {
        self.labels += 2;
        self.labels - 2
    }

    fn address(&mut self, at: &Expression) {
        self.line("push local 3");
        self.expression(at);
        self.line("push constant 63\nand\nadd");
    }

    fn expression(&mut self, expression: &Expression) {
        match expression {
            Expression::Constant(value) => self.line(&format!("push constant {value}")),
            Expression::Variable(index) => self.line(&format!("push {}", VARIABLES[*index])),
            Expression::Element(peek, at) => {
                self.address(at);
                self.line(if *peek {
                    "call Memory.peek 1"
                } else {
                    "pop pointer 1\npush that 0"
                });
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
            Expression::Call(function, x, y) => {
                self.expression(x);
                self.expression(y);
                match FUNCTIONS.get(self.index + 1 + function % 4) {
                    Some(name) => self.line(&format!("call {name} 2")),
                    None if self.index + 1 == FUNCTIONS.len() => {
                        // Only so deep.
                        self.line("pop local 2\npush local 4\npush constant 1\nsub");
                        self.line("push constant 3\nand\ncall Main.again 2");
                    }
                    None => self.line("sub"),
                }
            }
            Expression::Choice(test, x, y) => {
                let label = self.fresh();
                self.expression(test);
                self.line(&format!("if-goto L{label}"));
                self.expression(x);
                self.line(&format!("goto L{}\nlabel L{label}", label + 1));
                self.expression(y);
                self.line(&format!("label L{}", label + 1));
            }
        }
    }

    fn block(&mut self, block: &[Statement]) {
        for statement in block {
            self.statement(statement);
        }
    }

    fn statement(&mut self, statement: &Statement) {
        let label = self.fresh();
        match statement {
            Statement::Set(to, value) => {
                self.expression(value);
                self.line(&format!("pop {}", VARIABLES[*to]));
            }
            Statement::SetElement(0, at, value) => {
                self.expression(value);
                self.address(at);
                self.line("pop pointer 1\npop that 0");
            }
            Statement::SetElement(1, at, value) => {
                self.address(at);
                self.expression(value);
                self.line("call Memory.poke 2\npop temp 0");
            }
            Statement::SetElement(2, at, value) => {
                self.address(at);
                self.line("pop pointer 1");
                self.expression(value);
                self.line("pop that 1\npush that 2\npop that 0");
            }
            Statement::SetElement(_, at, value) => {
                self.address(at);
                self.expression(value);
                self.line("pop temp 0\npop pointer 1\npush temp 0\npop that 0");
            }
            Statement::If(inverted, test, then, other) => {
                self.expression(test);
                if *inverted {
                    self.line(&format!("not\nif-goto L{label}"));
                } else {
                    self.line(&format!("if-goto T{label}\ngoto L{label}\nlabel T{label}"));
                }
                self.block(then);
                self.line(&format!("goto L{}\nlabel L{label}", label + 1));
                self.block(other);
                self.line(&format!("label L{}", label + 1));
            }
            Statement::Repeat(times, block) => {
                let count = format!("local {}", 5 + label);
                self.line(&format!("push constant {times}\npop {count}"));
                self.line(&format!("label L{label}\npush {count}"));
                self.line(&format!("push constant 0\ngt\nnot\nif-goto L{}", label + 1));
                self.block(block);
                self.line(&format!("push {count}\npush constant 1\nsub\npop {count}"));
                self.line(&format!("goto L{label}\nlabel L{}", label + 1));
            }
            Statement::Return(test, value) => {
                self.expression(test);
                self.line(&format!("if-goto L{label}"));
                self.expression(value);
                self.line(&format!("return\nlabel L{label}"));
            }
        }
    }
}

/// The program in two files, each with its statics.
fn program(blocks: &[Vec<Statement>]) -> [String; 2] {
    let mut files = [
        String::from(
            "function Sys.init 0\npush constant 3\npush constant 4\ncall Main.f 2\npop static 0\n\
            push constant 7\nneg\npush constant 2\ncall Other.g 2\npop static 1\n\
            call Sys.halt 0\nreturn\n",
        ),
        String::new(),
    ];
    for (index, (name, block)) in FUNCTIONS.iter().zip(blocks).enumerate() {
        let mut emitter = Emitter {
            text: String::new(),
            labels: 0,
            index,
        };
        // local 3 is an array, `this` an object, local 4 how often it goes on.
        emitter.line("push constant 3000\npop local 3");
        emitter.line(&format!(
            "push constant {}\npop pointer 0",
            4000 + 8 * index
        ));
        emitter.line("push argument 1\npush constant 3\nand\npop local 4");
        if index + 1 == FUNCTIONS.len() {
            emitter.line("push local 4\nif-goto ON\npush argument 0\nreturn\nlabel ON");
        }
        emitter.block(block);
        emitter.line("push local 0\nreturn");
        let locals = emitter.labels + 7;
        files[usize::from(name.starts_with("Other"))]
            .push_str(&format!("function {name} {locals}\n{}", emitter.text));
    }
    files
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn the_cpu_leaves_what_the_vm_leaves(
        blocks in prop::collection::vec(statements(), 4),
    ) {
        let [main, other] = program(&blocks);
        let program = link(&[("Main.vm", &main), ("Other.vm", &other)]);
        let mut vm = crate::hack::vm::Machine::new(&program);
        // Recursion in loops may take for ever.
        let run = vm.run(200_000, &mut |_| true);
        prop_assume!(run.stop == crate::Stop::Ended);
        same(&program, false);
    }

    #[test]
    fn any_commands_are_translated_or_refused(commands in prop::collection::vec(any_command(), 1..80)) {
        let text = format!("function Main.main 2\n{}", commands.join("\n"));
        if let Ok(program) = Program::link(&[("Main.vm".to_owned(), text)]) {
            for options in ways() {
                if let Ok(translation) = translate(&program, options) {
                    let mut cpu = Cpu::new(&translation.words).unwrap();
                    cpu.run(10_000, &mut |_| true);
                }
            }
        }
    }
}
