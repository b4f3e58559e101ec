//! Observers of a query: events, a clock, a cancel flag.

use super::{ColonyView, DriveView, PopulationView, ReachedView};
use crate::path::CurvePath;
use std::time::Duration;

/// Watches a query: receives its events, lends it a clock, and may cancel it.
///
/// `()` ignores everything, [`StdClock`](super::StdClock) lends the system's clock, and
/// [`CancelToken`](super::CancelToken) cancels from any thread. A pair of observers is an observer:
/// both receive every event, the first that has a clock lends it, and either may cancel.
///
/// ```
/// use formicar::progress::{Event, Observer};
///
/// struct Lengths(Vec<f64>);
///
/// impl Observer for Lengths {
///     fn on_event(&mut self, event: &Event) {
///         if let Event::Improved { length_m, .. } = event {
///             self.0.push(*length_m);
///         }
///     }
/// }
/// ```
pub trait Observer {
    /// Receives an event.
    fn on_event(&mut self, _event: &Event) {}

    /// Time since the query began, if the observer has a clock; deadlines need one.
    fn elapsed(&mut self) -> Option<Duration> {
        None
    }

    /// True once the query is to stop, and from then on.
    fn is_cancelled(&mut self) -> bool {
        false
    }

    /// True if the observer wants [`Event::Reached`], which takes time to gather.
    fn watches_search(&self) -> bool {
        false
    }
}

impl Observer for () {}

impl<O: Observer + ?Sized> Observer for &mut O {
    fn on_event(&mut self, event: &Event) {
        (**self).on_event(event);
    }

    fn elapsed(&mut self) -> Option<Duration> {
        (**self).elapsed()
    }

    fn is_cancelled(&mut self) -> bool {
        (**self).is_cancelled()
    }

    fn watches_search(&self) -> bool {
        (**self).watches_search()
    }
}

impl<O: Observer> Observer for Option<O> {
    fn on_event(&mut self, event: &Event) {
        if let Some(observer) = self {
            observer.on_event(event);
        }
    }

    fn elapsed(&mut self) -> Option<Duration> {
        self.as_mut()?.elapsed()
    }

    fn is_cancelled(&mut self) -> bool {
        self.as_mut().is_some_and(Observer::is_cancelled)
    }

    fn watches_search(&self) -> bool {
        self.as_ref().is_some_and(Observer::watches_search)
    }
}

impl<A: Observer, B: Observer> Observer for (A, B) {
    fn on_event(&mut self, event: &Event) {
        self.0.on_event(event);
        self.1.on_event(event);
    }

    fn elapsed(&mut self) -> Option<Duration> {
        self.0.elapsed().or_else(|| self.1.elapsed())
    }

    fn is_cancelled(&mut self) -> bool {
        self.0.is_cancelled() || self.1.is_cancelled()
    }

    fn watches_search(&self) -> bool {
        self.0.watches_search() || self.1.watches_search()
    }
}

/// An event of a query.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Event<'a> {
    /// The map is ready for queries.
    MapReady,
    /// The fields of the query are ready and the search begins.
    SearchStarted,
    /// The number of search steps so far, every few hundred steps or less, and while a query is
    /// prepared or a path smoothed. It never falls within a query.
    Progress {
        /// Steps so far.
        n_steps: u64,
    },
    /// A certified path, first or better than the last.
    Improved {
        /// The path, world coordinates.
        path: &'a CurvePath,
        /// Its length in meters.
        length_m: f64,
        /// Search steps so far.
        n_steps: u64,
    },
    /// Ants that drive ended a generation.
    Drive(DriveView<'a>),
    /// Hybrid A* has reached further states; sent only to an observer that
    /// [watches the search](Observer::watches_search).
    Reached(ReachedView<'a>),
    /// A colony ended an iteration.
    Iteration(ColonyView<'a>),
    /// A population ended a generation.
    Generation(PopulationView<'a>),
}
