//! Every function of the operating system.

use super::{LIMIT, both, link, main, message, prints};
use crate::Stop;

/// Pushes a number of any sign.
fn push(value: i32) -> String {
    match value {
        -32768 => "push constant 32767\npush constant 1\nadd\n".to_owned(),
        ..0 => format!("push constant {}\nneg\n", -value),
        _ => format!("push constant {value}\n"),
    }
}

/// A call with constant arguments whose result stays.
fn call(name: &str, arguments: &[i32]) -> String {
    let pushes: String = arguments.iter().map(|value| push(*value)).collect();
    format!("{pushes}call {name} {}\n", arguments.len())
}

/// A call whose result is dropped.
pub(super) fn run(name: &str, arguments: &[i32]) -> String {
    call(name, arguments) + "pop temp 0\n"
}

fn value(name: &str, arguments: &[i32]) -> i16 {
    main(0, &(call(name, arguments) + "pop static 0")).1[0]
}

/// The number of the error that a call ends with.
pub(super) fn error(name: &str, arguments: &[i32]) -> i32 {
    let message = message(0, &run(name, arguments));
    let number = message.strip_prefix("Sys.error(").unwrap();
    number
        .split_once(") in Main.main")
        .unwrap()
        .0
        .parse()
        .unwrap()
}

#[test]
fn math() {
    let edges = [-32768, -32767, -181, -2, -1, 0, 1, 3, 182, 32767];
    for a in edges {
        for b in edges {
            assert_eq!(value("Math.multiply", &[a, b]), (a * b) as i16);
            assert_eq!(value("Math.min", &[a, b]), a.min(b) as i16);
            assert_eq!(value("Math.max", &[a, b]), a.max(b) as i16);
            if b == 0 {
                assert_eq!(error("Math.divide", &[a, b]), 3);
            } else {
                assert_eq!(value("Math.divide", &[a, b]), (a / b) as i16);
            }
        }
        assert_eq!(value("Math.abs", &[a]), a.abs() as i16);
    }
    for (x, root) in [
        (0, 0),
        (1, 1),
        (3, 1),
        (4, 2),
        (32761, 181),
        (32760, 180),
        (32767, 181),
    ] {
        assert_eq!(value("Math.sqrt", &[x]), root);
    }
    assert_eq!(error("Math.sqrt", &[-1]), 4);
    assert_eq!(value("Math.init", &[]), 0);
}

#[test]
fn memory() {
    let (_, statics) = main(
        1,
        &(run("Memory.poke", &[5000, -7])
            + &call("Memory.peek", &[5000])
            + "pop static 0\n"
            + &call("Memory.alloc", &[10])
            + "pop static 1\n"
            + &call("Memory.alloc", &[20])
            + "pop static 2\n"
            + "push static 1\ncall Memory.deAlloc 1\npop temp 0\n"
            // First fit: into the hole, or behind.
            + &call("Memory.alloc", &[11])
            + "pop static 3\n"
            + &call("Memory.alloc", &[8])
            + "pop static 4\n"
            // Each is what it was before: 10 words, 20, 11, and the rest.
            + "push static 3\ncall Memory.deAlloc 1\npop temp 0\n"
            + "push static 2\ncall Array.dispose 1\npop temp 0\n"
            + "push static 4\ncall String.dispose 1\npop temp 0\n"
            + &call("Memory.alloc", &[20])
            + "pop static 5\n"
            + &call("Memory.alloc", &[12])
            + "pop static 6\n"),
    );
    assert_eq!(statics[..7], [-7, 2050, 2062, 2084, 2050, 2062, 2097]);
    assert_eq!(error("Memory.alloc", &[0]), 5);
    assert_eq!(error("Memory.alloc", &[14333]), 6);
    assert_eq!(value("Memory.alloc", &[14332]), 2050);
    assert_eq!(error("Array.new", &[0]), 2);
    assert_eq!(error("Array.new", &[-1]), 2);
    assert_eq!(error("Array.new", &[20000]), 6);
    assert_eq!(value("Array.new", &[1]), 2050);
    // Memory.init forgets all.
    let again = main(
        0,
        &(run("Memory.alloc", &[10000])
            + &run("Memory.init", &[])
            + &call("Memory.alloc", &[10000])
            + "pop static 0"),
    );
    assert_eq!(again.1[0], 2050);
}

#[test]
fn a_heap_tied_in_a_knot_is_full_and_no_hang() {
    let body = run("Memory.poke", &[2048, 0]) + &run("Memory.poke", &[2049, 2048]);
    let text = message(0, &(body + &run("Memory.alloc", &[1])));
    assert!(text.starts_with("Sys.error(6)"), "{text}");
}

#[test]
fn strings() {
    let method = |name: &str, arguments: &[i32]| {
        let pushes: String = arguments.iter().map(|value| push(*value)).collect();
        format!(
            "push local 0\n{pushes}call String.{name} {}\n",
            arguments.len() + 1
        )
    };
    let new = |capacity: i32| call("String.new", &[capacity]) + "pop local 0\n";
    let append = |text: &str| -> String {
        text.bytes()
            .map(|c| method("appendChar", &[i32::from(c)]) + "pop local 0\n")
            .collect()
    };
    let print = "push local 0\ncall Output.printString 1\npop temp 0\n";
    let (run, statics) = main(
        1,
        &(new(6)
            + &append("-12x")
            + print
            + &method("length", &[])
            + "pop static 0\n"
            + &method("intValue", &[])
            + "pop static 1\n"
            + &method("charAt", &[3])
            + "pop static 2\n"
            + &method("setCharAt", &[3, 53])
            + "pop temp 0\n"
            + &method("intValue", &[])
            + "pop static 3\n"
            + &method("eraseLastChar", &[])
            + "pop temp 0\n"
            + &method("intValue", &[])
            + "pop static 4\n"
            + &method("setInt", &[-32768])
            + "pop temp 0\n"
            + print
            + "push local 0\npop pointer 0\npush this 0\npop static 5\npush this 1\npop static 6\n"
            + "push local 0\ncall String.dispose 1\npop temp 0\n"),
    );
    assert_eq!(run.text, "-12x-32768");
    assert_eq!(statics[..7], [4, -12, 120, -125, -12, 6, 6]);

    let fails = |body: String| message(1, &body).split_once(':').unwrap().0.to_owned();
    let in_main = |number: i32| format!("Sys.error({number}) in Main.main");
    assert_eq!(fails(run_new(-1)), in_main(14));
    assert_eq!(
        fails(new(3) + &append("ab") + &method("charAt", &[2])),
        in_main(15)
    );
    assert_eq!(
        fails(new(3) + &append("ab") + &method("charAt", &[-1])),
        in_main(15)
    );
    assert_eq!(
        fails(new(3) + &append("a") + &method("setCharAt", &[1, 65])),
        in_main(16)
    );
    assert_eq!(fails(new(2) + &append("abc")), in_main(17));
    assert_eq!(fails(new(2) + &method("eraseLastChar", &[])), in_main(18));
    assert_eq!(fails(new(3) + &method("setInt", &[1234])), in_main(19));
    assert_eq!(value("String.newLine", &[]), 128);
    assert_eq!(value("String.backSpace", &[]), 129);
    assert_eq!(value("String.doubleQuote", &[]), 34);
    assert_eq!(value("String.new", &[0]), 2050);
}

fn run_new(capacity: i32) -> String {
    run("String.new", &[capacity])
}

#[test]
fn output() {
    let text = prints(
        &(run("Output.init", &[])
            + &run("Output.printInt", &[-32768])
            + &run("Output.printChar", &[65])
            + &run("Output.printChar", &[66])
            + &run("Output.backSpace", &[])
            + &run("Output.println", &[])
            + &run("Output.backSpace", &[])
            + &run("Output.moveCursor", &[22, 63])
            + &run("Output.printChar", &[67])
            + &run("Output.printChar", &[68])
            + &run("Output.printChar", &[129])
            + &run("Output.printChar", &[128])
            + &run("Output.printChar", &[200])),
    );
    assert_eq!(text, "-32768A\nC\n\u{25a0}");
    assert_eq!(error("Output.moveCursor", &[23, 0]), 20);
    assert_eq!(error("Output.moveCursor", &[0, 64]), 20);
    assert_eq!(error("Output.moveCursor", &[-1, 0]), 20);
}

#[test]
fn keyboard_and_time() {
    assert_eq!(value("Keyboard.keyPressed", &[]), 0);
    assert_eq!(value("Keyboard.init", &[]), 0);
    for (name, arguments) in [("readChar", &[][..]), ("readLine", &[0]), ("readInt", &[0])] {
        let text = message(0, &run(&format!("Keyboard.{name}"), arguments));
        assert!(
            text.starts_with(&format!("Keyboard.{name} waits for a key")),
            "{text}"
        );
    }
    assert_eq!(value("Sys.wait", &[32767]), 0);
    assert_eq!(error("Sys.wait", &[-1]), 1);
    assert_eq!(error("Sys.error", &[42]), 42);
    assert_eq!(error("Sys.error", &[-3]), -3);
    let (halted, statics) = main(0, &(run("Sys.halt", &[]) + "push constant 1\npop static 0"));
    assert_eq!(halted.stop, Stop::Ended);
    assert_eq!((halted.instructions, statics[0]), (2, 0));
}

#[test]
fn calls_are_counted_by_name() {
    let (run, _) = main(
        0,
        &(run("Math.abs", &[1]) + &run("Math.divide", &[6, 2]) + &run("Math.divide", &[6, 3])),
    );
    let by_name = [("Math.abs".to_owned(), 1), ("Math.divide".to_owned(), 2)];
    assert_eq!(run.os_calls, 3);
    assert_eq!(run.os_calls_by_name, by_name);
    assert_eq!(run.instructions, 1 + 3 + 4 + 4 + 2);
}

#[test]
fn the_programs_own_classes_come_first() {
    // Its own allocator hands out from 9000; Array and String still are native.
    let memory = "function Memory.init 0
        push constant 9000
        pop static 0
        push constant 0
        return
        function Memory.alloc 0
        push static 0
        push static 0
        push argument 0
        add
        pop static 0
        return
        function Memory.deAlloc 0
        push argument 0
        pop static 1
        push constant 0
        return";
    let main_text = "function Main.main 1
        push constant 7
        call Array.new 1
        pop static 0
        push constant 4
        call String.new 1
        pop local 0
        push local 0
        push constant 33
        call String.appendChar 2
        call Output.printString 1
        pop temp 0
        push local 0
        pop static 1
        push static 0
        call Array.dispose 1
        pop temp 0
        push constant 5
        push constant 5
        call Math.abs 1
        call Math.multiply 2
        pop static 2
        push constant 0
        call Array.new 1
        return
        function Math.abs 0
        push constant 3
        return";
    let program = link(&[("Memory.vm", memory), ("Main.vm", main_text)]);
    let mut plain = program.clone();
    let (machine, run) = both(&program, &mut plain, LIMIT);
    let address = |index| program.static_address("Main.vm", index).unwrap();
    assert_eq!(machine.peek(address(0)), 9000);
    assert_eq!(machine.peek(address(1)), 9007);
    assert_eq!(machine.peek(address(2)), 15);
    assert_eq!(machine.peek(9007), 4);
    let given_back = program.static_address("Memory.vm", 1).unwrap();
    assert_eq!(machine.peek(given_back), 9000, "what was given back");
    assert_eq!(machine.peek(2048), 0, "the native heap is not there");
    assert_eq!(run.text, "!");
    assert_eq!(
        run.stop,
        Stop::Fault(crate::Fault {
            message: "Sys.error(2) in Array.new".to_owned(),
            file: Some("(operating system)".to_owned()),
            line: Some(8),
            column: None
        })
    );
    assert_eq!(program.commands(), 17 + 28);
}

#[test]
fn native_functions_use_the_programs_own_strings_and_errors() {
    let text = "function Main.main 0
        push constant 3
        call Output.printString 1
        pop temp 0
        push constant 1
        push constant 0
        call Math.divide 2
        return
        function String.length 0
        push argument 0
        return
        function String.charAt 0
        push argument 1
        push constant 97
        add
        return
        function Sys.error 0
        push argument 0
        call Output.printInt 1
        pop temp 0
        call Sys.halt 0
        return
        function Sys.halt 0
        label L
        push constant 1
        if-goto L
        push constant 0
        return";
    let program = link(&[("Main.vm", text)]);
    let mut plain = program.clone();
    let (_, run) = both(&program, &mut plain, LIMIT);
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(run.text, "abc3");
    // One that returns leaves nothing to go on with.
    let returns = "function Main.main 0
        push constant 1\nneg\ncall Math.sqrt 1\nreturn
        function Sys.error 0\npush constant 0\nreturn";
    let program = link(&[("Main.vm", returns)]);
    let mut plain = program.clone();
    let (_, run) = both(&program, &mut plain, LIMIT);
    assert!(matches!(run.stop, Stop::Fault(f) if f.message.starts_with("Sys.error returned")));
}

#[test]
fn sys_init_starts_the_program() {
    let own = "function Main.main 0\npush constant 1\npop static 0\npush constant 0\nreturn
        function Sys.init 0\ncall Main.main 0\npop temp 0\npush constant 2\npop static 1\ncall Sys.halt 0\nreturn";
    let program = link(&[("Main.vm", own)]);
    let mut plain = program.clone();
    let (machine, run) = both(&program, &mut plain, LIMIT);
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!((machine.peek(16), machine.peek(17)), (1, 2));
    assert_eq!(run.instructions, 1 + 1 + 5 + 4);
    // The native one can be called, too.
    let again = "function Main.main 0
        push static 0\nif-goto END\npush constant 1\npop static 0\ncall Sys.init 0
        label END\npush constant 0\nreturn";
    let program = link(&[("Main.vm", again)]);
    let mut plain = program.clone();
    assert_eq!(both(&program, &mut plain, LIMIT).1.stop, Stop::Ended);
}
