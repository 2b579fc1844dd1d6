//! Our arithmetic against the genuine BASIC II, on operands that anyone can make again.
//!
//! The operands come from `rom_operations.rs`; `tests/rom/` has what the ROM made of them,
//! recorded under jsbeeb by `peers_jsbeeb.rs`, which also checks that the files are still what
//! the ROM says. So these tests need no ROM.
#![allow(clippy::unwrap_used)]

use crate::rom_operations::{Gives, OPERATIONS, Operands, Operation, error_bytes};
use slowlight_isa::real40::text::{NumberFormat, Parsed, Style, parse, to_text};
use slowlight_isa::real40::{Real40, RealError, arith, elementary};
use slowlight_vm::Stop;
use slowlight_vm::bbc::{Config, Machine};

/// BASIC II's number of an error of arithmetic.
fn number(e: RealError) -> u8 {
    match e {
        RealError::DivisionByZero => 18,
        RealError::TooBig => 20,
        RealError::NegativeRoot => 21,
        RealError::LogRange => 22,
        RealError::AccuracyLost => 23,
        RealError::ExpRange => 24,
    }
}

fn real_or_error(result: Result<Real40, RealError>) -> Vec<u8> {
    match result {
        Ok(x) => x.to_bytes().to_vec(),
        Err(e) => error_bytes(Gives::Real, number(e)),
    }
}

fn int_or_error(result: Result<i32, RealError>) -> Vec<u8> {
    match result {
        Ok(n) => n.to_le_bytes().to_vec(),
        Err(e) => error_bytes(Gives::Int, number(e)),
    }
}

/// What our reals make of a case; `None` for what only the interpreter does.
fn ours(name: &str, operands: &Operands) -> Option<Vec<u8>> {
    let truth = |b: bool| Some((-i32::from(b)).to_le_bytes().to_vec());
    match operands {
        Operands::Reals(a, b) => {
            let (a, b) = (*a, *b);
            Some(match name {
                "add" => real_or_error(arith::add(a, b)),
                "sub" => real_or_error(arith::sub(a, b)),
                "mul" => real_or_error(arith::mul(a, b)),
                "div" => real_or_error(arith::div(a, b)),
                "sqr" => real_or_error(arith::sqrt(a)),
                "sin" => real_or_error(elementary::sin(a)),
                "cos" => real_or_error(elementary::cos(a)),
                "tan" => real_or_error(elementary::tan(a)),
                "atn" => real_or_error(elementary::atn(a)),
                "exp" => real_or_error(elementary::exp(a)),
                "ln" => real_or_error(elementary::ln(a)),
                "pow" => real_or_error(elementary::pow(a, b)),
                "asn" => real_or_error(elementary::asn(a)),
                "acs" => real_or_error(elementary::acs(a)),
                "log" => real_or_error(elementary::log10(a)),
                "int" => real_or_error(a.int_floor().map(Real40::from_i32)),
                "whole" => int_or_error(a.to_i32()),
                "print" => to_text(
                    a,
                    NumberFormat {
                        style: Style::General,
                        digits: 9,
                        width: 10,
                    },
                )
                .into_bytes(),
                "str" => to_text(a, NumberFormat::STR).into_bytes(),
                "less" => return truth(a < b),
                "equal" => return truth(a == b),
                "greater_equal" => return truth(a >= b),
                _ => return None,
            })
        }
        Operands::Text(text) => Some(real_or_error(match parse(text.as_bytes()) {
            Ok(Some((Parsed::Int(n), _))) => Ok(Real40::from_i32(n)),
            Ok(Some((Parsed::Real(x), _))) => Ok(x),
            Ok(None) => Ok(Real40::ZERO),
            Err(e) => Err(e),
        })),
        Operands::Ints(..) => None,
    }
}

/// What our interpreter makes of integers: a hundred to a program, in hexadecimal.
fn interpreted(operation: &Operation, cases: &[Operands]) -> Vec<Vec<u8>> {
    let mut results = Vec::new();
    for chunk in cases.chunks(100) {
        let mut program = String::from("1ON ERROR PRINT \"E\";ERR:GOTO L%\n");
        for (i, case) in chunk.iter().enumerate() {
            if let Operands::Ints(a, b) = case {
                let line = 10 * i + 10;
                program += &format!(
                    "{line}L%={}:A%={a}:B%={b}:{}:PRINT ~C%\n",
                    line + 10,
                    operation.statement
                );
            }
        }
        program += &format!("{}END\n", 10 * chunk.len() + 10);
        let mut machine = Machine::new(Config::default());
        machine.load_text(&program).unwrap();
        let run = machine.run(1_000_000_000, &mut |_| true);
        assert_eq!(run.stop, Stop::Ended, "{program}");
        let lines = run.text.lines().map(str::trim).filter(|l| !l.is_empty());
        results.extend(lines.map(|line| {
            match line.strip_prefix("E") {
                Some(n) if n.len() == 2 && n.parse::<u8>().is_ok_and(|n| n == 18 || n == 20) => {
                    error_bytes(Gives::Int, n.parse().unwrap())
                }
                _ => u32::from_str_radix(line, 16)
                    .unwrap()
                    .to_le_bytes()
                    .to_vec(),
            }
        }));
    }
    results
}

/// The recorded results.
fn recorded(operation: &Operation) -> Vec<Vec<u8>> {
    let bytes = std::fs::read(operation.file()).unwrap();
    match operation.gives {
        Gives::Real => bytes.chunks(5).map(<[u8]>::to_vec).collect(),
        Gives::Int => bytes.chunks(4).map(<[u8]>::to_vec).collect(),
        Gives::Text => bytes.split(|b| *b == 13).map(<[u8]>::to_vec).collect(),
    }
}

fn find(name: &str) -> &'static Operation {
    OPERATIONS.iter().find(|o| o.name == name).unwrap()
}

/// Cases in which we differ from the ROM, and how many there are.
fn differences(name: &str) -> (Vec<String>, usize) {
    let operation = find(name);
    let cases = operation.cases();
    let rom = recorded(operation);
    assert_eq!(rom.len(), cases.len(), "{name}");
    let ours: Vec<Vec<u8>> = match cases[0] {
        Operands::Ints(..) => interpreted(operation, &cases),
        _ => cases.iter().map(|c| ours(name, c).unwrap()).collect(),
    };
    assert_eq!(ours.len(), cases.len(), "{name}");
    // Between 2^-129 and 2^-128 the ROM has numbers whose exponent byte is 0; here they are zero.
    let zero = |rom: &Vec<u8>| match operation.gives {
        Gives::Real if rom[0] == 0 && rom[1..4] != [0xee; 3] => vec![0; 5],
        _ => rom.clone(),
    };
    let rom: Vec<Vec<u8>> = rom.iter().map(zero).collect();
    let triples = cases.iter().zip(&ours).zip(&rom);
    let wrong = triples.filter(|((_, ours), rom)| ours != rom);
    let show = |bytes: &[u8]| match operation.gives {
        Gives::Text => String::from_utf8_lossy(bytes).into_owned(),
        _ => bytes.iter().map(|b| format!("{b:02x}")).collect(),
    };
    let list = wrong.map(|((case, ours), rom)| {
        format!("{case:?}: ours {}, the ROM's {}", show(ours), show(rom))
    });
    (list.collect(), cases.len())
}

fn agrees(names: &[&str]) {
    for name in names {
        let (wrong, count) = differences(name);
        println!("{name}: {} of {count} differ", wrong.len());
        assert!(
            wrong.is_empty(),
            "{name}: {} of {count}\n{}",
            wrong.len(),
            wrong[..wrong.len().min(20)].join("\n")
        );
    }
}

#[test]
fn sums_products_quotients_and_roots_are_the_roms_bit_for_bit() {
    agrees(&["add", "sub", "mul", "div", "sqr"]);
}

#[test]
fn numbers_are_read_and_printed_as_the_rom_does() {
    agrees(&["read", "print", "str"]);
}

#[test]
fn curves_are_the_roms_bit_for_bit() {
    agrees(&["sin", "cos", "tan", "atn", "asn", "acs"]);
    agrees(&["exp", "ln", "log", "pow"]);
}

#[test]
fn whole_numbers_and_comparisons_are_the_roms() {
    agrees(&["int", "whole", "less", "equal", "greater_equal"]);
    agrees(&["product", "idiv", "mod", "and", "or", "eor"]);
}
