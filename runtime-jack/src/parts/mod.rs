//! The Jack source of the routines: a part is one subroutine of a class, or the
//! class's declarations.
//!
//! A part is named `Class.subroutine`; the class's own name alone is its head.
//! [`classes`] puts together the classes that are needed. A subroutine called
//! `make...` fills a static and is called once, by the class's `init`.
//!
//! Rules that the source keeps: no division of or by a negative (the official
//! system truncates, the web's floors), no difference beyond 16 bits in a
//! comparison (a translated program compares by subtracting), parentheses
//! everywhere (Jack has no precedence), nothing allocated but in `make...`.

#[macro_use]
pub(crate) mod float;
#[macro_use]
mod float_sums;
#[macro_use]
mod fixed;
#[macro_use]
pub(crate) mod functions;
pub(crate) mod int;
mod log;
mod log_far;
mod log_functions;
mod log_tables;
mod powers;
#[macro_use]
mod processor;
mod fixed_bits;
mod fixed_functions;
mod rounded;
mod rounded_bits;

use slowlight_routine::{Part, Source};

#[rustfmt::skip]
pub(crate) static ALL: &[Part] = &[
    part!("Float", [], 60, float::HEAD),
    part!("Float.makePowers", [], 120, float::MAKE_POWERS, 387),
    part!("Float.makeRoot", [], 40, float::MAKE_ROOT, 33),
    part!("Float.makeRoots", [], 150, rounded::MAKE_ROOTS, 11_456),
    part!("Float.constant", [], 40, float::CONSTANT),
    part!("Float.copy", [], 60, float::COPY),
    part!("Float.neg", [], 60, float::NEG),
    part!("Float.abs", [], 60, float::ABS),
    part!("Float.mul", [], 360, float::MUL),
    part!("Float.scale", [], 140, float::SCALE),
    part!("Float.add", ["Float.makePowers"], 520, float_sums::ADD),
    part!("Float.sub", ["Float.makePowers"], 530, float_sums::SUB),
    part!("Float.div", [], 420, float::DIV),
    part!("Float.sqrt", ["Float.makeRoot", "Float.add", "Float.ratio", "Float.scale", "Float.copy"], 280, float::SQRT),
    part!("Float.less", [], 260, float::LESS),
    part!("Float.equal", [], 120, float::EQUAL),
    part!("Float.negative", [], 40, float::NEGATIVE),
    part!("Float.positive", [], 40, float::POSITIVE),
    part!("Float.min", ["Float.less", "Float.copy"], 80, float::MIN),
    part!("Float.max", ["Float.less", "Float.copy"], 80, float::MAX),
    part!("Float.sign", [], 40, float::SIGN),
    part!("Float.floor", ["Float.makePowers"], 240, float::FLOOR),
    part!("Float.round", ["Float.makePowers"], 220, float::ROUND),
    part!("Float.mod", ["Float.copy", "Float.add"], 340, float::MOD),
    part!("Float.fromInt", [], 180, float::FROM_INT),
    part!("Float.fraction", [], 180, functions::FRACTION),
    part!("Float.part", ["Float.makePowers"], 300, functions::PART),
    part!("Float.set", [], 80, functions::SET),
    part!("Float.product", [], 520, functions::PRODUCT),
    part!("Float.ratio", [], 500, functions::RATIO),
    part!("Float.makeShape", [], 80, functions::MAKE_SHAPE, 19),
    part!("Float.makeQuarter", ["Float.set"], 100, functions::MAKE_QUARTER, 36),
    part!("Float.makeExcess", ["Float.set"], 120, functions::MAKE_EXCESS, 50),
    part!("Float.quarterSine", ["Float.makeShape", "Float.makeQuarter", "Float.makeExcess", "Float.fraction", "Float.part", "Float.product", "Float.add", "Float.sub", "Float.scale", "Float.fromInt"], 980, functions::SINE),
    part!("Float.sin", ["Float.quarterSine"], 100, functions::SIN),
    part!("Float.cos", ["Float.quarterSine"], 60, functions::COS),
    part!("Float.makeTangent", [], 80, functions::MAKE_TANGENT, 19),
    part!("Float.tan", ["Float.makeTangent", "Float.sin", "Float.cos", "Float.ratio"], 80, functions::TAN),
    part!("Float.atan2", ["Float.makeShape", "Float.makeQuarter", "Float.fraction", "Float.part", "Float.product", "Float.ratio", "Float.sub", "Float.scale"], 700, functions::ATAN2),
    part!("Float.arc", ["Float.makeShape", "Float.fraction", "Float.part", "Float.product", "Float.sqrt", "Float.scale", "Float.fromInt"], 640, functions::ARC),
    part!("Float.asin", ["Float.makeQuarter", "Float.arc", "Float.sub"], 120, functions::ASIN),
    part!("Float.acos", ["Float.makeQuarter", "Float.arc", "Float.sub"], 220, functions::ACOS),
    part!("Float.exponent", ["Float.makePowers", "Float.fraction"], 1400, powers::EXPONENT),
    part!("Float.exp", ["Float.exponent"], 100, powers::EXP),
    part!("Float.nearLog", ["Float.makeShape", "Float.fraction", "Float.part", "Float.product"], 640, powers::NEAR_LOG),
    part!("Float.makeLog", ["Float.set"], 120, powers::MAKE_LOG, 50),
    part!("Float.log", ["Float.makeLog", "Float.nearLog", "Float.fromInt", "Float.product", "Float.add"], 200, powers::LOG),
    part!("Float.pow", ["Float.makeLog", "Float.nearLog", "Float.exponent", "Float.copy", "Float.product"], 840, powers::POW),
    part!("Log", [], 0, log::HEAD),
    part!("Log.makePowers", ["Log.makeWhite"], 330, log::MAKE_POWERS, 186_855),
    part!("Log.makeLogs", ["Log.makePowers"], 200, log::MAKE_LOGS, 40_906),
    part!("Log.makeHalves", [], 80, log::MAKE_HALVES, 8_205),
    part!("Log.makeSums", ["Log.makePowers"], 150, log::MAKE_SUMS, 203_967),
    part!("Log.makeDifferences", ["Log.makeLogs"], 650, log::MAKE_DIFFERENCES, 262_902),
    part!("Log.makeWhite", [], 40, log::MAKE_WHITE, 36_912),
    part!("Log.whole", ["Log.makeLogs", "Log.makeHalves"], 420, log::WHOLE),
    made("Log.farSum", 720, log_far::sum),
    made("Log.farDifference", 750, log_far::difference),
    part!("Log.clamp", [], 60, log::CLAMP),
    part!("Log.sum", ["Log.makeSums", "Log.farSum"], 140, log::SUM),
    part!("Log.left", ["Log.makeDifferences", "Log.farDifference"], 110, log::LEFT),
    part!("Log.rest", ["Log.makeDifferences", "Log.farDifference"], 80, log::REST),
    part!("Log.difference", ["Log.makeDifferences", "Log.farDifference"], 140, log::DIFFERENCE),
    part!("Log.leave", ["Log.makeDifferences", "Log.farDifference"], 120, log::LEAVE),
    part!("Log.add", ["Log.makeSums", "Log.makeDifferences", "Log.farSum", "Log.farDifference"], 300, log::ADD),
    part!("Log.half", ["Log.makeHalves"], 420, log::HALF),
    part!("Log.root", ["Log.half"], 40, log::ROOT),
    part!("Log.less", [], 60, log::LESS),
    part!("Log.fromInt", ["Log.sum", "Log.makeLogs"], 130, log::FROM_INT),
    part!("Log.floor", ["Log.whole"], 100, log::FLOOR),
    part!("Log.round", ["Log.whole"], 60, log::ROUND),
    part!("Log.sign", [], 30, log::SIGN),
    part!("Log.mod", ["Log.add", "Log.floor", "Log.fromInt", "Log.clamp"], 120, log::MOD),
    part!("Log.sine", ["Log.whole", "Log.add", "Log.leave"], 300, log_functions::SINE),
    part!("Log.sin", ["Log.sine"], 40, log_functions::SIN),
    part!("Log.tan", ["Log.sine", "Log.clamp"], 80, log_functions::TAN),
    part!("Log.angle", ["Log.sum", "Log.difference", "Log.leave"], 200, log_functions::ANGLE),
    part!("Log.atan2", ["Log.angle"], 50, log_functions::ATAN2),
    part!("Log.asin", ["Log.angle", "Log.half"], 50, log_functions::ASIN),
    part!("Log.acos", ["Log.angle", "Log.half"], 80, log_functions::ACOS),
    part!("Log.units", ["Log.whole"], 160, log_functions::UNITS),
    part!("Log.exp", ["Log.units"], 50, log_functions::EXP),
    part!("Log.log", ["Log.fromInt", "Log.add"], 80, log_functions::LOG),
    part!("Log.pow", ["Log.units", "Log.fromInt", "Log.add"], 280, log_functions::POW),
    part!("Fixed", [], 0, fixed::HEAD),
    part!("Fixed.makeRoots", ["Fixed.mul"], 200, fixed::MAKE_ROOTS, 127_798),
    part!("Fixed.left", [], 70, fixed::LEFT),
    part!("Fixed.right", [], 90, fixed::RIGHT),
    part!("Fixed.mul", [], 320, fixed::MUL),
    part!("Fixed.halfMul", [], 310, fixed::HALF_MUL),
    part!("Fixed.wideMul", [], 380, fixed::WIDE_MUL),
    part!("Fixed.div", [], 560, fixed::DIV),
    part!("Fixed.root", ["Fixed.makeRoots", "Fixed.right"], 230, fixed::SQRT),
    part!("Fixed.doubleRoot", ["Fixed.root"], 90, fixed::DOUBLE_SQRT),
    part!("Fixed.makeSines", ["Fixed.mul"], 400, fixed::MAKE_SINES, 12_830),
    part!("Fixed.turns", ["Fixed.halfMul"], 60, fixed::TURNS),
    part!("Fixed.sin", ["Fixed.makeSines"], 210, fixed::SIN),
    part!("Fixed.floor", [], 70, fixed::FLOOR),
    part!("Fixed.makeArcs", ["Fixed.div"], 140, fixed_functions::MAKE_ARCS, 51_001),
    part!("Fixed.makePowers", ["Fixed.mul"], 200, fixed_functions::MAKE_POWERS, 25_965),
    part!("Fixed.makeLogs", ["Fixed.div"], 130, fixed_functions::MAKE_LOGS, 67_119),
    part!("Fixed.entry", [], 110, fixed_functions::ENTRY),
    part!("Fixed.tan", ["Fixed.sin", "Fixed.div"], 50, fixed_functions::TAN),
    part!("Fixed.arc", ["Fixed.makeArcs", "Fixed.entry", "Fixed.div"], 40, fixed_functions::ARC),
    part!("Fixed.atan2", ["Fixed.arc"], 190, fixed_functions::ATAN2),
    part!("Fixed.halfArc", ["Fixed.arc", "Fixed.root"], 100, fixed_functions::HALF_ARC),
    part!("Fixed.asin", ["Fixed.halfArc"], 50, fixed_functions::ASIN),
    part!("Fixed.acos", ["Fixed.halfArc"], 70, fixed_functions::ACOS),
    part!("Fixed.power", ["Fixed.makePowers", "Fixed.entry", "Fixed.mul", "Fixed.right"], 380, fixed_functions::POWER),
    part!("Fixed.exp", ["Fixed.power"], 40, fixed_functions::EXP),
    part!("Fixed.log", ["Fixed.makeLogs", "Fixed.entry", "Fixed.mul", "Fixed.left", "Fixed.right", "Int.add"], 210, fixed_functions::LOG),
    part!("Fixed.smallLog", ["Fixed.log", "Fixed.right"], 60, fixed_functions::SMALL_LOG),
    part!("Fixed.pow", ["Fixed.makeLogs", "Fixed.entry", "Fixed.power"], 280, fixed_functions::POW),
    part!("Int", [], 0, ""),
    part!("Int.magnitude", [], 60, int::MAGNITUDE),
    part!("Int.add", [], 120, int::ADD),
    part!("Int.sub", [], 120, int::SUB),
    part!("Int.mul", ["Int.magnitude"], 140, int::MUL),
    part!("Int.div", ["Int.magnitude"], 160, int::DIV),
    part!("Int.mod", ["Int.magnitude"], 160, int::MOD),
    part!("Int.xor", [], 60, int::XOR),
    part!("Int.sign", [], 60, int::SIGN),
    part!("Int.less", [], 100, int::LESS),
    part!("Int.min", ["Int.less"], 60, int::MIN),
    part!("Int.max", ["Int.less"], 60, int::MAX),
];

/// A subroutine that is written from a table, and needs nothing else.
const fn made(name: &'static str, bytes: u32, write: fn() -> String) -> Part {
    Part {
        name,
        source: Source::Made(write),
        needs: &[],
        bytes,
        starts: 0,
    }
}

/// What `f316r` has in their places.
#[rustfmt::skip]
const OF_ROUNDED: &[Part] = &[
    part!("Float.add", ["Float.makePowers"], 620, rounded::ADD),
    part!("Float.sub", ["Float.makePowers"], 630, rounded::SUB),
    part!("Float.sqrt", ["Float.makeRoots"], 300, rounded::SQRT),
];

/// The parts of `f316r`.
pub(crate) static ROUNDED: [Part; ALL.len()] = {
    let mut parts = [ALL[0]; ALL.len()];
    let mut k = 0;
    while k < ALL.len() {
        parts[k] = ALL[k];
        let mut other = 0;
        while other < OF_ROUNDED.len() {
            if same(ALL[k].name, OF_ROUNDED[other].name) {
                parts[k] = OF_ROUNDED[other];
            }
            other += 1;
        }
        k += 1;
    }
    parts
};

const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut k = 0;
    while k < a.len() && k < b.len() && a[k] == b[k] {
        k += 1;
    }
    k == a.len() && k == b.len()
}

/// What takes the place of texts on the processor; their needs are as large.
const ON_PROCESSOR: &[(&str, &str)] = &[
    (float::MAKE_POWERS, processor::MAKE_POWERS_AND_SHIFT),
    (float_sums::ADD, float_sums::ADD_SHIFTED),
    (float_sums::SUB, float_sums::SUB_SHIFTED),
    (float::MUL, processor::MUL),
    (float::DIV, processor::DIV),
    (functions::PRODUCT, rounded_bits::PRODUCT),
    (functions::RATIO, rounded_bits::RATIO),
    (rounded::ADD, rounded::ADD_SHIFTED),
    (rounded::SUB, rounded::SUB_SHIFTED),
    (rounded::MAKE_ROOTS, rounded_bits::MAKE_NO_ROOTS),
    (rounded::SQRT, rounded_bits::SQRT),
    (fixed::MUL, fixed_bits::MUL),
    (log::SUM, log::SUM_BY_SIGN),
    (fixed::HALF_MUL, fixed_bits::HALF_MUL),
    (fixed::WIDE_MUL, fixed_bits::WIDE_MUL),
    (fixed::LEFT, fixed_bits::LEFT),
    (fixed::RIGHT, fixed_bits::RIGHT),
    (fixed::DIV, fixed_bits::DIV),
    (fixed::SQRT, fixed_bits::SQRT),
    (fixed::DOUBLE_SQRT, fixed_bits::DOUBLE_SQRT),
    (fixed_functions::ENTRY, fixed_bits::ENTRY),
];

/// [`classes`] for a program that runs on the Hack's processor: the same values in
/// fewer cycles, and in more VM commands.
pub fn classes_for_processor(parts: &[&Part]) -> Vec<(&'static str, String)> {
    let own = |part: &&Part| {
        let Source::Text(usual) = part.source else {
            return **part;
        };
        let other = ON_PROCESSOR.iter().find(|(text, _)| *text == usual);
        Part {
            source: other.map_or(part.source, |(_, text)| Source::Text(text)),
            ..**part
        }
    };
    let parts: Vec<Part> = parts.iter().map(own).collect();
    classes(&parts.iter().collect::<Vec<&Part>>())
}

/// The classes that hold the given parts (closed over their needs, in the
/// runtime's order), each as its name and its text. A class's `init`, where
/// there is one, must be called once before anything else of it.
pub fn classes(parts: &[&Part]) -> Vec<(&'static str, String)> {
    let mut names: Vec<&'static str> = Vec::new();
    for part in parts {
        let name = class_of(part);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let text = |name| {
        let own: Vec<&Part> = parts
            .iter()
            .copied()
            .filter(|p| class_of(p) == name)
            .collect();
        let init = has_init(name, &own).then(|| init(makers(name, &own)));
        // Where the class has a head of its own, that is among them.
        let head = own.iter().any(|part| part.name == name);
        let all = if head {
            own.iter().map(|part| **part).collect()
        } else {
            ALL.to_vec()
        };
        (name, class(&all, name, &own, init))
    };
    names.into_iter().map(text).collect()
}

/// Whether a class with these parts has an `init`.
pub fn has_init(class: &str, parts: &[&Part]) -> bool {
    makers(class, parts).next().is_some()
}

pub(crate) fn class_of(part: &Part) -> &'static str {
    part.name.split('.').next().unwrap_or(part.name)
}

/// The subroutines that `init` calls.
pub(crate) fn makers<'p>(
    class: &'p str,
    parts: &'p [&Part],
) -> impl Iterator<Item = &'static str> + 'p {
    let own = parts.iter().filter(move |p| class_of(p) == class);
    own.map(|p| p.name).filter(|name| name.contains(".make"))
}

/// An `init` that calls these.
pub(crate) fn init(makers: impl Iterator<Item = &'static str>) -> String {
    let calls = makers.map(|maker| format!("        do {maker}();\n"));
    let calls: String = calls.collect();
    format!("    function void init() {{\n{calls}        return;\n    }}\n")
}

/// A class from its parts, which are some of `all`, and its `init`.
pub(crate) fn class(all: &[Part], name: &str, parts: &[&Part], init: Option<String>) -> String {
    let head = all.iter().filter(|p| p.name == name);
    let rest = parts.iter().copied().filter(|p| p.name != name);
    // Jack wants declarations first: those of a part go up.
    let mut declared = String::new();
    let mut written: Vec<String> = Vec::new();
    for part in head.chain(rest) {
        let text = match part.source {
            Source::Text(text) => text.to_owned(),
            Source::Made(write) => write(),
            Source::Table(_) => continue,
        };
        let mut code = String::new();
        for line in text.lines().map(|line| format!("{line}\n")) {
            match line.trim_start().split(' ').next() {
                Some("field" | "static") => declared.push_str(&line),
                _ => code.push_str(&line),
            }
        }
        written.push(code.trim_start_matches('\n').to_owned());
    }
    if let Some(init) = init {
        written.insert(1.min(written.len()), init);
    }
    written.insert(0, declared);
    written.retain(|t| !t.is_empty());
    format!("class {name} {{\n{}}}\n", written.join("\n"))
}
