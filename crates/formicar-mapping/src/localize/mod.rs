//! The robot found in a finished map: tracking, global start, and `lost` instead of a guess.

mod localizer;
mod map;
mod start;

pub use localizer::{Localizer, Located};
pub use map::{LocalizationMap, grid_distances};
pub use start::first_pose;
