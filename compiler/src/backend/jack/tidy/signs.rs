//! Signs that are compared with each other: `a = (~(b = a))` is `~b`, as a sign that stands
//! there twice counts for nothing.

use super::tree::*;

/// An equation of signs: those that stand in it, and whether it holds where all are the same.
struct Parity<'t> {
    signs: Vec<&'t str>,
    holds: bool,
}

/// Simplifies the conditions and the signs that are made of others.
pub(super) fn simplified(items: &mut [Item], is_sign: &impl Fn(&str) -> bool) {
    for item in items {
        match item {
            Item::Line(line) => {
                let made = assignment(&line.text).filter(|(name, _)| is_sign(name));
                let simple = made.and_then(|(name, value)| {
                    let simple = shorter(value, is_sign)?;
                    let rest = line.text.get(code(&line.text).len()..)?;
                    let value = match simple.contains(' ') {
                        true => format!("({simple})"),
                        false => simple,
                    };
                    Some(format!("let {name} = {value};{rest}"))
                });
                line.text = simple.unwrap_or_else(|| std::mem::take(&mut line.text));
            }
            Item::While { body, .. } => simplified(body, is_sign),
            Item::If { head, yes, no } => {
                if let Some(simple) = shorter(condition(&head.text), is_sign) {
                    *head = if_of(head, &simple);
                }
                simplified(yes, is_sign);
                simplified(no, is_sign);
            }
        }
    }
}

/// An expression of signs alone as it is shortest, if that is another.
fn shorter(text: &str, is_sign: &impl Fn(&str) -> bool) -> Option<String> {
    let (parity, rest) = Parity::equation(text, is_sign, 0)?;
    let simple = parity.text();
    (rest.is_empty() && simple != text).then_some(simple)
}

impl<'t> Parity<'t> {
    /// `a = b`, or one of these; what comes behind it.
    fn equation(
        text: &'t str,
        is_sign: &impl Fn(&str) -> bool,
        depth: u8,
    ) -> Option<(Self, &'t str)> {
        let (mut first, mut rest) = Parity::term(text, is_sign, depth)?;
        if let Some(behind) = rest.strip_prefix(" = ") {
            let (second, behind) = Parity::term(behind, is_sign, depth)?;
            rest = behind;
            first.holds = first.holds == second.holds;
            for sign in second.signs {
                match first.signs.iter().position(|other| *other == sign) {
                    Some(at) => drop(first.signs.remove(at)),
                    None => first.signs.push(sign),
                }
            }
        }
        Some((first, rest))
    }

    fn term(text: &'t str, is_sign: &impl Fn(&str) -> bool, depth: u8) -> Option<(Self, &'t str)> {
        if depth > 16 {
            return None;
        }
        if let Some(other) = text.strip_prefix('~') {
            let (mut parity, rest) = Parity::term(other, is_sign, depth + 1)?;
            parity.holds = !parity.holds;
            return Some((parity, rest));
        }
        if let Some(inner) = text.strip_prefix('(') {
            let (parity, rest) = Parity::equation(inner, is_sign, depth + 1)?;
            return Some((parity, rest.strip_prefix(')')?));
        }
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let end = text.find(|c| !is_part(c)).unwrap_or(text.len());
        let (name, mut rest) = text.split_at(end);
        let mut sign = name;
        if let Some(index) = rest.strip_prefix('[') {
            let end = end
                + 2
                + index
                    .find(|c| !is_part(c))
                    .filter(|at| index[*at..].starts_with(']'))?;
            (sign, rest) = text.split_at(end);
        }
        let (signs, holds) = match name {
            "true" | "false" => (Vec::new(), name == "true"),
            _ if is_sign(name) => (vec![sign], true),
            _ => return None,
        };
        Some((Parity { signs, holds }, rest))
    }

    fn text(&self) -> String {
        let Some((first, others)) = self.signs.split_first() else {
            return self.holds.to_string();
        };
        let equal = others.iter().fold((*first).to_owned(), |all, sign| {
            format!("{} = {sign}", term(&all))
        });
        match self.holds {
            true => equal,
            false => negated(&equal),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_twice_goes() {
        let is_sign = |name: &str| name.ends_with("_plus");
        for (text, simple) in [
            ("a_plus = (~(b_plus = a_plus))", Some("~b_plus")),
            ("c_plus = (~(~b_plus))", Some("c_plus = b_plus")),
            ("a_plus = (~b_plus[k])", Some("~(a_plus = b_plus[k])")),
            ("true = b_plus", Some("b_plus")),
            ("b_plus = b_plus", Some("true")),
            ("a_plus = b_plus", None),
            ("a_plus = (b < c)", None),
            ("k = j", None),
        ] {
            assert_eq!(shorter(text, &is_sign).as_deref(), simple, "{text}");
        }
    }
}
