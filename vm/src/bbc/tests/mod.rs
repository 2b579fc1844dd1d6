#![allow(clippy::unwrap_used)]

mod cases;
mod graphics;
mod programs;
mod rom;
mod tokens;
mod wrong;

use super::*;

/// Runs a program's text on a Micro and gives what is left, within ten seconds of its time.
fn run_on(dialect: Dialect, text: &str) -> Run {
    let mut machine = Machine::new(Config {
        dialect,
        page: 0x1900,
    });
    machine.load_text(text).unwrap();
    machine.run(20_000_000, &mut |_| true)
}

fn run(text: &str) -> Run {
    run_on(Dialect::Micro, text)
}

/// What a program prints; it must end well.
fn prints(text: &str) -> String {
    let run = run(text);
    assert_eq!(run.stop, Stop::Ended, "{text}\n{}", run.text);
    run.text
}

/// The message and line of a program's fault.
fn fails(text: &str) -> (String, u32) {
    match run(text).stop {
        Stop::Fault(f) => (f.message, f.line.unwrap_or(0)),
        other => panic!("{text}: {other:?}"),
    }
}

/// Ink at a pixel counted from the top left.
fn ink(run: &Run, x: u32, y: u32) -> u8 {
    run.screen.pixels[(y * run.screen.width + x) as usize]
}
