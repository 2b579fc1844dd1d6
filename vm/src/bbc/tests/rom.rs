//! Small programs and what the genuine BASIC II prints for them, recorded from the ROM
//! (`tests/all/peers_basic.rs` holds the records against it).

use super::cases::{Case, SUBJECTS, cases};
use super::*;

/// What is on the screen when BASIC wants its next line.
fn screen(case: &Case<'_>) -> String {
    let mut machine = Machine::new(Config::default());
    machine.load_text(case.program).unwrap();
    machine.type_lines(&case.input);
    let run = machine.run(20_000_000, &mut |_| true);
    match run.stop {
        Stop::Ended => run.text,
        Stop::Fault(Fault { message, line, .. }) => {
            let line = line.map_or(String::new(), |n| format!(" at line {n}"));
            format!("{}\n{message}{line}\n", run.text)
        }
        other => format!("{}\n{other:?}", run.text),
    }
}

#[test]
fn programs_print_what_they_do_on_the_rom() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for (subject, text) in SUBJECTS {
        for case in cases(text) {
            count += 1;
            let ours = screen(&case);
            if ours != case.prints {
                let mut pairs = case.prints.lines().zip(ours.lines()).enumerate();
                let first = pairs.find(|(_, (rom, ours))| rom != ours);
                wrong.push(format!(
                    "{subject}, {}: line, ROM, ours: {first:?}",
                    case.name
                ));
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {count} programs:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}
