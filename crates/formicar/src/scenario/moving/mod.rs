//! Things that move, and where they are predicted to be.

mod check;
mod error;
mod obstacle;
mod predictions;

pub use error::MovingError;
pub use obstacle::{MovingObstacle, ObstacleMotion, ObstacleShape, TimedWaypoint};
pub use predictions::{Predicted, Predictions};
