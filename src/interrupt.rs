//! Ctrl-C: a flag that rows, machines and watchers look at.

use crate::failure::{Failure, Outcome};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// What is said before the process ends.
static LAST_WORDS: Mutex<Option<Box<dyn FnOnce() + Send>>> = Mutex::new(None);

/// How long work has to notice the flag before the process ends regardless.
const PATIENCE: Duration = Duration::from_secs(1);

/// From now on Ctrl-C sets the flag instead of ending the process, so that
/// temporary files are removed on the way out. A single pixel may take long,
/// and nothing is being written meanwhile: then the process ends at once.
pub fn install() {
    // Where it cannot be installed, Ctrl-C ends the process as it always did.
    let _ = ctrlc::set_handler(|| {
        INTERRUPTED.store(true, Ordering::Relaxed);
        std::thread::sleep(PATIENCE);
        let words = LAST_WORDS.lock().ok().and_then(|mut words| words.take());
        if let Some(words) = words {
            words();
        }
        std::process::exit(i32::from(Failure::Interrupted.status()));
    });
}

/// Says something before the process ends because of Ctrl-C, where work did not notice in
/// time; until [`quietly`].
pub fn last_words(words: impl FnOnce() + Send + 'static) {
    if let Ok(mut place) = LAST_WORDS.lock() {
        *place = Some(Box::new(words));
    }
}

/// Takes the last words back: what they would say is said.
pub fn quietly() {
    if let Ok(mut place) = LAST_WORDS.lock() {
        *place = None;
    }
}

/// Whether somebody pressed Ctrl-C.
pub fn pressed() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// An error where somebody did.
///
/// # Errors
/// [`Failure::Interrupted`].
pub fn check() -> Outcome<()> {
    if pressed() {
        Err(Failure::Interrupted)
    } else {
        Ok(())
    }
}
