//! Planning again after the map has changed: the previous path is mended and improved, and gives
//! way only to one that is clearly cheaper.

mod bridge;
mod kept;
mod mend;

use super::config::FormicarParameters;
use super::query::Query;
use super::race::race;
use crate::geometry::{Arc, Pose2};
use crate::path::CurvePath;
use crate::planner::{Found, Halt, Task};
use crate::progress::{Event, Limits, Status};
use crate::scenario::{GoalHeading, GoalTolerance, Request, StartHeading};
use crate::search::{DriveProblem, Driven, HybridAstarConfig};
use mend::Mender;

/// Steps that a search over a gap may take, at least; else as many as planning anew took.
const LEAST_DETOUR_STEPS: u64 = 2000;
/// Tolerance of a search over a gap, meters and radians: it must end by a curve.
const DETOUR_TOLERANCE: GoalTolerance = GoalTolerance {
    xy_m: 1e-9,
    yaw_rad: 1e-9,
};

/// Plans without via points.
pub(super) fn mend_or_find(
    parameters: &FormicarParameters,
    task: &mut Task,
    previous: &CurvePath,
    limits: &mut Limits,
) -> Result<Found, Halt> {
    let ground = task.drive_ground(&parameters.hybrid_astar)?;
    let cost = parameters.cost.of_vehicle(task.vehicle());
    let query = Query {
        task,
        parameters,
        cost,
        problem: &DriveProblem::new(&ground, &parameters.hybrid_astar, &cost, task.request()),
    };
    limits.tell(&Event::SearchStarted);
    let mender = query.mender(previous);
    let mended = mender.as_ref().and_then(|mender| mender.mend(None));
    let mut mended = query.announced(mended, limits);
    let n_before = limits.n_steps();
    let anew = race(query.problem, &query.rules(), limits);
    if matches!(anew, Err(Status::Cancelled)) {
        return Err(Status::Cancelled.into());
    }
    if let (None, Some(mender), Ok(_)) = (&mended, &mender, &anew) {
        let most_steps = (limits.n_steps() - n_before).max(LEAST_DETOUR_STEPS);
        let path = query.mend_by_search(mender, most_steps, limits);
        mended = query.announced(path, limits);
    }
    Ok(query.better_of(mended, anew, limits)?)
}

/// Plans past via points, and takes the previous path as it is mended where that is not much
/// dearer.
pub(super) fn mend_or_find_legs(
    parameters: &FormicarParameters,
    task: &mut Task,
    previous: &CurvePath,
    limits: &mut Limits,
) -> Result<Found, Halt> {
    let anew = match task.find_past_via_points(limits) {
        Err(Halt::Ended(ended)) if ended.status == Status::Cancelled => return Err(ended.into()),
        Err(Halt::Refused(error)) => return Err(error.into()),
        anew => anew,
    };
    let ground = task.drive_ground(&parameters.hybrid_astar)?;
    let cost = parameters.cost.of_vehicle(task.vehicle());
    let query = Query {
        task,
        parameters,
        cost,
        problem: &DriveProblem::new(&ground, &parameters.hybrid_astar, &cost, task.request()),
    };
    let mended = query.mender(previous).and_then(|mender| mender.mend(None));
    let old = mended.map(|(start, arcs)| query.task.driven(start, &arcs));
    let Some(old) = old.filter(|old| query.certifies(&old.path, limits)) else {
        return anew;
    };
    let Ok(anew) = anew else {
        return Ok(old);
    };
    let [old_m, new_m] = [&old, &anew].map(|found| query.cost_m(&found.path));
    let prefers_new = parameters.replan.prefers_new(old_m, new_m);
    Ok(if prefers_new { anew } else { old })
}

impl<'a> Query<'a> {
    fn mender(&self, previous: &CurvePath) -> Option<Mender<'a>> {
        let previous = previous.map_poses(|pose| self.task.to_grid(pose));
        Mender::new(self.problem, self.cost, &previous)
    }

    /// Mends a path, with searches over its gaps that take so many steps together.
    fn mend_by_search(
        &self,
        mender: &Mender,
        most_steps: u64,
        limits: &mut Limits,
    ) -> Option<Driven> {
        let frame = self.task.obstacles().frame();
        let ground = mender.problem.map();
        let end = limits.n_steps().saturating_add(most_steps);
        let mut search = |from: Pose2, to: Pose2| {
            let config = HybridAstarConfig {
                max_iterations: end.checked_sub(limits.n_steps()).filter(|&n| n > 0)?,
                ..self.parameters.hybrid_astar.clone()
            };
            let gap = Request {
                start: frame.to_world(from),
                start_heading: StartHeading::Exact,
                goal_heading: GoalHeading::Exact,
                goal_tolerance: DETOUR_TOLERANCE,
                other_goals: Vec::new(),
                ..self.task.request().with_goal(frame.to_world(to))
            };
            let problem = DriveProblem::new(ground, &config, &self.cost, &gap);
            let found = race(&problem, &self.rules(), limits);
            found.ok().map(|first| first.path.1)
        };
        mender.mend(Some(&mut search))
    }

    /// Cost of a path, meters.
    fn cost_m(&self, path: &CurvePath) -> f64 {
        let arcs: Vec<Arc> = path.segments().iter().map(kept::arc_of).collect();
        self.path_m(&self.cost, self.task.to_grid(path.start()), &arcs)
    }
}
