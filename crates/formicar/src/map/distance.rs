//! Distance of every cell to the nearest obstacle: exact, Euclidean, truncated.

use super::distance_transform::{LANES, squared_distances};
use super::{BitGrid, Cell, CellRegion};
use std::ops::Range;
use std::sync::OnceLock;

/// Squared distances between cell centers, in cells, to the nearest obstacle cell.
///
/// Values at or beyond the truncation are saturated to its square. The border of the map is no
/// obstacle. Distances are computed tile by tile when they are first asked for, so that a query
/// pays for the part of the map that it looks at.
///
/// ```
/// use formicar::OccupancyGrid;
/// use formicar::map::{Cell, DistanceField};
///
/// let map = OccupancyGrid::from_rows(&[".....", "....#"], 1.0)?;
/// let field = DistanceField::new(&map.lethal_cells(), 16);
/// assert_eq!(field.distance_cells(Cell::new(1, 0)), 3.0);
/// assert_eq!(field.within(1.0).unwrap().count(), 3);
/// # Ok::<(), formicar::MapError>(())
/// ```
#[derive(Clone, Debug)]
pub struct DistanceField {
    obstacles: BitGrid,
    truncation_cells: u16,
    n_tile_cols: usize,
    /// Squared distances, row by row within a tile; tiles row by row.
    tiles: Vec<OnceLock<Box<Tile>>>,
}

/// Side of a tile, cells: a few truncations, since a tile is computed from what lies within one
/// around it.
const SIDE: usize = 128;

type Tile = [u16; SIDE * SIDE];

const _: () = assert!(SIDE.is_multiple_of(LANES));

impl DistanceField {
    /// A truncation that serves vehicles up to a few meters at usual resolutions.
    pub const DEFAULT_TRUNCATION_CELLS: u32 = 64;
    /// The largest truncation: its square still fits 16 bits.
    pub const MAX_TRUNCATION_CELLS: u32 = 255;

    /// The distance field of a set of obstacle cells.
    ///
    /// `truncation_cells` is clamped to 1..=[`Self::MAX_TRUNCATION_CELLS`]. The cost of a tile
    /// grows with the truncation where the map is open, and is less where obstacles are near.
    pub fn new(obstacles: &BitGrid, truncation_cells: u32) -> Self {
        let n_tile_cols = obstacles.n_cols().div_ceil(SIDE);
        let n_tiles = n_tile_cols * obstacles.n_rows().div_ceil(SIDE);
        Self {
            obstacles: obstacles.clone(),
            truncation_cells: truncation_cells.clamp(1, Self::MAX_TRUNCATION_CELLS) as u16,
            n_tile_cols,
            tiles: vec![OnceLock::new(); n_tiles],
        }
    }

    /// The cells whose distance may depend on a rectangle of obstacle cells.
    fn reach(&self, changed: &CellRegion) -> CellRegion {
        changed.grown(
            usize::from(self.truncation_cells),
            self.n_cols(),
            self.n_rows(),
        )
    }

    /// Takes over a rectangle of obstacle cells that has changed: the same bits as a field that is
    /// made anew, at a cost that grows with the rectangle grown by twice the truncation.
    pub fn refresh(&mut self, obstacles: &BitGrid, changed: &CellRegion) {
        for row in changed.rows() {
            self.obstacles
                .row_mut(row)
                .copy_from_slice(obstacles.row(row));
        }
        let reach = self.reach(changed);
        let tiles = |range: Range<usize>| range.start / SIDE..range.end.div_ceil(SIDE);
        for tile_row in tiles(reach.rows()) {
            for tile_col in tiles(reach.cols()) {
                self.refresh_tile((tile_col, tile_row), &reach);
            }
        }
    }

    /// Computes anew the part of a tile that lies in a rectangle, if the tile was asked for.
    fn refresh_tile(&mut self, (tile_col, tile_row): (usize, usize), reach: &CellRegion) {
        let place = tile_row * self.n_tile_cols + tile_col;
        let Some(tile) = self.tiles[place].get_mut() else {
            return;
        };
        let within = |range: Range<usize>, tile: usize| {
            range.start.max(tile * SIDE)..range.end.min((tile + 1) * SIDE)
        };
        let (mut cols, rows) = (
            within(reach.cols(), tile_col),
            within(reach.rows(), tile_row),
        );
        cols.start = cols.start / LANES * LANES;
        let cells = CellRegion::of_ranges(&cols, &rows);
        let fresh = squared_distances(&self.obstacles, self.truncation_cells, &cells);
        for (row, fresh) in rows.zip(fresh.chunks_exact(cols.len())) {
            tile[row % SIDE * SIDE + cols.start % SIDE..][..cols.len()].copy_from_slice(fresh);
        }
    }

    /// Number of columns.
    pub fn n_cols(&self) -> usize {
        self.obstacles.n_cols()
    }

    /// Number of rows.
    pub fn n_rows(&self) -> usize {
        self.obstacles.n_rows()
    }

    /// Distances from this one on are not told apart, cells.
    pub fn truncation_cells(&self) -> u32 {
        u32::from(self.truncation_cells)
    }

    /// Squared distance of a cell, in squared cells; at most the squared truncation.
    #[inline]
    pub fn squared(&self, col: usize, row: usize) -> u16 {
        self.tile(col, row)[row % SIDE * SIDE + col % SIDE]
    }

    /// The squared distances of two columns in one row, and of the same in another.
    #[inline]
    pub(crate) fn squared_of_four(&self, cols: [usize; 2], rows: [usize; 2]) -> [[u16; 2]; 2] {
        let is_in_one_tile = cols[0] / SIDE == cols[1] / SIDE && rows[0] / SIDE == rows[1] / SIDE;
        if is_in_one_tile {
            let tile = self.tile(cols[0], rows[0]);
            rows.map(|row| cols.map(|col| tile[row % SIDE * SIDE + col % SIDE]))
        } else {
            rows.map(|row| cols.map(|col| self.squared(col, row)))
        }
    }

    /// The squared distances of all cells, row by row, lowest row first.
    pub fn values(&self) -> impl Iterator<Item = u16> + '_ {
        let rows = 0..self.n_rows();
        rows.flat_map(move |row| (0..self.n_cols()).map(move |col| self.squared(col, row)))
    }

    /// Distance of a cell's center to the nearest obstacle cell's center, cells; at most the
    /// truncation.
    pub fn distance_cells(&self, cell: Cell) -> f64 {
        f64::from(self.squared(cell.col as usize, cell.row as usize)).sqrt()
    }

    /// The cells at a distance of at most `radius_cells`: obstacles grown by that radius. No tile
    /// is computed for it.
    ///
    /// None if the radius is negative, not a number, or not below the truncation, where the field
    /// cannot tell.
    pub fn within(&self, radius_cells: f64) -> Option<BitGrid> {
        let squared = self.square_within(radius_cells)?;
        Some(self.obstacles.grown(squared))
    }

    /// The largest squared distance, as [`Self::squared`] tells it, that is within a radius; none
    /// as for [`Self::within`].
    pub fn square_within(&self, radius_cells: f64) -> Option<u16> {
        if !(0.0..f64::from(self.truncation_cells)).contains(&radius_cells) {
            return None;
        }
        // The largest square whose root, as rounded by `distance_cells`, is within the radius.
        let mut limit = (radius_cells * radius_cells) as u16 + 1;
        while f64::from(limit).sqrt() > radius_cells {
            limit -= 1;
        }
        Some(limit)
    }

    #[inline]
    fn tile(&self, col: usize, row: usize) -> &Tile {
        let (tile_col, tile_row) = (col / SIDE, row / SIDE);
        let tile = &self.tiles[tile_row * self.n_tile_cols + tile_col];
        tile.get_or_init(|| self.computed(tile_col, tile_row))
    }

    #[cold]
    fn computed(&self, tile_col: usize, tile_row: usize) -> Box<Tile> {
        let range = |tile: usize, n: usize| tile * SIDE..((tile + 1) * SIDE).min(n);
        let (cols, rows) = (
            range(tile_col, self.n_cols()),
            range(tile_row, self.n_rows()),
        );
        let cells = CellRegion::of_ranges(&cols, &rows);
        let squared = squared_distances(&self.obstacles, self.truncation_cells, &cells);
        let mut tile = vec![0; SIDE * SIDE];
        for (target, source) in tile
            .chunks_exact_mut(SIDE)
            .zip(squared.chunks_exact(cols.len()))
        {
            target[..cols.len()].copy_from_slice(source);
        }
        tile.try_into().expect("as long as a tile")
    }
}

impl PartialEq for DistanceField {
    /// Distances are a function of these, computed or not.
    fn eq(&self, other: &Self) -> bool {
        self.truncation_cells == other.truncation_cells && self.obstacles == other.obstacles
    }
}

impl Eq for DistanceField {}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn brute_force(lethal: &BitGrid, truncation: u32, cell: Cell) -> u16 {
        let squared = |other: Cell| {
            let (dx, dy) = (cell.col.abs_diff(other.col), cell.row.abs_diff(other.row));
            dx * dx + dy * dy
        };
        let nearest = lethal.iter().map(squared).min().unwrap_or(u32::MAX);
        nearest.min(truncation * truncation) as u16
    }

    fn assert_exact(lethal: &BitGrid, truncation: u32) {
        let field = DistanceField::new(lethal, truncation);
        for row in 0..lethal.n_rows() {
            for col in 0..lethal.n_cols() {
                let expected = brute_force(lethal, truncation, Cell::new(col as u32, row as u32));
                assert_eq!(field.squared(col, row), expected, "cell ({col}, {row})");
            }
        }
    }

    #[test]
    fn one_obstacle_makes_rings_up_to_the_truncation() {
        let mut lethal = BitGrid::new(600, 3);
        lethal.insert(Cell::new(300, 1));
        assert_exact(&lethal, 1);
        assert_exact(&lethal, 32);
        assert_exact(&lethal, 255);
    }

    #[test]
    fn without_obstacles_all_is_far() {
        let field = DistanceField::new(&BitGrid::new(5, 2), 1000);
        assert_eq!(field.truncation_cells(), 255);
        assert!(field.values().all(|d| d == 255 * 255));
        assert_eq!(field.distance_cells(Cell::new(4, 1)), 255.0);
    }

    #[test]
    fn growing_obstacles_includes_the_radius_itself() {
        let mut lethal = BitGrid::new(70, 70);
        lethal.insert(Cell::new(66, 30));
        let field = DistanceField::new(&lethal, 8);
        for squared in [0, 1, 2, 3, 5, 8, 50] {
            let radius = f64::from(squared).sqrt();
            let grown = field.within(radius).unwrap();
            let cells = (0..70 * 70).map(|i| Cell::new(i % 70, i / 70));
            let near = cells.filter(|&cell| field.distance_cells(cell) <= radius);
            assert!(grown.iter().eq(near), "{squared}");
        }
        assert!(field.within(8.0).is_none() && field.within(f64::NAN).is_none());
    }

    proptest! {
        #[test]
        fn equals_brute_force(
            n_cols in 1_usize..140,
            n_rows in 1_usize..40,
            truncation in prop_oneof![1_u32..40, 200_u32..=255],
            places in prop::collection::vec((0.0..1.0, 0.0..1.0), 0..60),
        ) {
            let mut lethal = BitGrid::new(n_cols, n_rows);
            for (x, y) in places {
                let (col, row) = (x * n_cols as f64, y * n_rows as f64);
                lethal.insert(Cell::new(col as u32, row as u32));
            }
            assert_exact(&lethal, truncation);
        }
    }
}
