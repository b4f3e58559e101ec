//! The picture of an answer: what a plan's picture needs is read off the document.

use super::style::clearance_label;
use super::{Layout, Picture, PlanPicture, ProfilePoint, plan_picture_in};
use crate::geometry::{Point2, Pose2};
use crate::map::OccupancyGrid;
use crate::planner::{Answer, Outcome, PoseRecord, RequestDocument};
use crate::scenario::Request;
use crate::vehicle::Vehicle;

/// All that the picture of an answer is made from.
#[derive(Clone, Copy, Debug)]
pub struct AnswerPicture<'a> {
    /// The ground.
    pub map: &'a OccupancyGrid,
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// What came of the request.
    pub answer: &'a Answer,
    /// The same before it was written down.
    pub outcome: &'a Outcome,
    /// The place of an obstacle that the body comes nearest to, world coordinates
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
        let status = self.status.replace('_', " ");
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

/// Which goal was reached.
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
    let mut parts = vec![
        format!("{:.2} m", metrics.length_m),
        format!("clearance {}", clearance_label(metrics.min_clearance_m)),
    ];
    let limit_per_m = vehicle.max_curvature_per_m();
    if limit_per_m.is_finite() {
        let largest_per_m = metrics.max_curvature_per_m;
        parts.push(format!(
            "curvature {largest_per_m:.2} of {limit_per_m:.2} 1/m"
        ));
        let plural = if metrics.n_cusps == 1 { "" } else { "s" };
        parts.push(format!("{} cusp{plural}", metrics.n_cusps));
    }
    let by = format!("{} by {}", answer.provenance.vehicle.name, answer.planner);
    format!("{by}: {}", parts.join(", "))
}
