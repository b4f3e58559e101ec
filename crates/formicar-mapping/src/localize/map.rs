//! A map that a robot is found in.

use crate::config::MappingConfig;
use crate::front_end::TrackMap;
use crate::matching::ScoreGrids;
use crate::sdf::{PackedSdf, Place, SdfMap, SignedDistances};
use formicar::map::{Cell, OCCUPIED, OccupancyGrid, UNKNOWN};
use formicar::{Point2, Pose2};
use std::borrow::Cow;

/// A map that a robot is found in.
#[derive(Clone, Debug)]
pub struct LocalizationMap {
    field: PackedSdf,
    /// Scores for searches around a pose.
    near: Option<ScoreGrids>,
    /// Scores for searches in the whole map.
    pub(super) far: Option<ScoreGrids>,
}

impl SignedDistances for LocalizationMap {
    fn resolution_m(&self) -> f64 {
        self.field.resolution_m()
    }

    fn truncation_m(&self) -> f64 {
        self.field.truncation_m()
    }

    #[inline]
    fn quad(&self, place: Place) -> [f32; 4] {
        self.field.quad(place)
    }

    #[inline]
    fn distance(&self, place: Place) -> f32 {
        self.field.distance(place)
    }
}

impl TrackMap for LocalizationMap {
    fn score_grids(&self) -> Option<Cow<'_, ScoreGrids>> {
        self.near.as_ref().map(Cow::Borrowed)
    }
}

/// Side of a cell of the search in the whole map, meters, and its levels.
const FAR_CELL_M: f64 = 0.1;
const FAR_LEVELS: usize = 7;

impl LocalizationMap {
    /// The map of signed distances that mapping leaves.
    pub fn new(field: &SdfMap) -> Self {
        Self::of_packed(field.packed())
    }

    /// A map of packed distances.
    pub fn of_packed(field: PackedSdf) -> Self {
        Self {
            near: ScoreGrids::new(&field, field.resolution_m(), 5),
            far: ScoreGrids::new(&field, FAR_CELL_M, FAR_LEVELS),
            field,
        }
    }

    /// A map of free, occupied and unknown cells: distances are those to the outline of the
    /// occupied cells, positive in free ground, negative inside.
    ///
    /// Less exact than [`Self::new`]: an occupancy grid knows surfaces to half a cell.
    pub fn of_grid(grid: &OccupancyGrid, config: &MappingConfig) -> Self {
        Self::new(&grid_distances(grid, config))
    }

    /// Lowest and highest corner of the map, meters.
    pub(super) fn extent(&self) -> Option<(Point2, Point2)> {
        let (low, high) = self.field.bounds()?;
        let scale = self.resolution_m();
        let point = |p: Place| Point2::new(f64::from(p.0), f64::from(p.1)) * scale;
        Some((point(low), point(high)))
    }
}

/// Signed distances around the occupied cells of a grid, in world coordinates.
pub fn grid_distances(grid: &OccupancyGrid, config: &MappingConfig) -> SdfMap {
    let frame = grid.frame();
    let (resolution, truncation) = (config.resolution_m, config.truncation_m());
    let reach = (truncation / frame.resolution_m()).ceil() as i64 + 1;
    let mut map = SdfMap::new(resolution, truncation);
    let (low, high) = corners(grid);
    let place = |v: f64| (v / resolution).floor() as i32;
    for y in place(low.y)..=place(high.y) + 1 {
        for x in place(low.x)..=place(high.x) + 1 {
            let point = Point2::new(f64::from(x), f64::from(y)) * resolution;
            let Some(cell) = frame.cell_at(point) else {
                continue;
            };
            let value = grid.value(cell);
            if value == UNKNOWN {
                continue;
            }
            let own = value == OCCUPIED;
            let around = |v: u32| i64::from(v) - reach..=i64::from(v) + reach;
            let cells =
                around(cell.row).flat_map(|row| around(cell.col).map(move |col| (col, row)));
            let distances = cells.filter_map(|cell| distance_to(grid, cell, own, point));
            let nearest = distances.fold(truncation, f64::min);
            let signed = if own { -nearest } else { nearest };
            map.write((x, y), signed.clamp(-truncation, truncation));
        }
    }
    map
}

/// The distance of a point to the square of a cell of the other kind.
fn distance_to(
    grid: &OccupancyGrid,
    (col, row): (i64, i64),
    own: bool,
    point: Point2,
) -> Option<f64> {
    let frame = grid.frame();
    let is_inside =
        (0..frame.n_cols() as i64).contains(&col) && (0..frame.n_rows() as i64).contains(&row);
    if !is_inside {
        return None;
    }
    let cell = Cell::new(col as u32, row as u32);
    let is_other = (grid.value(cell) == OCCUPIED) != own;
    if !is_other {
        return None;
    }
    let local = frame.to_grid(Pose2::at(point, 0.0)).position();
    let center = Point2::new(col as f64 + 0.5, row as f64 + 0.5) * frame.resolution_m();
    let half = 0.5 * frame.resolution_m();
    let (dx, dy) = (
        (local.x - center.x).abs() - half,
        (local.y - center.y).abs() - half,
    );
    Some(Point2::new(dx.max(0.0), dy.max(0.0)).norm())
}

/// Lowest and highest world coordinates of a grid.
fn corners(grid: &OccupancyGrid) -> (Point2, Point2) {
    let extent = grid.frame().extent_m();
    let all = [
        (0.0, 0.0),
        (extent.x, 0.0),
        (0.0, extent.y),
        (extent.x, extent.y),
    ];
    let all = all.map(|(x, y)| grid.frame().to_world(Pose2::new(x, y, 0.0)).position());
    let fold = |of: fn(f64, f64) -> f64| {
        let x = all.iter().map(|p| p.x).reduce(of).unwrap_or_default();
        let y = all.iter().map(|p| p.y).reduce(of).unwrap_or_default();
        Point2::new(x, y)
    };
    (fold(f64::min), fold(f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_has_the_distances_of_its_walls() {
        let rows = [
            "..........",
            "....####..",
            "....####..",
            "..........",
            "??........",
        ];
        let grid = OccupancyGrid::from_rows(&rows, 0.1).unwrap();
        let map = LocalizationMap::of_grid(&grid, &MappingConfig::default());
        let at = |x, y| map.sample(Point2::new(x, y)).map(|s| s.distance_m);
        assert!((at(0.32, 0.3).unwrap() - 0.08).abs() < 0.01);
        assert!(at(0.5, 0.3).unwrap() < -0.05);
        assert_eq!(at(0.04, 0.04), None);
    }
}
