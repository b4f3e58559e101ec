//! Independent pieces of work on several threads.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Works on `0..n` with up to `n_jobs` threads and hands every result over as it arrives, with its
/// number. Nothing new is begun after `on_done` fails.
///
/// # Errors
/// The first failure of `on_done`.
pub fn each<T: Send, E>(
    n_jobs: usize,
    n: usize,
    work: impl Fn(usize) -> T + Sync,
    mut on_done: impl FnMut(usize, T) -> Result<(), E>,
) -> Result<(), E> {
    if n_jobs <= 1 || n <= 1 {
        return (0..n).try_for_each(|i| on_done(i, work(i)));
    }
    let next = AtomicUsize::new(0);
    thread::scope(|scope| {
        let (sender, results) = mpsc::channel();
        for _ in 0..n_jobs.min(n) {
            let (sender, next, work) = (sender.clone(), &next, &work);
            scope.spawn(move || {
                let take = || Some(next.fetch_add(1, Ordering::Relaxed)).filter(|i| *i < n);
                // The receiver is gone after a failure.
                std::iter::from_fn(take).all(|i| sender.send((i, work(i))).is_ok())
            });
        }
        drop(sender);
        results
            .into_iter()
            .try_for_each(|(i, result)| on_done(i, result))
    })
}

/// Like [`each`], but results are handed over in order.
///
/// # Errors
/// The first failure of `on_done`.
pub fn in_order<T: Send, E>(
    n_jobs: usize,
    n: usize,
    work: impl Fn(usize) -> T + Sync,
    mut on_done: impl FnMut(T) -> Result<(), E>,
) -> Result<(), E> {
    let (mut waiting, mut n_done) = (BTreeMap::new(), 0);
    each(n_jobs, n, work, |i, result| {
        waiting.insert(i, result);
        while let Some(result) = waiting.remove(&n_done) {
            n_done += 1;
            on_done(result)?;
        }
        Ok(())
    })
}

/// The results of work on `0..n`, in order.
///
/// # Errors
/// The failure with the lowest number.
pub fn map<T: Send, E: Send>(
    n_jobs: usize,
    n: usize,
    work: impl Fn(usize) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    let mut all = Vec::with_capacity(n);
    in_order(n_jobs, n, work, |result| {
        all.push(result?);
        Ok(())
    })?;
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::{Result, ensure};

    #[test]
    fn order_and_errors_do_not_depend_on_threads() {
        let square = |i: usize| anyhow::Ok(i * i);
        assert_eq!(map(1, 9, square).unwrap(), map(3, 9, square).unwrap());
        let fails = |i: usize| -> Result<usize> {
            ensure!(i < 4, "{i} is too many");
            Ok(i)
        };
        for n_jobs in [1, 3] {
            let error = map(n_jobs, 9, fails).unwrap_err();
            assert_eq!(error.to_string(), "4 is too many");
        }
    }

    #[test]
    fn every_result_is_handed_over_once() {
        for n_jobs in [1, 4] {
            let mut met = Vec::new();
            let done = each(
                n_jobs,
                20,
                |i| i,
                |i, result| {
                    assert_eq!(i, result);
                    met.push(i);
                    anyhow::Ok(())
                },
            );
            done.unwrap();
            met.sort_unstable();
            assert_eq!(met, (0..20).collect::<Vec<_>>());
        }
    }
}
