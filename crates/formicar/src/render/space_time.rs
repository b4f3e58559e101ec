//! Pictures of a drive in time: arc length over time, and vehicles and obstacles as ghosts.

use super::chart::{Axis, Chart, Limit, Ribbon, Series};
use super::{Picture, Scene, palette};
use crate::geometry::Point2;
use crate::motion::{MotionPlan, Region};
use crate::path::TimedPath;
use crate::scenario::Predictions;
use crate::vehicle::Vehicle;

/// Room after the end of the drive, in its durations.
const AFTER: f64 = 1.05;
/// Height of the chart of arc length over time.
const SPACE_TIME_PX: f64 = 300.0;
/// Points of a line over time.
const N_POINTS: usize = 400;
/// Ghosts of the vehicle along its drive, at most.
const MAX_GHOSTS: f64 = 8.0;

/// Arc length over time with the regions that predictions close, and speed over time with the top
/// speed.
pub fn space_time_charts(
    plan: &MotionPlan,
    predictions: &Predictions,
    max_speed_mps: f64,
) -> Vec<Chart> {
    let timed = &plan.timed;
    let end_s = shown_s(timed, predictions);
    let length_m = timed.path().length_m();
    let time = |label: &str| Axis {
        label: label.to_owned(),
        range: Some((0.0, end_s)),
        ..Axis::default()
    };
    let mut ribbons = Vec::new();
    let mut names: Vec<usize> = Vec::new();
    for chain in chains(&plan.regions, end_s) {
        let label = if names.contains(&chain.obstacle) {
            String::new()
        } else {
            names.push(chain.obstacle);
            let name = predictions.obstacles().get(chain.obstacle);
            format!("closed by {}", name.map_or("", |o| o.name()))
        };
        ribbons.push(Ribbon {
            // More names than fit would hide the chart.
            label: if names.len() > 4 {
                String::new()
            } else {
                label
            },
            points: chain.points,
            color: CLOSED_COLORS[chain.obstacle % CLOSED_COLORS.len()],
        });
    }
    let place = line(end_s, |t_s| timed.at(t_s).s_m);
    let speed = line(end_s, |t_s| timed.at(t_s).speed_mps);
    let space_time = Chart {
        title: "arc length over time".to_owned(),
        x: time("time, s"),
        y: Axis {
            range: Some((0.0, length_m.max(0.1))),
            ..Axis::named("m")
        },
        ribbons,
        series: vec![Series::new("drive", place, palette::FORWARD)],
        height_px: SPACE_TIME_PX,
        ..Chart::default()
    };
    let speed = Chart {
        title: "speed over time".to_owned(),
        x: time("time, s"),
        y: Axis::named("m/s"),
        limits: vec![Limit {
            label: format!("{max_speed_mps} m/s"),
            value: max_speed_mps,
        }],
        series: vec![Series::new("", speed, palette::FORWARD)],
        ..Chart::default()
    };
    vec![space_time, speed]
}

/// Colors of closed regions, by obstacle in turn.
const CLOSED_COLORS: [palette::Color; 3] = [palette::LIMIT, palette::CLOSED, palette::REVERSE];

impl Picture {
    /// The same picture with a drive in time: ghosts on its map, charts before its others.
    #[must_use]
    pub fn with_motion(
        mut self,
        plan: &MotionPlan,
        predictions: &Predictions,
        vehicle: &Vehicle,
        max_speed_mps: f64,
    ) -> Self {
        if let Some(scene) = &mut self.scene {
            scene.motion(&plan.timed, predictions, vehicle);
        }
        let charts = space_time_charts(plan, predictions, max_speed_mps);
        self.charts.splice(0..0, charts);
        self
    }
}

impl Scene {
    /// Vehicle and moving obstacles every so often, each with its time in seconds.
    pub fn motion(
        &mut self,
        timed: &TimedPath,
        predictions: &Predictions,
        vehicle: &Vehicle,
    ) -> &mut Self {
        let end_s = shown_s(timed, predictions);
        let step_s = nice_step_s(end_s / MAX_GHOSTS);
        let n_ghosts = (end_s / step_s).floor() as usize;
        for i in 0..=n_ghosts {
            let t_s = i as f64 * step_s;
            let before_s = (i > 0).then_some(t_s - step_s);
            for obstacle in predictions.obstacles() {
                let before = before_s.map(|t_s| obstacle.pose_at(t_s));
                // One that stands is drawn and named once.
                if before != Some(obstacle.pose_at(t_s)) {
                    let (corners, radius_m) = (obstacle.corners_at(t_s), obstacle.radius_at(t_s));
                    self.moving_obstacle(&corners, radius_m, &format!("{t_s} s"));
                }
            }
            let stands =
                before_s.is_some_and(|before_s| timed.at(t_s).s_m == timed.at(before_s).s_m);
            if !stands {
                // At the beginning its mark as a start names it.
                let label = before_s.map_or_else(String::new, |_| format!("{t_s} s"));
                self.vehicle_at(timed.pose_at(t_s), vehicle, &label);
            }
        }
        self
    }
}

/// The time up to which there is something to be seen.
fn shown_s(timed: &TimedPath, predictions: &Predictions) -> f64 {
    let duration_s = timed.duration_s();
    let shown_s = if timed.arrives() {
        duration_s
    } else {
        duration_s.max(predictions.horizon_s())
    };
    (AFTER * shown_s).max(1.0)
}

/// 1, 2 or 5 times a power of ten, at least so many seconds.
fn nice_step_s(at_least_s: f64) -> f64 {
    let power = 10_f64.powf(at_least_s.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter();
    let mut steps = factor.map(|factor| factor * power);
    steps.find(|step| *step >= at_least_s).unwrap_or(power)
}

fn line(end_s: f64, value: impl Fn(f64) -> f64) -> Vec<Point2> {
    let times = (0..=N_POINTS).map(|i| end_s * i as f64 / N_POINTS as f64);
    times.map(|t_s| Point2::new(t_s, value(t_s))).collect()
}

/// Regions of one obstacle that touch from slab to slab.
struct Chain {
    obstacle: usize,
    /// `[t, low, high]`.
    points: Vec<[f64; 3]>,
    last: Region,
}

fn chains(regions: &[Region], end_s: f64) -> Vec<Chain> {
    let mut chains: Vec<Chain> = Vec::new();
    for region in regions.iter().filter(|region| region.from_s < end_s) {
        let follows = |chain: &&mut Chain| {
            chain.obstacle == region.obstacle
                && chain.last.to_s == region.from_s
                && chain.last.from_m <= region.to_m
                && region.from_m <= chain.last.to_m
        };
        let ends = [region.from_s, region.to_s.min(end_s)];
        let points = ends.map(|t_s| [t_s, region.from_m, region.to_m]);
        match chains.iter_mut().find(follows) {
            Some(chain) => {
                chain.points.extend(points);
                chain.last = *region;
            }
            None => chains.push(Chain {
                obstacle: region.obstacle,
                points: points.to_vec(),
                last: *region,
            }),
        }
    }
    chains
}
