//! Oblique steps first (Joshy & Supriya 2016, as Wang 2019 describes them).

use super::class::class;
use crate::parameters::Parameters;

/// Diagonal steps at less than 90 degrees to the direction of the goal come first: "prefers to
/// move forward obliquely" (Wang 2019, sec. 1, of Joshy & Supriya 2016).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ObliqueFirst {}

impl Parameters for ObliqueFirst {}

impl ObliqueFirst {
    pub(super) fn first_class(to_goal: (i64, i64)) -> u8 {
        class(to_goal, |step, progress| step % 2 == 1 && progress > 0)
    }
}
