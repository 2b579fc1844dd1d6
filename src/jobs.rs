//! Several works at the same time, with answers in the order of the questions.
//!
//! A machine runs on one thread; a table of scenes and targets is many machines.
//! These threads are not rayon's: a work waits for rows that rayon's threads
//! draw, and a thread of rayon's that waits may begin another work inside.

#[cfg(not(target_family = "wasm"))]
use crate::draw::STACK;
use crate::failure::{Failure, Outcome};
use crate::interrupt;
#[cfg(not(target_family = "wasm"))]
use std::sync::atomic::{AtomicUsize, Ordering};
#[cfg(not(target_family = "wasm"))]
use std::sync::mpsc;

/// Does the work for each item, as many at a time as there are processors.
///
/// # Errors
/// Only an interruption, or that no thread could be had: how the works went is
/// in the answers.
pub fn each<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(&T) -> Outcome<R> + Sync,
) -> Outcome<Vec<Outcome<R>>> {
    each_told(items, work, |_, _| ())
}

/// The same, where whoever asks is told each answer as it comes, on its own thread: what it
/// does with it need not be shared between threads.
///
/// # Errors
/// As for [`each`].
pub fn each_told<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(&T) -> Outcome<R> + Sync,
    mut told: impl FnMut(&T, &Outcome<R>),
) -> Outcome<Vec<Outcome<R>>> {
    let mut done: Vec<Option<Outcome<R>>> = items.iter().map(|_| None).collect();
    answers(items, work, |k, answer| {
        if let Some((item, place)) = items.get(k).zip(done.get_mut(k)) {
            told(item, &answer);
            *place = Some(answer);
        }
    })?;
    interrupt::check()?;
    // Not reached: each item was served, and a panic has ended the scope.
    let served = |place: Option<Outcome<R>>| place.unwrap_or(Err(Failure::Interrupted));
    Ok(done.into_iter().map(served).collect())
}

/// Does the work on threads; answers are heard on the thread that asks.
#[cfg(not(target_family = "wasm"))]
fn answers<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(&T) -> Outcome<R> + Sync,
    mut heard: impl FnMut(usize, Outcome<R>),
) -> Outcome<()> {
    let next = AtomicUsize::new(0);
    let (says, said) = mpsc::channel();
    let job = interrupt::job();
    let work = |item: &T| interrupt::on_behalf(job.as_ref(), || work(item));
    let stopped = || interrupt::on_behalf(job.as_ref(), interrupt::pressed);
    let (next, work, stopped) = (&next, &work, &stopped);
    let threads = rayon::current_num_threads().clamp(1, items.len().max(1));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            let says = says.clone();
            let serve = move || {
                while let Some((k, item)) = {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    items.get(k).map(|item| (k, item))
                } {
                    // Whoever asked may have had enough.
                    if stopped() || says.send((k, work(item))).is_err() {
                        return;
                    }
                }
            };
            let thread = std::thread::Builder::new().stack_size(STACK);
            thread
                .spawn_scoped(scope, serve)
                .map_err(|e| Failure::Wrong(format!("cannot start a thread: {e}")))?;
        }
        drop(says);
        said.into_iter().for_each(|(k, answer)| heard(k, answer));
        Ok(())
    })
}

/// Where there are no threads, one after the other.
#[cfg(target_family = "wasm")]
fn answers<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(&T) -> Outcome<R> + Sync,
    mut heard: impl FnMut(usize, Outcome<R>),
) -> Outcome<()> {
    for (k, item) in items.iter().enumerate() {
        interrupt::check()?;
        heard(k, work(item));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_come_in_order() {
        let items: Vec<u64> = (0..100).collect();
        let mut heard = Vec::new();
        let work = |n: &u64| match n % 3 {
            0 => Err(Failure::Wrong(n.to_string())),
            _ => Ok(n * n),
        };
        let answers = each_told(&items, work, |n, answer| {
            assert_eq!(answer.is_ok(), n % 3 != 0);
            heard.push(*n);
        });
        heard.sort_unstable();
        assert_eq!(heard, items);
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
