//! How close the poses of a sampled path lie.

use crate::parameters::parameters;

parameters! {
    /// The most by which neighbors of a sampled path may differ.
    ///
    /// A number of meters is a spacing that heeds lengths alone.
    ///
    /// ```
    /// use formicar::path::{Direction, Spacing};
    /// use formicar::{CurvePath, Pose2};
    ///
    /// let mut path = CurvePath::new(Pose2::default());
    /// path.push(20.0, 0.2, Direction::Forward);
    /// assert_eq!(path.sample(0.1).len(), 3);
    /// // 4 radians, a fifth of one at a time.
    /// assert_eq!(path.sample(Spacing::default()).len(), 21);
    /// ```
    #[derive(Copy)]
    pub struct Spacing {
        /// Driven length, meters.
        #[range(0.001..=1000.0)]
        pub max_m: f64 = 0.1,
        /// Change of heading, radians.
        #[range(0.001..=10.0)]
        pub max_turn_rad: f64 = 0.2,
    }
}

impl From<f64> for Spacing {
    fn from(max_m: f64) -> Self {
        Self {
            max_m,
            max_turn_rad: f64::INFINITY,
        }
    }
}
