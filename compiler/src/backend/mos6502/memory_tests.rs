#![allow(clippy::unwrap_used)]

use super::tests::{GRADIENT, planned};
use crate::targets::{find, formats};

/// A plain machine's program begins at a page, and nothing else is in the three bytes before.
#[test]
fn the_jump_over_the_squares_has_room() {
    let plan = planned(GRADIENT);
    for (values, errors, origin) in [
        (0, 0, 0x300),
        (0xFD, 0, 0x300),
        (0xFE, 0, 0x400),
        (0x101, 0, 0x400),
        (0, 0x100, 0x400),
        (1, 0x100, 0x500),
    ] {
        let places = super::memory::Machine::Plain.places(&plan, values, errors);
        assert_eq!(places.origin, origin, "{values:x}, {errors:x}");
        assert_eq!(places.errors & 0xFF, 0);
        let end = match errors {
            0 => places.values + values,
            _ => places.errors + errors,
        };
        assert!(end + super::memory::JUMP <= origin);
    }
}

/// Every place in the zero page moves with the others, whatever part names it.
#[test]
fn the_runtimes_zero_page_may_stand_elsewhere() {
    for target in ["6502:plain", "6502:c64"] {
        let runtimes = formats(find(target).unwrap());
        for part in runtimes.flat_map(|t| t.runtime.parts) {
            let slowlight_routine::Source::Text(lines) = part.source else {
                continue;
            };
            let moved = super::memory::Machine::C64.placed(lines);
            for (line, moved) in lines.lines().zip(moved.lines()) {
                let address = |line: &str| {
                    let (_, rest) = line.split_once(" = $")?;
                    let digits = rest.split(' ').next()?;
                    u16::from_str_radix(digits, 16).ok()
                };
                // A number that is no symbol's would stay where it is, as bytes of tables shall.
                let code = line.split(';').next().unwrap_or_default();
                let plain = code.contains(" $") && address(line).is_none();
                let plain = plain && !code.contains(" .byte ");
                assert!(!plain, "{}: {line}", part.name);
                match address(line) {
                    Some(at) if at < 0x100 => assert_eq!(address(moved), Some(at + 2)),
                    Some(_) => assert!(address(moved) >= Some(0xC000)),
                    None => assert_eq!(line, moved),
                }
            }
        }
    }
}
