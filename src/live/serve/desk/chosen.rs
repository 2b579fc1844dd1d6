//! What becomes of machines, frontiers and what waits, once others are chosen.

use super::Inner;
use crate::live::board::{Task, Views};
use crate::live::run::{MOST, Run};
use crate::live::shown::{Chosen, ChosenRun, Frontier, Panel};

impl Inner {
    /// Takes machines, all as if they were new (`whole`) or only those that are others than
    /// before; what was begun for the old ones is in vain. Where text, values or files are
    /// others (`other`), so is what accuracy costs.
    pub(super) fn runs(&mut self, mut runs: Vec<Run>, serial: u64, (whole, other): (bool, bool)) {
        runs.truncate(MOST);
        for (panel, run) in runs.iter_mut().enumerate() {
            run.panel = panel;
            let before = self.wish.runs.get(panel);
            let same = before.filter(|before| !whole && before.is_like(run));
            run.serial = same.map_or(serial, |before| before.serial);
        }
        let before = std::mem::replace(&mut self.wish.runs, runs);
        for panel in 0..MOST {
            let (now, before) = (self.wish.runs.get(panel), before.get(panel));
            let number = |run: &Run| run.serial;
            if now.map(number) == before.map(number) {
                continue;
            }
            if let Some(before) = before
                && self.queue.has((Task::Build, panel))
            {
                // What would be written now is not what was asked for.
                let why = "not built: something else was chosen before its turn came";
                (self.shown).build(before.target.name, Vec::new(), Some(why.to_owned()));
            }
            let Some(now) = now else {
                self.shown.panels[panel] = Panel::default();
                self.pictures.machines[panel] = Views::default();
                self.searched[panel] = None;
                self.queue.no_more(panel, |_| true);
                continue;
            };
            let same = !other && before.is_some_and(|before| now.has_frontier_of(before));
            if before.is_none_or(|before| before.target.name != now.target.name) {
                // None of its points can be had there.
                self.shown.panels[panel].frontier = Frontier::default();
                self.searched[panel] = None;
            }
            // A search goes on while others of its points are looked at, and all is run again.
            self.queue
                .no_more(panel, |task| !same || task != Task::Tune);
            self.queue.ask((Task::Run, panel), now.serial);
        }
    }

    /// What was chosen is shown.
    pub(super) fn chosen(&mut self, by: &str) {
        let wish = &self.wish;
        self.shown.text.revision = self.revision;
        by.clone_into(&mut self.shown.text.by);
        self.shown.chosen = Chosen {
            serial: wish.serial,
            set: wish.set.clone(),
            runs: wish.runs.iter().map(ChosenRun::from).collect(),
        };
    }
}
