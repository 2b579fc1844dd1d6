#![allow(clippy::unwrap_used)]

use super::*;
use crate::keys::{Script, Unit};
use crate::mos6502::{Run, assemble};

mod picture;
mod slices;
mod timer;

/// A cartridge of 4K that begins at $F000 with this.
fn cart(source: &str) -> Vec<u8> {
    let text = format!("* = $F000\nstart:\n{source}\n");
    let length = assemble(&text).unwrap().bytes.len();
    let text = format!(
        "{text} .res {}, 255\n .word start, start, start\n",
        0xFFA - length
    );
    assemble(&text).unwrap().bytes
}

fn machine(source: &str) -> Vcs {
    let mut machine = Vcs::new();
    machine.load_at(0xF000, &cart(source), None).unwrap();
    machine
}

/// Plays a script, and says what became of it and how many lines the frames had.
fn play(bytes: &[u8], script: &str) -> (Run, Vcs) {
    let mut machine = Vcs::new();
    machine.load_at(0xF000, bytes, None).unwrap();
    let script: Script = script.parse().unwrap();
    machine
        .board
        .plug(Keyboard::new(script, Unit::Frames, |_| None));
    let run = machine.run(10_000_000, &mut |_| true);
    (run, machine)
}

/// A frame of vertical sync in three lines, and so many lines after it, each with this in it;
/// X is the number of lines left.
fn frames(begin: &str, lines: u32, line: &str) -> String {
    format!(
        "{begin}\nframe: lda #2\n sta $02\n sta $00\n sta $02\n sta $02\n sta $02\n lda #0\n sta $00\n \
         ldx #{lines}\nlines: {line}\n sta $02\n dex\n bne lines\n jmp frame\n"
    )
}

#[test]
fn frames_of_262_and_312_lines_are_those_of_the_two_systems() {
    // The sync takes three lines and begins a fourth, which ends with the loop's first.
    let (run, machine) = play(&cart(&frames("", 255, " nop")), "wait 5 quit");
    assert_eq!(machine.frames(), [259; 5]);
    let Stop::Fault(fault) = run.stop else {
        panic!("{:?}", run.stop)
    };
    assert_eq!(
        fault.message,
        "5 of 5 frames have not 262 lines: frame 0 has 259, frame 1 has 259, frame 2 has 259, \
         frame 3 has 259, frame 4 has 259"
    );
    for (inner, lines, name) in [(" sta $02\n", 262, "NTSC"), (" sta $02\n", 312, "PAL")] {
        // 259 - 4 + 2 lines, and 3 or 53 that are waited for behind.
        let rest = lines - 259;
        let source = frames("", 255, " nop").replace(
            "jmp frame",
            &format!("ldx #{rest}\nrest:{inner} dex\n bne rest\n jmp frame"),
        );
        let (run, machine) = play(&cart(&source), "wait 4 quit");
        assert_eq!(machine.frames(), [lines; 4]);
        assert_eq!(run.stop, Stop::Ended);
        let said = String::from_utf8(run.output).unwrap();
        assert_eq!(
            said,
            format!("4 frames, 4 of them of {lines} lines ({name})\n")
        );
        let screen = run.screen.unwrap();
        let height = if name == "PAL" { 288 } else { 240 };
        assert_eq!((screen.width, screen.height), (160, height));
        assert_eq!(screen.palette.len(), 128);
    }
}

/// At the limit of cycles it is said what is wrong with the frames so far.
#[test]
fn frames_that_do_not_come_are_said() {
    let long = frames("", 255, &" sta $02\n".repeat(4));
    for (source, said) in [
        (" jmp start\n", "no vertical sync began in 131"),
        (
            " lda #2\n sta $00\nl: jmp l\n",
            "no vertical sync ended frame 0 in 131",
        ),
        (
            &long,
            "102 of 102 frames have not 312 lines: frame 0 has 1279, frame 1 has 1279, ",
        ),
    ] {
        let (run, _) = play(&cart(source), "wait 500 quit");
        let Stop::Fault(fault) = run.stop else {
            panic!("{:?}", run.stop)
        };
        assert!(fault.message.starts_with(said), "{}", fault.message);
    }
    let sound =
        frames("", 255, " nop").replace("jmp frame", "sta $02\n sta $02\n sta $02\n jmp frame");
    let (run, _) = play(&cart(&sound), "wait 5000 quit");
    assert_eq!(run.stop, Stop::CycleLimit);
}

/// A store to WSYNC that ends with the line's last cycle waits for nothing; one cycle later it
/// costs a whole line.
/// A push into WSYNC, and the next one into VBLANK, by the line's last cycle: the wait is for
/// the end of that line, though a clock of the next one has been drawn.
#[test]
fn a_wait_at_the_end_of_a_line_is_for_no_other() {
    for more in 54..=59 {
        let body = format!(
            " stx $90\n ldx #2\n txs\n{} jsr on\non: ldx $90\n",
            picture::spend(more)
        );
        let (_, machine) = play(&cart(&frames("", 100, &body)), "wait 2 quit");
        // The first turn begins two cycles later in its line.
        let late = u32::from(more > 57);
        assert_eq!(machine.frames(), [4 + 100 * 2 + late; 2], "{more}");
    }
}

#[test]
fn sync_stops_until_the_line_is_over() {
    for more in [20, 64, 65, 66, 70] {
        let body = picture::spend(more);
        let source = format!(
            "frame: lda #2\n sta $02\n sta $00\n lda #0\n sta $00\n ldx #100\n sta $02\nlines:\n{body} \
             dex\n sta $02\n bne far\n jmp frame\nfar: jmp lines\n"
        );
        let (_, machine) = play(&cart(&source), "wait 2 quit");
        // A turn is bne and jmp, which begin a line, then what is spent, dex and sta; the
        // first turn has no bne and no jmp. Before the turns is a line, and one behind.
        let turns = if 6 + more + 5 > 76 { 1 + 99 * 2 } else { 100 };
        assert_eq!(machine.frames(), [turns + 2; 2], "{more}");
    }
}

#[test]
fn cartridges_have_the_sizes_that_there_are() {
    for size in [2048, 4096, 8192, 16384, 32768] {
        let bytes = vec![0xEA; size];
        assert!(Vcs::new().load_at(0xF000, &bytes, None).is_ok(), "{size}");
    }
    for size in [1, 100, 4095, 12288, 65536] {
        let bytes = vec![0xEA; size];
        let fault = Vcs::new().load_at(0xF000, &bytes, None).unwrap_err();
        assert!(fault.message.contains("F8"), "{}", fault.message);
    }
}

/// Every hotspot of every kind brings its own bank.
#[test]
fn hotspots_choose_banks() {
    for (banks, spot) in [(2u8, 0xFFF8u16), (4, 0xFFF6), (8, 0xFFF4)] {
        let mut rom = Vec::new();
        for bank in 0..banks {
            // Look at each hotspot, and keep what number stands in its bank.
            let mut text = "* = $F000\nstart:\n".to_owned();
            for other in 0..banks {
                let access = if other % 2 == 0 { "bit" } else { "sta" };
                let at = spot + u16::from(other);
                text.push_str(&format!(
                    " {access} ${at:04X}\n lda $F800\n sta {}\n",
                    0x80 + other
                ));
            }
            text.push_str("stays: jmp stays\n");
            let length = assemble(&text).unwrap().bytes.len();
            text.push_str(&format!(
                " .res {}\n .byte {bank}\n .res {}\n .word start, start, start\n",
                0x800 - length,
                0xFFA - 0x801
            ));
            rom.extend(assemble(&text).unwrap().bytes);
        }
        let mut machine = Vcs::new();
        machine.load_at(0xF000, &rom, None).unwrap();
        assert_eq!(machine.cartridge(), (false, usize::from(banks)));
        machine.run(1000, &mut |_| true);
        for bank in 0..banks {
            assert_eq!(machine.peek(0x80 + u16::from(bank)), bank, "{banks} banks");
        }
    }
}

#[test]
fn a_superchip_stores_below_and_reads_above() {
    let program = " lda #$12\n sta $F005\n lda #$34\n sta $F07F\n lda $F085\n sta $80\n lda $F0FF\n \
                   sta $81\n lda #$56\n ldx $F005\n lda $F085\n sta $82\nstays: jmp stays\n";
    let text = format!("* = $F000\n .res 256\nstart:\n{program}");
    let length = assemble(&text).unwrap().bytes.len();
    let text = format!(
        "{text} .res {}\n .word start, start, start\n",
        0xFFA - length
    );
    let mut machine = Vcs::new();
    machine
        .load_at(0xF000, &assemble(&text).unwrap().bytes, None)
        .unwrap();
    assert_eq!(machine.cartridge(), (true, 1));
    machine.run(200, &mut |_| true);
    // A read of the half that stores puts there what was on the lines: the address' high byte.
    assert_eq!(
        [0x80, 0x81, 0x82].map(|at| machine.peek(at)),
        [0x12, 0x34, 0xF0]
    );
    // The same without the empty bytes has no such memory.
    assert_eq!(machine_kind(&cart(program)), (false, 1));
}

fn machine_kind(bytes: &[u8]) -> (bool, usize) {
    let mut machine = Vcs::new();
    machine.load_at(0xF000, bytes, None).unwrap();
    machine.cartridge()
}

#[test]
fn memory_appears_many_times_over() {
    let mut machine = machine(
        " lda #$5A\n sta $80\n lda $0180\n sta $81\n lda $2D80\n sta $82\n lda $4A80\n sta $83\n \
         lda #7\n pha\n lda $FF\n sta $84\n lda $D001\n sta $85\nstays: jmp stays\n",
    );
    machine.run(200, &mut |_| true);
    let found = [0x81, 0x82, 0x83, 0x84, 0x85].map(|at| machine.peek(at));
    // $4A80 has A9 set: the RIOT's ports, SWCHA.
    assert_eq!(found, [0x5A, 0x5A, 0xFF, 7, 0x5A]);
}

#[test]
fn the_script_holds_the_stick_and_the_button() {
    // Each frame keeps SWCHA and INPT4 in memory, one behind the other.
    let line = " nop";
    let source = frames(" ldy #0", 250, line).replace(
        "jmp frame",
        "lda $0280\n sta $0080,y\n lda $0C\n and #$80\n sta $00C0,y\n iny\n jmp frame",
    );
    let script = "up down left right space wait 1 quit";
    let (_, machine) = play(&cart(&source), script);
    let stick: Vec<u8> = (0x80..0x8A).map(|at| machine.peek(at)).collect();
    assert_eq!(
        stick,
        [0xEF, 0xFF, 0xDF, 0xFF, 0xBF, 0xFF, 0x7F, 0xFF, 0xFF, 0xFF]
    );
    let fire: Vec<u8> = (0xC0..0xCA).map(|at| machine.peek(at)).collect();
    assert_eq!(fire, [128, 128, 128, 128, 128, 128, 128, 128, 0, 128]);
}
