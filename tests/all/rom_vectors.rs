//! Our arithmetic against the genuine BASIC II, on operands that anyone can make again.
//!
//! The operands come from a generator with a fixed start; `tests/rom/` has what the ROM made of
//! them, recorded under jsbeeb by `peers_jsbeeb.rs`, which also checks that the files are still
//! what the ROM says. So these tests need no ROM.
#![allow(clippy::unwrap_used)]

use slowlight_isa::real40::text::{NumberFormat, Parsed, Style, parse, to_text};
use slowlight_isa::real40::{Real40, RealError, arith, elementary};
use slowlight_vm::Stop;
use slowlight_vm::bbc::{Config, Machine};
use std::path::PathBuf;

/// What goes in: as many as the operation takes.
#[derive(Clone, Debug)]
pub enum Operands {
    Reals(Real40, Real40),
    Ints(i32, i32),
    Text(String),
}

/// What comes out, and how many bytes of the file it takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gives {
    Real,
    Int,
    Text,
}

/// An operation, as BASIC has it: of A, B, A%, B% or the text at &5000 to C, C% or &5100.
pub struct Operation {
    pub name: &'static str,
    pub statement: &'static str,
    pub gives: Gives,
    pub count: usize,
    operands: fn(&mut Random) -> Operands,
}

/// The operations, with how many cases each.
pub const OPERATIONS: &[Operation] = &[
    exact("add", "C=A+B", Gives::Real, 10_000, pair),
    exact("sub", "C=A-B", Gives::Real, 10_000, pair),
    exact("mul", "C=A*B", Gives::Real, 10_000, pair),
    exact("div", "C=A/B", Gives::Real, 10_000, pair),
    exact("sqr", "C=SQRA", Gives::Real, 10_000, pair),
    exact("read", "C=VAL$&5000", Gives::Real, 10_000, decimal),
    exact(
        "print",
        "@%=&0100090A:$&5100=STR$A",
        Gives::Text,
        10_000,
        pair,
    ),
    exact("str", "@%=&90A:$&5100=STR$A", Gives::Text, 2_000, pair),
    exact("int", "C=INTA", Gives::Real, 2_000, near),
    exact("whole", "C%=A", Gives::Int, 2_000, near),
    exact("less", "C%=A<B", Gives::Int, 2_000, close),
    exact("equal", "C%=A=B", Gives::Int, 2_000, close),
    exact("greater_equal", "C%=A>=B", Gives::Int, 2_000, close),
    exact("product", "C%=A%*B%", Gives::Int, 2_000, whole),
    exact("idiv", "C%=A% DIV B%", Gives::Int, 2_000, whole),
    exact("mod", "C%=A% MOD B%", Gives::Int, 2_000, whole),
    exact("and", "C%=A% AND B%", Gives::Int, 2_000, whole),
    exact("or", "C%=A% OR B%", Gives::Int, 2_000, whole),
    exact("eor", "C%=A% EOR B%", Gives::Int, 2_000, whole),
    exact("sin", "C=SINA", Gives::Real, 1_000, angle),
    exact("cos", "C=COSA", Gives::Real, 1_000, angle),
    exact("tan", "C=TANA", Gives::Real, 1_000, angle),
    exact("atn", "C=ATNA", Gives::Real, 1_000, angle),
    exact("exp", "C=EXPA", Gives::Real, 1_000, power),
    exact("ln", "C=LNA", Gives::Real, 1_000, positive),
    exact("pow", "C=A^B", Gives::Real, 1_000, powers),
];

const fn exact(
    name: &'static str,
    statement: &'static str,
    gives: Gives,
    count: usize,
    operands: fn(&mut Random) -> Operands,
) -> Operation {
    Operation {
        name,
        statement,
        gives,
        count,
        operands,
    }
}

impl Operation {
    /// The operands of each case.
    pub fn cases(&self) -> Vec<Operands> {
        let seed = self
            .name
            .bytes()
            .fold(7u64, |s, b| s.wrapping_mul(31).wrapping_add(u64::from(b)));
        let mut random = Random(seed);
        (0..self.count)
            .map(|_| (self.operands)(&mut random))
            .collect()
    }

    /// Where its results are kept.
    pub fn file(&self) -> PathBuf {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        root.join("tests/rom").join(self.name).with_extension("bin")
    }
}

/// An error in the place of a result of five or four bytes: no real has exponent 0 and these.
pub fn error_bytes(gives: Gives, number: u8) -> Vec<u8> {
    match gives {
        Gives::Real => vec![0, 0xee, 0xee, 0xee, number],
        Gives::Int => vec![0xee, 0xee, 0xee, number],
        Gives::Text => format!("error {number}").into_bytes(),
    }
}

/// SplitMix64.
pub struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// A real whose exponent byte lies in a range; one in three with a short mantissa.
    fn real(&mut self, from: u8, to: u8) -> Real40 {
        let exponent = u64::from(from) + self.below(u64::from(to - from) + 1);
        let keep = if self.below(3) == 0 {
            self.below(32)
        } else {
            0
        };
        let mantissa = (self.next() as u32) >> keep << keep;
        Real40::from_bits(exponent << 32 | u64::from(mantissa))
    }
}

/// Mostly of like size, some over the whole range, some zero.
fn any(r: &mut Random) -> Real40 {
    match r.below(20) {
        0 => Real40::ZERO,
        1..3 => r.real(1, 255),
        3..6 => Real40::from_i32(r.below(2000) as i32 - 1000),
        6..12 => r.real(126, 131),
        _ => r.real(100, 156),
    }
}

fn pair(r: &mut Random) -> Operands {
    Operands::Reals(any(r), any(r))
}

/// Reals that fit an integer, and some that do not.
fn near(r: &mut Random) -> Operands {
    Operands::Reals(r.real(120, 162), Real40::ZERO)
}

/// Reals that are often equal or differ in the last bits.
fn close(r: &mut Random) -> Operands {
    let a = any(r);
    let b = match r.below(3) {
        0 => a,
        1 => Real40::from_bits(a.to_bits() ^ r.below(4)),
        _ => any(r),
    };
    Operands::Reals(a, b)
}

fn whole(r: &mut Random) -> Operands {
    let mut int = || {
        let bits = r.below(32);
        let n = (r.next() as u32 & ((1u64 << bits) - 1) as u32) as i32;
        if r.below(2) == 0 { n } else { -n }
    };
    Operands::Ints(int(), int())
}

fn angle(r: &mut Random) -> Operands {
    Operands::Reals(r.real(112, 134), Real40::ZERO)
}

fn power(r: &mut Random) -> Operands {
    Operands::Reals(r.real(112, 134), Real40::ZERO)
}

fn positive(r: &mut Random) -> Operands {
    let reach = if r.below(2) == 0 { 1 } else { 28 };
    Operands::Reals(r.real(128 - reach, 128 + reach).abs(), Real40::ZERO)
}

fn powers(r: &mut Random) -> Operands {
    let y = match r.below(2) {
        0 => Real40::from_i32(r.below(24) as i32 - 8),
        _ => r.real(124, 131),
    };
    Operands::Reals(r.real(122, 132).abs(), y)
}

/// A decimal number: 1 to 12 digits, perhaps a point, perhaps a power of ten.
fn decimal(r: &mut Random) -> Operands {
    let length = 1 + r.below(12) as usize;
    let mut text: String = (0..length)
        .map(|_| char::from(b'0' + r.below(10) as u8))
        .collect();
    if r.below(3) > 0 {
        text.insert(r.below(length as u64 + 1) as usize, '.');
    }
    match r.below(4) {
        0 => text += &format!("E{}", r.below(25)),
        1 => text += &format!("E-{}", r.below(28)),
        _ => {}
    }
    Operands::Text(text)
}

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

/// Values of bytes that are no error, as doubles.
fn double(bytes: &[u8]) -> f64 {
    Real40::from_bytes([bytes[0], bytes[1], bytes[2], bytes[3], bytes[4]]).to_f64()
}

/// The elementary functions are not the ROM's series but values rounded from double precision.
/// How far apart they are is counted, in units of the last place; the ROM's EXP multiplies by e
/// once for each whole, which loses most.
#[test]
fn curves_are_near_the_roms() {
    let mut wrong = Vec::new();
    for (name, most) in [
        ("sin", 2.0),
        ("cos", 1.0),
        ("tan", 3.0),
        ("atn", 5.0),
        ("exp", 58.0),
        ("ln", 1.0),
        ("pow", 6.0),
    ] {
        let operation = find(name);
        let (cases, rom) = (operation.cases(), recorded(operation));
        let (mut same, mut worst, mut errors) = (0, 0.0f64, 0);
        for (case, rom) in cases.iter().zip(&rom) {
            let ours = ours(name, case).unwrap();
            let is_error = |b: &[u8]| b[0] == 0 && b[1..4] == [0xee; 3];
            if is_error(&ours) || is_error(rom) {
                if ours != *rom {
                    println!("{name} {case:?}: {ours:x?}, the ROM's {rom:x?}");
                    errors += 1;
                }
                continue;
            }
            same += usize::from(ours == *rom);
            let unit = (f64::from(rom[0]) - 160.0).exp2();
            worst = worst.max((double(&ours) - double(rom)).abs() / unit);
        }
        println!(
            "{name}: {same} of {} the same, {worst} units at most, {errors} other errors",
            cases.len()
        );
        if worst > most || errors > 0 {
            wrong.push(name);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn whole_numbers_and_comparisons_are_the_roms() {
    agrees(&["int", "whole", "less", "equal", "greater_equal"]);
    agrees(&["product", "idiv", "mod", "and", "or", "eor"]);
}
