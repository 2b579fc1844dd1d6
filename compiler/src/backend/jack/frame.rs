//! The classes around the statements: parameter block, checks, loops.

mod drawing;

use super::code::Code;
use super::fixed::is_fixed;
use super::logs::{has_signs, without_idle_signs};
use super::making::making;
use super::params::{checks, parameters};
use super::statics::statics;
use super::tidy::tidied;
use super::{Document, Line, Subroutine, Text, line, subroutine};
use crate::ir::graph::TableId;
use crate::plan::Plan;
use drawing::drawing;
use slowlight_routine::Format;
use slowlight_runtime_jack::log::on_processor;
use slowlight_runtime_jack::{classes, classes_for_processor, has_init};
use std::collections::BTreeSet;

/// Writes a plan down as the classes of a program, `Main` first.
pub(in crate::backend) fn program(plan: &Plan) -> Vec<Document> {
    let mut own = plan.statics.then(|| plan.clone());
    for routine in own.iter_mut().flat_map(|own| &mut own.routines) {
        *routine = routine.map(on_processor);
    }
    let plan = own.as_ref().unwrap_or(plan);
    let Parts {
        code,
        drawing,
        making,
        checks,
    } = parts(plan);
    let class = code.names.class.clone();
    let mut needs: Vec<&str> = plan.parts().iter().map(|p| p.name).collect();
    needs.extend(&code.needs);
    let parts = plan.runtime.closure(needs);
    let library = match plan.statics && !plan.lean {
        true => classes_for_processor(&parts),
        false => classes(&parts),
    };
    let fixed = match plan.statics {
        true => {
            let often = code.methods.iter().flat_map(|m| &m.lines);
            let often = often.chain(drawing.iter().flat_map(|s| &s.body));
            statics(
                declared(&code).into_iter().flat_map(|(_, names, _)| names),
                often,
                &library,
            )
        }
        false => BTreeSet::new(),
    };
    let scene = scene(&code, &fixed, making, checks, drawing);
    let mut documents = vec![
        main(&class, plan.graph.is_moving(), &parts).document("Main"),
        scene.document(&class),
    ];
    for (name, text) in library {
        let mut lines = Text::default();
        text.lines().for_each(|line| lines.line(line));
        documents.push(lines.document(name));
    }
    documents
}

/// What a scene's class is made of.
struct Parts<'p> {
    code: Code<'p>,
    drawing: Vec<Subroutine>,
    making: Vec<Subroutine>,
    checks: Vec<Line>,
}

fn parts(plan: &Plan) -> Parts<'_> {
    let mut code = Code::new(plan);
    let mut drawing = drawing(&mut code);
    let mut making = making(&mut code);
    let checks = checks(&mut code);
    let signs = code.names.signs();
    if !signs.is_empty() {
        let bodies = drawing.iter_mut().chain(&mut making).map(|s| &mut s.body);
        let mut all: Vec<&mut Vec<Line>> = bodies.collect();
        all.extend(code.methods.iter_mut().map(|m| &mut m.lines));
        without_idle_signs(&signs, &mut all);
    }
    tidied(&mut code, &mut drawing, &making);
    Parts {
        code,
        drawing,
        making,
        checks,
    }
}

/// A plan's code, the fields of its scene's object in their order, where none is a static, and
/// whether a line has a name.
pub(super) fn declared_names(plan: &Plan) -> (Code<'_>, Vec<String>, impl Fn(&str) -> bool) {
    let Parts { code, drawing, .. } = parts(plan);
    let names = declared(&code).into_iter().flat_map(|(_, names, _)| names);
    let names = names.collect();
    let methods = code.methods.iter().flat_map(|m| &m.lines);
    let lines = drawing.iter().flat_map(|s| &s.body).chain(methods);
    let lines: Vec<String> = lines.map(|line| line.text.clone()).collect();
    (code, names, move |name: &str| {
        lines.iter().any(|line| line.contains(name))
    })
}

fn main(class: &str, moves: bool, parts: &[&slowlight_routine::Part]) -> Text {
    let mut text = Text::default();
    text.line(match moves {
        true => "/** Shows the scene, picture after picture. */",
        false => "/** Draws the scene, and stops. */",
    });
    text.open("class Main {");
    text.open("function void main() {");
    text.line(format!("var {class} scene;"));
    for library in ["Float", "Log", "Fixed", "Int"] {
        if has_init(library, parts) {
            text.line(format!("do {library}.init();"));
        }
    }
    text.line(format!("let scene = {class}.new();"));
    let draw = if moves { "showPictures" } else { "drawPicture" };
    text.line(format!("if (scene.inRange()) {{ do scene.{draw}(); }}"));
    text.line("do Sys.halt();");
    text.line("return;");
    text.close("}");
    text.close("}");
    text
}

/// A name that can neither end a comment nor a line.
fn in_comment(name: &str) -> String {
    let plain = |c: char| {
        if c.is_ascii_graphic() && c != '*' {
            c
        } else {
            ' '
        }
    };
    name.chars().map(plain).collect()
}

/// The whole class of the scene.
fn scene(
    code: &Code,
    fixed: &BTreeSet<String>,
    making: Vec<Subroutine>,
    checks: Vec<Line>,
    drawing: Vec<Subroutine>,
) -> Text {
    let plan = code.plan;
    let image = &plan.graph.image;
    let mut text = Text::default();
    let about = format!(
        "The scene {}, {} x {} {}, its top left at ({}, {}) of the screen.",
        in_comment(&plan.name),
        image.width,
        image.height,
        image.unit(),
        plan.offset.0,
        plan.offset.1
    );
    match plan.points() {
        Some(_) => {
            text.line("/**");
            text.line(format!(" * {about}"));
            text.line(" *");
            text.line(
                " * Reals are whole numbers: behind a line stands what it works out, and how",
            );
            text.line(" * much a 1 in its result is worth, 2^-14 say.");
            text.line(" */");
        }
        None => text.line(format!("/** {about} */")),
    }
    text.open(format!("class {} {{", code.names.class));
    fields(code, fixed, &mut text);
    let block = "What may be changed: whole numbers, each in its range.";
    let mut all = vec![subroutine(
        block,
        "method void setParameters()",
        parameters(code),
    )];
    let new = format!("constructor {} new()", code.names.class);
    let mut start: Vec<Line> = vec![line("do setParameters();")];
    for made in &making {
        let name = made.head.trim_start_matches("method void ");
        if name != "takeParameters()" {
            start.push(line(&format!("do {name};")));
        }
    }
    start.push(line("return this;"));
    all.push(subroutine(
        "Makes everything that drawing needs.",
        new,
        start,
    ));
    let about = "Whether every parameter is in its range; says which is not.";
    all.push(subroutine(about, "method boolean inRange()", checks));
    all.extend(drawing);
    all.extend(making);
    for method in &code.methods {
        let head = format!("method void {}()", method.name);
        all.push(subroutine(
            method.about.as_str(),
            head,
            method.lines.clone(),
        ));
    }
    for part in all {
        // Its first and last line are a part of it.
        text.span = part.body.iter().find_map(|line| line.span);
        text.line("");
        if !part.about.is_empty() {
            text.line(format!("/** {} */", part.about));
        }
        text.open(format!("{} {{", part.head));
        let returns = part
            .body
            .last()
            .is_some_and(|l| l.text.starts_with("return"));
        text.append(part.body);
        if !returns {
            text.line("return;");
        }
        text.close("}");
    }
    text.close("}");
    text
}

/// The declarations, a few names a line: statics, then fields.
fn fields(code: &Code, fixed: &BTreeSet<String>, text: &mut Text) {
    for (kind, is_static) in [("static", true), ("field", false)] {
        for (ty, names, about) in declared(code) {
            let names = names.iter().filter(|n| fixed.contains(*n) == is_static);
            let names: Vec<&str> = names.map(String::as_str).collect();
            let mut rest = names.as_slice();
            while !rest.is_empty() {
                let mut wide = 0;
                let fits = |name: &&&str| {
                    wide += name.len() + 2;
                    wide <= 80
                };
                let count = rest.iter().take_while(fits).count().max(1);
                let (now, later) = rest.split_at(count);
                text.line(format!("{kind} {ty} {};{about}", now.join(", ")));
                rest = later;
            }
        }
    }
}

/// What the scene's object holds: a type, names, and what they are.
fn declared(code: &Code) -> Vec<(&'static str, Vec<String>, &'static str)> {
    let names = &code.names;
    let of = |format: Format| -> Vec<String> {
        let all = code.written.iter().filter(|(_, f)| *f == format);
        all.map(|(name, _)| name.clone()).collect()
    };
    let real = if code.real_is_int() { "int" } else { "Float" };
    let values = code.object.values().map(|(_, name)| name.to_owned());
    let constants = code.object.constants().iter().map(|c| c.name.clone());
    let mut all = vec![
        ("int", names.params.clone(), " // parameters"),
        ("int", names.rows.to_vec(), ""),
        ("int", names.axes.to_vec(), " // the pixel"),
        (real, values.collect(), " // parameters"),
        ("Float", constants.collect(), " // constants"),
    ];
    if let Some(spread) = &code.spread {
        let rows = spread.ring.to_vec();
        all.push(("Array", rows, " // what pixels send to later ones"));
        all.push((real, vec![spread.received.clone(), spread.sum.clone()], ""));
    }
    for (ty, names) in code.refined.iter().flat_map(|refined| refined.declared()) {
        all.push((ty, names, " // what pixels leave to later ones"));
    }
    for (ty, names) in names.canvas.iter().flat_map(|canvas| canvas.declared()) {
        all.push((ty, names, " // the screen's word"));
    }
    let tables = names.tables().map(|(_, name)| name.to_owned()).collect();
    all.push(("Array", tables, " // tables"));
    let tables = &code.plan.graph.tables;
    let signed = |id: TableId| code.logs() && tables.get(id.0 as usize).is_some_and(has_signs);
    let signs = names.tables().filter(|(id, _)| signed(*id));
    let signs = signs.map(|(_, name)| format!("{name}_plus")).collect();
    all.push(("Array", signs, ""));
    all.push(("Array", code.columns(), " // values by columns"));
    let about = if code.logs() { " // logarithms" } else { "" };
    all.push((real, of(code.plan.runtime.real), about));
    let fixed = code.written.iter().filter(|(_, f)| is_fixed(*f));
    let fixed = fixed.map(|(name, _)| name.clone()).collect();
    all.push(("int", fixed, " // reals in fixed point"));
    let ints = of(code.plan.runtime.int).into_iter();
    let counters = names.counters().map(str::to_owned);
    all.push(("int", ints.chain(counters).collect(), ""));
    all.push(("boolean", of(Format::Bool), ""));
    all
}
