//! The point of an obstacle nearest to a standing body, which pictures mark.

use super::convex::{Square, edges, point_segment};
use super::{Body, ObstacleMap};
use crate::geometry::{Point2, Pose2};
use crate::vehicle::Vehicle;

/// A distance and the point of the obstacle at which it is measured.
type Contact = (f64, Point2);

impl ObstacleMap {
    /// The point of a lethal square, or of the border, that a standing body comes nearest to.
    pub fn nearest_obstacle(&self, body: &Body, pose: Pose2) -> Point2 {
        let parts = body.convex_parts().iter();
        nearest(parts.map(|part| self.nearest_to_convex(part, pose)))
            .map_or(pose.position(), |(_, place)| place)
    }

    fn nearest_to_convex(&self, body: &Body, pose: Pose2) -> Contact {
        let corners: Vec<Point2> = body.corners.iter().map(|&p| pose.transform(p)).collect();
        let border = corners.iter().map(|&p| self.border_contact(p));
        let border = nearest(border).unwrap_or((f64::INFINITY, pose.position()));
        let reach = self.clearance_m(body, pose) + self.frame().resolution_m();
        let (low, high) = corners
            .iter()
            .fold((corners[0], corners[0]), |(low, high), p| {
                (
                    Point2::new(low.x.min(p.x), low.y.min(p.y)),
                    Point2::new(high.x.max(p.x), high.y.max(p.y)),
                )
            });
        let (cols, rows) = self.cells_between(low, high, reach);
        let cells = rows.flat_map(|row| cols.clone().map(move |col| (col, row)));
        let squares = cells
            .filter(|&(col, row)| self.rim().contains(col as i64, row as i64))
            .filter_map(|cell| square_contact(&corners, &self.square(cell)));
        nearest(squares.chain([border])).unwrap_or(border)
    }

    /// The same for a vehicle at a world pose, in world coordinates.
    pub fn contact(&self, vehicle: &Vehicle, pose: Pose2) -> Point2 {
        let frame = self.frame();
        let place = self.nearest_obstacle(&Body::new(vehicle), frame.to_grid(pose));
        frame.to_world(Pose2::at(place, 0.0)).position()
    }

    fn square(&self, (col, row): (usize, usize)) -> Square {
        let resolution = self.frame().resolution_m();
        Square {
            center: Point2::new(col as f64 + 0.5, row as f64 + 0.5) * resolution,
            half: 0.5 * resolution,
        }
    }

    fn border_contact(&self, p: Point2) -> Contact {
        let extent = self.frame().extent_m();
        let sides = [
            (p.x, Point2::new(0.0, p.y)),
            (p.y, Point2::new(p.x, 0.0)),
            (extent.x - p.x, Point2::new(extent.x, p.y)),
            (extent.y - p.y, Point2::new(p.x, extent.y)),
        ];
        nearest(sides).unwrap_or((f64::INFINITY, p))
    }
}

/// The nearest point of a square: if polygon and square are apart, a corner of one of them is in a
/// nearest pair.
fn square_contact(corners: &[Point2], square: &Square) -> Option<Contact> {
    let clamped = |v: f64, middle: f64| v.clamp(middle - square.half, middle + square.half);
    let from_corners = corners.iter().map(|&p| {
        let on_square = Point2::new(clamped(p.x, square.center.x), clamped(p.y, square.center.y));
        (p.distance(on_square), on_square)
    });
    let from_square = square
        .corners()
        .into_iter()
        .flat_map(|q| edges(corners).map(move |(a, b)| (point_segment(q, a, b), q)));
    nearest(from_corners.chain(from_square))
}

fn nearest(contacts: impl IntoIterator<Item = Contact>) -> Option<Contact> {
    contacts.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::convex::point_boundary;
    use crate::map::OccupancyGrid;

    #[test]
    fn finds_the_corner_beside_the_body_and_the_border() {
        let rows = [".......", "....#..", ".......", ".......", "......."];
        let map = ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 1.0).unwrap());
        let body = Body::new(&Vehicle::warehouse_amr());
        // Its front right corner lies at (3.775, 2.19), 0.81 below and 0.225 left of the square.
        let beside = map.nearest_obstacle(&body, Pose2::new(3.0, 2.5, 0.0));
        assert_eq!(beside, Point2::new(4.0, 3.0));
        let border = map.nearest_obstacle(&body, Pose2::new(3.0, 0.5, 0.0));
        assert_eq!(border.y, 0.0);
    }

    #[test]
    fn lies_as_far_off_as_the_clearance() {
        let rows = ["........", "..#..#..", "........", "...#....", "........"];
        let map = ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 0.5).unwrap());
        let vehicle = Vehicle::warehouse_amr();
        let body = Body::new(&vehicle);
        for i in 0..40 {
            let pose = Pose2::new(1.0 + 0.04 * f64::from(i), 1.2, 0.3 * f64::from(i));
            let clearance_m = map.clearance_m(&body, pose);
            if clearance_m > 0.0 {
                let place = map.nearest_obstacle(&body, pose);
                let placed = vehicle.footprint().placed(pose);
                let distance_m = point_boundary(place, placed.corners());
                assert!((distance_m - clearance_m).abs() < 1e-9, "{pose:?}");
            }
        }
    }
}
