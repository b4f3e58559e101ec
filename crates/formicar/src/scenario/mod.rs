//! The planning problem: a map, a vehicle and a request, checked before anything is planned.

mod check;
mod curvature;
mod error;
mod goal_region;
mod goals;
mod request;

pub use check::Scenario;
pub use curvature::{CurvatureMode, CurvatureRate};
pub use error::{Endpoint, ErrorCode, ScenarioError};
pub use goal_region::GoalRegion;
pub use goals::ReachedGoal;
pub use request::{GoalHeading, GoalTolerance, Request, StartContact, StartHeading, ViaPoint};
