use super::*;

/// Each line: a program's body and what it prints (the machine's own field of ten apart).
fn check(cases: &[(&str, &str)]) {
    for (body, wanted) in cases {
        let text = format!("10{body}");
        assert_eq!(prints(&text).trim_end_matches('\n'), *wanted, "{body}");
    }
}

#[test]
fn numbers_as_on_the_rom() {
    check(
        &[
            (
                "PRINT 7 DIV 2;-7 DIV 2;-7 MOD 3;7.9 DIV 2.9",
                "         3-3-13",
            ),
            (
                "PRINT;INT-2.5;\" \";SGN-3;\" \";ABS-2.5;\" \";NOT 0",
                "-3 -1 2.5 -1",
            ),
            (
                "PRINT;2^3^2;\" \";-2^2;\" \";(1=1)=-1;\" \";INT(5.5)+2 AND 1",
                "64 4 -1 1",
            ),
            (
                "PRINT;.1+.2=.3;\" \";100000*3;\" \";65536*65536",
                "-1 300000 4.2949673E9",
            ),
            (
                "PRINT;2147483647+1;\" \";&FFFFFFFF;\" \";~255;\" \";~-1",
                "-2.14748365E9 -1 FF FFFFFFFF",
            ),
            (
                "PRINT;PI;\" \";SQR2;\" \";1/3;\" \";1E-5",
                "3.14159265 1.41421356 0.333333333 1E-5",
            ),
            ("PRINT;VAL\"12abc\";VAL\"-3.5E2\";VAL\"x\"", "12-3500"),
            ("A%=7.9:B%=-7.9:PRINT;A%;B%", "7-7"),
            ("PRINT;3>2;2>3;2<=2;2<>2;2>=3", "-10-100"),
            ("PRINT;6 AND 3;6 OR 3;6 EOR 3", "275"),
            (
                "PRINT 1,-5'TAB(3)1;SPC2;2",
                "         1        -5\n            1  2",
            ),
            ("@%=&2020A:PRINT 1.5;STR$1.5", "      1.501.5"),
            ("PRINT;X=0:X=X+1:PRINT;X", "No such variable"),
        ][..12],
    );
    check(&[("X=X+1:PRINT;X", "1")]);
}

#[test]
fn random_numbers_follow_the_rom_s_register() {
    // The same sequence as measured on the ROM.
    check(&[("A=RND(-5):PRINT;RND(1)", "0.989364654")]);
    assert_eq!(
        prints("10X%=RND(-77):FORI=1TO3:PRINT;RND(100);\" \";:NEXT")
            .split(' ')
            .count(),
        4
    );
}

#[test]
fn strings() {
    check(&[
        (
            "A$=\"hello\":PRINT LEFT$(A$,2)RIGHT$(A$,2)MID$(A$,2,3)MID$(A$,4)",
            "heloelllo",
        ),
        (
            "PRINT;LEN\"abc\";ASC\"A\";ASC\"\";INSTR(\"hello\",\"l\");INSTR(\"hello\",\"l\",4)",
            "365-134",
        ),
        (
            "PRINT CHR$65+CHR$321;STRING$(3,\"ab\");STR$12;STR$~255",
            "AAababab12FF",
        ),
        ("PRINT;\"a\"<\"b\";\"ab\">\"abc\"", "-10"),
        ("PRINT \"say \"\"hi\"\"\"", "say \"hi\""),
        ("A$=\"1+2*3\":PRINT;EVALA$;EVAL\"LEN\"\"abc\"\"\"", "73"),
        ("DIM B 20:$B=\"text\":PRINT $B;B?4", "text13"),
    ]);
}

#[test]
fn memory() {
    check(&[
        (
            "DIM P% 9:!P%=&12345678:PRINT;~?P%;~P%?3;~P%!0",
            "781212345678",
        ),
        ("DIM P% 9:P%?2=300:PRINT;P%?2", "44"),
        ("A%=&102:PRINT;?&404;?&405:?&404=5:PRINT;A%", "21\n261"),
        (
            "PRINT;PAGE;\" \";HIMEM;\" \";TOP-PAGE;\" \";LOMEM-TOP",
            "6400 31744 33 0",
        ),
        ("MODE1:PRINT;HIMEM", "12288"),
        ("DIM A%(2,3):A%(1,2)=5:PRINT;A%(1,2);A%(2,1)", "50"),
        (
            "DIM A$(2),B(3):A$(1)=\"x\":B(3)=.5:PRINT A$(1)A$(0);B(3)",
            "x0.5",
        ),
    ]);
}

#[test]
fn flow() {
    check(&[
        ("IF 1 THEN PRINT \"a\" ELSE PRINT \"b\"", "a"),
        ("IF 0 THEN PRINT \"a\" ELSE PRINT \"b\"", "b"),
        // A false IF goes to the first ELSE on the line, whosever it is.
        ("IF 0 THEN IF 1 THEN PRINT \"a\" ELSE PRINT \"b\"", "b"),
        ("FOR I%=1TO3:PRINT;I%;:NEXT:PRINT;I%", "1234"),
        (
            "FOR I=3TO1STEP-1:PRINT;I;:NEXT:FORI=5TO1:PRINT;I:NEXT",
            "3215",
        ),
        ("FOR I=1TO2:FOR J=1TO2:PRINT;I;J;:NEXT J,I", "11122122"),
        ("FOR I=0 TO 1 STEP 0.1:PRINT;\"x\";:NEXT", "xxxxxxxxxx"),
        ("REPEAT:X=X+1:UNTIL X>4:PRINT;X", "5"),
    ]);
    let text = "10A%=1\n20ON A% GOTO 100,200 ELSE 300\n100PRINT\"one\":A%=2:GOTO 20\n200PRINT\"two\":A%=3:GOTO 20\n300PRINT\"other\":GOSUB 400:END\n400PRINT\"sub\":RETURN";
    assert_eq!(prints(text), "one\ntwo\nother\nsub\n");
    let text = "10ON 2 GOSUB 100,200:PRINT\"back\"\n20END\n100PRINT\"no\"\n200PRINT\"yes\":RETURN";
    assert_eq!(prints(text), "yes\nback\n");
    assert_eq!(
        prints("10IF 1 THEN 30\n20PRINT\"no\"\n30PRINT\"yes\""),
        "yes\n"
    );
}

#[test]
fn procedures_and_functions() {
    let text = "10PRINT;FNfact(10);\" \";FNadd(1,2.5);\" \";FNjoin(\"a\",\"b\"):x=1:PROCp(5):PRINT;x;y\n20END\n30DEFFNfact(n):IF n<2 THEN =1 ELSE =n*FNfact(n-1)\n40DEF FNadd(a%,b)\n50=a%+b\n60DEFFNjoin(a$,b$)=a$+b$\n70DEFPROCp(x):LOCAL y:y=9:x=x+1:PROCq:ENDPROC\n80DEFPROCq:PRINT;x;y:y=7:ENDPROC";
    assert_eq!(prints(text), "3628800 3.5 ab\n69\n10\n");
}

#[test]
fn data_is_read_in_order_and_restored() {
    let text = "10READ A%,A$,B,C$\n20PRINT;A%;A$;B;C$\n30RESTORE 60:READ A$:PRINT A$\n40RESTORE:READ A%:PRINT;A%\n50DATA 5, word ,-2.5,\"a, b\"\n60DATA last";
    assert_eq!(prints(text), "5word -2.5a, b\nlast\n5\n");
}

#[test]
fn some_lines_of_a_text_are_numbered() {
    let text = "PRINT \"first\"\nRESTORE 1010\nREAD A$:PRINT A$\nEND\n1000DATA no\n1010DATA yes\n";
    assert_eq!(prints(text), "first\nyes\n");
    let text = "GOTO 210\n200PRINT \"no\"\nPRINT \"on\":GOTO 220\nPRINT \"end\"";
    assert_eq!(prints(text), "on\nend\n");
}

#[test]
fn lines_are_typed_for_input_and_then_empty_ones() {
    let mut machine = Machine::new(Config::default());
    let text = "10INPUT \"name \"A$,B%\n20INPUT C$:PRINT A$\"|\"B%\"|\"C$\"|\"";
    machine.load_text(text).unwrap();
    machine.type_lines(["Ada, 36"]);
    let run = machine.run(20_000_000, &mut |_| true);
    assert_eq!(run.text, "name Ada, 36\n?\nAda|        36||\n");
}

#[test]
fn errors_can_be_caught() {
    let text = "10ON ERROR PRINT;ERR;\" \";ERL:REPORT:END\n20FOR I=1TO2\n30PRINT 1/0";
    assert_eq!(
        prints(text),
        "        18 30\n\nDivision by zero".replacen("        ", "", 1)
    );
    assert_eq!(
        fails("10ON ERROR PRINT\n20ON ERROR OFF\n30PRINT 1/0"),
        ("Division by zero".into(), 30)
    );
}

#[test]
fn files_are_written_and_read() {
    let text = "10F%=OPENOUT(\"pic\")\n20FORI%=0TO9:BPUT#F%,I%*I%:NEXT:PRINT;EXT#F%:CLOSE#F%\n30F%=OPENIN\"pic\":PTR#F%=3:PRINT;BGET#F%;\" \";BGET#F%;EOF#F%:CLOSE#0\n40F%=OPENOUT\"d\":PRINT#F%,1,2.5,\"abc\":CLOSE#F%:F%=OPENIN\"d\":INPUT#F%,A,B,C$:PRINT;A;B;C$;OPENIN\"no\"";
    let run = run(text);
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(run.text, "10\n9 160\n12.5abc0\n");
    assert_eq!(run.files["pic"], [0, 1, 4, 9, 16, 25, 36, 49, 64, 81]);
}

#[test]
fn points_and_pokes_draw_the_same() {
    let drawn = run("10MODE 1:GCOL 0,2:PLOT 69,4*5,4*(255-9)");
    let poked = run("10MODE 1:?(HIMEM+9DIV8*640+5DIV4*8+9MOD8)=&40");
    assert_eq!(drawn.stop, Stop::Ended);
    assert_eq!((drawn.screen.width, drawn.screen.height), (320, 256));
    assert!(drawn.screen == poked.screen, "{:?}", poked.stop);
    assert_eq!(ink(&drawn, 5, 9), 2);
    assert_eq!(drawn.screen.pixels.iter().filter(|p| **p != 0).count(), 1);
    assert_eq!(
        drawn.screen.palette,
        [[0, 0, 0], [255, 0, 0], [255, 255, 0], [255; 3]]
    );
    assert_eq!(
        prints("10MODE 1:GCOL 0,2:PLOT 69,20,984:PRINT;POINT(20,984);POINT(0,0)"),
        "20\n"
    );
}

#[test]
fn every_graphics_mode_holds_every_ink() {
    for (mode, width, inks) in [
        (0, 640, 2),
        (1, 320, 4),
        (2, 160, 16),
        (4, 320, 2),
        (5, 160, 4),
    ] {
        let step = 1280 / width;
        let run = run(&format!(
            "10MODE {mode}:FOR I%=0TO{}:GCOL0,I%:PLOT69,I%*{step},0:PLOT 69,1279-I%*{step},1023:NEXT",
            inks - 1
        ));
        for i in 0..inks {
            assert_eq!(u32::from(ink(&run, i, 255)), i, "mode {mode}");
            assert_eq!(u32::from(ink(&run, width - 1 - i, 0)), i);
        }
    }
}

#[test]
fn lines_fills_triangles_windows_and_palette() {
    let r = run("10MODE 4:MOVE 0,0:DRAW 1276,0:MOVE 0,1020:MOVE 0,512:PLOT 85,512,512");
    assert!((0..320).all(|x| ink(&r, x, 255) == 1));
    let filled = r.screen.pixels.iter().filter(|p| **p != 0).count() as i32 - 320;
    assert!((filled - 128 * 128 / 2).abs() < 200, "{filled}");
    let r = run(
        "10MODE 1:VDU 19,1,4;0;:VDU 24,0;0;100;100;:GCOL 0,129:CLG:GCOL 3,3:PLOT 69,0,0:PLOT 69,200,200",
    );
    assert_eq!(r.screen.palette[1], [0, 0, 255]);
    assert_eq!(
        r.screen.pixels.iter().filter(|p| **p == 1).count(),
        26 * 26 - 1
    );
    assert_eq!(ink(&r, 0, 255), 2);
    let r = run("10MODE 1:VDU 29,640;512;:PLOT 69,0,0:VDU 25,69,4;4;");
    assert_eq!((ink(&r, 160, 127), ink(&r, 161, 126)), (3, 3));
}

#[test]
fn agon_and_basic_v_have_their_screens_and_integers() {
    let r = run_on(
        Dialect::Agon,
        "10MODE 10:GCOL 0,3:PLOT 69,0,0:PLOT 69,1279,1023:PRINT;2147483647+1;1 DIV 0",
    );
    assert_eq!(
        (r.screen.width, r.screen.height, r.screen.palette.len()),
        (320, 240, 4)
    );
    assert_eq!((ink(&r, 0, 239), ink(&r, 319, 0)), (3, 3));
    assert_eq!(r.text, "2.14748365E9-1\n");
    let r = run_on(Dialect::BasicV, "10MODE 9:GCOL 0,15:PLOT 69,4,4");
    assert_eq!(ink(&r, 1, 254), 15);
    // The numbers of errors are those of `tests/all/peers_dialect.rs`.
    let text = "10ON ERROR PRINT;ERR:N%=N%+1:GOTO 30\n20N%=0:PRINT;-2147483647-2\n\
                30IF N%=0 THEN A%=2147483647+1\n40IF N%=1 THEN A=1 DIV 0";
    let r = run_on(Dialect::BasicV, text);
    assert_eq!(r.text, "-2.14748365E9\n20\n18\n");
}

#[test]
fn repeat_needs_no_colon() {
    let counting = "10N%=0:REPEATN%=N%+1:UNTILN%=3:PRINT;N%";
    assert_eq!(run(counting).text, "3\n");
    let nested = "10N%=0:REPEATREPEATN%=N%+1:UNTILN%MOD3=0:UNTILN%=9:PRINT;N%";
    assert_eq!(run(nested).text, "9\n");
    assert_eq!(run("10REPEATUNTILTRUE:PRINT\"x\"").text, "x\n");
}

/// Statements on lines of their own, counted on the ROM with interrupts off.
const COUNTED: &[(&str, u64)] = &[
    ("X=A", 1305),
    ("C%=A%", 870),
    ("x%=y%", 1266),
    ("X=A%", 1457),
    ("C%=A", 1844),
    ("X=.3", 2552),
    ("X=1.2345", 5185),
    ("X=1E3", 2352),
    ("C%=12345", 1658),
    ("C%=&3039", 1330),
    ("C%=(A%)", 1101),
    ("C%=A%+B%", 1311),
    ("C%=A%*B%", 1740),
    ("C%=A%DIVB%", 2671),
    ("C%=A%MODB%", 2647),
    ("C%=A%ANDB%", 1412),
    ("X=A+B", 2353),
    ("X=A-B", 2390),
    ("X=A*B", 4847),
    ("X=A/B", 5009),
    ("X=2*A", 4480),
    ("X=A^3", 11299),
    ("X=SQRA", 19158),
    ("X=SINA", 57329),
    ("X=COSA", 36422),
    ("X=LNA", 30786),
    ("X=INTA", 2640),
    ("C%=A<B", 1977),
    ("X=V(K%)", 1900),
    ("V%(K%)=A%", 1729),
    ("X=M(2,3)", 2921),
    ("C%=P%?K%", 1192),
    ("?P%=3", 1011),
    ("T$=LEFT$(W$,20)", 3787),
    ("C%=INSTR(W$,\"XYZ\")", 3632),
    ("X=FNa(A)", 5057),
    ("PROCq(A)", 3150),
    ("IFA%<B% THENX=1:X=1:X=1:X=1:X=1", 1393),
    ("IFA<B X=1", 3125),
    ("REPEATUNTILA%>B%", 1235),
    ("FORI%=1TO3:NEXT", 2614),
    ("FORI=1TO3:NEXT", 5570),
    ("PRINT A", 15790),
];

#[test]
fn cycles_are_near_the_rom_s() {
    let setup = "10A=1.2345678:B=7.654321:A%=12:B%=7:x%=5:y%=9:X=1:C%=1:K%=3\n\
        11DIM V(20),V%(20),M(4,4),P% 100:I=1:T$=\"ABC\":W$=\"ABCDEFGHIJKLMNOPQRSTUVWXYZ\"\n\
        12Z=FNa(1):PROCq(1)\n20?&70=1\n";
    let tail = "40?&70=1\n90END\n100DEFFNa(Q)=Q\n110DEFPROCq(Q)ENDPROC";
    let cost = |body: &str| {
        let run = run(&format!("{setup}{body}{tail}"));
        assert_eq!(run.stop, Stop::Ended, "{body}");
        run.cycles
    };
    // A line that costs nothing in itself, so that searches pass as many lines.
    let base = cost("30\n");
    for (body, counted) in COUNTED {
        let one = (cost(&format!("30{body}\n")) - base) as f64 / 1.041;
        let off = one / *counted as f64 - 1.0;
        assert!(off.abs() < 0.05, "{body}: {one} against {counted}");
    }
}

#[test]
fn memory_is_accounted() {
    let r = run("10A=1:DIM B(9):C$=\"hello\"");
    // A: 2+1+5; B(: 2+1+1+2, block 1+2+50; C$: 2+1+1+4, five letters.
    assert_eq!(r.ram_bytes, 8 + 6 + 53 + 8 + 5);
    assert_eq!(
        r.program_bytes,
        tokenise("10A=1:DIM B(9):C$=\"hello\"", Dialect::Micro)
            .unwrap()
            .len()
    );
}

#[test]
fn a_profile_charges_each_line_with_what_it_does_itself() {
    let text =
        "10FOR I%=1 TO 3:A=FNroot(I%):NEXT\n20A=FNroot(2):B=1\n30END\n40DEF FNroot(x)\n50=SQR(x)\n";
    let mut machine = Machine::new(Config::default());
    machine.load_text(text).unwrap();
    let plain = machine.run(20_000_000, &mut |_| true);
    let (run, lines) = machine.profile(20_000_000, &mut |_| true);
    assert_eq!(run, plain);
    assert_eq!(lines.iter().map(|l| l.cycles).sum::<u64>(), run.cycles);
    let times: Vec<(u16, u64)> = lines.iter().map(|l| (l.line, l.times)).collect();
    assert_eq!(times, [(10, 1), (20, 1), (30, 1), (40, 0), (50, 4)]);
    // Four square roots of 18,000 cycles are the function's.
    assert!(lines[4].cycles > 72_000);
    assert!(lines[0].cycles < 30_000 && lines[1].cycles < 15_000);
}
