//! What was found, as a table, as JSON, as CSV, and in one sentence.

use super::choice::{Base, Choice};
use super::explore::Found;
use super::goal::{Measure, percent};
use super::marks::Mark;
use super::point::Point;
use super::rows::Look;
use crate::format::{count, duration, table};
use serde_json::{Value, json};
use slowlight_compiler::report::frontier::{Way, dominated, rank_correlation};

/// All points in order of their time, and which of them are worth choosing.
pub struct Told<'a> {
    /// What stays as the user has it.
    pub base: &'a Base,
    /// The error that decides.
    pub measure: Measure,
    /// From the quickest to the slowest.
    pub points: Vec<Point>,
    /// For each, which dominates it.
    pub by: Vec<Option<usize>>,
    /// What could not be had.
    pub found: &'a Found,
    /// Programs of others, to compare with.
    pub marks: Vec<Mark>,
}

impl<'a> Told<'a> {
    /// Orders what was found.
    pub fn new(base: &'a Base, measure: Measure, found: &'a Found) -> Told<'a> {
        let mut points = found.points.clone();
        points.sort_by(|a, b| {
            let cycles = a.measured.cycles.cmp(&b.measured.cycles);
            cycles.then_with(|| a.choice.cmp(&b.choice))
        });
        let ways: Vec<Way> = points.iter().map(|p| way(measure, p)).collect();
        Told {
            base,
            measure,
            by: dominated(&ways),
            points,
            found,
            marks: Vec::new(),
        }
    }

    /// A point's error.
    pub fn error(&self, point: &Point) -> f64 {
        self.measure.of(&point.measured.errors)
    }

    /// What is worth choosing, from the quickest to the slowest.
    pub fn frontier(&self) -> impl DoubleEndedIterator<Item = (usize, &Point)> {
        let all = self.points.iter().enumerate().zip(&self.by);
        all.filter(|(_, by)| by.is_none()).map(|(point, _)| point)
    }

    /// How well the planner's figures order the frontier by time.
    pub fn correlation(&self) -> Option<f64> {
        let pairs: Vec<(f64, f64)> = self
            .frontier()
            .map(|(_, p)| (p.measured.predicted, p.measured.cycles as f64))
            .collect();
        rank_correlation(&pairs)
    }

    /// The point after which accuracy becomes dear: on a line from one end of the frontier
    /// to the other, both axes by their logarithms, the one furthest below.
    pub fn knee(&self) -> Option<&Point> {
        let all: Vec<&Point> = self.frontier().map(|(_, p)| p).collect();
        let (first, last) = (all.first()?, all.last()?);
        let floor = 0.5 / first.measured.errors.count.max(1) as f64;
        let at = |p: &Point| (p.measured.seconds.ln(), self.error(p).max(floor).ln());
        let ((x0, y0), (x1, y1)) = (at(first), at(last));
        let below = |p: &&&Point| {
            let (x, y) = at(p);
            (x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)
        };
        all.iter()
            .max_by(|a, b| below(a).total_cmp(&below(b)))
            .copied()
    }

    /// The conclusion.
    pub fn sentence(&self) -> String {
        let name = self.base.name();
        let target = self.base.target.name;
        let mut ends = self.frontier().map(|(_, p)| p);
        let Some(quick) = ends.next() else {
            return format!("{name} cannot be drawn on {target}: nothing that was tried works.");
        };
        let says = |p: &Point| {
            let time = duration(p.measured.seconds);
            format!(
                "{time} with {} {}",
                percent(self.error(p)),
                self.measure.phrase()
            )
        };
        let Some(best) = ends.next_back() else {
            return format!(
                "{name} on {target} takes {}; no other way is worth it.",
                says(quick)
            );
        };
        let mut text = format!(
            "{name} on {target} takes from {} to {}; {} of {} ways that were tried are worth choosing",
            says(quick),
            says(best),
            self.frontier().count(),
            self.found.tried.max(self.points.len()),
        );
        if let Some(knee) = self.knee() {
            let words = self.base.words(&knee.choice).join(" ");
            if !words.is_empty() && knee.choice != quick.choice && knee.choice != best.choice {
                text.push_str(&format!(
                    ", and accuracy becomes dear after {} ({words})",
                    says(knee)
                ));
            }
        }
        text + "."
    }

    /// The frontier, a row a point and a cell a figure; the first row has the titles.
    pub fn rows(&self) -> Vec<Vec<String>> {
        let head = [
            "options", "time", "cycles", "pixels", "%", "rmse", "low-pass", "bytes",
        ];
        let mut rows = vec![head.map(str::to_owned).to_vec()];
        rows.extend(self.frontier().map(|(_, point)| self.row(point)));
        rows
    }

    fn row(&self, point: &Point) -> Vec<String> {
        let at = &point.measured;
        let words = self.base.words(&point.choice).join(" ");
        let share = percent(Measure::Pixels.of(&at.errors));
        vec![
            match words.is_empty() {
                true => "(none)".to_owned(),
                false => words,
            },
            duration(at.seconds),
            count(at.cycles),
            count(at.errors.pixels),
            share.trim_end_matches(" %").to_owned(),
            format!("{:.2e}", at.errors.rmse),
            format!("{:.2e}", at.errors.low_pass),
            count(at.memory()),
        ]
    }

    /// The frontier as a table.
    pub fn table(&self) -> String {
        let mut out = table(&self.rows());
        out.push_str(
            "pixels, %: whose ink is not the native one; rmse: of shades before the dither; low-pass: of \
             inks under a Gaussian of 3 pixels; bytes: code, tables, memory; time and cycles: measured; \
             none of these is beaten by another in both time and error (docs/tune.md)\n",
        );
        for (choice, why) in &self.found.failed {
            out.push_str(&format!(
                "not to be had: {}: {why}\n",
                self.base.words(choice).join(" ")
            ));
        }
        if let Some(beyond) = self.beyond() {
            out.push_str(&beyond);
        }
        out
    }

    /// What was left out because it takes much work, if anything: the best of it.
    fn beyond(&self) -> Option<String> {
        let all = &self.found.beyond;
        let best = |a: &&(Choice, Look), b: &&(Choice, Look)| {
            let key = |(_, look): &(Choice, Look)| (look.error, look.cycles);
            let ((e, c), (f, d)) = (key(a), key(b));
            e.total_cmp(&f).then(c.total_cmp(&d))
        };
        let (choice, look) = all.iter().min_by(best)?;
        Some(format!(
            "beyond --effort: {}, such as {}, about {}: a greater --effort tries more\n",
            all.len(),
            self.base.words(choice).join(" "),
            duration(look.cycles / self.base.hertz()),
        ))
    }

    /// All points as JSON.
    pub fn json(&self, chosen: Option<&Point>) -> Value {
        let points: Vec<Value> = (0..self.points.len()).map(|k| self.point(k)).collect();
        let failed = self.found.failed.iter().map(
            |(choice, why)| json!({"options": self.base.words(choice).join(" "), "error": why}),
        );
        let mut left: Vec<Value> = (self.found.left.iter())
            .map(|(choice, look)| {
                json!({
                    "options": self.base.words(choice).join(" "),
                    "cycles_by_rows": look.cycles.round(),
                    "error_on_rows": look.error,
                })
            })
            .collect();
        let pruned = (self.found.pruned.iter()).map(|(choice, look)| {
            json!({
                "options": self.base.words(choice).join(" "),
                "cycles_expected": look.cycles.round(),
                "error_expected": look.error,
            })
        });
        let beyond = (self.found.beyond.iter()).map(|(choice, look)| {
            json!({
                "options": self.base.words(choice).join(" "),
                "cycles_expected": look.cycles.round(),
                "error_expected": look.error,
            })
        });
        let drafts = (self.found.drafted.iter()).map(|draft| {
            json!({
                "options": self.base.setting(&draft.setting).join(" "),
                "operations": draft.work,
                "error": self.measure.of(&draft.errors),
            })
        });
        let drafts: Vec<Value> = drafts.collect();
        left.sort_by_key(|v| v["options"].as_str().map(str::to_owned));
        let span = |of: &dyn Fn(&Point) -> f64| {
            let all: Vec<f64> = self.frontier().map(|(_, p)| of(p)).collect();
            let most = all.iter().copied().fold(0.0, f64::max);
            let least = all
                .iter()
                .copied()
                .filter(|v| *v > 0.0)
                .fold(f64::INFINITY, f64::min);
            (least < f64::INFINITY).then_some(most / least)
        };
        json!({
            "scene": self.base.path.display().to_string(),
            "target": self.base.target.name,
            "measure": self.measure,
            "conclusion": self.sentence(),
            "tried": self.found.tried,
            "frontier": {
                "points": self.frontier().count(),
                "time_span": span(&|p| p.measured.seconds),
                // Of errors above 0.
                "error_span": span(&|p| self.error(p)),
                "rank_correlation": self.correlation(),
            },
            "points": points,
            "left_after_drafts": drafts,
            "left_after_formats": pruned.collect::<Vec<Value>>(),
            "left_after_rows": left,
            "left_for_effort": beyond.collect::<Vec<Value>>(),
            "failed": failed.collect::<Vec<Value>>(),
            "chosen": chosen.map(|p| self.base.words(&p.choice).join(" ")),
        })
    }

    fn point(&self, k: usize) -> Value {
        let (point, by) = (&self.points[k], self.by[k]);
        let (at, choice) = (&point.measured, &point.choice);
        let [code, tables, ram] = at.bytes;
        json!({
            "options": self.base.words(choice).join(" "),
            "command": self.base.command(choice, "run"),
            "on_frontier": by.is_none(),
            "dominated_by": by.map(|k| self.base.words(&self.points[k].choice).join(" ")),
            "format": choice.format,
            "tables": choice.tables,
            "frozen": choice.frozen,
            "block": choice.setting.block,
            "refine": choice.setting.refine.map(|refine| refine.to_string()),
            "outlined": choice.outlined,
            "max_turns": choice.setting.max_turns,
            "max_steps": choice.setting.max_steps,
            "ways": ways(choice),
            "thrift": choice.thrift,
            "mode": at.mode,
            "inks": at.inks,
            "cycles": at.cycles,
            "machine_seconds": at.seconds,
            "predicted_cycles": at.predicted.round(),
            "code_bytes": code,
            "table_bytes": tables,
            "ram_bytes": ram,
            "error": self.error(point),
            "rmse": at.errors.rmse,
            "psnr": at.errors.psnr,
            "max_error": at.errors.max,
            "p99_error": at.errors.p99,
            "pixels": at.errors.count,
            "differs_from_native": at.errors.pixels,
            "expected_differing": at.errors.expected,
            "low_pass_rmse": at.errors.low_pass,
            "differs_from_model": at.differs_from_model,
            "program_sha256": at.program_sha256,
            "inks_sha256": at.inks_sha256,
            "spent": at.spent,
        })
    }

    /// All points as comma-separated values.
    pub fn csv(&self) -> String {
        let head = "options,on_frontier,cycles,machine_seconds,predicted_cycles,bytes,pixels,\
                    differs_from_native,expected_differing,rmse,psnr,max_error,p99_error,low_pass_rmse\n";
        let mut out = head.to_owned();
        for (point, by) in self.points.iter().zip(&self.by) {
            let (at, e) = (&point.measured, &point.measured.errors);
            let words = self
                .base
                .words(&point.choice)
                .join(" ")
                .replace('"', "\"\"");
            let psnr = e.psnr.map_or(String::new(), |db| db.to_string());
            out.push_str(&format!(
                "\"{words}\",{},{},{},{},{},{},{},{},{},{psnr},{},{},{}\n",
                by.is_none(),
                at.cycles,
                at.seconds,
                at.predicted.round(),
                at.memory(),
                e.count,
                e.pixels,
                e.expected,
                e.rmse,
                e.max,
                e.p99,
                e.low_pass,
            ));
        }
        out
    }
}

/// What is found in another way than the scene says: options and their values.
fn ways(choice: &Choice) -> Value {
    let words = choice.setting.ways.words().into_iter();
    let pairs = words.map(|(o, v)| (o.trim_start_matches('-').to_owned(), Value::from(v)));
    Value::Object(pairs.collect())
}

fn way(measure: Measure, point: &Point) -> Way {
    Way {
        cost: point.measured.cycles as f64,
        error: measure.of(&point.measured.errors),
    }
}
