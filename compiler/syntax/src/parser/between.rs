//! What stands where an item should begin.

use crate::cut::Spanned;
use crate::source::Diagnostic;
use crate::token::Token;

/// The words that begin items.
const ITEMS: [&str; 13] = [
    "image", "param", "state", "const", "fn", "effect", "shape", "scene", "record", "map",
    "dither", "draw", "use",
];

/// Reports what stands where an item should begin; nothing where the lexer has spoken.
pub fn not_an_item(tokens: &[Spanned]) -> Option<Diagnostic> {
    let (token, span) = tokens.first()?;
    let here = |message: String| Diagnostic::error(*span, message);
    Some(match token {
        Token::Bad => return None,
        Token::Sym(";") => here("this `;` ends nothing".into())
            .help("remove it: shapes, scenes and records end with their `}`"),
        Token::Sym(sign @ (")" | "]" | "}")) => {
            here(format!("nothing is open that `{sign}` could close")).help("remove it")
        }
        Token::Word("let") => here("`let` stands inside blocks".into())
            .help("at the top of a file write `const name = ...;`"),
        Token::Word("each") => here("`each` stands inside scenes".into())
            .help("write `scene world { each k in 0 .. 9 { sphere((k, 0, 0), 1) is k; } }`"),
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
