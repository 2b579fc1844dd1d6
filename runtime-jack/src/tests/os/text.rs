//! `Output` and `Keyboard`: what the native system prints to a text is read off the
//! screen.

use super::{completed, error, on_cpu, program, with_native, with_ours};
use slowlight_vm::Screen;
use slowlight_vm::hack::cpu::Cpu;
use slowlight_vm::hack::translate::{Options, translate};
use slowlight_vm::hack::vm::Program;
use std::collections::HashMap;

/// The pixels of a character's place.
fn cell(screen: &Screen, row: usize, column: usize) -> Vec<u8> {
    let pixel = |k: usize| {
        let (x, y) = (8 * column + k % 8, 11 * row + k / 8);
        screen.pixels[y * screen.width as usize + x]
    };
    (0..88).map(pixel).collect()
}

/// The characters by their pixels, as the system itself draws them.
fn font() -> HashMap<Vec<u8>, char> {
    let body = "var int k; let k = 32;
        while (k < 127) { do Output.printChar(k); let k = k + 1; } do Output.printChar(1);";
    let screen = with_ours(&program(body, "")).screen;
    let codes = (32u8..127).map(char::from).chain(['\u{25a0}']);
    let font: HashMap<_, _> = codes
        .enumerate()
        .map(|(k, c)| (cell(&screen, k / 64, k % 64), c))
        .collect();
    assert_eq!(font.len(), 96, "all look different");
    font
}

/// The rows of text on a screen, without blanks at their ends.
fn read(screen: &Screen) -> Vec<String> {
    let font = font();
    let row = |r| -> String {
        let cells = (0..64).map(|c| font.get(&cell(screen, r, c)).copied().unwrap_or('?'));
        cells.collect::<String>().trim_end().to_owned()
    };
    let mut rows: Vec<String> = (0..23).map(row).collect();
    while rows.last().is_some_and(String::is_empty) {
        rows.pop();
    }
    rows
}

#[test]
fn text_is_what_the_native_system_prints() {
    let body = "do Output.printString(\"Slow (light), {at} 3.5 @ [x]!\"); do Output.println();
        do Output.printInt(0); do Output.printChar(32); do Output.printInt(-1);
        do Output.printChar(32); do Output.printInt(1005); do Output.printChar(32);
        do Output.printInt(32767); do Output.printChar(32); do Output.printInt((-32767) - 1);
        do Output.printChar(128); do Output.printChar(128);
        do Output.printString(\"abcd\"); do Output.backSpace(); do Output.printChar(129);
        do Output.printChar(88); do Output.printChar(7); do Output.printChar(-5);
        do Output.println(); do Output.backSpace(); do Output.printString(\"\"); do Output.printInt(10);";
    let files = program(body, "");
    let (_, text) = with_native(&files);
    let expected: Vec<&str> = text.lines().collect();
    assert_eq!(read(&with_ours(&files).screen), expected);
    assert_eq!(read(&on_cpu(&files, Options::default()).screen), expected);
}

#[test]
fn rows_and_columns() {
    let body = "var int k;
        do Output.moveCursor(22, 63); do Output.printChar(90);
        do Output.printChar(65);
        do Output.moveCursor(4, 10); do Output.printInt(12);
        do Output.moveCursor(4, 11); do Output.moveCursor(7, 1); do Output.printChar(66);
        do Output.moveCursor(9, 0);
        while (k < 70) { do Output.printChar(48 + (k & 7)); let k = k + 1; }";
    let rows = read(&with_ours(&program(body, "")).screen);
    assert_eq!(rows[0], "A", "the last row is followed by the first");
    assert_eq!(rows[4], format!("{}1", " ".repeat(10)));
    assert_eq!(rows[7], " B");
    assert_eq!(rows[9], "01234567".repeat(8));
    assert_eq!(rows[10], "012345");
    assert_eq!(rows[22], format!("{}Z", " ".repeat(63)));
    for outside in ["-1, 0", "23, 0", "0, -1", "0, 64", "32767, 0"] {
        assert_eq!(
            error(&format!("do Output.moveCursor({outside});")),
            Some(20)
        );
    }
}

#[test]
fn keys_are_read_and_shown() {
    let body = "var String s;
        do Main.note(Keyboard.keyPressed());
        do Main.note(Keyboard.readChar());
        let s = Keyboard.readLine(\"name? \");
        do Main.note(s.length()); do Main.note(s.charAt(1));
        do Main.note(Keyboard.readInt(\"age? \"));";
    let files = program(body, "");
    let program = Program::link(&completed(&files)).unwrap();
    let words = translate(&program, Options::default()).unwrap().words;
    let mut cpu = Cpu::new(&words).unwrap();
    let mut limit = 1_000_000;
    let run = cpu.run(limit, &mut |_| true);
    assert_eq!(run.stop, slowlight_vm::Stop::CycleLimit, "it waits");
    let keys = [
        b'q', b'A', b'x', 129, 129, 129, b'B', b'c', 128, b'4', b'2', 128,
    ];
    let mut last = run;
    for key in keys {
        for held in [u16::from(key), 0] {
            cpu.press(held);
            limit += 100_000;
            last = cpu.run(limit, &mut |_| true);
        }
    }
    assert_eq!(last.stop, slowlight_vm::Stop::Ended);
    let noted: Vec<i16> = (super::OUT..super::OUT + 5)
        .map(|at| cpu.peek(at))
        .collect();
    assert_eq!(noted, [0, i16::from(b'q'), 2, i16::from(b'c'), 42]);
    assert_eq!(read(&last.screen), ["qname? Bc", "age? 42"]);
}

/// An error is shown also where the program prints nothing.
#[test]
fn an_error_is_shown() {
    let shown = |number: i32| with_ours(&program(&format!("do Sys.error({number});"), "")).screen;
    // A character is 3 columns and 5 rows, each of its pixels 5 wide and 5 high.
    let character = |screen: &Screen, at: usize| -> String {
        let pixel = |x: usize, y: usize| screen.pixels[(5 * y + 2) * 512 + 16 * at + 5 * x + 2];
        let row = |y| (0..3).map(move |x| if pixel(x, y) == 0 { '#' } else { '.' });
        (0..5).flat_map(row).collect()
    };
    let (three, ten) = (shown(3), shown(-10));
    assert_eq!(character(&three, 0), "####..####..###");
    assert_eq!(character(&three, 1), character(&three, 2));
    assert_eq!(character(&three, 3), "###..####..####");
    assert_eq!(character(&ten, 3), "......###......");
    assert_eq!(character(&ten, 4), ".#.##..#..#.###");
    assert_eq!(character(&ten, 5), "####.##.##.####");
    let black = |screen: &Screen| screen.pixels.iter().filter(|p| **p == 0).count();
    assert!(black(&three) < black(&ten));
}
