//! Keys and standard input on the command line: scripts, shots, what waits for ever, on
//! every machine that has a keyboard.

use crate::cli::{directory, success};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// Exit status, output and what was said, of a run that is given standard input.
fn typed(dir: &Path, args: &[&str], input: &str) -> (Option<i32>, String, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_slowlight"))
        .args(args)
        .current_dir(dir)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary runs");
    let mut stdin = child.stdin.take().expect("a pipe");
    // Who does not read it has closed it.
    let _ = stdin.write_all(input.as_bytes());
    drop(stdin);
    let output = child.wait_with_output().expect("it ends");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.code(),
        text(&output.stdout),
        text(&output.stderr),
    )
}

fn game() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/games/bricks");
    path.to_string_lossy().into_owned()
}

/// The game of docs/machines.md, played as it says there, on the VM with both systems: the
/// screens are those of the pictures there.
#[test]
fn the_game_is_played_by_its_script() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let script = root.join("examples/games/bricks.keys");
    let dir = directory(&[]);
    let keys = format!("@{}", script.display());
    let game = game();
    for more in [&[][..], &["--os", "jack"], &["--cpu"]] {
        let args = [
            "vm",
            "jack",
            &game,
            "--keys",
            &keys,
            "-o",
            "bricks-over.png",
        ];
        let args = [&args[..], more].concat();
        let (status, _, said) = typed(dir.path(), &args, "");
        assert_eq!(status, Some(0), "{more:?}: {said}");
        for name in ["serve.png", "wall.png", "over.png"] {
            let kept = root.join("docs/pictures").join(format!("bricks-{name}"));
            let kept = std::fs::read(kept).expect("the page's picture");
            let shot = dir.path().join(format!("bricks-{name}"));
            assert_eq!(
                std::fs::read(&shot).expect("a shot"),
                kept,
                "{name} {more:?}"
            );
            std::fs::remove_file(shot).expect("it was there");
        }
    }
}

/// Asks for a name and a number, then for keys until one is a full stop.
const ASKS: &str = "class Main { function void main() {
    var String name;
    var int n;
    var char c;
    let name = Keyboard.readLine(\"name? \");
    let n = Keyboard.readInt(\"n? \");
    do Output.printInt(n * 2);
    do Output.printString(name);
    while (~(c = 46)) { let c = Keyboard.readChar(); }
    return; } }";

#[test]
fn a_program_of_jack_reads_keys_and_lines() {
    let dir = directory(&[("Main.jack", ASKS)]);
    let dir = dir.path();
    let run = |more: &[&str], input: &str| {
        typed(
            dir,
            &[&["vm", "jack", "Main.jack"][..], more].concat(),
            input,
        )
    };
    let expected = "name? Ada\nn? -21\n-42Adaxy.";
    let (status, text, said) = run(&[], "Ada\n-21\nxy.");
    assert_eq!((status, text.as_str()), (Some(0), expected), "{said}");
    // The same by a script, with a mistake that is taken back; a key that is held is one.
    let script = "\"Ab\" backspace \"da\" enter*9 \"-21\" enter wait 5 \"xy.\"";
    let (status, text, said) = run(&["--keys", script], "");
    let text = text.replace("Ab\u{8}", "A");
    assert_eq!((status, text.as_str()), (Some(0), expected), "{said}");
    // First the script, then standard input.
    let (status, text, _) = run(&["--keys", "\"Ada\""], "\n-21\nxy.");
    assert_eq!((status, text.as_str()), (Some(0), expected));
    // With the system in Jack it is typed where the script says so.
    let (status, _, said) = run(&["--os", "jack", "--keys", "stdin"], "Ada\n-21\nxy.");
    assert_eq!(status, Some(0), "{said}");
    let (status, _, said) = run(&["--cpu", "--keys", "stdin"], "Ada\n-21\nxy.");
    assert_eq!(status, Some(0), "{said}");
    // A key that never comes.
    let (status, text, said) = run(&[], "Ada\n");
    assert_eq!((status, text.as_str()), (Some(1), "name? Ada\nn? "));
    assert!(
        said.contains("Keyboard.readInt waits for a key that never comes"),
        "{said}"
    );
    for more in [
        &["--os", "jack"][..],
        &["--cpu"],
        &["--cpu", "--keys", "\"Ada\" enter"],
    ] {
        let (status, _, said) = run(more, "");
        assert_eq!(status, Some(1), "{more:?}");
        assert!(
            said.contains("the program waits for a key that never comes"),
            "{said}"
        );
    }
}

/// Shows what GET, INKEY and INPUT give.
const BASIC: &str = "10 INPUT \"n \" A%,B$\n20 PRINT A%+1;\"<\";B$;\">\"\n30 G%=GET\n\
    40 PRINT G%;\" \";GET$\n50 REPEAT UNTIL INKEY(-26)\n60 T%=TIME\n70 REPEAT UNTIL NOT INKEY(-26)\n\
    80 PRINT TIME-T%>35 AND TIME-T%<45\n90 PRINT INKEY(1000)\n";

#[test]
fn a_program_of_basic_reads_keys_and_lines() {
    let dir = directory(&[("asks.bas", BASIC)]);
    let dir = dir.path();
    let run =
        |keys: &str, input: &str| typed(dir, &["vm", "bbc", "asks.bas", "--keys", keys], input);
    let rest = "wait 50 escape \"a\" wait 50 left*20 wait 100 @";
    let words = |text: &str| text.split_whitespace().collect::<Vec<&str>>().join(" ");
    let expected = "n 41,x y 42<x y> 27 a -1 64";
    let (status, text, said) = run(&format!("\"41,x y\" enter {rest}"), "");
    assert_eq!(
        (status, words(&text).as_str()),
        (Some(0), expected),
        "{said}"
    );
    let (status, text, said) = run(rest, "");
    assert_eq!(status, Some(1), "{text} {said}");
    // INPUT from standard input, with less on a line than it asks for.
    let dir = directory(&[(
        "sum.bas",
        "10 INPUT A,B\n20 PRINT A+B\n30 INPUT C\n40 PRINT C\n",
    )]);
    let args = ["vm", "bbc", "sum.bas"];
    let (status, text, _) = typed(dir.path(), &args, "1\n2.5\nseven\n");
    let numbers = words(&text);
    assert!(status == Some(0) && numbers.contains("3.5"), "{text}");
    assert!(numbers.ends_with("seven 0"), "{text}");
    let (status, _, said) = typed(dir.path(), &args, "1,2\n");
    assert_eq!(status, Some(1));
    assert!(
        said.contains("30: INPUT waits for a key that never comes"),
        "{said}"
    );
    let dir = directory(&[("get.bas", "10 PRINT 1\n20 IF GET=65 END\n30 GOTO 20\n")]);
    let (status, _, said) = typed(dir.path(), &["vm", "bbc", "get.bas"], "");
    assert_eq!(status, Some(1));
    assert!(
        said.contains("20: GET waits for a key that never comes"),
        "{said}"
    );
    success(dir.path(), &["vm", "bbc", "get.bas", "--keys", "b c A"]);
}

/// Colours a screen by the keys that GETIN gives, until RETURN; then waits for SPACE in the
/// matrix.
const C64: &str = "* = $c000
    lda #$3b
    sta $d011
next:
    jsr $ffe4
    beq next
    cmp #13
    beq scan
    sta $0400
    jsr $ffd2
    jmp next
scan:
    lda #$7f
    sta $dc00
space:
    lda $dc01
    and #$10
    bne space
    rts
";

#[test]
fn a_program_of_the_c64_reads_keys() {
    let dir = directory(&[("keys.asm", C64)]);
    let dir = dir.path();
    let run = |keys: &str| {
        typed(
            dir,
            &[
                "vm", "6502:c64", "keys.asm", "--limit", "5000000", "--keys", keys,
            ],
            "",
        )
    };
    let (_, text, said) = run("wait 9 \"ok\" wait 3 enter wait 5 z*5 wait 5 space*3");
    assert_eq!(text, "ok", "{said}");
    let (status, _, said) = run("\"ok\" enter wait 5 z*5");
    assert_eq!(status, Some(1));
    assert!(
        said.contains("it waits for a key, and none is left"),
        "{said}"
    );
    // By calls, each look is a unit: the first sees nothing.
    let (_, text, said) = run("by calls wait 1 \"ok\" enter wait 5 space*3 shot last.png");
    assert_eq!(text, "ok", "{said}");
    assert!(
        said.contains("the program stopped before it came to last.png"),
        "{said}"
    );
    // Without a script programs have ended where they wait for a key.
    let (_, _, said) = typed(dir, &["vm", "6502:c64", "keys.asm", "--limit", "5000"], "");
    assert!(said.contains("the program calls $FFE4"), "{said}");
}

/// Prints keys, until RETURN; then waits until Z is held.
const MICRO: &str = "* = $1900
next:
    jsr $ffe0
    cmp #13
    beq held
    jsr $ffee
    jmp next
held:
    lda #129
    ldx #$9e
    ldy #$ff
    jsr $fff4
    cpx #255
    bne held
    lda #4
    sta $80
    rts
";

#[test]
fn a_program_of_the_micro_reads_keys() {
    let dir = directory(&[("keys.asm", MICRO)]);
    let dir = dir.path();
    let run = |keys: &str| {
        typed(
            dir,
            &[
                "vm", "6502:bbc", "keys.asm", "--limit", "5000000", "--keys", keys,
            ],
            "",
        )
    };
    let (_, text, said) = run("\"ok\" wait 3 enter wait 5 x*5 wait 5 z*5");
    assert_eq!(text, "ok", "{said}");
    let (status, _, said) = run("\"ok\"");
    assert_eq!(status, Some(1));
    assert!(
        said.contains("OSRDCH waits for a key that never comes"),
        "{said}"
    );
    let (status, _, said) = run("\"ok\" enter x*5");
    assert_eq!(status, Some(1));
    assert!(
        said.contains("it waits for a key, and none is left"),
        "{said}"
    );
}

#[test]
fn wrong_scripts_are_wrong_usage() {
    let dir = directory(&[("Main.jack", ASKS), ("k.keys", "right*20\n  spcae\n")]);
    let dir = dir.path();
    let run = |keys: &str| typed(dir, &["vm", "jack", "Main.jack", "--keys", keys], "");
    let (status, _, said) = run("rihgt*20");
    assert_eq!(status, Some(2));
    assert!(
        said.starts_with("error: --keys: 1:1: there is no key `rihgt`"),
        "{said}"
    );
    let (status, _, said) = run("@k.keys");
    assert_eq!(status, Some(2));
    assert!(said.contains("2:3: there is no key `spcae`"), "{said}");
    assert_eq!(run("@gone.keys").0, Some(1));
    assert_eq!(run("a shot one.gif").0, Some(2));
}

/// The plain machine's port: what is held when a picture is done.
#[test]
fn a_program_of_the_plain_machine_sees_what_is_held() {
    let text = "hands = $ff0c
 * = $1000
 ldx #0
again: sta hands
 lda $ff0d
 sta $2000,x
 inx
 cpx #6
 bne again
 lda $2000
 cmp #2
 bne wrong
 lda $2001
 bne wrong
 lda $2002
 cmp #16
 bne wrong
 lda #0
 sta $ff0a
wrong: lda #7
 sta $ff0a
";
    let dir = directory(&[("held.asm", text)]);
    let run = |keys: &str| typed(dir.path(), &["vm", "6502", "held.asm", "--keys", keys], "");
    let (status, _, said) = run("by calls right space left");
    assert_eq!(status, Some(0), "{said}");
    assert_eq!(run("by calls left").0, Some(1));
}
