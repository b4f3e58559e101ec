//! A clock for queries with a deadline.

use super::{Event, Observer};
use std::time::{Duration, Instant};

/// The system's clock, started with a query; it also notes when the first path was certified,
/// and counts certified paths.
///
/// ```
/// use formicar::progress::StdClock;
/// use formicar::{OccupancyGrid, Planner, PlannerConfig, Pose2, Request, Seed, Vehicle};
/// use std::time::Duration;
///
/// let map = OccupancyGrid::from_rows(&["..............."; 10], 1.0)?;
/// let mut planner = Planner::new(&map, Vehicle::warehouse_amr(), PlannerConfig::default())?;
/// let mut request = Request::new(Pose2::new(3.0, 5.0, 0.0), Pose2::new(11.0, 5.0, 0.0));
/// request.deadline = Some(Duration::from_secs(5));
/// assert!(planner.plan(&request, Seed(1), &mut StdClock::start())?.found().is_ok());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct StdClock {
    begun: Instant,
    first_path: Option<Duration>,
    n_paths: u32,
}

impl StdClock {
    /// A clock that begins now.
    #[must_use]
    pub fn start() -> Self {
        Self {
            begun: Instant::now(),
            first_path: None,
            n_paths: 0,
        }
    }

    /// Time since the clock began.
    pub fn now(&self) -> Duration {
        self.begun.elapsed()
    }

    /// Time from the beginning to the first certified path, if there was one.
    pub fn first_path(&self) -> Option<Duration> {
        self.first_path
    }

    /// The number of certified paths so far, each better than the one before.
    pub fn n_paths(&self) -> u32 {
        self.n_paths
    }
}

impl Observer for StdClock {
    fn on_event(&mut self, event: &Event) {
        if matches!(event, Event::Improved { .. }) {
            self.first_path = self.first_path.or(Some(self.now()));
            self.n_paths += 1;
        }
    }

    fn elapsed(&mut self) -> Option<Duration> {
        Some(self.now())
    }
}
