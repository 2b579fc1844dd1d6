//! Lines of BASIC with labels for line numbers.

mod away;
mod edit;
mod label;
#[cfg(test)]
pub mod texts;

pub use label::{Label, Labels, MARK};

use crate::source::Span;

#[derive(Clone, Debug)]
enum Item {
    /// Statements, to which more may be joined while `open`.
    Line {
        text: String,
        span: Option<Span>,
        /// Where its later statements come from: from which on, counted from 0.
        later: Later,
        open: bool,
        /// About how often it is carried out.
        weight: u64,
    },
    Label(Label),
}

type Later = Vec<(usize, Option<Span>)>;

/// How many statements a line has: colons part them, those in strings do not.
fn statements(text: &str) -> usize {
    let outside = text.split('"').step_by(2);
    1 + outside.map(|part| part.matches(':').count()).sum::<usize>()
}

/// Notes that what is about to be joined to a line, with its own later statements,
/// comes from a place.
fn note(later: &mut Later, line: &str, first: Option<Span>, joined: &Later) {
    let before = statements(line);
    later.push((before, first));
    later.extend(joined.iter().map(|(at, span)| (before + at, *span)));
}

/// Statements are joined to a line up to this length: few lines are quick to search and save
/// memory, short ones read well.
const WIDTH: usize = 66;

/// A program or a part of one.
#[derive(Clone, Debug)]
pub struct Lines {
    items: Vec<Item>,
    /// About how often what is written next is carried out.
    pub weight: u64,
}

impl Default for Lines {
    fn default() -> Self {
        Lines {
            items: Vec::new(),
            weight: 1,
        }
    }
}

impl Lines {
    /// No lines yet, of what is carried out so often.
    pub fn of_weight(weight: u64) -> Lines {
        Lines {
            weight,
            ..Lines::default()
        }
    }

    /// A statement that others may stand beside.
    pub fn statement(&mut self, text: impl Into<String>, span: Option<Span>) {
        self.statements(text.into(), span, Later::new());
    }

    fn statements(&mut self, text: String, span: Option<Span>, own: Later) {
        if let Some(Item::Line {
            text: line,
            open: true,
            weight,
            later,
            ..
        }) = self.items.last_mut()
            && *weight == self.weight
            && line.len() + 1 + text.len() <= WIDTH
        {
            note(later, line, span, &own);
            line.push(':');
            line.push_str(&text);
            return;
        }
        self.items.push(Item::Line {
            text,
            span,
            later: own,
            open: true,
            weight: self.weight,
        });
    }

    /// A line of its own: nothing is joined to it.
    pub fn line(&mut self, text: impl Into<String>, span: Option<Span>) {
        self.items.push(Item::Line {
            text: text.into(),
            span,
            later: Later::new(),
            open: false,
            weight: self.weight,
        });
    }

    /// The next line gets this label.
    pub fn place(&mut self, label: Label) {
        self.items.push(Item::Label(label));
    }

    pub fn append(&mut self, mut other: Lines) {
        if let (
            Some(Item::Line { open: last, .. }),
            Some(Item::Line {
                text,
                span,
                later,
                open: true,
                weight,
            }),
        ) = (self.items.last(), other.items.first())
            && *last
        {
            let (text, span, later) = (text.clone(), *span, later.clone());
            let outer = std::mem::replace(&mut self.weight, *weight);
            other.items.remove(0);
            self.statements(text, span, later);
            self.weight = outer;
        }
        self.items.append(&mut other.items);
    }

    /// All of it as one line's worth of statements, if it is only that.
    pub fn in_one_line(&self) -> Option<String> {
        let mut all = String::new();
        for item in &self.items {
            let Item::Line {
                text, open: true, ..
            } = item
            else {
                return None;
            };
            if !all.is_empty() {
                all.push(':');
            }
            all.push_str(text);
        }
        Some(all)
    }

    /// With a remark before the lines of each item of the scene, as `name`
    /// tells them; what a GOTO goes to stays.
    pub fn remarked(self, name: impl Fn(Span) -> Option<String>) -> Lines {
        let mut all = Lines::of_weight(self.weight);
        let mut last = None;
        for item in self.items {
            if let Item::Line {
                span: Some(span), ..
            } = &item
            {
                let now = name(*span);
                if now != last
                    && let Some(text) = &now
                {
                    let labels = all.items.iter().rev();
                    let labels = labels.take_while(|i| matches!(i, Item::Label(_))).count();
                    let behind = all.items.split_off(all.items.len() - labels);
                    all.line(format!("REM {text}"), Some(*span));
                    all.items.extend(behind);
                }
                last = now;
            }
            all.items.push(item);
        }
        all
    }

    /// Every line's text.
    pub fn texts(&self) -> impl Iterator<Item = &str> {
        self.items.iter().filter_map(|item| match item {
            Item::Line { text, .. } => Some(text.as_str()),
            Item::Label(_) => None,
        })
    }

    /// Where in the scene every line comes from.
    pub fn spans(&self) -> Vec<Option<Span>> {
        let lines = self.items.iter().filter_map(|item| match item {
            Item::Line { span, .. } => Some(*span),
            Item::Label(_) => None,
        });
        lines.collect()
    }

    /// The lines with others before a label, or as near behind it as control does not go
    /// on to them from those before.
    pub fn with_before(mut self, label: Label, block: Lines) -> Lines {
        let at = self
            .items
            .iter()
            .position(|item| matches!(item, Item::Label(of) if *of == label));
        // What is named there by other labels is the same line.
        let from = away::first_label(&self.items, at.unwrap_or(self.items.len()));
        let parts = |at: &usize| !away::goes_on(self.items.get(..*at).unwrap_or(&[]));
        let near = (from..self.items.len()).find(parts);
        let mut rest = self.items.split_off(near.unwrap_or(from));
        if away::goes_on(&self.items) {
            self.items.push(away::jump(label));
        }
        self.items.extend(block.items);
        self.items.append(&mut rest);
        self
    }

    /// Every line's text, and about how often it is carried out.
    pub fn weighted(&self) -> impl Iterator<Item = (&str, u64)> {
        self.items.iter().filter_map(|item| match item {
            Item::Line { text, weight, .. } => Some((text.as_str(), *weight)),
            Item::Label(_) => None,
        })
    }

    /// Every label, and the number of the line that it stands before.
    pub fn labelled(&self) -> impl Iterator<Item = (Label, usize)> {
        let mut at = 0;
        self.items.iter().filter_map(move |item| match item {
            Item::Line { .. } => {
                at += 1;
                None
            }
            Item::Label(label) => Some((*label, at)),
        })
    }

    /// Where lines' later statements come from: the line and the statement from which
    /// on, both counted from 0.
    pub fn later(&self) -> Vec<(usize, usize, Option<Span>)> {
        let lines = self.items.iter().filter_map(|item| match item {
            Item::Line { later, .. } => Some(later),
            Item::Label(_) => None,
        });
        let each = lines.enumerate();
        each.flat_map(|(line, later)| later.iter().map(move |(at, span)| (line, *at, *span)))
            .collect()
    }

    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// Numbers the lines in tens, or in ones where tens do not suffice.
    pub fn finish(self) -> (String, Vec<Option<Span>>) {
        let is_line = |i: &Item| matches!(i, Item::Line { .. });
        let count = self.items.iter().filter(|i| is_line(i)).count();
        let step = if count <= 3000 { 10 } else { 1 };
        let mut numbers: Vec<(u32, usize)> = Vec::new();
        let mut next = step;
        for item in &self.items {
            match item {
                Item::Line { .. } => next += step,
                Item::Label(Label(n)) => numbers.push((*n, next)),
            }
        }
        let number_of = |n: &str| {
            let n: u32 = n.parse().unwrap_or(0);
            let found = numbers.iter().find(|(label, _)| *label == n);
            found.map_or(0, |(_, number)| *number).to_string()
        };
        let mut text = String::new();
        let mut spans = Vec::new();
        let mut number = step;
        for item in &self.items {
            if let Item::Line {
                text: line, span, ..
            } = item
            {
                text.push_str(&number.to_string());
                for (i, piece) in line.split(MARK).enumerate() {
                    if i % 2 == 0 {
                        text.push_str(piece);
                    } else {
                        text.push_str(&number_of(piece));
                    }
                }
                text.push('\n');
                spans.push(*span);
                number += step;
            }
        }
        (text, spans)
    }
}

/// What stands before the label that a line jumps to at its end, and that label.
pub fn jump(text: &str) -> Option<(&str, Label)> {
    let (before, label) = Label::last_of(text)?;
    (before.ends_with("GOTO ") || before.ends_with("THEN ")).then_some((before, label))
}
