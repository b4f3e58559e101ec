//! The distance term of a step's weight.

use crate::parameters::{parameters, rules};

rules! {
    /// Q = D + 1 / d of Li 2024 (27), with the straight distance d from a step's end to the goal in
    /// cells.
    pub enum DistanceTerm {
        /// D by what is known of ways from here.
        KnownLengths(KnownLengths),
        /// D = 0.
        None,
    }
}

parameters! {
    /// D of Li 2024 (20): eta (`L_max` - d) / (1 + `L_max` - `L_min`) (N - k) / k, where `L_max`
    /// and `L_min` are the longest and the shortest way to the goal found so far from the ant's
    /// cell, in cells. Before there is any they are read as the goal field's value and the largest
    /// one among cell and candidates.
    pub struct KnownLengths {
        /// η: weight of the known lengths.
        #[range(0.0..=1e6)]
        pub eta: f64 = 1.1,
    }
}

impl DistanceTerm {
    /// Q of a step that ends `distance` from the goal, from a cell with the longest and the
    /// shortest known way, with the factor of the generation.
    #[inline]
    pub(super) fn quality(&self, distance: f64, [longest, shortest]: [f64; 2], factor: f64) -> f64 {
        let nearness = 1.0 / distance.max(0.5);
        match self {
            Self::KnownLengths(rule) => {
                let saved = (longest - distance).max(0.0);
                rule.eta * saved / (1.0 + longest - shortest) * factor + nearness
            }
            Self::None => nearness,
        }
    }
}
