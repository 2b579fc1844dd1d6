//! Progress with an estimate, on standard error, for what takes over a second.
//!
//! No progress is shown where standard error is no terminal (indicatif sees to
//! that) or where the work is done within the second. Works that go on at the
//! same time have a line each.

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::borrow::Cow;
use std::io::{IsTerminal, Write};
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How long to be silent.
const SILENCE: Duration = Duration::from_secs(1);

/// All lines that are shown.
static LINES: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// Says a line: on a terminal above what is shown, elsewhere by itself.
pub fn say(line: &str) {
    // That a line could not be written is nothing that the work hangs on.
    let _ = match std::io::stderr().is_terminal() {
        true => LINES.println(line),
        false => writeln!(std::io::stderr(), "{line}"),
    };
}

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

/// Work of which nobody can say how far it has come: that it goes on is shown
/// until this is dropped.
pub struct Waiting {
    bar: ProgressBar,
    /// Dropped when the work is done.
    done: Option<Sender<()>>,
    shower: Option<JoinHandle<()>>,
}

/// How often what turns is turned.
const TURN: Duration = Duration::from_millis(100);

impl Waiting {
    /// Waits for `what`.
    pub fn new(what: impl Into<Cow<'static, str>>) -> Waiting {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{msg:>16} {spinner} {elapsed}") {
            bar.set_style(style);
        }
        bar.set_message(what);
        let (done, waits) = channel::<()>();
        let shown = bar.clone();
        // Without a thread to spare nothing is shown.
        let shower = std::thread::Builder::new().spawn(move || {
            if waits.recv_timeout(SILENCE) == Err(RecvTimeoutError::Timeout) {
                LINES.add(shown.clone());
                shown.enable_steady_tick(TURN);
            }
        });
        Waiting {
            bar,
            done: Some(done),
            shower: shower.ok(),
        }
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        drop(self.done.take());
        // It must not add the line after it is removed; it only ever ends by itself.
        if let Some(shower) = self.shower.take() {
            let _ = shower.join();
        }
        self.bar.finish_and_clear();
        LINES.remove(&self.bar);
    }
}
