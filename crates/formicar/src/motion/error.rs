//! Why there is no speed plan.

use crate::parameters::OutOfRange;
use thiserror::Error;

/// A path that cannot be driven in time.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MotionError {
    /// A parameter outside its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// The vehicle is faster than the path allows where it begins.
    #[error(
        "present_speed_mps = {speed_mps}; it must be at most {limit_mps:.3} m/s here, by the limits and by the next stop; hint: slow down first, or begin the path farther ahead"
    )]
    TooFast {
        /// The speed at the beginning.
        speed_mps: f64,
        /// The fastest that is possible.
        limit_mps: f64,
    },
    /// Moving slowly where the jerk is bounded.
    #[error(
        "present_speed_mps = {speed_mps}; with a bounded jerk it must be 0 or at least {limit_mps} m/s; hint: leave the jerk out, or stop first"
    )]
    TooSlow {
        /// The speed at the beginning.
        speed_mps: f64,
        /// The least that is possible.
        limit_mps: f64,
    },
    /// Whatever the vehicle does on the path, an obstacle comes too near.
    #[error(
        "obstacle {obstacle} comes within {distance_m} m of the vehicle by {t_s:.2} s, wherever it is on the path by then; hint: ask for less distance, or plan another path"
    )]
    Unavoidable {
        /// The name of the obstacle.
        obstacle: String,
        /// The distance to be kept, meters.
        distance_m: f64,
        /// The time up to which the distance can be kept, seconds.
        t_s: f64,
    },
}
