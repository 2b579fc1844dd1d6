//! The tree to VM commands: expressions and calls. Each leaves one word on
//! the stack.

use super::LARGEST;
use super::Place;
use super::emit::Emitter;
use super::symbols::Symbol;
use super::tree::{Call, Expression, Invocation, Kind, Name, Operator, Term, Type};

/// What becomes of a call that goes nowhere.
const REACHED: &str = "the program ends with an error if it comes to this call";

impl Expression<'_> {
    /// Whether this is the word `this` alone.
    pub(super) fn is_this(&self) -> bool {
        matches!(self.first, Term::This(_)) && self.rest.is_empty()
    }
}

impl<'a> Emitter<'a, '_, '_> {
    pub(super) fn expression(&mut self, expression: &Expression<'a>) {
        self.term(&expression.first);
        for (operator, place, term) in &expression.rest {
            self.term(term);
            match operator {
                Operator::Add => self.command("add"),
                Operator::Subtract => self.command("sub"),
                Operator::Multiply => self.os_call(*place, "Math", "multiply", 2),
                Operator::Divide => self.os_call(*place, "Math", "divide", 2),
                Operator::And => self.command("and"),
                Operator::Or => self.command("or"),
                Operator::Less => self.command("lt"),
                Operator::Greater => self.command("gt"),
                Operator::Equal => self.command("eq"),
            }
        }
    }

    fn term(&mut self, term: &Term<'a>) {
        match term {
            Term::Integer(value) => self.command(format_args!("push constant {value}")),
            Term::Text(text) => self.text(*text),
            Term::True => {
                self.command("push constant 0");
                self.command("not");
            }
            Term::Zero => self.command("push constant 0"),
            Term::This(place) => {
                if self.kind == Call::Function {
                    self.faults.add(*place, "a function has no `this`");
                }
                self.command("push pointer 0");
            }
            Term::Variable(name) => self.variable("push", *name),
            Term::Element(array, index) => {
                self.expression(index);
                self.variable("push", *array);
                self.command("add");
                self.command("pop pointer 1");
                self.command("push that 0");
            }
            Term::Call(call) => self.invocation(call),
            Term::Group(inner) => self.expression(inner),
            Term::Negative(inner) => {
                self.term(inner);
                self.command("neg");
            }
            Term::Not(inner) => {
                self.term(inner);
                self.command("not");
            }
        }
    }

    /// A new String, character by character; nobody but the program frees it.
    fn text(&mut self, text: Name<'a>) {
        let length = text.text.chars().count();
        if length > usize::from(LARGEST) {
            self.faults
                .add(text.place, "a string longer than 32767 characters");
            return;
        }
        self.command(format_args!("push constant {length}"));
        self.os_call(text.place, "String", "new", 1);
        for c in text.text.chars() {
            let code = u32::from(c);
            if code > u32::from(LARGEST) {
                let message = format!("the character `{}` has no 15-bit code", c.escape_debug());
                self.faults.add(text.place, message);
                return;
            }
            self.command(format_args!("push constant {code}"));
            self.os_call(text.place, "String", "appendChar", 2);
        }
    }

    /// Pushes or pops a variable.
    pub(super) fn variable(&mut self, command: &str, name: Name<'a>) {
        match self.lookup(name) {
            Some(symbol) => {
                let (segment, index) = (symbol.segment(), symbol.index);
                self.command(format_args!("{command} {segment} {index}"));
            }
            None => {
                let message = format!("there is no variable `{}`", name.text);
                self.faults.add(name.place, message);
            }
        }
    }

    /// The variable of this name; reports a field where there is no object.
    fn lookup(&mut self, name: Name<'a>) -> Option<Symbol<'a>> {
        let inner = self.scope.get(name.text);
        let symbol = inner.or_else(|| self.class_scope.get(name.text))?;
        if symbol.kind == Kind::Field && self.kind == Call::Function {
            let message = format!(
                "`{}` is a field, and a function has no object: make this a method",
                name.text
            );
            self.faults.add(name.place, message);
        }
        Some(symbol)
    }

    pub(super) fn invocation(&mut self, call: &Invocation<'a>) {
        let target = match call.receiver {
            None => self.own_object(call),
            Some(receiver) => self.receiver(receiver),
        };
        for argument in &call.arguments {
            self.expression(argument);
        }
        let Some((class, on_object)) = target else {
            return; // Reported.
        };
        self.check(call, class, on_object);
        let name = call.name.text;
        let arguments = call.arguments.len() + usize::from(on_object);
        self.command(format_args!("call {class}.{name} {arguments}"));
    }

    /// Pushes `this` for a call without a receiver: its class, and that there is an object.
    fn own_object(&mut self, call: &Invocation<'a>) -> Option<(&'a str, bool)> {
        let class = self.class.name.text;
        let name = call.name;
        let signature = self.classes.signature(class, name.text);
        // Of a function or of nothing, the call itself is wrong: `check` says so.
        if self.kind == Call::Function && signature.is_some_and(|s| s.kind == Call::Method) {
            let message = format!(
                "`{}` is a method, and a function has no object: write `object.{0}(...)`",
                name.text
            );
            self.faults.add(name.place, message);
            return None;
        }
        self.command("push pointer 0");
        Some((class, true))
    }

    /// Pushes the object before the dot, if it is one: the class to call, and whether it is.
    fn receiver(&mut self, receiver: Name<'a>) -> Option<(&'a str, bool)> {
        let name = receiver.text;
        let message = match self.lookup(receiver) {
            Some(symbol) => match symbol.of {
                Type::Class(class) => {
                    let (segment, index) = (symbol.segment(), symbol.index);
                    self.command(format_args!("push {segment} {index}"));
                    return Some((class.text, true));
                }
                Type::Plain(of) => format!("`{name}` is of type `{of}`, which has no methods"),
            },
            None => {
                if !self.classes.known(name) {
                    let message = format!("there is no variable and no class `{name}`: {REACHED}");
                    self.faults.warn(receiver.place, message);
                }
                return Some((name, false));
            }
        };
        self.faults.add(receiver.place, message);
        None
    }

    /// Holds a call against its target's signature.
    fn check(&mut self, call: &Invocation<'a>, class: &str, on_object: bool) {
        if !self.classes.known(class) {
            return; // Said where the variable is declared, or of the receiver.
        }
        let name = call.name.text;
        let given = call.arguments.len();
        let message = match self.classes.signature(class, name) {
            None if !self.classes.own(class) => {
                let message = format!("class `{class}` has no subroutine `{name}`: {REACHED}");
                self.faults.warn(call.name.place, message);
                return;
            }
            None => format!("class `{class}` has no subroutine `{name}`"),
            Some(target) => match (target.kind, on_object) {
                (Call::Method, false) => {
                    format!("`{name}` is a method of `{class}`: call it on an object")
                }
                (Call::Function | Call::Constructor, true) => {
                    format!("`{name}` is not a method: write `{class}.{name}(...)`")
                }
                _ if target.arguments != given => {
                    let (wanted, s) = (target.arguments, plural(target.arguments));
                    format!("`{class}.{name}` takes {wanted} argument{s}, not {given}")
                }
                _ => return,
            },
        };
        self.faults.add(call.name.place, message);
    }

    /// A call that the language makes by itself; `words` counts a method's object too.
    pub(super) fn os_call(&mut self, place: Place, class: &str, name: &str, words: usize) {
        let fits = self.classes.signature(class, name).is_some_and(|target| {
            target.arguments + usize::from(target.kind == Call::Method) == words
        });
        if !fits {
            self.faults.add(
                place,
                format!("this calls `{class}.{name}`, which the program's own `{class}` lacks"),
            );
        }
        self.command(format_args!("call {class}.{name} {words}"));
    }
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
