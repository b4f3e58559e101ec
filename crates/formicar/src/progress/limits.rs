//! The limits of a query: a step budget, a deadline, and the caller's cancellation.

use super::{Event, Observer, Status};
use crate::path::CurvePath;
use std::time::Duration;

/// The last path is judged and measured in this many times as long as one is judged.
const JUDGEMENTS_KEPT: u32 = 3;

/// Counts steps against a budget and, every few hundred steps, looks at the clock and the cancel
/// flag of the observer.
///
/// ```
/// use formicar::progress::{Limits, Status};
///
/// let mut observer = ();
/// let mut limits = Limits::new(&mut observer, Some(2), None);
/// assert!(limits.step().is_ok() && limits.step().is_ok());
/// assert_eq!(limits.step(), Err(Status::BudgetExhausted));
/// ```
pub struct Limits<'a> {
    observer: &'a mut dyn Observer,
    budget_steps: Option<u64>,
    deadline: Option<Duration>,
    /// Time before the deadline that is kept for the last judgement of a path.
    kept: Duration,
    n_steps: u64,
    /// Steps of the query that observers are told of during work that does not count as search.
    told_steps: Option<u64>,
    /// Length of the path that was reported last.
    reported_m: Option<f64>,
    /// True while paths are legs of the one that is asked for, and are not reported.
    hides_paths: bool,
}

impl<'a> Limits<'a> {
    /// Steps between two looks at the clock.
    const STRIDE: u64 = 256;

    /// Limits of one query.
    pub fn new(
        observer: &'a mut dyn Observer,
        budget_steps: Option<u64>,
        deadline: Option<Duration>,
    ) -> Self {
        Self {
            observer,
            budget_steps,
            deadline,
            kept: Duration::ZERO,
            n_steps: 0,
            told_steps: None,
            reported_m: None,
            hides_paths: false,
        }
    }

    /// Counts a step.
    ///
    /// # Errors
    /// The status to end with: budget, deadline or cancel.
    pub fn step(&mut self) -> Result<(), Status> {
        if self.is_exhausted() {
            return Err(Status::BudgetExhausted);
        }
        self.n_steps += 1;
        if self.n_steps % Self::STRIDE == 1 {
            return self.look();
        }
        Ok(())
    }

    /// Counts a step that takes much longer than one of a search over cells, and looks.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn long_step(&mut self) -> Result<(), Status> {
        self.step()?;
        self.look()
    }

    /// Counts as many of `n_wanted` steps as the budget still allows, and returns their number.
    pub fn take(&mut self, n_wanted: u64) -> u64 {
        let n_left = self
            .budget_steps
            .map_or(n_wanted, |budget| budget - self.n_steps);
        let n_taken = n_wanted.min(n_left);
        self.n_steps += n_taken;
        n_taken
    }

    /// True while the budget allows another step.
    pub fn has_steps_left(&self) -> bool {
        self.budget_steps.is_none_or(|budget| self.n_steps < budget)
    }

    /// Looks at the cancel flag and the clock now, and sends [`Event::Progress`].
    ///
    /// # Errors
    /// The status to end with: deadline or cancel.
    pub fn look(&mut self) -> Result<(), Status> {
        if self.observer.is_cancelled() {
            return Err(Status::Cancelled);
        }
        let kept = self.kept;
        let late = |deadline| {
            self.observer
                .elapsed()
                .is_some_and(|now| now + kept >= deadline)
        };
        if self.deadline.is_some_and(late) {
            return Err(Status::TimedOut);
        }
        let n_steps = self.told_steps();
        self.observer.on_event(&Event::Progress { n_steps });
        Ok(())
    }

    /// Judges a path, and keeps as much time before the deadline as judging and measuring the last
    /// one will take, at most a tenth of the whole.
    pub(crate) fn keeping_time<T>(&mut self, judge: impl FnOnce(&mut Self) -> T) -> T {
        let Some(deadline) = self.deadline else {
            return judge(self);
        };
        let begun = self.observer.elapsed();
        let result = judge(self);
        let time = self.observer.elapsed().zip(begun);
        let taken = time.map_or(Duration::ZERO, |(now, begun)| now.saturating_sub(begun));
        self.kept = self.kept.max(JUDGEMENTS_KEPT * taken).min(deadline / 10);
        result
    }

    /// True once the query is cancelled.
    pub(crate) fn is_cancelled(&mut self) -> bool {
        self.observer.is_cancelled()
    }

    /// Does a part of the work with at most `n_more` further steps, within the same budget.
    pub fn within<T>(&mut self, n_more: u64, work: impl FnOnce(&mut Self) -> T) -> T {
        let whole = self.budget_steps;
        let part = self.n_steps.saturating_add(n_more);
        self.budget_steps = Some(whole.map_or(part, |budget| budget.min(part)));
        let result = work(self);
        self.budget_steps = whole;
        result
    }

    /// True once the budget is used up.
    pub fn is_exhausted(&self) -> bool {
        self.budget_steps
            .is_some_and(|budget| self.n_steps >= budget)
    }

    /// The same deadline and cancel flag without the budget, for work that does not count as
    /// search: it has a count of its own, while observers are told that of the query, which stands
    /// still.
    pub fn without_budget(&mut self) -> Limits<'_> {
        let told_steps = Some(self.told_steps());
        Limits {
            observer: &mut *self.observer,
            budget_steps: None,
            deadline: self.deadline,
            kept: self.kept,
            n_steps: 0,
            told_steps,
            reported_m: self.reported_m,
            hides_paths: self.hides_paths,
        }
    }

    /// Like [`Self::without_budget`], for work that is mostly short: the first look at the clock
    /// comes only after many steps.
    pub fn aside(&mut self) -> Limits<'_> {
        Limits {
            n_steps: 1,
            ..self.without_budget()
        }
    }

    /// The cancel flag alone, for what is still worth doing after the deadline.
    pub(crate) fn without_deadline(&mut self) -> Limits<'_> {
        let n_steps = self.n_steps;
        Limits {
            deadline: None,
            n_steps,
            ..self.without_budget()
        }
    }

    /// Reports a certified path to the observer, unless it is as long as the one before.
    pub fn tell_improved(&mut self, path: &CurvePath) {
        let length_m = path.length_m();
        if self.reported_m == Some(length_m) || self.hides_paths {
            return;
        }
        self.reported_m = Some(length_m);
        self.tell(&Event::Improved {
            path,
            length_m,
            n_steps: self.told_steps(),
        });
    }

    /// True if the observer wants [`Event::Reached`].
    pub fn watches_search(&self) -> bool {
        self.observer.watches_search()
    }

    /// Does work whose paths are legs of the one that is asked for, without reporting them.
    pub fn in_parts<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let before = std::mem::replace(&mut self.hides_paths, true);
        let result = work(self);
        self.hides_paths = before;
        result
    }

    /// Sends an event to the observer.
    pub fn tell(&mut self, event: &Event) {
        self.observer.on_event(event);
    }

    /// Steps counted so far.
    pub fn n_steps(&self) -> u64 {
        self.n_steps
    }

    /// Steps of the query that observers are told of.
    fn told_steps(&self) -> u64 {
        self.told_steps.unwrap_or(self.n_steps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Stopwatch(u64);

    impl Observer for Stopwatch {
        fn elapsed(&mut self) -> Option<Duration> {
            self.0 += 1;
            Some(Duration::from_secs(self.0))
        }
    }

    #[test]
    fn a_budget_of_n_allows_n_steps() {
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, Some(3), None);
        assert!((0..3).all(|_| limits.step().is_ok()));
        assert_eq!(limits.step(), Err(Status::BudgetExhausted));
        assert_eq!(limits.n_steps(), 3);
    }

    #[test]
    fn steps_are_taken_while_the_budget_lasts() {
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, Some(5), None);
        assert_eq!([3, 3, 3].map(|n| limits.take(n)), [3, 2, 0]);
        assert_eq!(limits.n_steps(), 5);
    }

    struct Steps(Vec<u64>);

    impl Observer for Steps {
        fn on_event(&mut self, event: &Event) {
            if let Event::Progress { n_steps } = event {
                self.0.push(*n_steps);
            }
        }
    }

    #[test]
    fn work_aside_tells_the_steps_of_the_query() {
        let mut told = Steps(Vec::new());
        let mut limits = Limits::new(&mut told, None, None);
        limits.without_budget().long_step().unwrap();
        limits.take(300);
        limits.look().unwrap();
        limits.aside().long_step().unwrap();
        limits
            .without_budget()
            .without_deadline()
            .long_step()
            .unwrap();
        limits.long_step().unwrap();
        assert_eq!(told.0, [0, 0, 300, 300, 300, 300, 301]);
    }

    #[test]
    fn a_deadline_is_seen_between_strides() {
        let mut watch = Stopwatch(0);
        let mut limits = Limits::new(&mut watch, None, Some(Duration::from_secs(3)));
        let n_ok = (0..10_000).take_while(|_| limits.step().is_ok()).count() as u64;
        assert_eq!(n_ok, 2 * Limits::STRIDE);
    }
}
