//! Several works at the same time, with answers in the order of the questions.
//!
//! A machine runs on one thread; a table of scenes and targets is many machines.
//! These threads are not rayon's: a work waits for rows that rayon's threads
//! draw, and a thread of rayon's that waits may begin another work inside.

use crate::draw::STACK;
use crate::failure::{Failure, Outcome};
use crate::interrupt;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Does the work for each item, as many at a time as there are processors.
///
/// # Errors
/// Only an interruption, or that no thread could be had: how the works went is
/// in the answers.
pub fn each<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(&T) -> Outcome<R> + Sync,
) -> Outcome<Vec<Outcome<R>>> {
    let next = AtomicUsize::new(0);
    let done: Vec<Mutex<Option<Outcome<R>>>> = items.iter().map(|_| Mutex::new(None)).collect();
    let job = interrupt::job();
    let work = |item: &T| interrupt::on_behalf(job.as_ref(), || work(item));
    let stopped = || interrupt::on_behalf(job.as_ref(), interrupt::pressed);
    let serve = || {
        while let Some((item, place)) = {
            let k = next.fetch_add(1, Ordering::Relaxed);
            items.get(k).zip(done.get(k))
        } {
            if stopped() {
                return;
            }
            let answer = work(item);
            if let Ok(mut place) = place.lock() {
                *place = Some(answer);
            }
        }
    };
    let threads = rayon::current_num_threads().clamp(1, items.len().max(1));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            let thread = std::thread::Builder::new().stack_size(STACK);
            thread
                .spawn_scoped(scope, serve)
                .map_err(|e| Failure::Wrong(format!("cannot start a thread: {e}")))?;
        }
        Ok(())
    })?;
    interrupt::check()?;
    let answers = done.into_iter().map(|place| match place.into_inner() {
        Ok(Some(answer)) => answer,
        // Not reached: each item was served, and a panic has ended the scope.
        _ => Err(Failure::Interrupted),
    });
    Ok(answers.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_come_in_order() {
        let items: Vec<u64> = (0..100).collect();
        let answers = each(&items, |n| match n % 3 {
            0 => Err(Failure::Wrong(n.to_string())),
            _ => Ok(n * n),
        });
        for (n, answer) in answers.expect("no interruption").into_iter().enumerate() {
            match answer {
                Ok(square) => assert_eq!(square, (n * n) as u64),
                Err(Failure::Wrong(text)) => assert_eq!(text, n.to_string()),
                Err(other) => panic!("{other:?}"),
            }
        }
        assert!(
            each(&[(); 0], |()| Ok(()))
                .expect("nothing to do")
                .is_empty()
        );
    }
}
