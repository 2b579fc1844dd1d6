//! Sums of summands far apart, where decision trees stand for tables, at every distance; and
//! what the tables leave behind.

use crate::classes;
use crate::log::LOG10;
use crate::parts::{ALL, ROUNDED};
use crate::tests::machine::run;
use slowlight_routine::Source;
use slowlight_routine::log::model::Log;

/// A program's files: what it does, with some parts.
fn program(body: &str, needs: &[&str]) -> Vec<(String, String)> {
    let parts = LOG10.closure(needs.iter().copied().chain(["Log"]));
    let init = match crate::has_init("Log", &parts) {
        true => "do Log.init();",
        false => "",
    };
    let main = format!("class Main {{ function void main() {{ {body} return; }} }}");
    let mut files = vec![("Main.jack".to_owned(), main.replace("INIT", init))];
    let all = classes(&parts).into_iter();
    files.extend(all.map(|(name, text)| (format!("{name}.jack"), text)));
    files
}

#[test]
fn a_tree_is_what_the_table_says_at_every_distance() {
    // Where the value changes, and what it is from there on.
    let body = |name: &str| {
        format!(
            "var int d, k, last; let d = 4608; let last = -1;
            while (d > 0) {{
                let k = Log.{name}(d);
                if (~(k = last)) {{
                    do Output.printInt(d); do Output.printChar(32);
                    do Output.printInt(k); do Output.println();
                    let last = k;
                }}
                let d = d + 1;
            }}"
        )
    };
    for (name, of) in [
        ("farSum", Log::added as fn(i32) -> i32),
        ("farDifference", Log::taken),
    ] {
        let found = run(&program(&body(name), &[&format!("Log.{name}")]));
        let mut expected = String::new();
        let mut last = -1;
        for d in 4608..32768 {
            let k = of(d);
            if k != last {
                expected += &format!("{d} {k}\n");
                last = k;
            }
        }
        assert_eq!(found.text, expected, "{name}");
        assert_eq!(expected.lines().last(), Some("11806 0"));
    }
}

#[test]
fn tables_leave_a_white_screen() {
    for need in ["Log.makeLogs", "Log.sum", "Log.difference"] {
        let found = run(&program("INIT", &[need]));
        assert!(found.screen.pixels.iter().all(|ink| *ink == 1), "{need}");
    }
}

/// In the web IDE it takes half of the heap with it.
#[test]
fn no_part_clears_the_screen() {
    for part in ALL.iter().chain(&ROUNDED) {
        let text = match part.source {
            Source::Text(text) => text.to_owned(),
            Source::Made(write) => write(),
            Source::Table(_) => String::new(),
        };
        // Where a comment says so it may stand.
        let code = text.lines().map(|line| line.trim_start());
        let mut code = code.filter(|line| !line.starts_with('*'));
        assert!(
            code.all(|line| !line.contains("clearScreen();")),
            "{}",
            part.name
        );
    }
}
