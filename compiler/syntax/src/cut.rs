//! Cuts the tokens of a file into items, so that one error costs one item.
//!
//! An item begins at an item word with what such an item begins with behind it
//! (`fn` and a name, `image` and a number), at any depth of brackets: no
//! expression holds that, so a forgotten bracket cannot swallow the rest of the
//! file. It ends at a top-level `;`, or at the `}` of a shape, scene or record.
//!
//! Two checks run over an item's tokens before it is parsed: its brackets pair
//! up, and the tree that it will make is not too deep. The parser and everything
//! behind it may then recurse without counting.

use super::token::Token;
use crate::source::{Diagnostic, Span};

/// How deep a tree may be: brackets, `if`s, calls and operators in a row count
/// one level each.
pub const MAX_DEPTH: usize = 256;

/// A token with its place.
pub type Spanned<'a> = (Token<'a>, Span);

/// The tokens of the file, one slice an item. What stands between items comes
/// as a slice that does not begin with an item word.
pub fn items<'t, 'a>(tokens: &'t [Spanned<'a>]) -> Vec<&'t [Spanned<'a>]> {
    let mut cuts = Vec::new();
    let mut start = 0;
    let mut depth = 0usize;
    let mut push = |from: usize, to: usize| {
        if let Some(slice) = tokens.get(from..to).filter(|s| !s.is_empty()) {
            cuts.push(slice);
        }
    };
    for (at, (token, _)) in tokens.iter().enumerate() {
        let next = tokens.get(at + 1).map(|t| t.0);
        match token {
            Token::Item(word) if begins_item(word, next) || stands_first(tokens, at, depth) => {
                push(start, at);
                start = at;
                depth = 0;
            }
            Token::Sym("(" | "[" | "{") => depth += 1,
            Token::Sym(")" | "]" | "}") => {
                depth = depth.saturating_sub(1);
                if depth == 0 && *token == Token::Sym("}") && ends_with_brace(tokens.get(start)) {
                    push(start, at + 1);
                    start = at + 1;
                }
            }
            Token::Sym(";") if depth == 0 => {
                push(start, at + 1);
                start = at + 1;
            }
            _ => {}
        }
    }
    push(start, tokens.len());
    cuts
}

/// Whether `next` is what stands behind `word` at the start of an item.
fn begins_item(word: &str, next: Option<Token>) -> bool {
    match next {
        Some(Token::Ident(_)) => !matches!(word, "image" | "draw" | "use"),
        Some(Token::Int(_) | Token::Real(_)) => word == "image",
        Some(Token::Sym("(")) => word == "draw",
        Some(Token::Text(_)) => word == "use",
        _ => false,
    }
}

/// Whether the item word at `at` stands at the top, behind the end of an item:
/// an item then, though not a right one.
fn stands_first(tokens: &[Spanned], at: usize, depth: usize) -> bool {
    let before = at.checked_sub(1).and_then(|before| tokens.get(before));
    depth == 0 && matches!(before, None | Some((Token::Sym(";" | "}"), _)))
}

/// Whether an item that begins so ends at its closing brace.
fn ends_with_brace(first: Option<&Spanned>) -> bool {
    matches!(first, Some((Token::Item("shape" | "scene" | "record"), _)))
}

/// The first bracket without its partner, reported.
pub fn unpaired(tokens: &[Spanned]) -> Option<Diagnostic> {
    let mut open: Vec<(&str, Span)> = Vec::new();
    for (token, span) in tokens {
        let Token::Sym(sign) = token else { continue };
        match *sign {
            "(" | "[" | "{" => open.push((sign, *span)),
            ")" | "]" | "}" => match open.pop() {
                None => {
                    return Some(
                        Diagnostic::error(
                            *span,
                            format!("nothing is open that `{sign}` could close"),
                        )
                        .label("no partner"),
                    );
                }
                Some((opener, at)) if partner(opener) != *sign => {
                    let wanted = partner(opener);
                    return Some(
                        Diagnostic::error(
                            *span,
                            format!("`{sign}` stands where `{wanted}` has to close `{opener}`"),
                        )
                        .also(at, format!("this `{opener}` is still open"))
                        .help(format!("close it with `{wanted}` first")),
                    );
                }
                Some(_) => {}
            },
            _ => {}
        }
    }
    let (opener, at) = open.pop()?;
    let wanted = partner(opener);
    Some(
        Diagnostic::error(at, format!("this `{opener}` is never closed"))
            .label("open")
            .help(format!("its `{wanted}` is missing before the next item")),
    )
}

fn partner(opener: &str) -> &'static str {
    match opener {
        "(" => ")",
        "[" => "]",
        _ => "}",
    }
}

/// One bracket, `if` or `loop` that is open while the depth is measured.
#[derive(Default)]
struct Level {
    /// For an `if` or `loop`: whether its `else` was seen.
    branch: Option<bool>,
    /// For an `each`: where it stands, and whether what it repeats has begun.
    each: Option<(Each, bool)>,
    /// The deepest of the parts that are complete.
    deepest: usize,
    /// The deepest level inside the part that is being read.
    inside: usize,
    /// Operators of the part that is being read: each may add a level.
    operators: usize,
}

/// Where an `each` stands.
#[derive(Clone, Copy, PartialEq)]
enum Each {
    /// Among a scene's members.
    Member,
    /// Behind a function's name.
    Operand,
}

impl Level {
    /// A bound on the levels above the leaves of what this level has read.
    fn depth(&self) -> usize {
        self.deepest.max(self.inside + self.operators)
    }

    /// What was read is complete; what follows stands beside it.
    fn part(&mut self) {
        self.deepest = self.depth();
        self.inside = 0;
        self.operators = 0;
    }
}

/// Reports where the tree of these tokens would be deeper than [`MAX_DEPTH`].
///
/// The bound is never less than the depth of the tree, whatever the tokens:
/// operators of one part count even where they would stand beside each other.
pub fn too_deep(tokens: &[Spanned]) -> Option<Diagnostic> {
    let mut levels = vec![Level::default()];
    let mut before = None;
    for (token, span) in tokens {
        step(&mut levels, *token, before);
        before = Some(*token);
        let innermost = levels.last().map_or(0, Level::depth);
        if levels.len() > MAX_DEPTH || innermost >= MAX_DEPTH {
            return Some(deeper(*span));
        }
    }
    // What was left open counts as if it were closed here.
    while levels.len() > 1 {
        close(&mut levels);
    }
    let whole = levels.last().map_or(0, Level::depth);
    let (_, end) = tokens.last()?;
    (whole >= MAX_DEPTH).then(|| deeper(*end))
}

fn deeper(span: Span) -> Diagnostic {
    Diagnostic::error(span, format!("this nests deeper than {MAX_DEPTH} levels"))
        .label("brackets, `if`s, calls and operators in a row count one each")
        .help("give parts of it names: `let part = ...;`")
}

fn step(levels: &mut Vec<Level>, token: Token, before: Option<Token>) {
    match token {
        Token::Sym(sign @ ("(" | "[" | "{")) => {
            if sign == "{" && ends_operand(before) {
                repeated(levels);
            }
            // What is called or indexed again stands a level deeper each time.
            if let Some(Token::Sym(")" | "]" | "}")) = before {
                operator(levels);
            }
            levels.push(Level::default());
        }
        Token::Sym(")" | "]" | "}") => {
            close_branches(levels);
            close(levels);
            end_each(levels);
        }
        Token::Word("if" | "loop") => levels.push(Level {
            branch: Some(false),
            ..Level::default()
        }),
        Token::Word("each") => levels.push(Level {
            branch: Some(true),
            each: Some(match before {
                Some(Token::Sym("{" | "}" | ";")) => (Each::Member, false),
                _ => (Each::Operand, false),
            }),
            ..Level::default()
        }),
        Token::Word("else") => {
            while levels.last().is_some_and(|l| l.branch == Some(true)) {
                close(levels);
            }
            if let Some(level) = levels.last_mut() {
                level.part();
                level.branch = level.branch.map(|_| true);
            }
        }
        Token::Sym("," | ";") => {
            close_branches(levels);
            part(levels);
        }
        Token::Word("then" | "is" | "in" | "where") | Token::Sym("=" | ":" | "=>" | "..") => {
            part(levels);
        }
        Token::Word("and" | "or" | "not" | "div" | "mod") | Token::Sym(_) => operator(levels),
        _ => {}
    }
}

/// Whether an operand may end with a token; a block begins behind none such.
fn ends_operand(token: Option<Token>) -> bool {
    match token {
        Some(Token::Ident(_) | Token::Int(_) | Token::Real(_) | Token::Angle(_)) => true,
        Some(Token::Sym(sign)) => matches!(sign, ")" | "]" | "}"),
        Some(Token::Word(word)) => matches!(word, "true" | "false" | "none"),
        _ => false,
    }
}

/// What an `each` repeats begins, if the innermost level but ended branches is one's.
fn repeated(levels: &mut Vec<Level>) {
    let ended = |level: &&Level| level.branch == Some(true) && level.each.is_none();
    let above = levels.iter().rev().take_while(ended).count();
    let at = levels.len().checked_sub(above + 1);
    let innermost = at.and_then(|at| levels.get(at));
    if innermost.is_none_or(|level| level.each.is_none()) {
        return;
    }
    for _ in 0..above {
        close(levels);
    }
    if let Some(Level {
        each: Some((_, begun)),
        ..
    }) = levels.last_mut()
    {
        *begun = true;
    }
}

/// Ends an `each` with what it repeats; a member of a scene stands beside the others.
fn end_each(levels: &mut Vec<Level>) {
    if let Some(Level {
        each: Some((of, true)),
        ..
    }) = levels.last()
    {
        let is_member = *of == Each::Member;
        close(levels);
        if is_member {
            part(levels);
        }
    }
}

fn operator(levels: &mut [Level]) {
    if let Some(level) = levels.last_mut() {
        level.operators += 1;
    }
}

fn part(levels: &mut [Level]) {
    if let Some(level) = levels.last_mut() {
        level.part();
    }
}

/// Ends the `if`s and `loop`s that reach up to here.
fn close_branches(levels: &mut Vec<Level>) {
    while levels.last().is_some_and(|l| l.branch.is_some()) {
        close(levels);
    }
}

/// Ends the innermost level; its depth counts in the one around it.
fn close(levels: &mut Vec<Level>) {
    if levels.len() < 2 {
        return part(levels);
    }
    if let Some(inner) = levels.pop()
        && let Some(outer) = levels.last_mut()
    {
        outer.inside = outer.inside.max(inner.depth() + 1);
    }
}
