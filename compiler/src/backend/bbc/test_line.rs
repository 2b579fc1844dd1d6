//! Lines of one test, `IF .. THEN .. ELSE ..`, and opposites of tests.

/// A line that is one test.
pub struct Test<'t> {
    pub test: &'t str,
    pub yes: &'t str,
    pub no: &'t str,
}

impl<'t> Test<'t> {
    /// The test of a line, if it is one and no more.
    pub fn of(text: &'t str) -> Option<Test<'t>> {
        let (test, ways) = text.strip_prefix("IF ")?.split_once(" THEN ")?;
        let (yes, no) = ways.split_once(" ELSE ").unwrap_or((ways, ""));
        let one = !ways.contains("IF ") && !no.contains(" ELSE ");
        one.then_some(Test { test, yes, no })
    }
}

/// The test that holds where another does not.
pub fn opposite(test: &str) -> Option<String> {
    if let Some(name) = test.strip_prefix("NOT ") {
        return (!name.contains([' ', '(', '<', '>', '='])).then(|| name.to_owned());
    }
    let sign = |c: char| "<>=".contains(c);
    let from = test.find(sign)?;
    let length = test.get(from..)?.find(|c| !sign(c))?;
    let (left, rest) = test.split_at_checked(from)?;
    let (sign_is, right) = rest.split_at_checked(length)?;
    let alone = |text: &str| !text.contains(sign) && !text.contains("AND") && !text.contains("OR");
    let turned = match sign_is {
        "<" => ">=",
        "<=" => ">",
        ">" => "<=",
        ">=" => "<",
        "=" => "<>",
        "<>" => "=",
        _ => return None,
    };
    (alone(left) && alone(right)).then(|| format!("{left}{turned}{right}"))
}
