//! Pictures: scenes of maps and paths, strip charts, as SVG and (feature `png-pictures`) PNG.
//!
//! Renderers draw what they are handed and compute nothing about it: clearances, profiles and
//! limits come in as values. The same input gives the same bytes. Text is drawn as strokes, so
//! that no font is needed and a picture looks the same everywhere.

mod picture;
mod plan;

pub use picture::{Picture, RenderError};
pub use plan::{PlanPicture, ProfilePoint, plan_picture};
