//! The page: one file that shows the frontier to who has never seen the project.
//!
//! It is well-formed XML as well as HTML, asks for nothing from anywhere, and works from a
//! disk. Without scripts the plot, the sentence and the table are there all the same; a
//! script shows the point that is clicked, from the data that stands in the page.

use super::goal::{Measure, percent};
use super::plot::svg;
use super::point::Point;
use super::spent::Spent;
use super::tell::Told;
use crate::format::{count, duration};
use crate::sheet::{escaped, marked};
use serde_json::{Value, json};

const TEMPLATE: &str = include_str!("page.html");

/// The page; `native` is the native picture as a PNG in base 64.
pub fn page(told: &Told<'_>, native: &str) -> String {
    let scene = told.base.name();
    let parts = [
        (
            "{{title}}",
            escaped(&format!("{scene} on {}", told.base.target.name)),
        ),
        ("{{sentence}}", escaped(&told.sentence())),
        ("{{plot}}", svg(told)),
        ("{{native}}", native.to_owned()),
        ("{{rows}}", rows(told)),
        ("{{failed}}", failed(told)),
        ("{{measure}}", escaped(told.measure.caption())),
        ("{{command}}", escaped(&command(told))),
        ("{{data}}", data(told)),
    ];
    // One pass, so that nothing that is put in is looked at again.
    let mut out = String::new();
    let mut rest = TEMPLATE;
    while let Some(at) = rest.find("{{") {
        let (before, from) = rest.split_at(at);
        out.push_str(before);
        match parts.iter().find(|(name, _)| from.starts_with(name)) {
            Some((name, text)) => {
                out.push_str(text);
                rest = &from[name.len()..];
            }
            None => {
                out.push_str("{{");
                rest = &from[2..];
            }
        }
    }
    out + rest
}

fn command(told: &Told<'_>) -> String {
    let measure = match told.measure {
        Measure::Pixels => "",
        Measure::Rmse => " --measure rmse",
        Measure::Lowpass => " --measure lowpass",
    };
    let scene = told.base.path.display();
    format!(
        "slowlight tune {scene} --target {}{measure} --html report.html",
        told.base.target.name
    )
}

/// The frontier's rows.
fn rows(told: &Told<'_>) -> String {
    let row = |(k, point): (usize, &Point)| {
        let at = &point.measured;
        let words = told.base.words(&point.choice).join(" ");
        format!(
            "<tr data-point=\"{k}\"><td>{}</td><td data-name=\"time\">{}</td>\
             <td data-name=\"cycles\">{}</td><td data-name=\"error\">{}</td>\
             <td data-name=\"bytes\">{}</td></tr>\n",
            if words.is_empty() {
                "none".to_owned()
            } else {
                escaped(&words)
            },
            duration(at.seconds),
            count(at.cycles),
            percent(told.error(point)),
            count(at.memory()),
        )
    };
    told.frontier().map(row).collect()
}

fn failed(told: &Told<'_>) -> String {
    let all = told.found.failed.iter();
    let item = |(choice, why): &(super::choice::Choice, String)| {
        let words = told.base.words(choice).join(" ");
        format!(
            "<li><code>{}</code>: {}</li>\n",
            escaped(&words),
            marked(why)
        )
    };
    let items: String = all.map(item).collect();
    match items.is_empty() {
        true => String::new(),
        false => format!("<h2>Not to be had</h2>\n<ul>{items}</ul>\n"),
    }
}

/// What the script shows of each point, as JSON that can stand in a script: no `<` in it.
fn data(told: &Told<'_>) -> String {
    let points: Vec<Value> = (0..told.points.len()).map(|k| shown(told, k)).collect();
    let text = Value::Array(points).to_string();
    text.replace('<', "\\u003c")
        .replace('>', "\\u003e")
        .replace('&', "\\u0026")
}

fn shown(told: &Told<'_>, k: usize) -> Value {
    let point = &told.points[k];
    let (at, e) = (&point.measured, &point.measured.errors);
    let share = at.cycles as f64 / at.predicted.max(1.0);
    let facts = json!([
        ["time of the machine", duration(at.seconds)],
        ["cycles, measured", count(at.cycles)],
        [
            "cycles that the routines' costs predict",
            format!(
                "{} ({share:.2} times that were measured)",
                count(at.predicted as u64)
            )
        ],
        ["bytes of code, tables and memory", count(at.memory())],
        [
            "pixels in another ink than the native one",
            format!(
                "{} of {} ({})",
                count(e.pixels),
                count(e.count),
                percent(Measure::Pixels.of(e))
            )
        ],
        [
            "as many as the shades let one expect",
            count(e.expected.round() as u64)
        ],
        [
            "root mean square error of shades",
            format!("{:.3e}", e.rmse)
        ],
        [
            "peak signal to noise of shades",
            e.psnr
                .map_or("infinite".to_owned(), |db| format!("{db:.1} dB"))
        ],
        ["99 of 100 shades are within", format!("{:.3e}", e.p99)],
        ["greatest error of a shade", format!("{:.3e}", e.max)],
        ["error as seen from afar", format!("{:.3e}", e.low_pass)],
    ]);
    json!({
        "words": in_words(told, point),
        "spent": at.spent.iter().map(sentence).collect::<Vec<[String; 3]>>(),
        "command": told.base.command(&point.choice, "run"),
        "build": told.base.command(&point.choice, "build"),
        "better": told.by[k].map(|by| told.base.words(&told.points[by].choice).join(" ")),
        "facts": facts,
        "picture": at.picture,
        "difference": at.difference,
    })
}

/// The choices that made a point.
fn in_words(told: &Told<'_>, point: &Point) -> Vec<String> {
    let choice = &point.choice;
    let mut words = vec![format!(
        "Numbers are held as {} ({}).",
        choice.format,
        if choice.format == told.base.target.runtime.format {
            "usual on this machine"
        } else {
            "not the usual format"
        }
    )];
    words.push(match choice.frozen {
        true => {
            "The scene's params are folded: quicker, and no longer to be changed in the program."
                .to_owned()
        }
        false => "The scene's params stay changeable in the program.".to_owned(),
    });
    words.push(match (choice.setting.block, choice.setting.refine) {
        (_, Some(refine)) => format!(
            "Every {}th row is traced, and between them only pixels whose neighbours differ; the \
             others lie between those.",
            refine.step
        ),
        ((1, 1), None) => "Every pixel is traced by itself.".to_owned(),
        ((wide, high), None) => format!("One ray is traced for a block of {wide} x {high} pixels."),
    });
    if choice.outlined {
        words.push(
            "What the program has several times is a subroutine: smaller and slower.".to_owned(),
        );
    }
    if let Some(most) = choice.setting.max_turns {
        words.push(format!(
            "The scene's loops (bounces, say) end after {}.",
            turns(most)
        ));
    }
    if let Some(most) = choice.setting.max_steps {
        words.push(format!(
            "The library's loops (marches, searches, walks) end after {}.",
            turns(most)
        ));
    }
    words
}

/// A line and what it takes, as a person would say it: what stands before its text, the
/// text, and what stands behind.
fn sentence(spent: &Spent) -> [String; 3] {
    let mut text = format!("{} of the time", percent(spent.share));
    match spent.error {
        Some(error) if error >= 0.0005 => {
            text.push_str(&format!(" and {} of the error", percent(error)));
        }
        Some(_) => text.push_str(" and none of the error"),
        None => {}
    }
    text.push_str(&format!(": {}, ", spent.place));
    let routine = spent.routine.as_ref().map(|(name, share)| {
        let name = name.replace('`', "");
        format!(" ({name}: {} of the time)", percent(*share))
    });
    [text, spent.text.clone(), routine.unwrap_or_default()]
}

fn turns(most: u32) -> String {
    match most {
        1 => "one turn".to_owned(),
        more => format!("{more} turns"),
    }
}
