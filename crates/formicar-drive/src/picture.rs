//! Pictures and films of drives.

use crate::record::{DrivePoint, DriveRecord};
use crate::solid::Solid;
use formicar::path::{CurvePath, CurveSegment, Direction};
use formicar::render::{Axis, Chart, Picture, PoseMark, Scene, Series, palette};
use formicar::{OccupancyGrid, Point2, Pose2, Vehicle};

/// Most outlines of agents in a still picture, per agent.
const MAX_GHOSTS: usize = 6;
/// Most frames of a film.
const MAX_FRAMES: usize = 150;

/// All that the picture of a drive is made from.
#[derive(Clone, Copy, Debug)]
pub struct DriveView<'a> {
    /// The true map.
    pub map: &'a OccupancyGrid,
    /// What stands beside its squares.
    pub solids: &'a [Solid],
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// The drive.
    pub record: &'a DriveRecord,
    /// Heading.
    pub title: &'a str,
    /// Key numbers.
    pub caption: &'a str,
}

/// The drive on the true map: swept ground, agents as outlines, contacts; speed, steering angle and
/// the error of the robot's own pose over time.
pub fn drive_picture(of: &DriveView) -> Picture {
    let mut scene = ground(of);
    let trace = &of.record.trace;
    let driven = driven(trace);
    scene.swept(&driven, of.vehicle).curve(&driven);
    let step = trace.len().div_ceil(MAX_GHOSTS).max(1);
    for point in trace.iter().step_by(step) {
        draw_agents(&mut scene, of, point, |_| "");
    }
    draw_ends(&mut scene, of);
    for contact in &of.record.contacts {
        let name = if contact.by.is_robot() {
            "collision"
        } else {
            "was hit"
        };
        scene.point(contact.place, name);
    }
    Picture {
        title: of.title.to_owned(),
        caption: of.caption.to_owned(),
        scene: Some(scene),
        charts: charts(trace),
        ..Picture::default()
    }
}

/// The frames of a film, evenly over the drive.
pub fn drive_film(of: &DriveView) -> Vec<Picture> {
    let trace = &of.record.trace;
    let step = trace.len().div_ceil(MAX_FRAMES).max(1);
    let last = trace.len().saturating_sub(1);
    let frames = (0..trace.len()).filter(|i| i % step == 0 || *i == last);
    frames.map(|i| frame(of, &trace[..=i])).collect()
}

fn frame(of: &DriveView, trace: &[DrivePoint]) -> Picture {
    let mut scene = ground(of);
    scene.curve(&driven(trace));
    if let Some(now) = trace.last() {
        draw_agents(&mut scene, of, now, |name| name);
        scene.vehicle_at(now.pose, of.vehicle, "");
    }
    scene.pose(of.record.goal, of.vehicle, PoseMark::Goal);
    let now = trace.last().map_or((0.0, 0.0), |p| (p.t_s, p.speed_mps));
    Picture {
        title: of.title.to_owned(),
        caption: format!("{:.1} s, {:.2} m/s", now.0, now.1),
        scene: Some(scene),
        ..Picture::default()
    }
}

fn ground(of: &DriveView) -> Scene {
    let mut scene = Scene::new(of.map);
    for solid in of.solids {
        scene.ghost(solid.corners(), solid.radius_m(), palette::OBSTACLE, "");
    }
    scene
}

fn draw_ends(scene: &mut Scene, of: &DriveView) {
    scene.pose(of.record.start, of.vehicle, PoseMark::Start);
    scene.pose(of.record.goal, of.vehicle, PoseMark::Goal);
}

fn draw_agents(scene: &mut Scene, of: &DriveView, at: &DrivePoint, label: fn(&str) -> &str) {
    for (agent, &[x, y, heading]) in of.record.agents.iter().zip(&at.agents) {
        let solid = Solid::placed(&agent.shape, Pose2::new(x, y, heading));
        let name = agent.name.as_deref().unwrap_or_default();
        scene.moving_obstacle(solid.corners(), solid.radius_m(), label(name));
    }
}

/// The trace as a path of arcs between its points.
fn driven(trace: &[DrivePoint]) -> CurvePath {
    let start = trace.first().map_or(Pose2::default(), |p| p.pose);
    let pairs = trace.windows(2);
    let segments = pairs.filter_map(|pair| arc_between(pair[0].pose, pair[1].pose));
    CurvePath::from_segments(start, segments.collect())
}

/// The arc from one pose to the place of the next; none where they are one.
fn arc_between(from: Pose2, to: Pose2) -> Option<CurveSegment> {
    /// Poses nearer to each other are one, meters.
    const SAME_M: f64 = 1e-4;
    let way = from.relative(to);
    let chord_m = way.position().norm();
    if chord_m < SAME_M {
        return None;
    }
    let direction = if way.x >= 0.0 {
        Direction::Forward
    } else {
        Direction::Reverse
    };
    let half_rad = 0.5 * formicar::geometry::wrap_angle(way.heading);
    let bulge = if half_rad.abs() < 1e-6 {
        1.0
    } else {
        half_rad / half_rad.sin()
    };
    let length_m = chord_m * bulge;
    Some(CurveSegment {
        start: from,
        curvature_per_m: direction.sign() * 2.0 * half_rad / length_m,
        curvature_rate_per_m2: 0.0,
        length_m,
        direction,
    })
}

fn charts(trace: &[DrivePoint]) -> Vec<Chart> {
    let chart = |title: &str, unit: &str, value: &dyn Fn(&DrivePoint) -> f64| {
        let points = trace.iter().map(|p| Point2::new(p.t_s, value(p))).collect();
        Chart {
            title: title.to_owned(),
            x: Axis::named("time, s"),
            y: Axis::named(unit),
            series: vec![Series::new("", points, palette::FORWARD)],
            ..Chart::default()
        }
    };
    vec![
        chart("speed", "m/s", &|p| p.speed_mps),
        chart("steering angle", "degrees", &|p| p.steer_rad.to_degrees()),
        chart("error of the own pose", "cm", &|p| 100.0 * p.pose_error_m),
    ]
}
