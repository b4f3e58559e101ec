//! The objective of a tuning.

use super::TunedRun;
use serde::{Deserialize, Serialize};

/// The quantity that tuning minimizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// The cost of driving the path; with a weight, the steps to the first path too.
    Cost,
    /// The steps to the first path alone.
    Steps,
    /// The number of runs without a path alone.
    Success,
}

/// The objective of tuning: the geometric mean over runs of how many times dearer a run is than
/// the reference of its scenario.
///
/// A run with a certified path counts `(cost / reference)^a ((1 + steps) / (1 + reference))^b`,
/// where the cost is that of [`DriveCost::default`](formicar::objective::DriveCost), in meters,
/// whatever the planner itself improves, and the steps are those to the first certified path:
/// a = 1 and b the weight for [`Measure::Cost`], 0 and 1 for [`Measure::Steps`], 0 and 0 for
/// [`Measure::Success`]. It counts at most [`Objective::FAILURE`], which is what a run without a
/// path counts. The default itself is 1 wherever it always finds a path of the same cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Objective {
    /// The quantity that is measured.
    pub measure: Measure,
    /// b of [`Measure::Cost`], at least 0.
    pub steps_weight: f64,
}

/// The reference of a scenario: medians over the seeds of the default's runs that found a path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Reference {
    /// Meters.
    pub cost_m: f64,
    /// Steps.
    pub first_steps: f64,
}

impl Objective {
    /// The factor by which a run without a path is dearer.
    pub const FAILURE: f64 = 10.0;

    /// The logarithm of how many times dearer a run is than its reference.
    pub(super) fn log_ratio(&self, run: &TunedRun, reference: &Reference) -> f64 {
        let most = Self::FAILURE.ln();
        let (Some(cost_m), Some(first_steps)) = (run.cost_m, run.first_steps) else {
            return most;
        };
        let [a, b] = match self.measure {
            Measure::Cost => [1.0, self.steps_weight],
            Measure::Steps => [0.0, 1.0],
            Measure::Success => [0.0, 0.0],
        };
        let cost = (cost_m / reference.cost_m).ln();
        let steps = ((1.0 + first_steps as f64) / (1.0 + reference.first_steps)).ln();
        (a * cost + b * steps).min(most)
    }
}
