#![allow(clippy::unwrap_used)]

use super::*;
use proptest::prelude::*;
use slowlight_isa::opcodes::{OPCODES, Trust};

fn bytes(source: &str) -> Vec<u8> {
    assemble(source).unwrap().bytes
}

/// The first fault as `line:column: message`.
fn fault(source: &str) -> String {
    assemble(source).unwrap_err()[0].to_string()
}

#[test]
fn every_opcode_is_written_and_read_back() {
    for (opcode, o) in (0..=255u8).zip(OPCODES.iter()) {
        if o.trust == Trust::Jam || opcodes_find(o) != Some(opcode) {
            continue;
        }
        let (operand, expected): (&str, &[u8]) = match o.mode {
            Mode::Implied | Mode::Accumulator => ("", &[]),
            Mode::Immediate => ("#$12", &[0x12]),
            Mode::ZeroPage => ("$12", &[0x12]),
            Mode::ZeroPageX => ("$12,x", &[0x12]),
            Mode::ZeroPageY => ("$12,y", &[0x12]),
            Mode::Absolute => ("$1234", &[0x34, 0x12]),
            Mode::AbsoluteX => ("$1234,x", &[0x34, 0x12]),
            Mode::AbsoluteY => ("$1234,y", &[0x34, 0x12]),
            Mode::Indirect => ("($1234)", &[0x34, 0x12]),
            Mode::IndirectX => ("($12,x)", &[0x12]),
            Mode::IndirectY => ("($12),y", &[0x12]),
            Mode::Relative => ("*+4", &[0x02]),
        };
        let mut whole = vec![opcode];
        whole.extend(expected);
        assert_eq!(bytes(&format!(" {} {operand}", o.mnemonic)), whole);
        assert_eq!(
            bytes(&format!(
                " {} {}",
                o.mnemonic.to_uppercase(),
                operand.to_uppercase()
            )),
            whole
        );
    }
}

use slowlight_isa::opcodes::Mode;
fn opcodes_find(o: &slowlight_isa::opcodes::Opcode) -> Option<u8> {
    slowlight_isa::opcodes::find(o.mnemonic, o.mode)
}

#[test]
fn the_zero_page_is_used_where_the_value_is_known() {
    assert_eq!(bytes("zp = $10\n lda zp"), [0xA5, 0x10]);
    assert_eq!(bytes(" lda zp\nzp = $10"), [0xAD, 0x10, 0x00]);
    assert_eq!(bytes("zp = $FF\n lda zp+1"), [0xAD, 0x00, 0x01]);
    assert_eq!(
        bytes(" stx zp,y\nzp = $10"),
        [0x96, 0x10],
        "there is nothing else"
    );
    assert_eq!(
        bytes("zp = $10\n lda zp,y"),
        [0xB9, 0x10, 0x00],
        "no zp,y for lda"
    );
    assert_eq!(bytes("zp = $10\n jmp zp"), [0x4C, 0x10, 0x00]);
}

#[test]
fn expressions_have_their_values() {
    let value = |text: &str| assemble(&format!("* = $1234\nv = {text}")).unwrap().symbols["v"];
    assert_eq!(value("2+3*4-10/3"), 11);
    assert_eq!(value("-7/2"), -3, "towards zero, as in the others");
    assert_eq!(value("(1+2)*(3+4)"), 21);
    assert_eq!(value("8-4-2"), 2);
    assert_eq!(value("64/4/2"), 8);
    assert_eq!(value("--5"), 5);
    assert_eq!(value("<(*)"), 0x34);
    assert_eq!(value(">(*)"), 0x12);
    assert_eq!(value("<(-1000)"), 0x18);
    assert_eq!(value(">(-1000)"), 0xFC);
    assert_eq!(value("$F0|%1010"), 0xFA);
    assert_eq!(value("$FF^$0F"), 0xF0);
    assert_eq!(value("12&10&9"), 8);
    assert_eq!(value("(1<<20)>>18"), 4);
    assert_eq!(value("-100>>3"), -13);
    assert_eq!(value("'A'+1"), 66);
    assert_eq!(value("later*2\nlater = even_later\neven_later = 21"), 42);
    assert_eq!(value("$FFFFFFFF"), 0xFFFF_FFFF);
}

#[test]
fn what_assemblers_read_differently_needs_parentheses() {
    for text in [
        "1+2&3", "1&2+3", "1|2&3", "<(5)+1", "1<<2<<3", "1+2<<3", "4*<(5)",
    ] {
        assert!(assemble(&format!("v = {text}")).is_err(), "{text}");
    }
    assert_eq!(
        bytes(" lda #<(5)\n lda #>(label)\nlabel:"),
        [0xA9, 5, 0xA9, 0]
    );
}

#[test]
fn data_and_labels() {
    let a = assemble(
        "* = $0800\nl: .byte 1, \"ab\", 'c' ; comment ' \"\n.word l, m\nm: .res 2, 7\n.res 1",
    )
    .unwrap();
    assert_eq!(a.origin, 0x0800);
    assert_eq!(
        a.bytes,
        [1, b'a', b'b', b'c', 0x00, 0x08, 0x08, 0x08, 7, 7, 0]
    );
    assert_eq!(a.image()[..3], [0x00, 0x08, 1]);
    assert_eq!(a.symbols["m"], 0x0808);
    let lines: Vec<_> = (0x0800..=0x080B).map(|at| a.line_at(at)).collect();
    assert_eq!(lines[..5], [Some(2), Some(2), Some(2), Some(2), Some(3)]);
    assert_eq!(lines[8..], [Some(4), Some(4), Some(5), None]);
    assert_eq!(a.line_at(0x07FF), None);
}

#[test]
fn a_listing_stands_beside_its_source() {
    let source = "* = $1000\nstart: lda #1 ; one\n.byte 1,2,3,4,5,6,7,8,9\n bne start\n rts";
    let expected = concat!(
        "                                    * = $1000\n",
        "1000  A9 01                     2   start: lda #1 ; one\n",
        "1002  01 02 03 04 05 06 07 08 +     .byte 1,2,3,4,5,6,7,8,9\n",
        "100B  D0 F3                     2+   bne start\n",
        "100D  60                        6    rts\n",
    );
    assert_eq!(assemble(source).unwrap().listing(source), expected);
}

#[test]
fn faults_have_their_place() {
    assert_eq!(
        fault("\n ldq #1"),
        "2:2: unknown instruction `ldq` (a label needs a colon)"
    );
    assert_eq!(fault(" lda nowhere"), "1:6: `nowhere` is not defined");
    assert_eq!(
        fault("a1:\n\na1:"),
        "3:1: `a1` is already defined in line 1"
    );
    assert_eq!(
        fault(" sta #1"),
        "1:2: `sta` cannot have an immediate operand"
    );
    assert_eq!(
        fault(" lda #256"),
        "1:7: an immediate operand must be 0 to 255; this is 256"
    );
    assert_eq!(
        fault(" lda #-1"),
        "1:7: an immediate operand must be 0 to 255; this is -1"
    );
    assert_eq!(
        fault("p = q\nq = p"),
        "1:1: the value of `p` depends on itself or on an error"
    );
    assert_eq!(fault("p = 1/0"), "1:5: division by zero");
    assert_eq!(fault("p = q/0\nq = 1"), "1:5: division by zero");
    assert_eq!(
        fault("x = 1"),
        "1:1: `x` is a register and cannot be a symbol"
    );
    assert_eq!(
        fault("lda = 1"),
        "1:1: `lda` is an instruction and cannot be a symbol"
    );
    assert_eq!(
        fault("l: nop\n* = $10"),
        "2:5: the origin cannot move behind the first byte: pad with `.res`"
    );
    assert_eq!(
        fault("* = later\nlater = 1"),
        "1:5: `later` must be defined above, as the origin depends on it"
    );
    assert_eq!(
        fault("* = $FFFF\n.word 1"),
        "2:1: the program goes beyond $FFFF, by 1 bytes"
    );
    assert_eq!(super::extent("* = $FF00\n.res 256"), (0xFF00, 0x1_0000));
    assert_eq!(
        super::extent("* = $FF00\n.res 300\nlda 1"),
        (0xFF00, 0x1_002E)
    );
    assert_eq!(fault(" lda (4)+1"), {
        "1:6: an operand that begins with `(` is indirect: its `)` must end it; for an address write `0+(...)`"
    });
    assert_eq!(fault(" lda (4,y)"), "1:8: expected `)` or `,x)`");
    assert_eq!(
        fault(" .byte 'é'"),
        "1:8: expected one printable ASCII character in quotes, as 'c'"
    );
    assert_eq!(fault(" nop é"), "1:6: unexpected character 'é'");
    assert_eq!(
        fault(" .byte \"abc"),
        "1:8: this string has no closing quote"
    );
    assert_eq!(
        fault(" .byte $1FFFFFFFF"),
        "1:8: this number does not fit 32 bits"
    );
    assert_eq!(
        fault(" .byte 12ab"),
        "1:8: `12ab` is not a number in base 10"
    );
    assert_eq!(
        fault(" .frob 3"),
        "1:2: unknown directive `.frob`; there are `.byte`, `.word` and `.res`"
    );
    assert_eq!(
        fault(" .res 65537"),
        "1:7: the number of bytes must be 0 to 65536; this is 65537"
    );
    assert_eq!(
        fault(" lda 5 5"),
        "1:8: this does not belong to the statement before it"
    );
    let far = format!("l: nop\n{} bne l", ".res 100\n".repeat(2));
    assert_eq!(fault(&far), {
        "4:6: a branch reaches from -128 to 127 bytes, and this is -203: branch around a `jmp`"
    });
}

#[test]
fn branches_reach_exactly_as_far_as_they_do() {
    assert!(assemble("l: .res 126\n bne l").is_ok());
    assert!(assemble("l: .res 127\n bne l").is_err());
    assert!(assemble(" bne l\n.res 127\nl:").is_ok());
    assert!(assemble(" bne l\n.res 128\nl:").is_err());
}

#[test]
fn large_and_deep_texts_end() {
    assert_eq!(
        fault(&format!("v = {}1", "(".repeat(1 << 20))),
        "1:261: parentheses nest deeper than 256"
    );
    let long = assemble(&format!("v = 0{}", "+1".repeat(1 << 18))).unwrap();
    assert_eq!(long.symbols["v"], 1 << 18);
    assert!(assemble(&format!("v = {}1", "-".repeat(1 << 20))).is_ok());
    // A chain of forward references in the worst order for repeated passes.
    let mut chain = String::new();
    for i in 0..20_000 {
        chain += &format!("s{} = s{}\n", (i * 7919) % 20_000, (i * 7919) % 20_000 + 1);
    }
    assert_eq!(assemble(&(chain + "s20000 = 5")).unwrap().symbols["s0"], 5);
    assert_eq!(assemble(&"?\n".repeat(1000)).unwrap_err().len(), FAULTS);
    assert!(assemble(&".res 65536\n".repeat(1000)).is_err());
}

proptest! {
    #[test]
    fn no_text_makes_a_panic(text in "[ -~\\n\t\u{e9}]{0,200}") {
        let _ = assemble(&text).map(|a| a.listing(&text));
        let _ = assemble_as(&text, Dialect::Beebasm).map(|a| a.listing(&text));
    }

    #[test]
    fn nor_does_text_that_looks_like_a_program(parts in prop::collection::vec(
        prop::sample::select(vec![
            "l:", "m:", "l", "m", "lda", "sta", "bne", "jmp", "asl", "#", "(", ")", ",x", ",y", "a", "+", "-",
            "*", "/", "<", ">", "<<", ">>", "&", "|", "^", "=", "* =", ".byte", ".word", ".res", "1", "$FF",
            "%1", "'c'", "\"s\"", "65535", "\n", "\n", "\n", " ", ";", ".l", ".m", "LO(", "HI", "&FF", "EQUB", "EQUS",
            "EQUW", "SKIP", "ORG", "SAVE", ":", "\\",
        ]), 0..60)) {
        let text = parts.join(" ");
        let _ = assemble(&text).map(|a| a.listing(&text));
        let _ = assemble_as(&text, Dialect::Beebasm).map(|a| a.listing(&text));
    }
}

/// beebasm's way of writing; the bytes are those of the common one.
#[test]
fn beebasms_dialect_makes_the_same_bytes() {
    let common = "\
        zero = $12
        * = $0a00
start:  lda #<(data)
        ldx #>(data + 1)
        asl
        rol a
        sta zero
        sta zero,x
        sta (zero),y
again:  bne again
        jmp (data)
data:   .byte 1, $ff, %101, 'c', \"text\"
        .word start, data+2
        .res 3
        .byte <((big) >> 16)
        big = $123456
";
    let beebasm = "\
zero = &12 : big = &123456 \\ two statements; a comment
ORG &0A00
.start  LDA #LO(data) : LDX #HI(data + 1)
        ASL A : ROL a ; the accumulator
        STA zero: STA zero,X : sta (zero),y
.again  bne again
.wait
        jmp (data)
.data   EQUB 1, $ff, %101, 'c' : EQUS \"text\"
        EQUW start, data+2
        SKIP 3
        EQUB LO((big) >> 16)
        SAVE \"program\", start, *
";
    let read = assemble_as(beebasm, Dialect::Beebasm).unwrap();
    assert_eq!(read.bytes, bytes(common));
    assert_eq!(read.origin, 0x0a00);
    assert_eq!(read.line_at(0x0a02), Some(3));
}

#[test]
fn beebasms_dialect_refuses_what_beebasm_would() {
    let fault = |source: &str| {
        let faults = assemble_as(source, Dialect::Beebasm).unwrap_err();
        faults[0].to_string()
    };
    for (source, said) in [
        ("ASL", "1:1: beebasm wants `asl a` here"),
        ("ORG &200 : BRK : ROR", "1:18: beebasm wants `ror a` here"),
        (
            "start: BRK",
            "1:1: unknown instruction or directive `start`",
        ),
        ("* = &0A00", "1:1: expected"),
        (".byte 1", "1:7: expected a label"),
        (". BRK", "1:1: expected a label's name"),
        ("EQUB 1 | 2", "1:8: beebasm has no operator '|'"),
        ("EQUB 1 & 2", "1:8: `` is not a number in base 16"),
        ("SKIP 2, 1", "1:7: this does not belong"),
        ("SAVE \"x\"", "1:9: expected `,`"),
        ("SAVE \"x\", nowhere", "1:11: `nowhere` is not defined"),
        (".a BRK", "1:1: `a` is a register"),
        ("BRK : .b : .b", "1:12: `b` is already defined in line 1"),
    ] {
        let found = fault(source);
        assert!(found.starts_with(said), "{source}: {found}");
    }
    // And what only beebasm has is refused elsewhere.
    for source in ["EQUB 1", "lda #LO(1)", "v = &10", "nop : nop", "nop \\ x"] {
        assert!(assemble(source).is_err(), "{source}");
    }
}

/// A program that was read once is assembled again with other numbers, as if they stood in it.
#[test]
fn numbers_are_assigned_anew() {
    let text =
        |rows: u32| format!("* = $800\nrows = {rows}\nlast = rows - 1\n lda #last\n ldx rows\n");
    let parsed = Parsed::of(&text(3), Dialect::Common);
    for rows in [3, 7, 300] {
        let anew = parsed.assemble(&[("rows", i64::from(rows)), ("columns", 1)]);
        assert_eq!(anew, assemble(&text(rows)), "{rows}");
    }
    // Not a label: what the text does not assign stays where it is.
    let label = Parsed::of("* = $800\nhere: jmp here\n", Dialect::Common);
    assert_eq!(label.assemble(&[("here", 5)]), label.assemble(&[]));
}
