//! The planning problem: a map, a vehicle and a request, checked before anything is planned.

mod check;
mod curvature;
mod error;
mod goal_region;
mod goals;
mod moving;
mod request;
mod speed_zones;

pub use check::Scenario;
pub use curvature::{CurvatureMode, CurvatureRate};
pub use error::{Endpoint, ErrorCode, ScenarioError};
pub use goal_region::GoalRegion;
pub use goals::ReachedGoal;
pub use moving::{
    MovingError, MovingObstacle, ObstacleMotion, ObstacleShape, Predicted, Predictions,
    TimedWaypoint,
};
pub use request::{GoalHeading, GoalTolerance, Request, StartContact, StartHeading, ViaPoint};
pub use speed_zones::{SpeedZones, ZoneUnit};
