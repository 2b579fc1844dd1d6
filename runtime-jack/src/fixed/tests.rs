#![allow(clippy::unwrap_used)]
//! The models against the exact results, and the Jack source against the models, for every
//! number that scales may come to.

use super::model::{FIRST_ROOT, roots};
use super::{FIXED16, filled, read, routines::ALL};
use crate::classes;
use crate::model::{MOST, int, int_bits};
use crate::tests::generator::{Generator, Sums};
use crate::tests::machine::{pairs, run};
use slowlight_routine::{Bits, Error, Form, Format, Op, Range, Routine, Type, Value, scale};

/// The numbers that a routine takes, of those that scales may come to.
fn numbers(routine: &Routine) -> Vec<i32> {
    let small = Range::new(-1.0, 1.0);
    let takes = |n: &i32| {
        let mut args = vec![small; routine.args.len()];
        args.push(Range::point(f64::from(*n)));
        // Some are for an operand of 1.
        let ones = [Range::point(1.0), Range::point(1.0), args[args.len() - 1]];
        (routine.domain)(&args, small) || routine.args.len() == 2 && (routine.domain)(&ones, small)
    };
    match routine.op {
        Op::Mul | Op::Div | Op::Sqrt | Op::Floor | Op::Sin | Op::Cos => {
            (-20..=32).filter(takes).collect()
        }
        Op::Add if takes(&1) && !takes(&0) => vec![1],
        _ => vec![0],
    }
}

fn own() -> impl Iterator<Item = &'static Routine> {
    ALL.iter().filter(|r| scale::concerns(r.op))
}

/// Whether a routine is right for such operands.
fn may(routine: &Routine, args: &[i32], n: i32, exact: f64) -> bool {
    let mut ranges: Vec<Range> = args.iter().map(|a| Range::point(f64::from(*a))).collect();
    ranges.push(Range::point(f64::from(n)));
    (routine.domain)(&ranges, Range::point(exact))
}

/// What is meant, in units of the result's last place.
fn exact(op: Op, args: &[i32], n: i32) -> f64 {
    let a = f64::from(args[0]);
    let b = f64::from(args.get(1).copied().unwrap_or(0));
    let by = f64::from(n).exp2();
    match op {
        Op::Mul => a * b / by,
        Op::Div if b == 0.0 => a.signum() * f64::from(args[0].signum().abs()) * 1e9,
        Op::Div => a / b * by,
        Op::Sqrt => (a.max(0.0) * by).sqrt(),
        Op::Floor => (a / by).floor(),
        Op::Sin | Op::Cos => op.eval(&[Value::Real(a / by)]).real() * 16384.0,
        // Read as twice what it is.
        Op::Add if n == 1 => a,
        Op::Round | Op::ToReal => a,
        _ => op.eval(&[Value::Real(a), Value::Real(b)]).real(),
    }
}

fn computed(routine: &Routine, args: &[i32], n: i32) -> Bits {
    let mut bits: Vec<Bits> = args.iter().map(|a| int_bits(*a)).collect();
    bits.push(int_bits(n));
    (routine.model)(&bits)
}

fn edges() -> Vec<i32> {
    let near = [
        0, 1, 2, 3, 127, 128, 129, 255, 256, 257, 511, 512, 8191, 8192, 8193,
    ];
    let far = [16383, 16384, 16385, 21845, 32639, 32640, 32766, 32767];
    let all = near.into_iter().chain(far);
    all.flat_map(|x| [x, -x]).collect()
}

#[test]
fn routines_keep_within_their_errors() {
    let mut generator = Generator(3);
    let mut values = edges();
    values.extend((0..60).map(|_| generator.next()));
    values.extend((0..60).map(|_| -(generator.next() / 64)));
    let none = [0];
    for routine in own() {
        let seconds = if routine.args.len() > 1 {
            &values[..]
        } else {
            &none
        };
        for n in numbers(routine) {
            let mut worst = 0f64;
            for &a in &values {
                for &b in seconds {
                    let args = &[a, b][..routine.args.len()];
                    let exact = exact(routine.op, args, n);
                    if !may(routine, args, n, exact) {
                        continue;
                    }
                    let held = match routine.result {
                        Format::Bool => exact,
                        _ => exact.clamp(f64::from(-MOST), f64::from(MOST)),
                    };
                    let made = f64::from(int(computed(routine, args, n)));
                    worst = worst.max((made - held).abs());
                }
            }
            let most = match routine.error {
                Error::Absolute(most) => most,
                _ => 0.0,
            };
            let name = routine.name;
            assert!(worst <= most, "{name} with {n}: {worst}, not {most}");
        }
    }
}

#[test]
fn roots_of_every_value_are_right_to_what_is_stated() {
    let of = |k: usize| ((k + FIRST_ROOT) as f64 / 256.0).sqrt() * 32768.0;
    let off = |(k, root): (usize, &i32)| (f64::from(*root) - of(k)).abs();
    let worst = roots().iter().enumerate().map(off).fold(0.0, f64::max);
    assert!(worst <= 1.0, "{worst}");
    let routine = own().find(|r| r.op == Op::Sqrt).unwrap();
    for n in 1..=15 {
        for a in 0..=MOST {
            let off = f64::from(int(computed(routine, &[a], n))) - exact(Op::Sqrt, &[a], n);
            assert!(off.abs() <= 1.5, "{a} with {n}: {off}");
        }
    }
}

#[test]
fn texts_have_no_holes_left() {
    for routine in own() {
        for n in numbers(routine) {
            let Form::Expression { template, .. } = routine.form else {
                panic!("{} is no expression", routine.name);
            };
            let text = filled(template, n).replace("{0}", "a").replace("{1}", "b");
            assert!(!text.contains('{'), "{text}");
        }
    }
}

const MAIN: &str = "
    static int seed, first, second, a, b, out;
    static boolean said;

    function int random() {
        let seed = (seed * 25173) + 13849;
        return seed & 32767;
    }

    function int any(int most) {
        var int kind, value;
        let kind = Main.random() / 8192;
        let value = Main.random();
        if (kind = 0) { let value = value / 128; }
        if (kind = 1) { let value = value / 4096; }
        if (kind = 2) { let value = 32767 - (value / 4096); }
        let value = Math.min(value, most);
        if (Main.random() < 16384) { return -value; }
        return value;
    }

    function void note(int word) {
        let first = (first * 31) + word;
        let second = ((second + word) * 25173) + 1;
        return;
    }
";

/// The same draws as the harness in Jack.
fn any(generator: &mut Generator, most: i32) -> i32 {
    let kind = generator.next() / 8192;
    let value = generator.next();
    let value = match kind {
        0 => value / 128,
        1 => value / 4096,
        2 => 32767 - value / 4096,
        _ => value,
    };
    let value = value.min(most);
    if generator.next() < 16384 {
        -value
    } else {
        value
    }
}

/// How large operands may be of routines that do not take all.
fn greatest(routine: &Routine) -> i32 {
    let all = Range::new(f64::from(-MOST), f64::from(MOST));
    let mut args = vec![all; routine.args.len()];
    args.push(Range::point(f64::from(numbers(routine)[0])));
    match (routine.op, (routine.domain)(&args, Range::ALL)) {
        (_, true) => MOST,
        (Op::Mul, _) if routine.name == "multiple" => 181,
        (Op::Mul, _) => MOST,
        _ => MOST / 2,
    }
}

/// A program that carries out a step for such operands, and says what was noted.
fn program(needs: &[&'static str], step: &str, most: i32, count: u32) -> Vec<(String, String)> {
    let parts = FIXED16.closure(needs.iter().copied().chain(["Fixed"]));
    let mut main =
        format!("class Main {{\n{MAIN}    function void step() {{\n{step}\nreturn;\n}}\n");
    main += "    function void main() {\nvar int k, l;\n";
    if crate::has_init("Fixed", &parts) {
        main += "do Fixed.init();\n";
    }
    main += &format!(
        "let seed = 1;\nlet l = {};\nwhile (l > 0) {{\nlet k = 1000;\nwhile (k > 0) {{\n\
         let a = Main.any({most});\nlet b = Main.any({most});\ndo Main.step();\n\
         let k = k - 1; }}\nlet l = l - 1; }}\ndo Output.printInt(first);\ndo Output.printChar(32);\n\
         do Output.printInt(second);\nreturn;\n}}\n}}\n",
        count / 1000,
    );
    let mut files = vec![("Main.jack".to_owned(), main)];
    let all = classes(&parts).into_iter();
    files.extend(all.map(|(name, text)| (format!("{name}.jack"), text)));
    files
}

fn usage(routine: &Routine, n: i32) -> String {
    let Form::Expression { template, .. } = routine.form else {
        return String::new();
    };
    let text = filled(template, n).replace("{0}", "a").replace("{1}", "b");
    match routine.result {
        Format::Bool => format!("let said = {text};"),
        _ => format!("let out = {text};"),
    }
}

#[test]
fn routines_compute_what_their_models_do() {
    for routine in own() {
        let most = greatest(routine);
        let note = match routine.result {
            Format::Bool => "do Main.note(said);",
            _ => "do Main.note(out);",
        };
        let numbers = numbers(routine);
        let count = pairs() / numbers.len() as u32 / 1000 * 1000 + 1000;
        for n in numbers {
            let step = format!("{} {note}", usage(routine, n));
            let found = run(&program(routine.needs, &step, most, count));
            let (mut sums, mut generator) = (Sums::default(), Generator(1));
            for _ in 0..count {
                let a = any(&mut generator, most);
                let b = any(&mut generator, most);
                let args = &[a, b][..routine.args.len()];
                sums.result(computed(routine, args, n), routine.result);
            }
            let Sums(first, second) = sums;
            let name = routine.name;
            assert_eq!(found.text, format!("{first} {second}"), "{name} with {n}");
        }
    }
}

/// Operands read at other scales: what the compiler takes to be read is what the text reads.
#[test]
fn reading_at_another_scale_is_what_shifting_is() {
    for by in -18..=18 {
        for fits in [false, true] {
            let most = if fits { MOST >> by.clamp(0, 15) } else { MOST };
            let (text, _, need) = read(("a", 1), by, fits);
            let needs: Vec<&'static str> = need.into_iter().collect();
            let step = format!("let out = {text}; do Main.note(out);");
            let found = run(&program(&needs, &step, most, 2000));
            let (mut sums, mut generator) = (Sums::default(), Generator(1));
            for _ in 0..2000 {
                let a = any(&mut generator, most);
                any(&mut generator, most);
                sums.note(scale::shifted(i64::from(a), by, super::BITS) as i32);
            }
            let Sums(first, second) = sums;
            assert_eq!(found.text, format!("{first} {second}"), "{by} {fits}");
        }
    }
}

/// Commands of a use over those of its surroundings, at the middle one of its numbers.
fn cost(routine: &Routine) -> u32 {
    let numbers = numbers(routine);
    let n = numbers[numbers.len() / 2];
    let count = |step: &str| {
        run(&program(routine.needs, step, greatest(routine), 20_000)).instructions as f64
    };
    let idle = match routine.result {
        Format::Bool => "let said = false;",
        _ => "let out = 0;",
    };
    let difference = (count(&usage(routine, n)) - count(idle)) / 20_000.0;
    let loads = routine.args.len() as f64;
    (difference + 1.0 - loads).round().max(0.0) as u32
}

#[test]
fn routines_cost_what_they_say() {
    let differ = own().filter_map(|r| {
        let measured = cost(r);
        (measured != r.cycles).then(|| format!("{}: {measured}, not {}", r.name, r.cycles))
    });
    assert_eq!(differ.collect::<Vec<_>>(), Vec::<String>::new());
}

#[test]
fn every_operation_on_reals_that_is_offered_has_a_total_routine() {
    let all = Range::ALL;
    for routine in own() {
        let offered = |n: i32| {
            let number = Range::point(f64::from(n));
            let args = [vec![all; routine.args.len()], vec![number]].concat();
            ALL.iter()
                .any(|r| r.op == routine.op && (r.domain)(&args, all))
        };
        let numbers = match routine.op {
            Op::Mul => -60..=31,
            Op::Div => 0..=30,
            Op::Sqrt => 1..=15,
            Op::Floor => 0..=30,
            Op::Sin | Op::Cos => 0..=13,
            _ => 0..=0,
        };
        for n in numbers {
            assert!(offered(n), "{} with {n}", routine.op.name());
        }
        assert!(routine.args.iter().all(|f| f.scalar() != Type::Bool));
    }
}
