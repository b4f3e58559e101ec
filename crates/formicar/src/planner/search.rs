//! The trait that every planner implements, the built-in ones and a user's own.

use super::{Found, Halt, PlanError, PlannerConfig, Task};
use crate::map::DiagonalRule;
use crate::path::CurvePath;
use crate::progress::Limits;
use std::fmt;

/// A way of finding paths; [`Planner::with_search`] turns it into a planner.
///
/// The planner checks the request before it asks the search, plans past via points leg by leg,
/// adds transitions where the request asks for continuous curvature, and explains failures. The
/// judge decides about what the search finds, so that no search can return a path that collides.
///
/// A search has no state between queries: what it prepares for a map it takes from the [`Task`],
/// which keeps it. The same task must give the same path.
///
/// ```
/// use formicar::geometry::{Arc, Pose2};
/// use formicar::map::OccupancyGrid;
/// use formicar::numeric::Seed;
/// use formicar::planner::{Found, Halt, PathSearch, Planner, Task};
/// use formicar::progress::{Limits, Status};
/// use formicar::scenario::Request;
/// use formicar::vehicle::Vehicle;
///
/// /// Drives straight ahead as far as the goal is away.
/// #[derive(Debug)]
/// struct Ahead;
///
/// impl PathSearch for Ahead {
///     fn name(&self) -> &str {
///         "ahead"
///     }
///
///     fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
///         limits.step()?;
///         let (start, goal) = (task.request().start, task.request().goal);
///         let length_m = start.position().distance(goal.position());
///         Ok(task.driven(task.to_grid(start), &[Arc::new(0.0, length_m)]))
///     }
/// }
///
/// let map = OccupancyGrid::from_rows(&["....................", "...................."], 1.0)?;
/// let mut planner = Planner::with_search(&map, Vehicle::f1tenth(), std::sync::Arc::new(Ahead));
/// let request = Request::new(Pose2::new(2.0, 1.0, 0.0), Pose2::new(9.0, 1.0, 0.0));
/// let plan = planner.plan(&request, Seed(1), &mut ())?.found()?;
/// assert_eq!((plan.planner.as_str(), plan.metrics.length_m), ("ahead", 7.0));
/// // The judge refuses a path that does not end at the goal.
/// let aside = Request::new(Pose2::new(2.0, 1.0, 0.0), Pose2::new(9.0, 1.5, 0.0));
/// let outcome = planner.plan(&aside, Seed(1), &mut ())?;
/// assert_eq!(outcome.status(), Status::Infeasible);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// [`Planner::with_search`]: super::Planner::with_search
pub trait PathSearch: fmt::Debug + Send + Sync {
    /// The name in messages, answers and tables.
    fn name(&self) -> &str;

    /// Finds a path for a request without via points. It calls [`Limits::step`] for each of its
    /// steps, and ends where that fails: `limits.step()?`.
    ///
    /// # Errors
    /// No path, for a reason that is named; or input that this search refuses.
    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt>;

    /// Abilities beyond a path from one start to one goal.
    fn abilities(&self) -> Abilities {
        Abilities::default()
    }

    /// Finds a path from what is left of a previous one; only asked where
    /// [`Abilities::replans`] is set. The request may have via points:
    /// [`Task::find_past_via_points`] plans past them.
    ///
    /// # Errors
    /// As [`find`](Self::find).
    fn replan(
        &self,
        task: &mut Task<'_>,
        previous: &CurvePath,
        limits: &mut Limits<'_>,
    ) -> Result<Found, Halt> {
        let _ = (previous, limits);
        let planner = task.planner().to_owned();
        Err(PlanError::CannotReplan { planner }.into())
    }

    /// Advice for a user where the search finds no path.
    fn hints(&self) -> Hints {
        Hints::default()
    }

    /// The parameters of a built-in planner.
    fn config(&self) -> Option<&PlannerConfig> {
        None
    }
}

/// Abilities of a search beyond a path from one start to one goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Abilities {
    /// Treatment of several goals.
    pub goals: SeveralGoals,
    /// Vehicles that it plans for; others are refused.
    pub vehicles: Vehicles,
    /// Weighs soft costs; other searches pass over them.
    pub heeds_soft_costs: bool,
    /// Starts from a previous path: [`PathSearch::replan`].
    pub replans: bool,
    /// Sends ants: an observer hears of their iterations.
    pub sends_ants: bool,
}

/// Vehicles that a search plans for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Vehicles {
    /// Steered vehicles and points.
    #[default]
    Any,
    /// Steered vehicles alone.
    Cars,
}

/// Treatment of several goals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeveralGoals {
    /// It looks for all at once.
    AtOnce,
    /// It is asked for one after the other: that with the shortest way over cells first, with
    /// diagonal steps by this rule on obstacles grown by half the vehicle's width.
    NearestFirst(DiagonalRule),
}

impl Default for SeveralGoals {
    fn default() -> Self {
        Self::NearestFirst(DiagonalRule::default())
    }
}

/// Advice for a user where a search finds no path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hints {
    /// For a passage that is wide enough, so that turning is what fails.
    pub turning: &'static str,
    /// For a search that has ended by a limit of its own.
    pub own_limit: &'static str,
}

impl Default for Hints {
    fn default() -> Self {
        Self {
            turning: "formicar and hybrid-astar use the true footprint",
            own_limit: "raise the limit of the search",
        }
    }
}
