//! A cheap estimate of a standing body's clearance, continuous in its pose, for preferences.

use super::{Body, ObstacleMap};
use crate::geometry::{Point2, Pose2};
use std::f64::consts::SQRT_2;

impl ObstacleMap {
    /// From the center of a cell to its sides: the nearest square begins half a cell before its
    /// center.
    const CENTER_TO_SIDE_CELLS: f64 = 0.5;

    /// An estimate of a standing body's clearance, meters, that the covering discs and the
    /// distance transform, interpolated between cell centers, give; negative where a disc overlaps
    /// something.
    ///
    /// Above `enough_m`, any value above it may be returned: what stands far from everything needs
    /// one look. The estimate changes by at most the square root of 2 times what a point of the
    /// body moves. It exceeds the truth by less than half a cell, and falls short of it by less than
    /// a cell and what the discs stand out of the body, which is little at its sides and more at
    /// its ends.
    pub fn clearance_estimate_m(&self, body: &Body, pose: Pose2, enough_m: f64) -> f64 {
        let along = Point2::unit(pose.heading);
        self.estimate_at(body, pose.position(), along, enough_m)
    }

    /// The same for a body whose heading is given as a unit vector.
    pub(crate) fn estimate_at(
        &self,
        body: &Body,
        position: Point2,
        along: Point2,
        enough_m: f64,
    ) -> f64 {
        let parts = body.convex_parts().iter();
        let rooms = parts.map(|part| self.estimate_of_convex(part, position, along, enough_m));
        rooms.fold(f64::INFINITY, f64::min)
    }

    fn estimate_of_convex(
        &self,
        body: &Body,
        position: Point2,
        along: Point2,
        enough_m: f64,
    ) -> f64 {
        let place = |local: Point2| {
            Point2::new(
                position.x + along.x * local.x - along.y * local.y,
                position.y + along.y * local.x + along.x * local.y,
            )
        };
        let reach_m = body.half.x.max(body.half.y);
        let around_m = SQRT_2 * reach_m + body.disc_radius;
        let middle_m = self.room_about_m(place(body.middle), around_m + enough_m) - around_m;
        if middle_m > enough_m {
            return middle_m;
        }
        let far_m = body.disc_radius + enough_m;
        let least_m = body.discs.iter().fold(f64::INFINITY, |least_m, &disc| {
            // What is above the least of the others need not be told exactly.
            let room_m = self.room_about_m(place(disc), far_m.min(least_m));
            room_m.min(least_m)
        });
        least_m - body.disc_radius
    }

    /// Estimated distance from a point to the nearest lethal square or the border, meters, or a
    /// lower bound of the estimate that is above `far_m`.
    fn room_about_m(&self, p: Point2, far_m: f64) -> f64 {
        let frame = self.frame();
        let resolution_m = frame.resolution_m();
        let extent = frame.extent_m();
        let border_m = p.x.min(p.y).min(extent.x - p.x).min(extent.y - p.y);
        if border_m <= 0.0 {
            return border_m;
        }
        let scale = 1.0 / resolution_m;
        let (x, y) = (p.x * scale, p.y * scale);
        let (last_col, last_row) = (frame.n_cols() - 1, frame.n_rows() - 1);
        let field = self.distance();
        let here = field.squared((x as usize).min(last_col), (y as usize).min(last_row));
        // Centers that surround the point are within a diagonal of that of its own cell.
        let floor = f64::from(here).sqrt() - SQRT_2 - Self::CENTER_TO_SIDE_CELLS;
        if floor * resolution_m > far_m {
            return (floor * resolution_m).min(border_m);
        }
        let (x, y) = ((x - 0.5).max(0.0), (y - 0.5).max(0.0));
        let (col, row) = (x as usize, y as usize);
        let (u, v) = (x - col as f64, y - row as f64);
        let (next_col, above) = ((col + 1).min(last_col), (row + 1).min(last_row));
        let rows = field.squared_of_four([col, next_col], [row, above]);
        let [below, over] = rows.map(|squared| {
            let [left, right] = squared.map(|squared| f64::from(squared).sqrt());
            (1.0 - u) * left + u * right
        });
        let cells = (1.0 - v) * below + v * over - Self::CENTER_TO_SIDE_CELLS;
        (cells * resolution_m).min(border_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::generate::{ScatterParameters, scattered_obstacles};
    use crate::numeric::Seed;
    use crate::vehicle::Vehicle;

    #[test]
    fn is_near_the_truth() {
        let sparse = ScatterParameters {
            density: 0.01,
            ..ScatterParameters::default()
        };
        let map = scattered_obstacles(&sparse, Seed(4)).unwrap();
        let map = ObstacleMap::new(&map);
        let body = Body::new(&Vehicle::lei2020());
        let resolution_m = map.frame().resolution_m();
        let extent = map.frame().extent_m();
        let mut stream = Seed(5).stream([0, 0]);
        let mut n_near = 0;
        for _ in 0..2_000 {
            let (x, y) = (stream.range(0.0, extent.x), stream.range(0.0, extent.y));
            let pose = Pose2::new(x, y, stream.range(-3.0, 3.0));
            // Beyond 1 m neither is told apart.
            let exact_m = map.clearance_m(&body, pose).min(1.0);
            let estimate_m = map.clearance_estimate_m(&body, pose, 1.0).min(1.0);
            n_near += usize::from(exact_m > 0.0 && exact_m < 1.0);
            assert!(estimate_m <= exact_m + 0.5 * resolution_m, "{pose:?}");
            let inside_m = (body.half.x / body.discs.len() as f64).min(body.half.y);
            let low_m = exact_m - resolution_m - (body.disc_radius - inside_m);
            assert!(
                exact_m == 0.0 || estimate_m >= low_m,
                "{pose:?}: {exact_m} {estimate_m}"
            );
        }
        assert!(n_near > 20, "{n_near}");
    }
}
