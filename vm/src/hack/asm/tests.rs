//! Every instruction, and everything that can be wrong.
#![allow(clippy::unwrap_used)]

use super::instruction::{COMPS, COMPUTE, written};
use super::{ROM_WORDS, assemble, disassemble, read_image, write_image};
use proptest::prelude::*;

/// The one fault of a source: its line and message.
fn said(source: &str) -> (u32, String) {
    let faults = assemble(source).unwrap_err();
    assert_eq!(faults.len(), 1, "{faults:?}");
    (faults[0].line.unwrap(), faults[0].message.clone())
}

fn word(line: &str) -> u16 {
    assemble(line).unwrap().words[0]
}

#[test]
fn every_instruction_there_and_back() {
    let mut count = 0;
    for (name, bits) in COMPS {
        for low in 1..64 {
            let instruction = COMPUTE | bits << 6 | low;
            let text = written(instruction).unwrap();
            assert!(text.contains(name), "{text}");
            assert_eq!(word(&text), instruction, "{text}");
            count += 1;
        }
        // Neither a destination nor a jump: nothing that one would write.
        let (line, message) = said(&written(COMPUTE | bits << 6).unwrap());
        assert_eq!(line, 1);
        assert_eq!(
            message,
            format!("`{name}` goes nowhere: no `=` and no jump")
        );
    }
    assert_eq!(count, 28 * 63);
    for value in 0..=0x7fff {
        assert_eq!(word(&written(value).unwrap()), value);
    }
}

/// From the book's table, not from ours.
#[test]
fn words_of_the_book() {
    for (text, word_of_the_book) in [
        ("@2", 0b0000000000000010),
        ("D=A", 0b1110110000010000),
        ("D=D+A", 0b1110000010010000),
        ("M=D", 0b1110001100001000),
        ("D;JGT", 0b1110001100000001),
        ("0;JMP", 0b1110101010000111),
        ("MD=D-1", 0b1110001110011000),
        ("AM=M-1", 0b1111110010101000),
        ("AMD=D|M;JLE", 0b1111010101111110),
    ] {
        assert_eq!(word(text), word_of_the_book, "{text}");
    }
}

#[test]
fn spellings() {
    for (one, other) in [
        ("MD=M+D", "DM=D+M"),
        ("ADM=A&D", "AMD=D&A"),
        ("DAM=M|D", "AMD=D|M"),
        ("D=A+D", "D=D+A"),
        ("D = M - 1 ; JEQ // dec", "D=M-1;JEQ"),
        ("  @ 17\t", "@17"),
    ] {
        assert_eq!(word(one), word(other), "{one}");
    }
}

#[test]
fn symbols_labels_and_variables() {
    let source = "// sum\n@i\nM=1 // i\n(LOOP)\n@i\n@sum\n@R13\n@SCREEN\n@KBD\n@THAT\n@ahead\n\
        @LOOP\n\n(ahead)\n(Also.this$1:x_)\n@Also.this$1:x_\n0;JMP";
    let assembly = assemble(source).unwrap();
    let expected = [
        16,
        word("M=1"),
        16,
        17,
        13,
        16384,
        24576,
        4,
        10,
        2,
        10,
        word("0;JMP"),
    ];
    assert_eq!(assembly.words, expected);
    assert_eq!(assembly.lines, [2, 3, 5, 6, 7, 8, 9, 10, 11, 12, 16, 17]);
}

#[test]
fn every_wrong_line_is_named() {
    for (line, message) in [
        ("D=D*A", "unknown computation `D*A`"),
        ("D=", "unknown computation ``"),
        ("mov d, a", "unknown computation `movd,a`"),
        ("DD=A", "unknown destination `DD`: A, D and M, each once"),
        ("=A", "unknown destination ``: A, D and M, each once"),
        ("X=A", "unknown destination `X`: A, D and M, each once"),
        ("D;JXX", "unknown jump `JXX`"),
        ("D;", "`D;` goes nowhere: no `=` and no jump"),
        ("@32768", "@32768 is above 32767, the largest constant"),
        (
            "@99999999999999999999",
            "@99999999999999999999 is above 32767, the largest constant",
        ),
        (
            "@",
            "`` is no name: letters, digits, `_`, `.`, `$` and `:`, and not only digits",
        ),
        (
            "@-1",
            "`-1` is no name: letters, digits, `_`, `.`, `$` and `:`, and not only digits",
        ),
        (
            "(123)",
            "`123` is no name: letters, digits, `_`, `.`, `$` and `:`, and not only digits",
        ),
        ("(L", "a label ends in `)`: `(L`"),
        ("(A)", "a second label A: the first is in line 1"),
        ("(SP)", "SP cannot be a label: it is predefined"),
    ] {
        let expected = (3, message.to_owned());
        assert_eq!(said(&format!("(A)\n@A\n{line}\n0;JMP")), expected);
    }
}

#[test]
fn names_may_begin_with_a_digit() {
    let words = |text: &str| assemble(text).unwrap().words;
    assert_eq!(
        words("@6fe\nD=A;\n(6fe)\n@6fe\n0;JMP"),
        words("@2\nD=A\n@2\n0;JMP")
    );
    assert_eq!(words("@0x10\n@10.\n@0x10"), [16, 17, 16]);
    assert_eq!(words("(1st)\n@1st\nMD=M+1;"), words("@0\nDM=M+1"));
}

#[test]
fn what_does_not_fit() {
    let most = "@0\n".repeat(ROM_WORDS);
    assert_eq!(assemble(&most).unwrap().words.len(), ROM_WORDS);
    let message = "the program has 32771 instructions, 3 more than the ROM's 32768 words";
    let expected = (32769, message.to_owned());
    assert_eq!(said(&format!("{most}@1\n@2\n(L)\n@L")), expected);
    let image = write_image(&vec![0; ROM_WORDS + 3]);
    let faults = read_image(&image).unwrap_err();
    assert_eq!(faults[0].message, message);
    assert_eq!(faults[0].line, Some(32769));

    let many: String = (0..16_369).map(|k| format!("@v{k}\n")).collect();
    let (line, message) = said(&many);
    assert_eq!(line, 16_369);
    assert!(message.starts_with("no memory is left for the variable v16368"));
}

#[test]
fn images() {
    let words = [0, 1, 0x7fff, 0x8000, 0xffff, word("0;JMP")];
    let text = write_image(&words);
    assert!(text.starts_with("0000000000000000\n0000000000000001\n0111111111111111\n"));
    assert_eq!(read_image(&text).unwrap(), words);
    assert_eq!(read_image(&text.replace('\n', " \r\n\n")).unwrap(), words);
    for wrong in [
        "0",
        "00000000000000000",
        "000000000000000x",
        "+000000000000001",
    ] {
        let faults = read_image(&format!("\n{wrong}\n")).unwrap_err();
        assert_eq!(faults[0].to_string(), "2: not sixteen binary digits");
    }
}

proptest! {
    #[test]
    fn any_text_is_assembled_or_refused(text in "([@()A-Za-z0-9=;+!&|\\-_. /]{0,12}\n){0,20}") {
        if let Ok(assembly) = assemble(&text) {
            prop_assert_eq!(assembly.words.len(), assembly.lines.len());
            // What was assembled is assembled again from its disassembly.
            let again = assemble(&disassemble(&assembly.words)).unwrap();
            prop_assert_eq!(again.words, assembly.words);
        }
        let _ = read_image(&text);
    }
}
