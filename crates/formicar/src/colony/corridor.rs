//! On which cells ants may step.

use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// On which of the cells that allowed steps lead to ants may step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "rule", rename_all = "kebab-case")]
pub enum Corridor {
    /// All of them.
    #[default]
    None,
    /// Those near the shortest ways.
    Ratio(RatioCorridor),
}

/// The cells with D + S <= `ratio` L: with the lengths D and S of the shortest ways from the start
/// and to the goal, and that of the shortest way from start to goal, L.
///
/// Time and memory of a colony are in proportion to the cells of its corridor. A way of the
/// colony's may be longer than `ratio` L, as long as each of its cells lies on one that is not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RatioCorridor {
    /// Length of the ways that the corridor holds, in shortest ways, from 1 to 10.
    #[schemars(range(min = 1.0, max = 10.0))]
    pub ratio: f64,
    /// The most that a step of length c may lose, c + S' - S cells, from 0 to 64; no step between
    /// neighbors loses more than 2.83. Below 1 every such step leads nearer to the goal, and no
    /// ant gets stuck.
    #[schemars(range(min = 0.0, max = 64.0))]
    pub step_loss_cells: f64,
}

impl Default for RatioCorridor {
    fn default() -> Self {
        Self {
            ratio: 1.1,
            step_loss_cells: 3.0,
        }
    }
}

impl Corridor {
    pub(in crate::colony) fn check(&self) -> Result<(), OutOfRange> {
        match self {
            Self::None => Ok(()),
            Self::Ratio(rule) => {
                check_range("colony.corridor.ratio", rule.ratio, 1.0..=10.0)?;
                let loss = rule.step_loss_cells;
                check_range("colony.corridor.step_loss_cells", loss, 0.0..=64.0)
            }
        }
    }
}
