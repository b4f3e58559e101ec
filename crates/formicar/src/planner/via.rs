//! Via points: the legs between them one after the other, joined to one path.

use super::run::{Ended, Found};
use super::{Explanation, PlanError, Planner};
use crate::collision::{Body, Drive};
use crate::geometry::Pose2;
use crate::numeric::Seed;
use crate::path::CurvePath;
use crate::progress::{Limits, Status};
use crate::scenario::{Endpoint, GoalHeading, Request, StartHeading, ViaPoint};
use crate::vehicle::Motion;
use std::f64::consts::FRAC_PI_4;

/// Headings tried at a via point where the planner's own choice leads no further, in eighths of a
/// turn from that choice: opposite, across, aslant.
const OTHER_HEADINGS: [u8; 7] = [4, 2, 6, 1, 7, 3, 5];
/// How far from one of these a leg may end: halfway to the next.
const OTHER_YAW_RAD: f64 = 0.5 * FRAC_PI_4;

impl Planner {
    /// Plans past the via points of a request to any of its goals, leg by leg.
    ///
    /// At a via point without a heading the planner chooses one. Where no way leads on from it,
    /// [`OTHER_HEADINGS`] are tried. From none of those, leg by leg, is planned twice.
    pub(super) fn search_legs(
        &mut self,
        request: &Request,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let mut journey = Journey {
            planner: self,
            request,
            seed,
            limits,
            tried: vec![Tried::default(); request.via.len()],
        };
        Ok(journey.go_on(None, 0)?.map(joined))
    }
}

/// The legs from the last to the first, as one path. What was computed on the way is that of the
/// last leg.
fn joined(mut legs: Vec<Found>) -> Found {
    let cut_by = legs.iter().find_map(|leg| leg.cut_by);
    legs.reverse();
    let start = legs
        .first()
        .map_or(Pose2::default(), |leg| leg.path.start());
    let segments = legs.iter().flat_map(|leg| leg.path.segments().to_vec());
    let path = CurvePath::from_segments(start, segments.collect());
    let stages = legs.pop().map(|leg| leg.stages).unwrap_or_default();
    Found {
        path,
        stages,
        cut_by,
    }
}

/// A search for legs, depth first.
struct Journey<'a, 'l> {
    planner: &'a mut Planner,
    request: &'a Request,
    seed: Seed,
    limits: &'a mut Limits<'l>,
    /// What was tried at each via point.
    tried: Vec<Tried>,
}

/// Headings at a via point.
#[derive(Clone, Default)]
struct Tried {
    /// The planner's first choice, radians.
    own_rad: Option<f64>,
    /// Which of the others lead no further.
    others: [bool; OTHER_HEADINGS.len()],
}

impl Journey<'_, '_> {
    /// The legs from one on, the last first: from the request's start, or from where the leg
    /// before has ended.
    fn go_on(
        &mut self,
        from: Option<Pose2>,
        leg: usize,
    ) -> Result<Result<Vec<Found>, Ended>, PlanError> {
        let Some(via) = self.request.via.get(leg).copied() else {
            let found = self.plan_leg(&self.leg_to_goal(from), leg)?;
            return Ok(found.map(|found| vec![found]));
        };
        let own_choice = match self.plan_leg(&self.leg_to(from, &via), leg)? {
            Ok(found) => found,
            Err(ended) => return Ok(Err(ended)),
        };
        let own_rad = own_choice.path.end().heading;
        let first = match self.go_on_behind(own_choice, leg)? {
            Ok(legs) => return Ok(Ok(legs)),
            Err(ended) => ended,
        };
        let has_choice = via.heading_rad.is_none() && self.planner.vehicle.motion() == Motion::Car;
        if !has_choice || !first.leaves_hope(self.limits) {
            return Ok(Err(first));
        }
        let own_rad = *self.tried[leg].own_rad.get_or_insert(own_rad);
        for (i, eighths) in OTHER_HEADINGS.into_iter().enumerate() {
            let mut turned = via.with_heading(own_rad + FRAC_PI_4 * f64::from(eighths));
            turned.tolerance.yaw_rad = OTHER_YAW_RAD;
            if self.tried[leg].others[i] || !self.fits(&turned) {
                continue;
            }
            self.tried[leg].others[i] = true;
            let legs = match self.plan_leg(&self.leg_to(from, &turned), leg)? {
                Ok(found) => self.go_on_behind(found, leg)?,
                Err(ended) => Err(ended),
            };
            match legs {
                Ok(legs) => return Ok(Ok(legs)),
                // What failed is the leg behind; another heading might have helped it.
                Err(ended) if !ended.leaves_hope(self.limits) => {
                    let status = ended.status;
                    return Ok(Err(Ended { status, ..first }));
                }
                Err(_) => {}
            }
        }
        Ok(Err(first))
    }

    /// The legs behind one that is planned, and that one.
    fn go_on_behind(
        &mut self,
        found: Found,
        leg: usize,
    ) -> Result<Result<Vec<Found>, Ended>, PlanError> {
        let legs = self.go_on(Some(found.path.end()), leg + 1)?;
        Ok(legs.map(|mut legs| {
            legs.push(found);
            legs
        }))
    }

    /// Plans one leg; where there is no path, the reason names the leg.
    fn plan_leg(
        &mut self,
        request: &Request,
        leg: usize,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let ended = match self.planner.reach(request, self.seed, self.limits)? {
            Ok(found) => return Ok(Ok(found)),
            Err(ended) => ended,
        };
        let n_steps = self.limits.n_steps();
        let (explained, explanation) = self.planner.explain(request, ended.status, n_steps);
        let reason = ended.reason.as_ref().unwrap_or(&explained);
        let explanation = Explanation {
            leg: Some(leg + 1),
            ..explanation
        };
        Ok(Err(Ended {
            reason: Some(format!("{}: {reason}", leg_name(self.request, leg))),
            explanation: Some(Box::new(explanation)),
            ..ended
        }))
    }

    fn leg_to(&self, from: Option<Pose2>, via: &ViaPoint) -> Request {
        let heading_rad = via.heading_rad.unwrap_or_default();
        let leg = self.leg_to_goal(from);
        Request {
            goal_heading: match via.heading_rad {
                Some(_) => GoalHeading::Exact,
                None => GoalHeading::Any,
            },
            goal_tolerance: via.tolerance,
            ..leg.with_goal(Pose2::at(via.position, heading_rad))
        }
    }

    fn leg_to_goal(&self, from: Option<Pose2>) -> Request {
        let (start, start_heading) = match from {
            Some(pose) => (pose, StartHeading::Exact),
            None => (self.request.start, self.request.start_heading),
        };
        Request {
            start,
            start_heading,
            via: Vec::new(),
            ..self.request.clone()
        }
    }

    fn fits(&self, via: &ViaPoint) -> bool {
        let obstacles = &self.planner.obstacles;
        let body = Body::new(&self.planner.vehicle);
        let mut poses = via.poses().into_iter();
        poses.any(|pose| obstacles.is_free(&body, &Drive::at(obstacles.frame().to_grid(pose))))
    }
}

/// A leg as sentences name it.
pub(super) fn leg_name(request: &Request, leg: usize) -> String {
    let n_legs = request.via.len() + 1;
    let end = |i: usize| match i {
        0 => Endpoint::Start,
        i if i == n_legs => Endpoint::Goal,
        i => Endpoint::Via(i),
    };
    let (number, from, to) = (leg + 1, end(leg), end(leg + 1));
    format!("leg {number} of {n_legs}, from {from} to {to}")
}

impl Ended {
    /// Whether another attempt may do better: the search has ended by itself, and there are steps
    /// left.
    pub(super) fn leaves_hope(&self, limits: &Limits) -> bool {
        match self.status {
            Status::NoPath | Status::Infeasible => true,
            Status::BudgetExhausted => limits.has_steps_left(),
            _ => false,
        }
    }
}
