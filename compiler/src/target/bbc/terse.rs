//! The same statements in fewer bytes and fewer steps of the interpreter: brackets
//! around a function's lone argument, a sum with a number below 0, the zero before a
//! point, and choices between two whole numbers by a flag, which TRUE = -1 makes a sum.

use super::pieces::{Piece, pieces};
use std::collections::BTreeSet;

/// Functions of one argument, which takes no brackets where it is a variable.
const FUNCTIONS: &[&str] = &["ABS", "INT", "SGN", "SQR"];

/// A line with long names as it is written shortest. `flags` are variables that are
/// TRUE or FALSE.
pub fn terse(text: &str, flags: &BTreeSet<String>) -> String {
    let chosen = sum_of_flag(text, flags);
    let text = chosen.as_deref().unwrap_or(text);
    let all = pieces(text);
    let mut out = String::new();
    let mut rest = all.as_slice();
    while let [first, behind @ ..] = rest {
        rest = behind;
        let before = out.chars().last();
        match (first, behind) {
            (Piece::Word(word), [Piece::Sign("("), Piece::Name(name), Piece::Sign(")"), ..])
                if FUNCTIONS.contains(word) =>
            {
                out.push_str(word);
                out.push_str(name);
                rest = &behind[3..];
            }
            (Piece::Sign("+"), [Piece::Sign("-"), Piece::Word(number), next @ ..])
                if is_number(number) && !matches!(next.first(), Some(Piece::Sign("^"))) => {}
            // Behind a word a point might end an abbreviation.
            (Piece::Word(number), _)
                if number.starts_with("0.") && before.is_some_and(|c| "=<>+-*/(,".contains(c)) =>
            {
                out.push_str(&number[1..]);
            }
            (Piece::Name(t) | Piece::Word(t) | Piece::Fixed(t) | Piece::Sign(t), _) => {
                out.push_str(t);
            }
            (Piece::Space, _) => out.push(' '),
        }
    }
    out
}

fn is_number(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit() || c == '.')
}

/// `IF flag THEN v%=2 ELSE v%=1` as `v%=1-flag`.
fn sum_of_flag(text: &str, flags: &BTreeSet<String>) -> Option<String> {
    let (flag, ways) = text.strip_prefix("IF ")?.split_once(" THEN ")?;
    let (yes, no) = ways.split_once(" ELSE ")?;
    let (flag, yes, no) = match flag.strip_prefix("NOT ") {
        Some(flag) => (flag, no, yes),
        None => (flag, yes, no),
    };
    let (home, yes) = yes.split_once('=')?;
    let no = no.strip_prefix(home)?.strip_prefix('=')?;
    let (yes, no): (i64, i64) = (yes.parse().ok()?, no.parse().ok()?);
    if !flags.contains(flag) || !home.ends_with('%') {
        return None;
    }
    let base = if no == 0 {
        String::new()
    } else {
        no.to_string()
    };
    Some(match no - yes {
        0 => format!("{home}={no}"),
        1 if no == 0 => format!("{home}={flag}"),
        1 => format!("{home}={base}+{flag}"),
        -1 => format!("{home}={base}-{flag}"),
        by @ 2..=9 if no == 0 => format!("{home}={by}*{flag}"),
        by @ 2..=9 => format!("{home}={base}+{by}*{flag}"),
        by @ -9..=-2 => format!("{home}={base}-{}*{flag}", -by),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_become_shorter() {
        let flags = ["odd%".to_owned()].into();
        for (text, short) in [
            (
                "IF ABS(a)<0.5 THEN b=INT(a+1)",
                "IF ABSa<.5 THEN b=INT(a+1)",
            ),
            ("b=SQR(a(3))+-96*a+-2^2", "b=SQR(a(3))-96*a+-2^2"),
            ("b=a+(-c):c=10.5", "b=a+(-c):c=10.5"),
            ("IF odd% THEN a%=1 ELSE a%=0", "a%=-odd%"),
            ("IF NOT odd% THEN a%=3 ELSE a%=2", "a%=3+odd%"),
            ("IF odd% THEN a%=1 ELSE a%=-1", "a%=-1-2*odd%"),
            (
                "IF odd% THEN a%=90 ELSE a%=-1",
                "IF odd% THEN a%=90 ELSE a%=-1",
            ),
            (
                "IF even% THEN a%=1 ELSE a%=0",
                "IF even% THEN a%=1 ELSE a%=0",
            ),
            ("IF odd% THEN a=1 ELSE a=0", "IF odd% THEN a=1 ELSE a=0"),
            ("IF odd% THEN a%=1 ELSE b%=0", "IF odd% THEN a%=1 ELSE b%=0"),
            ("PRINT \"0.5+-3\"", "PRINT \"0.5+-3\""),
        ] {
            assert_eq!(terse(text, &flags), short);
        }
    }
}
