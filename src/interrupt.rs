//! Ctrl-C: a flag that rows, machines and watchers look at; and jobs, works that can be
//! stopped by themselves while the process goes on.

use crate::failure::{Failure, Outcome};
use std::cell::RefCell;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

#[cfg(not(target_family = "wasm"))]
mod pressing;
#[cfg(not(target_family = "wasm"))]
pub use pressing::install;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// What is said before the process ends.
static LAST_WORDS: Mutex<Option<Box<dyn FnOnce() + Send>>> = Mutex::new(None);

/// How many works go on that never look at the flag, and how many that write files.
static BLIND: AtomicUsize = AtomicUsize::new(0);
static WRITING: AtomicUsize = AtomicUsize::new(0);

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

/// Work that can be stopped while the process goes on; a copy is of the same work.
#[derive(Clone, Debug, Default)]
pub struct Job(Arc<AtomicBool>);

thread_local! {
    /// What this thread works for.
    static JOB: RefCell<Option<Job>> = const { RefCell::new(None) };
}

impl Job {
    /// Stops it: whoever works for it finds Ctrl-C pressed.
    pub fn stop(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it was stopped.
    pub fn is_stopped(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Does something on this thread for the job; what it hands to other threads is for it
    /// where these are told so ([`job`], [`on_behalf`]).
    pub fn doing<T>(&self, work: impl FnOnce() -> T) -> T {
        on_behalf(Some(self), work)
    }
}

/// What this thread works for, if that can be stopped by itself.
pub fn job() -> Option<Job> {
    JOB.with_borrow(Clone::clone)
}

/// Does something on this thread for the job that another thread works for.
pub fn on_behalf<T>(of: Option<&Job>, work: impl FnOnce() -> T) -> T {
    struct Before(Option<Job>);
    impl Drop for Before {
        fn drop(&mut self) {
            JOB.set(self.0.take());
        }
    }
    let _before = Before(JOB.replace(of.cloned()));
    work()
}

/// Whether somebody pressed Ctrl-C, or stopped what this thread works for.
pub fn pressed() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
        || JOB.with_borrow(|job| job.as_ref().is_some_and(Job::is_stopped))
}

/// Whether somebody pressed Ctrl-C.
pub fn ends() -> bool {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_job_is_stopped_by_itself() {
        let (one, other) = (Job::default(), Job::default());
        one.stop();
        assert!(!pressed());
        one.doing(|| {
            assert!(pressed());
            other.doing(|| assert!(!pressed()));
            assert!(pressed());
            let known = job();
            let found = std::thread::scope(|scope| {
                let thread = scope.spawn(|| (pressed(), on_behalf(known.as_ref(), pressed)));
                thread.join().expect("no panic")
            });
            assert_eq!(found, (false, true));
        });
        assert!(!pressed() && !ends());
    }
}
