//! The Jack source of routines for logarithmic reals against their models; and what a use
//! of each costs.

use super::{edges, may, own};
use crate::classes;
use crate::log::LOG10;
use crate::model::{MOST as MOST_INT, int_bits};
use crate::tests::generator::{Generator, STIR, Sums, all_pairs};
use crate::tests::machine::{pairs, run};
use slowlight_routine::log::LOG;
use slowlight_routine::log::model::Log;
use slowlight_routine::{Bits, Form, Format, Op, Range, Routine};

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
            routine.args[0] != LOG || may(routine, &args[..routine.args.len()])
        };
        let mut signs: Vec<_> = all.into_iter().filter(fits).collect();
        if signs.is_empty() {
            signs = all.to_vec();
        }
        let wide = (routine.domain)(&[Range::ALL, Range::ALL], Range::ALL);
        Draw { wide, signs }
    }

    /// The edges of operands that the routine takes, whatever their signs.
    fn edges(&self, routine: &Routine) -> Vec<i32> {
        match (routine.args[0] == LOG, self.wide) {
            (false, _) => [-32768, -32767, -1025, -257, -1]
                .into_iter()
                .flat_map(|n: i32| [n, -n.max(-MOST_INT), n / 2 + 1])
                .collect(),
            (true, true) => edges().into_iter().map(Log::clamp).collect(),
            (true, false) => {
                let inner = |log: &i32| (-2500..=5600).contains(log);
                edges().into_iter().filter(inner).collect()
            }
        }
    }

    /// A step for a pair of edges with each choice of signs.
    fn steps(&self, routine: &Routine) -> String {
        if routine.args[0] != LOG {
            return "do Main.step();\n".to_owned();
        }
        let step = |(p, q): &(bool, bool)| {
            format!("let aPlus = {p};\nlet bPlus = {q};\ndo Main.step();\n")
        };
        self.signs.iter().map(step).collect()
    }

    /// The operands of these steps.
    fn of_edges(&self, routine: &Routine, [a, b]: [i32; 2]) -> Vec<Vec<Bits>> {
        if routine.args[0] != LOG {
            return vec![vec![int_bits(a)]];
        }
        let bits = |(p, q): &(bool, bool)| {
            let all = [(*p, a), (*q, b)].map(|(plus, log)| Log { plus, log }.bits());
            all[..routine.args.len()].to_vec()
        };
        self.signs.iter().map(bits).collect()
    }

    /// How many draws of 32768 mean one choice of signs; what is left means the last.
    fn part(&self) -> usize {
        (32768 / self.signs.len()).min(32767)
    }

    fn jack(&self, routine: &Routine) -> String {
        if routine.args[0] != LOG {
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
        if routine.args[0] != LOG {
            return vec![int_bits(any_int(generator))];
        }
        let mut draw = |other| {
            let log = any(generator, other);
            match self.wide {
                true => Log::clamp(log),
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
    let real = |k: usize| routine.args.get(k) == Some(&LOG);
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

fn program(routine: &Routine, step: &str, with_edges: bool, count: u32) -> Vec<(String, String)> {
    let parts = LOG10.closure(routine.needs.iter().copied().chain(["Log"]));
    let mut main =
        format!("class Main {{\n{MAIN}    function void step() {{\n{step}\nreturn;\n}}\n");
    main += "    function void main() {\nvar int k, l;\nvar Array edges;\n";
    if crate::has_init("Log", &parts) {
        main += "do Log.init();\n";
    }
    let draw = Draw::of(routine);
    if with_edges {
        let operands = if routine.args[0] == LOG {
            ["a", "b"]
        } else {
            ["i", "j"]
        };
        main += &all_pairs(&draw.edges(routine), operands, &draw.steps(routine));
    }
    let stir = if step.contains("note(") { STIR } else { "" };
    main += &format!(
        "let seed = 1;\nlet l = {};\nwhile (l > 0) {{\nlet k = 1000;\n{stir}\nwhile (k > 0) {{\n{}do Main.step();\n\
         let k = k - 1; }}\nlet l = l - 1; }}\ndo Output.printInt(first);\ndo Output.printChar(32);\n\
         do Output.printInt(second);\nreturn;\n}}\n}}\n",
        count / 1000,
        draw.jack(routine),
    );
    // A routine costs what it does of operands as pictures have them: angles are from 1/4 to 16,
    // and what is rounded from 1 to 64.
    if !with_edges && matches!(routine.op, Op::Sin | Op::Cos | Op::Floor | Op::Round) {
        let angle = matches!(routine.op, Op::Sin | Op::Cos);
        let less = if angle { " - 2048" } else { "" };
        let usual = format!("let a = (Main.random() & 4095) + (Main.random() & 2047){less};\n");
        main = main.replace("let a = Main.clamped(Main.any(0));\n", &usual);
        main = main.replace("let a = Main.clamped(Main.inner(0));\n", &usual);
    }
    let mut files = vec![("Main.jack".to_owned(), main)];
    let all = classes(&parts).into_iter();
    files.extend(all.map(|(name, text)| (format!("{name}.jack"), text)));
    files
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
            true,
            pairs(),
        ));
        let (mut sums, mut generator) = (Sums::default(), Generator(1));
        let draw = Draw::of(routine);
        let edges = draw.edges(routine);
        for (a, b) in edges
            .iter()
            .flat_map(|a| edges.iter().map(move |b| (*a, *b)))
        {
            for args in draw.of_edges(routine, [a, b]) {
                note(&mut sums, routine, &args);
            }
        }
        for k in 0..pairs() / 1000 * 1000 {
            if k % 1000 == 0 {
                generator.stir();
            }
            note(&mut sums, routine, &draw.args(routine, &mut generator));
        }
        let Sums(first, second) = sums;
        assert_eq!(found.text, format!("{first} {second}"), "{}", routine.name);
    }
}

/// What the harness notes of a result.
fn note(sums: &mut Sums, routine: &Routine, args: &[Bits]) {
    let bits = (routine.model)(args);
    match routine.result {
        Format::Log { .. } => {
            let Log { plus, log } = Log::from_bits(bits);
            sums.note(log);
            sums.note(if plus { -1 } else { 0 });
        }
        _ => sums.result(bits, routine.result),
    }
}

/// Commands of a use over those of its surroundings, without loads and stores of
/// logarithms; those of signs count.
fn cost(routine: &Routine) -> u32 {
    let count = |step: &str| run(&program(routine, step, false, 20_000)).instructions;
    let stored = 1;
    let idle = match (routine.form, routine.result) {
        (Form::Statement(_), _) => "let r = 0;",
        (_, Format::Bool) => "let said = 0;",
        _ => "let out = 0;",
    };
    // Signs that the ranges know are not written.
    let known = |line: &&str| routine.name.contains("known_") && line.starts_with("let rPlus");
    let usage = usage(routine);
    let usage: Vec<&str> = usage.lines().filter(|line| !known(line)).collect();
    let difference = (count(&usage.join("\n")) - count(idle)) as f64 / 20_000.0;
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
