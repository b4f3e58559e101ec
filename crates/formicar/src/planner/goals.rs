//! Several goals for planners that plan to one: the nearest along the ground first.

use super::run::{Ended, Found};
use super::{PlanError, Planner, PlannerName};
use crate::collision::{Body, Drive};
use crate::geometry::Pose2;
use crate::numeric::Seed;
use crate::progress::{Limits, Status};
use crate::scenario::Request;
use crate::search::GoalField;

impl Planner {
    /// Plans to any of the goals of a request without via points.
    ///
    /// Planners that drive search for all of them at once. Every other planner plans to one goal: to that
    /// with the shortest way over cells, on obstacles grown by half the vehicle's width, and to the
    /// next where that one cannot be reached.
    pub(super) fn reach(
        &mut self,
        request: &Request,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        if request.other_goals.is_empty() || self.drives() {
            return self.search(request, seed, limits);
        }
        let goals = match self.goals_by_way(request, limits) {
            Ok(goals) => goals,
            Err(status) => return Ok(Err(status.into())),
        };
        let mut first = None;
        for goal in goals {
            match self.search(&request.with_goal(goal), seed, limits)? {
                Ok(found) => return Ok(Ok(found)),
                Err(ended) if !ended.leaves_hope(limits) => return Ok(Err(ended)),
                Err(ended) => {
                    first.get_or_insert(ended);
                }
            }
        }
        Ok(Err(first.unwrap_or(Status::NoPath.into())))
    }

    /// Whether the planner drives from pose to pose.
    fn drives(&self) -> bool {
        matches!(
            self.config.planner,
            PlannerName::Formicar | PlannerName::HybridAstar
        )
    }

    /// The goals at which the vehicle can stand, by the length of the way from the start; those
    /// without a way last, in their order.
    fn goals_by_way(
        &mut self,
        request: &Request,
        limits: &mut Limits,
    ) -> Result<Vec<Pose2>, Status> {
        let goals: Vec<Pose2> = request.goals().filter(|&g| self.fits(request, g)).collect();
        let costs = self.with_cells(|planner, cells| {
            let blocked = cells.moves.blocked();
            let ends = |&goal: &Pose2| planner.open_ends(&request.with_goal(goal), blocked).ok();
            let ends: Vec<_> = goals.iter().map(ends).collect();
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

    /// Whether the vehicle can stand at a goal in one of the headings that the request allows.
    fn fits(&self, request: &Request, goal: Pose2) -> bool {
        let body = Body::new(&self.vehicle);
        let poses = request.poses_at_goal(goal).into_iter();
        let mut poses = poses.map(|pose| self.obstacles.frame().to_grid(pose));
        poses.any(|pose| self.obstacles.is_free(&body, &Drive::at(pose)))
    }
}
