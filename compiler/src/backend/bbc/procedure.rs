//! Blocks as procedures behind the pixel's code.

use super::Style;
use super::code::Code;
use super::lines::Lines;

/// Lines of code that stand close to the top are found sooner: a jump looks
/// through all lines before its own. So what is done once a row or run, if it is
/// of more than a few lines, becomes a procedure that stands behind the pixel's
/// code; answers it.
pub(super) fn as_procedure<'p>(
    code: &mut Code<'p>,
    name: &str,
    write: impl FnOnce(&mut Code<'p>),
) -> Option<Lines> {
    let weight = code.lines.weight;
    let outer = std::mem::replace(&mut code.lines, Lines::of_weight(weight));
    write(code);
    let mut lines = std::mem::replace(&mut code.lines, outer);
    if code.values.style != Style::Fast || lines.texts().count() <= 2 {
        code.lines.append(lines);
        return None;
    }
    let name = code.values.names.unique(&format!("PROC{name}"), "");
    code.statement(name.clone());
    let mut procedure = Lines::of_weight(weight);
    procedure.line(format!("DEF {name}"), code.frame);
    lines.line("ENDPROC", code.frame);
    procedure.append(lines);
    Some(procedure)
}
