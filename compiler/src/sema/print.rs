//! The program as text, for `--emit program`.
use super::program::*;
use std::fmt;
impl fmt::Display for Program {
    fn fmt(&self, _f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Ok(())
    }
}
