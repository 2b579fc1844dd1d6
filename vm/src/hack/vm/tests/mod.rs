//! Every test is a program: it runs on both engines, which must agree.
#![allow(clippy::unwrap_used)]

mod commands;
pub(in crate::hack) mod engines;
mod heap;
mod keys;
mod limits;
mod memory;
mod os;
mod screen;
mod wrong;

use super::{Machine, Program, Run};
use crate::{Fault, Stop};

/// Enough for every test that ends.
const LIMIT: u64 = 1_000_000;

fn files(texts: &[(&str, &str)]) -> Vec<(String, String)> {
    let owned = |(name, text): &(&str, &str)| ((*name).to_owned(), (*text).to_owned());
    texts.iter().map(owned).collect()
}

fn link(texts: &[(&str, &str)]) -> Program {
    Program::link(&files(texts)).unwrap()
}

fn faults(texts: &[(&str, &str)]) -> Vec<Fault> {
    Program::link(&files(texts)).unwrap_err()
}

/// Runs on both engines; answers the machine and what it did.
fn both<'p>(program: &'p Program, plain: &'p mut Program, limit: u64) -> (Machine<'p>, Run) {
    plain.clone_from(program);
    plain.fused = None;
    let mut fast = Machine::new(program);
    let run = fast.run(limit, &mut |_| true);
    let mut slow = Machine::new(plain);
    assert_eq!(run, slow.run(limit, &mut |_| true));
    // What lies above SP is nobody's; everything else agrees.
    let sp = usize::from(slow.memory[0]);
    for address in (0..sp.min(2048)).chain(2048..0x8000) {
        assert_eq!(
            fast.memory[address], slow.memory[address],
            "the word at {address}"
        );
    }
    (fast, run)
}

/// Runs a `Main.main` without locals that prints; answers the text.
fn prints(body: &str) -> String {
    let (run, _) = main(0, body);
    assert_eq!(run.stop, Stop::Ended);
    run.text
}

/// Runs a `Main.main` of `body` and a return; answers the run and the first
/// words of statics.
fn main(locals: u16, body: &str) -> (Run, Vec<i16>) {
    let text = format!("function Main.main {locals}\n{body}\npush constant 0\nreturn\n");
    let program = link(&[("Main.vm", &text)]);
    assert!(program.fused.is_some(), "heights not proved");
    let mut plain = program.clone();
    let (machine, run) = both(&program, &mut plain, LIMIT);
    let statics = (16..40).map(|address| machine.peek(address)).collect();
    (run, statics)
}

/// The message of the fault that a `Main.main` ends with.
fn message(locals: u16, body: &str) -> String {
    match main(locals, body).0.stop {
        Stop::Fault(fault) => fault.message,
        stop => panic!("{stop:?}"),
    }
}
