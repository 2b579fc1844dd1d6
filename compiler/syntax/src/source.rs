//! Places in source text, and what is said about them.
//!
//! The compiler never prints: it returns [`Diagnostic`]s, plain data that the
//! command line renders. A file is known by its number in a [`Sources`].

/// A byte range in one source file.
///
/// What the library computes for a scene belongs to the scene's place that calls
/// it; [`Span::within`] says where in the library that is. That and the effect are
/// remarks and no part of the place: spans are compared without them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Span {
    /// Index into [`Sources::files`].
    pub file: u16,
    /// First byte.
    pub start: u32,
    /// One past the last byte; at least `start`.
    pub end: u32,
    /// File and first byte of the library's own place, where it is the library's.
    pub within: Option<(u16, u32)>,
    /// The effect on whose behalf it is computed, the innermost: by its number among the
    /// scene's functions. A remark, too.
    pub effect: Option<u16>,
}

impl Span {
    fn place(self) -> (u16, u32, u32) {
        (self.file, self.start, self.end)
    }
}

impl PartialEq for Span {
    fn eq(&self, other: &Span) -> bool {
        self.place() == other.place()
    }
}

impl Eq for Span {}

impl std::hash::Hash for Span {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.place().hash(state);
    }
}

impl PartialOrd for Span {
    fn partial_cmp(&self, other: &Span) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Span {
    fn cmp(&self, other: &Span) -> std::cmp::Ordering {
        self.place().cmp(&other.place())
    }
}

impl Span {
    /// The range `start..end` of file `file`.
    pub fn new(file: u16, start: usize, end: usize) -> Self {
        let clip = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
        Span {
            file,
            start: clip(start),
            end: clip(end.max(start)),
            within: None,
            effect: None,
        }
    }

    /// This place, where the library's `own` place is called from.
    pub fn calling(self, own: Span) -> Span {
        Span {
            within: Some((own.file, own.start)),
            ..self
        }
    }

    /// The library's own place, where this is a call of it; empty there.
    pub fn called(self) -> Option<Span> {
        let (file, start) = self.within?;
        Some(Span::new(file, start as usize, start as usize))
    }

    /// The smallest range that holds both; `self` where they lie in different files.
    pub fn to(self, other: Span) -> Span {
        if self.file != other.file {
            return self;
        }
        Span {
            file: self.file,
            start: self.start.min(other.start),
            end: self.end.max(other.end),
            within: self.within,
            effect: self.effect,
        }
    }

    /// The range as bytes of its file.
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// One source text and what to call it in messages.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// A path or title, as the user knows it.
    pub name: String,
    /// The whole text.
    pub text: String,
    /// Whether it belongs to the library (the prelude) rather than to the user.
    pub library: bool,
}

/// All the texts of one compilation, library files included.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sources {
    /// The texts, in the order in which they were added.
    pub files: Vec<SourceFile>,
}

impl Sources {
    /// Adds a text; answers its number.
    pub fn add(&mut self, file: SourceFile) -> u16 {
        self.files.push(file);
        u16::try_from(self.files.len() - 1).unwrap_or(u16::MAX)
    }

    /// The text under a span, empty where the span does not fit its file.
    pub fn text(&self, span: Span) -> &str {
        self.files
            .get(span.file as usize)
            .and_then(|f| f.text.get(span.range()))
            .unwrap_or("")
    }

    /// Line and column, both from 1, of a span's start; columns count characters.
    pub fn line_column(&self, span: Span) -> (usize, usize) {
        let text = self
            .files
            .get(span.file as usize)
            .map_or("", |f| f.text.as_str());
        let before = text.get(..span.start as usize).unwrap_or(text);
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().map_or(0, |l| l.chars().count()) + 1;
        (line, column)
    }
}

/// How grave a diagnostic is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The scene compiles, but something may surprise.
    Warning,
    /// The scene does not compile.
    Error,
}

/// A second place that explains a diagnostic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// Where.
    pub span: Span,
    /// What is to be seen there.
    pub text: String,
}

/// Something said about a place in a scene: the place, the reason and a way out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Error or warning.
    pub severity: Severity,
    /// The reason, in one sentence without a full stop.
    pub message: String,
    /// The place.
    pub span: Span,
    /// What to write under the place; may be empty.
    pub label: String,
    /// Further places.
    pub others: Vec<Label>,
    /// A way out, if one is known.
    pub help: Option<String>,
}

impl Diagnostic {
    /// An error with its place.
    pub fn error(span: Span, message: impl Into<String>) -> Self {
        Diagnostic {
            severity: Severity::Error,
            message: message.into(),
            span,
            label: String::new(),
            others: Vec::new(),
            help: None,
        }
    }

    /// A warning with its place.
    pub fn warning(span: Span, message: impl Into<String>) -> Self {
        Diagnostic {
            severity: Severity::Warning,
            ..Self::error(span, message)
        }
    }

    /// Adds what to write under the place.
    pub fn label(mut self, text: impl Into<String>) -> Self {
        self.label = text.into();
        self
    }

    /// Adds a second place.
    pub fn also(mut self, span: Span, text: impl Into<String>) -> Self {
        self.others.push(Label {
            span,
            text: text.into(),
        });
        self
    }

    /// Adds a way out.
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = Some(text.into());
        self
    }

    /// Whether it stops the compilation.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}
