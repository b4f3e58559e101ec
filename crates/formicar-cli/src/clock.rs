//! The observer of a query: a clock that notes the certified paths, and the ants to keep.

use formicar::progress::{AntFrames, Event, Observer};
use std::time::{Duration, Instant};

/// Gives the time to a query and counts its certified paths.
#[derive(Debug)]
pub(crate) struct Clock {
    begun: Instant,
    first_feasible: Option<Duration>,
    n_paths: u32,
}

impl Clock {
    /// A clock for a query that begins now.
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
        self.first_feasible.map(|time| time.as_secs_f64())
    }

    /// The number of times that a better path replaced a certified one.
    pub(crate) fn n_improvements(&self) -> u32 {
        self.n_paths.saturating_sub(1)
    }
}

impl Observer for Clock {
    fn on_event(&mut self, event: &Event) {
        if let Event::Improved { .. } = event {
            self.first_feasible.get_or_insert(self.begun.elapsed());
            self.n_paths += 1;
        }
    }

    fn elapsed(&mut self) -> Option<Duration> {
        Some(self.begun.elapsed())
    }
}

/// A clock, and the ants to keep for a picture.
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
