//! Food sources.

/// A place in the unit cube of a space, and what it costs.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Source {
    /// A coordinate in 0 to 1 for each dimension.
    pub position: Vec<f64>,
    /// Its cost.
    pub cost: f64,
    /// Trials beside it in a row that gained nothing.
    pub n_trials: u64,
}

impl Source {
    /// Karaboga & Basturk 2007 (2.3, in the form for costs of either sign): `1 / (1 + f)` of a cost
    /// f from 0 on, `1 + |f|` of one below.
    pub(super) fn fitness(&self) -> f64 {
        if self.cost >= 0.0 {
            1.0 / (1.0 + self.cost)
        } else {
            1.0 - self.cost
        }
    }
}
