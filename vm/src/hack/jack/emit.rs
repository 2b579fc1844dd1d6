//! The tree to VM commands: a class, its subroutines and their statements.
//! Expressions and calls are in [`super::value`].
//!
//! The emitter goes on after a fault, to find the next; the text that it made
//! is then thrown away.

use super::classes::Classes;
use super::symbols::Scope;
use super::tree::{Call, Class, Expression, Kind, Name, Statement, Subroutine, Type};
use super::{Faults, Place, STATICS, VmFile};
use std::fmt::{self, Write as _};

/// The commands of a class. `statics` is how many the classes before it have.
pub(super) fn class<'a>(
    class: &'a Class<'a>,
    classes: &'a Classes<'a>,
    statics: &mut u32,
    faults: &mut Faults,
) -> VmFile {
    let variables = Scope::of(class.variables.iter().copied(), 0, faults);
    let own_statics = variables.count(Kind::Static);
    check_statics(class, *statics, faults);
    *statics = statics.saturating_add(own_statics);
    let mut emitter = Emitter {
        class,
        classes,
        class_scope: variables,
        scope: Scope::default(),
        kind: Call::Function,
        void: true,
        ifs: 0,
        whiles: 0,
        out: String::new(),
        line: class.name.place.line,
        lines: Vec::new(),
        faults,
    };
    emitter.types(class.variables.iter().map(|variable| variable.of));
    for subroutine in &class.subroutines {
        emitter.subroutine(subroutine);
    }
    VmFile {
        name: format!("{}.vm", class.name.text),
        text: emitter.out,
        lines: emitter.lines,
        statics: own_statics,
    }
}

/// Reports the static that does not fit, if `before` are taken.
fn check_statics(class: &Class, before: u32, faults: &mut Faults) {
    let mut statics = class.variables.iter().filter(|v| v.kind == Kind::Static);
    let Some(free) = STATICS.checked_sub(before) else {
        return; // Reported where it happened.
    };
    if let Some(first) = statics.nth(usize::try_from(free).unwrap_or(usize::MAX)) {
        faults.add(
            first.name.place,
            format!("more than {STATICS} statics in all classes: use fields or an array"),
        );
    }
}

/// Walks one class.
pub(super) struct Emitter<'a, 'f, 'n> {
    pub(super) class: &'a Class<'a>,
    pub(super) classes: &'a Classes<'a>,
    /// Statics and fields.
    pub(super) class_scope: Scope<'a>,
    /// The subroutine's parameters and locals.
    pub(super) scope: Scope<'a>,
    /// The subroutine's kind.
    pub(super) kind: Call,
    void: bool,
    /// How many `if` the subroutine has so far, for the labels.
    ifs: u32,
    whiles: u32,
    out: String,
    /// The source's line that commands are written for now.
    line: u32,
    /// The source's line of each command.
    lines: Vec<u32>,
    pub(super) faults: &'f mut Faults<'n>,
}

impl<'a> Emitter<'a, '_, '_> {
    fn subroutine(&mut self, subroutine: &Subroutine<'a>) {
        let (name, class) = (subroutine.name.text, self.class.name.text);
        let variables = subroutine.parameters.iter().chain(&subroutine.locals);
        self.types(subroutine.returns.into_iter());
        self.types(variables.clone().map(|variable| variable.of));
        let first_parameter = u16::from(subroutine.kind == Call::Method);
        self.scope = Scope::of(variables.copied(), first_parameter, self.faults);
        self.kind = subroutine.kind;
        self.void = subroutine.returns.is_none();
        (self.ifs, self.whiles) = (0, 0);
        let locals = self.scope.count(Kind::Local);
        self.line = subroutine.name.place.line;
        self.command(format_args!("function {class}.{name} {locals}"));
        match subroutine.kind {
            Call::Constructor => self.allocation(subroutine),
            Call::Method => {
                self.command("push argument 0");
                self.command("pop pointer 0");
            }
            Call::Function => {}
        }
        self.statements(&subroutine.body);
        if may_fall_through(&subroutine.body) {
            self.faults.add(
                subroutine.end,
                format!(
                    "`{name}` may end without `return`: its last statement must be one, \
                     or an `if` and `else` that both end in one"
                ),
            );
        }
    }

    /// Makes a constructor's object.
    fn allocation(&mut self, subroutine: &Subroutine) {
        let class = self.class.name.text;
        let name = subroutine.name;
        if !matches!(subroutine.returns, Some(Type::Class(of)) if of.text == class) {
            self.faults.add(
                name.place,
                format!("the constructor `{}` must be of type `{class}`", name.text),
            );
        }
        // Memory.alloc(0) is an error of the OS, and no two objects may share an address.
        let words = self.class_scope.count(Kind::Field).max(1);
        self.command(format_args!("push constant {words}"));
        self.os_call(name.place, "Memory", "alloc", 1);
        self.command("pop pointer 0");
    }

    fn statements(&mut self, statements: &[Statement<'a>]) {
        for statement in statements {
            self.statement(statement);
        }
    }

    fn statement(&mut self, statement: &Statement<'a>) {
        let outer = std::mem::replace(&mut self.line, statement.place().line);
        match statement {
            Statement::Let {
                target,
                index: None,
                value,
            } => {
                self.expression(value);
                self.variable("pop", *target);
            }
            Statement::Let {
                target,
                index: Some(index),
                value,
            } => self.element_assignment(*target, index, value),
            Statement::If {
                condition,
                then,
                otherwise,
                ..
            } => self.branch(condition, then, otherwise.as_deref()),
            Statement::While {
                condition, body, ..
            } => self.repetition(condition, body),
            Statement::Do(call) => {
                self.invocation(call);
                self.command("pop temp 0");
            }
            Statement::Return { place, value } => self.leave(*place, value.as_ref()),
        }
        self.line = outer;
    }

    /// The value is computed before `pointer 1` is set, as it may set it too.
    fn element_assignment(
        &mut self,
        array: Name<'a>,
        index: &Expression<'a>,
        value: &Expression<'a>,
    ) {
        self.expression(index);
        self.variable("push", array);
        self.command("add");
        self.expression(value);
        self.command("pop temp 0");
        self.command("pop pointer 1");
        self.command("push temp 0");
        self.command("pop that 0");
    }

    fn branch(
        &mut self,
        condition: &Expression<'a>,
        then: &[Statement<'a>],
        otherwise: Option<&[Statement<'a>]>,
    ) {
        let label = self.ifs;
        self.ifs += 1;
        self.expression(condition);
        self.command(format_args!("if-goto IF_TRUE{label}"));
        self.command(format_args!("goto IF_FALSE{label}"));
        self.command(format_args!("label IF_TRUE{label}"));
        self.statements(then);
        if let Some(otherwise) = otherwise {
            self.command(format_args!("goto IF_END{label}"));
            self.command(format_args!("label IF_FALSE{label}"));
            self.statements(otherwise);
            self.command(format_args!("label IF_END{label}"));
        } else {
            self.command(format_args!("label IF_FALSE{label}"));
        }
    }

    fn repetition(&mut self, condition: &Expression<'a>, body: &[Statement<'a>]) {
        let label = self.whiles;
        self.whiles += 1;
        self.command(format_args!("label WHILE_EXP{label}"));
        self.expression(condition);
        self.command("not");
        self.command(format_args!("if-goto WHILE_END{label}"));
        self.statements(body);
        self.command(format_args!("goto WHILE_EXP{label}"));
        self.command(format_args!("label WHILE_END{label}"));
    }

    fn leave(&mut self, place: Place, value: Option<&Expression<'a>>) {
        if self.kind == Call::Constructor && !value.is_some_and(Expression::is_this) {
            self.faults.add(place, "a constructor must `return this;`");
        } else if self.void && value.is_some() {
            self.faults.add(place, "a void subroutine returns no value");
        } else if !self.void && value.is_none() {
            self.faults
                .add(place, "this subroutine must return a value");
        }
        match value {
            Some(value) => self.expression(value),
            // A call always leaves a word on the stack.
            None => self.command("push constant 0"),
        }
        self.command("return");
    }

    /// Warns of the classes that are not there, each declaration's once: what is of
    /// such a type is a word like any other.
    fn types(&mut self, types: impl Iterator<Item = Type<'a>>) {
        let mut last = None;
        for of in types {
            if let Type::Class(name) = of
                && !self.classes.known(name.text)
                && last != Some(name.place)
            {
                last = Some(name.place);
                let message = format!("there is no class `{}`", name.text);
                self.faults.warn(name.place, message);
            }
        }
    }

    pub(super) fn command(&mut self, command: impl fmt::Display) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.out, "{command}");
        self.lines.push(self.line);
    }
}

/// Whether control may leave these statements at their end.
fn may_fall_through(statements: &[Statement]) -> bool {
    match statements.last() {
        Some(Statement::Return { .. }) => false,
        Some(Statement::If {
            then,
            otherwise: Some(otherwise),
            ..
        }) => may_fall_through(then) || may_fall_through(otherwise),
        _ => true,
    }
}
