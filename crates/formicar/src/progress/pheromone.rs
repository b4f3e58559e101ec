//! Pheromone by cell.

use crate::map::STEPS;

/// Pheromone by cell from that by cell and step, eight to a cell: that of a cell is the most on a
/// step to it.
pub fn pheromone_by_cell(by_step: &[f32], n_cols: usize) -> Vec<f32> {
    let mut cells = vec![f32::NAN; by_step.len() / 8];
    let offset = |(dx, dy): (i32, i32)| dx as isize + dy as isize * n_cols as isize;
    for (cell, steps) in by_step.chunks_exact(8).enumerate() {
        for (&step, &tau) in STEPS.iter().zip(steps) {
            // Steps off the map have none.
            match cells.get_mut(cell.wrapping_add_signed(offset(step))) {
                Some(to) if !tau.is_nan() => *to = to.max(tau),
                _ => {}
            }
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_has_the_most_pheromone_of_the_steps_to_it() {
        let mut by_step = [f32::NAN; 4 * 8];
        // On a grid of 2 x 2: east and north-east from the first cell, south from the last.
        (by_step[0], by_step[1], by_step[3 * 8 + 6]) = (1.0, 2.0, 3.0);
        let by_cell = pheromone_by_cell(&by_step, 2);
        assert!(by_cell[0].is_nan() && by_cell[2].is_nan());
        assert_eq!((by_cell[1], by_cell[3]), (3.0, 2.0));
    }
}
