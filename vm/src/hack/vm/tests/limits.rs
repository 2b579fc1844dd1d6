//! Whatever a program does, its run ends.

use super::{LIMIT, both, link, main, message};
use crate::Stop;
use crate::hack::vm::{Machine, Program};

const COUNTING: &str = "function Main.main 1
    label NEXT
    push local 0
    push constant 1
    add
    pop local 0
    call Main.nothing 0
    pop temp 0
    goto NEXT
    function Main.nothing 0
    push constant 0
    return";

#[test]
fn the_limit_is_met_exactly() {
    let program = link(&[("Main.vm", COUNTING)]);
    let mut plain = program.clone();
    for limit in (0..60).chain(9_000..9_030) {
        let (_, run) = both(&program, &mut plain, limit);
        assert_eq!(run.stop, Stop::CycleLimit);
        assert_eq!(run.instructions, limit);
    }
}

#[test]
fn a_run_goes_on_after_its_limit() {
    let program = link(&[("Main.vm", COUNTING)]);
    let mut stopped = Machine::new(&program);
    for limit in 1..500 {
        assert_eq!(stopped.run(limit, &mut |_| true).instructions, limit);
    }
    let mut whole = Machine::new(&program);
    assert_eq!(
        stopped.run(5_000, &mut |_| true),
        whole.run(5_000, &mut |_| true)
    );
    assert_eq!(stopped.peek(261), whole.peek(261));
    assert_eq!(stopped.peek(261), 500);
}

#[test]
fn the_watcher_is_asked_and_obeyed() {
    let program = link(&[("Main.vm", COUNTING)]);
    let mut seen = Vec::new();
    let run = Machine::new(&program).run(u64::MAX, &mut |progress| {
        seen.push((progress.cycles, progress.row));
        seen.len() < 3
    });
    assert_eq!(run.stop, Stop::Interrupted);
    let tens: Vec<u64> = seen.iter().map(|(cycles, _)| cycles / 10_000_000).collect();
    assert_eq!(tens, [1, 2, 3]);
    assert!(seen.iter().all(|(_, row)| row.is_none()));
}

#[test]
fn the_watcher_sees_the_row_and_long_calls() {
    // Few commands, but each clears or fills the whole screen.
    let program = link(&[(
        "Main.vm",
        "function Main.main 0
        label NEXT
        push constant 0
        push constant 0
        push constant 511
        push constant 200
        call Screen.drawRectangle 4
        pop temp 0
        goto NEXT",
    )]);
    let (mut cycles, mut row, mut lit) = (0, None, 0);
    let run = Machine::new(&program).run(u64::MAX, &mut |progress| {
        (cycles, row) = (progress.cycles, progress.row);
        let screen = (progress.screen)().expect("a screen");
        lit = screen.pixels.iter().filter(|ink| **ink == 0).count();
        false
    });
    assert_eq!(run.stop, Stop::Interrupted);
    assert!(cycles < 10_000_000);
    assert_eq!(row, Some(200));
    assert_eq!(lit, 512 * 201);
}

#[test]
fn stores_to_the_screen_tell_the_row() {
    for store in [
        "push constant 7\npop that 32",
        "push constant 17025\npush constant 1\ncall Memory.poke 2\npop temp 0",
        "push constant 17025\npush constant 1\npop temp 0\npop pointer 1\npush temp 0\npop that 0",
        "push constant 5\npush constant 20\ncall Screen.drawPixel 2\npop temp 0",
    ] {
        let text = format!(
            "function Main.main 0
            push constant 17000
            pop pointer 1
            {store}
            label NEXT
            push constant 1
            if-goto NEXT"
        );
        let program = link(&[("Main.vm", &text)]);
        let mut row = None;
        Machine::new(&program).run(u64::MAX, &mut |progress| {
            row = progress.row;
            false
        });
        assert_eq!(row, Some(20), "{store}");
    }
}

#[test]
fn recursion_overflows_the_stack_and_is_named() {
    let text = message(
        0,
        "call Main.deeper 0
        return
        function Main.deeper 3
        call Main.deeper 0",
    );
    assert!(text.starts_with("stack overflow in Main.deeper"), "{text}");
}

#[test]
fn the_stack_can_be_used_to_its_last_word() {
    // Recursion with frames of 5 + 1 argument, down to an exact depth.
    let down = |depth: u32| {
        main(
            0,
            &format!(
                "push constant {depth}
                call Main.down 1
                pop static 0
                push constant 0
                return
                function Main.down 0
                push argument 0
                if-goto DEEPER
                push constant 1
                push constant 2
                push constant 3
                add
                add
                return
                label DEEPER
                push argument 0
                push constant 1
                sub
                call Main.down 1"
            ),
        )
    };
    // 261 + 6 at the first call, 6 a call, 3 at the bottom: 2048 at most.
    let deepest = (2048 - 261 - 6 - 3) / 6;
    let (run, statics) = down(deepest);
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(statics[0], 0);
    assert!(matches!(down(deepest + 1).0.stop, Stop::Fault(f) if f.message.contains("Main.down")));
}

#[test]
fn a_program_of_uneven_heights_runs_plainly() {
    let text = "function Main.main 0
        label NEXT
        push constant 1
        goto NEXT";
    let program = link(&[("Main.vm", text)]);
    assert!(program.fused.is_none());
    let run = Machine::new(&program).run(LIMIT, &mut |_| true);
    // 1 function, and two commands for each of the 1,787 words from 261.
    assert_eq!(run.instructions, 1 + 1787 * 2 + 1);
    let Stop::Fault(fault) = run.stop else {
        panic!("{:?}", run.stop)
    };
    assert!(fault.message.starts_with("stack overflow in Main.main"));
    assert_eq!(fault.line, Some(3));
}

#[test]
fn an_empty_endless_loop_is_an_end() {
    let (run, _) = main(0, "label L\ngoto L");
    assert_eq!(run.stop, Stop::Ended);
}

#[test]
fn printing_without_end_fills_no_memory() {
    let program: Program = link(&[(
        "Main.vm",
        "function Main.main 0
        label NEXT
        push constant 65
        call Output.printChar 1
        pop temp 0
        goto NEXT",
    )]);
    let run = Machine::new(&program).run(8_000_000, &mut |_| true);
    assert_eq!(run.stop, Stop::CycleLimit);
    assert_eq!(run.text.len(), 1 << 20);
}
