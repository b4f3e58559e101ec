//! Between which limits pheromone is kept.

mod floor;
mod max_min;

pub use floor::Floor;
pub use max_min::MaxMin;

use super::cost::CellCost;
use super::generation::AntPath;
use super::node::Node;
use crate::parameters::rules;

rules! {
    /// Between which limits pheromone is kept after each iteration.
    #[derive(Default)]
    pub enum PheromoneLimits {
        /// No limits.
        #[default]
        None,
        /// No less than a share of what there was at first.
        Floor(Floor),
        /// Those of the MAX-MIN Ant System.
        MaxMin(MaxMin),
    }
}

/// The quantities that limits refer to.
pub(super) struct Bounds {
    /// The least initial pheromone.
    initial: f64,
    /// Mean number of steps that an ant can choose from in a cell.
    n_choices: f64,
}

impl Bounds {
    pub(super) fn new(least_initial: f64, nodes: &[Node]) -> Self {
        let n_steps: u32 = nodes.iter().map(|node| node.allowed.count_ones()).sum();
        Self {
            initial: least_initial,
            n_choices: f64::from(n_steps) / nodes.len().max(1) as f64,
        }
    }
}

impl PheromoneLimits {
    /// Least and most pheromone. `lasting` is Q / rho: what is left of the deposits Q / F of one
    /// ant in the long run, times F.
    pub(super) fn range(
        &self,
        bounds: &Bounds,
        lasting: f64,
        best: Option<&AntPath<CellCost>>,
    ) -> (f64, f64) {
        match (self, best) {
            (Self::Floor(rule), _) => (rule.share * bounds.initial, f64::INFINITY),
            (Self::MaxMin(rule), Some(best)) => rule.range(bounds.n_choices, lasting, best),
            _ => (0.0, f64::INFINITY),
        }
    }
}
