//! What a program that is not yet linked has and calls: who brings it an operating
//! system needs to know that.

use super::parse::{Written, parse};
use crate::Fault;
use std::collections::{BTreeMap, BTreeSet};

/// The functions of some files of VM code.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// All that they have.
    pub has: BTreeSet<String>,
    /// All that they call.
    pub calls: BTreeSet<String>,
    /// Of these, what is called on the ways from where a program starts: `Sys.init`,
    /// `Main.main`, and the `init` of any class.
    pub reached: BTreeSet<String>,
}

impl Names {
    /// Reads `.vm` files, each a name and a text.
    ///
    /// # Errors
    /// What is wrong with their commands, by file and line.
    pub fn of(files: &[(String, String)]) -> Result<Names, Vec<Fault>> {
        let mut faults = Vec::new();
        let mut callees: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for (name, text) in files {
            let mut now = "";
            for line in parse(name, text, &mut faults) {
                match line.what {
                    Written::Function(function, _) => {
                        now = function;
                        callees.entry(now).or_default();
                    }
                    Written::Call(function, _) => callees.entry(now).or_default().push(function),
                    _ => {}
                }
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let starts = |name: &&str| *name == "Main.main" || name.ends_with(".init");
        let mut work: Vec<&str> = callees.keys().copied().filter(starts).collect();
        let mut seen: BTreeSet<&str> = work.iter().copied().collect();
        let mut reached = BTreeSet::new();
        while let Some(function) = work.pop() {
            for callee in callees.get(function).into_iter().flatten() {
                reached.insert((*callee).to_owned());
                if seen.insert(callee) {
                    work.push(callee);
                }
            }
        }
        let has = callees.keys().map(|name| (*name).to_owned());
        let calls = callees.values().flatten().map(|name| (*name).to_owned());
        Ok(Names {
            has: has.filter(|name| !name.is_empty()).collect(),
            calls: calls.collect(),
            reached,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calls_are_those_that_can_happen() {
        let text = "function Main.main 0\ncall Main.a 0\nreturn\n\
            function Main.a 0\ncall Screen.clearScreen 0\nreturn\n\
            function Main.b 0\ncall Output.println 0\nreturn\n\
            function Own.init 0\ncall Math.sqrt 1\nreturn\n";
        let names = Names::of(&[("Main.vm".to_owned(), text.to_owned())]);
        let names = names.unwrap_or_default();
        let reached: Vec<&str> = names.reached.iter().map(String::as_str).collect();
        assert_eq!(reached, ["Main.a", "Math.sqrt", "Screen.clearScreen"]);
        assert_eq!(names.calls.len(), 4);
        let has: Vec<&str> = names.has.iter().map(String::as_str).collect();
        assert_eq!(has, ["Main.a", "Main.b", "Main.main", "Own.init"]);
    }

    #[test]
    fn what_is_no_command_is_a_fault() {
        assert!(Names::of(&[("Main.vm".to_owned(), "jump".to_owned())]).is_err());
    }
}
