//! Progress with an estimate, on standard error, for what takes over a second.
//!
//! Nothing is shown where standard error is no terminal (indicatif sees to
//! that) or where the work is done within the second. Works that go on at the
//! same time have a line each.

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::borrow::Cow;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// How long to be silent.
const SILENCE: Duration = Duration::from_secs(1);

/// All lines that are shown.
static LINES: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// How far some work has come; may be shared between threads.
pub struct Progress {
    bar: ProgressBar,
    started: Instant,
    shown: AtomicBool,
}

impl Progress {
    /// Work of `total` units.
    pub fn new(what: impl Into<Cow<'static, str>>, total: u64) -> Progress {
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
            LINES.add(self.bar.clone());
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
        LINES.remove(&self.bar);
    }
}
