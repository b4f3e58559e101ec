//! The picture of a simulated drive: map, planned and driven path, swept ground, wheels and errors.

use super::chart::{Axis, Chart, Limit, Series, both_sides, reverse_stretches, stacked};
use super::palette;
use super::style::{Dash, Layout, LineStyle};
use super::{Picture, PlanPicture, Scene, plan_picture_in};
use crate::geometry::Point2;
use crate::map::OccupancyGrid;
use crate::path::CurvePath;
use crate::tracking::{TracePoint, Tracking};
use crate::vehicle::{AckermannAxles, Vehicle};

/// Points of the planned path, at least so far apart and at most so many.
const PLANNED_SPACING_M: f64 = 0.05;
const MAX_PLANNED_POINTS: f64 = 2000.0;
/// Errors below these fill no chart: half a centimeter, half a degree.
const LEAST_RANGE_M: f64 = 0.005;
const LEAST_RANGE_DEG: f64 = 0.5;

/// All that the picture of a drive is made from.
#[derive(Clone, Copy, Debug)]
pub struct DrivePicture<'a> {
    /// The ground.
    pub map: &'a OccupancyGrid,
    /// The vehicle, with its limits and footprint.
    pub vehicle: &'a Vehicle,
    /// The path that was to be driven.
    pub planned: &'a CurvePath,
    /// The result.
    pub drive: &'a Tracking,
    /// The obstacle that the vehicle came nearest to or touched first, and its clearance in meters.
    pub tightest: Option<(Point2, f64)>,
    /// Heading.
    pub title: &'a str,
    /// Key numbers.
    pub caption: &'a str,
}

/// The picture of a drive, for a page.
pub fn drive_picture(of: &DrivePicture) -> Picture {
    let plan = PlanPicture {
        map: of.map,
        vehicle: of.vehicle,
        start: of.drive.driven.start(),
        goal: of.planned.end(),
        places: &[],
        failure: None,
        path: Some(&of.drive.driven),
        profile: &[],
        tightest: of.tightest,
        title: of.title,
        caption: of.caption,
    };
    let mut picture = plan_picture_in(&plan, Layout::Page);
    if let Some(scene) = &mut picture.scene {
        draw_planned(scene, of.planned, "planned");
    }
    if let Some((detail, _)) = &mut picture.detail {
        draw_planned(detail, of.planned, "");
    }
    picture.charts = drive_charts(&of.drive.trace, of.vehicle);
    picture
}

/// Both front-wheel angles with the limit of the inner one, cross-track error and heading error
/// over time, the stretches in reverse shaded; angles in degrees.
pub fn drive_charts(trace: &[TracePoint], vehicle: &Vehicle) -> Vec<Chart> {
    if trace.len() < 2 {
        return Vec::new();
    }
    let cross_track = line(trace, |p| p.cross_track_error_m);
    let heading = line(trace, |p| p.heading_error_rad.to_degrees());
    let charts = vec![
        Chart {
            limits: wheel_limits(vehicle),
            height_px: 150.0,
            ..strip(trace, "front wheels", "degrees", wheels(trace))
        },
        Chart {
            y: around_zero("m", &cross_track, LEAST_RANGE_M),
            ..strip(trace, "cross-track error", "m", vec![cross_track])
        },
        Chart {
            y: around_zero("degrees", &heading, LEAST_RANGE_DEG),
            ..strip(trace, "heading error", "degrees", vec![heading])
        },
    ];
    stacked(charts, "time, s")
}

fn draw_planned(scene: &mut Scene, planned: &CurvePath, label: &str) {
    let spacing_m = PLANNED_SPACING_M.max(planned.length_m() / MAX_PLANNED_POINTS);
    let points: Vec<_> = planned
        .sample(spacing_m)
        .iter()
        .map(|p| p.pose.position())
        .collect();
    let style = LineStyle {
        label: label.to_owned(),
        color: palette::INK,
        width_px: 1.4,
        dash: Dash::Dotted,
    };
    scene.polyline(&points, &style);
}

fn strip(trace: &[TracePoint], title: &str, unit: &str, series: Vec<Series>) -> Chart {
    let duration_s = trace.last().map_or(0.0, |p| p.t_s);
    Chart {
        title: title.to_owned(),
        x: Axis {
            label: String::new(),
            range: (duration_s > 0.0).then_some((0.0, duration_s)),
            ..Axis::default()
        },
        y: Axis::named(unit),
        bands: reverse_stretches(trace.iter().map(|p| (p.t_s, p.direction))),
        series,
        ..Chart::default()
    }
}

fn wheels(trace: &[TracePoint]) -> Vec<Series> {
    let left = line(trace, |p| p.left_wheel_rad.to_degrees());
    let right = line(trace, |p| p.right_wheel_rad.to_degrees());
    vec![
        Series {
            label: "left wheel".to_owned(),
            ..left
        },
        Series {
            label: "right wheel".to_owned(),
            color: palette::REVERSE,
            dash: Dash::Dashed,
            ..right
        },
    ]
}

/// The angle of the inner wheel where the vehicle turns as tight as it can.
fn wheel_limits(vehicle: &Vehicle) -> Vec<Limit> {
    let axles = AckermannAxles::of(vehicle);
    let steer_rad = vehicle.steer_rad(vehicle.max_curvature_per_m());
    let (Some(axles), Some(steer_rad)) = (axles, steer_rad) else {
        return Vec::new();
    };
    let (inner_rad, _) = axles.front_wheel_angles(steer_rad);
    both_sides(inner_rad.to_degrees(), |a| format!("inner wheel {a:.1}°"))
}

fn line(trace: &[TracePoint], value: impl Fn(&TracePoint) -> f64) -> Series {
    let points = trace.iter().map(|p| Point2::new(p.t_s, value(p)));
    Series::new("", points.collect(), palette::FORWARD)
}

/// An axis with 0 in the middle, so that a tiny error looks tiny.
fn around_zero(unit: &str, series: &Series, least: f64) -> Axis {
    let most = series
        .points
        .iter()
        .fold(least, |most, p| most.max(p.y.abs()));
    Axis {
        label: unit.to_owned(),
        range: Some((-1.08 * most, 1.08 * most)),
        ..Axis::default()
    }
}
