//! Every command, by its effect on the RAM.

use super::{main, prints};
use crate::Stop;

/// The word that `body` leaves on the stack.
fn value(body: &str) -> i16 {
    let (run, statics) = main(3, &format!("{body}\npop static 0"));
    assert_eq!(run.stop, Stop::Ended);
    statics[0]
}

#[test]
fn arithmetic_wraps_at_16_bits() {
    let two = |x: i16, op: &str, y: i16| {
        let push = |v: i16| {
            if v == i16::MIN {
                "push constant 32767\npush constant 1\nadd".to_owned()
            } else if v < 0 {
                format!("push constant {}\nneg", -v)
            } else {
                format!("push constant {v}")
            }
        };
        value(&format!("{}\n{}\n{op}", push(x), push(y)))
    };
    let edges = [i16::MIN, -32767, -300, -1, 0, 1, 2, 255, 256, 32767];
    for x in edges {
        for y in edges {
            let truth = |holds: bool| -i16::from(holds);
            assert_eq!(two(x, "add", y), x.wrapping_add(y));
            assert_eq!(two(x, "sub", y), x.wrapping_sub(y));
            assert_eq!(two(x, "and", y), x & y);
            assert_eq!(two(x, "or", y), x | y);
            assert_eq!(two(x, "eq", y), truth(x == y));
            // Where x - y overflows, too.
            assert_eq!(two(x, "gt", y), truth(x > y));
            assert_eq!(two(x, "lt", y), truth(x < y));
        }
        assert_eq!(
            two(x, "pop temp 0\nneg\npush temp 0\nadd", 0),
            x.wrapping_neg()
        );
        assert_eq!(two(x, "pop temp 0\nnot\npush temp 0\nadd", 0), !x);
    }
}

#[test]
fn calls_keep_frames_and_pointers() {
    let (run, statics) = main(
        1,
        "push constant 3000
        pop pointer 0
        push constant 4000
        pop pointer 1
        push constant 10
        call Main.factorial 1
        pop static 0
        push pointer 0
        pop static 1
        push pointer 1
        pop static 2
        push constant 1
        pop local 0
        push local 0
        if-goto END
        push constant 99
        pop static 3
        label END
        push constant 0
        return
        function Main.factorial 0
        push constant 0
        pop pointer 0
        push argument 0
        push constant 2
        lt
        if-goto ONE
        push argument 0
        push argument 0
        push constant 1
        sub
        call Main.factorial 1
        call Math.multiply 2
        return
        label ONE
        push constant 1
        return",
    );
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(statics[..4], [3628800i32 as i16, 3000, 4000, 0]);
    assert_eq!(run.os_calls, 9);
    assert_eq!(run.os_calls_by_name, [("Math.multiply".to_owned(), 9)]);
}

#[test]
fn commands_are_counted_exactly() {
    // The function, 2 to set, 100 rounds of 9, the last test of 4, and 2 to return.
    let (run, _) = main(
        1,
        "push constant 0
        pop local 0
        label NEXT
        push local 0
        push constant 100
        eq
        if-goto DONE
        push local 0
        push constant 1
        add
        pop local 0
        goto NEXT
        label DONE",
    );
    assert_eq!(run.instructions, 1 + 2 + 100 * 9 + 4 + 2);
    assert_eq!(run.os_calls, 0);
}

#[test]
fn every_jump_on_a_comparison_is_taken_when_it_holds() {
    for (op, holds) in [("eq", [0, 1, 0]), ("lt", [1, 0, 0]), ("gt", [0, 0, 1])] {
        for (y, holds) in [5, 4, 3]
            .into_iter()
            .rev()
            .zip([holds[2], holds[1], holds[0]])
        {
            for not in [false, true] {
                // Operands pushed together, one before, both before.
                for between in [["", ""], ["neg\nneg", ""], ["neg\nneg", "neg\nneg"]] {
                    let [a, b] = between;
                    let not_text = if not { "not" } else { "" };
                    let text = prints(&format!(
                        "push constant 4\n{a}\npush constant {y}\n{b}\n{op}\n{not_text}
                        if-goto TAKEN
                        push constant 0
                        call Output.printInt 1
                        pop temp 0
                        goto END
                        label TAKEN
                        push constant 1
                        call Output.printInt 1
                        pop temp 0
                        label END"
                    ));
                    assert_eq!(
                        text,
                        (holds ^ i32::from(not)).to_string(),
                        "4 {op} {y} {not}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_jump_on_a_word_asks_for_all_its_bits() {
    // `not; if-goto` on 1 jumps, for not 1 is -2.
    for (word, not, taken) in [
        ("0", "", false),
        ("1", "", true),
        ("0", "not", true),
        ("1", "not", true),
        ("0\nnot", "not", false),
    ] {
        for before in ["", "neg\nneg"] {
            let (_, statics) = main(
                0,
                &format!(
                    "push constant {word}\n{before}\n{not}
                    if-goto END
                    push constant 1
                    pop static 0
                    label END"
                ),
            );
            assert_eq!(statics[0] == 0, taken, "{word} {not}");
        }
    }
}

#[test]
fn arrays_are_read_and_written_through_that() {
    let (_, statics) = main(
        2,
        "push constant 10
        call Array.new 1
        pop local 0
        push constant 3
        pop local 1
        push local 1
        push local 0
        add
        push constant 77
        pop temp 0
        pop pointer 1
        push temp 0
        pop that 0
        push local 0
        push constant 3
        add
        pop pointer 1
        push that 0
        pop static 0
        push local 0
        neg
        neg
        push local 1
        add
        pop pointer 1
        push that 0
        pop static 1
        push local 0
        push local 1
        add
        pop pointer 1
        push that 0
        push constant 1
        add
        pop static 2
        push local 0
        neg
        neg
        push local 1
        neg
        neg
        add
        pop pointer 1
        push that 0
        pop static 3
        push pointer 1
        push local 0
        sub
        pop static 4
        push local 0
        pop pointer 0
        push this 3
        pop this 4
        push this 4
        pop static 5
        push static 5
        pop this 6
        push constant 7
        push this 6
        sub
        pop static 6",
    );
    assert_eq!(statics[..7], [77, 77, 78, 77, 3, 77, -70]);
}

#[test]
fn labels_are_each_functions_own_and_comments_are_skipped() {
    let text = prints(
        "goto L // over the print
        call Output.println 0 /* never
        run */
        pop temp 0
        label L
        call Main.f 0
        call Output.printInt 1
        pop temp 0
        push constant 0
        return
        function Main.f 0
        goto L
        label L
        push constant 8
        return
        function Main.g 0",
    );
    assert_eq!(text, "8");
}
