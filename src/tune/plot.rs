//! The frontier as a picture: machine time on a logarithmic axis against error.
//!
//! The SVG stands by itself: no fonts, scripts or styles from elsewhere.

use super::goal::percent;
use super::marks::diamond;
use super::tell::Told;
use crate::format::duration;
use crate::sheet::escaped;
use slowlight_compiler::targets::System;

/// The picture's size, and where the axes are in it.
const SIZE: (f64, f64) = (920.0, 560.0);
const LEFT: f64 = 92.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 30.0;
const BOTTOM: f64 = 74.0;
/// Room below the axis for pictures without error, which a logarithm has no place for.
const NOTHING: f64 = 34.0;

/// A logarithmic axis.
struct Axis {
    /// The logarithms to the base 10 of its ends.
    ends: (f64, f64),
    /// Where the ends are.
    places: (f64, f64),
}

impl Axis {
    fn over(values: impl Iterator<Item = f64>, places: (f64, f64)) -> Axis {
        let logs: Vec<f64> = values.filter(|v| *v > 0.0).map(f64::log10).collect();
        let least = logs.iter().copied().fold(f64::INFINITY, f64::min);
        let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let ends = match least <= most {
            true => {
                let air = (0.04 * (most - least)).max(0.1);
                (least - air, most + air)
            }
            false => (-1.0, 0.0),
        };
        Axis { ends, places }
    }

    fn at(&self, value: f64) -> f64 {
        let part = (value.log10() - self.ends.0) / (self.ends.1 - self.ends.0);
        self.places.0 + part * (self.places.1 - self.places.0)
    }

    /// Values to mark: the powers of ten, with 2 and 5 times these where there are few.
    fn marks(&self) -> Vec<f64> {
        let whole = |factors: &[f64]| -> Vec<f64> {
            let from = self.ends.0.floor() as i32;
            let to = self.ends.1.ceil() as i32;
            let all = (from..=to).flat_map(|k| factors.iter().map(move |f| f * 10f64.powi(k)));
            all.filter(|v| (self.ends.0..=self.ends.1).contains(&v.log10()))
                .collect()
        };
        let tens = whole(&[1.0]);
        match tens.len() {
            0..=3 => whole(&[1.0, 2.0, 5.0]),
            _ => tens,
        }
    }
}

/// Times that people know.
const TIMES: [f64; 18] = [
    0.001,
    0.01,
    0.1,
    1.0,
    3.0,
    10.0,
    30.0,
    60.0,
    180.0,
    600.0,
    1800.0,
    3600.0,
    10800.0,
    36000.0,
    86400.0,
    259_200.0,
    864_000.0,
    2_592_000.0,
];

/// The plot; points are circles with the class `point` and their number in `data-point`.
pub fn svg(told: &Told<'_>) -> String {
    let (width, height) = SIZE;
    let across = (LEFT, width - RIGHT);
    let times = told.points.iter().map(|p| p.measured.seconds);
    let hertz = told.base.hertz();
    let times = times.chain(told.marks.iter().map(|mark| mark.time.seconds(hertz)));
    let errors = told.points.iter().map(|p| told.error(p));
    let errors = errors.chain(told.marks.iter().map(|mark| mark.error));
    let exact = errors.clone().any(|error| error == 0.0);
    let floor = height - BOTTOM - if exact { NOTHING } else { 0.0 };
    let x = Axis::over(times, across);
    let y = Axis::over(errors, (floor, TOP));
    let down = |error: f64| {
        if error > 0.0 {
            y.at(error)
        } else {
            height - BOTTOM - NOTHING / 2.0
        }
    };
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"sans-serif\" font-size=\"13\" role=\"img\">\n\
         <title>{}</title>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
        escaped(&told.sentence())
    );
    grid(&mut out, &x, &y, exact);
    captions(&mut out, told);
    let mut line = String::new();
    let mut before: Option<f64> = None;
    for (_, point) in told.frontier() {
        let (px, py) = (x.at(point.measured.seconds), down(told.error(point)));
        // A step: between two points nothing better is to be had than the quicker one.
        match before {
            None => line.push_str(&format!("M{px:.1} {py:.1}")),
            Some(_) => line.push_str(&format!("H{px:.1}V{py:.1}")),
        }
        before = Some(py);
    }
    out.push_str(&format!(
        "<path d=\"{line}\" fill=\"none\" stroke=\"#1b6ca8\" stroke-width=\"1.5\" stroke-opacity=\"0.6\"/>\n"
    ));
    // What is worth choosing is drawn last, above the others.
    for on in [false, true] {
        for (k, (point, by)) in told.points.iter().zip(&told.by).enumerate() {
            if by.is_none() != on {
                continue;
            }
            let (px, py) = (x.at(point.measured.seconds), down(told.error(point)));
            let (radius, fill, opacity) = match on {
                true => (6.0, "#1b6ca8", 1.0),
                false => (4.0, "#888888", 0.3),
            };
            let words = told.base.words(&point.choice).join(" ");
            let label = format!(
                "{}: {}, {} {}",
                if words.is_empty() {
                    "no options"
                } else {
                    &words
                },
                duration(point.measured.seconds),
                percent(told.error(point)),
                told.measure.phrase()
            );
            out.push_str(&format!(
                "<circle class=\"point\" data-point=\"{k}\" cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"{radius}\" \
                 fill=\"{fill}\" fill-opacity=\"{opacity}\"><title>{}</title></circle>\n",
                escaped(&label)
            ));
        }
    }
    for mark in &told.marks {
        let at = (x.at(mark.time.seconds(hertz)), down(mark.error));
        let middle = (across.0 + across.1) / 2.0;
        diamond(&mut out, mark, at, middle, (told.measure.phrase(), hertz));
    }
    out.push_str("</svg>");
    out
}

fn grid(out: &mut String, x: &Axis, y: &Axis, exact: bool) {
    let (width, height) = SIZE;
    let ((left, right), bottom) = ((LEFT, width - RIGHT), height - BOTTOM);
    let known: Vec<f64> = (TIMES.into_iter())
        .filter(|t| (x.ends.0..=x.ends.1).contains(&t.log10()))
        .collect();
    let times = if known.len() >= 2 { known } else { x.marks() };
    for time in times {
        let at = x.at(time);
        out.push_str(&format!(
            "<path d=\"M{at:.1} {TOP}V{bottom}\" stroke=\"#e4e4e4\"/>\
             <text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#444444\">{}</text>\n",
            bottom + 18.0,
            short(time)
        ));
    }
    for error in y.marks() {
        let at = y.at(error);
        out.push_str(&format!(
            "<path d=\"M{left} {at:.1}H{right}\" stroke=\"#e4e4e4\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"#444444\">{}</text>\n",
            left - 8.0,
            at + 4.5,
            mark(error)
        ));
    }
    if exact {
        let at = bottom - NOTHING / 2.0;
        out.push_str(&format!(
            "<path d=\"M{left} {:.1}H{right}\" stroke=\"#bbbbbb\" stroke-dasharray=\"3 4\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"#444444\">0 %</text>\n",
            bottom - NOTHING,
            left - 8.0,
            at + 4.5
        ));
    }
    out.push_str(&format!(
        "<path d=\"M{left} {TOP}V{bottom}H{right}\" fill=\"none\" stroke=\"#444444\"/>\n"
    ));
}

fn captions(out: &mut String, told: &Told<'_>) {
    let (width, height) = SIZE;
    let middle = (LEFT + width - RIGHT) / 2.0;
    let clock = if told.base.target.system == System::Hack {
        "time of the Hack computer, at the rate of the web IDE's emulator"
    } else {
        "time of the machine"
    };
    out.push_str(&format!(
        "<text x=\"{middle}\" y=\"{:.1}\" text-anchor=\"middle\">{clock} (logarithmic; to the left is quicker)</text>\n",
        height - 30.0
    ));
    out.push_str(&format!(
        "<text x=\"{middle}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#666666\">blue: worth choosing; grey: another point is both quicker and nearer the native picture{}</text>\n",
        height - 10.0,
        if told.marks.is_empty() { "" } else { "; red: a program of others" }
    ));
    let halfway = (TOP + height - BOTTOM) / 2.0;
    out.push_str(&format!(
        "<text transform=\"translate(20 {halfway}) rotate(-90)\" text-anchor=\"middle\" font-size=\"12\">{}</text>\n",
        escaped(told.measure.caption())
    ));
}

/// A mark's time, in one unit.
fn short(seconds: f64) -> String {
    let units = [
        (86400.0, "d"),
        (3600.0, "h"),
        (60.0, "min"),
        (1.0, "s"),
        (1e-3, "ms"),
        (1e-6, "us"),
    ];
    let (size, unit) = units
        .into_iter()
        .find(|(size, _)| seconds >= 0.999 * size)
        .unwrap_or((1e-6, "us"));
    format!("{} {unit}", (seconds / size * 1000.0).round() / 1000.0)
}

/// A mark's error.
fn mark(error: f64) -> String {
    let text = percent(error);
    let (digits, unit) = text.split_once(' ').unwrap_or((&text, "%"));
    let digits = match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.'),
        false => digits,
    };
    format!("{digits} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_logarithmic() {
        let axis = Axis::over([1.0, 100.0].into_iter(), (0.0, 100.0));
        assert!((axis.at(10.0) - 50.0).abs() < 1e-9);
        assert!(axis.at(1.0) > 0.0 && axis.at(100.0) < 100.0);
        assert!(axis.marks().contains(&10.0));
        // One value, and none.
        let one = Axis::over([5.0].into_iter(), (0.0, 100.0));
        assert!((one.at(5.0) - 50.0).abs() < 1e-9 && !one.marks().is_empty());
        assert!(
            Axis::over([0.0].into_iter(), (0.0, 1.0))
                .at(0.5)
                .is_finite()
        );
    }

    #[test]
    fn marks_read_well() {
        assert_eq!(short(60.0), "1 min");
        assert_eq!(short(0.01), "10 ms");
        assert_eq!(mark(0.001), "0.1 %");
        assert_eq!(mark(1.0), "100 %");
        assert_eq!(escaped("a<b & \"c\""), "a&lt;b &amp; &quot;c&quot;");
    }
}
