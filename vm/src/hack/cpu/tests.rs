//! The engines agree, and what programs do is what the book says.
#![allow(clippy::unwrap_used)]

use super::Cpu;
use crate::Stop;
use crate::hack::asm::assemble;
use proptest::prelude::*;

fn cpu(source: &str) -> Cpu {
    Cpu::new(&assemble(source).unwrap().words).unwrap()
}

/// Runs on both engines, which must agree in everything; answers the fast one.
fn both(rom: &[u16], limits: &[u64]) -> Cpu {
    let mut fast = Cpu::new(rom).unwrap();
    let mut plain = Cpu::new(rom).unwrap();
    for limit in limits {
        let run = fast.run(*limit, &mut |_| true);
        assert_eq!(run, plain.run_plain(*limit, &mut |_| true));
        assert!(run.cycles <= *limit.max(limits.first().unwrap()));
        assert_eq!(fast.registers, plain.registers);
        assert_eq!(fast.memory, plain.memory);
    }
    fast
}

/// What each computation of two words leaves in D.
#[test]
fn computations() {
    type Meaning = fn(i16, i16) -> i16;
    let meanings: [(&str, Meaning); 18] = [
        ("0", |_, _| 0),
        ("1", |_, _| 1),
        ("-1", |_, _| -1),
        ("D", |d, _| d),
        ("A", |_, a| a),
        ("!D", |d, _| !d),
        ("!A", |_, a| !a),
        ("-D", |d, _| d.wrapping_neg()),
        ("-A", |_, a| a.wrapping_neg()),
        ("D+1", |d, _| d.wrapping_add(1)),
        ("A+1", |_, a| a.wrapping_add(1)),
        ("D-1", |d, _| d.wrapping_sub(1)),
        ("A-1", |_, a| a.wrapping_sub(1)),
        ("D+A", |d, a| d.wrapping_add(a)),
        ("D-A", |d, a| d.wrapping_sub(a)),
        ("A-D", |d, a| a.wrapping_sub(d)),
        ("D&A", |d, a| d & a),
        ("D|A", |d, a| d | a),
    ];
    let words = [0, 1, 2, 255, 256, 12_345, 32_767];
    for (comp, meaning) in meanings {
        for (d, a) in words
            .iter()
            .flat_map(|d| words.iter().map(move |a| (*d, *a)))
        {
            for (sign_d, sign_a) in [("", ""), ("-", ""), ("", "-"), ("-", "-")] {
                let signed = |sign: &str, x: i16| if sign.is_empty() { x } else { -x };
                let expected = meaning(signed(sign_d, d), signed(sign_a, a));
                let of_memory = comp.replace('A', "M");
                let start = format!("@{a}\nD={sign_a}A\n@7\nM=D\n@{d}\nD={sign_d}A\n");
                for rest in [format!("@7\nA=M\nD={comp}"), format!("@7\nD={of_memory}")] {
                    let source = format!("{start}{rest}\n@8\nM=D\n(E)\n@E\n0;JMP");
                    let rom = assemble(&source).unwrap().words;
                    let run = both(&rom, &[1000]);
                    assert_eq!(run.peek(8), expected, "{comp} of {d} and {a}");
                }
            }
        }
    }
}

#[test]
fn jumps() {
    for (jump, of) in [
        ("JGT", [false, false, true]),
        ("JEQ", [false, true, false]),
        ("JGE", [false, true, true]),
        ("JLT", [true, false, false]),
        ("JNE", [true, false, true]),
        ("JLE", [true, true, false]),
        ("JMP", [true, true, true]),
    ] {
        for (value, jumps) in ["-1", "0", "1"].iter().zip(of) {
            let source = format!("D={value}\n@5\nM=1\n@T\nD;{jump}\n@5\nM=0\n(T)\n@T\n0;JMP");
            let rom = assemble(&source).unwrap().words;
            assert_eq!(both(&rom, &[100]).peek(5) == 1, jumps, "{value};{jump}");
        }
    }
}

/// The address that is stored to and jumped to is A's of before.
#[test]
fn the_old_address_counts() {
    let rom = assemble("@100\nAMD=A+1\n@9\nM=D\n@E\nA=0;JMP\n@9\nM=0\n(E)\n@E\n0;JMP");
    let run = both(&rom.unwrap().words, &[100]);
    assert_eq!((run.peek(100), run.peek(101), run.peek(9)), (101, 0, 101));
}

#[test]
fn a_program_ends_where_it_only_jumps_to_itself() {
    let mut ends = cpu("@3\nD=A\n(E)\n@E\n0;JMP");
    let run = ends.run(1_000_000, &mut |_| true);
    assert_eq!((run.stop, run.cycles), (Stop::Ended, 2));
    // These count, so they do not end.
    for source in [
        "(E)\n@E\nD=D+1;JMP",
        "(E)\nD=D+1\n@E\n0;JMP",
        "(E)\n@E\nD;JEQ",
    ] {
        let run = cpu(source).run(100_000, &mut |_| true);
        assert_eq!(
            (run.stop, run.cycles),
            (Stop::CycleLimit, 100_000),
            "{source}"
        );
    }
}

#[test]
fn running_past_the_end_is_a_fault() {
    let run = cpu("@3\nD=A").run(100, &mut |_| true);
    let Stop::Fault(fault) = run.stop else {
        panic!("{:?}", run.stop);
    };
    assert_eq!(
        fault.message,
        "the program has no instruction 2: its last is 1"
    );
    let Stop::Fault(fault) = cpu("@9\n0;JMP").run(100, &mut |_| true).stop else {
        panic!();
    };
    assert!(fault.message.contains("no instruction 9"));
    assert!(Cpu::new(&[0; 32_769]).is_err());
    let full = Cpu::new(&[0; 32_768]).unwrap().run(100_000, &mut |_| true);
    assert_eq!(full.stop, Stop::CycleLimit);
}

#[test]
fn screen_keyboard_and_watcher() {
    let source = "@KBD\nD=M\n@SCREEN\nM=D\n@16415\nM=-1\n@100\nD=A\n(L)\n@20451\nM=D\n@L\nD;JMP";
    let mut cpu = cpu(source);
    cpu.press(5);
    let mut rows = Vec::new();
    let run = cpu.run(200_000_000, &mut |now| {
        rows.push(now.row);
        rows.len() < 2
    });
    assert_eq!(run.stop, Stop::Interrupted);
    assert_eq!(rows, [Some(127), Some(127)]);
    let dark: Vec<usize> = (0..1024).filter(|k| run.screen.pixels[*k] == 0).collect();
    let last: Vec<usize> = (496..512).collect();
    assert_eq!(dark, [&[0, 2], &last[..]].concat());
    assert_eq!((run.screen.width, run.screen.height), (512, 256));
}

/// Instructions as programs have them; those of two words begin with a number.
const USUAL: [&str; 52] = [
    "D=M", "M=D", "A=A+1", "A=A-1", "D=0", "A=M", "A=D", "0;JMP", "M=0", "@ D=M", "@ D=M", "@ D=M",
    "@ D=A", "@ D=A", "@ M=D", "@ M=D", "@ M=D", "@ D=D+M", "@ D=D-M", "@ D=M-D", "@ D=D&M",
    "@ D=D|M", "@ D=D+A", "@ D=D-A", "@ D=D&A", "@ D=M+1", "@ D=M-1", "@ D=!M", "@ D=-M", "@ M=0",
    "@ M=1", "@ M=-1", "@ M=M+1", "@ M=M-1", "@ M=D+M", "@ M=M-D", "@ MD=M+1", "@ MD=M-1",
    "@ MD=D+M", "@ MD=M-D", "@ A=M", "@ A=M+1", "@ A=M-1", "@ A=D+M", "@ AM=M+1", "@ AM=M-1",
    "@ D;JLT", "@ D;JLE", "@ D;JEQ", "@ D;JNE", "@ D;JGE", "@ D;JGT",
];

/// Programs that go on for a while: usual instructions, and some of any kind.
fn program() -> impl Strategy<Value = Vec<u16>> {
    let address = prop_oneof![8 => 0..40u16, 1 => Just(16_384u16), 1 => any::<u16>()];
    let usual = (prop::sample::select(USUAL.to_vec()), address.clone()).prop_map(|(text, at)| {
        let text = text.replace("@ ", &format!("@{}\n", at & 0x7fff));
        assemble(&text).unwrap().words
    });
    let part = prop_oneof![
        20 => usual,
        1 => address.prop_map(|a| vec![a & 0x7fff]),
        1 => any::<u16>().prop_map(|w| vec![(w | 0xe000) & !7]),
        1 => any::<u16>().prop_map(|w| vec![w]),
    ];
    prop::collection::vec(part, 1..40).prop_map(|parts| parts.concat())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn the_engines_agree(rom in program(), first in 0..50u64, more in 0..400u64) {
        both(&rom, &[first, first + more]);
    }
}
