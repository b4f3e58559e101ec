//! Distance of every cell to the nearest obstacle: exact, Euclidean, truncated.

use super::{BitGrid, Cell, CellRegion};
use std::ops::Range;

/// Cells handled together: a few vector registers of 16-bit lanes.
const LANES: usize = 32;

/// Column offsets tried between two looks at the bound that ends the row pass.
const OFFSETS_PER_LOOK: usize = 4;

/// Squared distances between cell centers, in cells, to the nearest obstacle cell.
///
/// Values at or beyond the truncation are saturated to its square. The border of the map is no
/// obstacle. The transform is separable: a pass along the columns counts cells to the nearest
/// obstacle above and below, a pass along the rows takes the lower envelope of parabolas
/// (Felzenszwalb & Huttenlocher 2012), here as a plain minimum over the offsets that the
/// truncation allows, many cells at once, ended as soon as no farther offset can matter.
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
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DistanceField {
    n_cols: usize,
    n_rows: usize,
    truncation_cells: u16,
    squared: Vec<u16>,
}

impl DistanceField {
    /// A truncation that serves vehicles up to a few meters at usual resolutions.
    pub const DEFAULT_TRUNCATION_CELLS: u32 = 64;
    /// The largest truncation: its square still fits 16 bits.
    pub const MAX_TRUNCATION_CELLS: u32 = 255;

    /// The distance field of a set of obstacle cells.
    ///
    /// `truncation_cells` is clamped to 1..=[`Self::MAX_TRUNCATION_CELLS`]. The cost grows with
    /// cells times truncation where the map is open, and less where obstacles are near.
    pub fn new(lethal: &BitGrid, truncation_cells: u32) -> Self {
        let truncation = truncation_cells.clamp(1, Self::MAX_TRUNCATION_CELLS) as u16;
        let (n_cols, n_rows) = (lethal.n_cols(), lethal.n_rows());
        Self {
            n_cols,
            n_rows,
            truncation_cells: truncation,
            squared: squared_distances(lethal, truncation, 0..n_rows),
        }
    }

    /// The cells whose distance may depend on a rectangle of obstacle cells.
    pub fn reach(&self, changed: &CellRegion) -> CellRegion {
        changed.grown(usize::from(self.truncation_cells), self.n_cols, self.n_rows)
    }

    /// Works out anew what may depend on a changed rectangle of obstacle cells: the same bits as a
    /// field that is made anew, at a cost that grows with the rectangle grown by twice the
    /// truncation.
    pub fn refresh(&mut self, lethal: &BitGrid, changed: &CellRegion) {
        let inner = self.reach(changed);
        // Whatever decides these distances lies in here.
        let outer = self.reach(&inner);
        let first_col = outer.cols().start / 64 * 64;
        let window = lethal.window(first_col..outer.cols().end, outer.rows());
        let low = outer.rows().start;
        let rows = inner.rows().start - low..inner.rows().end - low;
        let fresh = squared_distances(&window, self.truncation_cells, rows);
        for row in inner.rows() {
            let source = &fresh[(row - low) * window.n_cols()..][..window.n_cols()];
            let cols = inner.cols();
            let source = &source[cols.start - first_col..cols.end - first_col];
            self.squared[row * self.n_cols..][cols].copy_from_slice(source);
        }
    }

    /// Number of columns.
    pub fn n_cols(&self) -> usize {
        self.n_cols
    }

    /// Number of rows.
    pub fn n_rows(&self) -> usize {
        self.n_rows
    }

    /// Distances from this one on are not told apart, cells.
    pub fn truncation_cells(&self) -> u32 {
        u32::from(self.truncation_cells)
    }

    /// Squared distance of a cell, in squared cells; at most the squared truncation.
    pub fn squared(&self, col: usize, row: usize) -> u16 {
        self.squared[row * self.n_cols + col]
    }

    /// The squared distances of all cells, row by row, lowest row first.
    pub fn as_slice(&self) -> &[u16] {
        &self.squared
    }

    /// The squared distances of a row.
    pub fn row(&self, row: usize) -> &[u16] {
        &self.squared[row * self.n_cols..][..self.n_cols]
    }

    /// The squared distances row by row, lowest row first.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[u16]> {
        (0..self.n_rows).map(|row| self.row(row))
    }

    /// Distance of a cell's center to the nearest obstacle cell's center, cells; at most the
    /// truncation.
    pub fn distance_cells(&self, cell: Cell) -> f64 {
        f64::from(self.squared(cell.col as usize, cell.row as usize)).sqrt()
    }

    /// The cells at a distance of at most `radius_cells`: obstacles grown by that radius.
    ///
    /// None if the radius is negative, not a number, or not below the truncation, where the field
    /// cannot tell.
    pub fn within(&self, radius_cells: f64) -> Option<BitGrid> {
        let limit = self.square_within(radius_cells)?;
        Some(BitGrid::of_values(self.n_cols, &self.squared, |d| {
            d <= limit
        }))
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
}

/// The squared distances of some rows; of the others, something else.
fn squared_distances(lethal: &BitGrid, truncation: u16, rows: Range<usize>) -> Vec<u16> {
    let n_cols = lethal.n_cols();
    let mut squared = distances_below(lethal, truncation);
    let mut rows_above = vec![truncation; n_cols.next_multiple_of(64)];
    let mut sweep = RowSweep::new(n_cols, truncation);
    for row in (rows.start..lethal.n_rows()).rev() {
        extend_runs(&mut rows_above, lethal.row(row), truncation);
        if rows.contains(&row) {
            let cells = &mut squared[row * n_cols..][..n_cols];
            sweep.load(&rows_above, cells);
            sweep.store(cells);
        }
    }
    squared
}

/// For every cell the rows down to the nearest obstacle of its column, at most the truncation.
fn distances_below(lethal: &BitGrid, truncation: u16) -> Vec<u16> {
    let n_cols = lethal.n_cols();
    let mut below = Vec::with_capacity(n_cols * lethal.n_rows());
    let mut runs = vec![truncation; n_cols.next_multiple_of(64)];
    for row in 0..lethal.n_rows() {
        extend_runs(&mut runs, lethal.row(row), truncation);
        below.extend_from_slice(&runs[..n_cols]);
    }
    below
}

/// Each bit of 16 in a lane of its own.
const BITS: [u16; 16] = {
    let mut bits = [0; 16];
    let mut i = 0;
    while i < 16 {
        bits[i] = 1 << i;
        i += 1;
    }
    bits
};

/// Steps to the next row: runs of free cells grow by one, up to the limit, or end at an obstacle.
fn extend_runs(runs: &mut [u16], obstacles: &[u64], limit: u16) {
    for (runs, &word) in runs.as_chunks_mut::<64>().0.iter_mut().zip(obstacles) {
        for (i, runs) in runs.as_chunks_mut::<16>().0.iter_mut().enumerate() {
            let obstacles = (word >> (16 * i)) as u16;
            for (run, bit) in runs.iter_mut().zip(BITS) {
                let keep = if obstacles & bit == 0 { u16::MAX } else { 0 };
                *run = (*run + 1).min(limit) & keep;
            }
        }
    }
}

/// The pass along one row.
///
/// It works on nearness, truncation squared minus distance squared: 0 is far away or off the map,
/// and saturating subtraction does the truncation.
struct RowSweep {
    /// Nearness along the columns alone, with zeros beyond both ends of the row.
    near: Vec<u16>,
    /// The largest nearness of each block of `near`.
    peaks: Vec<u16>,
    n_pad_blocks: usize,
    truncation: u16,
}

impl RowSweep {
    fn new(n_cols: usize, truncation: u16) -> Self {
        let n_pad_blocks = (usize::from(truncation) + OFFSETS_PER_LOOK).div_ceil(LANES);
        let n_blocks = n_cols.div_ceil(LANES) + 2 * n_pad_blocks;
        Self {
            near: vec![0; n_blocks * LANES],
            peaks: vec![0; n_blocks],
            n_pad_blocks,
            truncation,
        }
    }

    /// Takes in the distances of a row along the columns, upward and downward.
    fn load(&mut self, above: &[u16], below: &[u16]) {
        let far = self.truncation * self.truncation;
        let near = &mut self.near[self.n_pad_blocks * LANES..];
        for ((near, &above), &below) in near.iter_mut().zip(above).zip(below) {
            let distance = above.min(below);
            *near = far - distance * distance;
        }
        for (peak, block) in self.peaks.iter_mut().zip(self.near.as_chunks::<LANES>().0) {
            *peak = block.iter().fold(0, |peak, &near| peak.max(near));
        }
    }

    /// Writes the squared distances of the row.
    fn store(&self, squared: &mut [u16]) {
        let far = self.truncation * self.truncation;
        for (block, squared) in squared.chunks_mut(LANES).enumerate() {
            let window = &self.peaks[block..][..=2 * self.n_pad_blocks];
            let peak = window.iter().fold(0, |peak, &near| peak.max(near));
            let near = self.block(block + self.n_pad_blocks, peak);
            for (squared, near) in squared.iter_mut().zip(near) {
                *squared = far - near;
            }
        }
    }

    /// The nearness of a block whose neighborhood reaches up to `peak` along the columns.
    fn block(&self, block: usize, peak: u16) -> [u16; LANES] {
        let start = block * LANES;
        let mut best = lanes(&self.near, start);
        let mut first = 1;
        while first < usize::from(self.truncation) {
            let worst = best.iter().fold(u16::MAX, |worst, &near| worst.min(near));
            if usize::from(worst) + first * first >= usize::from(peak) {
                break;
            }
            for offset in first..first + OFFSETS_PER_LOOK {
                // Offsets past the truncation change nothing, whatever their saturated square.
                let step = (offset * offset).min(usize::from(u16::MAX)) as u16;
                let left = lanes(&self.near, start - offset);
                let right = lanes(&self.near, start + offset);
                for ((best, left), right) in best.iter_mut().zip(left).zip(right) {
                    *best = (*best).max(left.max(right).saturating_sub(step));
                }
            }
            first += OFFSETS_PER_LOOK;
        }
        best
    }
}

fn lanes(values: &[u16], start: usize) -> [u16; LANES] {
    *values[start..]
        .first_chunk()
        .expect("rows are padded beyond the largest offset")
}

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
        assert!(field.rows().flatten().all(|&d| d == 255 * 255));
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
