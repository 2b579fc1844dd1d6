//! Keys on the VM: both engines see the same of a script, and so does the processor.

use super::link;
use crate::hack::asm::assemble;
use crate::hack::cpu::Cpu;
use crate::hack::vm::Machine;
use crate::keys::{Keyboard, Unit};
use crate::{Progress, Stop};

fn keyboard(script: &str, unit: Unit) -> Keyboard {
    Keyboard::new(script.parse().unwrap(), unit, |_| None)
}

/// Adds up all keys that it sees, by the three ways to look, until it sees `q`; the sum of
/// each is weighed by when it came.
const SUMS: &str = "function Main.main 2
    label NEXT
    call Keyboard.keyPressed 0
    pop local 0
    push local 0
    push constant 113
    eq
    if-goto DONE
    push static 0
    push static 0
    add
    push local 0
    add
    pop static 0
    push constant 24576
    call Memory.peek 1
    push static 0
    add
    pop static 0
    push constant 24570
    pop pointer 1
    push that 6
    push static 0
    sub
    pop static 0
    push constant 24576
    push constant 0
    add
    pop pointer 1
    push that 0
    push static 0
    add
    pop static 0
    goto NEXT
    label DONE
    push constant 0
    return";

#[test]
fn engines_see_the_same_keys() {
    for (script, unit) in [
        ("a*3 wait 2 left f12 wait 7 up*30 q*9", Unit::Calls),
        ("wait 1 b*2 escape wait 1 q", Unit::Frames),
    ] {
        let program = link(&[("Main.vm", SUMS)]);
        let mut plain = program.clone();
        plain.fused = None;
        assert!(program.fused.is_some());
        let run = |program| {
            let mut machine = Machine::new(program);
            machine.plug(keyboard(script, unit));
            let run = machine.run(3_000_000, &mut |_: Progress| true);
            assert_eq!(run.stop, Stop::Ended, "{script}");
            (run, machine.peek(16), machine.unplug().unwrap().late())
        };
        let fast = run(&program);
        assert_eq!(fast, run(&plain));
        assert!(fast.0.instructions > 50, "{}", fast.0.instructions);
    }
}

/// `Sys.wait` passes frames.
#[test]
fn waiting_passes_frames() {
    let text = "function Main.main 1
        label NEXT
        push static 0
        push constant 1
        add
        pop static 0
        push constant 100
        call Sys.wait 1
        pop temp 0
        call Keyboard.keyPressed 0
        push constant 32
        eq
        not
        if-goto NEXT
        push constant 0
        return";
    let program = link(&[("Main.vm", text)]);
    let mut machine = Machine::new(&program);
    machine.plug(keyboard("wait 41 space*5", Unit::Frames));
    let run = machine.run(10_000, &mut |_| true);
    // Five frames a turn.
    assert_eq!((run.stop, machine.peek(16)), (Stop::Ended, 9));
}

/// A loop that looks for a key is found out; one that counts meanwhile is not.
#[test]
fn who_waits_for_ever_is_found_out() {
    let body = |more: &str| {
        format!(
            "function Main.main 0\nlabel NEXT\n{more}\ncall Keyboard.keyPressed 0\npush constant 65\n\
             eq\nnot\nif-goto NEXT\npush constant 0\nreturn"
        )
    };
    let run = |more: &str, script: &str| {
        let program = link(&[("Main.vm", &body(more))]);
        let mut machine = Machine::new(&program);
        machine.plug(keyboard(script, Unit::Calls));
        machine.run(100_000, &mut |_| true)
    };
    let never = run("", "b*50");
    let Stop::Fault(fault) = never.stop else {
        panic!("{:?}", never.stop);
    };
    assert!(
        fault
            .message
            .starts_with("the program waits for a key that never comes")
    );
    assert!(never.instructions < 500, "{}", never.instructions);
    assert_eq!(run("", "b*50 A").stop, Stop::Ended);
    let counts = "push static 0\npush constant 1\nadd\npop static 0";
    assert_eq!(run(counts, "b").stop, Stop::CycleLimit);
    // Places in a row where it looks are not one place that comes again.
    let looks = "call Keyboard.keyPressed 0\npop temp 0\n".repeat(20);
    let text = format!("function Main.main 0\n{looks}push constant 0\nreturn");
    let program = link(&[("Main.vm", &text)]);
    let mut machine = Machine::new(&program);
    machine.plug(keyboard("", Unit::Calls));
    assert_eq!(machine.run(1000, &mut |_| true).stop, Stop::Ended);
}

#[test]
fn the_processor_sees_the_same_keys() {
    let text = "(NEXT)\n@24576\nD=M\n@sum\nM=D+M\n@KBD\nD=M\n@113\nD=D-A\n@NEXT\nD;JNE\n(END)\n@END\n0;JMP";
    let words = assemble(text).unwrap().words;
    let run = |script: &str, limit: u64| {
        let mut cpu = Cpu::new(&words).unwrap();
        cpu.plug(keyboard(script, Unit::Calls));
        (cpu.run(limit, &mut |_| true).stop, cpu.peek(16))
    };
    // Every other look adds up; q ends it.
    assert_eq!(
        run("a*4 wait 3 b*2 wait 2 q*9", 1000),
        (Stop::Ended, 97 * 2 + 98)
    );
    let (stop, _) = run("", 1 << 40);
    let Stop::Fault(fault) = stop else {
        panic!("{stop:?}");
    };
    assert!(
        fault
            .message
            .starts_with("the program waits for a key that never comes")
    );
    assert_eq!(run("a*4 quit", 1000), (Stop::Ended, 97 * 2));
}
