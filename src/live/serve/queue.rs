//! What the machines' worker is to do: a queue in which each thing stands once.
//!
//! It is no longer than there are kinds of things and machines, whatever is asked for.

use crate::interrupt::Job;
use crate::live::board::Task;
use crate::live::run::Run;
use crate::scene::Scene;
use std::sync::Arc;

/// What is to be done for which machine.
pub type Place = (Task, usize);

/// Something for a machine: a run, its scene, and what ends it.
pub struct Errand {
    /// What.
    pub task: Task,
    /// For which machine.
    pub run: Run,
    /// The scene, right and drawn.
    pub scene: Arc<Scene>,
    /// To be worked for.
    pub job: Job,
}

/// The queue.
pub struct Queue {
    /// Runs come by themselves, and first.
    waiting: Vec<Place>,
    /// What is being done, and for which run.
    doing: Option<(Place, u64)>,
    /// What ends it.
    job: Job,
}

impl Queue {
    /// With the first machine's run.
    pub fn new() -> Queue {
        Queue {
            waiting: vec![(Task::Run, 0)],
            doing: None,
            job: Job::default(),
        }
    }

    /// Something is to be done for a run of such a number, unless just that is being done: a
    /// search is of any number, as it goes on only while it would be the same.
    pub fn ask(&mut self, place: Place, serial: u64) {
        let (of, number) = self.doing.unzip();
        let same = number == Some(serial) || place.0 == Task::Tune;
        let doing = of == Some(place) && same && !self.job.is_stopped();
        if !doing && !self.has(place) {
            self.waiting.push(place);
        }
        // Whoever asked for more than runs waits for these.
        self.waiting
            .sort_by_key(|(task, _)| u8::from(*task != Task::Run));
    }

    /// Nothing of some kind is done for a machine any more.
    pub fn no_more(&mut self, panel: usize, kind: impl Fn(Task) -> bool) {
        let is_one = |&(task, of): &Place| of == panel && kind(task);
        self.waiting.retain(|place| !is_one(place));
        if self.doing.is_some_and(|(place, _)| is_one(&place)) {
            self.job.stop();
        }
    }

    /// Nothing is done any more.
    pub fn clear(&mut self) {
        self.waiting.clear();
        self.job.stop();
    }

    /// Whether something waits.
    pub fn has(&self, place: Place) -> bool {
        self.waiting.contains(&place)
    }

    /// Whether nothing waits.
    pub fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// The worker asks what is next: it does nothing now.
    pub fn idle(&mut self) {
        self.doing = None;
    }

    /// The next thing, which is no longer waited for.
    pub fn take(&mut self) -> Option<Place> {
        (!self.waiting.is_empty()).then(|| self.waiting.remove(0))
    }

    /// Something is begun; answers the job that it is done for.
    pub fn begin(&mut self, place: Place, serial: u64) -> Job {
        self.job = Job::default();
        self.doing = Some((place, serial));
        self.job.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_thing_stands_once_and_runs_come_first() {
        let mut queue = Queue::new();
        for _ in 0..9 {
            queue.ask((Task::Tune, 0), 1);
            queue.ask((Task::Run, 1), 1);
        }
        assert_eq!(queue.take(), Some((Task::Run, 0)));
        let job = queue.begin((Task::Run, 0), 1);
        queue.ask((Task::Run, 0), 1);
        queue.no_more(0, |task| task == Task::Tune);
        assert!(!job.is_stopped());
        queue.no_more(0, |_| true);
        assert!(job.is_stopped());
        assert!(!queue.has((Task::Tune, 0)));
        // What was stopped is done again, though its worker has not come back yet.
        queue.ask((Task::Run, 0), 1);
        let next = [queue.take(), queue.take(), queue.take()];
        assert_eq!(next, [Some((Task::Run, 1)), Some((Task::Run, 0)), None]);
        // A search that goes on is not asked for twice, whatever its run's number is now.
        queue.begin((Task::Tune, 0), 1);
        queue.ask((Task::Tune, 0), 2);
        assert!(queue.is_empty());
    }
}
