//! A map made ready for distance queries: the map set-up that every query shares.

use super::Body;
use crate::geometry::{Point2, Pose2};
use crate::map::{
    self, BitGrid, Cell, CellRegion, DistanceField, GridFrame, MapError, OccupancyGrid,
};
use std::ops::Range;
use std::sync::OnceLock;
use xxhash_rust::xxh3::xxh3_128;

/// The lethal cells of a map, those on the rim of an obstacle, and the distance transform.
///
/// ```
/// use formicar::collision::{Body, Drive, ObstacleMap};
/// use formicar::{OccupancyGrid, Pose2, Vehicle};
///
/// let map = OccupancyGrid::from_rows(&["..........", "..........", "..........", "#########."], 1.0)?;
/// let (obstacles, body) = (ObstacleMap::new(&map), Body::new(&Vehicle::warehouse_amr()));
/// assert!(obstacles.is_free(&body, &Drive::at(Pose2::new(5.0, 2.5, 0.0))));
/// assert!(!obstacles.is_free(&body, &Drive::at(Pose2::new(5.0, 0.9, 0.0))));
/// # Ok::<(), formicar::MapError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ObstacleMap {
    frame: GridFrame,
    lethal: BitGrid,
    rim: BitGrid,
    distance: DistanceField,
    hash: OnceLock<u128>,
}

impl ObstacleMap {
    /// Prepares a map: cost proportional to its cells.
    pub fn new(map: &OccupancyGrid) -> Self {
        let lethal = map.lethal_cells();
        let mut rim = BitGrid::new(lethal.n_cols(), lethal.n_rows());
        refresh_rim(&mut rim, &lethal, 0..lethal.n_rows());
        Self {
            frame: *map.frame(),
            rim,
            distance: DistanceField::new(&lethal, DistanceField::DEFAULT_TRUNCATION_CELLS),
            lethal,
            hash: OnceLock::new(),
        }
    }

    /// Puts new values into a rectangle of cells, row by row, lowest row first; the rectangle
    /// about all cells that have become lethal or have ceased to be, none where there are none.
    ///
    /// The result is the same, to the bit, as that of preparing the changed map anew. Cost is
    /// proportional to the cells of the changed rectangle grown by twice the truncation of the
    /// distance transform.
    ///
    /// # Errors
    /// A part of it off the map, another number of values than cells, or a value outside
    /// -1..=100; nothing is changed then.
    pub fn update(
        &mut self,
        region: &CellRegion,
        values: &[i8],
    ) -> Result<Option<CellRegion>, MapError> {
        region.check(&self.frame, values)?;
        let mut changed: Option<CellRegion> = None;
        for (cell, &value) in region.cells().zip(values) {
            let (col, row) = (cell.col as usize, cell.row as usize);
            let is_lethal = map::lethal(value);
            if is_lethal == self.lethal.get(col, row) {
                continue;
            }
            if is_lethal {
                self.lethal.insert(cell);
            } else {
                self.lethal.remove(cell);
            }
            let here = CellRegion::new(cell, 1, 1);
            changed = Some(changed.map_or(here, |changed| changed.with(&here)));
        }
        let Some(changed) = changed else {
            return Ok(None);
        };
        let beside = changed.grown(1, self.lethal.n_cols(), self.lethal.n_rows());
        refresh_rim(&mut self.rim, &self.lethal, beside.rows());
        self.distance.refresh(&self.lethal, &changed);
        self.hash = OnceLock::new();
        Ok(Some(changed))
    }

    /// The same map with some cells free: cost proportional to the map, or to the rectangle about
    /// these cells where few are given.
    #[must_use]
    pub fn without(&self, cells: &[Cell]) -> Self {
        let mut opened = self.clone();
        let here = |&cell: &Cell| CellRegion::new(cell, 1, 1);
        let region = cells.iter().map(here).reduce(|all, cell| all.with(&cell));
        if let Some(region) = region {
            let value = |cell: Cell| {
                let (col, row) = (cell.col as usize, cell.row as usize);
                let is_kept = self.lethal.get(col, row) && !cells.contains(&cell);
                if is_kept { map::OCCUPIED } else { map::FREE }
            };
            let values: Vec<i8> = region.cells().map(value).collect();
            let updated = opened.update(&region, &values);
            updated.expect("cells of the map, and a value for each");
        }
        opened
    }

    /// Size, resolution and origin of the map.
    pub fn frame(&self) -> &GridFrame {
        &self.frame
    }

    /// Occupied and unknown cells.
    pub fn lethal(&self) -> &BitGrid {
        &self.lethal
    }

    /// Distances between cell centers, to the nearest lethal one.
    pub fn distance(&self) -> &DistanceField {
        &self.distance
    }

    /// A 128-bit hash of frame and lethal cells, all that the judge depends on.
    pub fn hash(&self) -> u128 {
        *self.hash.get_or_init(|| {
            let origin = self.frame.origin();
            let numbers = [
                self.frame.resolution_m(),
                origin.x,
                origin.y,
                origin.heading,
            ];
            let sizes = [self.frame.n_cols() as u64, self.frame.n_rows() as u64];
            let bytes: Vec<u8> = sizes
                .into_iter()
                .chain(numbers.map(f64::to_bits))
                .chain(self.lethal.words().iter().copied())
                .flat_map(u64::to_le_bytes)
                .collect();
            xxh3_128(&bytes)
        })
    }

    /// Lethal cells with a neighbor across a side that is not lethal.
    pub(super) fn rim(&self) -> &BitGrid {
        &self.rim
    }

    /// Whether a point lies in a lethal square shrunk by an inset.
    pub(super) fn covers(&self, p: Point2, inset: f64) -> bool {
        let resolution = self.frame.resolution_m();
        let (x, y) = (p.x / resolution, p.y / resolution);
        let margin = inset / resolution;
        let inner = |v: f64| (margin..=1.0 - margin).contains(&(v - v.floor()));
        self.lethal.contains(x.floor() as i64, y.floor() as i64) && inner(x) && inner(y)
    }

    /// An upper bound of a standing body's clearance, meters, from one look at the distance
    /// transform; where it is negative, the body's inner disc certainly overlaps something.
    pub fn clearance_ceiling_m(&self, body: &Body, pose: Pose2) -> f64 {
        self.ceiling_at_m(body, pose.position(), Point2::unit(pose.heading))
    }

    /// The same of a pose given as a position and a unit vector.
    pub fn ceiling_at_m(&self, body: &Body, position: Point2, along: Point2) -> f64 {
        let center = body.inner_center;
        let center = position + along * center.x + along.perpendicular() * center.y;
        self.obstacle_within_m(center) - body.inner_radius
    }

    /// The radius of a disc about a point that holds no part of a lethal square; 0 off the map.
    pub(super) fn free_radius_m(&self, p: Point2) -> f64 {
        // From the cell's center to the point and from a square's center to its corner: half a
        // diagonal each.
        self.cell_distance(p).map_or(0.0, |d| {
            (d - std::f64::consts::SQRT_2) * self.frame.resolution_m()
        })
    }

    /// The radius of a disc about a point that certainly reaches a lethal square.
    pub(super) fn obstacle_within_m(&self, p: Point2) -> f64 {
        let resolution = self.frame.resolution_m();
        match self.cell_distance(p) {
            Some(d) if d < f64::from(self.distance.truncation_cells()) => {
                (d + std::f64::consts::FRAC_1_SQRT_2 - 0.5) * resolution
            }
            Some(d) => 2.0 * d * resolution,
            None => resolution,
        }
    }

    /// The gap between a box and the map's border; negative where the box reaches out.
    pub(super) fn border_gap(&self, low: Point2, high: Point2) -> f64 {
        let extent = self.frame.extent_m();
        low.x
            .min(low.y)
            .min(extent.x - high.x)
            .min(extent.y - high.y)
    }

    /// Columns and rows of the cells that a box widened by `reach` touches.
    pub(super) fn cells_between(
        &self,
        low: Point2,
        high: Point2,
        reach: f64,
    ) -> (Range<usize>, Range<usize>) {
        let scale = 1.0 / self.frame.resolution_m();
        let range = |low: f64, high: f64, n: usize| {
            // A closed square also touches what ends on its side: one cell more at both ends.
            let from = ((low - reach) * scale - 1.0).max(0.0) as usize;
            let to = ((high + reach) * scale + 2.0).clamp(0.0, n as f64) as usize;
            from.min(to)..to
        };
        (
            range(low.x, high.x, self.frame.n_cols()),
            range(low.y, high.y, self.frame.n_rows()),
        )
    }

    fn cell_distance(&self, p: Point2) -> Option<f64> {
        let scale = 1.0 / self.frame.resolution_m();
        let (col, row) = (p.x * scale, p.y * scale);
        let inside = col >= 0.0
            && row >= 0.0
            && col < self.frame.n_cols() as f64
            && row < self.frame.n_rows() as f64;
        inside.then(|| f64::from(self.distance.squared(col as usize, row as usize)).sqrt())
    }
}

/// Works out which cells of some rows are on the rim.
fn refresh_rim(rim: &mut BitGrid, lethal: &BitGrid, rows: Range<usize>) {
    let (n_cols, n_rows) = (lethal.n_cols(), lethal.n_rows());
    let last_bit = 1 << ((n_cols - 1) % 64);
    for row in rows {
        let here = lethal.row(row);
        let below = lethal.row(row.saturating_sub(1));
        let above = lethal.row((row + 1).min(n_rows - 1));
        for w in 0..here.len() {
            // Beyond the border nothing is free: the border itself stops the body.
            let carry_in = if w == 0 { 1 } else { here[w - 1] >> 63 };
            let carry_out = here.get(w + 1).map_or(last_bit, |next| next << 63);
            let west = here[w] << 1 | carry_in;
            let east = here[w] >> 1 | carry_out;
            rim.row_mut(row)[w] = here[w] & !(west & east & below[w] & above[w]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 5))]

        #[test]
        fn an_updated_map_is_that_of_the_changed_cells(
            n_cols in 1_usize..400,
            n_rows in 1_usize..80,
            density in 0_usize..40,
            updates in prop::collection::vec((0.0..1.0, 0.0..1.0, 1_usize..40, 1_usize..40), 1..4),
            seed in any::<u64>(),
        ) {
            let mut draw = crate::numeric::Seed(seed).stream([0, 0]);
            let rows = vec![".".repeat(n_cols); n_rows];
            let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
            let mut grid = OccupancyGrid::from_rows(&rows, 0.5).unwrap();
            for _ in 0..density {
                let cell = Cell::new(draw.below(n_cols) as u32, draw.below(n_rows) as u32);
                grid.set(cell, map::OCCUPIED);
            }
            let mut map = ObstacleMap::new(&grid);
            for (x, y, width, height) in updates {
                let (col, row) = ((x * n_cols as f64) as usize, (y * n_rows as f64) as usize);
                let (width, height) = (width.min(n_cols - col), height.min(n_rows - row));
                let region = CellRegion::new(Cell::new(col as u32, row as u32), width, height);
                let n_kinds = 1 + draw.below(3);
                let values: Vec<i8> = (0..width * height)
                    .map(|_| [0, 100, -1][draw.below(n_kinds)])
                    .collect();
                map.hash();
                map.update(&region, &values).unwrap();
                grid.replace(&region, &values).unwrap();
                let fresh = ObstacleMap::new(&grid);
                prop_assert_eq!(map.lethal(), fresh.lethal());
                prop_assert_eq!(map.rim(), fresh.rim());
                prop_assert_eq!(map.distance(), fresh.distance());
                prop_assert_eq!(map.hash(), fresh.hash());
            }
        }
    }

    #[test]
    fn an_update_tells_what_it_changed() {
        let map = OccupancyGrid::from_rows(&["....", "..#.", "...."], 1.0).unwrap();
        let mut map = ObstacleMap::new(&map);
        let whole = CellRegion::new(Cell::new(0, 0), 4, 3);
        let mut values = [0; 12];
        values[6] = map::UNKNOWN;
        assert_eq!(map.update(&whole, &values).unwrap(), None);
        values[1] = 100;
        values[8] = 100;
        let changed = CellRegion::new(Cell::new(0, 0), 2, 3);
        assert_eq!(map.update(&whole, &values).unwrap(), Some(changed));
        assert!(map.update(&whole, &values[1..]).is_err());
    }

    #[test]
    fn the_rim_faces_free_ground() {
        let rows = ["#####", "#####", "#####", "##.##", "....."];
        let map = ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 1.0).unwrap());
        let rim: Vec<_> = map.rim().iter().map(|c| (c.col, c.row)).collect();
        assert_eq!(rim, [(0, 1), (1, 1), (3, 1), (4, 1), (2, 2)]);
    }

    #[test]
    fn the_hash_sees_cells_and_frame() {
        let hash = |rows: &[&str], resolution| {
            ObstacleMap::new(&OccupancyGrid::from_rows(rows, resolution).unwrap()).hash()
        };
        let first = hash(&["..", ".#"], 1.0);
        assert_eq!(first, hash(&["..", ".?"], 1.0));
        assert_ne!(first, hash(&["..", "#."], 1.0));
        assert_ne!(first, hash(&["..", ".#"], 2.0));
    }
}
