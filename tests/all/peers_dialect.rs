//! Our BASIC V against Matrix Brandy, statement by statement: what they answer and which errors
//! they raise. Where the two are known to differ (Brandy's reals are doubles, its strings long),
//! both answers are pinned.

use crate::cli::directory;
use slowlight_vm::Stop;
use slowlight_vm::bbc::{Config, Dialect, Machine};
use std::process::{Command, Stdio};

/// Statements that set R%, from 0, and what it is then; an error is its number and 100.
const SAME: &[(&str, u8)] = &[
    ("A=1 DIV 0", 118),
    ("A=1 MOD 0", 118),
    ("A=1/0", 118),
    ("A=SQR(-1)", 121),
    ("A=LN(0)", 122),
    ("A=LOG(-1)", 122),
    ("A%=3E9", 120),
    ("A%=2147483647+1", 120),
    ("A%=&7FFFFFFF:A%=A%+1", 120),
    ("A=ZZ", 126),
    ("A$=1", 106),
    ("A=B(1)", 114),
    ("DIM Q(3):A=Q(4)", 115),
    ("PROCnone", 129),
    ("A=FNnone", 129),
    ("NEXT", 132),
    ("UNTIL 1", 143),
    ("RETURN", 138),
    ("ENDPROC", 113),
    ("GOTO 9999", 141),
    ("READ A", 142),
    ("R%=-(2147483647+1=2147483648)", 1),
    ("R%=-(-2147483647-2=-2147483649)", 1),
    ("R%=-(100000*100000=1E10)", 1),
    ("R%=-(2147483647*2=4294967294)", 1),
    // The least integer has no opposite, and stays.
    ("R%=-(ABS(&80000000)=&80000000)", 1),
    ("R%=-(-&80000000=&80000000)", 1),
    ("R%=-(2^31-1=2147483647)", 1),
    ("R%=-(-7 DIV 2=-3)", 1),
    ("R%=-(-7 MOD 3=-1)", 1),
    ("R%=7.9 DIV 2.9", 3),
    ("R%=2.9", 2),
    ("R%=-(-2.9)", 2),
    ("R%=-INT(-2.5)", 3),
    ("R%=5 AND 3.9", 1),
    ("R%=2^3^2", 64),
    ("R%=-2^2", 4),
    ("R%=-(1<2)", 1),
    ("R%=-(&FFFFFFFF=-1)", 1),
    ("R%=-SGN(-.1)", 1),
    ("R%=-ASC(\"\")", 1),
    ("FOR I%=5 TO 1:R%=R%+1:NEXT", 1),
    ("FOR I%=1 TO 5 STEP 2:NEXT:R%=I%", 7),
];

/// What Brandy has first, then what we have.
const DIFFERENT: &[(&str, u8, u8)] = &[
    ("R%=-(.1+.2=.3)", 0, 1),
    ("FOR X=0 TO 1 STEP .1:R%=R%+1:NEXT", 11, 10),
    ("A=3E38", 0, 120),
    ("A=EXP(100)", 0, 124),
    ("A=SIN(1E12)", 0, 123),
    ("A$=STRING$(200,\"ab\")", 0, 119),
];

/// A program that writes R% of each statement to a file.
fn program() -> String {
    let statements: Vec<&str> = SAME
        .iter()
        .map(|s| s.0)
        .chain(DIFFERENT.iter().map(|s| s.0))
        .collect();
    let mut text =
        "10F%=OPENOUT(\"results\"):N%=0\n20ON ERROR R%=100+ERR:GOTO 900\n30N%=N%+1:R%=0\n"
            .to_owned();
    for (k, statement) in statements.iter().enumerate() {
        text += &format!("{}IF N%={} THEN {statement}\n", 40 + k, k + 1);
    }
    text += &format!(
        "900BPUT#F%,R%\n910IF N%<{} THEN GOTO 30\n920CLOSE#F%\n930END\n",
        statements.len()
    );
    text
}

fn brandys(text: &str) -> Vec<u8> {
    let dir = directory(&[("program.bas", text)]);
    let status = Command::new("brandy")
        .args(["-quit", "program.bas"])
        .current_dir(dir.path())
        .env("SDL_VIDEODRIVER", "dummy")
        .env("SDL_AUDIODRIVER", "dummy")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .expect("brandy is installed: see tests/peers/setup");
    assert!(status.success(), "{status}");
    std::fs::read(dir.path().join("results")).expect("results")
}

fn ours(text: &str) -> Vec<u8> {
    let mut machine = Machine::new(Config {
        dialect: Dialect::BasicV,
        ..Config::default()
    });
    machine.load_text(text).expect("a program");
    let run = machine.run(1_000_000_000, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended, "{}", run.text);
    run.files.get("results").cloned().unwrap_or_default()
}

#[test]
fn statements_do_what_they_do_on_brandy() {
    let text = program();
    let (brandys, ours) = (brandys(&text), ours(&text));
    let same = SAME.iter().map(|(s, r)| (s, *r, *r));
    let expected = same.chain(DIFFERENT.iter().map(|(s, b, o)| (s, *b, *o)));
    let expected: Vec<_> = expected.collect();
    assert_eq!(
        (brandys.len(), ours.len()),
        (expected.len(), expected.len())
    );
    let pairs = expected.iter().zip(brandys.iter().zip(&ours));
    let wrong: Vec<_> = pairs
        .filter(|((_, b, o), (brandys, ours))| b != *brandys || o != *ours)
        .collect();
    assert!(wrong.is_empty(), "expected, then found: {wrong:#?}");
}
