use super::*;
use proptest::prelude::*;

#[test]
fn errors_have_the_rom_s_messages_and_lines() {
    for (body, message) in [
        ("PRINT 1/0", "Division by zero"),
        ("PRINT 3 MOD 0", "Division by zero"),
        ("A%=1E10", "Too big"),
        ("PRINT 1E30*1E30", "Too big"),
        ("PRINT SQR-1", "-ve root"),
        ("PRINT LN0", "Log range"),
        ("PRINT EXP100", "Exp range"),
        ("PRINT SIN1E9", "Accuracy lost"),
        ("PRINT zz", "No such variable"),
        ("PRINT A(1)", "Array"),
        ("DIM A(3):A(4)=1", "Subscript"),
        ("DIM A(3):A(-1)=1", "Subscript"),
        ("DIM A(3,3):A(1)=1", "Array"),
        ("DIM A(3):A(1,1)=1", "Missing )"),
        ("DIM A(3):DIM A(3)", "Bad DIM"),
        ("DIM A(30000)", "Bad DIM"),
        ("DIM A(6000)", "DIM space"),
        ("DIM A% 30000", "DIM space"),
        ("PRINT \"a", "Missing \""),
        ("PRINT (1", "Missing )"),
        ("PRINT LEFT$(\"a\")", "Missing ,"),
        ("PRINT &", "Bad HEX"),
        ("PRINT \"a\"+1", "Type mismatch"),
        ("A$=1", "Type mismatch"),
        ("A=\"a\"", "Type mismatch"),
        ("PRINT STRING$(200,\"ab\")", "String too long"),
        ("FOR A$=1TO2", "FOR variable"),
        ("FOR A=1", "No TO"),
        ("NEXT", "No FOR"),
        ("B=0:FOR A=1TO2:NEXT B", "Can't match FOR"),
        ("FOR A=1TO2:NEXT B", "Syntax error"),
        ("UNTIL TRUE", "No REPEAT"),
        ("RETURN", "No GOSUB"),
        ("GOTO 1234", "No such line"),
        ("GOTO A%+1", "No such line"),
        ("ON 3 GOTO 10,20", "ON range"),
        ("ON 3 PRINT", "ON syntax"),
        ("READ A", "Out of DATA"),
        ("PROCx", "No such FN/PROC"),
        ("A=FNx", "No such FN/PROC"),
        ("PROC", "Bad call"),
        ("PROCp(1,2)", "Arguments"),
        ("PROCp", "Arguments"),
        ("PROCp(\"a\")", "Arguments"),
        ("ENDPROC", "No PROC"),
        ("=1", "No FN"),
        ("LOCAL A", "Not LOCAL"),
        ("fred", "Mistake"),
        ("A=1 2", "Syntax error"),
        ("PRINT#1,2", "Channel"),
        ("CLOSE 1", "Missing #"),
        ("BPUT#17,1", "Channel"),
        ("GOSUB 20", "Too many GOSUBs"),
        ("REPEAT:GOTO 20", "Too many REPEATs"),
        ("FOR I=1TO2:GOTO 20", "Too many FORs"),
        ("STOP", "STOP"),
        ("*WOMBAT", "Bad command"),
        ("$0=\"a\"", "$ range"),
    ] {
        let text = format!("10REM\n20{body}\n30END\n40DEFPROCp(A):ENDPROC");
        assert_eq!(fails(&text), (message.to_owned(), 20), "{body}");
    }
}

#[test]
fn what_is_left_out_says_so() {
    for body in ["CALL &FFF4", "A=USR0", "[OPT 2", "CHAIN \"X\""] {
        let (message, _) = fails(&format!("10{body}"));
        assert!(message.contains("Not in this machine"), "{message}");
        assert!(message.contains("vm 6502:bbc"), "{message}");
    }
}

#[test]
fn endless_programs_stop_at_the_limit() {
    for text in [
        "10GOTO 10",
        "10REPEAT:UNTIL0",
        "10FOR I=1TO2STEP0:NEXT",
        "10ON ERROR GOTO 10\n20PRINT 1/0",
        "10PRINT FNa\n20DEFFNa\n30GOTO 30",
        "10REPEAT:A=INKEY(100):UNTIL0",
        "10RUN",
        "10A=FNr\n20DEFFNr\n30RUN",
        "10TRACE ON\n20GOTO 20",
        "10WIDTH1\n20PRINT 1,2:GOTO 20",
        "10REPEAT:INPUT A$:UNTIL A$=\"x\"",
    ] {
        let run = run(text);
        assert_eq!(run.stop, Stop::CycleLimit, "{text}");
        assert!(run.cycles < 40_000_000);
    }
}

#[test]
fn a_watcher_can_stop_a_run() {
    let mut machine = Machine::new(Config::default());
    machine.load_text("10GOTO 10").unwrap();
    let mut seen = 0;
    let run = machine.run(u64::MAX, &mut |p| {
        seen += 1;
        p.cycles < 30_000_000
    });
    assert_eq!(run.stop, Stop::Interrupted);
    assert_eq!(seen, 4);
}

#[test]
fn endless_recursion_is_no_room() {
    for text in [
        "10PRINT FNa\n20DEFFNa=FNa",
        "10PRINT FNa\n20DEFFNa=1+(2*(3+FNa))",
        "10PRINT FNa\n20DEFFNa=FNa+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1",
        "10PROCa\n20DEFPROCa:PROCa:ENDPROC",
        "10PRINT FNa(1)\n20DEFFNa(x)=FNa(x+1)",
        "10A$=\"EVALA$\":PRINT EVALA$",
        "10A$=\"FNa\":PRINT FNa\n20DEFFNa=EVALA$",
        "10PROCa\n20DEFPROCa:LOCAL A,B,C,D$:PROCa",
    ] {
        assert_eq!(fails(text).0, "No room", "{text}");
    }
}

#[test]
fn deep_brackets_are_an_error() {
    let text = format!("10PRINT {}1", "(".repeat(200));
    assert_eq!(fails(&text).0, "Expression too deep");
    let text = format!(
        "10A$=STRING$(250,\"(\"):PRINT EVALA$\n20PRINT {}1",
        "-".repeat(200)
    );
    assert_eq!(fails(&text).0, "Expression too deep");
    let text = format!("10{}PRINT", "IF1 ".repeat(60));
    assert_eq!(prints(&text), "\n");
}

#[test]
fn programs_and_variables_that_do_not_fit() {
    let long: String = (0..200)
        .map(|i| format!("{i}REM{}\n", "x".repeat(200)))
        .collect();
    assert!(fails(&long).0.starts_with("No room"));
    assert_eq!(fails("10MODE 1:DIM A(1200)"), ("DIM space".into(), 10));
    assert_eq!(fails("10DIM A(1200):MODE 1"), ("Bad MODE".into(), 10));
    assert_eq!(fails("10HIMEM=PAGE"), ("No room".into(), 10));
}

/// Bytes that look like programs: lines of tokens, names and signs.
fn program() -> impl Strategy<Value = Vec<u8>> {
    let body = prop_oneof![
        prop::collection::vec(any::<u8>().prop_map(|b| if b == 13 { 32 } else { b }), 0..40),
        prop::collection::vec(
            prop::sample::select(b"AB%$()+-*/=<>,;:?!&1\"' \xf1\xe7\x8c\x8b\xe3\xb8\xed\xa4\xf2\xdd\xe5\xe4\xee\x85\xf5\xfd\xde\xea\xf0\xeb\xef\xe6\xc2\xa0\xba\x8d\x54\x44\x40\xdc\xf3\xf7\xfc\xe8\xf9\x86\x8a\x89~[#".to_vec()),
            0..40,
        ),
    ];
    prop::collection::vec(body, 1..8).prop_map(|lines| {
        let mut out = Vec::new();
        for (i, line) in lines.iter().enumerate() {
            out.extend([0x0d, 0, i as u8 + 1, line.len() as u8 + 4]);
            out.extend(line);
        }
        out.extend([0x0d, 0xff]);
        out
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn any_tokens_end_in_some_way(bytes in program(), dialect in prop::sample::select(vec![Dialect::Micro, Dialect::Agon, Dialect::BasicV])) {
        let mut machine = Machine::new(Config { dialect, page: 0x1900 });
        machine.load_tokenised(&bytes).unwrap();
        let run = machine.run(1_000_000, &mut |_| true);
        prop_assert!(run.cycles < 3_000_000_000);
    }

    #[test]
    fn any_bytes_are_refused_or_run(bytes in prop::collection::vec(any::<u8>(), 0..100)) {
        let mut machine = Machine::new(Config::default());
        if machine.load_tokenised(&bytes).is_ok() {
            machine.run(1_000_000, &mut |_| true);
        }
    }
}
