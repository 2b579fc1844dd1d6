#![allow(clippy::unwrap_used)]

use crate::backend::mos6502::syntax::{SYNTAXES, USUAL, find as find_syntax};
use crate::plan::Goal;
use crate::planner::PlannedScene;
use crate::planner::plan;
use crate::scene::check;
use crate::sema::Options;
use crate::targets::{default_mode, find, formats};
use std::collections::BTreeSet;

pub(super) fn planned(source: &str) -> PlannedScene {
    planned_in(source, "fixed16.16")
}

pub(super) fn planned_in(source: &str, format: &str) -> PlannedScene {
    let mut all = formats(find("6502:plain").unwrap());
    let target = all.find(|t| t.runtime.format == format).unwrap();
    let scene = check("test", source);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    let graph = scene
        .lower(&Options {
            offset: target.offset,
            ..Options::default()
        })
        .unwrap();
    let mode = default_mode(target, graph.image.width, graph.image.height).unwrap();
    plan(
        &graph,
        target,
        &Goal {
            name: "test".to_owned(),
            mode,
            rows: None,
            plot: true,
        },
    )
    .unwrap()
}

fn text(source: &str) -> String {
    let documents = super::emit(&planned(source));
    assert_eq!(documents.len(), 1);
    assert_eq!(documents[0].text.lines().count(), documents[0].lines.len());
    documents[0].text.clone()
}

/// The names that lines define, labels and symbols alike.
fn defined(text: &str) -> Vec<&str> {
    let name = |line: &'_ str| -> Option<usize> {
        let end = line.find([':', ' '])?;
        let symbol = line[end..].starts_with(':') || line[end..].starts_with(" = ");
        (symbol && line.starts_with(|c: char| c.is_ascii_alphabetic())).then_some(end)
    };
    text.lines()
        .filter_map(|line| name(line).map(|end| &line[..end]))
        .collect()
}

pub(super) const GRADIENT: &str = "image 8 x 4 inks black, grey, white;
param tilt: real = 0.25 in -1 .. 1;
const steps = [0, 2, 1];
draw (x, y) = if x * tilt < y - 1 then ink(steps[x mod 3, 0]) else ink(2);";

#[test]
fn a_small_scene_reads_well() {
    insta::assert_snapshot!(format!("{GRADIENT}\n\n{}", text(GRADIENT)));
}

#[test]
fn a_small_scene_with_points_of_its_own_reads_well() {
    let plan = planned_in(GRADIENT, "fixed16");
    let text = super::emit(&plan).remove(0).text;
    let program = text.split("runtime: ").next().unwrap();
    insta::assert_snapshot!(format!("{GRADIENT}\n\n{program}"));
}

/// Products at pixels, and nowhere else, are called only where memory is short.
#[test]
fn products_stand_in_place_where_there_is_room() {
    let source = "image 64 x 32 inks black, white;
        param tilt: real = 0.25 in 0.1 .. 1;
        draw (x, y) = {
          let v = sqrt(x * tilt + y);
          ink(floor(v * (v * tilt + y) * (tilt + v)) mod 2)
        };";
    let mut plan = planned_in(source, "fixed16");
    let at_pixels = |plan: &PlannedScene, what: &str| {
        let text = super::emit(plan).remove(0).text;
        let pixel = text.split("once a pixel").nth(1).unwrap();
        let pixel = pixel.split("picture_done:").next().unwrap();
        pixel.lines().filter(|line| line.contains(what)).count()
    };
    let calls = at_pixels(&plan, "jsr product16");
    assert!(calls >= 2, "{calls}");
    assert_eq!(at_pixels(&plan, "(sum1_lo),y"), 0);
    plan.copies = crate::plan::Copies::Ends;
    assert_eq!(at_pixels(&plan, "jsr product16"), 0);
    assert_eq!(at_pixels(&plan, "lda (sum1_lo),y"), 2 * calls);
}

/// Of a sum of which the lowest bit counts, no more than a byte is computed.
#[test]
fn sums_have_the_bytes_that_are_asked_for() {
    let source = "image 64 x 32 inks black, white;
        draw (x, y) = ink((floor((x + 2 * y) * 30.3) + floor(y * 70.7)) mod 2);";
    let plan = planned_in(source, "fixed16");
    let shapes = super::shapes::shapes(&plan).unwrap();
    let bytes = |name: &str| -> Vec<u8> {
        let named = |id: &crate::ir::graph::NodeId| {
            plan.routine(*id)
                .is_some_and(|routine| routine.name == name)
        };
        let place = |id| crate::ir::tree::Place::of(&plan.graph, id);
        let ids = plan.graph.ids().filter(named);
        ids.map(|id| shapes.of(&plan, place(id)).bytes).collect()
    };
    let sums = [bytes("int_add"), bytes("floor")].concat();
    assert!(sums.contains(&1), "{sums:?}");
    assert!(sums.iter().all(|bytes| *bytes == 1), "{sums:?}");
}

#[test]
fn names_of_scenes_never_meet_those_of_the_program() {
    let names = [
        "acc",
        "low",
        "lda",
        "sign",
        "start",
        "next_row",
        "pixel_x",
        "first_row",
        "multiply",
        "make_squares",
        "else1",
        "table0_0",
        "count",
        "s",
        "a",
        "param0",
        "take_int",
        "v1",
        // What other assemblers keep for themselves.
        "_low",
        "bra",
        "shl",
        "pi",
    ];
    for name in names {
        let source = format!(
            "image 8 x 4 inks black, white;
             param {name}: real = 0.25 in -1 .. 1;
             draw (x, y) = {{ let inc = sqrt({name} * x); let and_ = inc / (y + {name}); ink(floor(inc + and_)) }};"
        );
        let text = text(&source);
        let all = defined(&text);
        let unique: BTreeSet<&str> = all.iter().copied().collect();
        assert_eq!(all.len(), unique.len(), "{name}");
        for reserved in ["lda", "inc", "and", "a", "x", "y", "s", "bra", "shl", "pi"] {
            assert!(!unique.contains(reserved), "{name}: {reserved}");
        }
        // Local in 64tass.
        assert!(!unique.iter().any(|n| n.starts_with('_')), "{name}");
    }
}

#[test]
fn only_what_is_used_is_written() {
    let text = text("image 8 x 4 inks black, white; draw (x, y) = ink((x + y) mod 2);");
    for absent in [
        "multiply",
        "root",
        "divide",
        "make_squares",
        "sqr_lo",
        "clamp_index",
        "saturate",
    ] {
        assert!(!defined(&text).contains(&absent), "{absent}");
    }
}

#[test]
fn output_is_a_function_of_the_scene() {
    assert_eq!(text(GRADIENT), text(GRADIENT));
}

#[test]
fn a_dither_that_spreads_reads_well() {
    let source = "image 8 x 4 inks black, grey, white; draw (x, y) = floyd(x / 8, x, y);";
    // The runtime's parts are tested elsewhere.
    let all = text(source);
    let own = all.split("; ---- runtime").next().unwrap();
    insta::assert_snapshot!(format!("{source}\n\n{own}"));
}

/// Everything that a line may be, in every syntax.
#[test]
fn lines_in_every_syntax() {
    let neutral = [
        "; a comment: it's all",
        "* = $0a00",
        "name = $12              ; 1: a symbol",
        "sum = -250",
        "label:                  ; and a comment",
        "        lda #<(label)   ; low",
        "        ldx #>(label)",
        "        asl",
        "        ror name",
        "        lda (name),y",
        "        .byte 1, $02, <((sum) >> 16)",
        "        .word label, $1234",
        "        ; indented",
        "",
    ];
    let mut all = String::new();
    for syntax in &SYNTAXES {
        all.push_str(&format!("---- {}\n", syntax.name));
        for line in neutral {
            let written = syntax.line(line);
            // The first is what everything is written in.
            assert!(syntax.name != "ca65" || written == line, "{written}");
            all.push_str(&written);
            all.push('\n');
        }
    }
    insta::assert_snapshot!(all);
}

/// Opcodes that the data sheet leaves out, which assemblers call otherwise or do not know.
#[test]
fn undocumented_opcodes_in_every_syntax() {
    let neutral = [
        "name = $ff",
        "        lax name",
        "        lax name+1      ; not in the zero page",
        "        lax (name),y",
        "        lax table,y",
        "        isc name",
        "        alr #$fe",
        "        sbx #$03",
        "        lda name",
        "table:",
    ];
    let lines = neutral.map(|line| (line.to_owned(), None));
    for syntax in &SYNTAXES {
        let text = syntax.write(&lines).0;
        let code = text.lines().skip(1).take(8);
        let code = code.map(|line| line.split(';').next().unwrap_or(line).trim());
        let wanted = match syntax.name {
            "xa" => {
                ".byt $a7, name|.byt $af, <(name+1), >(name+1)|.byt $b3, name\
                 |.byt $bf, <(table), >(table)|.byt $e7, name|.byt $4b, $fe|.byt $cb, $03"
            }
            "beebasm" => {
                "EQUB &a7, name|EQUB &af, LO(name+1), HI(name+1)|EQUB &b3, name\
                 |EQUB &bf, LO(table), HI(table)|EQUB &e7, name|EQUB &4b, &fe|EQUB &cb, &03"
            }
            "ca65" => "lax name|lax name+1|lax (name),y|lax table,y|isc name|alr #$fe|axs #$03",
            "dasm" => "lax name|lax name+1|lax (name),y|lax table,y|isb name|asr #$fe|sbx #$03",
            _ => "lax name|lax name+1|lax (name),y|lax table,y|isc name|alr #$fe|sbx #$03",
        };
        let written: Vec<&str> = code.collect();
        assert_eq!(
            written.join("|"),
            format!("{wanted}|lda name"),
            "{}",
            syntax.name
        );
        let how = syntax.how("program", "6502:plain", true).join("\n");
        let option = ["--cpu 6502X", "64tass -i", "--cpu nmos6502"].map(|o| how.contains(o));
        let asked = option.into_iter().filter(|asked| *asked).count();
        let has = matches!(syntax.name, "ca65" | "64tass" | "acme");
        assert_eq!(asked, usize::from(has), "{how}");
        assert_eq!(
            syntax.how("program", "6502:plain", false).join("\n") == how,
            !has
        );
    }
}

#[test]
fn a_small_scene_in_every_syntax() {
    let source = "image 8 x 4 inks black, white;
param from: int = 3 in 1 .. 9;
const steps = [0, 1, 1, 0; 1, 0, 0, 1];
draw (x, y) = ink((steps[x mod 4, y mod 2] + x + from) mod 2);";
    let plan = planned(source);
    for syntax in &SYNTAXES {
        let document = super::document(&plan, syntax);
        let lines = document.text.lines().count();
        assert_eq!(lines, document.lines.len(), "{}", syntax.name);
        insta::assert_snapshot!(format!("syntax_{}", syntax.name), document.text);
    }
    let usual = &super::emit(&planned(source))[0].text;
    assert_eq!(*usual, super::document(&plan, USUAL).text);
}

/// xa holds 24 bits of a symbol.
#[test]
fn large_params_are_bytes_where_symbols_are_narrow() {
    let written = |value: i64, syntax: &str| {
        let plan = planned(&format!(
            "image 8 x 4 inks black, white; param n: int = {value}; draw (x, y) = ink((x + n) mod 2);"
        ));
        let text = super::document(&plan, find_syntax(syntax).unwrap()).text;
        let mut behind = text.lines().skip_while(|l| !l.starts_with("param0:"));
        behind.nth(1).unwrap().trim().to_owned()
    };
    let narrow = ".byt <(n), >(n), <((n) >> 16), <(0-((n) >> 23))";
    for inside in [0, -250, 0x7f_ffff, -0x80_0000] {
        assert_eq!(written(inside, "xa"), narrow);
    }
    assert_eq!(written(0x80_0000, "xa"), ".byt 0, 0, 128, 0");
    assert_eq!(written(-0x80_0001, "xa"), ".byt 255, 255, 127, 255");
    let wide = ".byte <(n), >(n), <((n) >> 16), <((n) >> 24)";
    assert_eq!(written(0x80_0000, "64tass"), wide);
}

/// Long programs have several instructions on a line where the assembler has
/// no memory for so many lines; a comment, a label or data ends one.
#[test]
fn long_programs_have_less_lines_for_xa() {
    let part = ["        nop"; 6].into_iter().chain([
        "label:",
        "        rts ; a comment",
        "        inx",
        "        .byte 1",
    ]);
    let lines = |times: usize| -> Vec<_> {
        let all = std::iter::repeat_n(part.clone(), times).flatten();
        all.map(|l| (l.to_owned(), None)).collect()
    };
    let xa = find_syntax("xa").unwrap();
    let (short, places) = xa.write(&lines(1));
    assert_eq!((short.lines().count(), places.len()), (10, 10));
    let (long, places) = xa.write(&lines(2001));
    assert_eq!(long.lines().count(), places.len());
    let first: Vec<&str> = long.lines().take(6).collect();
    assert_eq!(
        first,
        [
            "        nop : nop : nop : nop",
            "        nop : nop",
            "label:",
            "        rts ; a comment",
            "        inx",
            "        .byt 1",
        ]
    );
    let (usual, _) = USUAL.write(&lines(2001));
    assert_eq!(usual.lines().count(), 20_010);
}

/// A program for fewer rows differs from the whole one in two numbers.
#[test]
fn rows_are_parameters() {
    let mut plan = planned(GRADIENT);
    let emitted = |plan: &PlannedScene| super::document(plan, USUAL).text;
    let whole = emitted(&plan);
    plan.rows = (1, 2);
    let some = emitted(&plan);
    assert_eq!(whole.lines().count(), some.lines().count());
    let changed = whole.lines().zip(some.lines()).filter(|(a, b)| a != b);
    let changed: Vec<&str> = changed
        .filter_map(|(_, line)| line.split(';').next())
        .map(str::trim)
        .collect();
    let [first, last] = super::ROWS;
    assert_eq!(changed, [format!("{first} = 1"), format!("{last} = 2")]);
}
