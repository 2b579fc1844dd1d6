//! Where the platform keeps what: segments, statics, pointers, all addresses.

use super::{LIMIT, both, link, main};
use crate::Stop;

#[test]
fn segments_lie_where_the_platform_has_them() {
    let text = "function Main.main 2
        push constant 7
        call Main.f 1
        pop static 1
        push constant 0
        return
        function Main.f 2
        push constant 3000
        pop pointer 0
        push constant 4000
        pop pointer 1
        push constant 11
        pop local 1
        push constant 12
        pop this 5
        push constant 13
        pop that 6
        push constant 14
        pop temp 7
        push constant 15
        pop static 2
        push local 1
        push this 5
        add
        push that 6
        add
        push temp 7
        add
        push static 2
        add
        push argument 0
        add
        push pointer 0
        add
        push pointer 1
        add
        push local 0
        add
        call Sys.halt 0
        return";
    let program = link(&[("Main.vm", text)]);
    let mut plain = program.clone();
    let (machine, run) = both(&program, &mut plain, LIMIT);
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(program.statics(), 3);
    assert_eq!(program.static_address("Main.vm", 2), Some(18));
    assert_eq!(program.static_address("Main.vm", 3), None);
    assert_eq!(machine.peek(3), 3000);
    assert_eq!(machine.peek(4), 4000);
    assert_eq!(machine.peek(3005), 12);
    assert_eq!(machine.peek(4006), 13);
    assert_eq!(machine.peek(12), 14);
    assert_eq!(machine.peek(18), 15);
    // The frame of Main.main is at 256, its locals at 261, and the argument at 263.
    assert_eq!(machine.peek(2), 263);
    assert_eq!(machine.peek(1), 263 + 1 + 5);
    let frame: Vec<i16> = (264..269).map(|address| machine.peek(address)).collect();
    assert_eq!(frame[1..], [261, 256, 0, 0]);
    assert_eq!(machine.peek(270), 11);
    // Two locals and the sum.
    assert_eq!(machine.peek(0), 272);
    assert_eq!(machine.peek(271), 11 + 12 + 13 + 14 + 15 + 7 + 7000);
    // Three in Main.main; in Main.f seven stores, the sum of nine, and the call.
    assert_eq!(run.instructions, 3 + 1 + 14 + 17 + 1);
}

#[test]
fn statics_are_each_files_own() {
    let program = link(&[
        (
            "A.vm",
            "function A.set 0\npush constant 5\npop static 1\npush constant 0\nreturn",
        ),
        (
            "Main.vm",
            "function Main.main 0
            call A.set 0
            pop static 0
            push constant 6
            pop static 1
            push static 1
            return",
        ),
    ]);
    let mut plain = program.clone();
    let (machine, _) = both(&program, &mut plain, LIMIT);
    assert_eq!(program.statics(), 4);
    assert_eq!(program.commands(), 5 + 7);
    assert_eq!((machine.peek(17), machine.peek(19)), (5, 6));
}

#[test]
fn the_pointers_and_the_stack_can_be_reached_by_memory_too() {
    // Reads SP, LCL and a temp through THAT and Memory.peek; writes a static, then THAT.
    let (run, statics) = main(
        2,
        "push constant 0
        pop pointer 1
        push that 0
        pop static 0
        push that 1
        pop static 1
        push constant 9
        pop temp 1
        push that 6
        pop static 2
        push constant 1234
        pop that 19
        push constant 0
        call Memory.peek 1
        pop static 4
        push constant 5000
        pop that 4
        push pointer 1
        pop static 5
        push constant 4
        push constant 6000
        call Memory.poke 2
        pop temp 0
        push pointer 1
        pop static 6
        push local 0
        push local 1
        add
        pop static 7",
    );
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(statics[..8], [263, 261, 9, 1234, 264, 5000, 6000, 0]);
}

#[test]
fn addresses_wrap_at_16_bits() {
    let (_, statics) = main(
        0,
        "push constant 1
        neg
        pop pointer 1
        push constant 21
        pop that 3001
        push constant 3000
        call Memory.peek 1
        pop static 0
        push that 3001
        pop static 1",
    );
    assert_eq!(statics[..2], [21, 21]);
}
