//! The observer of a query: a clock that notes the certified paths, and the ants to keep.

use formicar::progress::{AntFrames, Event, Observer};
use std::time::{Duration, Instant};

/// Gives the time to a query and notes its certified paths.
#[derive(Debug)]
pub(crate) struct Clock {
    begun: Instant,
    paths: Vec<PathTold>,
}

/// A certified path, as reported to the observer.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(
    not(feature = "lab"),
    allow(dead_code, reason = "measurements read all of it")
)]
pub(crate) struct PathTold {
    /// The time since the query began.
    pub(crate) at: Duration,
    pub(crate) length_m: f64,
    /// Search steps by then.
    pub(crate) n_steps: u64,
}

impl Clock {
    /// A clock for a query that begins now.
    pub(crate) fn begin() -> Self {
        Self {
            begun: Instant::now(),
            paths: Vec::new(),
        }
    }

    /// Seconds since the query began.
    pub(crate) fn query_s(&self) -> f64 {
        self.begun.elapsed().as_secs_f64()
    }

    /// Seconds from the beginning to the first certified path.
    pub(crate) fn first_feasible_s(&self) -> Option<f64> {
        self.paths.first().map(|told| told.at.as_secs_f64())
    }

    /// The number of times that a better path replaced a certified one.
    pub(crate) fn n_improvements(&self) -> u32 {
        u32::try_from(self.paths.len().saturating_sub(1)).unwrap_or(u32::MAX)
    }

    /// All certified paths, the best last.
    #[cfg(feature = "lab")]
    pub(crate) fn into_paths(self) -> Vec<PathTold> {
        self.paths
    }
}

impl Observer for Clock {
    fn on_event(&mut self, event: &Event) {
        if let Event::Improved {
            length_m, n_steps, ..
        } = *event
        {
            self.paths.push(PathTold {
                at: self.begun.elapsed(),
                length_m,
                n_steps,
            });
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
