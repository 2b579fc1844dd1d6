//! Scripts of keys, and what programs see of them.
#![allow(clippy::unwrap_used)]

use super::{Key, Keyboard, Next, Script, Seen, Still, Unit};
use crate::Screen;
use proptest::prelude::*;

fn script(text: &str) -> Script {
    text.parse().unwrap()
}

fn said(text: &str) -> String {
    text.parse::<Script>().unwrap_err().to_string()
}

/// What each unit of a script holds, up to its length.
fn units(text: &str) -> Vec<Option<Key>> {
    let script = script(text);
    (0..script.length()).map(|unit| script.held(unit)).collect()
}

fn none() -> Option<Screen> {
    None
}

#[test]
fn words_are_keys_in_time() {
    use Key::{Char, Enter, Function, Left};
    let expected = [
        Some(Left),
        Some(Left),
        Some(Left),
        None,
        None,
        None,
        Some(Enter),
        None,
    ];
    assert_eq!(units("left*3 wait 2 enter"), expected);
    let expected = [
        Some(Char(b'A')),
        None,
        Some(Char(b' ')),
        None,
        Some(Char(b'b')),
        None,
    ];
    assert_eq!(units("\"A b\" // \"c\"\n"), expected);
    let expected = [Some(Function(10)), None, Some(Char(b'*')), None];
    assert_eq!(units("F10 *"), expected);
    let expected = [
        Some(Char(b'*')),
        Some(Char(b'*')),
        None,
        Some(Char(b'"')),
        None,
        None,
    ];
    assert_eq!(units("**2 quote left*0"), expected);
    assert_eq!(units(""), []);
    assert_eq!(script("by calls a").unit(), Some(Unit::Calls));
    assert_eq!(script("by frames").unit(), Some(Unit::Frames));
}

/// A key that is held across the end is let go there, and does not put it off.
#[test]
fn a_script_ends_where_it_is_cut() {
    let mut keyboard = Keyboard::new(script("right*20 a").ended(3), Unit::Frames, |_| None);
    let seen: Vec<Seen> = (0..4).map(|frame| keyboard.look(frame, none)).collect();
    let right = Seen::Key(Key::Right);
    assert_eq!(seen, [right, right, right, Seen::Quit]);
}

#[test]
fn wrong_words_are_named_with_their_place() {
    for (text, message) in [
        (
            "rihgt*20",
            "1:1: there is no key `rihgt`: keys are single characters, f0 to f12, space",
        ),
        ("a\n  f13", "2:3: there is no key `f13`"),
        ("a f+1", "1:3: there is no key `f+1`"),
        ("a é", "1:3: there is no key `é`"),
        ("a*x", "1:1: `x` is no number of units from 0 to 1000000000"),
        ("a*-1", "1:1: `-1` is no number"),
        ("a*9999999999", "1:1: `9999999999` is no number"),
        ("a **", "1:3: `` is no number"),
        ("wait", "1:1: `wait` needs how long, in units: `wait 50`"),
        ("wait long", "1:6: `long` is no number"),
        ("shot", "1:1: `shot` needs a file"),
        ("by", "1:1: `by` needs `frames` or `calls`"),
        ("by hand", "1:4: a script is by `frames` or by `calls`"),
        ("a by calls", "1:3: `by` stands at the start"),
        ("stdin a", "1:7: nothing comes after"),
        ("quit stdin", "1:6: nothing comes after"),
        ("a \"bc", "1:3: the text has no closing"),
        ("\"ü\"", "1:1: a text has only ASCII"),
    ] {
        let said = said(text);
        assert!(said.starts_with(message), "{text}: {said}");
    }
}

/// What a script gives to looks by calls, and to waits, is the same keys in the same order.
#[test]
fn looks_and_waits_see_the_script() {
    let mut keyboard = Keyboard::new(script("a*2 b wait 3 c"), Unit::Calls, |_| None);
    let looks: Vec<Seen> = (0..11).map(|_| keyboard.look(99, none)).collect();
    let key = |c| Seen::Key(Key::Char(c));
    let no = Seen::Nothing;
    let expected = [
        key(b'a'),
        key(b'a'),
        no,
        key(b'b'),
        no,
        no,
        no,
        no,
        key(b'c'),
        no,
        no,
    ];
    assert_eq!(looks, expected);
    assert_eq!(keyboard.late(), 1);

    let mut keyboard = Keyboard::new(script("a*2 b wait 3 c"), Unit::Calls, |_| None);
    let waits: Vec<Next> = (0..5).map(|_| keyboard.wait(0, "", none)).collect();
    let key = |c| Next::Key(Key::Char(c), 0);
    assert_eq!(
        waits,
        [key(b'a'), key(b'a'), key(b'b'), key(b'c'), Next::Never]
    );

    let mut keyboard = Keyboard::new(script("a*2 b wait 3 c quit"), Unit::Calls, |_| None);
    let waits: Vec<Next> = (0..4).map(|_| keyboard.wait_press(0, "", none)).collect();
    assert_eq!(waits, [key(b'a'), key(b'b'), key(b'c'), Next::Quit]);
}

#[test]
fn by_frames_keys_are_held_from_picture_to_picture() {
    let new = || Keyboard::new(script("a*2 wait 3 b quit"), Unit::Frames, |_| None);
    let key = |c| Seen::Key(Key::Char(c));
    let mut keyboard = new();
    let frames = [0, 0, 1, 2, 5, 6, 6, 7, 8];
    let looks: Vec<Seen> = frames.iter().map(|f| keyboard.look(*f, none)).collect();
    let no = Seen::Nothing;
    assert_eq!(
        looks,
        [
            key(b'a'),
            key(b'a'),
            key(b'a'),
            no,
            no,
            key(b'b'),
            key(b'b'),
            no,
            Seen::Quit
        ]
    );
    // Typed, a key that is held comes once a frame.
    let mut keyboard = new();
    let takes: Vec<Seen> = frames.iter().map(|f| keyboard.take(*f, none)).collect();
    assert_eq!(
        takes,
        [
            key(b'a'),
            no,
            key(b'a'),
            no,
            no,
            key(b'b'),
            no,
            no,
            Seen::Quit
        ]
    );
    // Who waits is told how long.
    let mut keyboard = new();
    let next = |c, frames| Next::Key(Key::Char(c), frames);
    assert_eq!(keyboard.wait(0, "", none), next(b'a', 0));
    assert_eq!(keyboard.wait(0, "", none), next(b'a', 1));
    assert_eq!(keyboard.wait(1, "", none), next(b'b', 5));
    assert_eq!(keyboard.wait(6, "", none), Next::Quit);
    let mut keyboard = new();
    assert_eq!(keyboard.wait_press(0, "", none), next(b'a', 2));
    assert_eq!(keyboard.wait_press(2, "", none), next(b'b', 5));
}

fn two_lines(shown: &str) -> Option<Vec<u8>> {
    (shown == "? ").then(|| b"7\n".to_vec())
}

#[test]
fn standard_input_is_typed_behind_the_script() {
    let mut keyboard = Keyboard::new(script("a"), Unit::Calls, two_lines);
    let shown = ["? ", "? ", "? ", "? ", "", ""];
    let typed: Vec<Next> = shown
        .iter()
        .map(|s| keyboard.wait_press(0, s, none))
        .collect();
    let key = |key| Next::Key(key, 0);
    let seven = key(Key::Char(b'7'));
    assert_eq!(
        typed,
        [
            key(Key::Char(b'a')),
            seven,
            key(Key::Enter),
            seven,
            key(Key::Enter),
            Next::Never
        ]
    );
    // Who only looks sees none of it, but where the script says so.
    let mut keyboard = Keyboard::new(script("a"), Unit::Calls, two_lines);
    let looks: Vec<Seen> = (0..4).map(|_| keyboard.look(0, none)).collect();
    assert_eq!(looks[1..], [Seen::Nothing; 3]);
    assert_eq!(keyboard.late(), 2);
    fn once(_: &str) -> Option<Vec<u8>> {
        Some(b"x\xff\r\n".to_vec())
    }
    let mut keyboard = Keyboard::new(script("stdin"), Unit::Calls, once);
    let looks: Vec<Seen> = (0..4).map(|_| keyboard.look(0, none)).collect();
    let (x, enter) = (Seen::Key(Key::Char(b'x')), Seen::Key(Key::Enter));
    assert_eq!(looks, [x, Seen::Nothing, enter, Seen::Nothing]);
}

#[test]
fn shots_are_taken_when_they_are_due() {
    let screen = |n: u8| {
        let pixels = vec![n];
        move || {
            Some(Screen {
                width: 1,
                height: 1,
                pixels,
                palette: Vec::new(),
            })
        }
    };
    let text = "shot first.png a wait 5 shot \"last one.png\" b shot never.png";
    let mut keyboard = Keyboard::new(script(text), Unit::Calls, |_| None);
    for look in 0..8 {
        keyboard.look(0, screen(look));
    }
    let shots: Vec<(&str, u8)> = keyboard
        .shots()
        .iter()
        .map(|(name, screen)| (name.as_str(), screen.as_ref().unwrap().pixels[0]))
        .collect();
    assert_eq!(shots, [("first.png", 0), ("last one.png", 7)]);
    assert_eq!(keyboard.missed().collect::<Vec<_>>(), ["never.png"]);
    // Who waits passes over time, and the screen stays what it is.
    let mut keyboard = Keyboard::new(script(text), Unit::Frames, |_| None);
    keyboard.wait(3, "", screen(9));
    assert_eq!(keyboard.shots().len(), 2);
}

proptest! {
    #[test]
    fn any_text_is_a_script_or_is_refused(text in "[a-z0-9*\"/ \n.éA-Z+-]{0,60}") {
        match text.parse::<Script>() {
            Ok(script) => {
                // A key is never held beyond the end.
                prop_assert_eq!(script.held(script.length()), None);
            }
            Err(fault) => prop_assert!(fault.line.is_some() && fault.column.is_some()),
        }
    }

    /// Words give the keys that they name, in their order, each for its length.
    #[test]
    fn scripts_are_what_they_say(words in prop::collection::vec((0usize..5, 0u64..4), 0..20)) {
        let names = ["a", "left", "f1", "*", "wait"];
        let keys = [Key::Char(b'a'), Key::Left, Key::Function(1), Key::Char(b'*')];
        let mut text = String::new();
        let mut expected = Vec::new();
        for (name, count) in words {
            match keys.get(name) {
                Some(key) => {
                    text += &format!("{}*{count} ", names[name]);
                    expected.extend(vec![Some(*key); count as usize]);
                    expected.push(None);
                }
                None => {
                    text += &format!("wait {count}\n");
                    expected.extend(vec![None; count as usize]);
                }
            }
        }
        prop_assert_eq!(units(&text), expected);
    }

    /// A walk that ends in a circle is found out, and no state that comes once is.
    #[test]
    fn circles_are_found(tail in 0u64..50, circle in 1u64..50) {
        let mut still = Still::default();
        let state = |step: u64| if step < tail { step } else { tail + (step - tail) % circle };
        let found = (0..1000).find(|step| still.again(state(*step) % 3, &[state(*step)]));
        let found = found.unwrap();
        prop_assert!(found >= tail + circle && found < 4 * (tail + circle) + 4, "{}", found);
    }
}

/// A film is a shot at each look, and ends at the last; what is held is what the script says.
#[test]
fn films_have_a_shot_at_every_look() {
    let script: Script = "up*2 left*9".parse().expect("a script");
    let mut keyboard = Keyboard::new(script.filmed(5), Unit::Frames, |_| None).remembering();
    let screen = || None;
    let seen: Vec<Seen> = (0..5)
        .map(|at| {
            keyboard.remember(7 * at as u64, || vec![at]);
            keyboard.look(99, screen)
        })
        .collect();
    let (up, left) = (Seen::Key(Key::Up), Seen::Key(Key::Left));
    assert_eq!(seen, [up, up, Seen::Nothing, left, Seen::Quit]);
    assert_eq!(keyboard.shots().len(), 5);
    assert_eq!(keyboard.memories().concat(), [0, 1, 2, 3, 4]);
}

/// A program that asks for three keys one after the other looks three times at one picture.
#[test]
fn looks_in_a_row_are_one() {
    let script: Script = "up left".parse().expect("a script");
    let keyboard = Keyboard::new(script.filmed(3), Unit::Calls, |_| None);
    let mut keyboard = keyboard.remembering().looked_at(3);
    let seen: Vec<Seen> = (0..7)
        .map(|at| {
            keyboard.remember(7 * at as u64, || vec![at]);
            keyboard.look(0, || None)
        })
        .collect();
    let up = Seen::Key(Key::Up);
    assert_eq!(seen[..3], [up; 3]);
    assert_eq!(seen[3..6], [Seen::Nothing; 3]);
    assert_eq!(seen[6], Seen::Quit);
    assert_eq!(keyboard.shots().len(), 3);
    assert_eq!(keyboard.memories().concat(), [0, 3, 6]);
    assert_eq!(keyboard.times(), [0, 21, 42]);
}
