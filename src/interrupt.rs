//! Ctrl-C: a flag that rows, machines and watchers look at.

use crate::failure::{Failure, Outcome};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// What is said before the process ends.
static LAST_WORDS: Mutex<Option<Box<dyn FnOnce() + Send>>> = Mutex::new(None);

/// How many works go on that never look at the flag, and how many that write files.
static BLIND: AtomicUsize = AtomicUsize::new(0);
static WRITING: AtomicUsize = AtomicUsize::new(0);

/// How long work has to notice the flag before the process ends regardless.
const PATIENCE: Duration = Duration::from_secs(1);

/// How often it is looked at whether there is anything to wait for.
const LOOK: Duration = Duration::from_millis(5);

/// Something goes on until this is dropped.
pub struct GoesOn(&'static AtomicUsize);

impl GoesOn {
    fn new(count: &'static AtomicUsize) -> GoesOn {
        count.fetch_add(1, Ordering::SeqCst);
        GoesOn(count)
    }
}

impl Drop for GoesOn {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Work begins that never looks at the flag, planning above all: until this is dropped Ctrl-C
/// ends the process at once, since to wait for it would be in vain.
pub fn blind() -> GoesOn {
    GoesOn::new(&BLIND)
}

/// Files are being written until this is dropped, temporary ones among them that are to be
/// removed: that is waited for.
pub fn writing() -> GoesOn {
    GoesOn::new(&WRITING)
}

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
