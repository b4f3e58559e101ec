//! Parameters of the model-predictive controller.

use crate::parameters::parameters;

parameters! {
    /// A model-predictive controller of the kinematic bicycle: over a horizon it finds the
    /// accelerations and steering rates that keep nearest to the timed path within the limits, and
    /// drives the first of them.
    #[derive(Copy)]
    pub struct MpcParameters {
        /// Steps of the horizon.
        #[range(2..=100)]
        pub n_steps: u32 = 20,
        /// Duration of a step, seconds.
        #[range(0.005..=0.5)]
        pub step_s: f64 = 0.05,
        /// Weight of the error along the path, 1/m^2.
        #[range(0.0..=1e6)]
        pub along_weight: f64 = 4.0,
        /// Weight of the error across the path, 1/m^2.
        #[range(0.0..=1e6)]
        pub across_weight: f64 = 100.0,
        /// Weight of the heading error, 1/rad^2.
        #[range(0.0..=1e6)]
        pub heading_weight: f64 = 20.0,
        /// Weight of the error of the speed, s^2/m^2.
        #[range(0.0..=1e6)]
        pub speed_weight: f64 = 1.0,
        /// Weight of the error of the steering angle, 1/rad^2.
        #[range(0.0..=1e6)]
        pub steer_weight: f64 = 0.5,
        /// Weight of the acceleration, s^4/m^2.
        #[range(1e-6..=1e6)]
        pub acceleration_weight: f64 = 0.05,
        /// Weight of the steering rate, s^2/rad^2.
        #[range(1e-6..=1e6)]
        pub steer_rate_weight: f64 = 0.02,
    }
}
