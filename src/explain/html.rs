//! A profile as one page of HTML: no scripts, no network, nothing beside it.

use super::Explained;
use super::terminal::{error, percent, places, rate, spared};
use super::told::told;
use crate::draw::Window;
use crate::format::count;
use crate::sheet::{escaped, marked};
use slowlight_compiler::report::profile::{Part, SourceLine};
use std::fmt::Write as _;

const STYLE: &str = "\
:root{color-scheme:light dark;--ink:#222;--paper:#fff;--faint:#767676;--soft:#555;--line:#999;--bar:#f6a04066}
@media(prefers-color-scheme:dark){:root{--ink:#ddd;--paper:#181818;--faint:#8a8a8a;--soft:#aaa;--line:#666;--bar:#f6a04055}}
body{font:14px/1.4 system-ui,sans-serif;margin:2em;color:var(--ink);background:var(--paper)}
table{border-collapse:collapse;width:100%}
th,td{padding:1px 8px;text-align:right;white-space:nowrap;vertical-align:top}
th{border-bottom:1px solid var(--line);font-weight:600;position:sticky;top:0;background:var(--paper)}
td.code,th.code{text-align:left;white-space:pre-wrap;overflow-wrap:anywhere;font-family:ui-monospace,monospace;width:60%}
td.rate,th.rate{text-align:left}
td.none{color:var(--faint)}
summary{cursor:pointer;list-style:none}
summary::-webkit-details-marker{display:none}
summary::after{content:' \\25B8';color:var(--soft)}
details[open]>summary::after{content:' \\25BE'}
summary:focus-visible{outline:2px solid #3584e4;outline-offset:1px}
ul.why{max-width:60em}ul.why li{margin:.4em 0}
ul{margin:2px 0 6px;padding-left:2em;font:12px/1.5 system-ui,sans-serif;color:var(--soft)}
dl{display:grid;grid-template-columns:max-content 1fr;gap:2px 1em;max-width:60em}
dt{font-weight:600}dd{margin:0}
@media(max-width:700px){body{margin:1em}h1{overflow-wrap:anywhere}tr:first-child{display:none}
table,tbody{display:block}tr{display:flex;flex-wrap:wrap;gap:0 1em;padding:2px 0;border-bottom:1px solid var(--line)}
td{padding:0;font-size:12px;color:var(--soft)}td:empty{display:none}td[data-name]::before{content:attr(data-name) ' '}
td.code{order:-1;flex:1 0 calc(100% - 5em);width:auto;font-size:14px;color:var(--ink)}
td.number{order:-2;width:2.5em;text-align:right}}
";

/// What the columns say; the names of cycles and sizes are the machine's.
fn columns(found: &Explained) -> [(&'static str, String); 8] {
    let plain = |text: &str| text.to_owned();
    let unit = found.unit();
    let per_turn = "how often the line is computed: once, for each row, each column or each \
                    pixel, or in the turns of a loop";
    [
        (
            "share",
            format!(
                "of all {unit} of the program, and the bar behind the source beside that of the dearest line"
            ),
        ),
        (
            unit,
            plain("what the line took on the machine, the routines that it calls included"),
        ),
        ("runs", plain("how often what is written there was begun")),
        (
            found.size_unit(),
            plain("the program's length for this line, its routines not included"),
        ),
        (
            "error",
            plain(
                "the share of the mean square error that goes where this line's values are in 64-bit floating point; “cancels” where it grows",
            ),
        ),
        ("rate", plain(per_turn)),
        ("line", plain("its number in the scene or in the library")),
        (
            "source",
            plain(
                "the line; one with \u{25b8} opens to its parts: routines of the machine, and lines of the library that it calls",
            ),
        ),
    ]
}

/// The page.
pub fn page(found: &Explained) -> String {
    let plan = &found.plan;
    let title = escaped(&format!("{} on {}", found.scene.name, plan.target.name));
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n<h1>{title}</h1>\n"
    );
    let window = Window::on_screen(plan);
    let errors = &found.errors;
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        "<p>Rows {} to {}, numbers held as {}: {} {}. Beside the native picture, the scene in \
         64-bit floating point: a root mean square error of {:.2e} over the shades of {} pixels, \
         and {} of them in another ink.</p>",
        window.rows.0,
        window.rows.1,
        plan.runtime.format,
        count(found.run.cycles),
        found.unit(),
        errors.rmse,
        count(errors.pixels as u64),
        count(errors.differ as u64),
    );
    out.push_str("<dl>");
    for (name, text) in columns(found) {
        let _ = write!(out, "<dt>{}</dt><dd>{}</dd>", escaped(name), escaped(&text));
    }
    out.push_str("</dl>\n");
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
    why(&mut out, found);
    out.push_str("</html>\n");
    out
}

/// What lines' plans could not do, the dearest line first, if that was asked.
fn why(out: &mut String, found: &Explained) {
    let Some(all) = &found.why else {
        return;
    };
    out.push_str("<h2>What lines could not do</h2>\n");
    if all.is_empty() {
        out.push_str(
            "<p>No line would be cheaper by a range, a bound or a constant that was tried.</p>\n",
        );
        return;
    }
    out.push_str("<ul class=\"why\">\n");
    for told in told(found) {
        let spared = spared(found, told.saves, told.cycles);
        let _ = writeln!(
            out,
            "<li>{} ({}): {}",
            escaped(&places(found, &told.lines)),
            percent(found.share(told.cycles)),
            marked(&format!("{} {spared}", told.head))
        );
    }
    out.push_str("</ul>\n");
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
            "<tr><td><td><td><td><td><td class=\"rate\"><td class=\"number none\">{number}\
             <td class=\"code\">{text}"
        );
        return;
    };
    let heat = 100.0 * line.cycles as f64 / most.max(1) as f64;
    let error = found.error(line).map_or(String::new(), |e| error(e.share));
    let _ = write!(
        out,
        "<tr><td>{}<td data-name=\"{}\">{}<td data-name=\"runs\">{}<td data-name=\"{}\">{}\
         <td{}>{error}<td class=\"rate\">{}<td class=\"number\">{number}\
         <td class=\"code\" style=\"background:linear-gradient(90deg,var(--bar) {heat:.1}%,transparent {heat:.1}%)\">",
        percent(found.share(line.cycles)),
        found.unit(),
        count(line.cycles),
        count(line.executions),
        found.size_unit(),
        count(line.size),
        if error.is_empty() {
            ""
        } else {
            " data-name=\"error\""
        },
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
        marked(&part.name),
        count(part.times)
    )
}
