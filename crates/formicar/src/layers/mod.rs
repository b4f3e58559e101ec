//! Layers: what is laid over a map before ants walk on it.
//!
//! Obstacle expansion keeps them off obstacles by half the vehicle's width (Lei 2020, sec. II.B),
//! closing U-shapes keeps them out of dead ends (sec. II.C). Both tell where ants may walk; what
//! the vehicle's body may touch is decided by the true obstacles alone.

mod closing;
mod config;
mod detour;
mod expansion;
mod hull;
mod pockets;
mod u_shapes;

use crate::map::{BitGrid, Cell, DiagonalRule, ring};

pub use config::{Expansion, LayersConfig, MAX_EXPANSION_CELLS, UShapes};
pub use expansion::obstacle_expansion;
pub use u_shapes::{Pocket, PocketFate};

/// A map's obstacles, and what was laid over them for a query.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layers {
    /// The obstacles of the map.
    pub obstacles: BitGrid,
    /// Free cells too near to obstacles.
    pub expanded: BitGrid,
    /// Free cells of closed U-shapes.
    pub closed: BitGrid,
    /// All three: where ants may not walk.
    pub blocked: BitGrid,
    /// What was looked at in closing U-shapes, the largest first.
    pub pockets: Vec<Pocket>,
}

impl Layers {
    /// The layers for a query from and to `ends`, the cells of its start and goals.
    ///
    /// Closing U-shapes changes no distance between ends under the diagonal rule; an end that
    /// expansion covers stands for the [nearest open cell](Self::nearest_open), so that its
    /// pocket stays open too. Nothing is carved out around it.
    pub fn new(
        obstacles: &BitGrid,
        config: &LayersConfig,
        ends: &[Cell],
        rule: DiagonalRule,
        vehicle_width_cells: f64,
    ) -> Self {
        let n_cells = config.expansion.n_cells(vehicle_width_cells);
        let expanded = obstacle_expansion(obstacles, n_cells);
        let mut blocked = obstacles.clone();
        blocked.unite(&expanded);
        let mut layers = Self {
            obstacles: obstacles.clone(),
            expanded,
            closed: BitGrid::new(blocked.n_cols(), blocked.n_rows()),
            blocked,
            pockets: Vec::new(),
        };
        if config.u_shapes == UShapes::Close {
            layers.close_u_shapes(ends, rule);
        }
        layers
    }

    /// The open cell whose center is nearest to that of a cell, the cell itself if it is open, the
    /// first in row-major order among equals; none within `max_radius_cells`.
    ///
    /// Cost grows with the square of the distance.
    pub fn nearest_open(&self, cell: Cell, max_radius_cells: u32) -> Option<Cell> {
        let (n_cols, n_rows) = (self.blocked.n_cols(), self.blocked.n_rows());
        let mut nearest: Option<(u64, Cell)> = None;
        let mut limit = u64::from(max_radius_cells).pow(2);
        for radius in 0..=max_radius_cells {
            if u64::from(radius).pow(2) > limit {
                break;
            }
            for open in ring(cell, radius, n_cols, n_rows) {
                let candidate = (squared_distance(cell, open), open);
                let is_open = !self.blocked.get(open.col as usize, open.row as usize);
                if is_open
                    && candidate.0 <= limit
                    && nearest.is_none_or(|n| is_before(candidate, n))
                {
                    nearest = Some(candidate);
                    limit = candidate.0;
                }
            }
        }
        nearest.map(|(_, open)| open)
    }

    /// Number of pockets with a fate.
    pub fn n_pockets(&self, fate: PocketFate) -> usize {
        self.pockets
            .iter()
            .filter(|pocket| pocket.fate == fate)
            .count()
    }

    fn close_u_shapes(&mut self, ends: &[Cell], rule: DiagonalRule) {
        let anywhere = self.blocked.n_cols().max(self.blocked.n_rows()) as u32;
        let open_ends = ends
            .iter()
            .filter_map(|&end| self.nearest_open(end, 2 * anywhere));
        let open_ends: Vec<Cell> = open_ends.collect();
        (self.closed, self.pockets) = u_shapes::close_u_shapes(&self.blocked, &open_ends, rule);
        self.blocked.unite(&self.closed);
    }
}

fn squared_distance(a: Cell, b: Cell) -> u64 {
    u64::from(a.col.abs_diff(b.col)).pow(2) + u64::from(a.row.abs_diff(b.row)).pow(2)
}

/// Whether a cell is nearer than another or, equally near, before it in row-major order.
fn is_before(a: (u64, Cell), b: (u64, Cell)) -> bool {
    (a.0, a.1.row, a.1.col) < (b.0, b.1.row, b.1.col)
}
