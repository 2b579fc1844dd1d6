//! Small programs, and what is said of those that cannot be translated.

use super::{link, same};
use crate::hack::cpu::Cpu;
use crate::hack::translate::{Options, Size, translate};
use crate::hack::vm::Machine;

/// A `Sys.init` with statics 0 to 9, which ends.
fn runs(body: &str) {
    let text = format!("function Sys.init 3\n{body}\ncall Sys.halt 0\nreturn");
    same(&link(&[("Sys.vm", &text)]), false);
}

#[test]
fn every_comparison_of_words_far_apart() {
    let words = [
        "push constant 0",
        "push constant 1",
        "push constant 1\nneg",
        "push constant 100",
        "push constant 100\nneg",
        "push constant 32767",
        "push constant 32767\nneg",
        "push constant 32767\nnot",
    ];
    for x in words {
        for y in words {
            let mut body = format!("{x}\npop static 8\n{y}\npop static 9\n");
            for (k, op) in ["eq", "lt", "gt"].iter().enumerate() {
                // As a word, and as a condition either way; against words in memory
                // and constants on either side.
                for (n, (a, b)) in [
                    ("push static 8", "push static 9"),
                    (x, "push static 9"),
                    ("push static 8", y),
                ]
                .iter()
                .enumerate()
                {
                    let to = 3 * k + n + 3000;
                    body.push_str(&format!("push constant {to}\n{a}\n{b}\n{op}\n"));
                    body.push_str("pop temp 0\npop pointer 1\npush temp 0\npop that 0\n");
                    for (way, not) in ["", "not\n"].iter().enumerate() {
                        let label = format!("L{k}{n}{way}");
                        body.push_str(
                            &format!(
                                "push constant {}\n{a}\n{b}\n{op}\n{not}if-goto {label}\n\
                             push constant 7\ncall Memory.poke 2\npop temp 0\n\
                             push constant 0\npush constant 0\nlabel {label}\n\
                             pop static 7\n",
                                to + 100 * (way + 1),
                            )
                            .replace(
                                "push constant 0\npush constant 0\nlabel",
                                "push constant 5\nlabel",
                            ),
                        );
                    }
                }
            }
            runs(&body);
        }
    }
}

#[test]
fn what_is_missing_is_said() {
    let program = link(&[(
        "Main.vm",
        "function Main.main 0\npush constant 3\ncall Main.f 1\nreturn\n\
         function Main.f 0\npush argument 0\ncall Output.printInt 1\nreturn\n\
         function Main.never 0\ncall Output.println 0\nreturn",
    )]);
    let faults = translate(&program, Options::default()).unwrap_err();
    assert_eq!(faults.len(), 1);
    assert_eq!(
        faults[0].message,
        "Main.f calls Output.printInt, which the program would have to bring: \
         only the VM has it by itself"
    );
    let uneven =
        "function Sys.init 0\nlabel A\npush constant 1\npush constant 1\nif-goto A\nreturn";
    let faults = translate(&link(&[("Sys.vm", uneven)]), Options::default()).unwrap_err();
    assert!(
        faults[0]
            .message
            .starts_with("a function's stack is not equally high")
    );
}

#[test]
fn what_does_not_fit_is_said() {
    let one = "push static 0\npush constant 12345\nadd\npop static 0\n";
    let text = format!(
        "function Sys.init 0\n{}push constant 0\nreturn",
        one.repeat(10_000)
    );
    let faults = translate(&link(&[("Sys.vm", &text)]), Options::default()).unwrap_err();
    assert_eq!(faults.len(), 1);
    let message = &faults[0].message;
    assert!(
        message.ends_with("more than the ROM's 32768 words"),
        "{message}"
    );
}

#[test]
fn functions_with_their_callers_pointers_and_temps() {
    let text = "function Sys.init 1
        push constant 3000
        pop pointer 0
        push constant 3001
        pop pointer 1
        push constant 77
        pop temp 2
        push constant 5
        call Sys.f 1
        pop static 0
        push temp 2
        pop static 1
        push that 0
        pop static 2
        call Sys.halt 0
        return
        function Sys.f 1
        push argument 0
        pop this 0
        push temp 2
        pop that 0
        push constant 9
        pop temp 2
        push constant 0
        pop pointer 0
        push local 0
        push this 16
        add
        return";
    same(&link(&[("Sys.vm", text)]), true);
}

#[test]
fn many_arguments_and_locals() {
    let push: String = (0..9).map(|k| format!("push constant {k}\n")).collect();
    let sum: String = (0..9)
        .map(|k| format!("push argument {k}\nadd\n"))
        .collect();
    let locals: String = (0..70).map(|k| format!("push local {k}\nadd\n")).collect();
    let text = format!(
        "function Sys.init 0
        {push}call Sys.f 9
        pop static 0
        {push}call Sys.f 9
        pop static 1
        call Sys.halt 0
        return
        function Sys.f 70
        push constant 0
        {sum}{locals}push constant 8
        pop local 40
        push local 40
        add
        push argument 8
        push constant 8
        eq
        not
        if-goto DONE
        {push}push constant 3
        add
        call Sys.f 9
        add
        label DONE
        return"
    );
    same(&link(&[("Sys.vm", &text)]), true);
}

/// What waits on the stack is what was pushed, whatever changes meanwhile.
#[test]
fn words_change_after_they_are_pushed() {
    let text = "function Sys.init 2
        push constant 5
        pop static 0
        push static 0
        call Sys.f 0
        add
        pop static 1
        push constant 6
        pop local 0
        push local 0
        call Sys.f 0
        pop local 0
        push local 0
        add
        pop static 2
        push local 0
        push constant 8
        pop local 0
        pop static 3
        push static 0
        push constant 16
        pop pointer 1
        push constant 44
        pop that 0
        pop static 4
        push that 0
        push constant 16
        push constant 45
        call Memory.poke 2
        pop temp 0
        pop static 5
        call Sys.halt 0
        return
        function Sys.f 0
        push static 0
        push constant 100
        add
        pop static 0
        push constant 1000
        return";
    same(&link(&[("Sys.vm", text)]), true);
}

/// What is in D is not what is in memory, once that has changed by an address.
#[test]
fn words_change_by_their_addresses() {
    let text = "function Sys.init 0
        push constant 3000
        push static 1
        add
        pop static 2
        push constant 3
        pop static 0
        push static 1
        push constant 16
        add
        pop pointer 1
        push constant 7
        push static 1
        sub
        pop static 0
        push constant 1
        pop that 0
        push static 0
        pop static 3
        push static 0
        push static 3
        add
        pop static 4
        call Sys.halt 0
        return";
    same(&link(&[("Sys.vm", text)]), true);
}

/// With all statics taken the cells are where the stack would begin.
#[test]
fn no_room_between_the_statics() {
    let temps: String = (0..8)
        .map(|k| format!("push constant {k}\npop temp {k}\n"))
        .collect();
    let sum: String = (0..8).map(|k| format!("push temp {k}\nadd\n")).collect();
    let text = format!(
        "function Sys.init 2
        {temps}push constant 3
        pop local 1
        push constant 6
        call Sys.again 1
        push local 1
        push constant 7
        call Sys.f 1
        sub
        sub
        {sum}pop static 239
        call Sys.halt 0
        return
        function Sys.again 2
        push argument 0
        pop local 1
        push argument 0
        if-goto ON
        push constant 1
        return
        label ON
        push argument 0
        call Sys.f 1
        push argument 0
        push constant 1
        sub
        call Sys.again 1
        push local 1
        add
        sub
        return
        function Sys.f 20
        push argument 0
        pop local 19
        push local 19
        push local 3
        add
        push static 239
        add
        pop static 0
        push static 0
        return"
    );
    same(&link(&[("Sys.vm", &text)]), true);
}

#[test]
fn functions_called_like_symbols_and_like_our_labels() {
    let names = [
        "halt",
        "leave",
        "SP",
        "SCREEN",
        "$3",
        "$3$7",
        "R15",
        "Sys.init$1",
    ];
    let calls: String = names
        .iter()
        .map(|name| format!("call {name} 0\npush static 0\nadd\npop static 0\n"))
        .collect();
    let functions: String = (1..)
        .zip(names)
        .map(|(k, name)| format!("function {name} 0\npush constant {k}\nreturn\n"))
        .collect();
    let text = format!("function Sys.init 0\n{calls}call Sys.halt 0\nreturn\n{functions}");
    same(&link(&[("Sys.vm", &text)]), true);
}

/// A method that passes fields beyond the first few so many times.
fn passes_fields(times: usize) -> String {
    let set = |k, value| {
        format!(
            "push constant 3000\npush constant {value}\npop temp 0\n\
             pop pointer 1\npush temp 0\npop that {k}\n"
        )
    };
    let (some, others) = (set(9, 55), set(100, 77));
    let more = "push this 9\npush this 100\npush this 0\ncall Sys.f 3\nadd\n".repeat(times);
    format!(
        "function Sys.init 0
        {some}{others}push constant 3000
        call Sys.method 1
        pop static 0
        call Sys.halt 0
        return
        function Sys.method 0
        push argument 0
        pop pointer 0
        push this 9
        push constant 4
        push this 9
        call Sys.f 3
        {more}return
        function Sys.f 0
        push argument 0
        push argument 0
        add
        push argument 1
        sub
        push argument 2
        add
        return"
    )
}

#[test]
fn fields_are_passed_by_number_where_words_count() {
    let program = link(&[("Sys.vm", &passes_fields(6))]);
    let (_, results) = same(&program, true);
    let words: Vec<usize> = results.iter().map(|(t, _)| t.words.len()).collect();
    let small: Vec<bool> = results.iter().map(|(t, _)| t.small).collect();
    assert_eq!(small, [false, false, true, false]);
    assert!(words[2] < words[0], "{words:?}");
}

#[test]
fn a_program_is_small_where_it_must_be() {
    let program = link(&[("Sys.vm", &passes_fields(1500))]);
    let fast = Options {
        size: Size::Fast,
        ..Options::default()
    };
    let fast = translate(&program, fast).map(|t| t.words.len());
    let faults = fast.unwrap_err();
    assert!(
        faults[0].message.contains("more than the ROM's"),
        "{faults:?}"
    );
    let fitted = translate(&program, Options::default()).unwrap();
    assert!(fitted.small);
    let mut cpu = Cpu::new(&fitted.words).unwrap();
    cpu.run(1_000_000, &mut |_| true);
    let mut vm = Machine::new(&program);
    vm.run(1_000_000, &mut |_| true);
    assert_eq!(cpu.peek(16), vm.peek(16));
    assert_ne!(cpu.peek(16), 0);
}
