//! Soft costs: areas where a vehicle may drive but preferably does not.

use crate::geometry::Point2;
use crate::map::{Cell, FREE, GridFrame, OCCUPIED, OccupancyGrid};
use crate::parameters::{OutOfRange, Range};
use thiserror::Error;

/// The largest weight of soft costs.
const MAX_WEIGHT: f64 = 1000.0;
/// The largest graded value of a map: the next is occupied.
const MAX_GRADED: i8 = OCCUPIED - 1;

/// Values from 0 (indifferent) to 1 (unwanted) on a grid, and their weight: a meter driven on a
/// cell costs 1 + weight x value meters.
///
/// They are a preference only: they affect neither the validity of paths nor whether one is found.
#[derive(Clone, Debug, PartialEq)]
pub struct SoftCosts {
    frame: GridFrame,
    values: Vec<f32>,
    weight: f64,
}

/// Invalid soft costs.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SoftCostsError {
    /// As many values as cells are needed.
    #[error("{n_values} soft costs for {n_cells} cells")]
    WrongCellCount {
        /// Values given.
        n_values: usize,
        /// Cells of the frame.
        n_cells: usize,
    },
    /// A value outside 0 to 1.
    #[error("the soft cost of cell ({}, {}) is {value}; it must be 0 (indifferent) to 1 (unwanted)", cell.col, cell.row)]
    BadValue {
        /// The cell.
        cell: Cell,
        /// The value found.
        value: f32,
    },
    /// A weight outside its range.
    #[error(transparent)]
    BadWeight(#[from] OutOfRange),
}

impl SoftCosts {
    /// Soft costs from values, row-major, row 0 (bottom) first; the weight is 0 to 1000.
    ///
    /// # Errors
    /// As many values as cells, each in 0..=1, are needed, and a weight in its range.
    pub fn new(frame: GridFrame, values: Vec<f32>, weight: f64) -> Result<Self, SoftCostsError> {
        let weights = Range::of::<f64>(0.0..=MAX_WEIGHT);
        weights.check("the weight of soft costs", &weight)?;
        if values.len() != frame.n_cells() {
            return Err(SoftCostsError::WrongCellCount {
                n_values: values.len(),
                n_cells: frame.n_cells(),
            });
        }
        match values.iter().position(|v| !(0.0..=1.0).contains(v)) {
            Some(i) => Err(SoftCostsError::BadValue {
                cell: frame.cell(i),
                value: values[i],
            }),
            None => Ok(Self {
                frame,
                values,
                weight,
            }),
        }
    }

    /// The graded cells of a map, 1 to 99, as soft costs in proportion: those of a costmap (its
    /// costs 1 to 253), or of an image in the modes `scale` and `raw`. Occupied cells count 1,
    /// unknown ones 0.
    ///
    /// # Errors
    /// A weight outside 0 to 1000.
    pub fn from_graded(map: &OccupancyGrid, weight: f64) -> Result<Self, SoftCostsError> {
        let share = |&value: &i8| f32::from(value.clamp(FREE, MAX_GRADED)) / f32::from(MAX_GRADED);
        let values = map.values().iter().map(share).collect();
        Self::new(*map.frame(), values, weight)
    }

    /// The same costs on another frame: each of its cells takes the value under its center, 0
    /// where there is none.
    #[must_use]
    pub fn onto(&self, frame: &GridFrame) -> Self {
        if *frame == self.frame {
            return self.clone();
        }
        let value = |i: usize| {
            let under = self.frame.cell_at(frame.center(frame.cell(i)));
            under.map_or(0.0, |cell| self.values[self.frame.index(cell)])
        };
        Self {
            frame: *frame,
            values: (0..frame.n_cells()).map(value).collect(),
            weight: self.weight,
        }
    }

    /// The weight.
    pub fn weight(&self) -> f64 {
        self.weight
    }

    /// The value under a position in grid coordinates; 0 off the grid.
    pub fn value_at(&self, grid: Point2) -> f64 {
        let resolution_m = self.frame.resolution_m();
        let (col, row) = (grid.x / resolution_m, grid.y / resolution_m);
        let inside = (0.0..self.frame.n_cols() as f64).contains(&col)
            && (0.0..self.frame.n_rows() as f64).contains(&row);
        if !inside {
            return 0.0;
        }
        f64::from(self.values[row as usize * self.frame.n_cols() + col as usize])
    }

    /// Additional cost of a meter at a position in grid coordinates: weight x value.
    pub fn price_at(&self, grid: Point2) -> f64 {
        self.weight * self.value_at(grid)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose2;

    fn frame(n_cols: usize, resolution_m: f64) -> GridFrame {
        GridFrame::new(n_cols, 1, resolution_m, Pose2::default()).unwrap()
    }

    #[test]
    fn graded_cells_count_in_proportion() {
        let map = OccupancyGrid::new(frame(5, 1.0), vec![0, 33, 99, 100, -1]).unwrap();
        let costs = SoftCosts::from_graded(&map, 3.0).unwrap();
        let under = |x| costs.value_at(Point2::new(x, 0.5));
        for (x, value) in [
            (0.5, 0.0),
            (1.5, 1.0 / 3.0),
            (2.5, 1.0),
            (3.5, 1.0),
            (4.5, 0.0),
        ] {
            assert!((under(x) - value).abs() < 1e-6, "{x}");
        }
        assert_eq!((under(-0.1), under(5.0)), (0.0, 0.0));
        assert!((costs.price_at(Point2::new(1.5, 0.5)) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn costs_of_another_frame_are_read_at_the_centers() {
        let coarse = SoftCosts::new(frame(2, 1.0), vec![0.0, 1.0], 1.0).unwrap();
        let fine = coarse.onto(&frame(6, 0.5));
        assert_eq!(fine.values, [0.0, 0.0, 1.0, 1.0, 0.0, 0.0]);
        assert_eq!(coarse.onto(&frame(2, 1.0)), coarse);
    }

    #[test]
    fn bad_values_and_weights_are_named() {
        let error = |values, weight| {
            let costs = SoftCosts::new(frame(2, 1.0), values, weight);
            costs.unwrap_err().to_string()
        };
        assert!(error(vec![0.5, 1.5], 1.0).contains("cell (1, 0) is 1.5"));
        assert!(error(vec![0.5, f32::NAN], 1.0).contains("NaN"));
        assert!(error(vec![0.5], 1.0).contains("1 soft costs for 2 cells"));
        for weight in [-1.0, 1e4, f64::NAN] {
            assert!(
                error(vec![0.0; 2], weight).contains("0 to 1000"),
                "{weight}"
            );
        }
    }
}
