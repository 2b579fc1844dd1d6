//! What can be asked: a table of names, none of which is a path of a file.

use super::desk::{Change, Desk};
use super::file::Saved;
use super::page;
use super::watching;
use crate::files;
use crate::live::board::{Board, Task};
use crate::live::choices::machines;
use crate::live::run::{self, Asked, Run};
use crate::live::shown::Shown;
use serde::Deserialize;
use serde_json::{Value, json};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// How many params may be set, and of how many numbers each.
const MOST: (usize, usize) = (1000, 4);

/// An answer.
pub struct Answer {
    /// HTTP's number for how it went.
    pub status: u16,
    /// What the bytes are.
    pub kind: &'static str,
    /// The bytes.
    pub bytes: Cow<'static, [u8]>,
}

impl Answer {
    /// In words.
    pub fn text(status: u16, text: &'static str) -> Answer {
        Answer {
            status,
            kind: "text/plain; charset=utf-8",
            bytes: Cow::Borrowed(text.as_bytes()),
        }
    }

    fn json(status: u16, value: &Value) -> Answer {
        Answer {
            status,
            kind: "application/json",
            bytes: Cow::Owned(value.to_string().into_bytes()),
        }
    }

    fn png(bytes: &[u8]) -> Answer {
        match bytes.is_empty() {
            true => Answer::text(404, "there is no picture yet\n"),
            false => Answer {
                status: 200,
                kind: "image/png",
                bytes: Cow::Owned(bytes.to_vec()),
            },
        }
    }

    fn wrong(why: &str) -> Answer {
        Answer::json(400, &json!({"wrong": why}))
    }
}

/// The state, with its number.
pub fn state(version: u64, shown: &Shown) -> Answer {
    Answer::json(200, &json!({"version": version, "shown": shown}))
}

/// Answers who only looks.
pub fn got(desk: &Desk, path: &str) -> Answer {
    match path {
        "scene" => {
            let (text, revision) = desk.text();
            let text = json!({"text": &*text, "revision": revision});
            Answer::json(200, &text)
        }
        "machines" => Answer::json(200, &machines()),
        "costs" => match desk.pictures().costs.to_vec() {
            bytes if bytes.is_empty() => Answer::text(404, "nothing was counted yet\n"),
            bytes => Answer {
                status: 200,
                kind: "application/json",
                bytes: Cow::Owned(bytes),
            },
        },
        "native.png" => Answer::png(&desk.pictures().native),
        "1/machine.png" => Answer::png(&desk.pictures().machines[0].machine),
        "2/machine.png" => Answer::png(&desk.pictures().machines[1].machine),
        "1/difference.png" => Answer::png(&desk.pictures().machines[0].difference),
        "2/difference.png" => Answer::png(&desk.pictures().machines[1].difference),
        name => match page::asset(name) {
            Some(asset) => Answer {
                status: 200,
                kind: asset.kind,
                bytes: Cow::Borrowed(asset.bytes),
            },
            None => Answer::text(404, "there is nothing of that name\n"),
        },
    }
}

/// What an edit may bring; what is not there stays as it is.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Edit {
    /// The page's own name.
    page: String,
    text: Option<String>,
    set: Option<BTreeMap<String, Vec<f64>>>,
    runs: Option<Vec<Asked>>,
}

/// Which machine something is wanted of.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Of {
    #[serde(default)]
    panel: usize,
}

/// What saving brings.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Save {
    page: String,
    text: String,
    /// Whether to write over what somebody else wrote.
    #[serde(default)]
    force: bool,
}

/// Answers who wants something done.
pub fn posted(desk: &Desk, path: &str, body: &[u8]) -> Answer {
    match path {
        "edit" => match serde_json::from_slice(body) {
            Ok(edit) => match change(edit) {
                Ok(change) => Answer::json(200, &json!({"serial": desk.wish(change)})),
                Err(why) => Answer::wrong(&why),
            },
            Err(e) => Answer::wrong(&e.to_string()),
        },
        "save" => match serde_json::from_slice(body) {
            Ok(save) => saved(desk, save),
            Err(e) => Answer::wrong(&e.to_string()),
        },
        "reload" => done(|| watching::reload(desk, true)),
        "stop" => done(|| desk.stop()),
        "run" => done(|| {
            // Files that nobody watches are read again, and end a search of what they were.
            let files = desk.file().is_any_stale();
            desk.wish(Change {
                files,
                ..Change::default()
            });
        }),
        "costs" => of(body, |panel| desk.ask(Task::Costs, panel)),
        "build" => of(body, |panel| desk.ask(Task::Build, panel)),
        "tune" => of(body, |panel| desk.ask(Task::Tune, panel)),
        "stop-search" => of(body, |panel| desk.stop_search(panel)),
        _ => Answer::text(404, "there is nothing of that name\n"),
    }
}

fn done(work: impl FnOnce()) -> Answer {
    work();
    Answer::json(200, &json!({}))
}

/// Does something for the machine that is named.
fn of(body: &[u8], work: impl FnOnce(usize)) -> Answer {
    match serde_json::from_slice(body) {
        Ok(Of { panel }) => done(|| work(panel)),
        Err(e) => Answer::wrong(&e.to_string()),
    }
}

/// An edit as a change, where all that it names is there.
fn change(edit: Edit) -> Result<Change, String> {
    let too_long = |text: &String| text.len() > files::MAX_BYTES;
    if edit.text.as_ref().is_some_and(too_long) {
        return Err("a scene is no longer than some megabytes".to_owned());
    }
    let runs = edit.runs.map(|runs| match runs.len() {
        1..=run::MOST => (runs.into_iter())
            .map(|asked| Run::asked(0, 0, asked))
            .collect::<Result<Vec<Run>, String>>(),
        _ => Err("there are one machine or two".to_owned()),
    });
    let fits = |set: &BTreeMap<String, Vec<f64>>| {
        let numbers =
            |values: &Vec<f64>| values.len() <= MOST.1 && values.iter().all(|v| v.is_finite());
        set.len() <= MOST.0 && set.values().all(numbers)
    };
    if !edit.set.as_ref().is_none_or(fits) {
        return Err("params have up to 3 numbers".to_owned());
    }
    Ok(Change {
        text: edit
            .text
            .map(|text| (text.replace("\r\n", "\n"), edit.page)),
        set: edit.set,
        runs: runs.transpose()?,
        files: false,
    })
}

/// Saves a text, and makes it what is wanted.
fn saved(desk: &Desk, save: Save) -> Answer {
    let text = save.text.replace("\r\n", "\n");
    if text.len() > files::MAX_BYTES {
        return Answer::wrong("a scene is no longer than some megabytes");
    }
    // What the watch has seen of another's text is known, and still not what the page has.
    let written = match !save.force && desk.shown().1.file.elsewhere {
        true => Ok(Saved::Elsewhere),
        false => desk.file().save(&text, save.force),
    };
    match written {
        Ok(Saved::Yes) => {
            if *desk.wanted().text != *text {
                desk.wish(Change {
                    text: Some((text.clone(), save.page)),
                    ..Change::default()
                });
            }
            let saved = *desk.wanted().text == *text;
            desk.show(|shown, _| {
                shown.file.saved = saved;
                shown.file.elsewhere = false;
                shown.file.wrong = None;
            });
            Answer::json(200, &json!({"saved": true}))
        }
        Ok(Saved::Elsewhere) => {
            desk.show(|shown, _| shown.file.elsewhere = true);
            let why = "the file was changed elsewhere since it was read";
            Answer::json(409, &json!({"saved": false, "wrong": why}))
        }
        Err(failure) => {
            let why = failure.reason();
            desk.show(|shown, _| shown.file.wrong = Some(why.clone()));
            Answer::json(500, &json!({"saved": false, "wrong": why}))
        }
    }
}
