//! Pictures of answers.

use crate::ground::Ground;
use crate::summary::{clearance, counted};
use anyhow::Result;
use formicar::collision::{Body, ObstacleMap};
use formicar::geometry::{Point2, Pose2};
use formicar::planner::{Answer, Outcome, PoseRecord, RequestDocument};
use formicar::render::{Layout, Picture, PlanPicture, ProfilePoint, plan_picture_in};
use formicar::scenario::Request;
use formicar::vehicle::Vehicle;

/// The formats of pictures.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PictureKind {
    Svg,
    Png,
}

/// File extensions and their formats.
pub(crate) const KINDS: [(&str, PictureKind); 2] =
    [("svg", PictureKind::Svg), ("png", PictureKind::Png)];

/// Width of a PNG, pixels.
pub(crate) const PNG_WIDTH_PX: u32 = 1600;

/// The picture of an answer, with or without a path.
pub(crate) fn of(
    (ground, obstacles): (&Ground, &ObstacleMap),
    answer: &Answer,
    outcome: &Outcome,
    layout: Layout,
) -> Picture {
    let [start, goal] = ends(answer);
    let places = places(answer);
    let (path, report) = outcome.judged().unzip();
    let profile = profile(answer).unwrap_or_default();
    let plan = PlanPicture {
        map: &ground.map,
        vehicle: &ground.vehicle.vehicle,
        start,
        goal,
        places: &places,
        failure: answer.explanation.as_ref(),
        path,
        profile: &profile,
        tightest: report.map(|r| {
            let place = contact(obstacles, &ground.vehicle.vehicle, r.tightest);
            (place, r.min_clearance_m)
        }),
        title: &title(ground, answer),
        caption: &caption(answer, &ground.vehicle.vehicle),
    };
    plan_picture_in(&plan, layout)
}

/// Start and goal of the request; of several goals that which was reached, or the first.
pub(crate) fn ends(answer: &Answer) -> [Pose2; 2] {
    let request = request(answer);
    let reached = reached(answer);
    let goal = request.as_ref().and_then(|r| r.goals().nth(reached));
    [request.as_ref().map(|r| r.start), goal].map(Option::unwrap_or_default)
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

/// The map, and how the query ended.
pub(crate) fn title(ground: &Ground, answer: &Answer) -> String {
    let status = answer.status.replace('_', " ");
    format!("{}: {status}", ground.record.name)
}

/// The place of an obstacle that the vehicle comes nearest to.
pub(crate) fn contact(obstacles: &ObstacleMap, vehicle: &Vehicle, tightest: Pose2) -> Point2 {
    let frame = obstacles.frame();
    let place = obstacles.nearest_obstacle(&Body::new(vehicle), frame.to_grid(tightest));
    frame.to_world(Pose2::at(place, 0.0)).position()
}

/// The bytes of a picture.
pub(crate) fn encode(picture: &Picture, kind: PictureKind) -> Result<Vec<u8>> {
    Ok(match kind {
        PictureKind::Svg => picture.to_svg().into_bytes(),
        PictureKind::Png => picture.to_png(PNG_WIDTH_PX)?,
    })
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
        format!("clearance {}", clearance(metrics.min_clearance_m)),
    ];
    let limit_per_m = vehicle.max_curvature_per_m();
    if limit_per_m.is_finite() {
        let largest_per_m = metrics.max_curvature_per_m;
        parts.push(format!(
            "curvature {largest_per_m:.2} of {limit_per_m:.2} 1/m"
        ));
        parts.push(counted(metrics.n_cusps, "cusp"));
    }
    let by = format!("{} by {}", answer.provenance.vehicle.name, answer.planner);
    format!("{by}: {}", parts.join(", "))
}
