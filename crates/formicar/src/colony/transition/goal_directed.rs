//! Steps towards the goal first (Lei & Zheng 2020).

use super::class::class;
use crate::parameters::Parameters;

/// Steps at no more than 90 degrees to the direction of the goal come first, the others only where
/// none of those is left: Lei & Zheng 2020, sec. II.F, figure 6.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct GoalDirected {}

impl Parameters for GoalDirected {}

impl GoalDirected {
    pub(super) fn first_class(to_goal: (i64, i64)) -> u8 {
        class(to_goal, |_, progress| progress >= 0)
    }
}
