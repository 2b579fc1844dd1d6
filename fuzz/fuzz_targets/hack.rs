//! Any bytes as a program of the Hack computer: as Jack, as VM code and as
//! assembly, and as what these become: VM code, machine code, an image of the
//! ROM. What is accepted runs for a while.
//!
//! What is held: no panic, no hang (`-timeout`), no unbounded memory
//! (`-rss_limit_mb`); assembly that the translator writes is assembled to the same
//! words, and images read back as they were; the CPU's engines agree.
#![no_main]

use libfuzzer_sys::fuzz_target;
use slowlight_vm::hack::asm::{assemble, disassemble, read_image, write_image};
use slowlight_vm::hack::cpu::Cpu;
use slowlight_vm::hack::jack::compile;
use slowlight_vm::hack::translate::{Compare, Keep, Options, Size, translate};
use slowlight_vm::hack::vm::{Machine, Program};

const CYCLES: u64 = 20_000;

const PLAIN: Options = Options {
    compare: Compare::Words,
    keep: Keep::Cells,
    size: Size::Fit,
};
const WAYS: [Options; 4] = [
    PLAIN,
    Options { keep: Keep::Frames, ..PLAIN },
    Options { size: Size::Small, ..PLAIN },
    Options { compare: Compare::Differences, ..PLAIN },
];

/// Runs words on both engines.
fn cpu(words: &[u16]) {
    let mut fast = Cpu::new(words).expect("it fits");
    let mut plain = fast.clone();
    let run = fast.run(CYCLES, &mut |_| true);
    assert_eq!(run, plain.run_plain(CYCLES, &mut |_| true));
    assert!((0..0x8000).all(|at| fast.peek(at) == plain.peek(at)));
    let image = write_image(words);
    assert_eq!(read_image(&image).expect("our own image"), words);
}

/// Links VM code, runs it, and runs what it becomes.
fn vm(files: &[(String, String)]) {
    let Ok(program) = Program::link(files) else {
        return;
    };
    Machine::new(&program).run(CYCLES, &mut |_| true);
    for options in WAYS {
        if let Ok(translation) = translate(&program, options) {
            let again = assemble(&translation.assembly).expect("our own assembly");
            assert_eq!(again.words, translation.words);
            cpu(&translation.words);
        }
    }
}

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes).into_owned();
    if let Ok(assembly) = assemble(&text) {
        let again = assemble(&disassemble(&assembly.words)).expect("our own assembly");
        assert_eq!(again.words, assembly.words);
        cpu(&assembly.words);
    }
    let words: Vec<u16> = bytes
        .chunks_exact(2)
        .take(0x8000)
        .map(|pair| u16::from_be_bytes([pair[0], pair[1]]))
        .collect();
    cpu(&words);
    vm(&[("Main.vm".to_owned(), text.clone())]);
    if let Ok(classes) = compile(&[("Main.jack".to_owned(), text)]) {
        let files: Vec<_> = classes.into_iter().map(|c| (c.name, c.text)).collect();
        vm(&files);
    }
});
