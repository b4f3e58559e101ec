//! Independent pieces of work on several threads.

use anyhow::Result;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What each of `0..n` comes to, in that order, on up to `n_jobs` threads. What fails first by
/// number is the error.
pub(crate) fn map<T: Send>(
    n_jobs: usize,
    n: usize,
    work: impl Fn(usize) -> Result<T> + Sync,
) -> Result<Vec<T>> {
    if n_jobs <= 1 || n <= 1 {
        return (0..n).map(work).collect();
    }
    let next = AtomicUsize::new(0);
    let slots: Vec<Mutex<Option<Result<T>>>> = (0..n).map(|_| Mutex::new(None)).collect();
    let work_off = || {
        while let Some(slot) = take(&next, &slots) {
            let done = work(slot.0);
            if let Ok(mut place) = slot.1.lock() {
                *place = Some(done);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..n_jobs.min(n) {
            scope.spawn(work_off);
        }
    });
    let done = slots.into_iter().map(|slot| {
        let slot = slot.into_inner().unwrap_or_default();
        slot.unwrap_or_else(|| Err(anyhow::anyhow!("a thread ended before its work")))
    });
    done.collect()
}

/// The next piece that nobody has taken, and its number.
fn take<'a, T>(next: &AtomicUsize, slots: &'a [T]) -> Option<(usize, &'a T)> {
    let i = next.fetch_add(1, Ordering::Relaxed);
    Some((i, slots.get(i)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_and_errors_do_not_depend_on_threads() {
        let square = |i: usize| Ok(i * i);
        assert_eq!(map(1, 9, square).unwrap(), map(3, 9, square).unwrap());
        let fails = |i: usize| {
            anyhow::ensure!(i < 4, "{i} is too many");
            Ok(i)
        };
        for n_jobs in [1, 3] {
            let error = map(n_jobs, 9, fails).unwrap_err();
            assert_eq!(error.to_string(), "4 is too many");
        }
    }
}
