//! Maps and poses from a seed: the same parameters and seed give the same cells.

mod free_poses;
mod main_component;
mod neighborhood;
mod parameters;
mod scatter;

pub use free_poses::free_pose_pairs;
pub use neighborhood::alley_neighborhood;
pub use parameters::{NeighborhoodParameters, ScatterParameters};
pub use scatter::scattered_obstacles;

use super::MapError;
use crate::parameters::OutOfRange;
use thiserror::Error;

/// The reason why a map or poses cannot be generated.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GenerateError {
    /// A parameter outside its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// Two parameters in the wrong order.
    #[error("{low_name} = {low} is above {high_name} = {high}; hint: exchange them")]
    Reversed {
        /// The parameter that should be lower.
        low_name: &'static str,
        /// Its value.
        low: f64,
        /// The parameter that should be higher.
        high_name: &'static str,
        /// Its value.
        high: f64,
    },
    /// A map too small for what it should hold.
    #[error(
        "the map is {width_m} x {height_m} m; at least {min_m} x {min_m} m are needed; hint: more cells or a coarser resolution"
    )]
    TooSmall {
        /// Width, meters.
        width_m: f64,
        /// Height, meters.
        height_m: f64,
        /// Least width and height, meters.
        min_m: f64,
    },
    /// The frame is no map.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The vehicle found too few places to stand.
    #[error(
        "found {n_found} of {n_wanted} pairs of free poses after {n_tries} tries for one pose; hint: fewer pairs, a smaller vehicle, or a map with wider ways"
    )]
    NoFreePoses {
        /// Pairs found.
        n_found: usize,
        /// Pairs asked for.
        n_wanted: usize,
        /// Poses tried in vain.
        n_tries: usize,
    },
}
