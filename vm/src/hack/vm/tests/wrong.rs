//! Wrong programs, by what is said about them.

use super::{both, faults, files, link, main, message};
use crate::hack::vm::{Machine, Missing, Program};
use crate::{Fault, Stop};

/// What is said about one line in an otherwise right program.
fn said(line: &str) -> String {
    let text = format!("function Main.main 0\npush constant 0\n{line}\nreturn\n");
    let faults = faults(&[("Main.vm", &text)]);
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert_eq!(faults[0].file.as_deref(), Some("Main.vm"));
    assert_eq!(faults[0].line, Some(3));
    faults[0].message.clone()
}

#[test]
fn every_wrong_line_is_named() {
    for (line, message) in [
        ("mul", "unknown command `mul`"),
        ("push", "push needs a segment and an index"),
        ("push heap 0", "unknown segment `heap`"),
        ("push local", "push needs an index"),
        (
            "push local -1",
            "push needs an index, from 0 to 32767, not `-1`",
        ),
        (
            "push local +1",
            "push needs an index, from 0 to 32767, not `+1`",
        ),
        (
            "push constant 32768",
            "push needs an index, from 0 to 32767, not `32768`",
        ),
        ("push temp 8", "temp 8: the last index of temp is 7"),
        ("pop pointer 2", "pointer 2: the last index of pointer is 1"),
        (
            "pop static 240",
            "static 240: the last index of static is 239",
        ),
        (
            "pop constant 1",
            "pop constant: a constant cannot be stored to",
        ),
        ("add 1", "`1` after a complete add"),
        ("label", "label needs a name"),
        ("label 1st", "`1st` is no name for label"),
        ("label a-b", "`a-b` is no name for label"),
        ("goto NOWHERE", "no label NOWHERE in Main.main"),
        ("if-goto NOWHERE", "no label NOWHERE in Main.main"),
        (
            "call Main.g 0",
            "no function Main.g: neither the program nor the operating system has it",
        ),
        ("call Math.abs 2", "Math.abs takes 1 arguments, not 2"),
        ("call Math.abs", "call needs its count of arguments"),
        (
            "function Main.f x",
            "function needs its count of locals, from 0 to 32767, not `x`",
        ),
        ("function Main.main 0", "a second function Main.main"),
        (
            "push /* x */ local 0",
            "a comment in the middle of a command",
        ),
    ] {
        assert_eq!(said(line), message);
    }
}

/// Reads and writes through THAT, of a field, of an array, by the operating
/// system: all on both engines.
#[test]
fn there_is_no_memory_above_the_keyboard() {
    let address = |n: i32| match n {
        0..=32767 => format!("push constant {n}"),
        32768 => "push constant 32767\npush constant 1\nadd".to_owned(),
        _ => format!("push constant {}\nneg", 65536 - n),
    };
    let uses = |at: &str| {
        [
            format!("{at}\npop pointer 1\npush that 0\npop static 0"),
            format!("{at}\npop pointer 0\npush this 0\npop static 0"),
            format!("{at}\npop pointer 1\npush constant 1\npop that 0"),
            format!("{at}\npop pointer 1\npush static 1\npop that 0"),
            format!("{at}\npush constant 0\nadd\npop pointer 1\npush that 0\npop static 0"),
            format!(
                "{at}\npush constant 0\nadd\npush constant 1\npop temp 0\npop pointer 1\npush temp 0\npop that 0"
            ),
            format!("{at}\ncall Memory.peek 1\npop temp 0"),
            format!("{at}\npush constant 1\ncall Memory.poke 2\npop temp 0"),
            format!("{at}\ncall String.length 1\npop temp 0"),
        ]
    };
    for n in [24577, 32767, 32768, 65535] {
        for body in uses(&address(n)) {
            assert_eq!(
                message(0, &body),
                format!("Main.main uses address {n}, and the memory ends at 24576"),
                "{body}"
            );
        }
    }
    for n in [2048, 16384, 24575, 24576] {
        for body in uses(&address(n)) {
            assert_eq!(main(0, &body).0.stop, Stop::Ended, "{body}");
        }
    }
}

#[test]
fn a_long_word_is_cut() {
    let message = said(&"x".repeat(5000));
    assert!(message.len() < 100, "{message}");
}

#[test]
fn all_faults_are_reported_but_not_thousands() {
    let one = faults(&[("A.vm", "push constant 1\nadd"), ("B.vm", "x\ny")]);
    let places: Vec<_> = one.iter().map(|f| (f.file.as_deref(), f.line)).collect();
    assert_eq!(
        places,
        [
            (Some("B.vm"), Some(1)),
            (Some("B.vm"), Some(2)),
            (Some("A.vm"), Some(1))
        ]
    );
    assert_eq!(faults(&[("A.vm", &"x\n".repeat(5000))]).len(), 100);
}

#[test]
fn a_second_label_and_too_many_statics_are_refused() {
    let twice = "function Main.main 0\nlabel A\nlabel A\nreturn";
    assert_eq!(
        faults(&[("Main.vm", twice)])[0].message,
        "a second label A in Main.main"
    );
    let many = "function A.f 0\npush static 200\nreturn";
    let more = "function Main.main 0\npush static 38\npush static 39\nreturn";
    let fault = &faults(&[("A.vm", many), ("Main.vm", more)])[0];
    assert_eq!(
        (fault.file.as_deref(), fault.line),
        (Some("Main.vm"), Some(3))
    );
    assert!(fault.message.starts_with("static 39 does not fit"));
}

#[test]
fn a_program_needs_a_start() {
    let none = faults(&[("A.vm", "function A.f 0\nreturn")]);
    assert_eq!(
        none[0].message,
        "the program has neither Sys.init nor Main.main to start in"
    );
    assert_eq!(faults(&[]), none);
}

#[test]
fn falling_off_the_end_is_a_fault_at_the_last_line() {
    let program = link(&[(
        "Main.vm",
        "function Main.main 0\npush constant 1\npop temp 0\n",
    )]);
    let mut plain = program.clone();
    let (_, run) = both(&program, &mut plain, 100);
    assert_eq!(run.instructions, 3);
    let fault = Fault {
        message: "Main.main has come to its end without a return".to_owned(),
        file: Some("Main.vm".to_owned()),
        line: Some(3),
        column: None,
    };
    assert_eq!(run.stop, Stop::Fault(fault));
}

#[test]
fn the_stack_has_a_bottom() {
    for body in [
        "pop local 0\npop local 0",
        "call Main.f 300",
        "add",
        "call Math.max 2",
    ] {
        let text = format!(
            "function Main.main 0
            pop temp 0\npop temp 0\npop temp 0\npop temp 0\npop temp 0
            {body}
            push constant 0
            return
            function Main.f 0
            push constant 0
            return"
        );
        let program = link(&[("Main.vm", &text)]);
        let run = Machine::new(&program).run(1_000, &mut |_| true);
        let Stop::Fault(fault) = run.stop else {
            panic!("{body}: {:?}", run.stop)
        };
        assert!(
            fault.message.starts_with("stack underflow in Main.main"),
            "{}",
            fault.message
        );
        assert!(fault.line >= Some(7));
    }
}

#[test]
fn a_frame_overwritten_is_a_fault_and_no_panic() {
    let text = message(
        0,
        "push constant 256
        push constant 30000
        call Memory.poke 2
        pop temp 0",
    );
    assert!(text.contains("returns to nowhere"), "{text}");
    // A return site of another call: wrong, but it goes somewhere and ends.
    let (run, _) = main(
        0,
        "push constant 256
        push constant 2
        call Memory.poke 2
        pop temp 0
        call Main.f 0
        push constant 0
        return
        function Main.f 0
        push constant 1",
    );
    assert_ne!(run.stop, Stop::CycleLimit);
}

#[test]
fn sys_error_names_the_caller() {
    assert_eq!(
        message(0, "push constant 9\ncall Sys.error 1"),
        "Sys.error(9) in Main.main"
    );
    assert_eq!(
        message(0, "push constant 9\npush constant 0\ncall Math.divide 2"),
        "Sys.error(3) in Main.main: division by zero"
    );
}

/// A call that goes nowhere is an error where it is reached, at the call.
#[test]
fn missing_functions_matter_where_they_are_called() {
    let text = |zero: u16| {
        format!(
            "function Main.main 0\npush constant {zero}\nif-goto CALL\npush constant 7\n\
             call Output.printInt 1\nreturn\nlabel CALL\npush constant 5\npush constant 6\n\
             call Ghost.haunt 2\nreturn\n"
        )
    };
    let run = |zero: u16| {
        let mut all = files(&[("Main.vm", &text(zero)), ("Ghost.vm", "")]);
        let missing = Missing::of(&all).unwrap();
        let said: Vec<String> = missing.calls.iter().map(Fault::to_string).collect();
        assert_eq!(
            said,
            [
                "Main.vm:10: there is no function Ghost.haunt: the program ends with an error if it comes to this call"
            ]
        );
        all.extend(missing.file());
        let program = Program::link(&all).unwrap();
        let mut plain = program.clone();
        both(&program, &mut plain, 100).1
    };
    let good = run(0);
    assert_eq!((good.stop, good.text.as_str()), (Stop::Ended, "7"));
    let Stop::Fault(fault) = run(1).stop else {
        panic!("no fault");
    };
    assert_eq!(
        fault.to_string(),
        "Main.vm:10: there is no function Ghost.haunt"
    );
}

#[test]
fn commands_without_functions_run_from_the_first() {
    let run = |text: &str| {
        let program = link(&[("Add.vm", text)]);
        assert!(program.is_bare());
        let mut machine = Machine::new(&program);
        let run = machine.run(1000, &mut |_| true);
        (run.stop, run.instructions, machine.stack())
    };
    assert_eq!(
        run("push constant 7\npush constant 8\nadd"),
        (Stop::Ended, 3, vec![15])
    );
    let counts = "push constant 3\nlabel AGAIN\npop local 0\npush local 0\npush constant 1\nsub\n\
        pop local 0\npush local 0\npush local 0\nif-goto AGAIN\npush constant 9";
    assert_eq!(run(counts), (Stop::Ended, 26, vec![0, 9]));
    // The bases are those of the book's own tests.
    let bases = "push constant 21\npop this 6\npush pointer 0\npush this 6\npush pointer 1\n\
        push constant 2\ncall Math.multiply 2\nreturn";
    assert_eq!(run(bases).2, [3000, 21, 6020]);
    let (stop, ..) = run("push constant 1\nadd");
    let Stop::Fault(fault) = stop else {
        panic!("no fault");
    };
    assert_eq!(
        fault.to_string(),
        "Add.vm:2: stack underflow in the program: SP is 256, and the stack starts at 256"
    );
    let two = faults(&[("A.vm", "push constant 1"), ("B.vm", "push constant 2")]);
    assert_eq!(two[0].message, "a command outside every function");
}
