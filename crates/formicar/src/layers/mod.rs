//! Layers: cells that are blocked in addition to the obstacles of a map before ants walk on it.
//!
//! Obstacle expansion keeps ants off obstacles by half the vehicle's width (Lei 2020, sec. II.B),
//! closing U-shapes keeps them out of dead ends (sec. II.C). Both limit where ants may walk; the
//! vehicle's body is checked against the true obstacles alone.

mod bit_mask;
mod closing;
mod config;
mod detour;
mod drive_masks;
mod expansion;
mod hull;
mod pocket_fate;
mod pockets;
mod soft_costs;
mod swept_masks;
mod u_shapes;

use crate::map::{BitGrid, Cell, DiagonalRule, ring};

pub use config::{Expansion, LayersConfig, MAX_EXPANSION_CELLS, UShapes};
pub use drive_masks::DriveMasks;
pub use expansion::obstacle_expansion;
pub use pocket_fate::PocketFate;
pub use soft_costs::{SoftCosts, SoftCostsError};
pub use swept_masks::SweptMasks;
pub use u_shapes::Pocket;

/// A map's obstacles, and the cells blocked in addition for a query.
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
    /// The pockets examined in closing U-shapes, the largest first.
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
        let ground = (obstacles, vehicle_width_cells);
        Self::new_while(ground, config, (ends, rule), &mut || true)
    }

    /// The same, where `goes_on` is asked on the way whether to go on; of no use where it said no.
    pub(crate) fn new_while(
        (obstacles, vehicle_width_cells): (&BitGrid, f64),
        config: &LayersConfig,
        (ends, rule): (&[Cell], DiagonalRule),
        goes_on: &mut dyn FnMut() -> bool,
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
        if config.u_shapes == UShapes::Close && goes_on() {
            layers.close_u_shapes(ends, rule, goes_on);
        }
        layers
    }

    /// The open cell whose center is nearest to that of a cell: the cell itself if it is open, the
    /// first in row-major order among equals; none if all within `max_radius_cells` are blocked or
    /// the cell is off the map.
    ///
    /// If expansion covers a start or a goal, ants begin or end there instead. Cost grows with the
    /// square of the distance.
    pub fn nearest_open(&self, cell: Cell, max_radius_cells: u32) -> Option<Cell> {
        nearest_open(&self.blocked, cell, max_radius_cells)
    }

    /// Number of pockets with a fate.
    pub fn n_pockets(&self, fate: PocketFate) -> usize {
        self.pockets
            .iter()
            .filter(|pocket| pocket.fate == fate)
            .count()
    }

    fn close_u_shapes(
        &mut self,
        ends: &[Cell],
        rule: DiagonalRule,
        goes_on: &mut dyn FnMut() -> bool,
    ) {
        let ends = ends.iter();
        let ends: Vec<Cell> = ends
            .filter_map(|&end| self.nearest_open(end, MAX_RADIUS))
            .collect();
        (self.closed, self.pockets) = u_shapes::close_u_shapes(&self.blocked, &ends, rule, goes_on);
        self.blocked.unite(&self.closed);
    }
}

/// The cell outside of a set whose center is nearest to that of a cell, as
/// [`Layers::nearest_open`] tells it of the blocked ones.
pub fn nearest_open(blocked: &BitGrid, cell: Cell, max_radius_cells: u32) -> Option<Cell> {
    let (n_cols, n_rows) = (blocked.n_cols(), blocked.n_rows());
    if cell.col as usize >= n_cols || cell.row as usize >= n_rows {
        return None;
    }
    let is_open = |cell: &Cell| !blocked.get(cell.col as usize, cell.row as usize);
    let by_distance = |open: Cell| (squared_distance(cell, open), open.row, open.col);
    let limit = u64::from(max_radius_cells).pow(2);
    let mut nearest = (limit + 1, 0, 0);
    for radius in 0..n_cols.max(n_rows) as u32 {
        if u64::from(radius).pow(2) > nearest.0.min(limit) {
            break;
        }
        let open = ring(cell, radius, n_cols, n_rows).filter(is_open);
        nearest = open.map(by_distance).fold(nearest, Ord::min);
    }
    (nearest.0 <= limit).then(|| Cell::new(nearest.2, nearest.1))
}

/// A radius that reaches all over every map.
const MAX_RADIUS: u32 = u32::MAX;

fn squared_distance(a: Cell, b: Cell) -> u64 {
    u64::from(a.col.abs_diff(b.col)).pow(2) + u64::from(a.row.abs_diff(b.row)).pow(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::OccupancyGrid;
    use proptest::prelude::*;

    const CLOSE: LayersConfig = LayersConfig {
        expansion: Expansion::HalfWidth,
        u_shapes: UShapes::Close,
    };

    fn lethal(rows: &[&str]) -> BitGrid {
        OccupancyGrid::from_rows(rows, 1.0).unwrap().lethal_cells()
    }

    /// A map with its layers: `#` obstacles, `+` expanded, `x` closed.
    fn drawn(layers: &Layers) -> Vec<String> {
        let map = &layers.obstacles;
        let letter = |col: usize, row: usize| {
            let marks = [(map, '#'), (&layers.expanded, '+'), (&layers.closed, 'x')];
            let mark = marks.into_iter().find(|(set, _)| set.get(col, row));
            assert_eq!(mark.is_some(), layers.blocked.get(col, row));
            mark.map_or('.', |(_, letter)| letter)
        };
        let rows = (0..map.n_rows()).rev();
        rows.map(|row| (0..map.n_cols()).map(|col| letter(col, row)).collect())
            .collect()
    }

    const U: [&str; 8] = [
        "...........",
        "...........",
        ".#.......#.",
        ".#.......#.",
        ".#.......#.",
        ".#.......#.",
        ".#########.",
        "...........",
    ];

    #[test]
    fn obstacles_grow_and_what_they_embrace_then_is_closed() {
        let ends = [Cell::new(5, 7), Cell::new(0, 7)];
        let layers = Layers::new(&lethal(&U), &CLOSE, &ends, DiagonalRule::NoObstacles, 2.0);
        let expected = [
            "...........",
            "+++xxxxx+++",
            "+#+xxxxx+#+",
            "+#+xxxxx+#+",
            "+#+xxxxx+#+",
            "+#+++++++#+",
            "+#########+",
            "+++++++++++",
        ];
        assert_eq!(drawn(&layers), expected);
        assert_eq!(layers.n_pockets(PocketFate::Closed), 1);
        assert_eq!(layers.pockets[0].first, Cell::new(3, 3));
        assert_eq!(
            (layers.pockets[0].n_cells, layers.pockets[0].n_closed),
            (20, 20)
        );
        let kept = LayersConfig::default();
        let layers = Layers::new(&lethal(&U), &kept, &ends, DiagonalRule::NoObstacles, 2.0);
        assert_eq!(drawn(&layers), U);
    }

    #[test]
    fn a_start_that_expansion_covers_keeps_its_pocket_open() {
        let start = Cell::new(2, 4);
        let ends = [start, Cell::new(0, 7)];
        let layers = Layers::new(&lethal(&U), &CLOSE, &ends, DiagonalRule::NoObstacles, 2.0);
        assert_eq!(layers.n_pockets(PocketFate::HoldsEnd), 1);
        assert_eq!(layers.closed.count(), 0);
        assert!(layers.expanded.get(2, 4), "nothing is carved out");
        assert_eq!(layers.nearest_open(start, 1), Some(Cell::new(3, 4)));
        assert_eq!(layers.nearest_open(start, 0), None);
        assert_eq!(
            layers.nearest_open(Cell::new(5, 5), 0),
            Some(Cell::new(5, 5))
        );
        assert_eq!(
            layers.nearest_open(Cell::new(11, 0), 9),
            None,
            "off the map"
        );
    }

    proptest! {
        #[test]
        fn the_nearest_open_cell_is_that_of_a_full_search(
            n_cols in 1_usize..16,
            bits in prop::collection::vec(prop::bool::weighted(0.93), 16..160),
            at in any::<prop::sample::Index>(),
            max_radius_cells in 0_u32..14,
        ) {
            let mut obstacles = BitGrid::new(n_cols, bits.len() / n_cols);
            let cells = (0..bits.len() / n_cols * n_cols).map(|i| Cell::new((i % n_cols) as u32, (i / n_cols) as u32));
            let cells: Vec<Cell> = cells.collect();
            obstacles.extend(cells.iter().zip(&bits).filter(|(_, is_set)| **is_set).map(|(cell, _)| *cell));
            let layers = Layers::new(&obstacles, &LayersConfig::default(), &[], DiagonalRule::Always, 0.0);
            let from = cells[at.index(cells.len())];
            let open = obstacles.complement();
            let within = |c: &Cell| squared_distance(from, *c) <= u64::from(max_radius_cells).pow(2);
            let expected = open.iter().filter(within).min_by_key(|&c| squared_distance(from, c));
            prop_assert_eq!(layers.nearest_open(from, max_radius_cells), expected);
        }
    }
}
