//! Calls of functions that do not exist: what stands in for those, so that a program
//! fails only where it comes to one.

use super::names::Names;
use super::os::Native;
use super::parse::{Written, fault, parse};
use crate::Fault;
use std::collections::BTreeSet;

/// What goes in messages for the file of the functions that are missing.
pub(super) const FILE: &str = "(no such function)";

/// The number that `Sys.error` is given by a function that is missing; the operating
/// system's own end at 20.
pub const ERROR: i16 = 255;

/// Functions that a program calls and nobody has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Missing {
    names: BTreeSet<String>,
    /// Each call of one.
    pub calls: Vec<Fault>,
}

impl Missing {
    /// Looks for them in `.vm` files, each a name and a text, that are all of the program.
    ///
    /// # Errors
    /// What is wrong with their commands, by file and line.
    pub fn of(files: &[(String, String)]) -> Result<Missing, Vec<Fault>> {
        let Names { has, calls, .. } = Names::of(files)?;
        let nobody = |name: &String| !has.contains(name) && Native::named(name).is_none();
        let names: BTreeSet<String> = calls.into_iter().filter(nobody).collect();
        let mut found = Missing::default();
        for (file, text) in files {
            for line in parse(file, text, &mut Vec::new()) {
                if let Written::Call(name, _) = line.what
                    && names.contains(name)
                {
                    let message = format!(
                        "there is no function {name}: the program ends with an error if it comes to this call"
                    );
                    found.calls.push(fault(file, line.line, message));
                }
            }
        }
        Ok(Missing { names, ..found })
    }

    /// A file of functions in their place, which give up; none where nothing is missing.
    pub fn file(&self) -> Option<(String, String)> {
        let text: String = self.names.iter().map(|name| gives_up(name)).collect();
        (!text.is_empty()).then(|| (FILE.to_owned(), text))
    }

    /// A file that calls what that file calls, and is of no class that a program may lack:
    /// for who looks what an operating system must have.
    pub fn calling(&self) -> Option<(String, String)> {
        let text = gives_up("Missing.error");
        (!self.names.is_empty()).then(|| (FILE.to_owned(), text))
    }
}

fn gives_up(name: &str) -> String {
    format!("function {name} 0\npush constant {ERROR}\ncall Sys.error 1\nreturn\n")
}
