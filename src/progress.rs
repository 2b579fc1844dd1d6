//! Progress with an estimate, on standard error, for what takes over a second.
//!
//! Nothing is shown where standard error is no terminal (indicatif sees to
//! that) or where the work is done within the second.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// How long to be silent.
const SILENCE: Duration = Duration::from_secs(1);

/// How far some work has come; may be shared between threads.
pub struct Progress {
    bar: ProgressBar,
    started: Instant,
    shown: AtomicBool,
}

impl Progress {
    /// Work of `total` units.
    pub fn new(what: &'static str, total: u64) -> Progress {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
        let form = "{msg:>16} {wide_bar} {percent:>3}% {eta:>4} left";
        if let Ok(style) = ProgressStyle::with_template(form) {
            bar.set_style(style);
        }
        bar.set_message(what);
        Progress {
            bar,
            started: Instant::now(),
            shown: AtomicBool::new(false),
        }
    }

    /// So many units more are done.
    pub fn step(&self, units: u64) {
        self.bar.inc(units);
        self.show();
    }

    /// So many units are done in all.
    pub fn reach(&self, units: u64) {
        self.bar.set_position(units);
        self.show();
    }

    fn show(&self) {
        if self.started.elapsed() > SILENCE && !self.shown.swap(true, Ordering::Relaxed) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
