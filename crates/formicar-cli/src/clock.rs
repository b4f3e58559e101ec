//! What watches a query: a clock that remembers when the first path was certified, and whoever
//! keeps its ants.

use formicar::progress::{AntFrames, Event, Observer};
use std::time::{Duration, Instant};

/// Lends time to a query and notes its certified paths.
#[derive(Debug)]
pub(crate) struct Clock {
    begun: Instant,
    first_feasible: Option<Duration>,
    n_paths: u32,
}

impl Clock {
    /// A query begins now.
    pub(crate) fn begin() -> Self {
        Self {
            begun: Instant::now(),
            first_feasible: None,
            n_paths: 0,
        }
    }

    /// Seconds since the query began.
    pub(crate) fn query_s(&self) -> f64 {
        self.begun.elapsed().as_secs_f64()
    }

    /// Seconds from the beginning to the first certified path.
    pub(crate) fn first_feasible_s(&self) -> Option<f64> {
        self.first_feasible.map(|d| d.as_secs_f64())
    }

    /// How often a certified path was replaced by a better one.
    pub(crate) fn n_improvements(&self) -> u32 {
        self.n_paths.saturating_sub(1)
    }
}

impl Observer for Clock {
    fn on_event(&mut self, event: &Event) {
        if let Event::Improved { .. } = event {
            self.n_paths += 1;
            self.first_feasible.get_or_insert(self.begun.elapsed());
        }
    }

    fn elapsed(&mut self) -> Option<Duration> {
        Some(self.begun.elapsed())
    }
}

/// A clock, and ants kept for a picture where one is wanted.
#[derive(Debug)]
pub(crate) struct Watch<'a> {
    pub(crate) clock: Clock,
    pub(crate) ants: Option<&'a mut AntFrames>,
}

impl Observer for Watch<'_> {
    fn on_event(&mut self, event: &Event) {
        self.clock.on_event(event);
        if let Some(ants) = &mut self.ants {
            ants.on_event(event);
        }
    }

    fn elapsed(&mut self) -> Option<Duration> {
        self.clock.elapsed()
    }
}
