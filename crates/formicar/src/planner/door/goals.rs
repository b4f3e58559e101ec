//! Several goals for searches that plan to one: the nearest along the ground first.

use super::check_motion;
use crate::collision::{Body, Drive};
use crate::geometry::Pose2;
use crate::map::DiagonalRule;
use crate::path::CurvePath;
use crate::planner::{Found, Halt, SeveralGoals, Stages, Task};
use crate::progress::{Limits, Status};
use crate::scenario::Request;
use crate::search::GoalField;

/// Plans to any of the goals of a request without via points. A search that plans to one goal is
/// asked for the nearest, and for the next where that one cannot be reached.
pub(super) fn find_any(task: &mut Task, limits: &mut Limits) -> Result<Found, Halt> {
    if let Some(found) = standing(task, limits) {
        return Ok(found);
    }
    let rule = match task.search.abilities().goals {
        SeveralGoals::NearestFirst(rule) if !task.request().other_goals.is_empty() => rule,
        SeveralGoals::NearestFirst(_) | SeveralGoals::AtOnce => return search(task, limits),
    };
    let mut first = None;
    for goal in goals_by_distance(task, rule, limits)? {
        let to_goal = task.request().with_goal(goal);
        let ended = match search(&mut task.asking(&to_goal), limits) {
            Ok(found) => return Ok(found),
            Err(halt) => halt.ended()?,
        };
        if !ended.leaves_hope(limits) {
            return Err(ended.into());
        }
        first.get_or_insert(ended);
    }
    Err(first.unwrap_or(Status::NoPath.into()).into())
}

fn search(task: &mut Task, limits: &mut Limits) -> Result<Found, Halt> {
    check_motion(task.search, task.vehicle())?;
    task.search.find(task, limits)
}

/// The goals at which the vehicle can stand, by the length of the way from the start; those
/// without a way last, in their order.
fn goals_by_distance(
    task: &mut Task,
    rule: DiagonalRule,
    limits: &mut Limits,
) -> Result<Vec<Pose2>, Status> {
    let request = task.request();
    let goals = request.goals().filter(|&goal| fits(task, request, goal));
    let goals: Vec<Pose2> = goals.collect();
    let costs = task.with_cells(rule, |task, cells| {
        let blocked = cells.moves.blocked();
        let cells_of = |&goal: &Pose2| {
            let to_goal = request.with_goal(goal);
            task.open_ends_of(&to_goal, blocked).ok()
        };
        let ends: Vec<_> = goals.iter().map(cells_of).collect();
        let Some([start, _]) = ends.iter().flatten().next() else {
            return Ok(vec![None; goals.len()]);
        };
        let field = GoalField::new(&cells.moves, &[*start], &mut limits.without_budget());
        let field = match field {
            Ok(field) => field,
            Err(error) => return error.status().map_or(Ok(vec![None; goals.len()]), Err),
        };
        Ok(ends
            .iter()
            .map(|ends| ends.and_then(|[_, goal]| field.cost(goal)))
            .collect())
    })?;
    let mut order: Vec<usize> = (0..goals.len()).collect();
    order.sort_by_key(|&i| costs[i].unwrap_or(u32::MAX));
    Ok(order.into_iter().map(|i| goals[i]).collect())
}

/// True where the vehicle can stand at a goal in one of the headings that the request allows.
fn fits(task: &Task, request: &Request, goal: Pose2) -> bool {
    let body = Body::new(task.vehicle());
    let stands_free = |pose| {
        let pose = task.to_grid(pose);
        task.obstacles().is_free(&body, &Drive::at(pose))
    };
    !request.free_poses_at_goal(goal, stands_free).is_empty()
}

/// The path without length of a vehicle that stands at a goal already, whichever search is asked.
/// The observer hears of it.
pub(super) fn standing(task: &Task, limits: &mut Limits) -> Option<Found> {
    let request = task.request();
    let (motion, body) = (task.vehicle().motion(), Body::new(task.vehicle()));
    let stands = |&pose: &Pose2| {
        request.is_goal(motion, pose)
            && task
                .obstacles()
                .is_free(&body, &Drive::at(task.to_grid(pose)))
    };
    let start = request.start_poses().into_iter().find(stands)?;
    let path = CurvePath::from_segments(start, Vec::new());
    limits.tell_improved(&path);
    Some(Found::new(path, Stages::default()))
}
