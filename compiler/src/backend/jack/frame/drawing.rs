//! The methods that go over the picture: once a picture, once a row, once a pixel.

use super::super::Text;
use super::super::code::Code;
use super::super::error_names::Spread;
use super::super::report::reports;
use super::super::steps::moves;
use super::{Subroutine, subroutine};
use crate::plan::Plan;
use slowlight_runtime_jack::TERM;

/// What a pixel that is computed must pass beside to be drawn.
fn seen(code: &Code, [x, y]: &[String; 2], rows: &[String; 2]) -> Vec<String> {
    let plan = code.plan;
    let mut tests = Vec::new();
    if plan.graph.is_in_order() {
        match &code.refined {
            Some(refined) => tests.extend(refined.seen(y, rows)),
            None => tests.push(format!("~({y} < {})", rows[0])),
        }
        let (computed, drawn) = (plan.computed_columns(), plan.columns);
        if computed.0 < drawn.0 {
            tests.push(format!("~({x} < {})", drawn.0));
        }
        if computed.1 > drawn.1 {
            tests.push(format!("~({x} > {})", drawn.1));
        }
    }
    tests
}

/// The condition for a pixel to be drawn: those of ink 1 are white already.
fn black(ink: &str, tests: &[String]) -> String {
    match tests {
        [] => format!("{ink} = 0"),
        _ => format!("({ink} = 0) & {}", tests.join(" & ")),
    }
}

/// What draws a pixel, or a block of them.
fn drawn(plan: &Plan, [x, y]: [&str; 2]) -> String {
    let block = plan.graph.image.block;
    let place = |axis: &str, size: u32, by: i64| {
        let first = match size {
            1 => axis.to_owned(),
            _ => format!("({axis} * {size})"),
        };
        match by {
            0 => first,
            1.. => format!("{first} + {by}"),
            _ => format!("{first} - {}", by.unsigned_abs()),
        }
    };
    let (left, top) = (i64::from(plan.offset.0), i64::from(plan.offset.1));
    let [x0, y0] = [place(x, block.0, left), place(y, block.1, top)];
    if block == (1, 1) {
        return format!("do Screen.drawPixel({x0}, {y0});");
    }
    let x1 = place(x, block.0, left + i64::from(block.0) - 1);
    let y1 = place(y, block.1, top + i64::from(block.1) - 1);
    format!("do Screen.drawRectangle({x0}, {y0}, {x1}, {y1});")
}

/// The loop over the rows. Errors come from the rows above, drawn or not.
fn down(y: &str, [first, last]: &[String; 2], spread: Option<&Spread>, text: &mut Text) {
    let top = if spread.is_some() { "0" } else { first };
    text.line(format!("let {y} = {top};"));
    text.open(format!("while (~({y} > {last})) {{"));
    text.line("do drawRow();");
    if let Some(spread) = spread {
        spread.turn(text);
    }
    text.line(format!("let {y} = {y} + 1;"));
    text.close("}");
}

/// What is worked out once a picture, once a row, once a pixel.
pub(super) fn drawing(code: &mut Code) -> Vec<Subroutine> {
    let plan = code.plan;
    let frame = code.body(&plan.tree.frame);
    let column = code.body(&plan.tree.column);
    let row = code.body(&plan.tree.row);
    let pixel = code.body(&plan.tree.pixel);
    let steps = moves(code);
    code.subroutines();
    let ink = code.read(plan.graph.ink);
    let spread = code.spread.clone();
    let [x, y] = code.names.axes.clone();
    let rows = code.names.rows.clone();
    let refined = code.refined.clone();

    let mut picture = Text::default();
    if code.object.values().next().is_some() && steps.is_empty() {
        picture.line("do takeParameters();");
    }
    picture.append(frame);
    code.fill_columns(column, &mut picture);
    picture.span = plan.drawn;
    let canvas = code.names.canvas.clone();
    if plan.plot && canvas.is_none() && steps.is_empty() {
        picture.line("do Screen.setColor(true);");
    }
    match &refined {
        Some(refined) => refined.picture(&y, &rows, &mut picture),
        None => down(&y, &rows, spread.as_ref(), &mut picture),
    }
    let told = match steps.is_empty() {
        true => reports(code, &mut picture),
        false => None,
    };

    let mut across = Text {
        span: plan.drawn,
        ..Text::default()
    };
    if let Some(refined) = &refined {
        refined.row(&y, &mut across);
    }
    across.append(row);
    let columns = plan.computed_columns();
    if let Some(canvas) = &canvas {
        canvas.begin(&y, &mut across);
    }
    across.line(format!("let {x} = {};", columns.0));
    across.open(format!("while ({x} < {}) {{", columns.1.saturating_add(1)));
    across.line("do drawPixel();");
    across.line(format!("let {x} = {x} + 1;"));
    across.close("}");
    if let Some(canvas) = &canvas {
        canvas.end(&mut across);
    }

    let mut dot = Text {
        span: plan.drawn,
        ..Text::default()
    };
    if let Some(spread) = &spread {
        spread.receive(code, &x, &mut dot);
    }
    if let Some(refined) = &refined {
        refined.receive(&x, &mut dot);
    }
    dot.append(pixel);
    dot.span = plan.drawn.or(Some(plan.graph.span(plan.graph.ink)));
    if let Some(canvas) = &canvas {
        canvas.pixel(&black(&ink.at(TERM), &[]), &mut dot);
    } else if plan.plot {
        let seen = seen(code, &code.names.axes, &rows);
        if !steps.is_empty() {
            // The picture before is still there.
            dot.line(format!("do Screen.setColor({} = 0);", ink.at(TERM)));
            dot.line(drawn(plan, [&x, &y]));
        } else {
            dot.open(format!("if ({}) {{", black(&ink.at(TERM), &seen)));
            dot.line(drawn(plan, [&x, &y]));
            dot.close("}");
        }
    } else if let Some(place) = plan.place(plan.graph.ink) {
        // Worked out, not drawn.
        let home = code.home(place, plan.runtime.int);
        if ink.text != home {
            dot.line(format!("let {home} = {};", ink.text));
        }
    }
    if let Some(spread) = &spread {
        dot.append(spread.send(code, &x));
    }
    if let Some(refined) = &refined {
        refined.send(code, &x, &mut dot);
    }
    let (first, last) = columns;
    let mut all = vec![
        subroutine(
            "Once a picture.",
            "method void drawPicture()",
            picture.lines,
        ),
        subroutine(
            format!("Row {y}: columns {first} to {last}."),
            "method void drawRow()",
            across.lines,
        ),
        subroutine(
            format!("The pixel at ({x}, {y})."),
            "method void drawPixel()",
            dot.lines,
        ),
    ];
    all.extend(told);
    all.extend(steps);
    let next = refined.iter().flat_map(|r| r.methods(&code.names.axes));
    all.extend(next);
    all
}
