//! Via points: the legs between them one after the other, joined to one path.

use super::explain::explain;
use super::goals::find_any;
use crate::collision::{Body, Drive};
use crate::geometry::Pose2;
use crate::path::CurvePath;
use crate::planner::{Ended, Explanation, Found, Halt, Task};
use crate::progress::Limits;
use crate::scenario::{Endpoint, GoalHeading, Request, StartHeading, ViaPoint};
use crate::vehicle::Motion;
use std::f64::consts::FRAC_PI_4;

/// Headings tried at a via point where the planner's own choice leads no further, in eighths of a
/// turn from that choice: opposite, across, aslant.
const OTHER_HEADINGS: [u8; 7] = [4, 2, 6, 1, 7, 3, 5];
/// A leg may end this far from one of these headings: halfway to the next.
const OTHER_YAW_RAD: f64 = 0.5 * FRAC_PI_4;

/// Plans past the via points of a request to any of its goals, leg by leg; the observer is not
/// hears nothing of the parts.
///
/// At a via point without a heading the search chooses one. Where no path leads on from it,
/// [`OTHER_HEADINGS`] are tried, each of them at most once per leg.
pub(in crate::planner) fn find_legs(task: &mut Task, limits: &mut Limits) -> Result<Found, Halt> {
    let request = task.request();
    limits.in_parts(|limits| {
        let mut legs = LegSearch {
            task,
            request,
            limits,
            tried: vec![Tried::default(); request.via.len()],
        };
        legs.plan_from(None, 0).map(joined)
    })
}

/// The legs from the last to the first, as one path. Its stages are those of the last leg.
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
struct LegSearch<'a, 't, 'l> {
    task: &'a mut Task<'t>,
    request: &'t Request,
    limits: &'a mut Limits<'l>,
    /// The headings tried at each via point.
    tried: Vec<Tried>,
}

/// Headings at a via point.
#[derive(Clone, Default)]
struct Tried {
    /// The search's first choice, radians.
    own_rad: Option<f64>,
    /// True for each of the others that leads no further.
    others: [bool; OTHER_HEADINGS.len()],
}

impl LegSearch<'_, '_, '_> {
    /// The legs from one on, the last first: from the request's start, or from where the leg
    /// before has ended.
    fn plan_from(&mut self, from: Option<Pose2>, leg: usize) -> Result<Vec<Found>, Halt> {
        let Some(via) = self.request.via.get(leg).copied() else {
            let found = self.plan_leg(&self.leg_to_goal(from), leg)?;
            return Ok(vec![found]);
        };
        let own_choice = self.plan_leg(&self.leg_to(from, &via), leg)?;
        let own_rad = own_choice.path.end().heading;
        let first = match self.with_legs_after(own_choice, leg) {
            Ok(legs) => return Ok(legs),
            Err(halt) => halt.ended()?,
        };
        let is_car = self.task.vehicle().motion() == Motion::Car;
        if via.heading_rad.is_some() || !is_car || !first.leaves_hope(self.limits) {
            return Err(first.into());
        }
        let own_rad = *self.tried[leg].own_rad.get_or_insert(own_rad);
        for (i, eighths) in OTHER_HEADINGS.into_iter().enumerate() {
            let mut turned = via.with_heading(own_rad + FRAC_PI_4 * f64::from(eighths));
            turned.tolerance.yaw_rad = OTHER_YAW_RAD;
            if self.tried[leg].others[i] || !self.fits(&turned) {
                continue;
            }
            self.tried[leg].others[i] = true;
            let found = self.plan_leg(&self.leg_to(from, &turned), leg);
            match found.and_then(|found| self.with_legs_after(found, leg)) {
                Ok(legs) => return Ok(legs),
                // What failed is the leg behind; another heading might have helped it.
                Err(halt) => {
                    let status = halt.ended()?;
                    if !status.leaves_hope(self.limits) {
                        let status = status.status;
                        return Err(Ended { status, ..first }.into());
                    }
                }
            }
        }
        Err(first.into())
    }

    /// The legs behind one that is planned, and that one.
    fn with_legs_after(&mut self, found: Found, leg: usize) -> Result<Vec<Found>, Halt> {
        let mut legs = self.plan_from(Some(found.path.end()), leg + 1)?;
        legs.push(found);
        Ok(legs)
    }

    /// Plans one leg; where there is no path, the reason names the leg.
    fn plan_leg(&mut self, request: &Request, leg: usize) -> Result<Found, Halt> {
        let mut task = self.task.asking(request);
        let ended = match find_any(&mut task, self.limits) {
            Ok(found) => return Ok(found),
            Err(halt) => halt.ended()?,
        };
        let (explained, explanation) = explain(&task, ended.status, self.limits);
        let reason = ended.reason.as_ref().unwrap_or(&explained);
        let explanation = Explanation {
            leg: Some(leg + 1),
            ..explanation
        };
        Err(Halt::Ended(Ended {
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
        let body = Body::new(self.task.vehicle());
        let mut poses = via.poses().into_iter();
        poses.any(|pose| {
            let pose = self.task.to_grid(pose);
            self.task.obstacles().is_free(&body, &Drive::at(pose))
        })
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
