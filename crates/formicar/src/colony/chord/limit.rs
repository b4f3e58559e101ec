//! The steering limit of an ant's vehicle.

use crate::parameters::{parameters, rules};
use crate::vehicle::SuspensionParameters;

rules! {
    /// `phi_c`: the steering that the vehicle can give where an ant is.
    pub enum SteeringLimit {
        /// The limit under the suspension on the ant's path (Li 2024, sec. 3).
        Dynamic(DynamicLimit),
        /// That of the rigid vehicle.
        Rigid,
    }
}

parameters! {
    /// The suspension.
    #[derive(Default)]
    pub struct DynamicLimit {
        /// Its parameters.
        pub suspension: SuspensionParameters,
    }
}

impl SteeringLimit {
    /// The suspension; a rigid one where the limit is fixed.
    pub fn suspension(&self) -> SuspensionParameters {
        match self {
            Self::Dynamic(rule) => rule.suspension.clone(),
            Self::Rigid => SuspensionParameters::rigid(),
        }
    }
}
