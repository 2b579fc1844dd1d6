//! Guesses at what was meant, from what was expected and the tokens around.
//! Where none is sure, the plain message stands alone.

use super::message::Spot;
use crate::source::Diagnostic;
use crate::token::Token;

impl Spot<'_> {
    /// Something that was left out.
    pub fn missing(&self) -> Option<Diagnostic> {
        let gap = |what: &str| Diagnostic::error(self.gap(), format!("missing `{what}`"));
        let found = self.found();
        let equals = found == Some(Token::Sym("="));
        if found == Some(Token::Ident("xor")) && self.expects("an operator") {
            let place = Diagnostic::error(self.place(), "`xor` is no operator of this language");
            return Some(place.help("two bools differ where `a != b`"));
        }
        if self.expects("`then`") && !equals && !self.compares() {
            return Some(gap("then").help("an `if` reads `if condition then a else b`"));
        }
        if self.expects("`else`") && self.item() == "effect" && (equals || self.in_head()) {
            return Some(gap("else").help(
                "an effect says what stands in its place when it is left out: `-> real else 0 = ...`",
            ));
        }
        if self.expects("`else`") && !equals && !self.compares() {
            return Some(
                gap("else").help("every `if` and every `loop` has a value on both ways out"),
            );
        }
        let ended = match found {
            None | Some(Token::Word("let" | "spread") | Token::Sym("}")) => true,
            Some(Token::Word("each")) => self.item() == "scene",
            Some(Token::Sym(_)) => false,
            Some(_) => self.on_new_line(),
        };
        let in_scene = self.item() == "scene" && self.holds(Token::Word("loop"));
        (self.expects("`;`") && ended).then(|| match in_scene {
            true => gap(";").help(
                "a `loop` makes a value, and no members: it stands in a function or in an \
                 argument; a scene names each of its shapes",
            ),
            false => gap(";"),
        })
    }

    fn compares(&self) -> bool {
        self.found().is_some_and(Token::is_comparison)
    }

    /// Something that stands where something else was meant.
    pub fn mistaken(&self) -> Option<Diagnostic> {
        let here = |message: String| Diagnostic::error(self.place(), message);
        let operand = self.expects("an expression");
        let operator = self.expects("an operator");
        match self.found()? {
            Token::Word("each")
                if matches!(self.ahead(), Some(Token::Ident(_))) && self.item() == "shape" =>
            {
                Some(here("`each` does not repeat facets".into()).help(
                    "inside a facet write `min each k in 0 .. 9 { length(p - (k, 0, 0)) - 1 }`",
                ))
            }
            Token::Item(word) | Token::Word(word)
                if self.expects("a name") || self.expects("a colour") =>
            {
                let message = format!("`{word}` is a word of the language, not a name");
                Some(here(message).help(format!("choose another name: `{word}_` or `the_{word}`")))
            }
            Token::Ident(name)
                if self.expects("`let`") && self.ahead() == Some(Token::Sym("=")) =>
            {
                Some(
                    here("a value gets its name by `let`, and keeps it".into())
                        .help(format!("write `let {name} = ...;`")),
                )
            }
            Token::Sym("=") if operator && !self.expects("`=`") => Some(self.equals()),
            Token::Sym(";") if operator && self.expects("`}`") => Some(
                here("the value at the end of a block has no `;`".into())
                    .help("remove the `;`, or name the value with `let` and end in an expression"),
            ),
            Token::Sym(";")
                if operand && self.item() == "scene" && self.before() == Some(Token::Sym("}")) =>
            {
                Some(here("an `each` ends with its `}`".into()).help("remove the `;`"))
            }
            Token::Sym("}")
                if operand
                    && self.item() != "scene"
                    && self.behind(2) != Some(Token::Ident("to")) =>
            {
                Some(
                    here("a block ends in an expression: its value".into())
                        .help("write the value in front of the `}`, without a `;`"),
                )
            }
            Token::Ident(word) if self.expects("`let`") && self.ahead_of_name() => {
                Some(here(format!("`{word}` does not begin a statement")).help(
                    "statements begin with `let`, `frame let`, `row let`, `column let` or `spread`",
                ))
            }
            Token::Text(_) if operand => Some(
                here("a string is not a value".into())
                    .help("strings stand in a `map` and behind `use` only"),
            ),
            Token::Char(_) if operand => Some(
                here("a character is not a value".into())
                    .help("characters stand behind `where` of a `map` only"),
            ),
            Token::Colour(_) if operand => Some(
                here("a colour is not a value".into())
                    .help("name it behind `inks` of the image; its ink is `ink(0)`, `ink(1)`, ..."),
            ),
            Token::Sym(sign @ (")" | "]" | "}" | ";")) => self.trailing(sign),
            _ => None,
        }
    }

    /// Whether another name or a `let` follows the token found.
    fn ahead_of_name(&self) -> bool {
        matches!(self.ahead(), Some(Token::Ident(_) | Token::Word("let")))
    }

    /// A separator with nothing behind it.
    fn trailing(&self, sign: &str) -> Option<Diagnostic> {
        let Some(Token::Sym(before @ ("," | ";"))) = self.before() else {
            return None;
        };
        let wanted = self.expected.first().map_or("something", String::as_str);
        let message = format!("expected {wanted} behind the `{before}`, found `{sign}`");
        Some(Diagnostic::error(self.place(), message).help(format!("remove the `{before}`")))
    }

    /// `=` where nothing is being named.
    fn equals(&self) -> Diagnostic {
        let place = self.place();
        match (self.behind(2), self.before()) {
            (Some(Token::Sym("(" | ",")), Some(Token::Ident(name))) => {
                Diagnostic::error(place, "`=` neither compares nor names an argument").help(
                    format!("write `{name}: ...` to name an argument, `==` to compare"),
                )
            }
            _ => Diagnostic::error(place, "`=` names a value; it does not compare")
                .help("to compare write `==`"),
        }
    }

    /// Whether the item has a token before the place.
    fn holds(&self, token: Token<'_>) -> bool {
        let before = self.tokens.get(..self.at).unwrap_or(&[]);
        before.iter().any(|(one, _)| *one == token)
    }

    /// Whether the place lies before the body of the item.
    fn in_head(&self) -> bool {
        let before = self.tokens.get(..self.at).unwrap_or(&[]);
        !before
            .iter()
            .any(|(token, _)| matches!(token, Token::Sym("=" | "{")))
    }

    /// A way out for what has no message of its own.
    pub fn way_out(&self) -> Option<String> {
        let operator = self.expects("an operator");
        let help = match (self.before(), self.found()) {
            _ if self.in_head() || matches!(self.item(), "record" | "map" | "image") => {
                return self.usage();
            }
            (Some(Token::Ident("for" | "foreach" | "repeat")), Some(Token::Ident(_)))
                if self.item() == "scene" =>
            {
                return self.each();
            }
            (_, Some(Token::Word("each"))) => return self.each(),
            _ if self.in_each() => return self.each(),
            (Some(Token::Int(_) | Token::Real(_)), Some(Token::Ident(_) | Token::Sym("(")))
                if operator =>
            {
                "multiplication is written `*`"
            }
            (_, Some(Token::Sym("("))) if operator => "only names can be called: `f(a)`, `a.f(b)`",
            (_, Some(Token::Sym(":"))) if operator => {
                "`:` stands behind the name of an argument or a parameter only"
            }
            (_, Some(Token::Sym(":"))) if self.behind(2) == Some(Token::Word("let")) => {
                "a `let` has the type of its value"
            }
            (_, Some(Token::Sym(","))) if self.item() == "scene" && self.expects("`;`") => {
                "each member of a scene ends with `;`"
            }
            _ if self.item() == "shape" && self.expects("`=`") => return self.usage(),
            (_, Some(Token::Word(word @ ("mod" | "div" | "and" | "or")))) if !operator => {
                return Some(format!("`{word}` stands between two values: `a {word} b`"));
            }
            (Some(Token::Ident("return")), _) => {
                "a block's value is its last expression; there is no `return`"
            }
            (Some(Token::Word("loop" | "next")), _) => {
                "a loop reads like `loop (i = 0) max 12 { next(i + 1) } else i`"
            }
            (Some(Token::Word("let")), Some(Token::Sym("("))) => {
                "a `let` names one value; take a vector apart by `.x`, `.y`, `.z`"
            }
            (_, Some(Token::Sym("?"))) => "a choice is written `if condition then a else b`",
            (_, Some(Token::Sym(".."))) => {
                "`..` stands between the ends of a `param`'s or a `state`'s range, or of an `each`'s, only"
            }
            (Some(Token::Sym("[")), Some(Token::Sym("]"))) => {
                "a table or an index has at least one value"
            }
            (Some(Token::Sym("(")), Some(Token::Sym(")"))) => match self.behind(2) {
                Some(Token::Word("next")) => {
                    "`next` gives a value for each name that its loop carries"
                }
                _ => "a vector has two or three parts",
            },
            (_, Some(Token::Sym("{"))) if self.expects("`max`") => {
                "a loop says how often it may run at most: `max 12`"
            }
            (_, Some(_)) if operator && self.expects("`{`") => {
                "the body of a loop stands in braces"
            }
            (_, Some(Token::Sym(")" | ","))) if self.expects("`=`") => {
                "what a loop carries has a start: `(i = 0)`"
            }
            _ if self.expects("`=`") && self.behind(3) == Some(Token::Word("if")) => {
                "this reads `if let name = value then a else b`"
            }
            (_, Some(Token::Item(word))) if self.expects("an expression") => {
                return Some(format!(
                    "`{word}` begins an item; items stand at the top of a file"
                ));
            }
            _ if self.expects("`..`") || self.item() == "state" && self.expects("`->`") => {
                return self.usage();
            }
            _ if self.expects("`to`")
                || self.behind(1) == Some(Token::Ident("to"))
                || self.behind(2) == Some(Token::Ident("to")) =>
            {
                "a spread reads `spread error to { (1, 0): 1/2 };`"
            }
            _ => return None,
        };
        Some(help.into())
    }

    /// How an `each` reads.
    fn each(&self) -> Option<String> {
        let help = match self.item() {
            "scene" => "this reads `each k in 0 .. 9 { sphere((k, 0, 0), 1) is k; }`",
            _ => {
                "outside of scenes `each` stands behind the name of what joins two: \
                 `union each k in 0 .. 9 { sphere((k, 0, 0), 1) }`"
            }
        };
        Some(help.into())
    }

    /// Whether the place lies in an `each`, before what it repeats.
    fn in_each(&self) -> bool {
        let before = self.tokens.get(..self.at).unwrap_or(&[]);
        let words = before.iter().rev().take_while(|(token, _)| {
            !matches!(token, Token::Sym("{" | "}" | ";") | Token::Word("loop"))
        });
        words.into_iter().any(|(t, _)| *t == Token::Word("each"))
            && ["`in`", "`..`", "`{`", "a name"]
                .iter()
                .any(|e| self.expects(e))
    }

    /// How the item reads when it is right.
    fn usage(&self) -> Option<String> {
        let example = match self.item() {
            "image" => "image 320 x 240 inks black, white;",
            "param" => "param a: real = 1 in 0 .. 2;",
            "state" => "state a: int = 0 in 0 .. 9 -> a + 1;",
            "const" => "const a = 1;",
            "fn" => "fn f(a: real) -> real = a;",
            "effect" => "effect f(a: real) -> real else 0 = a;",
            "shape" => "shape s(a: real) { dist(p) = length(p) - a; }",
            "scene" => "scene s { sphere((0, 0, 0), 1) is 1; }",
            "record" => "record r { a: real, b: real }",
            "map" => "map m { \"##\" \"#.\" } where '#' => 1, '.' => 0;",
            "dither" => "dither d(v: real, x: int, y: int) -> ink = threshold(v, 0.5);",
            "draw" => "draw (x, y) = ink(0);",
            "use" => "use \"file.scn\";",
            _ => return None,
        };
        Some(format!("it reads like `{example}`"))
    }
}
