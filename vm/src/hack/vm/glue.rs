//! VM code that stands in for native functions which build on functions
//! that the program defines itself.
//!
//! A program may bring some classes of the operating system and leave others
//! to the machine. Where a native function would call one that the program
//! brings (`Array.new` calls `Memory.alloc`), it must call the program's. So
//! it is linked in as VM code instead; its commands then count like any
//! others.

use super::link::Source;
use super::parse::Written;
use std::collections::HashSet;

/// A function in VM code, used if the program defines one of `calls` and not
/// the function itself.
struct Glue {
    name: &'static str,
    calls: &'static [&'static str],
    text: &'static str,
}

/// What goes in messages for the file of linked-in functions.
pub(super) const FILE: &str = "(operating system)";

const GLUE: &[Glue] = &[
    Glue {
        name: "Array.new",
        calls: &["Memory.alloc"],
        text: "function Array.new 0
            push argument 0
            push constant 1
            lt
            not
            if-goto FITS
            push constant 2
            call Sys.error 1
            pop temp 0
            label FITS
            push argument 0
            call Memory.alloc 1
            return",
    },
    Glue {
        name: "Array.dispose",
        calls: &["Memory.deAlloc"],
        text: "function Array.dispose 0
            push argument 0
            call Memory.deAlloc 1
            return",
    },
    Glue {
        name: "String.new",
        calls: &["Memory.alloc"],
        text: "function String.new 0
            push argument 0
            push constant 0
            lt
            not
            if-goto FITS
            push constant 14
            call Sys.error 1
            pop temp 0
            label FITS
            push argument 0
            push constant 2
            add
            call Memory.alloc 1
            pop pointer 0
            push argument 0
            pop this 0
            push constant 0
            pop this 1
            push pointer 0
            return",
    },
    Glue {
        name: "String.dispose",
        calls: &["Memory.deAlloc"],
        text: "function String.dispose 0
            push argument 0
            call Memory.deAlloc 1
            return",
    },
    Glue {
        name: "Output.printString",
        calls: &["String.length", "String.charAt", "Output.printChar"],
        text: "function Output.printString 1
            label NEXT
            push local 0
            push argument 0
            call String.length 1
            lt
            not
            if-goto DONE
            push argument 0
            push local 0
            call String.charAt 2
            call Output.printChar 1
            pop temp 0
            push local 0
            push constant 1
            add
            pop local 0
            goto NEXT
            label DONE
            push constant 0
            return",
    },
];

/// The text of the functions that this program needs beside its own and the native ones.
pub(super) fn linked_in(sources: &[Source]) -> String {
    let mut defined = HashSet::new();
    let mut calls_init = false;
    for line in sources.iter().flat_map(|source| &source.lines) {
        match line.what {
            Written::Function(name, _) => {
                defined.insert(name);
            }
            Written::Call("Sys.init", _) => calls_init = true,
            _ => {}
        }
    }
    let has = |name: &str| defined.contains(name);
    let mut text = String::new();
    for glue in GLUE {
        if !has(glue.name) && glue.calls.iter().any(|name| has(name)) {
            text.push_str(glue.text);
            text.push('\n');
        }
    }
    if !has("Sys.init") && has("Main.main") {
        match initialiser(has) {
            Some(init) => text.push_str(&init),
            None if calls_init => text.push_str(
                "function Sys.init 0\ncall Main.main 0\npop temp 0\ncall Sys.halt 0\nreturn\n",
            ),
            None => {}
        }
    }
    text
}

/// The classes that the native `Sys.init` initialises, in its order.
const INITIALISED: &[&str] = &[
    "Memory.init",
    "Math.init",
    "Screen.init",
    "Output.init",
    "Keyboard.init",
];

/// A `Sys.init` that initialises the classes which the program brings and
/// runs `Main.main`; `None` if it brings no initialiser.
fn initialiser(defined: impl Fn(&str) -> bool) -> Option<String> {
    let mut text = String::from("function Sys.init 0\n");
    let plain = text.len();
    for name in INITIALISED {
        if defined(name) {
            text.push_str(&format!("call {name} 0\npop temp 0\n"));
        }
    }
    if text.len() == plain {
        return None;
    }
    text.push_str("call Main.main 0\npop temp 0\ncall Sys.halt 0\nreturn\n");
    Some(text)
}
