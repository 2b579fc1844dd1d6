#![allow(clippy::unwrap_used)]

//! Every routine is run in the BASIC machine on edges and random operands of its domain and
//! compared with its model, bit for bit; and the model with the operation's definition.

mod cases;
mod powers;
mod remainders;

use super::*;
use cases::{cases, operands, value};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use slowlight_routine::{Error, Form, Op, Part, Range, Routine, Source};
use slowlight_vm::Stop;
use slowlight_vm::bbc::{Config, Dialect, Machine, tokenise};

/// A value as PRINT# writes it to a file.
fn record(bits: Bits, format: Format) -> Vec<u8> {
    match format {
        Format::Real40 => [
            &[0xff][..],
            &Real40::from_bits(bits)
                .to_bytes()
                .iter()
                .rev()
                .copied()
                .collect::<Vec<u8>>(),
        ]
        .concat(),
        Format::Bool => [&[0x40][..], &(-i32::from(bits != 0)).to_be_bytes()].concat(),
        _ => [&[0x40][..], &model::int(bits).to_be_bytes()].concat(),
    }
}

/// The results that a program wrote, in a format.
fn results(mut file: &[u8], format: Format) -> Vec<Bits> {
    let mut out = Vec::new();
    while let Some((kind, rest)) = file.split_first() {
        let real = *kind == 0xff;
        let (bytes, rest) = rest.split_at(if real { 5 } else { 4 });
        let number = if real {
            let b: Vec<u8> = bytes.iter().rev().copied().collect();
            Real40::from_bytes(b.try_into().unwrap())
        } else {
            Real40::from_i32(i32::from_be_bytes(bytes.try_into().unwrap()))
        };
        out.push(match format {
            Format::Real40 => number.to_bits(),
            Format::Bool => u64::from(!number.is_zero()),
            _ if real => model::from_int(number.to_i32().unwrap()),
            _ => model::from_int(i32::from_be_bytes(bytes.try_into().unwrap())),
        });
        file = rest;
    }
    out
}

fn text(part: &Part) -> &'static str {
    match part.source {
        Source::Text(text) => text,
        Source::Made(_) | Source::Table(_) => panic!("BASIC's parts are text"),
    }
}

/// Runs a routine on all cases; answers the results and the cycles of each use.
fn run(r: &Routine, cases: &[Vec<Bits>]) -> Vec<Bits> {
    let Form::Expression { template, .. } = r.form else {
        panic!("{}: not an expression", r.name);
    };
    let names: Vec<&str> = r
        .args
        .iter()
        .zip([["p", "q"], ["p%", "q%"]].map(|n| n).iter().cycle())
        .enumerate()
        .map(|(k, (f, _))| match (f, k) {
            (Format::Real40, 0) => "p",
            (Format::Real40, _) => "q",
            (_, 0) => "p%",
            _ => "q%",
        })
        .collect();
    let mut expression = template.to_owned();
    for (k, name) in names.iter().enumerate() {
        expression = expression.replace(&format!("{{{k}}}"), name);
    }
    let result = match r.result {
        Format::Real40 => "s",
        _ => "s%",
    };
    let mut program = format!(
        "F%=OPENIN\"in\"\nG%=OPENOUT\"out\"\nREPEAT\nINPUT#F%,{}\n{result}={expression}\nPRINT#G%,{result}\nUNTIL EOF#F%\nEND\n",
        names.join(",")
    );
    // What is no DEF is done first.
    for part in RUNTIME.closure(r.needs.iter().copied()) {
        if text(part).starts_with("DEF") {
            program.push_str(text(part));
        } else {
            program.insert_str(0, text(part));
        }
    }
    let mut machine = Machine::new(Config {
        dialect: Dialect::Micro,
        page: 0x1900,
    });
    machine.load_text(&program).unwrap();
    let input = cases
        .iter()
        .flat_map(|args| args.iter().zip(r.args).flat_map(|(b, f)| record(*b, *f)))
        .collect();
    machine.add_file("in", input);
    let run = machine.run(u64::MAX, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended, "{}\n{program}", r.name);
    results(&run.files["out"], r.result)
}

#[test]
fn routines_do_on_the_machine_what_their_models_say() {
    for r in RUNTIME.routines {
        let cases = cases(r);
        assert!(cases.len() > 1, "{}: nothing to test", r.name);
        let got = run(r, &cases);
        assert_eq!(got.len(), cases.len(), "{}", r.name);
        for (args, got) in cases.iter().zip(got) {
            let wanted = (r.model)(args);
            let shown: Vec<Value> = args
                .iter()
                .zip(r.args)
                .map(|(b, f)| value(*b, *f))
                .collect();
            assert_eq!(
                got,
                wanted,
                "{}{shown:?}: {:?} on the machine, {:?} by the model",
                r.name,
                value(got, r.result),
                value(wanted, r.result)
            );
        }
    }
}

#[test]
fn models_are_as_close_as_they_say() {
    for r in RUNTIME.routines {
        for args in cases(r) {
            let values: Vec<Value> = args
                .iter()
                .zip(r.args)
                .map(|(b, f)| value(*b, *f))
                .collect();
            let got = value((r.model)(&args), r.result).real();
            // Reals saturate at BIG and vanish below 2^-128.
            let exact = r.op.eval(&values).real();
            let exact = if r.result == REAL {
                let end = if r.name == "FNdiv" { FAR } else { BIG };
                exact.clamp(-end, end)
            } else {
                exact
            };
            let off = (got - exact).abs();
            let spans: Vec<Range> = values.iter().map(|v| Range::point(v.real())).collect();
            let allowed = match r.error {
                Error::Exact => 0.0,
                error => error.most(&spans, exact) + 1e-38,
            };
            // Above BIG the format goes on a little.
            let end = got.abs() > BIG * 0.999_999_999 && exact.abs() >= BIG * 0.999;
            assert!(
                off <= allowed || end,
                "{}{values:?} = {got}, not {exact}: off by {off}, allowed {allowed}",
                r.name
            );
        }
    }
}

#[test]
fn every_operation_ends_with_a_total_routine() {
    for op in Op::ALL {
        let last = RUNTIME.routines.iter().rfind(|r| r.op == *op).unwrap();
        let all = vec![Range::ALL; op.arity()];
        assert!((last.domain)(&all, Range::ALL), "{}", last.name);
    }
}

#[test]
fn parts_have_the_bytes_they_say_and_exist() {
    for part in RUNTIME.parts {
        let bytes = tokenise(text(part), Dialect::Micro).unwrap().len() as u32 - 2;
        assert_eq!(part.bytes, bytes, "{}", part.name);
        assert!(
            part.needs.iter().all(|n| RUNTIME.part(n).is_some()),
            "{}",
            part.name
        );
    }
    for r in RUNTIME.routines {
        assert!(
            r.needs.iter().all(|n| RUNTIME.part(n).is_some()),
            "{}",
            r.name
        );
        assert_eq!(r.args.len(), r.op.arity());
    }
}

#[test]
fn literals_are_short_and_read_back() {
    for (x, text) in [
        (0.0, "0"),
        (1.0, "1"),
        (-0.5, "-0.5"),
        (0.1, "0.1"),
        (1.0 / 3.0, "0.3333333333"),
        (1e9, "1000000000"),
        (1e10, "1E10"),
        (1.5e-7, "1.5E-7"),
        (-2e20, "-2E20"),
        (f64::MAX, "1.7E38"),
        (159.5, "159.5"),
        (1234567890.0, "1234567890"),
        (0.001, "0.001"),
    ] {
        assert_eq!(literal(x), text);
    }
}

proptest! {
    #[test]
    fn literals_are_the_nearest_ten_digits(bits in any::<u64>()) {
        let x = Real40::from_bits(bits).to_f64();
        prop_assume!(x.abs() < BIG && x.abs() > 1e-37);
        let text = literal(x);
        let digits = text.split('E').next().unwrap().replace(['-', '.'], "");
        prop_assert!(digits.trim_start_matches('0').len() <= 10, "{text}");
        prop_assert!((nearest(x).to_f64() - x).abs() <= 1e-9 * x.abs(), "{text}");
        prop_assert!((text.parse::<f64>().unwrap() - x).abs() <= 0.51e-9 * x.abs());
    }
}

#[test]
fn under_its_tests_a_function_may_be_left_out() {
    let find = |name: &str| routines::ALL.iter().find(|r| r.name == name).unwrap();
    for guarded in guards::GUARDED {
        let (full, cheap) = (find(guarded.name), find(guarded.cheap));
        assert_eq!(
            (full.op, full.args, full.result),
            (cheap.op, cheap.args, cheap.result)
        );
        let first = operands(full.args[0]);
        let second = match full.args.get(1) {
            Some(format) => operands(*format),
            None => vec![0],
        };
        let mut tried = 0;
        for a in &first {
            for b in &second {
                let args = &[*a, *b][..full.args.len()];
                let value = |k: usize| match decode(args[k], full.args[k]) {
                    Value::Real(x) => x,
                    value => f64::from(value.int()),
                };
                let known: Vec<Range> = (0..args.len()).map(|k| Range::point(value(k))).collect();
                if !(full.domain)(&known, Range::ALL) {
                    continue;
                }
                if !guarded.when.iter().all(|(k, test)| test.holds(value(*k))) {
                    if let Some(text) = guarded.otherwise {
                        let bits = encode(Value::Real(text.parse().unwrap()), full.result);
                        assert_eq!((full.model)(args), bits, "{} of {args:?}", guarded.name);
                    }
                    continue;
                }
                tried += 1;
                let bits = (full.model)(args);
                assert_eq!(bits, (cheap.model)(args), "{} of {args:?}", guarded.name);
                let result = match decode(bits, full.result) {
                    Value::Real(x) => x,
                    value => f64::from(value.int()),
                };
                assert!(
                    guarded.below.is_none_or(|most| result.abs() < most),
                    "{result}"
                );
            }
        }
        assert!(
            tried > 5,
            "{}: {tried} operands pass its tests",
            guarded.name
        );
    }
}
