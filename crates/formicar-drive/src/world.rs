//! What stands: occupied squares and solids, seen by exact rays.

use crate::solid::Solid;
use formicar::collision::ObstacleMap;
use formicar::map::BitGrid;
use formicar::{OccupancyGrid, Point2, Pose2};
use formicar_mapping::simulate::{self, Segment};

/// The standing part of the truth: a map and solids on it.
#[derive(Clone, Debug)]
pub struct World {
    map: OccupancyGrid,
    obstacles: ObstacleMap,
    edges: simulate::World,
    solids: Vec<Solid>,
}

impl World {
    /// A world of occupied squares and further solids.
    pub fn new(map: OccupancyGrid, solids: Vec<Solid>) -> Self {
        let obstacles = ObstacleMap::new(&map);
        Self {
            edges: simulate::World::new(edges(&map, obstacles.lethal())),
            obstacles,
            solids,
            map,
        }
    }

    /// The map.
    pub fn map(&self) -> &OccupancyGrid {
        &self.map
    }

    /// The occupied squares, ready for distance queries.
    pub fn obstacles(&self) -> &ObstacleMap {
        &self.obstacles
    }

    /// The solids.
    pub fn solids(&self) -> &[Solid] {
        &self.solids
    }

    /// The exact range of a ray along a unit vector up to an occupied square; none within `max_m`.
    pub fn square_range_m(&self, from: Point2, along: Point2, max_m: f64) -> Option<f64> {
        self.edges.range_m(from, along, max_m)
    }

    /// The exact range of a ray up to a square or a solid; none within `max_m`.
    pub fn range_m(&self, from: Point2, along: Point2, max_m: f64) -> Option<f64> {
        let solids = self.solids.iter().filter_map(|s| s.range_m(from, along));
        let nearest = solids
            .chain(self.square_range_m(from, along, max_m))
            .fold(f64::INFINITY, f64::min);
        (nearest <= max_m).then_some(nearest)
    }
}

/// The edges between occupied squares and the rest, in runs as long as they go.
fn edges(map: &OccupancyGrid, lethal: &BitGrid) -> Vec<Segment> {
    let frame = map.frame();
    let (n_cols, n_rows) = (lethal.n_cols() as i64, lethal.n_rows() as i64);
    let at = |col: i64, row: i64| {
        let local = Point2::new(col as f64, row as f64) * frame.resolution_m();
        frame.to_world(Pose2::at(local, 0.0)).position()
    };
    let mut edges = Vec::new();
    for row in 0..=n_rows {
        let is_edge = |col: i64| lethal.contains(col, row) != lethal.contains(col, row - 1);
        runs(n_cols, is_edge, &mut |begin, end| {
            let (a, b) = (at(begin, row), at(end, row));
            edges.push(Segment { a, b });
        });
    }
    for col in 0..=n_cols {
        let is_edge = |row: i64| lethal.contains(col, row) != lethal.contains(col - 1, row);
        runs(n_rows, is_edge, &mut |begin, end| {
            let (a, b) = (at(col, begin), at(col, end));
            edges.push(Segment { a, b });
        });
    }
    edges
}

/// The runs of places at which something holds.
fn runs(n: i64, holds: impl Fn(i64) -> bool, found: &mut dyn FnMut(i64, i64)) {
    let mut begin = None;
    for i in 0..=n {
        match (begin, i < n && holds(i)) {
            (None, true) => begin = Some(i),
            (Some(from), false) => {
                found(from, i);
                begin = None;
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::scenario::ObstacleShape;
    use proptest::prelude::*;

    /// The range to a square by slabs.
    fn square_m(from: Point2, along: Point2, low: Point2, side_m: f64) -> Option<f64> {
        let slab = |from: f64, along: f64, low: f64| {
            if along == 0.0 {
                let inside = (low..=low + side_m).contains(&from);
                return if inside {
                    (f64::NEG_INFINITY, f64::INFINITY)
                } else {
                    (1.0, 0.0)
                };
            }
            let (a, b) = ((low - from) / along, (low + side_m - from) / along);
            (a.min(b), a.max(b))
        };
        let (x, y) = (slab(from.x, along.x, low.x), slab(from.y, along.y, low.y));
        let (enter, leave) = (x.0.max(y.0), x.1.min(y.1));
        (enter <= leave && enter > 0.0).then_some(enter)
    }

    proptest! {
        #[test]
        fn rays_are_those_of_brute_force(
            occupied in prop::collection::vec((0_usize..12, 0_usize..9), 0..25),
            discs in prop::collection::vec((0.0..6.0_f64, 0.0..4.5_f64, 0.05..0.4_f64), 0..4),
            x in 0.0..6.0_f64, y in 0.0..4.5_f64, angle in -3.2..3.2_f64,
        ) {
            let mut rows = vec![vec!['.'; 12]; 9];
            for &(col, row) in &occupied {
                rows[8 - row][col] = '#';
            }
            let rows: Vec<String> = rows.into_iter().map(|row| row.into_iter().collect()).collect();
            let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
            let map = OccupancyGrid::from_rows(&rows, 0.5).unwrap();
            let discs: Vec<Solid> = discs.iter().map(|&(x, y, radius_m)| {
                Solid::placed(&ObstacleShape::Disc { radius_m }, Pose2::new(x, y, 0.0))
            }).collect();
            let (from, along) = (Point2::new(x, y), Point2::unit(angle));
            let inside = |&(col, row): &(usize, usize)| {
                (x / 0.5).floor() as usize == col && (y / 0.5).floor() as usize == row
            };
            prop_assume!(!occupied.iter().any(inside));
            let squares = occupied.iter().filter_map(|&(col, row)| {
                square_m(from, along, Point2::new(col as f64, row as f64) * 0.5, 0.5)
            });
            let round = discs.iter().filter_map(|d| d.range_m(from, along));
            let brute = squares.chain(round).fold(f64::INFINITY, f64::min);
            match World::new(map, discs.clone()).range_m(from, along, 30.0) {
                Some(range_m) => prop_assert!((range_m - brute).abs() < 1e-9, "{range_m} {brute}"),
                None => prop_assert!(brute > 30.0, "{brute}"),
            }
        }
    }
}
