//! The parameter block, and what checks it.

use super::code::Code;
use super::expression::int;
use super::line;
use super::{Line, Text};
use crate::ir::graph::Role;
use crate::plan::ParamPlan;
use slowlight_runtime_jack::TERM;
use slowlight_runtime_jack::model::MOST;

/// An int of the parameter block, kept within what Jack can write.
fn written(text: &str) -> i32 {
    let most = f64::from(MOST);
    text.parse::<f64>()
        .map_or(0, |x| x.clamp(-most, most) as i32)
}

pub(super) fn parameters(code: &Code) -> Vec<Line> {
    let plan = code.plan;
    let mut rows: Vec<(String, String, String)> = Vec::new();
    let scale = |p: &ParamPlan| match p.digits {
        Some(digits) if digits > 0 => format!("times {}, ", 10u32.pow(u32::from(digits))),
        _ => String::new(),
    };
    let written_by_hand = |at: &usize| {
        let param = plan.graph.params.get(*at);
        !param.is_some_and(|p| matches!(p.role, Role::Input(_)))
    };
    let all = code.names.params.iter().zip(&plan.params).enumerate();
    for (name, param) in all
        .filter(|(at, _)| written_by_hand(at))
        .map(|(_, both)| both)
    {
        let range = match &param.range {
            Some((least, greatest)) => format!("from {} to {}", written(least), written(greatest)),
            None => "in no range".to_owned(),
        };
        rows.push((
            name.clone(),
            written(&param.text).to_string(),
            scale(param) + &range,
        ));
    }
    let (first, last) = plan.shown_rows();
    for (name, row) in code.names.rows.iter().zip([plan.rows.0, plan.rows.1]) {
        rows.push((
            name.clone(),
            row.to_string(),
            format!("from {first} to {last}"),
        ));
    }
    let lines = rows.iter().map(|(name, value, about)| {
        let assignment = format!("let {name} = {value};");
        line(&format!("{assignment:<28} // {about}"))
    });
    lines.collect()
}

/// One condition a parameter that has a range.
pub(super) fn checks(code: &mut Code) -> Vec<Line> {
    let plan = code.plan;
    let rows = plan.shown_rows();
    let names = code.names.params.iter().chain(&code.names.rows).cloned();
    let ranges = plan.params.iter().zip(&plan.graph.params).map(|(p, of)| {
        let (least, greatest) = p.range.as_ref()?;
        let given = matches!(of.role, Role::Input(_));
        (!given).then(|| (written(least), written(greatest)))
    });
    let ranges = ranges.chain([Some((rows.0 as i32, rows.1 as i32)); 2]);
    let all: Vec<_> = names.zip(ranges).collect();
    let mut text = Text::default();
    for (name, range) in all {
        let Some((least, greatest)) = range else {
            continue;
        };
        // A translated program compares by subtracting, which must not overflow.
        let outside = if greatest.saturating_sub(least) <= MOST {
            let (least, greatest) = (int(least).at(TERM), int(greatest).at(TERM));
            format!("({name} < {least}) | ({name} > {greatest})")
        } else {
            code.needs.insert("Int.less");
            let (least, greatest) = (int(least).text, int(greatest).text);
            format!("Int.less({name}, {least}) | Int.less({greatest}, {name})")
        };
        text.open(format!("if ({outside}) {{"));
        let said = format!("{name} is outside its range, {least} to {greatest}");
        text.line(format!("do Output.printString(\"{said}\");"));
        text.line("return false;");
        text.close("}");
    }
    text.line("return true;");
    text.lines
}
