//! Expressions as text, and the tests under which they may be written shorter.

use slowlight_routine::Form;
use slowlight_runtime_bbc::level;
use slowlight_runtime_bbc::level::{OPERAND, PRODUCT, SUM};

/// The same value without a function call, where tests allow it.
#[derive(Clone, Debug, PartialEq)]
pub struct Fast {
    pub text: String,
    pub level: u8,
    /// Conditions; all must hold.
    pub tests: Vec<String>,
    /// What the value's size stays below then, where that is known.
    pub below: Option<f64>,
    /// The value where they do not all hold, if that is always the same.
    pub otherwise: Option<&'static str>,
}

/// An expression and how tightly it binds.
#[derive(Clone, Debug)]
pub struct Text {
    pub text: String,
    pub level: u8,
    pub fast: Option<Box<Fast>>,
}

fn at(text: &str, own: u8, level: u8) -> String {
    if own < level {
        format!("({text})")
    } else {
        text.to_owned()
    }
}

impl Text {
    pub fn new(text: impl Into<String>, level: u8) -> Text {
        Text {
            text: text.into(),
            level,
            fast: None,
        }
    }

    pub fn operand(text: impl Into<String>) -> Text {
        Text::new(text, OPERAND)
    }

    /// In brackets, if it binds less tightly than needed.
    pub fn at(&self, level: u8) -> String {
        at(&self.text, self.level, level)
    }

    /// The same where its tests have passed.
    pub fn fast_at(&self, level: u8) -> String {
        match &self.fast {
            Some(fast) => at(&fast.text, fast.level, level),
            None => self.at(level),
        }
    }

    /// Whether it is a variable or a number: reading it twice costs no more
    /// than keeping it.
    pub fn is_simple(&self) -> bool {
        let plain = |c: char| c.is_ascii_alphanumeric() || "_%.".contains(c);
        let text = self.text.strip_prefix('-').unwrap_or(&self.text);
        text.chars().all(plain)
    }
}

/// A routine's expression with its operands, as they are under their tests or always.
pub fn filled(form: Form, operands: &[Text], fast: bool) -> Text {
    let Form::Expression {
        template,
        level,
        operands: levels,
    } = form
    else {
        return Text::operand("0");
    };
    let mut text = template.to_owned();
    for (k, operand) in operands.iter().enumerate() {
        let need = levels.get(k).copied().unwrap_or(level::OPERAND);
        let hole = format!("{{{k}}}");
        let mut operand = if fast {
            operand.fast_at(need)
        } else {
            operand.at(need)
        };
        // Two signs beside each other are hard to read.
        let sign = |sign: &str| text.contains(&format!("{sign}{hole}"));
        if operand.starts_with('-') && (sign("+") || sign("-")) {
            operand = format!("({operand})");
        }
        text = text.replace(&hole, &operand);
    }
    Text::new(text, level)
}

/// A sum whose first part is negative the other way round, a negative sum part by part, and a
/// product with a power of two below 1 as a quotient: the same bits, since rounding knows neither
/// signs nor exponents.
pub fn turned(form: Form, operands: &[Text]) -> Option<Text> {
    let Form::Expression { template, .. } = form else {
        return None;
    };
    match (template, operands) {
        ("{0}+{1}", [first, second]) if first.level >= PRODUCT && second.level >= SUM => {
            let rest = first.text.strip_prefix('-')?;
            let whole = !second.text.starts_with('-');
            whole.then(|| Text::new(format!("{}-{rest}", second.text), SUM))
        }
        ("{0}*{1}", [first, second]) => {
            let (by, other) = match (power(&first.text), power(&second.text)) {
                (_, Some(by)) => (by, first),
                (Some(by), _) if second.level > PRODUCT => (by, second),
                _ => return None,
            };
            Some(Text::new(format!("{}/{by}", other.at(PRODUCT)), PRODUCT))
        }
        ("-{0}", [sum]) if sum.level == SUM => {
            let (first, second) = sum.text.split_once('+')?;
            let plain = |text: &str| Text::operand(text).is_simple() && !text.starts_with('-');
            let both = plain(first) && plain(second);
            both.then(|| Text::new(format!("-{first}-{second}"), SUM))
        }
        _ => None,
    }
}

/// What a number is one part of, if that is a power of two.
fn power(text: &str) -> Option<u32> {
    let x: f64 = text.parse().ok()?;
    (1..=16).map(|k| 1 << k).find(|n| x * f64::from(*n) == 1.0)
}
