//! Ctrl-C: a flag that rows, machines and watchers look at.

use crate::failure::{Failure, Outcome};
use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C sets the flag instead of ending the process, so that
/// temporary files are removed on the way out.
pub fn install() {
    // Where it cannot be installed, Ctrl-C ends the process as it always did.
    let _ = ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::Relaxed));
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
