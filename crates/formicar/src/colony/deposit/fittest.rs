//! The better ones among the ants that arrived deposit.

use super::{Generation, Portion, from_ant};
use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Q / F from the cheapest share of the ants that arrived, at least one.
///
/// It stands for "the survival of the fittest" of Zhang 2016, which Wang 2019 names and does not
/// write down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Fittest {
    /// Q, from 1e-6 to 1e9.
    #[schemars(range(min = 1e-6, max = 1e9))]
    pub q: f64,
    /// Share of the ants that arrived, from 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub share: f64,
}

impl Default for Fittest {
    fn default() -> Self {
        Self {
            q: 100.0,
            share: 0.5,
        }
    }
}

impl Fittest {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        check_range("colony.deposit.share", self.share, 0.0..=1.0)
    }

    pub(super) fn deposits<'a>(&self, generation: &'a Generation) -> Vec<Portion<'a>> {
        let cost = |ant: usize| generation.cost(ant).cost;
        let mut fit: Vec<usize> = generation.arrived().collect();
        fit.sort_by(|&a, &b| cost(a).total_cmp(&cost(b)).then(a.cmp(&b)));
        let n_fit = (self.share * fit.len() as f64).ceil().max(1.0) as usize;
        fit.truncate(n_fit);
        // In the ants' order, as everywhere.
        fit.sort_unstable();
        let ants = fit.into_iter();
        ants.map(|ant| from_ant(generation, ant, self.q)).collect()
    }
}
