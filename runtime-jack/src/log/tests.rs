#![allow(clippy::unwrap_used)]
//! The models against the exact results, and the Jack source against the models.

use super::model::{LEAST, Log, MOST, NEAR, OCTAVE, clamp};
use super::tables::tables;
use super::{LOG10, routines::ALL};
use crate::classes;
use crate::model::{int, int_bits};
use crate::tests::generator::{Generator, STIR, Sums};
use crate::tests::machine::{pairs, run};
use slowlight_routine::{Bits, Error, Form, Format, Range, Routine, Value};

fn unit(x: f64) -> f64 {
    x * f64::from(OCTAVE)
}

#[test]
fn tables_are_right_to_what_is_stated() {
    let tables = tables();
    let worst = |list: &[i32], from: usize, exact: &dyn Fn(f64) -> f64| {
        let all = list.iter().enumerate().skip(from);
        all.map(|(d, &k)| (f64::from(k) - unit(exact(d as f64))).abs())
            .fold(0.0, f64::max)
    };
    let less = |d: f64| (-d / f64::from(OCTAVE)).exp2();
    let found = [
        worst(&tables.sums, 0, &|d| (1.0 + less(d)).log2()),
        worst(&tables.differences, 256, &|d| -(1.0 - less(d)).log2()),
        worst(&tables.differences[..256], 1, &|d| -(1.0 - less(d)).log2()),
        worst(&tables.logs, 1, &f64::log2),
    ];
    assert_eq!(
        found.map(|worst| format!("{worst:.3}")),
        ["0.540", "0.591", "1.220", "0.540"]
    );
    assert_eq!(tables.sums.len(), NEAR as usize);
}

/// Logarithms at every edge.
fn edges() -> Vec<i32> {
    let near = [
        0, 1, 2, 3, 255, 256, 257, 1023, 1024, 1025, 6143, 6144, 6145,
    ];
    let far = [9215, 9216, 9217, 15359, 15360, MOST - 1, MOST];
    let mut all: Vec<i32> = near.into_iter().chain(far).collect();
    all.extend(all.clone().iter().map(|log| -log));
    all.push(LEAST);
    all.sort_unstable();
    all.dedup();
    all
}

/// Whether a routine is right for such operands.
fn may(routine: &Routine, args: &[Bits]) -> bool {
    let values: Vec<Value> = (args.iter().zip(routine.args))
        .map(|(bits, format)| (LOG10.decode)(*bits, *format))
        .collect();
    let ranges: Vec<Range> = values.iter().map(|v| Range::point(v.real())).collect();
    let exact = routine.op.eval(&values);
    (routine.domain)(&ranges, Range::point(exact.real()))
}

#[test]
fn routines_keep_within_their_errors() {
    let mut generator = Generator(7);
    let mut logs = edges();
    logs.extend((0..150).map(|_| generator.next() - 16384));
    logs.extend((0..150).map(|_| generator.next() / 32 - 512));
    let reals: Vec<Bits> = [true, false]
        .into_iter()
        .flat_map(|plus| logs.iter().map(move |&log| Log { plus, log }.bits()))
        .collect();
    let every: Vec<Bits> = (LEAST..=MOST)
        .flat_map(|log| [true, false].map(|plus| Log { plus, log }.bits()))
        .collect();
    let ints: Vec<Bits> = (-40..40).map(|k| int_bits(k * k * k / 2)).collect();
    let own = ALL
        .iter()
        .filter(|r| r.args[0] == super::LOG || r.result == super::LOG);
    for routine in own {
        let list = |k: usize| match routine.args.get(k) {
            None => vec![0],
            Some(Format::Log { .. }) if routine.args.len() == 1 => every.clone(),
            Some(Format::Log { .. }) => reals.clone(),
            Some(_) => ints.clone(),
        };
        let mut seen = 0;
        for &a in &list(0) {
            for &b in &list(1) {
                let args = &[a, b][..routine.args.len()];
                if !may(routine, args) {
                    continue;
                }
                seen += 1;
                holds(routine, args);
            }
        }
        // Those of constants are for ranges that hold a 0, which no value is.
        let constant = [
            "negative",
            "positive",
            "not_positive",
            "not_negative",
            "max_zero",
            "loose_mul",
            "loose_div",
            "is_zero",
            "zero_max",
        ];
        assert!(
            seen > 0 || constant.contains(&routine.name),
            "{}",
            routine.name
        );
    }
}

/// The greatest value.
fn most_held() -> f64 {
    let greatest = Log {
        plus: true,
        log: MOST,
    };
    greatest.value()
}

fn holds(routine: &Routine, args: &[Bits]) {
    let values: Vec<Value> = (args.iter().zip(routine.args))
        .map(|(bits, format)| (LOG10.decode)(*bits, *format))
        .collect();
    let ranges: Vec<Range> = values.iter().map(|v| Range::point(v.real())).collect();
    let exact = routine.op.eval(&values).real();
    let made = (LOG10.decode)((routine.model)(args), routine.result).real();
    // Beyond the ends results saturate; so do ints.
    let exact = match routine.result {
        Format::Log { .. } => exact.clamp(-most_held(), most_held()),
        Format::Int { .. } => exact.clamp(-32768.0, 32767.0),
        _ => exact,
    };
    let off = (made - exact).abs();
    let most = match routine.error {
        Error::Exact => 0.0,
        error => error.most(&ranges, exact),
    };
    assert!(
        off <= most,
        "{} {values:?}: {made}, not {exact}",
        routine.name
    );
}

const MAIN: &str = "
    static int seed, block, first, second, i, j, out, a, b, r;
    static boolean aPlus, bPlus, rPlus, said;

    function int random() {
        let seed = (seed * 25173) + 13849;
        return (seed + block) & 32767;
    }

    function int any(int other) {
        var int kind, log;
        let kind = Main.random() / 8192;
        let log = Main.random();
        if (kind = 0) { return log - 16384; }
        if (kind = 1) { return (log / 16) - 1024; }
        if (kind = 2) { return other + (log / 4096) - 4; }
        return other + (log / 16) - 1024;
    }

    function int inner(int other) {
        let other = Main.any(other);
        if ((other > 5600) | (other < (-2500))) { return 17; }
        return other;
    }

    function int clamped(int log) { return Math.max(-13312, Math.min(16383, log)); }

    function int anyInt() {
        var int kind, whole;
        let kind = Main.random() / 8192;
        let whole = Main.random();
        if (kind = 0) { return ((whole - 16384) * 2) + (Main.random() / 16384); }
        return (whole / 64) - 256;
    }

    function void note(int word) {
        let first = (first * 31) + word;
        let second = ((second + word) * 25173) + 1;
        return;
    }
";

/// The same draws as the harness in Jack.
fn any(generator: &mut Generator, other: i32) -> i32 {
    let kind = generator.next() / 8192;
    let log = generator.next();
    match kind {
        0 => log - 16384,
        1 => log / 16 - 1024,
        2 => other + log / 4096 - 4,
        _ => other + log / 16 - 1024,
    }
}

fn any_int(generator: &mut Generator) -> i32 {
    let kind = generator.next() / 8192;
    let whole = generator.next();
    match kind {
        0 => (whole - 16384) * 2 + generator.next() / 16384,
        _ => whole / 64 - 256,
    }
}

/// How a routine's operands are drawn: anything, or within seven octaves of 1 with
/// such signs as it takes.
struct Draw {
    wide: bool,
    signs: Vec<(bool, bool)>,
}

impl Draw {
    fn of(routine: &Routine) -> Draw {
        let all = [(true, true), (true, false), (false, true), (false, false)];
        let of = |plus| Log { plus, log: 17 }.bits();
        let fits = |(p, q): &(bool, bool)| {
            let args = [of(*p), of(*q)];
            routine.args[0] != super::LOG || may(routine, &args[..routine.args.len()])
        };
        let mut signs: Vec<_> = all.into_iter().filter(fits).collect();
        if signs.is_empty() {
            signs = all.to_vec();
        }
        let wide = (routine.domain)(&[Range::ALL, Range::ALL], Range::ALL);
        Draw { wide, signs }
    }

    /// How many draws of 32768 mean one choice of signs; what is left means the last.
    fn part(&self) -> usize {
        (32768 / self.signs.len()).min(32767)
    }

    fn jack(&self, routine: &Routine) -> String {
        if routine.args[0] != super::LOG {
            return "let i = Main.anyInt();\n".to_owned();
        }
        let draw = if self.wide {
            "clamped(Main.any"
        } else {
            "clamped(Main.inner"
        };
        let mut text = format!("let a = Main.{draw}(0));\nlet b = Main.{draw}(a));\n");
        let (last, part) = (self.signs.len() - 1, self.part());
        text += &format!("let j = Math.min({last}, Main.random() / {part});\n");
        for (k, (p, q)) in self.signs.iter().enumerate() {
            text += &format!("if (j = {k}) {{ let aPlus = {p}; let bPlus = {q}; }}\n");
        }
        text
    }

    fn args(&self, routine: &Routine, generator: &mut Generator) -> Vec<Bits> {
        if routine.args[0] != super::LOG {
            return vec![int_bits(any_int(generator))];
        }
        let mut draw = |other| {
            let log = any(generator, other);
            match self.wide {
                true => clamp(log),
                false if !(-2500..=5600).contains(&log) => 17,
                false => log,
            }
        };
        let a = draw(0);
        let b = draw(a);
        let at = generator.next() as usize / self.part();
        let (p, q) = self.signs[at.min(self.signs.len() - 1)];
        let all = [
            Log { plus: p, log: a }.bits(),
            Log { plus: q, log: b }.bits(),
        ];
        all[..routine.args.len()].to_vec()
    }
}

/// A use of a routine, as statements.
fn usage(routine: &Routine) -> String {
    let real = |k: usize| routine.args.get(k) == Some(&super::LOG);
    let fill = |template: &str| {
        let operand = |k: usize| match real(k) {
            true => ["a", "b"][k],
            false => ["i", "j"][k],
        };
        template
            .replace("{0+}", "aPlus")
            .replace("{1+}", "bPlus")
            .replace("{r+}", "rPlus")
            .replace("{r}", "r")
            .replace("{0}", operand(0))
            .replace("{1}", operand(1))
    };
    let result = if routine.result == Format::Bool {
        "said"
    } else {
        "out"
    };
    match routine.form {
        Form::Statement(template) => fill(template),
        Form::Expression { template, .. } => format!("let {result} = {};", fill(template)),
    }
}

fn program(routine: &Routine, step: &str, count: u32) -> Vec<(String, String)> {
    let parts = LOG10.closure(routine.needs.iter().copied().chain(["Log"]));
    let mut main =
        format!("class Main {{\n{MAIN}    function void step() {{\n{step}\nreturn;\n}}\n");
    main += "    function void main() {\nvar int k, l;\n";
    if crate::has_init("Log", &parts) {
        main += "do Log.init();\n";
    }
    let stir = if step.contains("note(") { STIR } else { "" };
    main += &format!(
        "let seed = 1;\nlet l = {};\nwhile (l > 0) {{\nlet k = 1000;\n{stir}\nwhile (k > 0) {{\n{}do Main.step();\n\
         let k = k - 1; }}\nlet l = l - 1; }}\ndo Output.printInt(first);\ndo Output.printChar(32);\n\
         do Output.printInt(second);\nreturn;\n}}\n}}\n",
        count / 1000,
        Draw::of(routine).jack(routine),
    );
    let mut files = vec![("Main.jack".to_owned(), main)];
    let all = classes(&parts).into_iter();
    files.extend(all.map(|(name, text)| (format!("{name}.jack"), text)));
    files
}

fn own() -> impl Iterator<Item = &'static Routine> {
    ALL.iter()
        .filter(|r| r.args[0] == super::LOG || r.result == super::LOG)
}

#[test]
fn routines_compute_what_their_models_do() {
    for routine in own() {
        let notes = match routine.result {
            Format::Log { .. } => "do Main.note(r); do Main.note(rPlus);",
            Format::Bool => "do Main.note(said);",
            _ => "do Main.note(out);",
        };
        let found = run(&program(
            routine,
            &format!("{} {notes}", usage(routine)),
            pairs(),
        ));
        let (mut sums, mut generator) = (Sums::default(), Generator(1));
        let draw = Draw::of(routine);
        for k in 0..pairs() / 1000 * 1000 {
            if k % 1000 == 0 {
                generator.stir();
            }
            let args = draw.args(routine, &mut generator);
            let bits = (routine.model)(&args);
            match routine.result {
                Format::Log { .. } => {
                    let Log { plus, log } = Log::from_bits(bits);
                    sums.note(log);
                    sums.note(if plus { -1 } else { 0 });
                }
                Format::Bool => sums.note(if bits == 0 { 0 } else { -1 }),
                _ => sums.note(int(bits)),
            }
        }
        let Sums(first, second) = sums;
        assert_eq!(found.text, format!("{first} {second}"), "{}", routine.name);
    }
}

/// Commands of a use over those of its surroundings, without loads and stores of
/// logarithms; those of signs count.
fn cost(routine: &Routine) -> u32 {
    let count = |step: &str| run(&program(routine, step, 20_000)).instructions;
    let stored = 1;
    let idle = match (routine.form, routine.result) {
        (Form::Statement(_), _) => "let r = 0;",
        (_, Format::Bool) => "let said = 0;",
        _ => "let out = 0;",
    };
    let difference = (count(&usage(routine)) - count(idle)) as f64 / 20_000.0;
    let loads = routine.args.len() as f64;
    (difference + f64::from(stored) - loads).round().max(0.0) as u32
}

#[test]
fn routines_cost_what_they_say() {
    let differ = own().filter_map(|r| {
        let measured = cost(r);
        (measured != r.cycles).then(|| format!("{}: {measured}, not {}", r.name, r.cycles))
    });
    assert_eq!(differ.collect::<Vec<_>>(), Vec::<String>::new());
}
