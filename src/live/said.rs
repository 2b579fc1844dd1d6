//! Diagnostics and params as the page takes them: with places in UTF-16.

use super::shown::{Param, Part, Problem, Problems};
use crate::diagnostics;
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::sema::{Program, Ty};
use slowlight_compiler::source::{Diagnostic, Sources, Span};
use slowlight_routine::Type;

/// How many problems the page is told of.
const MOST: usize = 50;

/// How many units of UTF-16 come before a byte of a text.
fn utf16(text: &str, byte: usize) -> usize {
    let before = text.char_indices().take_while(|(at, _)| *at < byte);
    before.map(|(_, c)| c.len_utf16()).sum()
}

/// What is said about the text of a wish.
pub fn problems(serial: u64, sources: &Sources, said: &[Diagnostic]) -> Problems {
    let own = sources.files.first().map_or("", |file| file.text.as_str());
    let problem = |d: &Diagnostic| {
        let (line, column) = sources.line_column(d.span);
        let at = |byte: usize| utf16(own, byte);
        let (from, to, file) = match d.span.file {
            0 => (at(d.span.range().start), at(d.span.range().end), None),
            other => {
                let file = sources.files.get(usize::from(other));
                (0, 0, Some(file.map_or("", |f| f.name.as_str()).to_owned()))
            }
        };
        let label = Some(&d.label).filter(|label| !label.is_empty());
        let parts = [Some(&d.message), label, d.help.as_ref()];
        Problem {
            severity: if d.is_error() { "error" } else { "warning" },
            message: parts
                .into_iter()
                .flatten()
                .cloned()
                .collect::<Vec<_>>()
                .join("\n"),
            file,
            line,
            column,
            from,
            to,
        }
    };
    let sorted = diagnostics::sorted(sources, said);
    Problems {
        serial,
        list: sorted.into_iter().take(MOST).map(problem).collect(),
        text: diagnostics::render(sources, said, false),
    }
}

/// What angles are written in where a param's value is.
fn unit(written: &str) -> (&'static str, f64) {
    let units = [
        ("deg", std::f64::consts::PI / 180.0),
        ("turn", std::f64::consts::TAU),
    ];
    let found = units.into_iter().find(|(unit, _)| written.contains(unit));
    found.unwrap_or(("rad", 1.0))
}

/// The params of a program and of its graph, which has their numbers.
pub fn params(sources: &Sources, program: &Program, graph: &Graph) -> Vec<Param> {
    let text = |span: Span| sources.text(span);
    let own = sources.files.first().map_or("", |file| file.text.as_str());
    let param = |param: &slowlight_compiler::sema::Param| {
        let scalars = graph.params.iter().filter(|p| p.name == param.name);
        let part = |p: &slowlight_compiler::ir::graph::Param| Part {
            name: p.component,
            value: p.usual,
            range: p.range.map(|range| (range.lo, range.hi)),
        };
        let parts: Vec<Part> = scalars.clone().map(part).collect();
        let kind = match scalars.clone().next()?.ty {
            Type::Bool => "bool",
            Type::Int => "int",
            Type::Real => "real",
        };
        let span = param.value.value.span;
        let (unit, scale) = match param.ty {
            Ty::Angle => unit(text(span)),
            _ => ("", 1.0),
        };
        let place = (span.file == 0).then(|| {
            let range = span.range();
            (utf16(own, range.start), utf16(own, range.end))
        });
        Some(Param {
            name: param.name.clone(),
            kind,
            unit,
            scale,
            parts,
            place,
        })
    };
    program.params.iter().filter_map(param).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_in_utf_16() {
        let text = "a\u{e9}\u{1f600}b";
        let at = |c: char| utf16(text, text.find(c).expect("it is there"));
        assert_eq!((at('a'), at('\u{1f600}'), at('b')), (0, 2, 4));
        assert_eq!(utf16(text, 100), 5);
    }

    #[test]
    fn params_have_ranges_units_and_places() {
        let text = "image 8 x 8 inks black, white; // \u{e9}\n\
            param eye: vec2 = (1, 2) in (0, 0) .. (3, 4);\n\
            param turn: angle = 0.25turn in 0turn .. 1turn;\n\
            draw (x, y) = threshold(eye.x + sin(turn) * eye.y, bayer(2)[x mod 2, y mod 2]);\n";
        let scene = slowlight_compiler::scene::check("a.scn", text);
        let graph = scene.lower(&Default::default()).expect("a graph");
        let found = params(&scene.sources, &scene.program, &graph);
        let [eye, turn] = found.as_slice() else {
            panic!("{found:?}");
        };
        let names: Vec<_> = eye.parts.iter().map(|p| (p.name, p.value)).collect();
        assert_eq!(names, [("x", 1.0), ("y", 2.0)]);
        assert_eq!(eye.parts[1].range, Some((0.0, 4.0)));
        assert_eq!((turn.unit, turn.kind), ("turn", "real"));
        let (from, to) = turn.place.expect("a place");
        let written: Vec<u16> = text.encode_utf16().collect();
        let written = String::from_utf16(&written[from..to]).expect("text");
        assert_eq!(written, "0.25turn");
    }
}
