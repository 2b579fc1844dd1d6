//! What the rules say of a wrong item, in the user's words: the place, at most
//! three expectations, and a way out where one can be guessed.

use super::Raw;
use crate::source::{Diagnostic, Span};
use crate::syntax::cut::Spanned;
use crate::syntax::token::Token;
use chumsky::error::RichPattern;

/// The words that begin items.
const ITEMS: [&str; 12] = [
    "image", "param", "const", "fn", "effect", "shape", "scene", "record", "map", "dither", "draw",
    "use",
];

/// Where a rule failed.
struct Spot<'t> {
    text: &'t str,
    tokens: &'t [Spanned<'t>],
    /// Index of the token found; the length where the item ends instead.
    at: usize,
    /// What could have stood there: `` `;` ``, `an expression`.
    expected: Vec<String>,
}

/// The errors of one item, in the user's words.
///
/// At most one for each stretch between two `;`: behind an error the rules skip
/// to the next one, and what they say before it is a consequence.
pub fn translate<'t>(
    errors: &[Raw<'t>],
    text: &'t str,
    tokens: &'t [Spanned<'t>],
) -> Vec<Diagnostic> {
    let mut said = Vec::new();
    let mut last: Option<usize> = None;
    for error in errors {
        let at = tokens.partition_point(|(_, span)| span.start < error.span().start);
        let apart = last.is_none_or(|last| {
            let between = tokens.get(last..at).unwrap_or(&[]);
            between.iter().any(|(token, _)| *token == Token::Sym(";"))
        });
        if !apart {
            continue;
        }
        last = Some(at);
        let spot = Spot {
            text,
            tokens,
            at,
            expected: expectations(error),
        };
        // What the lexer could not read, it has reported.
        if spot.found() != Some(Token::Bad) && spot.before() != Some(Token::Bad) {
            said.push(spot.say());
        }
    }
    said
}

/// What could have stood there, the likeliest first.
fn expectations(error: &Raw) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for pattern in error.expected() {
        let words = match pattern {
            RichPattern::Token(token) => format!("`{}`", token.parts().1),
            RichPattern::Label(label) => label.to_string(),
            RichPattern::Identifier(word) => format!("`{word}`"),
            RichPattern::EndOfInput => "the end of the item".into(),
            _ => continue,
        };
        if !all.contains(&words) {
            all.push(words);
        }
    }
    all.sort_by_key(|words| match words.as_str() {
        "an operator" => 3,
        "`,`" => 2,
        "the end of the item" => 4,
        words => usize::from(!words.starts_with('`')),
    });
    all
}

impl<'t> Spot<'t> {
    fn token(&self, at: Option<usize>) -> Option<Token<'t>> {
        self.tokens.get(at?).map(|t| t.0)
    }
    fn found(&self) -> Option<Token<'t>> {
        self.token(Some(self.at))
    }
    /// The token `back` places before the one found.
    fn behind(&self, back: usize) -> Option<Token<'t>> {
        self.token(self.at.checked_sub(back))
    }
    fn before(&self) -> Option<Token<'t>> {
        self.behind(1)
    }
    fn expects(&self, words: &str) -> bool {
        self.expected.iter().any(|e| e == words)
    }

    /// The token found, or the end of the item.
    fn place(&self) -> Span {
        match self.tokens.get(self.at) {
            Some((_, span)) => *span,
            None => self.gap(),
        }
    }

    /// Directly behind the token before.
    fn gap(&self) -> Span {
        let before = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        before.map_or(Span::default(), |(_, span)| Span {
            start: span.end,
            ..*span
        })
    }

    /// Whether the token found begins a line.
    fn on_new_line(&self) -> bool {
        let between = self.gap().end as usize..self.place().start as usize;
        self.text.get(between).is_some_and(|t| t.contains('\n'))
    }

    /// The word that the item begins with.
    fn item(&self) -> &'t str {
        match self.tokens.first() {
            Some((Token::Item(word), _)) => word,
            _ => "",
        }
    }

    fn say(&self) -> Diagnostic {
        self.missing()
            .or_else(|| self.mistaken())
            .unwrap_or_else(|| self.plain())
    }

    /// `expected a, b or c, found d`.
    fn plain(&self) -> Diagnostic {
        let found = match self.found() {
            Some(token) => token.to_string(),
            None => "the end of the item".into(),
        };
        let shown: Vec<&str> = self.expected.iter().take(3).map(String::as_str).collect();
        let message = match shown.as_slice() {
            [] => format!("{found} cannot stand here"),
            [one] => format!("expected {one}, found {found}"),
            [first @ .., last] => format!("expected {} or {last}, found {found}", first.join(", ")),
        };
        let mut diagnostic = Diagnostic::error(self.place(), message);
        diagnostic.help = self.way_out();
        diagnostic
    }

    /// Something that was left out.
    fn missing(&self) -> Option<Diagnostic> {
        let gap = |what: &str| Diagnostic::error(self.gap(), format!("missing `{what}`"));
        if self.expects("`then`") && self.found() != Some(Token::Sym("=")) && !self.compares() {
            return Some(gap("then").help("an `if` reads `if condition then a else b`"));
        }
        if self.expects("`else`") {
            return Some(match self.item() {
                "effect" if self.at < 3 || self.found() == Some(Token::Sym("=")) => gap("else")
                    .help("an effect says what stands in its place when it is left out: `-> real else 0 = ...`"),
                _ => gap("else").help("every `if` and every `loop` has a value on both ways out"),
            });
        }
        let ended = match self.found() {
            None | Some(Token::Word("let" | "spread") | Token::Sym("}")) => true,
            Some(Token::Ident(_) | Token::Word(_)) => self.on_new_line(),
            Some(_) => false,
        };
        if self.expects("`;`") && ended {
            return Some(gap(";"));
        }
        None
    }

    fn compares(&self) -> bool {
        self.found().is_some_and(Token::is_comparison)
    }

    /// Something that stands where something else was meant.
    fn mistaken(&self) -> Option<Diagnostic> {
        let here = |message: String| Diagnostic::error(self.place(), message);
        match self.found()? {
            Token::Item(word) | Token::Word(word)
                if self.expects("a name") || self.expects("a colour") =>
            {
                Some(
                    here(format!("`{word}` is a word of the language, not a name"))
                        .help(format!("choose another name: `{word}_` or `the_{word}`")),
                )
            }
            Token::Sym("=") if !self.expects("`=`") => Some(self.equals()),
            Token::Sym(";") if self.expects("`}`") && self.item() != "map" => Some(
                here("the value at the end of a block has no `;`".into())
                    .help("remove the `;`, or name the value with `let` and end in an expression"),
            ),
            Token::Sym("}") if self.expects("an expression") => Some(
                here("a block ends in an expression: its value".into())
                    .help("write the value in front of the `}`, without a `;`"),
            ),
            Token::Text(_) if self.expects("an expression") => Some(
                here("a string is not a value".into())
                    .help("strings stand in a `map` and behind `use` only"),
            ),
            Token::Colour(_) if self.expects("an expression") => Some(
                here("a colour is not a value".into())
                    .help("name it behind `inks` of the image; its ink is `ink(0)`, `ink(1)`, ..."),
            ),
            Token::Sym(sign @ (")" | "]" | "," | ";"))
                if matches!(self.before(), Some(Token::Sym(","))) =>
            {
                Some(
                    here(format!(
                        "expected {} behind the `,`, found `{sign}`",
                        self.first()
                    ))
                    .help("remove the `,`"),
                )
            }
            _ => None,
        }
    }

    fn first(&self) -> &str {
        self.expected.first().map_or("something", String::as_str)
    }

    /// `=` where nothing is being named.
    fn equals(&self) -> Diagnostic {
        let place = self.place();
        let opens = matches!(self.behind(2), Some(Token::Sym("{" | ";")));
        match self.before() {
            Some(Token::Ident(name)) if opens => {
                Diagnostic::error(place, "a value gets its name by `let`, and keeps it")
                    .help(format!("write `let {name} = ...;`"))
            }
            _ => Diagnostic::error(place, "`=` names a value; it does not compare")
                .help("to compare write `==`"),
        }
    }

    /// A way out for what has no message of its own.
    fn way_out(&self) -> Option<String> {
        let help = match (self.before(), self.found()) {
            (Some(Token::Int(_) | Token::Real(_)), Some(Token::Ident(_) | Token::Sym("(")))
                if self.expects("an operator") =>
            {
                "multiplication is written `*`"
            }
            (_, Some(Token::Sym("("))) if self.expects("an operator") => {
                "only names can be called: `f(a)`, `a.f(b)`"
            }
            (_, Some(Token::Sym(":"))) if self.expects("an operator") => {
                "a type stands behind the name of a parameter, not in an expression"
            }
            (_, Some(Token::Sym("?"))) => "a choice is written `if condition then a else b`",
            (_, Some(Token::Sym("=>"))) => "`=>` stands in a `map` only",
            (Some(Token::Sym("[")), Some(Token::Sym("]"))) => "a table has at least one entry",
            (Some(Token::Sym("(")), Some(Token::Sym(")"))) => "a vector has two or three parts",
            (_, Some(Token::Sym("{"))) if self.expects("`max`") => {
                "a loop says how often it may run at most: `max 12`"
            }
            _ if self.expects("`->`") => "say what it gives: `-> real`",
            _ if self.expects("`:`")
                && matches!(
                    self.item(),
                    "fn" | "effect" | "dither" | "shape" | "param" | "record"
                ) =>
            {
                "a type stands behind the name: `a: real`"
            }
            _ if self.expects("`inks`") => "an image reads `image 320 x 240 inks black, white;`",
            _ if self.expects("`where`") => {
                "say what the characters mean: `where '#' => 1, '.' => 0`"
            }
            _ if self.expects("`to`") => "a spread reads `spread error to { (1, 0): 1/2 };`",
            _ => return None,
        };
        Some(help.into())
    }
}

/// What stands where an item should begin; nothing where the lexer has spoken.
pub fn not_an_item(tokens: &[Spanned]) -> Option<Diagnostic> {
    let (token, span) = tokens.first()?;
    let here = |message: String| Diagnostic::error(*span, message);
    Some(match token {
        Token::Bad => return None,
        Token::Sym(";") => {
            here("an item that ends in `}` has no `;` behind it".into()).help("remove the `;`")
        }
        Token::Sym(sign @ (")" | "]" | "}")) => {
            here(format!("nothing is open that `{sign}` could close")).help("remove it")
        }
        Token::Word("let") => here("`let` stands inside blocks".into())
            .help("at the top of a file write `const name = ...;`"),
        Token::Ident(word) => {
            let diagnostic = here(format!("expected an item, found {token}"));
            match meant(word) {
                Some(item) => diagnostic.help(format!("did you mean `{item}`?")),
                None => diagnostic.help(format!("items begin with {}", list())),
            }
        }
        _ => here(format!("expected an item, found {token}"))
            .help(format!("items begin with {}", list())),
    })
}

fn list() -> String {
    ITEMS.map(|word| format!("`{word}`")).join(", ")
}

/// The item word that a foreign or misspelt word stands for.
fn meant(word: &str) -> Option<&'static str> {
    match word {
        "function" | "func" | "fun" | "def" | "proc" => return Some("fn"),
        "struct" | "type" => return Some("record"),
        "import" | "include" | "require" => return Some("use"),
        "var" | "val" | "static" => return Some("const"),
        "parameter" | "uniform" => return Some("param"),
        _ => {}
    }
    let close = ITEMS.iter().filter(|item| item.len() > 2);
    let scored = close.map(|item| (distance(word, item), *item));
    let (score, item) = scored.min()?;
    (score <= 2 && score < item.len() - 1).then_some(item)
}

/// Letters to insert, remove or replace to make one word of the other.
fn distance(a: &str, b: &str) -> usize {
    if a.len() > 2 * b.len() + 2 {
        return usize::MAX;
    }
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.bytes().enumerate() {
        let mut corner = i;
        let mut left = i + 1;
        for (y, cell) in b.bytes().zip(row.iter_mut().skip(1)) {
            let up = *cell;
            left = (corner + usize::from(x != y)).min(up + 1).min(left + 1);
            corner = up;
            *cell = left;
        }
        if let Some(first) = row.first_mut() {
            *first = i + 1;
        }
    }
    row.last().copied().unwrap_or(usize::MAX)
}
