//! Why a command did not do what was asked, and the exit status for it.

use slowlight_compiler::source::{Diagnostic, Sources};

/// Texts and what was said about them.
#[derive(Debug)]
pub struct Said {
    /// The texts.
    pub sources: Sources,
    /// What was said.
    pub diagnostics: Vec<Diagnostic>,
}

/// A program that its machine does not hold.
#[derive(Debug)]
pub struct TooLarge {
    /// By how much in each mode, and what would help.
    pub text: String,
    /// By how much in that mode where it is least.
    pub least: String,
}

/// Why a command stopped.
#[derive(Debug)]
pub enum Failure {
    /// The scene is wrong; the diagnostics say where.
    Scene(Box<Said>),
    /// A file, a generated program or its machine is wrong.
    Wrong(String),
    /// The program of a scene is too large.
    TooLarge(Box<TooLarge>),
    /// What was asked for does not exist or does not fit together.
    Usage(String),
    /// Options that do not fit the scene; the diagnostics say which.
    Options(Box<Said>),
    /// The machine's picture is not the model's, or a snapshot changed. Already reported.
    Differs,
    /// A hard case does not pass. Already reported.
    Cases,
    /// Some of several works failed, the first with this status. Already reported.
    Several(u8),
    /// Somebody pressed Ctrl-C.
    Interrupted,
}

/// What a command comes to.
pub type Outcome<T> = Result<T, Failure>;

impl Failure {
    /// The exit status: 1 the scene or program is wrong, 2 wrong usage, 3 the
    /// machine differs from the model or a snapshot changed, 130 interrupted (128 + SIGINT, as shells have it).
    pub fn status(&self) -> u8 {
        match self {
            Failure::Scene(_) | Failure::Wrong(_) | Failure::TooLarge(_) | Failure::Cases => 1,
            Failure::Usage(_) | Failure::Options(_) => 2,
            Failure::Differs => 3,
            Failure::Several(status) => *status,
            Failure::Interrupted => 130,
        }
    }

    /// It in one line, for a table.
    pub fn reason(&self) -> String {
        match self {
            Failure::Scene(said) | Failure::Options(said) => {
                let first = said.diagnostics.iter().find(|d| d.is_error());
                first.map_or("the scene is wrong".to_owned(), |d| d.message.clone())
            }
            Failure::Wrong(message) | Failure::Usage(message) => two_lines(message),
            Failure::TooLarge(large) => two_lines(&large.text),
            Failure::Differs | Failure::Cases | Failure::Several(_) => "failed".to_owned(),
            Failure::Interrupted => "interrupted".to_owned(),
        }
    }
}

/// What was wrong, and the first of the facts under it.
fn two_lines(message: &str) -> String {
    let lines = message.lines().map(str::trim).take(2);
    lines.collect::<Vec<&str>>().join(" ")
}

/// The name nearest to a misspelt one, where one is near enough to be meant.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // `c64` is a part of `6502:c64`.
    let like = |k: &str| match k.split(':').any(|part| part == name) {
        true => 1.0,
        false => strsim::normalized_damerau_levenshtein(name, k),
    };
    known
        .into_iter()
        .map(|k| (like(k), k))
        .filter(|(like, _)| *like >= 0.5)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, k)| k)
}

/// `no param `eya`; did you mean `eye`?`, or the list of what there is.
pub fn unknown<'a>(
    what: &str,
    name: &str,
    known: impl IntoIterator<Item = &'a str> + Clone,
) -> String {
    if let Some(near) = nearest(name, known.clone()) {
        return format!("no {what} `{name}`; did you mean `{near}`?");
    }
    let all: Vec<&str> = known.into_iter().collect();
    if all.is_empty() {
        format!("no {what} `{name}`; there is none")
    } else {
        format!("no {what} `{name}`; there is {}", all.join(", "))
    }
}

/// A system error without its number.
pub fn plain(e: &std::io::Error) -> String {
    let text = e.to_string();
    match text.find(" (os error") {
        Some(at) => text[..at].to_owned(),
        None => text,
    }
}
