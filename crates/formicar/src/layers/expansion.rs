//! Obstacles grown by whole cells, 64 cells at a time.

use crate::map::BitGrid;

/// The free cells that become impassable when obstacles grow by `n_cells` on all sides, corners
/// included.
///
/// Lei 2020, sec. II.B: the free ones among the eight neighbors of an obstacle (the paper's 0.5),
/// `n_cells` times over. Cost: cells / 64 times the logarithm of `n_cells`.
pub fn obstacle_expansion(obstacles: &BitGrid, n_cells: u32) -> BitGrid {
    let n_cells = (n_cells as usize).min(obstacles.n_cols().max(obstacles.n_rows()));
    let mut grown = obstacles.clone();
    for shift in shifts(n_cells) {
        for row in 0..grown.n_rows() {
            spread_along_row(grown.row_mut(row), shift);
        }
    }
    for shift in shifts(n_cells) {
        spread_across_rows(&mut grown, shift);
    }
    for row in 0..grown.n_rows() {
        for (grown, obstacles) in grown.row_mut(row).iter_mut().zip(obstacles.row(row)) {
            *grown &= !obstacles;
        }
    }
    grown.clear_padding();
    grown
}

/// Shifts that add up to a reach: what was spread by r so far can be spread by up to r + 1 more
/// without leaving gaps (even at the border, where the cells beyond are lost), and less than a
/// word.
fn shifts(reach: usize) -> impl Iterator<Item = usize> {
    let mut reached = 0;
    std::iter::from_fn(move || {
        let shift = (reached + 1).min(63).min(reach - reached);
        reached += shift;
        (shift > 0).then_some(shift)
    })
}

/// Adds the cells `shift` columns to both sides, 1 to 63.
fn spread_along_row(words: &mut [u64], shift: usize) {
    let mut before = 0;
    for i in 0..words.len() {
        let (here, after) = (words[i], words.get(i + 1).copied().unwrap_or(0));
        let from_before = here << shift | before >> (64 - shift);
        let from_after = here >> shift | after << (64 - shift);
        words[i] = here | from_before | from_after;
        before = here;
    }
}

/// Adds the cells `shift` rows above and below.
fn spread_across_rows(grown: &mut BitGrid, shift: usize) {
    let source = grown.clone();
    let n_rows = grown.n_rows();
    for row in 0..n_rows {
        let words = grown.row_mut(row);
        let below = row.checked_sub(shift);
        let above = Some(row + shift).filter(|&above| above < n_rows);
        for other in [below, above].into_iter().flatten() {
            for (word, other) in words.iter_mut().zip(source.row(other)) {
                *word |= other;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{Cell, OccupancyGrid};
    use proptest::prelude::*;

    #[test]
    fn grows_like_lei_2020_figure_2() {
        let cells = |rows: [&str; 5]| OccupancyGrid::from_rows(&rows, 0.5).unwrap().lethal_cells();
        let obstacles = cells([".....", ".##..", ".#...", ".....", "....#"]);
        let expanded = cells(["####.", "#..#.", "#.##.", "#####", "...#."]);
        assert_eq!(obstacle_expansion(&obstacles, 1), expanded);
        assert_eq!(obstacle_expansion(&obstacles, 0).count(), 0);
        assert_eq!(
            obstacle_expansion(&obstacles, u32::MAX),
            obstacles.complement()
        );
    }

    proptest! {
        #[test]
        fn equals_brute_force(
            n_cols in 1_usize..300,
            n_rows in 1_usize..40,
            n_cells in 0_u32..140,
            cells in prop::collection::vec(any::<[prop::sample::Index; 2]>(), 0..8),
        ) {
            let mut obstacles = BitGrid::new(n_cols, n_rows);
            for [col, row] in &cells {
                obstacles.insert(Cell::new(col.index(n_cols) as u32, row.index(n_rows) as u32));
            }
            let mut expected = BitGrid::new(n_cols, n_rows);
            for cell in obstacles.complement().iter() {
                let near = |o: Cell| o.col.abs_diff(cell.col).max(o.row.abs_diff(cell.row)) <= n_cells;
                if obstacles.iter().any(near) {
                    expected.insert(cell);
                }
            }
            prop_assert_eq!(obstacle_expansion(&obstacles, n_cells), expected);
        }
    }
}
