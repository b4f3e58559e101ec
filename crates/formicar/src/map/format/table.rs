//! Rows of cells that a text gives from the top.

use super::{FormatError, FormatProblem, Place};
use crate::geometry::Pose2;
use crate::map::{FREE, GridFrame, OCCUPIED, OccupancyGrid};

/// Collects rows of free and occupied cells from the top.
#[derive(Default)]
pub(super) struct RowsFromTop {
    n_cols: usize,
    values: Vec<i8>,
}

impl RowsFromTop {
    /// Adds the next lower row.
    pub(super) fn push(
        &mut self,
        row: impl Iterator<Item = Result<bool, FormatError>>,
    ) -> Result<(), FormatError> {
        let n_before = self.values.len();
        for occupied in row {
            self.values.push(if occupied? { OCCUPIED } else { FREE });
        }
        let found = self.values.len() - n_before;
        if n_before == 0 {
            self.n_cols = found;
        }
        if found != self.n_cols {
            let expected = self.n_cols;
            return Err(FormatProblem::UnequalRows { found, expected }.into());
        }
        Ok(())
    }

    pub(super) fn n_rows(&self) -> usize {
        self.values.len().checked_div(self.n_cols).unwrap_or(0)
    }

    /// The grid with origin (0, 0, 0).
    pub(super) fn into_grid(self, resolution_m: f64) -> Result<OccupancyGrid, FormatError> {
        let frame = GridFrame::new(self.n_cols, self.n_rows(), resolution_m, Pose2::default())?;
        let rows = self.values.chunks_exact(self.n_cols).rev();
        Ok(OccupancyGrid::new(
            frame,
            rows.flatten().copied().collect(),
        )?)
    }
}

/// The lines of a text with their places; line ends may be LF or CRLF.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (Place, &str)> {
    text.lines()
        .enumerate()
        .map(|(i, line)| (Place::Line(i + 1), line))
}

/// One flag per cell, true where it is occupied, rows from the top, for a format without unknown or
/// graded cells.
pub(super) fn occupied_from_top<'a>(
    grid: &'a OccupancyGrid,
    format: &'static str,
) -> Result<impl Iterator<Item = &'a [i8]>, FormatError> {
    let plain = |v: &i8| *v == FREE || *v == OCCUPIED;
    if let Some(&value) = grid.values().iter().find(|v| !plain(v)) {
        let n_cells = grid.values().iter().filter(|&&v| v == value).count();
        let hint = if value < 0 {
            "decide first whether unknown cells are free or occupied, or write a ROS map"
        } else {
            "write a ROS map (.yaml) instead"
        };
        return Err(FormatProblem::Unrepresentable {
            n_cells,
            value,
            format,
            hint,
        }
        .into());
    }
    Ok(grid.values().chunks_exact(grid.frame().n_cols()).rev())
}
