//! A planner of a user's own, through the same door.

use super::{Case, case, found};
use formicar::geometry::{Arc, Pose2};
use formicar::numeric::Seed;
use formicar::planner::{
    Abilities, Ended, Found, Halt, Outcome, PathSearch, PlanError, Planner, PlannerName, Stages,
    Task, Vehicles,
};
use formicar::progress::{Limits, Status};
use formicar::scenario::{Request, ViaPoint};
use formicar::vehicle::Gears;
use formicar::vehicle::Vehicle;
use std::sync;

/// Drives straight ahead, as far as the goal is away.
#[derive(Debug)]
struct Ahead;

impl PathSearch for Ahead {
    fn name(&self) -> &'static str {
        "ahead"
    }

    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
        limits.step()?;
        let (start, goal) = (task.request().start, task.request().goal);
        let length_m = start.position().distance(goal.position());
        if task.request().gears == Gears::Forward && length_m > 100.0 {
            let reason = "too far ahead".to_owned();
            return Err(Ended::because(Status::NoPath, reason, Stages::default()).into());
        }
        Ok(task.driven(task.to_grid(start), &[Arc::new(0.0, length_m)]))
    }

    fn abilities(&self) -> Abilities {
        Abilities {
            vehicles: Vehicles::Cars,
            ..Abilities::default()
        }
    }
}

/// A yard with a wall ahead of the start, and requests on it.
fn yard() -> Case {
    case(PlannerName::Faco2024)
}

fn planner() -> Planner {
    let Case { map, vehicle, .. } = yard();
    Planner::with_search(&map, vehicle, sync::Arc::new(Ahead))
}

fn plan(request: &Request) -> Outcome {
    let outcome = planner().plan(request, Seed(1), &mut ());
    outcome.expect("a valid request")
}

#[test]
fn its_path_gets_certificate_metrics_and_its_name() {
    let free = Request::new(Pose2::new(3.1, 2.1, 0.0), Pose2::new(19.1, 2.1, 0.0));
    let plan = found(plan(&free));
    assert_eq!((plan.planner.as_str(), plan.n_steps), ("ahead", 1));
    assert!((plan.metrics.length_m - 16.0).abs() < 1e-9);
    assert!(plan.certificate.valid);
    assert!(planner().config().is_none());
}

#[test]
fn a_path_that_collides_is_refused_by_the_judge() {
    let Outcome::NotFound(failure) = plan(&yard().request) else {
        panic!("a path through the wall");
    };
    assert_eq!(failure.status, Status::Infeasible);
    let expected = "the judge refused the path that ahead found";
    assert!(failure.reason.starts_with(expected), "{}", failure.reason);
    let (_, report) = failure.refused.expect("the refused path");
    assert!(!report.valid);
}

#[test]
fn the_door_plans_its_legs_and_goals_and_keeps_its_limits() {
    let mut request = Request::new(Pose2::new(3.1, 2.1, 0.0), Pose2::new(19.1, 2.1, 0.0));
    request.via = vec![ViaPoint::new(Pose2::new(9.1, 2.1, 0.0).position())];
    assert_eq!(found(plan(&request)).n_steps, 2);
    request.via.clear();
    request.other_goals = vec![Pose2::new(9.1, 2.1, 0.0)];
    let plan_to_nearest = found(plan(&request));
    assert_eq!(plan_to_nearest.certificate.goal_index, Some(1));
    request.budget_steps = Some(0);
    assert_eq!(plan(&request).status(), Status::BudgetExhausted);
}

#[test]
fn its_own_reasons_and_refusals_are_handed_on() {
    let wide = formicar::map::OccupancyGrid::from_rows(&[&".".repeat(600)[..]; 20], 0.2);
    let wide = wide.expect("rows");
    let search = sync::Arc::new(Ahead);
    let mut planner = Planner::with_search(&wide, Vehicle::lei2020(), search.clone());
    let request = Request {
        gears: Gears::Forward,
        ..Request::new(Pose2::new(3.1, 2.1, 0.0), Pose2::new(110.1, 2.1, 0.0))
    };
    let outcome = planner.plan(&request, Seed(1), &mut ());
    let Ok(Outcome::NotFound(failure)) = outcome else {
        panic!("{outcome:?}")
    };
    assert_eq!(failure.reason, "too far ahead");
    let mut planner = Planner::with_search(&wide, Vehicle::point(), search);
    let refused = planner.plan(&request, Seed(1), &mut ());
    assert!(matches!(refused, Err(PlanError::NeedsACar { planner }) if planner == "ahead"));
    let previous = formicar::path::CurvePath::from_arcs(request.start, &[]);
    let refused = planner.replan(&request, &previous, Seed(1), &mut ());
    assert!(matches!(refused, Err(PlanError::CannotReplan { planner }) if planner == "ahead"));
}
