//! Every test is a program that runs on the VM and, translated in each way, on
//! the CPU, and leaves the same there.
#![allow(clippy::unwrap_used)]

mod figures;
mod jack;
mod programs;
mod random;

use super::{Compare, Keep, Options, Size, Translation, translate};
use crate::Stop;
use crate::hack::asm::assemble;
use crate::hack::cpu::Cpu;
use crate::hack::vm::{Machine, Program};

fn link(files: &[(&str, &str)]) -> Program {
    let owned = |(name, text): &(&str, &str)| ((*name).to_owned(), (*text).to_owned());
    let files: Vec<_> = files.iter().map(owned).collect();
    Program::link(&files).unwrap()
}

/// The ways to translate.
fn ways() -> [Options; 4] {
    [
        Options::default(),
        Options {
            keep: Keep::Frames,
            ..Options::default()
        },
        Options {
            size: Size::Small,
            ..Options::default()
        },
        Options {
            compare: Compare::Differences,
            ..Options::default()
        },
    ]
}

/// Runs on the VM and on the CPU; statics, heap and screen must agree. Answers
/// the VM's instructions and, for each way of translation, that and its cycles.
/// Programs that compare words far apart are not `tame`.
fn same(program: &Program, tame: bool) -> (u64, Vec<(Translation, u64)>) {
    let mut vm = Machine::new(program);
    let run = vm.run(20_000_000, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended);
    let mut results = Vec::new();
    for options in ways() {
        if options.compare == Compare::Differences && !tame {
            continue;
        }
        let translation = translate(program, options).unwrap();
        let assembled = assemble(&translation.assembly).unwrap();
        assert_eq!(assembled.words, translation.words);
        let mut cpu = Cpu::new(&translation.words).unwrap();
        let ran = cpu.run(2_000_000_000, &mut |_| true);
        assert_eq!(ran.stop, Stop::Ended, "{}", translation.assembly);
        let statics = 16..16 + program.statics();
        // Without an allocator of its own the VM's has made its heap.
        let heap = if program.native_heap { 2050 } else { 2048 };
        for address in statics.chain(heap..24_577) {
            assert_eq!(
                cpu.peek(address),
                vm.peek(address),
                "the word at {address}, {options:?}\n{}",
                translation.assembly
            );
        }
        results.push((translation, ran.cycles));
    }
    (run.instructions, results)
}
