//! The best so far deposits once more, for many (Dorigo, Maniezzo & Colorni 1996).

use super::{Generation, Memory};
use super::{Portion, all, along};
use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Q / F from every ant that arrived, and e Q / F along the best way so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Elitist {
    /// Q, from 1e-6 to 1e9.
    #[schemars(range(min = 1e-6, max = 1e9))]
    pub q: f64,
    /// e as a share of the ants of the iteration, from 0 to 10.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub elite_share: f64,
}

impl Default for Elitist {
    fn default() -> Self {
        Self {
            q: 100.0,
            elite_share: 0.1,
        }
    }
}

impl Elitist {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        check_range("colony.deposit.elite_share", self.elite_share, 0.0..=10.0)
    }

    pub(super) fn deposits<'a>(
        &self,
        generation: &'a Generation,
        memory: &'a Memory,
    ) -> Vec<Portion<'a>> {
        let n_elite = self.elite_share * generation.n_ants() as f64;
        let mut portions = all(generation, self.q);
        portions.extend(along(memory.best(), n_elite * self.q));
        portions
    }
}
