//! Lines of text as a picture, with bars behind them: what a terminal shows, for a page.
//!
//! The SVG stands by itself: no fonts, scripts or styles from elsewhere. Each line is set to
//! its own length, so that columns stand under each other in any font.

use std::fmt::Write as _;

/// A character's width, a line's height and the edge, in pixels.
const WIDE: f64 = 7.2;
const HIGH: f64 = 17.0;
const EDGE: f64 = 14.0;

/// A line of a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// What is written.
    pub text: String,
    /// How long the bar behind it is, from 0 to 1; none without one.
    pub bar: Option<f64>,
}

impl Line {
    /// A line without a bar.
    pub fn plain(text: &str) -> Line {
        Line {
            text: text.to_owned(),
            bar: None,
        }
    }
}

/// The picture; bars begin at a character's column.
pub fn svg(title: &str, lines: &[Line], from: usize) -> String {
    let most = lines.iter().map(|line| line.text.chars().count()).max();
    let wide = 2.0 * EDGE + WIDE * most.unwrap_or(0) as f64;
    let high = 2.0 * EDGE + HIGH * lines.len() as f64;
    let left = EDGE + WIDE * from as f64;
    // Writing to a String cannot fail.
    let mut out = String::new();
    let _ = write!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {wide:.0} {high:.0}\" \
         width=\"{wide:.0}\" height=\"{high:.0}\" role=\"img\" font-family=\"ui-monospace, \
         Menlo, Consolas, 'DejaVu Sans Mono', monospace\" font-size=\"12\">\n\
         <title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        escaped(title)
    );
    for (k, line) in lines.iter().enumerate() {
        let top = EDGE + HIGH * k as f64;
        if let Some(part) = line.bar.filter(|part| *part > 0.0) {
            let long = (wide - EDGE - left).max(0.0) * part.clamp(0.0, 1.0);
            let _ = writeln!(
                out,
                "<rect class=\"bar\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{long:.1}\" \
                 height=\"{HIGH}\" fill=\"#f6a040\" fill-opacity=\"0.4\"/>"
            );
        }
        let text = line.text.trim_end();
        let first = text.chars().take_while(|c| *c == ' ').count();
        let text = text.trim_start();
        if text.is_empty() {
            continue;
        }
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" textLength=\"{:.1}\" lengthAdjust=\"spacingAndGlyphs\" \
             xml:space=\"preserve\" style=\"white-space:pre\" fill=\"#222\">{}</text>",
            EDGE + WIDE * first as f64,
            top + 0.75 * HIGH,
            WIDE * text.chars().count() as f64,
            escaped(text)
        );
    }
    out.push_str("</svg>\n");
    out
}

/// A text that may stand in XML.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // Not allowed in XML at all.
            c if c.is_control() && !matches!(c, '\n' | '\t') => out.push('?'),
            c => out.push(c),
        }
    }
    out
}

/// The same, with what stands between backticks as code.
pub fn marked(text: &str) -> String {
    let mut out = String::new();
    for (k, part) in text.split('`').enumerate() {
        out += &match k % 2 {
            0 => escaped(part),
            _ => format!("<code>{}</code>", escaped(part)),
        };
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn backticks_are_code() {
        assert_eq!(
            marked("a < `b < c`, `d`"),
            "a &lt; <code>b &lt; c</code>, <code>d</code>"
        );
        assert_eq!(marked("`a"), "<code>a</code>");
        assert_eq!(marked("none"), "none");
    }

    #[test]
    fn bars_are_shares_of_the_room_behind_their_column() {
        let lines = [
            Line {
                text: "0123456789".to_owned(),
                bar: Some(0.5),
            },
            Line::plain("  a < b"),
            Line::plain(""),
        ];
        let svg = svg("bars & text", &lines, 4);
        let tree = roxmltree::Document::parse(&svg).expect("it parses");
        let with = |name: &str| {
            let all = tree.descendants().filter(|n| n.has_tag_name(name));
            all.collect::<Vec<_>>()
        };
        let bars: Vec<_> = tree
            .descendants()
            .filter(|n| n.attribute("class") == Some("bar"))
            .collect();
        assert_eq!(bars.len(), 1);
        // Six characters are behind the column, and half of them is three.
        assert_eq!(bars[0].attribute("width"), Some("21.6"));
        assert_eq!(bars[0].attribute("x"), Some("42.8"));
        let said: Vec<_> = tree
            .descendants()
            .filter(|n| n.tag_name().name() == "text")
            .filter_map(|n| n.text())
            .collect();
        assert_eq!(said, ["0123456789", "a < b"]);
        assert!(with("script").is_empty());
    }
}
