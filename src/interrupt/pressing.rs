//! What pressing Ctrl-C does: a flag, a wait for those who look at it, and the end.

use super::{BLIND, INTERRUPTED, LAST_WORDS, WRITING};
use crate::failure::Failure;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// How long work has to notice the flag before the process ends regardless.
const PATIENCE: Duration = Duration::from_secs(1);

/// How often it is looked at whether there is anything to wait for.
const LOOK: Duration = Duration::from_millis(5);

/// Waits until there is nothing to wait for, or no longer.
fn wait() {
    let begun = Instant::now();
    let going = |count: &AtomicUsize| count.load(Ordering::SeqCst) > 0;
    while begun.elapsed() < PATIENCE && (going(&WRITING) || !going(&BLIND)) {
        std::thread::sleep(LOOK);
    }
}

/// From now on Ctrl-C sets the flag instead of ending the process, so that
/// temporary files are removed on the way out. A single pixel may take long,
/// and nothing is being written meanwhile: then the process ends after a second, and at once
/// where it is known that nobody looks ([`blind`]).
pub fn install() {
    // Where it cannot be installed, Ctrl-C ends the process as it always did.
    let _ = ctrlc::set_handler(|| {
        INTERRUPTED.store(true, Ordering::Relaxed);
        wait();
        let words = LAST_WORDS.lock().ok().and_then(|mut words| words.take());
        if let Some(words) = words {
            words();
        }
        std::process::exit(i32::from(Failure::Interrupted.status()));
    });
}
