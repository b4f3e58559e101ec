//! What users hold may be sent to other threads and shared between them.

use formicar::planner::{Answer, NotFound, PathSearch, PlanError};
use formicar::progress::{CancelToken, StdClock};
use formicar::{
    OccupancyGrid, Outcome, Plan, Planner, PlannerConfig, Request, Scenario, Seed, Status, Vehicle,
};

fn is_send_and_sync<T: Send + Sync + ?Sized>() {}

#[test]
fn types_of_the_door_are_send_and_sync() {
    is_send_and_sync::<OccupancyGrid>();
    is_send_and_sync::<Vehicle>();
    is_send_and_sync::<Scenario>();
    is_send_and_sync::<Request>();
    is_send_and_sync::<Planner>();
    is_send_and_sync::<PlannerConfig>();
    is_send_and_sync::<dyn PathSearch>();
    is_send_and_sync::<Outcome>();
    is_send_and_sync::<Plan>();
    is_send_and_sync::<NotFound>();
    is_send_and_sync::<PlanError>();
    is_send_and_sync::<Answer>();
    is_send_and_sync::<CancelToken>();
    is_send_and_sync::<StdClock>();
    is_send_and_sync::<(Seed, Status)>();
}
