//! Every routine's Jack on the machine against its model, bit for bit: all
//! pairs of edge operands and as many random ones as `SLOWLIGHT_PAIRS` says
//! (20,000 unless told); and what a use of it costs.
//!
//! Operands are made by the Jack program itself, by a generator that is stated
//! here a second time; the results are summed up in two words of 16 bits each.

use super::generator::{Generator, STIR, Sums};
use super::{edges, int_edges};
use crate::model::{Float, int};
use crate::wide::F416;
use crate::{F316, F316R, classes, classes_for_processor, has_init};
use slowlight_routine::{Bits, Form, Format, Part, Routine, Runtime};
use slowlight_vm::Stop;
use slowlight_vm::hack::jack;
use slowlight_vm::hack::vm::{Machine, Program, Run};

const MAIN: &str = "
    static int seed, block, first, second, i, j, out;
    static boolean p, q, said;
    static Array es, ms, ls, ints;
    static Float a, b, r;

    function int random() {
        let seed = (seed * 25173) + 13849;
        return (seed + block) & 32767;
    }

    function void anyFloat(Array f) {
        var int kind;
        let kind = Main.random() / 4096;
        if (kind = 0) { let f[1] = Math.min(8000, Main.random() - 8000); }
        else { let f[1] = 117 + (Main.random() / 1638); }
        let f[0] = Main.random() / 16384;
        let f[2] = 8192 + (Main.random() / 4);
        if (kind = 7) {
            if (Main.random() < 4096) { let f[1] = 0; let f[2] = 0; }
        }
        return;
    }

    function int anyInt() {
        var int kind, whole;
        let kind = Main.random() / 8192;
        let whole = Main.random();
        if (kind = 0) { return ((whole - 16384) * 2) + (Main.random() / 16384); }
        if (kind = 1) { return (whole / 64) - 256; }
        return (whole / 2048) - 8;
    }

    function void edge(Array f, int k) {
        var int n;
        let f[1] = 0;
        let f[2] = 0;
        if (k < 2) { let f[0] = k; return; }
        let n = (k - 2) / 2;
        let f[0] = k & 1;
        let f[1] = es[n / 5];
        let f[2] = ms[n - ((n / 5) * 5)];
        return;
    }

    function void noteFloat(Array f) {
        do Main.note(f[0]);
        do Main.note(f[1]);
        do Main.note(f[2]);
        return;
    }

    function void note(int word) {
        let first = (first * 31) + word;
        let second = ((second + word) * 25173) + 1;
        return;
    }
";

/// The harness of reals in a format.
fn main_of(real: Format) -> String {
    match real {
        Format::Float416 => MAIN
            .replace("] = 0; }", "] = 0; let f[3] = 0; }")
            .replace("f[2] = 0;\n", "f[2] = 0;\n let f[3] = 0;\n")
            .replace("/ 4);\n", "/ 4);\n let f[3] = Main.random() / 2;\n")
            .replace("note(f[2]);", "note(f[2]); do Main.note(f[3]);")
            .replace("= ms[", "= ms[n - ((n / 5) * 5)];\n let f[3] = ls["),
        _ => MAIN.to_owned(),
    }
}

/// What the harness calls operand `k` of a format.
fn operand(format: Format, k: usize) -> &'static str {
    let names = match format {
        Format::Bool => ["p", "q"],
        format if format.is_object() => ["a", "b"],
        _ => ["i", "j"],
    };
    names[k]
}

/// One use of a routine, as a statement.
fn usage(routine: &Routine) -> String {
    let fill = |template: &str| {
        let mut text = template.replace("{r}", "r");
        for (k, format) in routine.args.iter().enumerate() {
            text = text.replace(&format!("{{{k}}}"), operand(*format, k));
        }
        text
    };
    let result = if routine.result == Format::Bool {
        "said"
    } else {
        "out"
    };
    match routine.form {
        Form::Statement(template) => format!("do {};", fill(template)),
        Form::Expression { template, .. } => format!("let {result} = {};", fill(template)),
    }
}

/// What the harness puts before a use, so that no division is by what the
/// routine's domain excludes.
fn excluded(routine: &Routine, args: &[Bits]) -> bool {
    routine.name == "int_quotient" && (int(args[0]) < 0 || int(args[1]) <= 0)
}

/// A program around the statement `step`, which sees the operands.
fn program(
    (runtime, routine): (&Runtime, &Routine),
    step: &str,
    with_edges: bool,
    pairs: u32,
    classes: &Classes,
) -> Vec<(String, String)> {
    let mut main = String::from("class Main {\n");
    main += &main_of(runtime.real);
    main += "    function void step() {\n";
    if routine.name == "int_quotient" {
        main += "        if ((i < 0) | (j < 1)) { return; }\n";
    }
    main += &format!("        {step}\n        return;\n    }}\n");
    let list = |name: &str, values: &[i32]| {
        let mut text = format!("        let {name} = Array.new({});\n", values.len());
        for (k, v) in values.iter().enumerate() {
            let v = if *v == -32768 {
                "-32767 - 1".to_owned()
            } else {
                v.to_string()
            };
            text += &format!("        let {name}[{k}] = {v};\n");
        }
        text
    };
    main += "    function void main() {\n        var int k, l;\n";
    let parts = runtime.closure(routine.needs.iter().copied().chain(["Float"]));
    if has_init("Float", &parts) {
        main += "        do Float.init();\n";
    }
    main += "        let a = Float.new();\n        let b = Float.new();\n        let r = Float.new();\n";
    main += &list("es", super::EXPONENTS);
    main += &list("ms", super::MANTISSAS);
    main += &list("ls", super::LOWER);
    main += &list("ints", &int_edges());
    let set = |k: usize, index: &str| match routine.args.get(k) {
        None => String::new(),
        Some(Format::Bool) => format!("let {} = ({index} = 1);", ["p", "q"][k]),
        Some(f) if f.is_object() => format!("do Main.edge({}, {index});", ["a", "b"][k]),
        Some(_) => format!("let {} = ints[{index}];", ["i", "j"][k]),
    };
    let any = |k: usize| match routine.args.get(k) {
        None => String::new(),
        Some(Format::Bool) => format!("let {} = Main.random() < 16384;", ["p", "q"][k]),
        Some(f) if f.is_object() => format!("do Main.anyFloat({});", ["a", "b"][k]),
        Some(_) => format!("let {} = Main.anyInt();", ["i", "j"][k]),
    };
    let count = |k: usize| routine.args.get(k).map_or(1, |f| edges(*f).len());
    if with_edges {
        main += &format!(
            "        while (k < {}) {{
            {}
            let l = 0;
            while (l < {}) {{ {} do Main.step(); let l = l + 1; }}
            let k = k + 1;
        }}\n",
            count(0),
            set(0, "k"),
            count(1),
            set(1, "l"),
        );
    }
    // What is run on the edges is compared, not counted.
    let stir = if with_edges { STIR } else { "" };
    main += &format!(
        "        let seed = 1;
        let l = {};
        while (l > 0) {{
            let k = 1000;
            {stir}
            while (k > 0) {{ {} {} do Main.step(); let k = k - 1; }}
            let l = l - 1;
        }}
        do Output.printInt(first);
        do Output.printChar(32);
        do Output.printInt(second);
        return;\n    }}\n}}\n",
        pairs / 1000,
        any(0),
        any(1),
    );
    let mut files = vec![("Main.jack".to_owned(), main)];
    files.extend(
        classes(&parts)
            .into_iter()
            .map(|(name, text)| (format!("{name}.jack"), text)),
    );
    files
}

pub fn run(files: &[(String, String)]) -> Run {
    let compiled =
        jack::compile(files).unwrap_or_else(|faults| panic!("{}\n{}", faults[0], files[0].1));
    let texts: Vec<(String, String)> = compiled.into_iter().map(|f| (f.name, f.text)).collect();
    let program = Program::link(&texts).unwrap_or_else(|faults| panic!("{}", faults[0]));
    let run = Machine::new(&program).run(20_000_000_000, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended, "{}", run.text);
    run
}

pub fn pairs() -> u32 {
    let told = std::env::var("SLOWLIGHT_PAIRS").ok();
    told.and_then(|n| n.parse().ok()).unwrap_or(20_000)
}

/// What the models make of the same operands.
fn expected(routine: &Routine, with_edges: bool, pairs: u32) -> Sums {
    let mut sums = Sums::default();
    let mut note = |args: &[Bits]| {
        if !excluded(routine, args) {
            sums.result((routine.model)(args), routine.result);
        }
    };
    let binary = routine.args.len() > 1;
    if with_edges {
        for a in edges(routine.args[0]) {
            match routine.args.get(1) {
                Some(format) => edges(*format).into_iter().for_each(|b| note(&[a, b])),
                None => note(&[a]),
            }
        }
    }
    let mut generator = Generator(1);
    for k in 0..pairs / 1000 * 1000 {
        if with_edges && k % 1000 == 0 {
            generator.stir();
        }
        let a = generator.bits(routine.args[0]);
        if binary {
            let b = generator.bits(routine.args[1]);
            note(&[a, b]);
        } else {
            note(&[a]);
        }
    }
    sums
}

/// The use, and noting what it gave.
fn noted(routine: &Routine) -> String {
    let usage = usage(routine);
    let notes = match (routine.form, routine.result) {
        (Form::Statement(_), _) => "do Main.noteFloat(r);",
        (_, Format::Bool) => "do Main.note(said);",
        _ => "do Main.note(out);",
    };
    format!("{usage} {notes}")
}

#[test]
fn routines_compute_what_their_models_do() {
    for routine in F316.routines {
        computes_what_its_model_does((&F316, routine), &classes);
    }
}

#[test]
fn rounded_routines_compute_what_their_models_do() {
    for routine in F316R.routines {
        computes_what_its_model_does((&F316R, routine), &classes);
    }
}

#[test]
fn wide_routines_compute_what_their_models_do() {
    for routine in F416.routines {
        computes_what_its_model_does((&F416, routine), &classes);
    }
}

/// Only those of whose parts the processor has others.
#[test]
fn routines_for_the_processor_do_so_too() {
    for runtime in [&F316, &F316R] {
        for name in ["add", "sub", "mul", "div", "sqrt", "tan", "asin"] {
            let routine = runtime.routines.iter().find(|r| r.name == name).unwrap();
            computes_what_its_model_does((runtime, routine), &classes_for_processor);
        }
    }
}

type Classes = dyn Fn(&[&Part]) -> Vec<(&'static str, String)>;

fn computes_what_its_model_does((runtime, routine): (&Runtime, &Routine), classes: &Classes) {
    let use_of = (runtime, routine);
    let files = program(use_of, &noted(routine), true, pairs(), classes);
    let Sums(first, second) = expected(routine, true, pairs());
    assert_eq!(
        run(&files).text,
        format!("{first} {second}"),
        "{} {}",
        runtime.format,
        routine.name
    );
}

#[test]
fn a_wrong_routine_would_be_found() {
    let mul = F316.routines.iter().find(|r| r.name == "mul").unwrap();
    let sums = expected(mul, false, 1000);
    let off = Routine {
        model: |args| (mul_model(args)) ^ 1,
        ..*mul
    };
    assert_ne!(sums, expected(&off, false, 1000));
}

fn mul_model(args: &[Bits]) -> Bits {
    Float::from_bits(args[0])
        .mul(Float::from_bits(args[1]))
        .bits()
}

/// Commands of a use over those of its surroundings, without the operands'
/// loads; operands from 2^-10 to 2^11, roots from 0.
fn cost(runtime: &Runtime, routine: &Routine) -> u32 {
    let count = |step: &str| {
        let mut files = program((runtime, routine), step, false, 20_000, &classes);
        let main = files[0]
            .1
            .replace("if (kind = 0) { let f[1]", "if (kind = 9) { let f[1]");
        files[0].1 = match routine.name {
            "sqrt" | "log" => main.replace("let f[0] = Main.random() / 16384;", "let f[0] = 0;"),
            _ => main,
        };
        run(&files).instructions
    };
    let (idle, stored) = match routine.form {
        Form::Statement(_) => ("", 0),
        Form::Expression { .. } if routine.result == Format::Bool => ("let said = 0;", 1),
        Form::Expression { .. } => ("let out = 0;", 1),
    };
    let used = if routine.name == "int_quotient" {
        20_000 - skipped(routine)
    } else {
        20_000
    };
    let difference = (count(&usage(routine)) - count(idle)) as f64 / f64::from(used);
    (difference + f64::from(stored)).round() as u32 - routine.args.len() as u32
}

/// How many random pairs the harness passes over.
fn skipped(routine: &Routine) -> u32 {
    let mut generator = Generator(1);
    let pairs = (0..20_000).map(|_| {
        [
            generator.bits(routine.args[0]),
            generator.bits(routine.args[1]),
        ]
    });
    pairs.filter(|args| excluded(routine, args)).count() as u32
}

#[test]
fn routines_cost_what_they_say() {
    let differ = |runtime: &'static Runtime| {
        runtime.routines.iter().filter_map(move |r| {
            let measured = cost(runtime, r);
            let said = (runtime.format, r.name, r.cycles);
            (measured != r.cycles).then(|| format!("{said:?}: {measured}"))
        })
    };
    let differ = [&F316, &F316R, &F416].into_iter().flat_map(differ);
    assert_eq!(differ.collect::<Vec<_>>(), Vec::<String>::new());
}
