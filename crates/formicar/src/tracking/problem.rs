//! Errors of simulated drives.

use crate::parameters::OutOfRange;
use thiserror::Error;

/// An error in a path, a vehicle or a configuration for a simulated drive.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TrackingError {
    /// A parameter outside its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// A vehicle without wheels to turn.
    #[error("the vehicle is a point; a drive is simulated for cars")]
    NeedsACar,
    /// A vehicle whose steering angles are unknown.
    #[error("the vehicle's wheelbase is unknown; hint: give wheelbase_m beside the footprint")]
    NeedsAWheelbase,
    /// A path with a number that is none, or a length that is negative.
    #[error(
        "segment {index} of the path has a number that is not finite, or a length below 0; hint: `check` tells what is wrong with a path"
    )]
    NotFinite {
        /// Place of the segment.
        index: usize,
    },
    /// A path that jumps.
    #[error(
        "the path jumps by {gap_m} m to segment {index}; at most {limit_m} m are allowed; hint: `check` tells what is wrong with a path"
    )]
    Gap {
        /// Place of the segment after the jump.
        index: usize,
        /// The length of the jump, meters.
        gap_m: f64,
        /// The most that is allowed, meters.
        limit_m: f64,
    },
    /// A controller that needs a timed path, in a drive at one speed.
    #[error("{controller} drives in time; hint: give it a timed path (--speed-plan)")]
    NeedsTime {
        /// Its name.
        controller: &'static str,
    },
    /// The model-predictive controller of a library without it.
    #[error("mpc is not compiled in; hint: enable the feature `mpc` of formicar")]
    NotCompiledIn,
    /// A drive of too many steps.
    #[error(
        "the drive takes up to {n_steps:.0} steps, at most {limit:.0} are simulated; hint: raise time_step_s or speed_mps, or cut the path"
    )]
    TooLong {
        /// Steps that it may take.
        n_steps: f64,
        /// The most that are simulated.
        limit: f64,
    },
}
