//! The ants of one generation, and what their ways come to.

use crate::colony::crew::Part;
use crate::objective::PolylineCost;

/// The ways of the ants of a generation, one behind the other.
#[derive(Clone, Debug, Default)]
pub(super) struct ChordGeneration {
    /// Steps as places on the ring, or [`TO_GOAL`](super::ant::TO_GOAL).
    pub(super) steps: Vec<u8>,
    pub(super) ends: Vec<usize>,
    pub(super) arrived: Vec<bool>,
    pub(super) costs: Vec<PolylineCost>,
}

impl ChordGeneration {
    /// Ends the way of an ant.
    pub(super) fn end_ant(&mut self, arrived: bool, cost: PolylineCost) {
        self.ends.push(self.steps.len());
        self.arrived.push(arrived);
        self.costs.push(cost);
    }

    /// Forgets all ants from the first on that does not end within so many steps.
    pub(super) fn keep_steps(&mut self, n_steps: u64) {
        let n_kept = self.ends.partition_point(|&end| end as u64 <= n_steps);
        self.ends.truncate(n_kept);
        self.arrived.truncate(n_kept);
        self.costs.truncate(n_kept);
        self.steps.truncate(self.ends.last().copied().unwrap_or(0));
    }

    pub(super) fn n_steps(&self) -> u64 {
        self.steps.len() as u64
    }

    /// The ants that arrived, in their order.
    pub(super) fn arrived(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.arrived.len()).filter(|&ant| self.arrived[ant])
    }

    /// The cheapest ant; of equals the first.
    pub(super) fn best(&self) -> Option<usize> {
        self.arrived()
            .min_by(|&a, &b| self.costs[a].cost.total_cmp(&self.costs[b].cost))
    }

    pub(super) fn steps_of(&self, ant: usize) -> &[u8] {
        let first = ant.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.steps[first..self.ends[ant]]
    }
}

impl Part for ChordGeneration {
    fn clear(&mut self) {
        self.steps.clear();
        self.ends.clear();
        self.arrived.clear();
        self.costs.clear();
    }

    fn append(&mut self, part: &Self) {
        let n_steps = self.steps.len();
        self.steps.extend_from_slice(&part.steps);
        self.ends.extend(part.ends.iter().map(|end| n_steps + end));
        self.arrived.extend_from_slice(&part.arrived);
        self.costs.extend_from_slice(&part.costs);
    }
}
