//! Paths of several planners on one map, and strip charts along one path.

use super::Figure;
use formicar::collision::{Body, ClearanceAlong, ObstacleMap};
use formicar::geometry::{Point2, Pose2};
use formicar::map::OccupancyGrid;
use formicar::path::CurvePath;
use formicar::render::{
    Color, Dash, LineStyle, Picture, PoseMark, ProfilePoint, Scene, palette, strip_charts,
};
use formicar::vehicle::Vehicle;

/// Spacing of places along a path, meters; short paths have no fewer than `MIN_PLACES`.
const SPACING_M: f64 = 0.05;
const MIN_PLACES: f64 = 200.0;

/// Spacing of drawn places along a curve, meters.
const OVERLAY_SPACING_M: f64 = 0.1;

/// Lines that differ in color, dash and width, the last path's first.
const LOOKS: [(Color, Dash, f64); 6] = [
    (palette::FORWARD, Dash::Solid, 2.6),
    (palette::REVERSE, Dash::Dashed, 3.2),
    (palette::GOAL, Dash::Dotted, 2.6),
    (palette::START, Dash::Dashed, 2.2),
    (palette::WAYPOINTS, Dash::Solid, 1.6),
    (palette::LIMIT, Dash::Dotted, 3.2),
];

/// A path with the name of its planner.
#[derive(Clone, Debug)]
pub struct OverlayPath {
    /// The planner.
    pub name: String,
    /// Its places, world coordinates.
    pub points: Vec<Point2>,
}

impl OverlayPath {
    /// The places along a curve.
    pub fn along(name: &str, path: &CurvePath) -> Self {
        let samples = path.sample(OVERLAY_SPACING_M).into_iter();
        Self {
            name: name.to_owned(),
            points: samples.map(|sample| sample.pose.position()).collect(),
        }
    }
}

/// Several paths on one map.
#[derive(Clone, Debug)]
pub struct Overlay<'a> {
    /// The caption.
    pub caption: String,
    /// The map.
    pub map: &'a OccupancyGrid,
    /// The part of it that is shown, lowest and highest coordinate; all of it if none.
    pub window: Option<(Point2, Point2)>,
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// Start and goal.
    pub ends: [Pose2; 2],
    /// The paths; those named last lie above.
    pub paths: Vec<OverlayPath>,
}

impl Overlay<'_> {
    /// The map with the paths in different colors and dashes, and their names beside it.
    pub fn figure(&self) -> Figure {
        let mut scene = match self.window {
            Some((low, high)) => Scene::window(self.map, low, high),
            None => Scene::new(self.map),
        };
        for (i, path) in self.paths.iter().enumerate() {
            let (color, dash, width_px) = LOOKS[(self.paths.len() - 1 - i) % LOOKS.len()];
            let style = LineStyle {
                label: path.name.clone(),
                color,
                width_px,
                dash,
            };
            scene.polyline(&path.points, &style);
        }
        let marks = [PoseMark::Start, PoseMark::Goal];
        for (&pose, mark) in self.ends.iter().zip(marks) {
            scene.pose(pose, self.vehicle, mark);
        }
        let picture = Picture {
            scene: Some(scene),
            ..Picture::default()
        };
        Figure::new(&self.caption, &picture)
    }
}

/// Curvature, steering and clearance along a path with the vehicle's limits.
pub fn strips(caption: &str, map: &OccupancyGrid, vehicle: &Vehicle, path: &CurvePath) -> Figure {
    let (obstacles, body) = (ObstacleMap::new(map), Body::new(vehicle));
    let spacing_m = SPACING_M.min(path.length_m() / MIN_PLACES).max(1e-3);
    let samples = path.sample(spacing_m);
    let mut clearance = ClearanceAlong::new(&obstacles, &body);
    let points = samples.iter().map(|at| ProfilePoint {
        s_m: at.s_m,
        curvature_per_m: at.curvature_per_m,
        steer_rad: vehicle.steer_rad(at.curvature_per_m),
        clearance_m: clearance.at_m(at.pose),
        direction: at.direction,
    });
    let picture = Picture {
        charts: strip_charts(&points.collect::<Vec<_>>(), vehicle),
        ..Picture::default()
    };
    Figure::new(caption, &picture)
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::path::Direction;

    #[test]
    fn paths_and_strips_are_drawn() {
        let map = OccupancyGrid::from_rows(&["          "; 10], 1.0).unwrap();
        let vehicle = Vehicle::lei2020();
        let start = Pose2::new(1.0, 5.0, 0.0);
        let path = |name: &str, y: f64| OverlayPath {
            name: name.to_owned(),
            points: vec![Point2::new(1.0, 5.0), Point2::new(8.0, y)],
        };
        let overlay = Overlay {
            caption: "Two paths.".to_owned(),
            map: &map,
            window: None,
            vehicle: &vehicle,
            ends: [start, Pose2::new(8.0, 5.0, 0.0)],
            paths: vec![path("a", 5.0), path("b", 6.0)],
        };
        let two = overlay.figure();
        let one = Overlay {
            paths: vec![path("a", 5.0)],
            ..overlay.clone()
        };
        assert_eq!(two.caption, "Two paths.");
        assert!(two.svg.len() > one.figure().svg.len());
        let mut curve = CurvePath::new(start);
        curve.push(0.0, 5.0, Direction::Forward);
        let figure = strips("Along it.", &map, &vehicle, &curve);
        assert!(figure.svg.starts_with("<svg ") && !figure.svg.contains("NaN"));
    }
}
