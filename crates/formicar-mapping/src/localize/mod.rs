//! The robot found in a finished map: tracking, global start, and `lost` instead of a guess.

mod localizer;
mod map;

pub use localizer::{Localizer, Located};
pub use map::{LocalizationMap, grid_distances};
