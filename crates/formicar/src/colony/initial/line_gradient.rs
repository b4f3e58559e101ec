//! Pheromone that falls with the distance from the line between start and goal.

use super::unit::PheromoneUnit;
use crate::map::Cell;
use crate::parameters::parameters;

parameters! {
    /// tau0 = `tau_min` + (`tau_max` - `tau_min`) (1 - d / `d_max`) with the distance d of a cell
    /// from the line through start and goal, `d_max` the largest on the map: Lei & Zheng 2020, sec.
    /// II.D.
    pub struct LineGradient {
        /// Pheromone farthest from the line.
        #[range(1e-6..=1e6)]
        pub tau_min: f64 = 1.0,
        /// Pheromone on the line.
        #[range(1e-6..=1e6)]
        pub tau_max: f64 = 2.0,
        /// The unit of both.
        pub unit: PheromoneUnit = PheromoneUnit::Deposit,
    }
}

impl LineGradient {
    /// Pheromone on some cells, row by row, and the least on the map.
    pub(super) fn values(
        &self,
        n_cols: usize,
        n_rows: usize,
        ends: [Cell; 2],
        cells: &[u32],
    ) -> (Vec<f64>, f64) {
        let [(x0, y0), (x1, y1)] = ends.map(|cell| (f64::from(cell.col), f64::from(cell.row)));
        let (dx, dy) = (x1 - x0, y1 - y0);
        let length = dx.hypot(dy).max(1.0);
        let distance = |col: usize, row: usize| {
            ((row as f64 - y0) * dx - (col as f64 - x0) * dy).abs() / length
        };
        // No cell is farther from a line than the farthest corner.
        let (east, north) = (n_cols - 1, n_rows - 1);
        let corners = [(0, 0), (east, 0), (0, north), (east, north)];
        let farthest = corners.map(|(col, row)| distance(col, row));
        let farthest = farthest.into_iter().fold(0.0, f64::max);
        let range = self.tau_max - self.tau_min;
        let tau = |d: f64| self.tau_min + range * (1.0 - d / farthest.max(1.0));
        let cell = |&cell: &u32| (cell as usize % n_cols, cell as usize / n_cols);
        let values = cells
            .iter()
            .map(cell)
            .map(|(col, row)| tau(distance(col, row)));
        (values.collect(), tau(farthest).min(tau(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn falls_from_the_line_to_the_farthest_corner() {
        let ends = [Cell::new(0, 0), Cell::new(4, 4)];
        let cells: Vec<u32> = (0..25).collect();
        let (values, least) = LineGradient::default().values(5, 5, ends, &cells);
        assert_eq!(least, values.iter().copied().fold(f64::INFINITY, f64::min));
        assert!((values[0] - 2.0).abs() < 1e-12 && (values[12] - 2.0).abs() < 1e-12);
        assert!((values[4] - 1.0).abs() < 1e-12 && (values[20] - 1.0).abs() < 1e-12);
        assert!((values[2] - 1.5).abs() < 1e-12, "{}", values[2]);
    }
}
