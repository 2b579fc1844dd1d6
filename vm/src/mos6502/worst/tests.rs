#![allow(clippy::unwrap_used)]

use super::*;
use crate::Stop;
use crate::mos6502::{Plain, assemble};
use proptest::prelude::*;

/// A program that ends at `end`, in what it takes at most by its text.
fn asked(source: &str) -> (Result<u64, Unknown>, Assembly) {
    let text = format!("* = $0800\n{source}\nend_: lda #0\n sta $FF0A\n");
    let assembly = assemble(&text).unwrap();
    let question = Question {
        assembly: &assembly,
        ram: 0..=0xFF,
        mirrored: false,
        turns: Question::turns_of(&assembly, &text),
        ends: BTreeSet::from([assembly.symbols["end_"] as u16]),
        exit: None,
    };
    (question.worst(assembly.origin), assembly)
}

fn worst(source: &str) -> u64 {
    asked(source).0.unwrap()
}

fn refused(source: &str) -> Why {
    asked(source).0.unwrap_err().why
}

/// What the machine takes to `end`, with these bytes from $70 on.
fn taken(source: &str, bytes: &[u8]) -> u64 {
    let assembly = asked(source).1;
    let mut machine = Plain::new();
    machine.load(&assembly.image()).unwrap();
    for (at, byte) in (0x70..).zip(bytes) {
        machine.poke(at, *byte);
    }
    let run = machine.run(10_000_000, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended, "{source}");
    // The two instructions at the end.
    run.cycles - 6
}

/// The most that any byte at $70 makes it take.
fn most(source: &str) -> u64 {
    (0..=255).map(|byte| taken(source, &[byte])).max().unwrap()
}

#[test]
fn straight_code_is_added_up() {
    let source = " cld\n ldx #3\n lda $70\n sta $71\n adc $1234\n sta $2000,x\n inc $70\n asl\n \
                  lda ($72),y\n ldy #0\n lda ($72),y\n sta ($72),y\n pha\n php\n plp\n pla\n jmp on\n nop\n\
                  on: lda $20F0,x\n lda $20FE,x\n lax $70\n";
    assert_eq!(worst(source), taken(source, &[0; 8]) + 1);
    // Only the first of the three `(zp),y` may cross: its index is not known.
    assert_eq!(
        worst(source),
        taken(
            source.replace("($72),y\n ldy", "$20FF,x\n ldy").as_str(),
            &[]
        ) + 1
    );
}

#[test]
fn an_index_crosses_a_page_where_it_may() {
    let source = " ldx $70\n lda $2081,x\n";
    assert_eq!(worst(source), most(source));
    assert_eq!(worst(source), taken(source, &[0]) + 1);
    // At a page's beginning none does, and one that is known either does or not.
    for source in [
        " ldx $70\n lda $2000,x\n",
        " ldx #9\n lda $20F1,x\n",
        " ldx #200\n lda $2081,x\n",
    ] {
        assert_eq!(worst(source), most(source));
        assert_eq!(worst(source), taken(source, &[0]), "{source}");
    }
}

#[test]
fn a_branch_costs_more_into_another_page() {
    for pad in 0..12 {
        let source = format!(
            " jmp on\n .res {}\non: lda $70\n beq over\n nop\nover: lda #1\n bne far\n nop\nfar: nop\n",
            0xF0 + pad
        );
        assert_eq!(worst(&source), most(&source), "{pad}");
    }
}

#[test]
fn of_two_ways_the_longer_counts() {
    let source = " lda $70\n bmi minus\n ldx #5\none: dex\n bne one\n jmp done\nminus: ldx #9\ntwo: dex\n \
                  bne two\ndone: nop\n";
    assert_eq!(worst(source), most(source));
    // What a branch has asked is known behind it.
    let source = " lda $70\n beq none\n bne some\n jsr never\nsome: nop\nnone: nop\n jmp end_\nnever: jmp never\n";
    assert_eq!(worst(source), most(source));
}

#[test]
fn counters_that_are_known_are_counted() {
    for source in [
        " ldx #0\nl: inx\n cpx #9\n bne l\n",
        " ldy #7\nl: nop\n dey\n bpl l\n",
        " lda #5\n sta $80\nl: ldx #4\nm: dex\n bne m\n dec $80\n bne l\n",
        " lda #0\n sta $80\nl: lda $80\n clc\n adc #3\n sta $80\n cmp #30\n bcc l\n",
        " lda #1\nl: asl\n bcc l\n",
        " ldx #2\nl: txa\n pha\n ldx #200\nm: inx\n bne m\n pla\n tax\n dex\n bpl l\n",
    ] {
        let found = asked(source).0;
        // A counter that was on the stack is not known any more.
        if source.contains("pla") {
            assert_eq!(found.unwrap_err().why, Why::Loop);
        } else {
            assert_eq!(found, Ok(taken(source, &[])), "{source}");
        }
    }
    // A store through a pointer may have been to the counter.
    let stores = " lda #5\n sta $80\nl: sta ($70),y\n dec $80\n bne l\n";
    assert_eq!(refused(stores), Why::Loop);
}

#[test]
fn other_loops_take_what_they_are_said_to_take() {
    let shift = " lda $70\n ora #1\nl: ; at most 8 turns\n asl\n bcc l\n";
    assert_eq!(worst(shift), most(shift));
    let inner = " lda $70\n and #3\n sta $71\n ldy #3\nouter: ldx $71\nl: ; at most 4 turns\n nop\n dex\n \
                 bpl l\n dey\n bne outer\n";
    assert_eq!(worst(inner), most(inner));
    // Each turn counts as the longest, though no two may be.
    let ways = " ldx #0\n ldy $70\nl: ; at most 3 turns\n tya\n beq skip\n nop\n nop\n ldy #0\nskip: inx\n cpx #3\n \
                bne l\n";
    assert_eq!(worst(ways), most(ways) + 2 * 5);
    assert_eq!(refused(&shift.replace("; at most 8 turns", "")), Why::Loop);
}

/// Of a loop that is entered in its middle, the block that is said to be come to so often is the
/// head, wherever it is.
#[test]
fn loops_that_are_entered_in_their_middle_count_by_the_block_that_is_bounded() {
    let source = " lda $70\n and #7\n tax\n and #1\n beq m\nl: nop\n nop\nm: ; at most 8 turns\n dex\n bpl l\n";
    assert_eq!(worst(source), most(source));
    // Counted where the other way comes in: the first turn of the longest way begins there.
    let other = source
        .replace("m: ; at most 8 turns", "m:")
        .replace("l: nop", "l: ; at most 8 turns\n nop");
    assert_eq!(worst(&other), most(source) + (3 - 2) + 2 + 3);
}

#[test]
fn calls_are_what_they_call() {
    let source = " ldx #3\n jsr wait\n ldx #6\n jsr wait\n jsr twice\n jmp end_\ntwice: ldx #1\n jsr wait\n \
                  ldx #2\nwait: dex\n bne wait\n rts\n";
    assert_eq!(worst(source), taken(source, &[]));
    // A routine by itself: to its return.
    let (_, assembly) = asked(source);
    let question = Question {
        assembly: &assembly,
        ram: 0..=0xFF,
        mirrored: false,
        turns: BTreeMap::new(),
        ends: BTreeSet::new(),
        exit: None,
    };
    let entry = assembly.symbols["twice"] as u16;
    assert_eq!(
        question.worst(entry),
        Ok(2 + 6 + (2 + 2) + 6 + 2 + (2 + 3) + (2 + 2) + 6)
    );
}

/// To the store that ends the program, though it goes on behind that.
#[test]
fn a_store_may_be_the_end() {
    let source = " lda $70\n bne on\n jsr quit\non: ldx #4\n jsr wait\n lda #0\n sta $FF0A\nwait: dex\n bne wait\n \
                  rts\nquit: lda #0\n sta $FF0A\n";
    let assembly = asked(source).1;
    let question = Question {
        assembly: &assembly,
        ram: 0..=0xFF,
        mirrored: false,
        turns: BTreeMap::new(),
        ends: BTreeSet::new(),
        exit: Some(0xFF0A),
    };
    // `taken` leaves out the two last instructions.
    assert_eq!(question.worst(assembly.origin), Ok(most(source) + 6));
}

/// Between the places where it asks; a loop that asks in every turn needs no bound.
#[test]
fn slices_are_as_long_as_the_longest_between_two_asks() {
    let slices = |source: &str| {
        let text = format!("* = $0800\nstart:\n{source}\nask: rts\n");
        let assembly = assemble(&text).unwrap();
        let names = ["one", "two"];
        let at = |name: &&str| assembly.symbols.get(*name).map(|at| *at as u16);
        let question = Question {
            assembly: &assembly,
            ram: 0..=0xFF,
            mirrored: false,
            turns: Question::turns_of(&assembly, &text),
            ends: names.iter().filter_map(at).collect(),
            exit: None,
        };
        question.slices(assembly.origin)
    };
    let found = slices(
        " ldx $70\nl: lda $71\none: jsr ask\n nop\n dex\n bne l\n ldy #3\nm: dey\n bne m\ntwo: jsr ask\n jmp l\n",
    );
    // From one to two: nop, dex, bne, and the loop of three turns.
    assert_eq!(found, Ok(2 + 2 + 2 + 2 + 3 * 5 - 1));
    let without = slices("one: jsr ask\n ldx $70\nl: dex\n bne l\n jmp one\n").unwrap_err();
    assert_eq!(without.why, Why::Loop);
    let returns = slices("one: jsr ask\n rts\n").unwrap_err();
    assert_eq!(returns.why, Why::Returns);
}

#[test]
fn what_has_no_answer_is_refused() {
    for (source, why) in [
        ("l: jmp l\n", Why::Loop),
        (" jmp ($70)\n", Why::Jump),
        (" brk\n", Why::Jump),
        (" sta on\non: nop\n", Why::Modifies),
        (" sta on,x\non: nop\n", Why::Modifies),
        (" pla\n", Why::Stack),
        (" jsr one\n jmp end_\none: pha\n rts\n", Why::Stack),
        (" lda $70\n beq one\n pha\none: nop\n", Why::Stack),
        (" ldx #$80\n txs\n", Why::Stack),
        (" sed\n", Why::Decimal),
        (" lda #8\n pha\n plp\n", Why::Decimal),
        (" sta $01F0\n", Why::Stack),
        (" ldy $70\n sta $00F0,y\n", Why::Stack),
        (
            " ldx #$FF\n jsr one\n jmp end_\none: txs\n rts\n",
            Why::Stack,
        ),
        (" ldx $70\n sta $0790,x\n", Why::Modifies),
        (" jsr one\none: jsr one\n rts\n", Why::Depth),
        (" lda $70\n beq m\nl: inx\nm: dey\n bne l\n", Why::Irregular),
        (" .byte 2\n", Why::Instruction),
        (" .byte $8B, 1\n", Why::Instruction),
        (" jmp $4000\n", Why::Instruction),
        (
            " ldy #0\nj: ldx #0\nk: lda #0\nl: sec\n adc #0\n bne l\n inx\n bne k\n iny\n bne j\n",
            Why::Fuel,
        ),
    ] {
        assert_eq!(refused(source), why, "{source}");
    }
    let unknown = asked(" ldx #1\nl: lda $70\n bne l\n").0.unwrap_err();
    assert_eq!(unknown.address, 0x802);
}

/// Where the stack is in the zero page, what is pushed may be in no counter's place, nor may a
/// store be in that of a return.
#[test]
fn a_stack_in_the_zero_page_is_kept_apart() {
    let asked = |source: &str| {
        let assembly = assemble(&format!("* = $0800\n{source} rts\n")).unwrap();
        let question = Question {
            assembly: &assembly,
            ram: 0x80..=0xFF,
            mirrored: true,
            turns: BTreeMap::new(),
            ends: BTreeSet::new(),
            exit: None,
        };
        question
            .worst(assembly.origin)
            .map_err(|unknown| unknown.why)
    };
    let counter = |at: &str, body: &str| {
        asked(&format!(
            " lda #5\n sta {at}\nl: {body}\n dec {at}\n bne l\n jmp over\none: lda #1\n sta $90,x\n rts\nover:\n"
        ))
    };
    assert!(counter("$FC", "pha\n pha\n pla\n pla").is_ok());
    assert_eq!(counter("$FE", "pha\n pha\n pla\n pla"), Err(Why::Loop));
    assert!(counter("$FC", "ldx #3\n jsr one").is_ok());
    assert_eq!(counter("$FE", "ldx #3\n jsr one"), Err(Why::Loop));
    assert_eq!(counter("$FC", "ldx $98\n jsr one"), Err(Why::Stack));
    assert_eq!(counter("$FC", "ldx #$6E\n jsr one"), Err(Why::Stack));
}

/// A piece of a program, nested as deep as `depth`; `name` makes its labels its own.
fn piece(seed: &mut impl FnMut(usize) -> usize, depth: usize, name: &str) -> String {
    let simple = [
        " lda $70\n",
        " lda $71\n",
        " eor $72\n",
        " adc #$35\n",
        " sbc $73\n",
        " sta $72\n",
        " asl\n",
        " ror $70\n",
        " inc $71\n",
        " dec $73\n",
        " cmp $71\n",
        " tay\n",
        " lda $20F0,y\n",
        " ldy $70\n",
        " lda ($74),y\n",
        " sta $2080,y\n",
        " bit $72\n",
        " lsr\n",
        " rol $73\n",
        " slo $71\n",
    ];
    let branches = ["beq", "bne", "bcc", "bcs", "bpl", "bmi", "bvc", "bvs"];
    let mut text = String::new();
    for k in 0..1 + seed(4) {
        let own = format!("{name}_{k}");
        text.push_str(&match seed(if depth == 0 { 3 } else { 6 }) {
            0..3 => simple[seed(simple.len())].to_owned(),
            3 => {
                let (one, other) = (piece(seed, depth - 1, &format!("{own}a")), piece(seed, depth - 1, &format!("{own}b")));
                let branch = branches[seed(branches.len())];
                format!(" {branch} t{own}\n jmp e{own}\nt{own}:\n{one} jmp d{own}\ne{own}:\n{other}d{own}:\n")
            }
            4 => {
                // A counter that nobody else has.
                let (body, turns) = (piece(seed, depth - 1, &own), 1 + seed(4));
                let at = 0x80 + depth;
                format!(" ldx #{turns}\n stx ${at:02x}\nl{own}:\n{body} dec ${at:02x}\n beq o{own}\n jmp l{own}\no{own}:\n")
            }
            _ => {
                // As many turns as the lower bits of a byte say, in a counter.
                let body = piece(seed, depth - 1, &own);
                let at = 0x90 + depth;
                format!(" lda $70\n and #3\n sta ${at:02x}\nl{own}: ; at most 4 turns\n{body} dec ${at:02x}\n bmi o{own}\n jmp l{own}\no{own}:\n")
            }
        });
    }
    text
}

proptest! {
    /// No program takes longer than is said, whatever it is given.
    #[test]
    fn no_run_takes_longer(seeds in prop::collection::vec(0usize..1000, 60), bytes in prop::collection::vec(any::<[u8; 6]>(), 8)) {
        let mut at = 0;
        let mut seed = |below: usize| {
            at += 1;
            (seeds[at % seeds.len()] + at / seeds.len()) % below
        };
        let source = piece(&mut seed, 3, "p");
        let bound = worst(&source);
        for mut bytes in bytes {
            // The pointer is to where nothing else is.
            bytes[5] = 0x30;
            let taken = taken(&source, &bytes);
            prop_assert!(taken <= bound, "{taken} of {bound}:\n{source}");
        }
    }
}
