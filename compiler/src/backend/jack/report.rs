//! What a program prints at its end, where its graph reports something.

use super::Text;
use super::code::Code;
use super::{Subroutine, line, subroutine};
use slowlight_routine::{Format, Type};

/// Prints what the graph reports, a line each: ints, bools as 0 or 1, Floats as
/// sign, exponent and mantissa's words, logarithms after 1 for a negative, fixed point as its int. Answers the method that prints a Float, if needed.
pub(super) fn reports(code: &mut Code, text: &mut Text) -> Option<Subroutine> {
    let plan = code.plan;
    let mut floats = false;
    for &id in &plan.graph.reports {
        // A constant is read in its own place, where values have such.
        let value = match (plan.points(), plan.graph.ty(id)) {
            (Some(points), Type::Real) => code.read_at(points, id, points.own(id)).text,
            _ => code.read(id).text,
        };
        match plan.format(id) {
            Format::Bool => {
                text.open(format!("if ({value}) {{"));
                text.line("do Output.printInt(1);");
                text.close("}");
                text.open("else {");
                text.line("do Output.printInt(0);");
                text.close("}");
            }
            Format::Int { .. } | Format::Fixed { .. } => {
                text.line(format!("do Output.printInt({value});"))
            }
            Format::Log { .. } => {
                let plus = code.sign(id).text;
                text.open(format!("if ({plus}) {{"));
                text.line("do Output.printInt(0);");
                text.close("}");
                text.open("else {");
                text.line("do Output.printInt(1);");
                text.close("}");
                text.line("do Output.println();");
                text.line(format!("do Output.printInt({value});"));
            }
            _ => {
                floats = true;
                text.line(format!("do reportFloat({value});"));
            }
        }
        text.line("do Output.println();");
    }
    floats.then(|| {
        let parts = (0..plan.runtime.real.words()).map(|k| {
            let part = line(&format!("do Output.printInt(a[{k}]);"));
            [part, line("do Output.printChar(32);")]
        });
        subroutine(
            "A Float's sign, exponent and mantissa.",
            "method void reportFloat(Array a)",
            parts.flatten().collect(),
        )
    })
}
