//! Results in place: whether an operation's statements read an operand before they write the
//! result, so that both may be one variable.

use crate::ir::graph::*;
use crate::plan::Plan;
use slowlight_routine::Form;

/// Whether that is so of each operand of a value.
pub(super) fn in_place(plan: &Plan, id: NodeId) -> [bool; 2] {
    let (Node::Apply(..), Some(routine)) = (plan.graph.node(id), plan.routine(id)) else {
        return [false; 2];
    };
    match routine.form {
        // An object is written field by field.
        _ if plan.format(id).is_object() => [false; 2],
        Form::Expression { .. } => [true; 2],
        Form::Statement(template) => [0, 1].map(|k| is_read_first(template, k)),
    }
}

/// Whether no line of a template reads an operand, or its sign, behind one that writes the
/// result's, and none is carried out again. An arm is not behind the other.
fn is_read_first(template: &str, k: usize) -> bool {
    let both = [(format!("{{{k}}}"), "{r}"), (format!("{{{k}+}}"), "{r+}")];
    let mut written = [false; 2];
    // What was written before a block and in the arm before it; of the last one: before it
    // and behind it.
    let mut open: Vec<[[bool; 2]; 2]> = Vec::new();
    let mut last = [[false; 2]; 2];
    for line in template.lines().map(str::trim_start) {
        match line {
            "else {" => {
                open.push(last);
                [written, _] = last;
            }
            "}" => {
                let [before, other] = open.pop().unwrap_or_default();
                last = [before, written];
                written = [0, 1].map(|of| written[of] || other[of]);
            }
            _ => {}
        }
        for ((operand, result), written) in both.iter().zip(&mut written) {
            if *written && line.contains(operand) || line.starts_with("while") {
                return false;
            }
            *written |= line.contains(&format!("let {result} ="));
        }
        if line.ends_with('{') && line != "else {" {
            open.push([written, [false; 2]]);
        }
    }
    template.contains("let {r} =")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_read_behind_the_result_is_found() {
        assert!(is_read_first(
            "let {r} = {0} + {1};\nlet {r+} = {0+} = {1+};",
            0
        ));
        assert!(!is_read_first(
            "let {r} = {0};\nif ({0} < {1}) {\nlet {r} = {1};\n}",
            0
        ));
        assert!(!is_read_first(
            "let {r+} = {1+};\nlet {r} = {0};\nlet {r+} = {0+};",
            0
        ));
        assert!(!is_read_first("do {r}.add({0}, {1})", 0));
        let arms = "if (a) {\nlet {r} = {0};\n}\nelse {\nlet {r} = {1};\n}";
        assert!(is_read_first(arms, 0) && is_read_first(arms, 1));
        assert!(!is_read_first(&format!("{arms}\nlet {{r+}} = {{0}};"), 0));
    }
}
