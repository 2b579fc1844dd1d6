use super::*;
use proptest::prelude::*;

fn bytes(text: &str) -> Vec<u8> {
    tokenise(text, Dialect::Micro).unwrap()
}

#[test]
fn a_line_is_stored_as_the_machine_stores_it() {
    assert_eq!(
        bytes("10PRINT\"HI\":GOTO 10\r\n"),
        [
            0x0d, 0, 10, 17, 0xf1, b'"', b'H', b'I', b'"', b':', 0xe5, b' ', 0x8d, 0x54, 0x4a,
            0x40, 0, 0x0d, 0xff
        ]
        .iter()
        .copied()
        .enumerate()
        .filter(|(i, _)| *i != 16)
        .map(|(_, b)| if b == 17 { 16 } else { b })
        .collect::<Vec<u8>>()
    );
}

#[test]
fn pseudo_variables_keywords_in_names_and_abbreviations() {
    assert_eq!(bytes("1TIME=TIME")[4..7], [0xd1, b'=', 0x91]);
    assert_eq!(bytes("1P.A")[4..6], [0xf1, b'A']);
    // END is no keyword where letters follow; TO is one in TOTAL.
    assert_eq!(&bytes("1ENDING=1")[4..10], b"ENDING");
    assert_eq!(bytes("1TOTAL=1")[4..8], [0xb8, b'T', b'A', b'L']);
    assert_eq!(&bytes("1total=1")[4..9], b"total");
    assert_eq!(
        &bytes("1X=&80DIV3")[4..12],
        &[b'X', b'=', b'&', b'8', b'0', b'D', b'I', b'V'][..]
    );
    assert_eq!(&bytes("1REM PRINT")[4..], b"\xf4 PRINT\x0d\xff");
    assert_eq!(&bytes("1PROCPRINT")[4..], b"\xf2PRINT\x0d\xff");
}

#[test]
fn a_number_at_the_start_of_a_line_is_a_line_number() {
    assert_eq!(&bytes("10CLS 3")[4..], b"\xdb \x8d\x54\x43\x40\x0d\xff");
    assert_eq!(&bytes("10 7=A")[4..], b" \x8d\x54\x47\x40=A\x0d\xff");
    assert_eq!(&bytes("10CLS:7")[4..], b"\xdb:7\x0d\xff");
    assert_eq!(&bytes("10A 7")[4..], b"A 7\x0d\xff");
}

#[test]
fn text_survives_there_and_back() {
    let text = "10IF A%>B% THEN 100 ELSE GOSUB 200,300\n20DATA GOTO 10,\"PRINT\"\n30*FX 200\n100x=SIN-.5:REM PRINT\n200HIMEM=&3000\n";
    assert_eq!(detokenise(&bytes(text)).unwrap(), text);
}

#[test]
fn lines_without_numbers_are_numbered_in_tens() {
    assert_eq!(
        detokenise(&bytes("CLS\n\nEND\n")).unwrap(),
        "10CLS\n20END\n"
    );
    assert_eq!(
        detokenise(&bytes("20END\n10CLS\n20STOP")).unwrap(),
        "10CLS\n20STOP\n"
    );
}

#[test]
fn lines_without_numbers_go_on_from_the_one_before() {
    assert_eq!(
        detokenise(&bytes("CLS\n5END\nCLG\n1000STOP\n\n  RUN\n7 REM\n")).unwrap(),
        "5END\n7 REM\n10CLS\n15CLG\n1000STOP\n1010RUN\n"
    );
}

#[test]
fn wrong_text_is_refused_with_its_line() {
    let long = format!("10CLS\n20PRINT \"{}\"", "x".repeat(250));
    for (text, line, says) in [
        ("10CLS\n\n20END\n10PRINT\nCLG", 5, "lines 3 and 5"),
        ("CLS\n10END", 2, "lines 1 and 2"),
        ("32760CLS\nEND", 2, "32767"),
        ("32768END", 1, "32767"),
        ("10PRINT \"\u{2603}\"", 1, "Latin-1"),
        (long.as_str(), 2, "split it"),
    ] {
        let fault = tokenise(text, Dialect::Micro).unwrap_err();
        assert_eq!(fault.line, Some(line), "{text}");
        assert!(fault.message.contains(says), "{}", fault.message);
    }
}

#[test]
fn bytes_that_are_no_program_are_refused() {
    for bytes in [
        &[][..],
        &[0],
        &[0x0d],
        &[0x0d, 0],
        &[0x0d, 0, 10, 3],
        &[0x0d, 0, 10, 9, b'A'],
        &[0x0d, 0, 10, 5, b'A'],
    ] {
        assert_eq!(detokenise(bytes).unwrap_err().message, "Bad program");
        assert!(
            Machine::new(Config::default())
                .load_tokenised(bytes)
                .is_err()
        );
    }
}

proptest! {
    #[test]
    fn any_text_is_tokenised_or_refused(text in "[ -~\r\n]{0,200}") {
        if let Ok(bytes) = tokenise(&text, Dialect::Micro) {
            prop_assert!(detokenise(&bytes).is_ok());
        }
    }

    #[test]
    fn any_line_reads_back_the_same(body in "[ -~]{0,60}") {
        // Detokenised text tokenises to the same bytes, if no keyword was abbreviated.
        prop_assume!(!body.contains('.'));
        prop_assume!(!body.trim_start().starts_with(|c: char| c.is_ascii_digit()));
        let once = bytes(&format!("10 {body}"));
        let text = detokenise(&once).unwrap();
        prop_assume!(text.lines().next().unwrap().len() < 240);
        prop_assert_eq!(tokenise(&text, Dialect::Micro), Ok(once));
    }
}
