//! The picture of an answer: what a plan's picture needs is read off the document.

use super::plan::key_numbers;
use super::{Layout, Picture, PlanPicture, ProfilePoint, plan_picture_in};
use crate::geometry::{Point2, Pose2};
use crate::map::OccupancyGrid;
use crate::planner::{Answer, Outcome, PoseRecord, RequestDocument};
use crate::scenario::Request;
use crate::vehicle::Vehicle;

/// The parts of the picture of an answer.
#[derive(Clone, Copy, Debug)]
pub struct AnswerPicture<'a> {
    /// The map.
    pub map: &'a OccupancyGrid,
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// The answer to the request.
    pub answer: &'a Answer,
    /// The outcome that the answer describes.
    pub outcome: &'a Outcome,
    /// The point of an obstacle that the body comes nearest to, world coordinates
    /// ([`ObstacleMap::contact`](crate::collision::ObstacleMap::contact)).
    pub contact: Option<Point2>,
}

/// The picture of an answer, with or without a path.
pub fn answer_picture(of: &AnswerPicture, layout: Layout) -> Picture {
    let [start, goal] = of.answer.ends();
    let (path, report) = of.outcome.judged().unzip();
    plan_picture_in(
        &PlanPicture {
            map: of.map,
            vehicle: of.vehicle,
            start,
            goal,
            places: &places(of.answer),
            failure: of.answer.explanation.as_ref(),
            path,
            profile: &profile(of.answer).unwrap_or_default(),
            tightest: of.contact.zip(report.map(|report| report.min_clearance_m)),
            title: &of.answer.title(),
            caption: &caption(of.answer, of.vehicle),
        },
        layout,
    )
}

impl Answer {
    /// Start and goal of the request; of several goals that which was reached, or the first.
    pub fn ends(&self) -> [Pose2; 2] {
        let request = request(self);
        let goal = request.as_ref().and_then(|r| r.goals().nth(reached(self)));
        [request.as_ref().map(|r| r.start), goal].map(Option::unwrap_or_default)
    }

    /// The map, and how the query ended.
    pub fn title(&self) -> String {
        let status = self.status.name().replace('_', " ");
        format!("{}: {status}", self.provenance.map.name)
    }
}

/// The goals that were not reached, and the via points, by their names.
fn places(answer: &Answer) -> Vec<(Point2, String)> {
    let Some(request) = request(answer) else {
        return Vec::new();
    };
    let reached = reached(answer);
    let others = request.goals().enumerate().filter(|&(i, _)| i != reached);
    let others = others.map(|(_, goal)| (goal.position(), "other goal".to_owned()));
    let via = request.via.iter().enumerate();
    let via = via.map(|(i, via)| (via.position, format!("via {}", i + 1)));
    others.chain(via).collect()
}

fn request(answer: &Answer) -> Option<Request> {
    let request = answer.provenance.request.as_ref()?;
    request.onto(&RequestDocument::default()).ok()
}

/// The index of the goal that was reached.
fn reached(answer: &Answer) -> usize {
    let certificate = answer.certificate.as_ref();
    certificate.and_then(|c| c.goal_index).unwrap_or_default()
}

/// The sampled poses, and between them the tightest place as the judge found it.
fn profile(answer: &Answer) -> Option<Vec<ProfilePoint>> {
    let point = |pose: &PoseRecord| ProfilePoint {
        s_m: pose.s,
        curvature_per_m: pose.curvature,
        steer_rad: pose.steer,
        clearance_m: pose.clearance,
        direction: pose.direction,
    };
    let mut points: Vec<_> = answer.path.as_ref()?.poses.iter().map(point).collect();
    let report = answer.certificate.as_ref()?;
    let after = points.partition_point(|point| point.s_m < report.tightest_s_m);
    if let Some(&next) = points.get(after) {
        points.insert(
            after,
            ProfilePoint {
                s_m: report.tightest_s_m,
                clearance_m: report.min_clearance_m,
                ..next
            },
        );
    }
    Some(points)
}

/// Key numbers of a path, or the reason why there is none.
fn caption(answer: &Answer, vehicle: &Vehicle) -> String {
    let (Some(metrics), None) = (&answer.metrics, &answer.reason) else {
        return answer.reason.clone().unwrap_or_default();
    };
    let by = format!("{} by {}", answer.provenance.vehicle.name, answer.planner);
    format!("{by}: {}", key_numbers(metrics, vehicle))
}
