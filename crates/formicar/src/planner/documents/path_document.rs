//! A path in files: sampled poses for followers, exact segments for the judge.

use crate::collision::{Body, ClearanceAlong, ObstacleMap};
use crate::geometry::{Pose2, wrap_angle};
use crate::motion::fastest;
use crate::path::{
    CurvePath, CurveSegment, Direction, Spacing, SpeedLimits, Stop, TimedPath, TimedPose,
    steer_rate_rad_per_s,
};
use crate::vehicle::Vehicle;
use std::fmt::Write;

/// A path, world coordinates.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PathDocument {
    /// Poses at most 0.1 m and 0.2 rad apart unless asked otherwise, with both ends of every
    /// segment; where the gear changes, one pose in each gear.
    pub poses: Vec<PoseRecord>,
    /// The path itself, exactly.
    pub segments: Vec<SegmentRecord>,
}

/// A sampled pose of the rear-axle center.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PoseRecord {
    /// Meters.
    pub x: f64,
    /// Meters.
    pub y: f64,
    /// Radians, counter-clockwise from the x axis, in (-pi, pi].
    pub heading: f64,
    /// Arc length driven so far, meters.
    pub s: f64,
    /// Gear in which the pose is reached: 1 forward, -1 in reverse. Where it changes, the pose
    /// stands twice: as it is reached, and as it is left.
    #[cfg_attr(feature = "schema", schemars(with = "i8"))]
    pub direction: Direction,
    /// tan(steer) / wheelbase where the pose is reached, 1/m, positive left.
    pub curvature: f64,
    /// Steering angle of the virtual middle wheel, radians; null where the wheelbase is unknown.
    pub steer: Option<f64>,
    /// Distance from the footprint to the nearest obstacle or map border, meters.
    pub clearance: f64,
    /// Speed when the pose is reached, meters per second; where the vehicle says how fast it drives.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed: Option<f64>,
    /// Time when the pose is reached, seconds; where the vehicle says how fast it drives. Where it
    /// stands on the way, the pose is listed twice: as it is reached, and as it is left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// Acceleration with which the pose is reached, m/s^2; of drives planned in time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub acceleration: Option<f64>,
    /// Change of the steering angle as the pose is reached, rad/s; of drives planned in time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steer_rate: Option<f64>,
}

/// A line, an arc or a clothoid; along it the heading changes by
/// `direction * (curvature * length + curvature_rate * length^2 / 2)`.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SegmentRecord {
    /// Start of the segment, meters.
    pub x: f64,
    /// Start of the segment, meters.
    pub y: f64,
    /// Heading at the start of the segment, radians.
    pub heading: f64,
    /// tan(steer) / wheelbase at the start of the segment, 1/m, positive left.
    pub curvature: f64,
    /// Change of the curvature per driven meter, 1/m^2; left out on lines and arcs, where it is 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub curvature_rate: f64,
    /// Driven length, meters.
    pub length: f64,
    /// Gear: 1 forward, -1 in reverse.
    #[cfg_attr(feature = "schema", schemars(with = "i8"))]
    pub direction: Direction,
}

#[allow(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde hands over a reference"
)]
fn is_zero(number: &f64) -> bool {
    *number == 0.0
}

impl PathDocument {
    /// A path in world coordinates, measured against a map with a vehicle; its poses lie no farther
    /// apart than the spacing.
    pub fn new(
        path: &CurvePath,
        obstacles: &ObstacleMap,
        vehicle: &Vehicle,
        spacing: impl Into<Spacing>,
    ) -> Self {
        let spacing = spacing.into();
        let body = Body::new(vehicle);
        let mut clearance = ClearanceAlong::new(obstacles, &body);
        let timed = timed(path, vehicle, spacing);
        let mut after_cusps = after_cusps(path, &spacing).peekable();
        let mut poses = Vec::new();
        for (i, at) in path.sample(spacing).into_iter().enumerate() {
            let timed = timed.get(i);
            let reached = PoseRecord {
                x: at.pose.x,
                y: at.pose.y,
                heading: wrap_angle(at.pose.heading),
                s: at.s_m,
                direction: at.direction,
                curvature: at.curvature_per_m,
                steer: vehicle.steer_rad(at.curvature_per_m),
                clearance: clearance.at_m(at.pose),
                speed: timed.map(|timed| timed.speed_mps),
                time: timed.map(|timed| timed.time_s),
                acceleration: None,
                steer_rate: None,
            };
            let left = after_cusps.next_if(|(cusp, _)| *cusp == i);
            let left = left.map(|(_, next)| PoseRecord {
                direction: next.direction,
                curvature: next.curvature_per_m,
                steer: vehicle.steer_rad(next.curvature_per_m),
                time: timed.map(|timed| timed.time_s + timed.stands_s),
                ..reached.clone()
            });
            poses.push(reached);
            poses.extend(left);
        }
        Self {
            poses,
            segments: path.segments().iter().map(SegmentRecord::from).collect(),
        }
    }

    /// The same path with the times of a drive along it; where the vehicle stands on the way there are
    /// poses too. Poses that it does not reach have neither speed nor time.
    #[must_use]
    pub fn timed(&self, timed: &TimedPath, obstacles: &ObstacleMap, vehicle: &Vehicle) -> Self {
        let mut stops = timed.stops().into_iter().peekable();
        let body = Body::new(vehicle);
        let is_cusp = |i: usize| {
            let pair = self.poses.get(i).zip(self.poses.get(i + 1));
            pair.is_some_and(|(a, b)| a.s == b.s && a.direction != b.direction)
        };
        let mut poses = Vec::new();
        for (i, pose) in self.poses.iter().enumerate() {
            while let Some(stop) = stops.next_if(|stop| stop.s_m < pose.s - SAME_PLACE_M) {
                let place = timed.path().pose_at(stop.s_m);
                let at = standing(timed.path(), stop.s_m, pose);
                let at = PoseRecord {
                    clearance: obstacles.clearance_m(&body, obstacles.frame().to_grid(place)),
                    steer: vehicle.steer_rad(at.curvature),
                    ..at
                };
                poses.extend(twice(&in_time(&at, timed, vehicle), stop));
            }
            let here = in_time(pose, timed, vehicle);
            let stop = stops.peek().copied();
            let stop = stop.filter(|stop| (stop.s_m - pose.s).abs() <= SAME_PLACE_M);
            let Some(stop) = stop else {
                poses.push(here);
                continue;
            };
            // At a change of gear the document has two poses already, as a stop has.
            let [reached, left] = twice(&here, stop);
            let closes_cusp = i > 0 && is_cusp(i - 1);
            if !closes_cusp {
                poses.push(reached);
            }
            if !is_cusp(i) {
                poses.push(left);
                stops.next();
            }
        }
        Self {
            poses,
            segments: self.segments.clone(),
        }
    }

    /// The path behind the document: from its segments, or standing still at its only pose.
    pub fn curve_path(&self) -> Option<CurvePath> {
        let segments: Vec<_> = self.segments.iter().map(CurveSegment::from).collect();
        let standing = self.poses.first().map(|p| Pose2::new(p.x, p.y, p.heading));
        let start = segments.first().map(|s| s.start).or(standing)?;
        Some(CurvePath::from_segments(start, segments))
    }

    /// The poses as CSV, with a header; an unknown steering angle is left empty. Speed and time have
    /// columns where they are known.
    pub fn poses_csv(&self) -> String {
        let mut text = String::from("x,y,heading,s,direction,curvature,steer,clearance");
        let is_timed = self.poses.first().is_some_and(|p| p.time.is_some());
        let is_planned = self.poses.iter().any(|p| p.acceleration.is_some());
        text.push_str(match (is_timed, is_planned) {
            (true, true) => ",speed,time,acceleration,steer_rate\n",
            (true, false) => ",speed,time\n",
            _ => "\n",
        });
        for p in &self.poses {
            let steer = p.steer.map_or(String::new(), |steer| steer.to_string());
            let direction = i8::from(p.direction);
            let cell = |value: Option<f64>| value.map_or(String::new(), |x| x.to_string());
            let timing = match (is_timed, is_planned) {
                (true, true) => format!(
                    ",{},{},{},{}",
                    cell(p.speed),
                    cell(p.time),
                    cell(p.acceleration),
                    cell(p.steer_rate)
                ),
                (true, false) => format!(",{},{}", cell(p.speed), cell(p.time)),
                _ => String::new(),
            };
            // Writing to a string does not fail.
            let _ = writeln!(
                text,
                "{},{},{},{},{direction},{},{steer},{}{timing}",
                p.x, p.y, p.heading, p.s, p.curvature, p.clearance
            );
        }
        text
    }
}

/// Places that are this near count as one, meters.
const SAME_PLACE_M: f64 = 1e-9;

/// A pose with the times of a drive; without any where the drive ends before it.
fn in_time(pose: &PoseRecord, timed: &TimedPath, vehicle: &Vehicle) -> PoseRecord {
    let reached = Some(timed.reached(pose.s)).filter(|reached| reached.time_s.is_finite());
    let rate_per_m2 = timed
        .path()
        .segment_at(pose.s)
        .map_or(0.0, |(segment, _)| segment.curvature_rate_per_m2);
    let steer_rate = reached
        .zip(vehicle.wheelbase_m())
        .map(|(reached, wheelbase_m)| {
            steer_rate_rad_per_s(wheelbase_m, reached.speed_mps, pose.curvature, rate_per_m2)
        });
    PoseRecord {
        speed: reached.map(|reached| reached.speed_mps),
        time: reached.map(|reached| reached.time_s),
        acceleration: reached.map(|reached| reached.acceleration_mps2),
        steer_rate,
        ..pose.clone()
    }
}

/// A pose at a stop between two samples, of which the next is known.
fn standing(path: &CurvePath, s_m: f64, next: &PoseRecord) -> PoseRecord {
    let pose = path.pose_at(s_m);
    let curvature = path
        .segment_at(s_m)
        .map_or(0.0, |(segment, driven_m)| segment.curvature_at(driven_m));
    PoseRecord {
        x: pose.x,
        y: pose.y,
        heading: wrap_angle(pose.heading),
        s: s_m,
        curvature,
        ..next.clone()
    }
}

/// A pose as it is reached, and as it is left.
fn twice(pose: &PoseRecord, stop: Stop) -> [PoseRecord; 2] {
    let at = |time| PoseRecord {
        speed: Some(0.0),
        time: Some(time),
        ..pose.clone()
    };
    [at(stop.t_s), at(stop.t_s + stop.duration_s)]
}

/// The segments that begin with a change of gear, each with the index of the sample there.
fn after_cusps<'a>(
    path: &'a CurvePath,
    spacing: &Spacing,
) -> impl Iterator<Item = (usize, &'a CurveSegment)> {
    let mut index = 0;
    path.segments().windows(2).filter_map(move |pair| {
        index += pair[0].n_steps(spacing);
        (pair[0].direction != pair[1].direction).then_some((index, &pair[1]))
    })
}

/// Speed and time at each sample; none where the vehicle does not say how fast it drives.
fn timed(path: &CurvePath, vehicle: &Vehicle, spacing: Spacing) -> Vec<TimedPose> {
    SpeedLimits::of(vehicle).map_or_else(Vec::new, |limits| {
        fastest(path, vehicle, &limits, spacing).timed_poses(spacing)
    })
}

impl From<&CurveSegment> for SegmentRecord {
    fn from(segment: &CurveSegment) -> Self {
        Self {
            x: segment.start.x,
            y: segment.start.y,
            heading: segment.start.heading,
            curvature: segment.curvature_per_m,
            curvature_rate: segment.curvature_rate_per_m2,
            length: segment.length_m,
            direction: segment.direction,
        }
    }
}

impl From<&SegmentRecord> for CurveSegment {
    fn from(record: &SegmentRecord) -> Self {
        Self {
            start: Pose2::new(record.x, record.y, record.heading),
            curvature_per_m: record.curvature,
            curvature_rate_per_m2: record.curvature_rate,
            length_m: record.length,
            direction: record.direction,
        }
    }
}
