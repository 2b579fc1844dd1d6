//! The heap of each operating system: what it gives until it is full, and what it makes of
//! words that are given back.

use super::{LIMIT, link};
use crate::Stop;
use crate::hack::vm::{Heap, Machine};

/// A step of a program on the heap.
#[derive(Clone, Copy)]
enum Step {
    /// Asks for words.
    Alloc(u16),
    /// Gives back what such a step was given, by its number from 0.
    Free(usize),
}
use Step::{Alloc, Free};

/// What each request is given, on both engines; 6 for that error, which is the last.
fn given(heap: Heap, steps: &[Step]) -> Vec<i16> {
    let mut body = String::new();
    let mut requests = 0;
    for step in steps {
        match step {
            Alloc(size) => {
                body +=
                    &format!("push constant {size}\ncall Memory.alloc 1\npop static {requests}\n");
                requests += 1;
            }
            Free(which) => {
                body += &format!("push static {which}\ncall Memory.deAlloc 1\npop temp 0\n");
            }
        }
    }
    let text = format!("function Main.main 0\n{body}push constant 0\nreturn\n");
    let program = link(&[("Main.vm", &text)]);
    let mut plain = program.clone();
    plain.fused = None;
    let found = [&program, &plain].map(|program| {
        let mut machine = Machine::with_heap(program, heap);
        let run = machine.run(LIMIT, &mut |_| true);
        let all = (16..16 + requests).map(|at| machine.peek(at));
        let mut all: Vec<i16> = all.take_while(|word| *word != 0).collect();
        match run.stop {
            Stop::Ended => assert_eq!(all.len(), usize::from(requests)),
            Stop::Fault(fault) => {
                assert!(fault.message.starts_with("Sys.error(6)"), "{fault}");
                all.push(6);
            }
            stop => panic!("{stop:?}"),
        }
        all
    });
    let [fast, slow] = found;
    assert_eq!(fast, slow);
    fast
}

#[test]
fn a_heap_is_given_away_to_its_last_word() {
    let all =
        |sizes: &[u16], heap| given(heap, &sizes.iter().map(|s| Alloc(*s)).collect::<Vec<_>>());
    assert_eq!(Heap::BuiltIn.words(), 14_334);
    assert_eq!(all(&[14_332], Heap::BuiltIn), [2050]);
    assert_eq!(all(&[14_333], Heap::BuiltIn), [6]);
    assert_eq!(all(&[7000, 7330], Heap::BuiltIn), [2050, 9052]);
    assert_eq!(all(&[7000, 7330, 1], Heap::BuiltIn), [2050, 9052, 6]);
    assert_eq!(all(&[7000, 7331], Heap::BuiltIn), [2050, 6]);
    assert_eq!(all(&[3, 14_326, 1], Heap::BuiltIn), [2050, 2055, 6]);
    // Where the official system runs beside the program there are fewer.
    assert_eq!(Heap::Official.words(), 11_511);
    assert_eq!(all(&[11_509], Heap::Official), [4872]);
    assert_eq!(all(&[11_510], Heap::Official), [6]);
    assert_eq!(all(&[5000, 6507, 1], Heap::Official), [4872, 9874, 6]);
    assert_eq!(all(&[5000, 6508], Heap::Official), [4872, 6]);
}

#[test]
fn what_is_given_back_is_reused_and_not_joined() {
    let full = [Alloc(100), Alloc(200), Alloc(14_028)];
    let then = |more: &[Step]| {
        let steps: Vec<Step> = full.iter().chain(more).copied().collect();
        given(Heap::BuiltIn, &steps)[3..].to_vec()
    };
    assert_eq!(then(&[Alloc(1)]), [6]);
    for free in [[Free(0), Free(1)], [Free(1), Free(0)]] {
        let [a, b] = free;
        assert_eq!(
            then(&[a, b, Alloc(201)]),
            [6],
            "302 words in a row, of two segments"
        );
        assert_eq!(
            then(&[a, b, Alloc(200), Alloc(100), Alloc(1)]),
            [2152, 2050, 6]
        );
        // What is left of a segment is one of its own while it has a word.
        assert_eq!(then(&[a, b, Alloc(97), Alloc(1)]), [2050, 2149]);
        assert_eq!(then(&[a, b, Alloc(98), Alloc(1)]), [2050, 2152]);
    }
    // Over and over.
    let turns: Vec<Step> = (0..20).flat_map(|k| [Free(2 + k), Alloc(14_028)]).collect();
    assert_eq!(then(&turns), vec![2354; 20]);
}

#[test]
fn the_official_system_joins_what_is_free_in_a_row() {
    let full = [Alloc(100), Alloc(200), Alloc(11_205)];
    let then = |more: &[Step]| {
        let steps: Vec<Step> = full.iter().chain(more).copied().collect();
        given(Heap::Official, &steps)[3..].to_vec()
    };
    assert_eq!(then(&[Alloc(1)]), [6]);
    for free in [[Free(0), Free(1)], [Free(1), Free(0)]] {
        let [a, b] = free;
        assert_eq!(then(&[a, b, Alloc(302)]), [4872]);
        assert_eq!(then(&[a, b, Alloc(303)]), [6]);
    }
    assert_eq!(
        then(&[Free(0), Free(2), Alloc(100), Alloc(11_205)]),
        [4872, 5176]
    );
}
