//! The Jack source of routines in fixed point against their models, with the VM's texts
//! and the processor's; and what a use of each costs.

use super::{computed, edges, numbers, own};
use crate::classes;
use crate::fixed::{FIXED16, filled, read};
use crate::model::MOST;
use crate::tests::generator::{Generator, STIR, Sums, all_pairs};
use crate::tests::machine::{pairs, run};
use slowlight_routine::{Form, Format, Op, Range, Routine, scale};

const MAIN: &str = "
    static int seed, block, first, second, a, b, out;
    static boolean said;

    function int random() {
        let seed = (seed * 25173) + 13849;
        return (seed + block) & 32767;
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

/// The operands of the harness's pair `k`.
fn drawn(generator: &mut Generator, k: u32, most: i32) -> [i32; 2] {
    if k.is_multiple_of(1000) {
        generator.stir();
    }
    [0; 2].map(|_| any(generator, most))
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
fn program(
    needs: &[&'static str],
    step: &str,
    (most, edges): (i32, &[i32]),
    count: u32,
) -> Vec<(String, String)> {
    let parts = FIXED16.closure(needs.iter().copied().chain(["Fixed"]));
    let mut main =
        format!("class Main {{\n{MAIN}    function void step() {{\n{step}\nreturn;\n}}\n");
    main += "    function void main() {\nvar int k, l;\nvar Array edges;\n";
    if crate::has_init("Fixed", &parts) {
        main += "do Fixed.init();\n";
    }
    main += &all_pairs(edges, ["a", "b"], "do Main.step();\n");
    let stir = if step.contains("note(") { STIR } else { "" };
    main += &format!(
        "let seed = 1;\nlet l = {};\nwhile (l > 0) {{\nlet k = 1000;\n{stir}\nwhile (k > 0) {{\n\
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
        computes_what_its_model_does(routine, &|_, text| text);
    }
}

/// Those of whose parts the processor has others.
#[test]
fn routines_for_the_processor_do_so_too() {
    for routine in own().filter(|r| !r.needs.is_empty()) {
        let parts = FIXED16.closure(routine.needs.iter().copied().chain(["Fixed"]));
        let bits = crate::classes_for_processor(&parts);
        computes_what_its_model_does(routine, &|file, text| {
            let own = bits.iter().find(|(name, _)| file == format!("{name}.jack"));
            own.map_or(text, |(_, other)| other.clone())
        });
    }
}

fn computes_what_its_model_does(routine: &Routine, class: &dyn Fn(&str, String) -> String) {
    let most = greatest(routine);
    let note = match routine.result {
        Format::Bool => "do Main.note(said);",
        _ => "do Main.note(out);",
    };
    let numbers = numbers(routine);
    let count = pairs() / numbers.len() as u32 / 1000 * 1000 + 1000;
    for n in numbers {
        let step = format!("{} {note}", usage(routine, n));
        let edges: Vec<i32> = edges().iter().map(|a| (*a).clamp(-most, most)).collect();
        let files = program(routine.needs, &step, (most, &edges), count).into_iter();
        let files = files.map(|(name, text)| (name.clone(), class(&name, text)));
        let found = run(&files.collect::<Vec<_>>());
        let (mut sums, mut generator) = (Sums::default(), Generator(1));
        let pairs = edges
            .iter()
            .flat_map(|a| edges.iter().map(move |b| [*a, *b]));
        let drawn = (0..count).map(|k| drawn(&mut generator, k, most));
        for args in pairs.chain(drawn) {
            let args = &args[..routine.args.len()];
            sums.result(computed(routine, args, n), routine.result);
        }
        let Sums(first, second) = sums;
        let name = routine.name;
        assert_eq!(found.text, format!("{first} {second}"), "{name} with {n}");
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
            let found = run(&program(&needs, &step, (most, &[]), 2000));
            let (mut sums, mut generator) = (Sums::default(), Generator(1));
            for k in 0..2000 {
                let [a, _] = drawn(&mut generator, k, most);
                sums.note(scale::shifted(i64::from(a), by, crate::fixed::BITS) as i32);
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
        run(&program(
            routine.needs,
            step,
            (greatest(routine), &[]),
            20_000,
        ))
        .instructions as f64
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
