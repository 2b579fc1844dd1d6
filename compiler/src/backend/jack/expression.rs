//! Expressions as Jack writes them.

use slowlight_routine::log::model::Log;
use slowlight_runtime_jack::{SUM, TERM};

/// An expression: its text, and how tightly it binds.
#[derive(Clone, Debug)]
pub(super) struct Expression {
    pub text: String,
    pub level: u8,
}

impl Expression {
    pub fn term(text: impl Into<String>) -> Expression {
        Expression {
            text: text.into(),
            level: TERM,
        }
    }

    /// With parentheses where it binds less than `level`.
    pub fn at(&self, level: u8) -> String {
        if self.level < level {
            format!("({})", self.text)
        } else {
            self.text.clone()
        }
    }
}

/// An int as Jack writes it.
pub(super) fn int(value: i32) -> Expression {
    match value {
        0..=32767 => Expression::term(value.to_string()),
        -32767..0 => Expression {
            text: value.to_string(),
            level: SUM,
        },
        _ => Expression {
            text: "-32767 - 1".to_owned(),
            level: SUM,
        },
    }
}

/// A constant's logarithm as Jack writes it.
pub(super) fn constant(bits: slowlight_routine::Bits) -> Expression {
    int(Log::from_bits(bits).log)
}
