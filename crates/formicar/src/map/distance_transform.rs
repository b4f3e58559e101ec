//! The exact Euclidean distance transform, truncated, of a rectangle of cells.
//!
//! The transform is separable: a pass along the columns counts cells to the nearest obstacle above
//! and below, a pass along the rows takes the lower envelope of parabolas (Felzenszwalb &
//! Huttenlocher 2012), here as a plain minimum over the offsets that the truncation allows, many
//! cells at once, ended as soon as no farther offset can matter.

use super::{BitGrid, CellRegion, set_bits};

/// Cells handled together: a few vector registers of 16-bit lanes.
pub(super) const LANES: usize = 32;

/// Column offsets tried between two looks at the bound that ends the row pass.
const OFFSETS_PER_LOOK: usize = 4;

/// The squared distances of the cells of a rectangle, row by row, at most the squared truncation.
/// The first column must be a multiple of [`LANES`].
pub(super) fn squared_distances(
    obstacles: &BitGrid,
    truncation: u16,
    cells: &CellRegion,
) -> Vec<u16> {
    // Whatever decides these distances lies in here.
    let outer = cells.grown(
        usize::from(truncation),
        obstacles.n_cols(),
        obstacles.n_rows(),
    );
    let words = outer.cols().start / 64..outer.cols().end.div_ceil(64);
    let (first_col, n_cols) = (64 * words.start, 64 * words.len());
    let (cols, rows) = (cells.cols(), cells.rows());
    let words = |row| &obstacles.row(row)[words.clone()];

    let mut below = Vec::with_capacity(n_cols * rows.len());
    let limit = truncation as i16;
    let mut runs = vec![limit; n_cols];
    for row in outer.rows().start..rows.end {
        extend_runs(&mut runs, words(row), limit);
        if row >= rows.start {
            below.extend_from_slice(&runs);
        }
    }

    let mut squared = vec![0; cols.len() * rows.len()];
    let mut sweep = RowSweep::new(n_cols, truncation);
    runs.fill(limit);
    for row in (rows.start..outer.rows().end).rev() {
        extend_runs(&mut runs, words(row), limit);
        if row < rows.end {
            let row = row - rows.start;
            sweep.load(&runs, &below[row * n_cols..][..n_cols]);
            sweep.store(
                cols.start - first_col,
                &mut squared[row * cols.len()..][..cols.len()],
            );
        }
    }
    squared
}

/// Steps to the next row: runs of free cells grow by one, up to the limit, or end at an obstacle.
fn extend_runs(runs: &mut [i16], obstacles: &[u64], limit: i16) {
    for (runs, &word) in runs.as_chunks_mut::<64>().0.iter_mut().zip(obstacles) {
        for run in runs.iter_mut() {
            *run = (*run + 1).min(limit);
        }
        for bit in set_bits(word) {
            runs[bit as usize] = 0;
        }
    }
}

/// The pass along one row.
///
/// It works on nearness, truncation squared minus distance squared: the least is far away or off
/// the map, and saturating subtraction does the truncation. Nearness is shifted to signed numbers:
/// SSE2, which every x86-64 has, knows their maximum, and not that of unsigned ones.
struct RowSweep {
    /// Nearness along the columns alone, far away beyond both ends of the row.
    near: Vec<i16>,
    /// The largest nearness of each block of `near`.
    peaks: Vec<i16>,
    n_pad_blocks: usize,
    truncation: u16,
}

/// The least nearness.
const FAR: i16 = i16::MIN;

impl RowSweep {
    fn new(n_cols: usize, truncation: u16) -> Self {
        let n_pad_blocks = (usize::from(truncation) + OFFSETS_PER_LOOK).div_ceil(LANES);
        let n_blocks = n_cols.div_ceil(LANES) + 2 * n_pad_blocks;
        Self {
            near: vec![FAR; n_blocks * LANES],
            peaks: vec![FAR; n_blocks],
            n_pad_blocks,
            truncation,
        }
    }

    /// Takes in the distances of a row along the columns, upward and downward.
    fn load(&mut self, above: &[i16], below: &[i16]) {
        let far = self.truncation * self.truncation;
        let near = &mut self.near[self.n_pad_blocks * LANES..];
        for ((near, &above), &below) in near.iter_mut().zip(above).zip(below) {
            let distance = above.min(below) as u16;
            *near = (far - distance * distance).wrapping_sub(1 << 15) as i16;
        }
        for (peak, block) in self.peaks.iter_mut().zip(self.near.as_chunks::<LANES>().0) {
            *peak = block.iter().fold(FAR, |peak, &near| peak.max(near));
        }
    }

    /// Writes the squared distances of the cells from a column on, a multiple of [`LANES`].
    fn store(&self, first_col: usize, squared: &mut [u16]) {
        let far = self.truncation * self.truncation;
        for (i, squared) in squared.chunks_mut(LANES).enumerate() {
            let block = first_col / LANES + i;
            let window = &self.peaks[block..][..=2 * self.n_pad_blocks];
            let peak = window.iter().fold(FAR, |peak, &near| peak.max(near));
            let near = self.block(block + self.n_pad_blocks, peak);
            for (squared, near) in squared.iter_mut().zip(near) {
                *squared = far - (near as u16).wrapping_add(1 << 15);
            }
        }
    }

    /// The nearness of a block whose neighborhood reaches up to `peak` along the columns.
    fn block(&self, block: usize, peak: i16) -> [i16; LANES] {
        let start = block * LANES;
        let mut best = lanes(&self.near, start);
        let mut first = 1;
        while first < usize::from(self.truncation) {
            let worst = best.iter().fold(i16::MAX, |worst, &near| worst.min(near));
            if usize::from(worst.abs_diff(FAR)) + first * first >= usize::from(peak.abs_diff(FAR)) {
                break;
            }
            for offset in first..first + OFFSETS_PER_LOOK {
                let left = lanes(&self.near, start - offset);
                let right = lanes(&self.near, start + offset);
                approach(&mut best, left, right, offset * offset);
            }
            first += OFFSETS_PER_LOOK;
        }
        best
    }
}

/// Raises nearness to that of cells to the left and to the right less a step.
fn approach(best: &mut [i16; LANES], left: [i16; LANES], right: [i16; LANES], step: usize) {
    let near: [i16; LANES] = std::array::from_fn(|i| left[i].max(right[i]));
    // A step beyond the range of a lane is two; what is left over then changes nothing.
    let (near, step) = match step.checked_sub(MAX_STEP) {
        None => (near, step),
        Some(rest) => (
            near.map(|near| near.saturating_sub(i16::MAX)),
            rest.min(MAX_STEP),
        ),
    };
    for (best, near) in best.iter_mut().zip(near) {
        *best = (*best).max(near.saturating_sub(step as i16));
    }
}

const MAX_STEP: usize = i16::MAX as usize;

fn lanes(values: &[i16], start: usize) -> [i16; LANES] {
    *values[start..]
        .first_chunk()
        .expect("rows are padded beyond the largest offset")
}
