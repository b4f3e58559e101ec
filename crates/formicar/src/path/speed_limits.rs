//! The limits within which a vehicle may drive a path.

use crate::parameters::parameters;
use crate::vehicle::Vehicle;

parameters! {
    /// Limits of speed, acceleration and steering rate.
    pub struct SpeedLimits {
        /// Top speed in both gears, meters per second.
        #[range(0.001..=100.0)]
        pub max_speed_mps: f64 = 1.0,
        /// Largest lateral acceleration, m/s^2; default 2, as in a calmly driven car.
        #[range(0.01..=100.0)]
        pub max_lateral_mps2: f64 = 2.0,
        /// Largest acceleration along the path, m/s^2; default 1.
        #[range(0.01..=100.0)]
        pub max_acceleration_mps2: f64 = 1.0,
        /// Largest deceleration, m/s^2; as the acceleration where left out.
        #[range(0.01..=100.0)]
        pub max_braking_mps2: Option<f64> = None,
        /// Fastest change of the steering angle, radians per second; unbounded where left out.
        #[range(0.001..=100.0)]
        pub max_steer_rate_rad_per_s: Option<f64> = None,
        /// Fastest change of the acceleration, m/s^3; unbounded where left out.
        #[range(0.01..=1000.0)]
        pub max_jerk_mps3: Option<f64> = None,
    }
}

impl SpeedLimits {
    /// The limits of a vehicle that says how fast it drives; none of the others.
    pub fn of(vehicle: &Vehicle) -> Option<Self> {
        let parameters = vehicle.parameters();
        let usual = Self::default();
        Some(Self {
            max_speed_mps: parameters.speed_mps?,
            max_acceleration_mps2: parameters
                .max_acceleration_mps2
                .unwrap_or(usual.max_acceleration_mps2),
            max_steer_rate_rad_per_s: parameters.max_steer_rate_rad_per_s,
            ..usual
        })
    }

    /// Largest deceleration, m/s^2.
    pub fn braking_mps2(&self) -> f64 {
        self.max_braking_mps2.unwrap_or(self.max_acceleration_mps2)
    }
}
