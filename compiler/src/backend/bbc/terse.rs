//! The same statements in fewer bytes and fewer steps of the interpreter: brackets
//! around a function's lone argument, a sum with a number below 0, the zero before a
//! point, and choices between two whole numbers by a flag, which TRUE = -1 makes a sum.

use super::pieces::{Piece, pieces};
use std::collections::BTreeSet;

/// Functions of one argument, which takes no brackets where it is a variable.
const FUNCTIONS: &[&str] = &["ABS", "INT", "SGN", "SQR"];

/// A line with long names as it is written shortest. `flags` are variables that are
/// TRUE or FALSE. `scant`: even where that takes a little longer.
pub fn terse(text: &str, flags: &BTreeSet<String>, scant: bool) -> String {
    let chosen = sum_of_flag(text, flags, scant);
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
            (
                Piece::Word(word),
                [
                    Piece::Sign("("),
                    Piece::Sign("-"),
                    Piece::Name(name),
                    Piece::Sign(")"),
                    ..,
                ],
            ) if FUNCTIONS.contains(word) => {
                out.push_str(&format!("{word}-{name}"));
                rest = &behind[4..];
            }
            (Piece::Sign("+"), [Piece::Sign("-"), Piece::Word(number), next @ ..])
                if is_number(number) && !matches!(next.first(), Some(Piece::Sign("^"))) => {}
            (Piece::Word(number), _) if scant && zeros(number) > 3 => {
                let (digits, zeros) = number.split_at(number.len() - zeros(number));
                out.push_str(&format!("{digits}E{}", zeros.len()));
            }
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

/// How many zeros a whole number ends in.
fn zeros(word: &str) -> usize {
    match word.bytes().all(|b| b.is_ascii_digit()) {
        true => word.len() - word.trim_end_matches('0').len(),
        false => 0,
    }
}

fn is_number(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit() || c == '.')
}

/// `IF flag THEN v%=2 ELSE v%=1` as `v%=1-flag`.
fn sum_of_flag(text: &str, flags: &BTreeSet<String>, scant: bool) -> Option<String> {
    let (flag, ways) = text.strip_prefix("IF ")?.split_once(" THEN ")?;
    let (yes, no) = ways.split_once(" ELSE ")?;
    let (flag, yes, no) = match flag.strip_prefix("NOT ") {
        Some(flag) => (flag, no, yes),
        None => (flag, yes, no),
    };
    let (home, yes) = yes.split_once('=')?;
    let no = no.strip_prefix(home)?.strip_prefix('=')?;
    let (yes, no): (i64, i64) = (yes.parse().ok()?, no.parse().ok()?);
    let compared = match scant && is_comparison(flag) {
        true => format!("({flag})"),
        false => String::new(),
    };
    let flag = match compared.as_str() {
        "" if flags.contains(flag) => flag,
        "" => return None,
        compared => compared,
    };
    if !home.ends_with('%') {
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

/// Whether a condition is one comparison of numbers.
fn is_comparison(text: &str) -> bool {
    let all = pieces(text);
    let word = |piece: &Piece<'_>| match piece {
        Piece::Space | Piece::Fixed(_) => false,
        Piece::Word(word) => is_number(word) || word.len() == 1,
        Piece::Name(_) | Piece::Sign(_) => true,
    };
    let signs = |c: char| text.matches(c).count();
    all.iter().all(word) && signs('<') + signs('>') == 1 && signs('(') == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_memory_is_scant_comparisons_are_counted_with() {
        let terse = |text| terse(text, &BTreeSet::new(), true);
        let text = "IF a<=b THEN I%=1 ELSE I%=0";
        assert_eq!(terse(text), "I%=-(a<=b)");
        assert_eq!(terse("a=1200000+10000*b"), "a=12E5+1E4*b");
        for text in [
            "IF a<b AND c<d THEN I%=1 ELSE I%=0",
            "IF n% AND 1 THEN I%=1 ELSE I%=0",
            "IF a THEN I%=1 ELSE I%=0",
        ] {
            assert_eq!(terse(text), text);
        }
    }

    #[test]
    fn statements_become_shorter() {
        let flags = ["odd%".to_owned()].into();
        for (text, short) in [
            (
                "IF ABS(a)<0.5 THEN b=INT(a+1)",
                "IF ABSa<.5 THEN b=INT(a+1)",
            ),
            ("b=SQR(a(3))+-96*a+-2^2", "b=SQR(a(3))-96*a+-2^2"),
            ("b=SQR(-a)*SQR(-a*b)", "b=SQR-a*SQR(-a*b)"),
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
            assert_eq!(terse(text, &flags, false), short);
        }
    }
}
