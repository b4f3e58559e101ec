//! Flags for the gears and headings of a request.

use crate::values;
use clap::Args;
use formicar::scenario::{GoalHeading, StartHeading};
use formicar::vehicle::Gears;

/// Flags for the gears and headings of a request; the library supplies the defaults.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(crate) struct ModeArgs {
    /// Gears to use; `reverse` allows both and penalizes reverse.
    #[arg(long, value_name = "MODE",
          value_parser = values::word::<Gears>(&["forward", "reverse"]))]
    pub(crate) motion: Option<Gears>,

    /// Start with exactly the given heading, or with any.
    #[arg(long, value_name = "MODE",
          value_parser = values::word::<StartHeading>(&["exact", "any"]))]
    pub(crate) start_heading: Option<StartHeading>,

    /// Arrive with exactly the given heading, with it or the opposite one, or with any.
    #[arg(long, value_name = "MODE",
          value_parser = values::word::<GoalHeading>(&["exact", "bidirectional", "any"]))]
    pub(crate) goal_heading: Option<GoalHeading>,
}
