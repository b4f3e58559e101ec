//! How a run is watched, timed, limited and stopped; how it may end.

mod driving;
mod frames;
mod history;
mod iteration;
mod pheromone;
mod population;

pub use driving::{DriveView, DriveWay, ReachedView};
pub use frames::{AntFrame, AntFrames, Traffic};
pub use history::{History, Stop};
pub use iteration::{AntWays, ColonyView, IterationRecord, Pheromone, path_of};
pub use pheromone::pheromone_by_cell;
pub use population::PopulationView;

pub(crate) use history::iterate;

use crate::path::CurvePath;
use crate::scenario::ErrorCode;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Watches a run: it sees events, lends its clock, and may cancel.
///
/// `()` watches nothing, has no clock and never cancels.
pub trait Observer {
    /// Something happened.
    fn on_event(&mut self, _event: &Event) {}

    /// Time since the query began, if the observer has a clock; deadlines need one.
    fn elapsed(&mut self) -> Option<Duration> {
        None
    }

    /// Whether the caller wants the run to stop.
    fn is_cancelled(&mut self) -> bool {
        false
    }

    /// Whether it wants to hear of [`Event::Reached`], which takes time to gather.
    fn watches_search(&self) -> bool {
        false
    }
}

impl Observer for () {}

/// What a run tells its observer.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Event<'a> {
    /// The map is ready for queries.
    MapReady,
    /// The fields of the query are ready and the search begins.
    SearchStarted,
    /// Search steps done so far; sent every few hundred steps.
    Progress {
        /// Steps so far.
        n_steps: u64,
    },
    /// A certified path, first or better than the last.
    Improved {
        /// The path, world coordinates.
        path: &'a CurvePath,
        /// Its length in metres.
        length_m: f64,
        /// Search steps so far.
        n_steps: u64,
    },
    /// Ants that drive ended a generation.
    Drive(DriveView<'a>),
    /// Hybrid A* has come farther; told only to whom [watches](Observer::watches_search).
    Reached(ReachedView<'a>),
    /// A colony ended an iteration.
    Iteration(ColonyView<'a>),
    /// A population ended a generation.
    Generation(PopulationView<'a>),
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// A certified path.
    Found,
    /// The search space holds no path.
    NoPath,
    /// The search found a path that the judge refused.
    Infeasible,
    /// The step budget ran out first.
    BudgetExhausted,
    /// The deadline passed first.
    TimedOut,
    /// The caller cancelled.
    Cancelled,
}

impl Status {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Found => "found",
            Self::NoPath => "no_path",
            Self::Infeasible => "infeasible",
            Self::BudgetExhausted => "budget_exhausted",
            Self::TimedOut => "timed_out",
            Self::Cancelled => "cancelled",
        }
    }
}

/// Nav2's code for an ending.
impl From<Status> for ErrorCode {
    fn from(status: Status) -> Self {
        match status {
            Status::Found => Self::None,
            Status::NoPath | Status::Infeasible | Status::BudgetExhausted => Self::NoValidPath,
            Status::TimedOut => Self::Timeout,
            Status::Cancelled => Self::Unknown,
        }
    }
}

/// Counts steps against a budget and, now and then, looks at clock and cancel flag.
pub struct Limits<'a> {
    observer: &'a mut dyn Observer,
    budget_steps: Option<u64>,
    deadline: Option<Duration>,
    n_steps: u64,
    /// Length of the path that was last told.
    told_m: Option<f64>,
    /// Whether paths are parts of one, of which nothing is told.
    tells_no_paths: bool,
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
            n_steps: 0,
            told_m: None,
            tells_no_paths: false,
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

    /// Counts as many of `n_wanted` steps as the budget still allows; how many that were.
    pub fn take(&mut self, n_wanted: u64) -> u64 {
        let n_left = self
            .budget_steps
            .map_or(n_wanted, |budget| budget - self.n_steps);
        let n_taken = n_wanted.min(n_left);
        self.n_steps += n_taken;
        n_taken
    }

    /// Whether the budget allows another step.
    pub fn has_steps_left(&self) -> bool {
        self.budget_steps.is_none_or(|budget| self.n_steps < budget)
    }

    /// Looks at the cancel flag and the clock now.
    ///
    /// # Errors
    /// The status to end with: deadline or cancel.
    pub fn look(&mut self) -> Result<(), Status> {
        if self.observer.is_cancelled() {
            return Err(Status::Cancelled);
        }
        let late = |deadline| self.observer.elapsed().is_some_and(|now| now >= deadline);
        if self.deadline.is_some_and(late) {
            return Err(Status::TimedOut);
        }
        self.observer.on_event(&Event::Progress {
            n_steps: self.n_steps,
        });
        Ok(())
    }

    /// Does a part of the work with at most so many steps more, within the same budget.
    pub fn within<T>(&mut self, n_more: u64, work: impl FnOnce(&mut Self) -> T) -> T {
        let whole = self.budget_steps;
        let part = self.n_steps.saturating_add(n_more);
        self.budget_steps = Some(whole.map_or(part, |budget| budget.min(part)));
        let result = work(self);
        self.budget_steps = whole;
        result
    }

    /// Whether the budget is used up.
    pub fn is_exhausted(&self) -> bool {
        self.budget_steps
            .is_some_and(|budget| self.n_steps >= budget)
    }

    /// The same limits without the budget, for work that is no search step; it shares clock and
    /// cancel flag.
    pub fn without_budget(&mut self) -> Limits<'_> {
        Limits {
            observer: &mut *self.observer,
            budget_steps: None,
            deadline: self.deadline,
            n_steps: 0,
            told_m: self.told_m,
            tells_no_paths: self.tells_no_paths,
        }
    }

    /// The same for work that is mostly short: the clock is looked at only after many steps.
    pub fn aside(&mut self) -> Limits<'_> {
        Limits {
            n_steps: 1,
            ..self.without_budget()
        }
    }

    /// Tells the observer of a certified path, unless it is as long as the one told last.
    pub fn tell_improved(&mut self, path: &CurvePath) {
        let length_m = path.length_m();
        if self.told_m == Some(length_m) || self.tells_no_paths {
            return;
        }
        self.told_m = Some(length_m);
        self.tell(&Event::Improved {
            path,
            length_m,
            n_steps: self.n_steps,
        });
    }

    /// Whether the observer wants to hear how far a search has come.
    pub fn watches_search(&self) -> bool {
        self.observer.watches_search()
    }

    /// Does some work whose paths are parts of the one that is asked for: the observer is not told
    /// of them.
    pub fn in_parts<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let before = std::mem::replace(&mut self.tells_no_paths, true);
        let result = work(self);
        self.tells_no_paths = before;
        result
    }

    /// Tells the observer something.
    pub fn tell(&mut self, event: &Event) {
        self.observer.on_event(event);
    }

    /// Steps counted so far.
    pub fn n_steps(&self) -> u64 {
        self.n_steps
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

    #[test]
    fn a_deadline_is_seen_between_strides() {
        let mut watch = Stopwatch(0);
        let mut limits = Limits::new(&mut watch, None, Some(Duration::from_secs(3)));
        let n_ok = (0..10_000).take_while(|_| limits.step().is_ok()).count() as u64;
        assert_eq!(n_ok, 2 * Limits::STRIDE);
    }
}
