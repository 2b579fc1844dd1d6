//! The operating system in Jack against the VM's native one: the same program, with
//! the one, with the other, and with ours translated on the processor, leaves the
//! same words, the same screen, and fails with the same error.

mod drawing;
mod functions;
mod text;

use crate::os::{FAILED, NUMBER, Wanted, classes};
use slowlight_vm::hack::cpu::Cpu;
use slowlight_vm::hack::jack::compile;
use slowlight_vm::hack::translate::{Compare, Keep, Options, translate};
use slowlight_vm::hack::vm::{Machine, Names, Program};
use slowlight_vm::{Screen, Stop};

/// Where programs leave what they found out: above what they take of the heap.
const OUT: u16 = 14_000;
const LIMIT: u64 = 400_000_000;

/// What a program did.
#[derive(Clone, Debug, PartialEq)]
pub struct Left {
    /// The words from [`OUT`] to the screen.
    pub words: Vec<i16>,
    pub screen: Screen,
    /// The number of the error that it ended with.
    pub error: Option<i16>,
}

type Files = Vec<(String, String)>;

fn vm(files: &Files) -> Files {
    let compiled = compile(files).unwrap();
    compiled.into_iter().map(|f| (f.name, f.text)).collect()
}

/// `main`'s body and other subroutines, as a program.
pub fn program(body: &str, more: &str) -> Files {
    let text = format!(
        "class Main {{
            static Array out; static int next, seed;
            function void main() {{ let out = {OUT}; do Main.start(); return; }}
            function void start() {{ {body} return; }}
            function void note(int word) {{ let out[next] = word; let next = next + 1; return; }}
            function int random() {{ let seed = (seed * 25173) + 13849; return seed; }}
            {more}
        }}"
    );
    vec![("Main.jack".to_owned(), text)]
}

/// A program as VM code, with what it needs of our system.
pub fn completed(files: &Files) -> Files {
    let own = vm(files);
    let names = Names::of(&own).unwrap();
    let [has, calls, reached] = [&names.has, &names.calls, &names.reached]
        .map(|n| n.iter().map(String::as_str).collect::<Vec<_>>());
    let system = classes(Wanted {
        calls: &calls,
        reached: &reached,
        has: &has,
    });
    let mut all = files.clone();
    for (name, text) in system {
        all.push((format!("{name}.jack"), text));
    }
    vm(&all)
}

fn words(peek: impl Fn(u16) -> i16) -> Vec<i16> {
    (OUT..16384).map(peek).collect()
}

pub fn with_native(files: &Files) -> (Left, String) {
    let program = Program::link(&vm(files)).unwrap();
    let mut machine = Machine::new(&program);
    let run = machine.run(LIMIT, &mut |_| true);
    let error = match run.stop {
        Stop::Ended => None,
        Stop::Fault(fault) => {
            let number = fault.message.strip_prefix("Sys.error(");
            let number = number.unwrap_or_else(|| panic!("{}", fault.message));
            Some(number.split(')').next().unwrap().parse().unwrap())
        }
        stop => panic!("{stop:?}"),
    };
    let left = Left {
        words: words(|at| machine.peek(at)),
        screen: run.screen,
        error,
    };
    (left, run.text)
}

fn noted(program: &Program, peek: impl Fn(u16) -> i16) -> Option<i16> {
    let at = |index| program.static_address("Sys.vm", index);
    let (failed, number) = (at(FAILED)?, at(NUMBER)?);
    (peek(failed) != 0).then(|| peek(number))
}

pub fn with_ours(files: &Files) -> Left {
    let program = Program::link(&completed(files)).unwrap();
    let mut machine = Machine::new(&program);
    let run = machine.run(LIMIT, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(
        run.os_calls_by_name.iter().find(|(n, _)| n != "Sys.halt"),
        None,
        "the native system is not asked"
    );
    Left {
        words: words(|at| machine.peek(at)),
        screen: run.screen,
        error: noted(&program, |at| machine.peek(at)),
    }
}

/// The ways to translate: none may matter.
fn ways() -> [Options; 3] {
    let plain = Options::default();
    [
        plain,
        Options {
            keep: Keep::Frames,
            ..plain
        },
        Options {
            compare: Compare::Differences,
            ..plain
        },
    ]
}

pub fn on_cpu(files: &Files, options: Options) -> Left {
    let program = Program::link(&completed(files)).unwrap();
    let translation = translate(&program, options).unwrap();
    let mut cpu = Cpu::new(&translation.words).unwrap();
    let run = cpu.run(8 * LIMIT, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended);
    Left {
        words: words(|at| cpu.peek(at)),
        screen: run.screen,
        error: noted(&program, |at| cpu.peek(at)),
    }
}

/// Runs a program on all machines, which must agree. Screens are not compared
/// where it fails, as ours shows the error there.
pub fn agreed(files: &Files) -> Left {
    let (native, _) = with_native(files);
    let mut all = vec![with_ours(files)];
    all.extend(ways().map(|way| on_cpu(files, way)));
    for ours in all {
        assert_eq!(ours.error, native.error, "{files:?}");
        assert_eq!(ours.words, native.words, "{files:?}");
        assert!(
            native.error.is_some() || ours.screen == native.screen,
            "{files:?}"
        );
    }
    native
}

/// The error that a body ends with on all machines.
pub fn error(body: &str) -> Option<i16> {
    agreed(&program(body, "")).error
}
