//! Standard output, which every command writes to through here.
//!
//! What cannot be written is an error, as for any file: a full disc must not look like
//! success. A reader that has gone away (`| head`) has what it wanted, and that is none.

use crate::failure::{Failure, Outcome, plain};
use std::io::{ErrorKind, IsTerminal, Write};

/// Prints a text as it is.
///
/// # Errors
/// Where standard output takes no more.
pub fn say(text: &str) -> Outcome<()> {
    let mut out = std::io::stdout().lock();
    written(out.write_all(text.as_bytes()).and_then(|()| out.flush()))
}

/// Prints a value as JSON, and a line's end.
///
/// # Errors
/// As [`say`], and where the value is none that JSON can hold.
pub fn say_json(value: &impl serde::Serialize) -> Outcome<()> {
    let text = serde_json::to_string_pretty(value)
        .map_err(|e| Failure::Wrong(format!("cannot be written as JSON: {e}")))?;
    say(&(text + "\n"))
}

/// Says a line on standard error. Where that cannot be written, there is nobody to tell.
pub fn remark(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Whether what is printed is for eyes that like colours.
pub fn coloured() -> bool {
    std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty())
}

/// What became of writing.
///
/// # Errors
/// Where it failed, unless nobody reads any more.
pub fn written(result: std::io::Result<()>) -> Outcome<()> {
    match result {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(Failure::Wrong(format!(
            "cannot write to standard output: {}",
            plain(&e)
        ))),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reader_that_went_away_is_no_error() {
        assert!(written(Ok(())).is_ok());
        assert!(written(Err(ErrorKind::BrokenPipe.into())).is_ok());
        let full = written(Err(ErrorKind::StorageFull.into()));
        assert!(matches!(full, Err(Failure::Wrong(why)) if why.contains("standard output")));
    }
}
