//! Tests of how programs that are no source are told, placed and begun.
#![allow(clippy::unwrap_used)]

use super::super::board::Config;
use super::*;

fn file(name: &str, bytes: &[u8]) -> File {
    File {
        name: name.to_owned(),
        bytes: bytes.to_vec(),
    }
}

fn on(board: Board, at: Option<u16>, start: Option<u16>) -> Config {
    Config {
        board,
        at,
        start,
        ..Config::default()
    }
}

fn refusal(file: &File, config: Config) -> String {
    match read(file, config).unwrap_err() {
        Failure::Usage(message) | Failure::Wrong(message) => message,
        other => panic!("{other:?}"),
    }
}

#[test]
fn addresses_are_written_as_usual() {
    for (text, value) in [
        ("$2000", 0x2000),
        ("&1900", 0x1900),
        ("0xc000", 0xC000),
        ("0XfF", 0xFF),
        ("8192", 8192),
        ("0", 0),
        ("$FFFF", 0xFFFF),
    ] {
        assert_eq!(address(text), Ok(value), "{text}");
    }
    for text in [
        "", "$", "0x", "2000h", "C000", "-1", "+5", "$ 20", "&1_0", "é",
    ] {
        assert!(address(text).unwrap_err().contains("hexadecimal"), "{text}");
    }
    for text in ["65536", "$10000", "0x123456789"] {
        assert!(
            address(text).unwrap_err().starts_with("an address is"),
            "{text}"
        );
    }
}

#[test]
fn text_is_told_by_what_is_in_it() {
    for (name, bytes) in [
        ("a.a", &b"* = $2000\n lda #0\n"[..]),
        ("b", b" nop\r\n\x0c\tnop ; \xc3\xa9"),
        ("c.prg", b"* = $2000"),
        // Not UTF-8, but called a source.
        ("d.S", b" nop ; caf\xe9"),
    ] {
        assert!(is_text(&file(name, bytes)), "{name}");
    }
    for (name, bytes) in [
        // LDA #65, JSR &FFEE, RTS: no control character is in it.
        ("a.bin", &b"\xa9A \xee\xff`"[..]),
        ("b.asm", b" nop\n\x00"),
        ("c.s", b"\xa9\x00"),
        ("d.ssd", b"text"),
    ] {
        assert!(!is_text(&file(name, bytes)), "{name}");
    }
}

#[test]
fn binaries_lie_where_it_is_said() {
    let plain = |at, start| on(Board::Plain, at, start);
    let code = [0xEA, 0x60];
    let at = |at, start| read(&file("x.bin", &code), plain(at, start)).unwrap();
    assert_eq!(
        (at(Some(0x2000), None).at, at(Some(0x2000), None).start),
        (0x2000, Some(0x2000))
    );
    assert_eq!(at(Some(0x2000), Some(0x2001)).start, Some(0x2001));
    assert_eq!(at(Some(0x2000), None).bytes, code);
    let prg = file("x.PRG", &[0x34, 0x12, 0xEA]);
    let read_prg = |start| read(&prg, plain(None, start)).unwrap();
    assert_eq!((read_prg(None).at, read_prg(None).start), (0x1234, None));
    assert_eq!(read_prg(Some(7)).start, Some(7));
    assert_eq!(read_prg(None).bytes, [0xEA]);
    for (name, config, said) in [
        ("x.bin", plain(None, None), "--at ADDR"),
        ("x", plain(None, Some(5)), "--at ADDR"),
        ("x.prg", plain(Some(5), None), "leave --at out"),
        ("x.ssd", plain(None, None), "vm 6502:bbc x.ssd"),
        (
            "x.ssd",
            on(Board::Bbc, None, Some(5)),
            "leave --at and --start out",
        ),
        ("x.ssd", on(Board::Bbc, None, None), "no disc image"),
        ("x.dsd", on(Board::Bbc, None, None), "two sides"),
    ] {
        let message = refusal(&file(name, &code), config);
        assert!(message.contains(said), "{name}: {message}");
    }
    assert!(refusal(&file("x.prg", &[1]), plain(None, None)).contains("two bytes of load address"));
}

/// A disc whose `!BOOT` types lines, with two programs.
fn disc(lines: &str) -> Disc {
    let file = |name: &str, load: u16, exec: u16, bytes: &[u8]| DiscFile {
        name: name.to_owned(),
        load,
        exec,
        bytes: bytes.to_vec(),
    };
    Disc {
        title: "T".to_owned(),
        option: dfs::EXEC,
        files: vec![
            file("CODE", 0x2000, 0x2003, &[1, 2, 3, 4]),
            file("A.OTHER", 0x3000, 0x3000, &[5]),
            file("PROG", 0x1900, 0x8023, &[13, 255]),
            file("!BOOT", 0, 0, lines.as_bytes()),
        ],
    }
}

#[test]
fn a_disc_starts_what_its_boot_file_says() {
    for (lines, name) in [
        ("*RUN CODE\r", "CODE"),
        ("\r*| a remark\r * run code\rCHAIN \"PROG\"\r", "CODE"),
        ("*R.CODE", "CODE"),
        ("*/$.code\n", "CODE"),
        ("*CODE 1 2\r", "CODE"),
        ("*RUN \"CODE\"\r", "CODE"),
        ("*RUN A.OTHER\r", "A.OTHER"),
        ("**RUN :0.A.OTHER\r", "A.OTHER"),
    ] {
        assert_eq!(
            started(&disc(lines)).map(|f| f.name),
            Ok(name.to_owned()),
            "{lines:?}"
        );
    }
    for (lines, said) in [
        ("CHAIN\"PROG\"\r", "vm bbc"),
        ("*BASIC\rCHAIN\"PROG\"\r", "`*BASIC`"),
        ("*RUN NOTHING\r", "`*RUN NOTHING`"),
        ("*LOAD CODE 3000\r*RUN CODE", "`*LOAD CODE 3000`"),
        ("*RUN PROG\r", "vm bbc"),
        ("\r*\r", "runs no program"),
    ] {
        let message = started(&disc(lines)).unwrap_err();
        assert!(message.contains(said), "{lines:?}: {message}");
    }
    // As machine code itself, and not at all.
    let with = |option| Disc {
        option,
        ..disc("*RUN CODE")
    };
    assert_eq!(started(&with(dfs::RUN)).unwrap().name, "!BOOT");
    assert!(
        started(&with(0))
            .unwrap_err()
            .contains("CODE, A.OTHER, PROG")
    );
    let mut none = disc("");
    none.files.pop();
    assert!(started(&none).unwrap_err().contains("`!BOOT`"));
}
