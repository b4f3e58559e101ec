//! Maps for benchmarks.

use formicar::map::{BitGrid, Cell};
use formicar::numeric::Seed;

/// A town of rectangular blocks of 20 to 60 cells between alleys of 10 to 20, most of them
/// courtyards: walls around open ground.
pub(crate) fn town(n_cols: usize, n_rows: usize) -> BitGrid {
    let mut lethal = BitGrid::new(n_cols, n_rows);
    let mut stream = Seed(1).stream([n_cols as u64, n_rows as u64]);
    let mut top = 8;
    while top + 60 < n_rows {
        let height = 20 + stream.below(40);
        let mut left = 8;
        while left + 60 < n_cols {
            let width = 20 + stream.below(40);
            let solid = stream.below(3) == 0;
            for row in top..top + height {
                let wall = solid || row == top;
                (left..left + width)
                    .filter(|&col| wall || col == left)
                    .for_each(|col| lethal.insert(Cell::new(col as u32, row as u32)));
            }
            left += width + 10 + stream.below(10);
        }
        top += height + 10 + stream.below(10);
    }
    lethal
}

/// Grid sizes of the benchmarks.
pub(crate) const SIZES: [(usize, usize); 3] = [(800, 500), (2000, 2000), (5000, 5000)];
