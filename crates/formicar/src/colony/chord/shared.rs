//! The state that all ants of a generation read.

/// Read by all ants of a generation.
#[derive(Clone, Debug)]
pub(super) struct ChordShared {
    /// Pheromone by number.
    pub(super) tau: Vec<f32>,
    /// Longest and shortest known distance to the goal by number, cells; 0 and infinite if none is
    /// known.
    pub(super) known: Vec<[f32; 2]>,
    /// (N - k) / k of generation k of N.
    pub(super) factor: f64,
}

impl ChordShared {
    /// Longest and shortest known distance from a cell to the goal.
    pub(super) fn ways(&self, number: usize) -> Option<[f64; 2]> {
        let ways = self.known[number].map(f64::from);
        (ways[1] <= ways[0]).then_some(ways)
    }
}
