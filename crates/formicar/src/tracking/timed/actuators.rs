//! What the motors do with a command.

use crate::parameters::parameters;

parameters! {
    /// The actuators of a vehicle that is driven in time; the steering rate stands beside them in
    /// the configuration.
    #[derive(Copy)]
    pub struct Actuators {
        /// Time until a command takes effect, seconds.
        #[range(0.0..=1.0)]
        pub delay_s: f64 = 0.0,
        /// Largest acceleration, m/s^2; that of the vehicle where left out, or 1.
        #[range(0.01..=100.0)]
        pub max_acceleration_mps2: Option<f64> = None,
        /// Largest deceleration, m/s^2; twice the acceleration where left out, since a controller
        /// needs some to correct with.
        #[range(0.01..=100.0)]
        pub max_braking_mps2: Option<f64> = None,
        /// Time between two commands, seconds.
        #[range(0.001..=0.2)]
        pub control_period_s: f64 = 0.02,
    }
}

impl Actuators {
    /// True for those of every vehicle, which documents leave out.
    #[cfg(feature = "serde")]
    pub(in crate::tracking) fn is_usual(&self) -> bool {
        *self == Self::default()
    }
}
