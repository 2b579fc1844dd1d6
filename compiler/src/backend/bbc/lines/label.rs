//! Labels for line numbers that are not known yet.

/// What a GOTO names before lines have numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Label(pub(super) u32);

impl Label {
    /// The label that a text ends with, and what stands before it.
    pub fn last_of(text: &str) -> Option<(&str, Label)> {
        let (before, number) = text.strip_suffix(MARK)?.rsplit_once(MARK)?;
        Some((before, Label(number.parse().ok()?)))
    }

    /// Every label in a text.
    pub fn all_of(text: &str) -> impl Iterator<Item = Label> {
        let ends = text.match_indices(MARK).skip(1).step_by(2);
        ends.filter_map(|(at, _)| Some(Label::last_of(text.get(..=at)?)?.1))
    }
}

/// Encloses a label's number in a line's text.
pub const MARK: char = '\u{1}';

impl std::fmt::Display for Label {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{MARK}{}{MARK}", self.0)
    }
}

/// Makes labels, each once.
#[derive(Clone, Default)]
pub struct Labels(u32);

impl Labels {
    pub fn next(&mut self) -> Label {
        self.0 += 1;
        Label(self.0)
    }
}
