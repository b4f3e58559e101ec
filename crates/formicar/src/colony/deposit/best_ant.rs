//! The best ant alone deposits (Stützle & Hoos 2000).

use super::{Generation, Memory, Portion, along, from_ant};
use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Q / F from the best ant of the iteration; every few iterations from the best so far instead.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct BestAnt {
    /// Q, from 1e-6 to 1e9.
    #[schemars(range(min = 1e-6, max = 1e9))]
    pub q: f64,
    /// Every so many iterations the best so far deposits; 1 for always, 0 for never, at most
    /// 1 000 000.
    #[schemars(range(min = 0, max = 1_000_000))]
    pub best_so_far_every: u32,
}

impl Default for BestAnt {
    fn default() -> Self {
        Self {
            q: 1.0,
            best_so_far_every: 5,
        }
    }
}

impl BestAnt {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        let every = f64::from(self.best_so_far_every);
        check_range("colony.deposit.best_so_far_every", every, 0.0..=1e6)
    }

    pub(super) fn deposits<'a>(
        &self,
        iteration: u32,
        generation: &'a Generation,
        memory: &'a Memory,
    ) -> Vec<Portion<'a>> {
        let every = self.best_so_far_every;
        let portion = if every > 0 && (iteration + 1).is_multiple_of(every) {
            along(memory.best(), self.q)
        } else {
            let best = generation.best();
            best.map(|ant| from_ant(generation, ant, self.q))
        };
        portion.into_iter().collect()
    }
}
