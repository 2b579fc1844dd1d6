//! What a terminal says of itself: its primary device attributes, asked for with a time limit.

/// Whether the terminal says that it shows sixels.
#[cfg(unix)]
pub fn has_sixel() -> bool {
    attributes().is_some_and(|answer| says_sixel(&answer))
}

/// Elsewhere nobody is asked.
#[cfg(not(unix))]
pub fn has_sixel() -> bool {
    false
}

/// Whether an answer, `ESC [ ? 62 ; 4 ; 22 c` say, has attribute 4 among those behind the
/// terminal's class.
#[cfg_attr(not(unix), allow(dead_code))]
fn says_sixel(answer: &str) -> bool {
    let Some((_, rest)) = answer.split_once("\x1b[?") else {
        return false;
    };
    let Some((numbers, _)) = rest.split_once('c') else {
        return false;
    };
    numbers.split(';').skip(1).any(|number| number == "4")
}

/// How long a terminal may take to answer, in milliseconds: nearly all do at once.
#[cfg(unix)]
const WAIT: u64 = 200;

/// An answer is shorter than this.
#[cfg(unix)]
const LONGEST: usize = 256;

/// The answer of the terminal that the program was started from; none where there is none, or
/// it says nothing in time.
#[cfg(unix)]
fn attributes() -> Option<String> {
    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    use rustix::termios::{OptionalActions, tcgetattr, tcgetpgrp, tcsetattr};
    use std::time::{Duration, Instant};

    let terminal = std::fs::File::options()
        .read(true)
        .write(true)
        .open("/dev/tty")
        .ok()?;
    // From the background it must not be touched.
    if tcgetpgrp(&terminal).ok()? != rustix::process::getpgrp() {
        return None;
    }
    let before = tcgetattr(&terminal).ok()?;
    let mut raw = before.clone();
    raw.make_raw();
    tcsetattr(&terminal, OptionalActions::Now, &raw).ok()?;
    let end = Instant::now() + Duration::from_millis(WAIT);
    let mut answer = Vec::new();
    let mut ask = || -> Option<()> {
        rustix::io::write(&terminal, b"\x1b[c").ok()?;
        while !answer.ends_with(b"c") && answer.len() < LONGEST {
            let left = end.checked_duration_since(Instant::now())?;
            let left = Timespec {
                tv_sec: 0,
                tv_nsec: left.subsec_nanos().into(),
            };
            let mut all = [PollFd::new(&terminal, PollFlags::IN)];
            if poll(&mut all, Some(&left)).ok()? == 0 {
                return None;
            }
            let mut bytes = [0; 64];
            let count = rustix::io::read(&terminal, &mut bytes).ok()?;
            if count == 0 {
                return None;
            }
            answer.extend_from_slice(bytes.get(..count)?);
        }
        Some(())
    };
    let asked = ask();
    // What it was must come back, whatever was said.
    let _ = tcsetattr(&terminal, OptionalActions::Now, &before);
    asked?;
    String::from_utf8(answer).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attribute_four_is_sixel() {
        for (answer, has) in [
            ("\x1b[?62;4;22c", true),
            ("\x1b[?65;1;4c", true),
            ("q\x1b[?64;1;2;4;6c", true),
            // The class is no attribute.
            ("\x1b[?4c", false),
            ("\x1b[?1;2c", false),
            ("\x1b[?62;14;44c", false),
            ("\x1b[?62;4", false),
            ("", false),
        ] {
            assert_eq!(says_sixel(answer), has, "{answer:?}");
        }
    }
}
