//! A watch on the scene's directory: what is saved elsewhere is read again.

use super::desk::{Change, Desk};
use crate::live::board::Board;
use notify_debouncer_mini::notify::{RecommendedWatcher, RecursiveMode};
use notify_debouncer_mini::{DebounceEventResult, Debouncer, new_debouncer};
use std::sync::Arc;
use std::time::Duration;

/// How long writes to a file must rest before it is read: editors write in several steps.
const REST: Duration = Duration::from_millis(60);

/// Watches the file, and others beside it that the scene may use; none where the system
/// cannot. It ends when it is dropped.
pub fn watch(desk: &Arc<Desk>) -> Option<Debouncer<RecommendedWatcher>> {
    let told = desk.clone();
    let mut watching = new_debouncer(REST, move |events: DebounceEventResult| {
        let events = events.unwrap_or_default();
        let file = told.file();
        if events.iter().any(|event| file.is(&event.path)) {
            reload(&told, false);
        }
        // To be read is an event, too.
        if events.iter().any(|event| file.is_stale(&event.path)) {
            told.wish(Change {
                files: true,
                ..Change::default()
            });
        }
    })
    .ok()?;
    let watched = desk.file().directory();
    let mode = RecursiveMode::NonRecursive;
    watching.watcher().watch(watched, mode).ok()?;
    Some(watching)
}

/// Reads the file again; with `force` its text replaces one that was not saved.
pub fn reload(desk: &Desk, force: bool) {
    match desk.file().again() {
        Ok(Some((text, was))) => changed(desk, &text, &was, force),
        Ok(None) if force => {
            let text = desk.file().text();
            changed(desk, &text, &text, true);
        }
        // Perhaps again what it was before it could not be read.
        Ok(None) => {
            let saved = desk.file().holds(&desk.wanted().text);
            desk.show(|shown, _| (shown.file.wrong, shown.file.saved) = (None, saved));
        }
        Err(failure) => {
            let why = failure.reason();
            desk.show(|shown, _| (shown.file.wrong, shown.file.saved) = (Some(why), false));
        }
    }
}

/// The file's text has changed on disk; where the page's was not saved, that is only said.
/// `force` takes it all the same.
fn changed(desk: &Desk, text: &str, was: &str, force: bool) {
    let unsaved = *desk.wanted().text != *was;
    if unsaved && !force {
        return desk.show(|shown, _| shown.file.elsewhere = true);
    }
    desk.wish(Change {
        text: Some((text.to_owned(), "file".to_owned())),
        ..Change::default()
    });
    desk.show(|shown, _| {
        shown.file.elsewhere = false;
        shown.file.wrong = None;
    });
}
