//! Iterations of a colony kept for pictures: some of each run, however long it is.

use super::{AntWays, ColonyView, Event, IterationRecord, Observer};
use crate::map::Cell;
use crate::path::GridPath;

/// The number of passages of ants between two cells in one iteration, in either direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Traffic {
    /// The two cells, the one that comes first row by row before the other.
    pub cells: [Cell; 2],
    /// Passages.
    pub n_passed: u32,
}

/// The kept part of an iteration.
#[derive(Clone, Debug, PartialEq)]
pub struct AntFrame {
    /// Its numbers.
    pub record: IterationRecord,
    /// The passages of the ants that reached the goal.
    pub arrived: Vec<Traffic>,
    /// The passages of the others.
    pub lost: Vec<Traffic>,
    /// The way of least cost; none if no ant arrived.
    pub best: Option<GridPath>,
    /// Pheromone after the update by cell, row by row; not a number where no ant can go.
    pub pheromone: Vec<f32>,
}

/// Keeps iterations as they go by: the 1st, 2nd, 5th, 10th, 20th and so on, every k-th, and the
/// last.
///
/// k doubles whenever there are more than [`AntFrames::MAX_FRAMES`], or fewer where they would
/// hold more than [`AntFrames::MAX_CELLS`] together.
#[derive(Clone, Debug)]
pub struct AntFrames {
    grid: Grid,
    stride: u32,
    frames: Vec<AntFrame>,
}

impl AntFrames {
    /// Most iterations kept, but for the first few.
    pub const MAX_FRAMES: usize = 60;
    /// Most cells of all that is kept.
    pub const MAX_CELLS: usize = 1 << 24;

    /// For runs on a grid of so many columns and rows.
    pub fn new(n_cols: usize, n_rows: usize) -> Self {
        Self {
            grid: Grid(n_cols, n_rows),
            stride: 1,
            frames: Vec::new(),
        }
    }

    /// The kept iterations, in order.
    pub fn frames(&self) -> &[AntFrame] {
        &self.frames
    }

    /// Adds an iteration; the first of a run discards those of the run before.
    pub fn keep(&mut self, view: &ColonyView) {
        if view.record.iteration == 0 {
            self.frames.clear();
            self.stride = 1;
        }
        let last = self.frames.last();
        if last.is_some_and(|last| !self.is_kept(last)) {
            self.frames.pop();
        }
        self.frames
            .push(AntFrame::of(view, (self.grid.0, self.grid.1)));
        let n_most = Self::MAX_CELLS / self.grid.n_cells().max(1);
        if self.frames.len() > n_most.clamp(4, Self::MAX_FRAMES) {
            self.stride = self.stride.saturating_mul(2);
            let mut frames = std::mem::take(&mut self.frames);
            let last = frames.pop();
            frames.retain(|frame| self.is_kept(frame));
            frames.extend(last);
            self.frames = frames;
        }
    }

    /// True if a frame stays when others follow.
    fn is_kept(&self, frame: &AntFrame) -> bool {
        let number = frame.record.iteration.saturating_add(1);
        let power = 10_u32.pow(number.ilog10());
        let is_round = [1, 2, 5].iter().any(|first| number == first * power);
        is_round || number.is_multiple_of(self.stride)
    }
}

impl Observer for AntFrames {
    fn on_event(&mut self, event: &Event) {
        if let Event::Iteration(view) = event {
            self.keep(view);
        }
    }
}

impl AntFrame {
    /// The frame of an iteration on a grid of `n_cols` columns and `n_rows` rows.
    pub fn of(view: &ColonyView, (n_cols, n_rows): (usize, usize)) -> Self {
        let ants = |arrived: bool| {
            let ants = 0..view.ways.n_ants();
            let ants = ants.filter(|&ant| view.ways.arrived[ant] == arrived);
            traffic(&view.ways, ants)
        };
        Self {
            record: *view.record,
            arrived: ants(true),
            lost: ants(false),
            best: view.ways.best.map(|ant| view.ways.way(ant)),
            pheromone: view.pheromone.by_cell(n_cols, n_rows),
        }
    }
}

/// The passages of some ants, ordered by cells.
fn traffic(ways: &AntWays, ants: impl Iterator<Item = usize>) -> Vec<Traffic> {
    let row_by_row = |cell: &Cell| (cell.row, cell.col);
    let mut passages = Vec::new();
    for ant in ants {
        let path = ways.way(ant);
        passages.extend(path.cells.windows(2).map(|pair| {
            let mut cells = [pair[0], pair[1]];
            cells.sort_by_key(row_by_row);
            cells
        }));
    }
    passages.sort_unstable_by_key(|cells| cells.each_ref().map(row_by_row));
    let same = passages.chunk_by(|a, b| a == b);
    let traffic = same.map(|passages| Traffic {
        cells: passages[0],
        n_passed: passages.len() as u32,
    });
    traffic.collect()
}

/// Columns and rows.
#[derive(Clone, Copy, Debug)]
struct Grid(usize, usize);

impl Grid {
    fn n_cells(self) -> usize {
        self.0 * self.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::STEPS;
    use crate::progress::Pheromone;

    const WAYS: AntWays = AntWays {
        start: Cell::new(0, 0),
        goal: Cell::new(2, 0),
        moves: &STEPS,
        steps: &[0, 0, 4, 0, 1],
        ends: &[4, 5],
        arrived: &[true, false],
        best: Some(0),
    };

    fn kept(n_iterations: u32, n_cells: usize) -> Vec<u32> {
        let mut frames = AntFrames::new(n_cells / 2, 2);
        for iteration in 0..n_iterations {
            let record = IterationRecord {
                iteration,
                ..IterationRecord::default()
            };
            frames.keep(&ColonyView {
                record: &record,
                ways: WAYS,
                pheromone: Pheromone::Cells(&[]),
            });
        }
        let numbers = frames.frames().iter().map(|f| f.record.iteration + 1);
        numbers.collect()
    }

    #[test]
    fn passages_count_in_both_directions() {
        let record = IterationRecord::default();
        let view = ColonyView {
            record: &record,
            ways: WAYS,
            pheromone: Pheromone::Cells(&[0.5; 6]),
        };
        let frame = AntFrame::of(&view, (3, 2));
        let [a, b, c] = [0, 1, 2].map(|col| Cell::new(col, 0));
        let passed = |cells, n_passed| Traffic { cells, n_passed };
        assert_eq!(frame.arrived, [passed([a, b], 1), passed([b, c], 3)]);
        assert_eq!(frame.lost, [passed([a, Cell::new(1, 1)], 1)]);
        assert_eq!(frame.best.unwrap().cells, [a, b, c, b, c]);
        assert_eq!(frame.pheromone, [0.5; 6]);
    }

    #[test]
    fn first_round_regular_and_last_iterations_are_kept() {
        assert_eq!(kept(7, 4), [1, 2, 3, 4, 5, 6, 7]);
        let many = kept(151, 4);
        assert!(many.len() <= AntFrames::MAX_FRAMES, "{many:?}");
        assert_eq!(many[..7], [1, 2, 4, 5, 8, 10, 12]);
        assert_eq!(many[many.len() - 2..], [148, 151]);
    }

    #[test]
    fn memory_is_bounded_by_frames_and_cells() {
        assert!(kept(20_000, 4).len() <= AntFrames::MAX_FRAMES + 1);
        assert!(kept(5_000, AntFrames::MAX_CELLS / 20).len() <= 21);
    }
}
