//! The front end: each scan is matched with the newest submap, and key scans build it.

mod build;
mod quality;
mod submap;
mod track;

pub use build::{FrontEnd, Node, SavedFrontEnd, ScanPlace};
pub use quality::{Quality, ScanMatch};
pub use submap::{GrowingSubmap, Submap};
pub use track::Track;
pub(crate) use track::{TrackMap, is_degenerate};
