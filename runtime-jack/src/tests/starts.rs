//! What makes the tables that routines read takes the commands that its part says.

use super::machine::run;
use crate::fixed::FIXED16;
use crate::log::LOG10;
use crate::parts::class_of;
use crate::wide::F416;
use crate::{F316, F316R, classes};
use slowlight_routine::Part;

/// The VM commands of a program that makes what all parts keep up to one, that included or
/// not: makers need what those before them made.
fn started(all: &[&Part], part: &Part, included: bool) -> u64 {
    let class = class_of(part);
    let main = format!("class Main {{ function void main() {{ do {class}.init(); return; }} }}");
    let mut files = vec![("Main.jack".to_owned(), main)];
    let call = format!("        do {}();\n", part.name);
    for (name, text) in classes(all) {
        let ended = match included {
            true => format!("{call} return;"),
            false => format!("return; {call}"),
        };
        files.push((format!("{name}.jack"), text.replacen(&call, &ended, 1)));
    }
    run(&files).instructions
}

#[test]
fn parts_start_as_they_say() {
    let mut differ = Vec::new();
    for runtime in [&F316, &F316R, &F416, &LOG10, &FIXED16] {
        // Runtimes list parts of all, and have those that their routines need.
        let needs = runtime.routines.iter().flat_map(|r| r.needs);
        let all = runtime.closure(needs.copied().chain(["Float", "Log", "Fixed"]));
        for part in &all {
            let made = match part.name.contains(".make") {
                true => started(&all, part, true) - started(&all, part, false),
                false => 0,
            };
            if made != u64::from(part.starts) {
                differ.push((runtime.format, part.name, made));
            }
        }
    }
    assert_eq!(differ, []);
}
