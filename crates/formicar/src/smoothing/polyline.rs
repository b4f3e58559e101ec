//! The polyline whose corners are to be rounded: legs and the turns between them.

use super::problem::SmoothingProblem;
use crate::geometry::{Point2, Pose2, angle_difference};
use crate::map::Cell;
use crate::scenario::Request;

/// Nodes nearer to each other than this are the same, meters.
const SAME_PLACE_M: f64 = 1e-9;
/// Turns below this do not count, radians.
const STRAIGHT_RAD: f64 = 1e-9;

/// A straight piece of the polyline, grid coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    pub(super) start: Pose2,
    pub(super) length_m: f64,
    /// Length of the polyline before it, meters.
    pub(super) s_m: f64,
}

/// Legs from start to goal; empty where both are the same place.
#[derive(Clone, Debug)]
pub(super) struct Polyline {
    pub(super) points: Vec<Point2>,
    pub(super) legs: Vec<Leg>,
}

impl Polyline {
    /// The polyline through points, without repeated points and points on a straight line.
    pub(super) fn new(points: impl IntoIterator<Item = Point2>) -> Self {
        let mut kept: Vec<Point2> = Vec::new();
        for point in points {
            if kept
                .last()
                .is_some_and(|p| p.distance(point) < SAME_PLACE_M)
            {
                continue;
            }
            if let [.., before, last] = kept[..] {
                let turn = angle_difference((point - last).angle(), (last - before).angle());
                if turn.abs() < STRAIGHT_RAD {
                    kept.pop();
                }
            }
            kept.push(point);
        }
        let mut s_m = 0.0;
        let legs = kept.windows(2).map(|w| {
            let leg = Leg {
                start: Pose2::at(w[0], (w[1] - w[0]).angle()),
                length_m: w[0].distance(w[1]),
                s_m,
            };
            s_m += leg.length_m;
            leg
        });
        Self {
            legs: legs.collect(),
            points: kept,
        }
    }

    /// Length in meters.
    pub(super) fn length_m(&self) -> f64 {
        self.legs.last().map_or(0.0, |leg| leg.s_m + leg.length_m)
    }

    /// Number of corners.
    pub(super) fn n_corners(&self) -> usize {
        self.legs.len().saturating_sub(1)
    }

    /// The turn from a leg to the next, positive left.
    pub(super) fn turn_rad(&self, corner: usize) -> f64 {
        let heading = |leg: usize| self.legs[leg].start.heading;
        angle_difference(heading(corner + 1), heading(corner))
    }
}

/// The start, the centers of the nodes, the goal; grid coordinates.
///
/// The first and the last node stand for the ends on the grid. Each is dropped where its end sees
/// the node after it: otherwise the path would turn within the end's own cell.
pub(super) fn waypoints(
    problem: &SmoothingProblem,
    request: &Request,
    nodes: &[Cell],
) -> Vec<Point2> {
    let frame = problem.obstacles.frame();
    let center = |cell: &Cell| {
        Point2::new(f64::from(cell.col) + 0.5, f64::from(cell.row) + 0.5) * frame.resolution_m()
    };
    let [start, goal] = [request.start, request.goal].map(|pose| frame.to_grid(pose).position());
    let mut points = vec![start];
    points.extend(nodes.iter().map(center));
    points.push(goal);
    if points.len() > 2 && problem.sees(start, points[2]) {
        points.remove(1);
    }
    let last = points.len() - 1;
    if last > 1 && problem.sees(goal, points[last - 2]) {
        points.remove(last - 1);
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn repeated_and_straight_points_make_no_corner() {
        let points = [(0.0, 0.0), (0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 3.0)];
        let line = Polyline::new(points.map(|(x, y)| Point2::new(x, y)));
        assert_eq!((line.legs.len(), line.n_corners()), (2, 1));
        assert!((line.turn_rad(0) - FRAC_PI_2).abs() < 1e-12);
        assert_eq!((line.length_m(), line.legs[1].s_m), (5.0, 2.0));
        let nowhere = Polyline::new([Point2::default(); 3]);
        assert_eq!((nowhere.legs.len(), nowhere.points.len()), (0, 1));
    }
}
