//! A profile as one page of HTML: no scripts, no network, nothing beside it.

use super::Explained;
use super::terminal::{percent, rate};
use crate::draw::Window;
use crate::format::count;
use crate::sheet::escaped;
use slowlight_compiler::report::profile::{Part, SourceLine};
use std::fmt::Write as _;

const STYLE: &str = "\
body{font:14px/1.4 system-ui,sans-serif;margin:2em;color:#222;background:#fff}
table{border-collapse:collapse;width:100%}
th,td{padding:1px 8px;text-align:right;white-space:nowrap;vertical-align:top}
th{border-bottom:1px solid #999;font-weight:600;position:sticky;top:0;background:#fff}
td.code,th.code{text-align:left;white-space:pre-wrap;font-family:ui-monospace,monospace;width:60%}
td.rate,th.rate{text-align:left}
td.none{color:#bbb}
summary{cursor:pointer;list-style:none}
ul{margin:2px 0 6px;padding-left:2em;font:12px/1.5 system-ui,sans-serif;color:#555}
@media(prefers-color-scheme:dark){body,th{background:#181818;color:#ddd}ul{color:#aaa}}
";

/// The page.
pub fn page(found: &Explained) -> String {
    let plan = &found.plan;
    let title = escaped(&format!("{} on {}", found.scene.name, plan.target.name));
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n<h1>{title}</h1>\n"
    );
    let window = Window::on_screen(plan);
    let errors = &found.errors;
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        "<p>Rows {} to {} in {}: {} {}; rmse {:.2e} over {} pixels, {} of their inks not native's. \
         A line's error is the share of the mean square that goes where its values are f64.",
        window.rows.0,
        window.rows.1,
        plan.runtime.format,
        count(found.run.cycles),
        found.unit(),
        errors.rmse,
        count(errors.pixels as u64),
        count(errors.differ as u64),
    );
    let most = found.profile.lines.iter().map(|line| line.cycles).max();
    for (file, name, text) in found.files() {
        let _ = write!(
            out,
            "<h2>{}</h2>\n<table>\n<tr><th>share<th>{}<th>runs<th>{}<th>error<th class=\"rate\">rate\
             <th>line<th class=\"code\">source\n",
            escaped(name),
            found.unit(),
            found.size_unit()
        );
        for (number, text) in (1..).zip(text.lines()) {
            let line = found.line(file, number);
            row(&mut out, found, line, number, text, most.unwrap_or(0));
        }
        out.push_str("</table>\n");
    }
    out.push_str("</html>\n");
    out
}

fn row(
    out: &mut String,
    found: &Explained,
    line: Option<&SourceLine>,
    number: usize,
    text: &str,
    most: u64,
) {
    let text = escaped(text);
    let Some(line) = line else {
        let _ = writeln!(
            out,
            "<tr><td colspan=\"6\"><td class=\"none\">{number}<td class=\"code\">{text}"
        );
        return;
    };
    let heat = 100.0 * line.cycles as f64 / most.max(1) as f64;
    let error = found
        .error(line)
        .map_or(String::new(), |e| percent(e.share));
    let _ = write!(
        out,
        "<tr><td>{}<td>{}<td>{}<td>{}<td>{error}<td class=\"rate\">{}<td>{number}\
         <td class=\"code\" style=\"background:linear-gradient(90deg,#f6a04066 {heat:.1}%,transparent {heat:.1}%)\">",
        percent(found.share(line.cycles)),
        count(line.cycles),
        count(line.executions),
        count(line.size),
        rate(line),
    );
    let parts = line.parts.iter().map(|part| item(found, part, ""));
    let within = line.within.iter();
    let within = within.map(|part| item(found, part, "library: "));
    let items: String = parts.chain(within).collect();
    let _ = match items.is_empty() {
        true => writeln!(out, "{text}"),
        false => writeln!(
            out,
            "<details><summary>{text}</summary><ul>{items}</ul></details>"
        ),
    };
}

fn item(found: &Explained, part: &Part, kind: &str) -> String {
    format!(
        "<li>{} {kind}{}, {} times",
        percent(found.share(part.cycles)),
        escaped(&part.name),
        count(part.times)
    )
}
