//! The steering limit of an ant's vehicle.

use crate::numeric::OutOfRange;
use crate::vehicle::SuspensionParameters;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// `phi_c`: the steering that the vehicle can give where an ant is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "rule", rename_all = "kebab-case")]
pub enum SteeringLimit {
    /// What the suspension leaves of it on the ant's way (Li 2024, sec. 3).
    Dynamic(DynamicLimit),
    /// That of the rigid vehicle.
    Rigid,
}

/// How the suspension gives way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DynamicLimit {
    /// Its parameters.
    pub suspension: SuspensionParameters,
}

impl SteeringLimit {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        self.suspension().check()
    }

    /// The suspension; a rigid one where the limit is fixed.
    pub fn suspension(&self) -> SuspensionParameters {
        match self {
            Self::Dynamic(rule) => rule.suspension.clone(),
            Self::Rigid => SuspensionParameters::rigid(),
        }
    }
}
