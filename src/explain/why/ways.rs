//! Candidate annotations: what a scene could say more, so that its plan may do more: params as
//! constants, and ranges of params.

use super::number;
use crate::failure::Outcome;
use crate::scene::{Edit, Precision, Scene};
use slowlight_compiler::ir::graph::Param;
use slowlight_compiler::sema::Ty;
use slowlight_compiler::source::Span;
use slowlight_compiler::syntax;
use slowlight_compiler::syntax::tree::{File, ItemKind, Param as Written};

/// How many params are looked at.
const PARAMS: usize = 16;

/// What is said more, and so what the plan lacked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A param is a constant.
    Constant,
    /// A param has a range, or a narrower one.
    Range,
    /// All params have ranges, so that formats that need them may be chosen.
    Formats,
    /// A shape has a bound.
    Bound,
    /// Rays have an end.
    Far,
    /// A loop has fewer turns.
    Turns,
}

/// A scene that says more.
pub struct Way {
    /// What.
    pub kind: Kind,
    /// Why the plan of the scene as it is has to do without.
    pub cause: String,
    /// What is to be written.
    pub change: String,
    /// The same in a sentence.
    pub said: String,
    /// The scene with it.
    pub scene: Scene,
    /// How its text was made.
    pub edits: Vec<Edit>,
}

impl Way {
    /// Where in the scene as it is something of this one is.
    pub fn told(&self, span: Span) -> Span {
        let edits = self.edits.iter().rev();
        edits.fold(span, |span, edit| edit.told(span))
    }
}

/// The scene's own files as trees, with their numbers and texts.
pub fn trees(scene: &Scene) -> Vec<(u16, &str, File)> {
    let files = (0..).zip(&scene.checked.sources.files);
    let own = files.filter(|(_, file)| !file.library);
    own.map(|(k, file)| (k, file.text.as_str(), syntax::parse(&file.text, k).0))
        .collect()
}

/// ` in NAME`, where a file is not the one that was given, but one that it uses.
pub fn within(scene: &Scene, file: u16) -> String {
    let named = scene.checked.sources.files.get(usize::from(file));
    match named.filter(|_| file != 0) {
        Some(file) => format!(" in {}", file.name),
        None => String::new(),
    }
}

/// A param: as it is written, and its numbers.
struct Known<'s> {
    file: u16,
    /// ` in NAME`, where that is none of its own.
    within: String,
    text: &'s str,
    item: Span,
    written: Written,
    ty: &'s Ty,
    parts: Vec<Param>,
}

/// Groups of ways, in each the one that claims least first: params as constants, and with
/// ranges.
///
/// # Errors
/// Where the scene does not compile.
pub fn of_params(scene: &Scene, formats: bool) -> Outcome<Vec<Vec<Way>>> {
    let numbers = scene.graph(None, Precision::NATIVE)?.params;
    let program = &scene.checked.program;
    let mut all = Vec::new();
    for (file, text, tree) in trees(scene) {
        for item in tree.items {
            let ItemKind::Param(written) = item.kind else {
                continue;
            };
            // What moves is no constant.
            if written.next.is_some() {
                continue;
            }
            let same = |p: &&Param| p.name == written.name.text;
            let parts: Vec<Param> = numbers.iter().filter(same).cloned().collect();
            // What is said of the text's value need not hold for one that was set.
            if parts.iter().any(|part| part.value != part.usual) {
                continue;
            }
            let known = program.params.iter().find(|p| p.name == written.name.text);
            // None of it is live where it is frozen already.
            if let Some(known) = known.filter(|_| !parts.is_empty() && all.len() < PARAMS) {
                all.push(Known {
                    file,
                    within: within(scene, file),
                    text,
                    item: item.span,
                    written,
                    ty: &known.ty,
                    parts,
                });
            }
        }
    }
    let mut groups = Vec::new();
    for known in &all {
        groups.push(vec![known.frozen(scene)]);
        let ranged = known.ranges();
        groups.push(
            ranged
                .iter()
                .filter_map(|r| known.within(scene, r))
                .collect(),
        );
    }
    let open: Vec<&Known<'_>> = all.iter().filter(|known| known.lacks_range()).collect();
    if formats && !open.is_empty() {
        groups.push(open_ones(scene, &open).into_iter().collect());
    }
    Ok(groups)
}

/// All params that have no range with one.
fn open_ones(scene: &Scene, open: &[&Known<'_>]) -> Option<Way> {
    let mut edits = Vec::new();
    let (mut texts, mut said) = (Vec::new(), Vec::new());
    // From the last to the first, so that none moves another.
    for known in open.iter().rev() {
        let ranges = known.ranges();
        let range = ranges.get(2).or(ranges.last())?;
        let (edit, text) = known.edit(range)?;
        edits.push(edit);
        said.push(format!("`{text}`{}", known.within));
        texts.push(text);
    }
    texts.reverse();
    said.reverse();
    let names = open.iter().map(|k| format!("`{}`", k.written.name.text));
    Some(Way {
        kind: Kind::Formats,
        cause: format!(
            "{} {} no range",
            listed(&names.collect::<Vec<_>>()),
            if open.len() == 1 { "has" } else { "have" }
        ),
        said: listed(&said),
        change: texts.join(" "),
        scene: scene.edited(&edits)?,
        edits,
    })
}

/// `a, b and c`.
fn listed(all: &[String]) -> String {
    match all {
        [before @ .., last] if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        _ => all.concat(),
    }
}

/// A piece of a scene without its comments and ends of lines.
fn on_a_line(text: &str) -> String {
    let code = text.lines().filter_map(|line| line.split("//").next());
    let words: Vec<&str> = code.flat_map(str::split_whitespace).collect();
    words.join(" ")
}

type Range = Vec<(f64, f64)>;

impl Known<'_> {
    fn name(&self) -> &str {
        &self.written.name.text
    }

    fn lacks_range(&self) -> bool {
        self.written.range.is_none() && *self.ty != Ty::Bool
    }

    fn text_of(&self, span: Span) -> &str {
        self.text.get(span.range()).unwrap_or("")
    }

    fn frozen(&self, scene: &Scene) -> Way {
        let name = self.name();
        let value = &on_a_line(self.text_of(self.written.value.span));
        // A constant has the type that it is written in.
        let real = match *self.ty == Ty::Real && value.parse::<i64>().is_ok() {
            true => ".0",
            false => "",
        };
        Way {
            kind: Kind::Constant,
            cause: format!("`{name}` may be changed in the program"),
            change: format!("const {name} = {value}{real};"),
            said: format!(
                "`const {name} = {value}{real};`{} or `--freeze {name}`",
                self.within
            ),
            scene: scene.freezing(name),
            edits: Vec::new(),
        }
    }

    /// Ranges about its value, the widest first.
    fn ranges(&self) -> Vec<Range> {
        if *self.ty == Ty::Bool {
            return Vec::new();
        }
        let of = |range: &dyn Fn(f64, (f64, f64)) -> (f64, f64)| -> Range {
            let part = |p: &Param| {
                let v = p.usual;
                let all = p
                    .range
                    .map_or((f64::NEG_INFINITY, f64::INFINITY), |r| (r.lo, r.hi));
                let (lo, hi) = range(v, all);
                let (lo, hi) = (lo.max(all.0).min(v), hi.min(all.1).max(v));
                match *self.ty {
                    Ty::Int => (lo.floor(), hi.ceil()),
                    _ => (lo, hi),
                }
            };
            self.parts.iter().map(part).collect()
        };
        let size = |v: f64| v.abs().max(1.0);
        // Of the value's sign, where it has one.
        let signed = |v: f64, times: f64| match v {
            v if v > 0.0 => (v / times, v * times),
            v if v < 0.0 => (v * times, v / times),
            _ => (-1.0, 1.0),
        };
        let mut all: Vec<Range> = match self.written.range {
            None => [100.0, 10.0]
                .map(|times| of(&move |v, _| (-times * size(v), times * size(v))))
                .into(),
            Some(_) => vec![of(&|v, (lo, hi)| {
                (f64::midpoint(lo, v), f64::midpoint(v, hi))
            })],
        };
        all.extend([4.0, 1.5].map(|times| of(&|v, _| signed(v, times))));
        all
    }

    /// The edit that gives it a range, and the item as it is written then.
    fn edit(&self, range: &Range) -> Option<(Edit, String)> {
        let text = self.text_of(self.item);
        let end = self.item.start as usize + text.rfind(';').unwrap_or(text.len());
        let start = match &self.written.range {
            Some((low, _)) => low.span.start as usize,
            None => end,
        };
        let one = |of: fn(&(f64, f64)) -> f64, up: bool| -> String {
            let parts = range.iter().zip(&self.parts);
            let parts = parts.map(|(r, p)| self.number(of(r), p.usual, up));
            let parts: Vec<String> = parts.collect();
            match parts.len() {
                1 => parts.concat(),
                _ => format!("({})", parts.join(", ")),
            }
        };
        let range = format!("{} .. {}", one(|r| r.0, false), one(|r| r.1, true));
        let put = match &self.written.range {
            Some(_) => range,
            None => format!(" in {range}"),
        };
        let before = self.text.get(self.item.start as usize..start)?;
        let whole = format!("{}{put};", on_a_line(before));
        // Lines behind it keep their numbers.
        let lines = self.text.get(start..end)?.matches('\n').count();
        let edit = Edit {
            at: Span::new(self.file, start, end),
            text: put + &"\n".repeat(lines),
        };
        Some((edit, whole))
    }

    /// An end of a range as it is written; beside the value it is nearly at.
    fn number(&self, end: f64, value: f64, up: bool) -> String {
        let (size, unit) = match *self.ty {
            Ty::Angle => (180.0 / std::f64::consts::PI, "deg"),
            _ => (1.0, ""),
        };
        if end == value && *self.ty != Ty::Angle {
            return format!("{value}");
        }
        // What is rounded inwards may leave the value out, and outwards the range there is.
        format!("{}{unit}", number(end * size, up))
    }

    fn within(&self, scene: &Scene, range: &Range) -> Option<Way> {
        let same =
            |(r, p): (&(f64, f64), &Param)| p.range.is_some_and(|had| (had.lo, had.hi) == *r);
        if range.iter().zip(&self.parts).all(same) {
            return None;
        }
        let (edit, text) = self.edit(range)?;
        let name = self.name();
        let cause = match &self.written.range {
            None => format!("`{name}` has no range"),
            Some((low, high)) => format!(
                "`{name}` may be {} .. {}",
                self.text_of(low.span),
                self.text_of(high.span)
            ),
        };
        let edits = vec![edit];
        Some(Way {
            kind: Kind::Range,
            cause,
            said: format!("`{text}`{}", self.within),
            change: text,
            scene: scene.edited(&edits)?,
            edits,
        })
    }
}
