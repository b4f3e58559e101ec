//! The position of a grid in the world: cells to meters and back.

use super::cell::Cell;
use super::error::{MAX_CELLS, MAX_ORIGIN_M, MAX_RESOLUTION_M, MIN_RESOLUTION_M, MapError};
use crate::geometry::{Point2, Pose2};

/// Size, resolution and origin of a grid.
///
/// *Grid coordinates* are meters from the lower left corner along the grid's own axes; the origin
/// (with its yaw) carries them to the world.
///
/// ```
/// use formicar::map::{Cell, GridFrame};
/// use formicar::{Point2, Pose2};
///
/// let frame = GridFrame::new(100, 80, 0.05, Pose2::new(-2.5, -2.0, 0.0))?;
/// assert_eq!(frame.cell_at(Point2::new(0.01, 0.01)), Some(Cell::new(50, 40)));
/// assert_eq!(frame.cell_at(Point2::new(3.0, 0.0)), None);
/// # Ok::<(), formicar::MapError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridFrame {
    n_cols: usize,
    n_rows: usize,
    resolution_m: f64,
    origin: Pose2,
}

impl GridFrame {
    /// A frame of `n_cols` x `n_rows` cells of `resolution_m` meters.
    ///
    /// # Errors
    /// An empty grid, more than [`MAX_CELLS`] cells, a resolution outside
    /// [`MIN_RESOLUTION_M`]..=[`MAX_RESOLUTION_M`], or an origin that is not finite or beyond
    /// [`MAX_ORIGIN_M`].
    pub fn new(
        n_cols: usize,
        n_rows: usize,
        resolution_m: f64,
        origin: Pose2,
    ) -> Result<Self, MapError> {
        let n_cells = n_cols.checked_mul(n_rows).filter(|&n| n <= MAX_CELLS);
        match n_cells {
            None => return Err(MapError::TooLarge { n_cols, n_rows }),
            Some(0) => return Err(MapError::Empty { n_cols, n_rows }),
            Some(_) => {}
        }
        if !(MIN_RESOLUTION_M..=MAX_RESOLUTION_M).contains(&resolution_m) {
            return Err(MapError::BadResolution { resolution_m });
        }
        if !(origin.is_finite() && origin.x.abs().max(origin.y.abs()) <= MAX_ORIGIN_M) {
            return Err(MapError::BadOrigin {
                x: origin.x,
                y: origin.y,
                yaw: origin.heading,
            });
        }
        Ok(Self {
            n_cols,
            n_rows,
            resolution_m,
            origin,
        })
    }

    /// Number of columns.
    pub fn n_cols(&self) -> usize {
        self.n_cols
    }

    /// Number of rows.
    pub fn n_rows(&self) -> usize {
        self.n_rows
    }

    /// Number of cells.
    pub fn n_cells(&self) -> usize {
        self.n_cols * self.n_rows
    }

    /// Side of a cell in meters.
    pub fn resolution_m(&self) -> f64 {
        self.resolution_m
    }

    /// The world pose of the lower left corner of cell (0, 0).
    pub fn origin(&self) -> Pose2 {
        self.origin
    }

    /// Width and height in meters.
    pub fn extent_m(&self) -> Point2 {
        Point2::new(self.n_cols as f64, self.n_rows as f64) * self.resolution_m
    }

    /// A world pose in grid coordinates.
    pub fn to_grid(&self, world: Pose2) -> Pose2 {
        self.origin.relative(world)
    }

    /// A pose in grid coordinates, in the world.
    pub fn to_world(&self, grid: Pose2) -> Pose2 {
        self.origin.compose(grid)
    }

    /// The cell under a world point, if it lies on the map.
    pub fn cell_at(&self, world: Point2) -> Option<Cell> {
        let local = self.to_grid(Pose2::at(world, 0.0)).position();
        let (col, row) = (
            (local.x / self.resolution_m).floor(),
            (local.y / self.resolution_m).floor(),
        );
        let inside =
            col >= 0.0 && row >= 0.0 && col < self.n_cols as f64 && row < self.n_rows as f64;
        inside.then(|| Cell::new(col as u32, row as u32))
    }

    /// The world point at the center of a cell.
    pub fn center(&self, cell: Cell) -> Point2 {
        let half = |i: u32| (f64::from(i) + 0.5) * self.resolution_m;
        self.origin
            .transform(Point2::new(half(cell.col), half(cell.row)))
    }

    /// The place of a cell in row-major order, row 0 first.
    pub fn index(&self, cell: Cell) -> usize {
        cell.row as usize * self.n_cols + cell.col as usize
    }

    /// The cell at a place in row-major order.
    pub fn cell(&self, index: usize) -> Cell {
        Cell::new((index % self.n_cols) as u32, (index / self.n_cols) as u32)
    }
}
