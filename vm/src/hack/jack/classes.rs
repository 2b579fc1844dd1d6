//! What a program may call: the signatures of its classes and of the OS.

use super::tree::Call::{self, Constructor, Function, Method};
use super::tree::Class;
use super::{Faults, LARGEST};
use std::collections::{HashMap, HashSet};

/// What a call must match.
#[derive(Clone, Copy, Debug)]
pub(super) struct Signature {
    pub kind: Call,
    /// Written arguments: a method's `this` is not counted.
    pub arguments: usize,
}

/// Every class that the program may name, with its subroutines.
pub(super) struct Classes<'a> {
    of: HashMap<&'a str, HashMap<&'a str, Signature>>,
    /// Those that the program brings.
    own: HashSet<&'a str>,
}

impl<'a> Classes<'a> {
    /// The OS, overlaid with the program's classes. Reports classes that are
    /// there twice or not named as their file, and subroutines that are there
    /// twice.
    pub(super) fn of(parsed: &[(&'a str, Class<'a>)], faults: &mut Faults<'a>) -> Self {
        let mut of = HashMap::new();
        for (class, subroutines) in OS {
            let signatures = subroutines.iter().map(|(name, kind, arguments)| {
                let (kind, arguments) = (*kind, *arguments);
                (*name, Signature { kind, arguments })
            });
            of.insert(*class, signatures.collect::<HashMap<_, _>>());
        }
        let mut first_in: HashMap<&str, &str> = HashMap::new();
        for (file, class) in parsed {
            faults.file = file;
            let name = class.name;
            let stem = stem(file);
            if stem != name.text {
                faults.add(
                    name.place,
                    format!(
                        "the file `{stem}` holds class `{}`: name them alike",
                        name.text
                    ),
                );
            }
            if let Some(first) = first_in.insert(name.text, file) {
                faults.add(
                    name.place,
                    format!("class `{}` is already in {first}", name.text),
                );
            }
            of.insert(name.text, signatures(class, faults));
        }
        let own = parsed.iter().map(|(_, class)| class.name.text).collect();
        Classes { of, own }
    }

    /// Whether the program brings the class.
    pub(super) fn own(&self, class: &str) -> bool {
        self.own.contains(class)
    }

    pub(super) fn known(&self, class: &str) -> bool {
        self.of.contains_key(class)
    }

    /// `None` if the class has no such subroutine, or is not known.
    pub(super) fn signature(&self, class: &str, subroutine: &str) -> Option<Signature> {
        self.of.get(class)?.get(subroutine).copied()
    }
}

fn signatures<'a>(class: &Class<'a>, faults: &mut Faults) -> HashMap<&'a str, Signature> {
    let mut signatures = HashMap::new();
    for subroutine in &class.subroutines {
        let name = subroutine.name;
        let signature = Signature {
            kind: subroutine.kind,
            arguments: subroutine.parameters.len(),
        };
        if signature.arguments >= usize::from(LARGEST) {
            faults.add(
                name.place,
                format!("`{}` has too many parameters", name.text),
            );
        }
        if signatures.insert(name.text, signature).is_some() {
            faults.add(
                name.place,
                format!("class `{}` already has a `{}`", class.name.text, name.text),
            );
        }
    }
    signatures
}

/// A file's name without its folders and its extension.
pub(super) fn stem(file: &str) -> &str {
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// Names, kinds and counts of written arguments.
type OsSubroutines = &'static [(&'static str, Call, usize)];

/// The standard OS (the book's appendix 6): its subroutines, kinds and
/// argument counts. The `init` functions are what a `Sys` of one's own calls.
const OS: &[(&str, OsSubroutines)] = &[
    ("Array", &[("new", Function, 1), ("dispose", Method, 0)]),
    (
        "Keyboard",
        &[
            ("init", Function, 0),
            ("keyPressed", Function, 0),
            ("readChar", Function, 0),
            ("readLine", Function, 1),
            ("readInt", Function, 1),
        ],
    ),
    (
        "Math",
        &[
            ("init", Function, 0),
            ("abs", Function, 1),
            ("multiply", Function, 2),
            ("divide", Function, 2),
            ("min", Function, 2),
            ("max", Function, 2),
            ("sqrt", Function, 1),
        ],
    ),
    (
        "Memory",
        &[
            ("init", Function, 0),
            ("peek", Function, 1),
            ("poke", Function, 2),
            ("alloc", Function, 1),
            ("deAlloc", Function, 1),
        ],
    ),
    (
        "Output",
        &[
            ("init", Function, 0),
            ("moveCursor", Function, 2),
            ("printChar", Function, 1),
            ("printString", Function, 1),
            ("printInt", Function, 1),
            ("println", Function, 0),
            ("backSpace", Function, 0),
        ],
    ),
    (
        "Screen",
        &[
            ("init", Function, 0),
            ("clearScreen", Function, 0),
            ("setColor", Function, 1),
            ("drawPixel", Function, 2),
            ("drawLine", Function, 4),
            ("drawRectangle", Function, 4),
            ("drawCircle", Function, 3),
        ],
    ),
    (
        "String",
        &[
            ("new", Constructor, 1),
            ("dispose", Method, 0),
            ("length", Method, 0),
            ("charAt", Method, 1),
            ("setCharAt", Method, 2),
            ("appendChar", Method, 1),
            ("eraseLastChar", Method, 0),
            ("intValue", Method, 0),
            ("setInt", Method, 1),
            ("newLine", Function, 0),
            ("backSpace", Function, 0),
            ("doubleQuote", Function, 0),
        ],
    ),
    (
        "Sys",
        &[
            ("init", Function, 0),
            ("halt", Function, 0),
            ("error", Function, 1),
            ("wait", Function, 1),
        ],
    ),
];
