//! Constructs of other 6502 assemblers that this one does not read, by name: for diagnostics.

use super::Dialect;
use super::parse::directive;

/// What words are in the assemblers that have them: kinds, and names in lower case between
/// blanks. A name with a dot in front stands for acme's with `!` as well.
///
/// Source: the manuals of ca65, 64tass, acme, dasm, xa and beebasm.
static WORDS: &[(&str, &str)] = &[
    (
        "a scope for names",
        ".proc .endproc .scope .endscope .block .bend .endblock .zone .namespace .endn subroutine { }",
    ),
    (
        "a macro",
        ".macro .endmacro .mac .endmac .macpack .endm .exitmacro .define .undefine .function .endf \
         macro endmacro mac endm",
    ),
    (
        "conditional assembly",
        ".if .ifdef .ifndef .ifblank .ifnblank .ifconst .ifref .ifnref .ife .ifne .else .elseif \
         .elsif .elif .endif .fi if ifdef ifndef ifconst ifnconst else elif elsif endif eif",
    ),
    (
        "a repetition",
        ".repeat .endrepeat .rept .endr .endrep .rep .for .next .while .endwhile .do .until repeat \
         repend rept endr for next",
    ),
    (
        "an origin; here that is `* = ADDR`, before the first byte",
        ".org .reloc .pc .logical .here .phase .pseudopc org rorg rend",
    ),
    (
        "a segment, for a linker",
        ".segment .code .data .bss .rodata .zeropage .zp .section .send .dsection .pushseg .popseg \
         seg seg.u",
    ),
    (
        "a name of another module, for a linker",
        ".import .importzp .export .exportzp .global .globalzp .autoimport .constructor \
         .destructor .interruptor .forceimport",
    ),
    (
        "another file",
        ".include .incbin .binary .binclude .bin .source .src include incbin incdir",
    ),
    (
        "a record or an enumeration",
        ".struct .endstruct .ends .union .endunion .endu .tag .enum .endenum",
    ),
    (
        "a form of data; here there are `.byte`, `.word` and `.res`",
        ".asciiz .asc .aasc .ascii .text .null .shift .shiftl .ptext .tx .pet .raw .scr .literal \
         .dbyt .dword .addr .faraddr .lobytes .hibytes .bankbytes .byt .by .wo .db .dw .dc .dfb \
         .char .sint .int .lint .long .dint .rta .8 .16 .24 .32 .le16 .be16 .hex .fill .skip .ds \
         .dsb .align .charmap .ct .convtab .sprintf .concat dc dc.b dc.w dc.l ds ds.b ds.w dfb dfw \
         db dw byte word hex align equd mapchar",
    ),
    (
        "a definition; here that is `name = value`",
        ".equ .eq .set .var .let .label .const .local .localchar equ eqm set :=",
    ),
    (
        "a directive of another assembler",
        ".setcpu .cpu .pushcpu .popcpu .p02 .p02x .pc02 .psc02 .p816 .a8 .a16 .i8 .i16 .al .as .xl \
         .xs .feature .smart .case .debuginfo .listbytes .list .pagelength .enc .cdef .edef .to .sl \
         .initmem .linecont .end .fopt .assert .error .warning .warn .out .fatal .cerror .cwarn \
         .serious .proff .pron processor end cpu echo err list print assert guard clear error \
         putfile puttext putbasic copyblock randomize",
    ),
    (
        "an instruction of the 65C02 or later; this processor is the NMOS 6502",
        "bra phx phy plx ply stz trb tsb wai stp jsl jml rep sep xba phk phb plb",
    ),
];

/// The first thing on a line that only other assemblers know, and what it is there.
pub(super) fn construct(line: &str, dialect: Dialect) -> Option<String> {
    let comment = |c: char| c == ';' || c == '\\' && dialect == Dialect::Beebasm;
    let text = line.split(comment).next().unwrap_or_default().trim();
    let said = |name: &str, what: &str| Some(format!("`{name}` is not read: {what}"));
    let words = text.split(|c: char| c.is_whitespace() || ",()#*/<>".contains(c));
    for (k, word) in words.filter(|w| !w.is_empty()).enumerate() {
        // What is in a text means nothing.
        if word.contains(['"', '\'']) {
            return None;
        }
        let lower = word.to_ascii_lowercase();
        let acme = lower.strip_prefix('!').map(|name| format!(".{name}"));
        let name = acme.as_deref().unwrap_or(&lower);
        let has = |(_, names): &&(&str, &str)| names.split_whitespace().any(|n| n == name);
        // A dot begins a label in beebasm; some words are directives here as well.
        let own = dialect == Dialect::Beebasm && name.starts_with('.')
            || directive(name, dialect).is_some();
        // A word without a dot is a directive only as a statement or behind its label.
        let known = WORDS.iter().find(has).filter(|_| !own);
        if let Some((what, _)) = known.filter(|_| name.starts_with('.') || k < 2) {
            return said(word, what);
        }
        if acme.is_some() {
            return said(word, "a directive of acme's");
        }
        if word.len() > 1 && word.starts_with('@') {
            return said(word.trim_end_matches(':'), "a cheap local label");
        }
        if word.contains("::") {
            return said(word, "a name in a scope");
        }
        let signs = word.trim_start_matches(':');
        let counted = !signs.is_empty() && signs.chars().all(|c| c == '+' || c == '-');
        let alone = k == 0 || signs.len() < word.len();
        if dialect == Dialect::Common && (word == ":" || counted && (alone || signs.len() > 1)) {
            return said(word, "an unnamed label");
        }
    }
    None
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use crate::mos6502::{Dialect, assemble, assemble_as};

    #[test]
    fn what_only_other_assemblers_read_is_refused_by_name() {
        for (source, said) in [
            (".proc main", "`.proc` is not read: a scope"),
            ("main: .SCOPE", "`.SCOPE` is not read: a scope"),
            (".macro inx2", "`.macro` is not read: a macro"),
            ("inx2 MACRO", "`MACRO` is not read: a macro"),
            ("@loop:", "`@loop` is not read: a cheap local label"),
            (" bne @loop ; again", "`@loop` is not read: a cheap"),
            (".if .defined(x)", "`.if` is not read: conditional"),
            (" !if x {", "`!if` is not read: conditional"),
            (" !byte 1", "`!byte` is not read: a directive of acme's"),
            (" org $2000", "`org` is not read: an origin"),
            (".segment \"CODE\"", "`.segment` is not read: a segment"),
            (".include \"x.inc\"", "`.include` is not read: another file"),
            (" dc.b 1", "`dc.b` is not read: a form of data"),
            ("name equ 5", "`equ` is not read: a definition"),
            ("name := 5", "`:=` is not read: a definition"),
            (": inx", "`:` is not read: an unnamed label"),
            (" bne :-", "`:-` is not read: an unnamed label"),
            (" jmp ++", "`++` is not read: an unnamed label"),
            (" jsr main::inner", "`main::inner` is not read: a name in"),
            (" stz $12", "`stz` is not read: an instruction of the 65C02"),
        ] {
            let faults = assemble(source).unwrap_err();
            assert!(
                faults[0].message.starts_with(said),
                "{source}: {}",
                faults[0]
            );
        }
        let faults = assemble_as("FOR n, 0, 3\nEQUD 1\n.x {", Dialect::Beebasm).unwrap_err();
        let said: Vec<&str> = faults.iter().map(|f| f.message.as_str()).collect();
        assert!(said[0].starts_with("`FOR` is not read: a repetition"));
        assert!(said[1].starts_with("`EQUD` is not read: a form of data"));
        assert!(said[2].starts_with("`{` is not read: a scope"));
        // The same words where they mean something here.
        for fine in [
            "if = 1\n lda #if",
            "org: nop",
            "set = 2\n.byte \".proc @x ++\"",
            " lda #1 ; .if",
        ] {
            assert!(assemble(fine).is_ok(), "{fine}");
        }
        // And what is wrong otherwise is said as before.
        assert_eq!(
            assemble(" frob 1").unwrap_err()[0].to_string(),
            "1:2: unknown instruction `frob` (a label needs a colon)"
        );
        assert_eq!(
            assemble(" .byte 1 +").unwrap_err()[0].to_string(),
            "1:11: expected a number, a name, `*` or `(`"
        );
    }
}
