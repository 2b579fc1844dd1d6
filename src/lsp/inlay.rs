//! Figures behind lines: which scenes are measured, when, and what is shown of it.

use super::look::At;
use super::measure::{Done, Measured, Work};
use super::state::State;
use super::text::{Lines, path_of};
use crossbeam_channel::{Receiver, Sender, unbounded};
use lsp_types::{InlayHint, InlayHintLabel, InlayHintTooltip, Position, Range, Uri};
use slowlight_compiler::targets::Target;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// How long nothing must have been edited before a scene is measured.
const QUIET: Duration = Duration::from_millis(700);

/// What was measured, and what is to be.
pub struct Inlays {
    target: Option<&'static Target>,
    found: BTreeMap<String, Measured>,
    /// Scenes that are to be measured, the last first, and when one was last edited.
    wanted: Vec<Uri>,
    edited: Instant,
    work: Option<Work>,
    works: u64,
    tell: Sender<Done>,
    /// Where works tell what they found.
    pub told: Receiver<Done>,
}

impl Default for Inlays {
    fn default() -> Self {
        let (tell, told) = unbounded();
        Inlays {
            target: None,
            found: BTreeMap::new(),
            wanted: Vec::new(),
            edited: Instant::now(),
            work: None,
            works: 0,
            tell,
            told,
        }
    }
}

impl Inlays {
    /// Measures for another machine, or for none.
    pub fn measure_for<'u>(
        &mut self,
        target: Option<&'static Target>,
        open: impl Iterator<Item = &'u Uri>,
    ) {
        if self.target.map(|t| t.name) == target.map(|t| t.name) {
            return;
        }
        self.target = target;
        self.work = None;
        self.found.clear();
        self.wanted = open.cloned().collect();
    }

    /// A text was opened or edited: what is measured of it is of no use.
    pub fn edited(&mut self, uri: &Uri) {
        self.edited = Instant::now();
        if self.work.as_ref().is_some_and(|work| work.uri() == uri) {
            self.work = None;
        }
        self.wanted.retain(|wanted| wanted != uri);
        self.wanted.push(uri.clone());
    }

    /// A text was closed.
    pub fn closed(&mut self, uri: &Uri) {
        if self.work.as_ref().is_some_and(|work| work.uri() == uri) {
            self.work = None;
        }
        self.wanted.retain(|wanted| wanted != uri);
        self.found.remove(uri.as_str());
    }

    /// How long until something is to be measured; none where nothing is.
    pub fn due(&self) -> Option<Duration> {
        let idle = self.work.is_none() && self.target.is_some() && !self.wanted.is_empty();
        idle.then(|| QUIET.saturating_sub(self.edited.elapsed()))
    }

    /// Begins to measure, if it is time. What is wrong, or no scene, is not measured.
    pub fn begin(&mut self, state: &State) {
        let Some(target) = self.target.filter(|_| self.due() == Some(Duration::ZERO)) else {
            return;
        };
        while let Some(uri) = self.wanted.pop() {
            let document = state.documents.get(uri.as_str());
            let right = state.known(&uri).is_some_and(|known| {
                known.is_right() && known.is_scene() && *known.root_uri() == uri
            });
            let Some(document) = document.filter(|_| right) else {
                continue;
            };
            let path = path_of(&uri);
            let dir = path.as_deref().and_then(std::path::Path::parent);
            let tell = self.tell.clone();
            // Nobody waits for what comes when the server has ended.
            let tell = move |done| drop(tell.send(done));
            self.works += 1;
            self.work = Work::begin(self.works, (&uri, &document.text), dir, target, tell).ok();
            return;
        }
    }

    /// Takes in what a work found; answers whether there is something to show. Why nothing
    /// was found is answered, too: the scene may not fit the machine.
    pub fn done(&mut self, done: Done) -> Result<bool, String> {
        if self
            .work
            .as_ref()
            .is_none_or(|work| work.number() != done.work)
        {
            return Ok(false);
        }
        self.work = None;
        let measured = done.found?;
        self.found.insert(done.uri.as_str().to_owned(), measured);
        Ok(true)
    }

    /// The figures of a text between two lines.
    pub fn hints(&self, of: At<'_>, uri: &Uri, range: Range) -> Vec<InlayHint> {
        let Some(found) = self.found.get(uri.as_str()) else {
            return Vec::new();
        };
        let old = found.text != of.text;
        let lines = Lines::new(of.text);
        let mut byte = 0;
        let ends: Vec<Position> = of
            .text
            .split('\n')
            .map(|line| {
                let end = byte + line.trim_end().len();
                byte += line.len() + 1;
                lines.position(of.text, end)
            })
            .collect();
        let shown = found.now(of.text).into_iter().filter_map(|(line, cost)| {
            let position = *ends.get(line)?;
            let inside = range.start.line <= position.line && position.line <= range.end.line;
            inside.then(|| InlayHint {
                position,
                label: InlayHintLabel::String(cost.label(&found.unit, old)),
                kind: None,
                text_edits: None,
                tooltip: Some(InlayHintTooltip::String(cost.tooltip(found.target, old))),
                padding_left: Some(true),
                padding_right: None,
                data: None,
            })
        });
        shown.collect()
    }
}
