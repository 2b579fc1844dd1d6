//! Modes, colours and coordinates.

use super::super::colours::{agon, assign, micro, physical};
use super::code::Code;
use super::segment::Draw;
use crate::plan::Plan;
use crate::targets::{Mode, System};

/// The resident variables that have their own use: the ink, the row's height on
/// the screen, the column and the row. (`@%` formats numbers.)
pub const OWN: &str = "IRXY";

/// The physical colours of a mode's inks when it starts.
pub fn first_colour(mode: &Mode, ink: usize) -> u8 {
    match (mode.inks, ink) {
        (2, i) => [0, 7][i & 1],
        (4, i) => [0, 1, 3, 7][i & 3],
        (_, i) => (i & 7) as u8,
    }
}

/// The physical colours that stand for a palette.
pub fn colours(palette: &[[u8; 3]]) -> Vec<u8> {
    assign(palette, &micro())
}

/// The VDU statement that gives an ink the scene's colour, or the machine's that stands for
/// it; none where it has it already.
pub fn colour(plan: &Plan, ink: usize, rgb: [u8; 3]) -> Option<String> {
    let palette = &plan.graph.image.palette;
    let first = first_colour(&plan.mode, ink);
    let number = |given: Vec<u8>| given.get(ink).copied().unwrap_or(7);
    match plan.target.system {
        System::Agon => {
            let own = agon();
            let shown = own.get(usize::from(number(assign(palette, &own))));
            let [r, g, b] = shown.map_or(rgb, |own| own.rgb);
            (physical(first) != [r, g, b]).then(|| format!("VDU 19,{ink},255,{r},{g},{b}"))
        }
        System::BasicV => {
            let [r, g, b] = rgb;
            match (0..8).find(|c| physical(*c) == rgb) {
                Some(own) if own == first => None,
                Some(own) => Some(format!("VDU 19,{ink},{own};0;")),
                None => Some(format!("VDU 19,{ink},16,{r},{g},{b}")),
            }
        }
        _ => {
            let own = number(colours(palette));
            (own != first).then(|| format!("VDU 19,{ink},{own};0;"))
        }
    }
}

/// `a-4*Y%` and so on: a sum of a constant and a multiple.
fn linear(constant: i64, factor: i64, name: &str) -> String {
    let product = match factor.abs() {
        1 => name.to_owned(),
        f => format!("{f}*{name}"),
    };
    match (constant, factor < 0) {
        (0, false) => product,
        (0, true) => format!("-{product}"),
        (c, false) if c < 0 => format!("{product}-{}", -c),
        (c, false) => format!("{product}+{c}"),
        (c, true) => format!("{c}-{product}"),
    }
}

/// How a run of pixels whose inks are known, every `stride`th of a row, is plotted
/// up to column `to`.
pub fn run(plan: &Plan, code: &mut Code<'_>, to: &str, stride: u32) -> Draw {
    let names = ["run", "other"].map(|name| code.values.names.unique(name, "%"));
    let (mut once, mut each, mut then) = (Vec::new(), Vec::new(), Vec::new());
    // After MODE the screen is ink 0 already.
    if plan.plot {
        let (ink, point) = (&names[0], point(plan));
        once.push(format!("IF {ink} THEN GCOL 0,{ink}"));
        each.push(format!("IF {ink} THEN {point}"));
        then.push(format!("IF I% THEN GCOL 0,I%:{point}"));
    }
    Draw {
        count: "X%".to_owned(),
        to: to.to_owned(),
        by: stride,
        behind: None,
        either: [0, 1].map(|k| format!("I%={}", names[k])),
        names,
        of: String::new(),
        once,
        each,
        then,
    }
}

/// The test for a row that is computed to be drawn: from the first to the last.
pub fn seen_rows(plan: &Plan, (first, last): (&str, &str)) -> String {
    match plan.graph.refinement {
        Some(_) => format!("Y%>={first} AND Y%<={last}"),
        None => format!("Y%>={first}"),
    }
}

/// The graphics x of picture column `X%`.
pub fn x_expression(plan: &Plan) -> String {
    let unit = 1280 / i64::from(plan.mode.width.max(1));
    let block = i64::from(plan.graph.image.block.0);
    linear(unit * i64::from(plan.offset.0), unit * block, "X%")
}

/// The statements that draw a pixel of the picture in the ink that is chosen: a point, or
/// the two triangles of a block.
pub fn point(plan: &Plan) -> String {
    let x = x_expression(plan);
    let (wide, high) = plan.graph.image.block;
    if (wide, high) == (1, 1) {
        return format!("PLOT 69,{x},R%");
    }
    let across = (i64::from(wide) - 1) * 1280 / i64::from(plan.mode.width.max(1));
    let down = (i64::from(high) - 1) * 1024 / i64::from(plan.mode.height.max(1));
    format!("MOVE {x},R%:PLOT 0,0,-{down}:PLOT 81,{across},{down}:PLOT 81,0,-{down}")
}

/// The graphics y of picture row `Y%`: y runs up, over 1024 units.
pub fn y_expression(plan: &Plan) -> String {
    let height = i64::from(plan.mode.height.max(1));
    let bottom = height - 1 - i64::from(plan.offset.1);
    let block = i64::from(plan.graph.image.block.1);
    if 1024 % height == 0 {
        let unit = 1024 / height;
        return linear(unit * bottom, -unit * block, "Y%");
    }
    // The middle of the row, since units are no whole part of it.
    format!("(512+1024*({})) DIV {height}", linear(bottom, -block, "Y%"))
}

/// Draws the pixel in its ink, whatever that is: the screen is ink 0 at first, but to ask takes
/// more characters. With two inks points are drawn in the other as they are.
pub fn draw(plan: &Plan, code: &mut Code<'_>) {
    let ink = code.values.read(plan.graph.ink).text;
    let point = point(plan);
    match plan.mode.inks {
        2 => {
            let shown = ink
                .strip_prefix("-(")
                .and_then(|rest| rest.strip_suffix(')'));
            let shown = shown.filter(|inner| !inner.contains(['(', ')']));
            code.line(format!("IF {} THEN {point}", shown.unwrap_or(&ink)));
        }
        _ => {
            code.statement(format!("GCOL 0,{ink}"));
            code.statement(point);
        }
    }
}
