//! Planners that drive: the race on any number of threads, and what a request may ask of a pose.

use super::{Case, case, found, plan_with};
use formicar::geometry::Pose2;
use formicar::map::builtin;
use formicar::numeric::Seed;
use formicar::planner::{Planner, PlannerConfig, PlannerName};
use formicar::scenario::{GoalHeading, GoalTolerance, Request, StartHeading};
use formicar::vehicle::{Gears, Vehicle};

/// Where ants win the race, are improved, and a budget may end it: in any phase the same.
fn the_number_of_threads_changes_no_race(map: &str, request: usize) {
    let builtin = builtin::BuiltinMap::by_name(map).expect("a built-in map");
    let vehicle = Vehicle::preset(builtin.vehicle).expect("a preset");
    let ends = &builtin.requests[request];
    for budget_steps in [None, Some(900), Some(5000)] {
        for gears in [Gears::Both, Gears::Forward] {
            let request = Request {
                budget_steps,
                gears,
                ..Request::new(ends.start, ends.goal)
            };
            let config = PlannerConfig::of(PlannerName::Formicar);
            let plan = |n_threads: usize| {
                let planner = Planner::new(&builtin.grid(), vehicle.clone(), config.clone());
                let mut planner = planner.expect("parameters").with_threads(n_threads);
                let outcome = planner.plan(&request, Seed(3), &mut ()).expect("a request");
                let path = outcome.judged().map(|(path, _)| path.clone());
                (outcome.status(), outcome.n_steps(), path)
            };
            let one = plan(1);
            assert_eq!(one, plan(2), "{map} {budget_steps:?}");
            assert_eq!(one, plan(7), "{map} {budget_steps:?}");
        }
    }
}

#[test]
fn threads_change_no_race_in_the_neighborhood() {
    the_number_of_threads_changes_no_race("li-neighborhood", 0);
}

#[test]
fn threads_change_no_race_from_the_dock() {
    the_number_of_threads_changes_no_race("warehouse", 0);
}

#[test]
fn threads_change_no_race_to_packing() {
    the_number_of_threads_changes_no_race("warehouse", 1);
}

#[test]
fn heading_modes_gears_and_tolerances_hold() {
    let Case {
        map,
        vehicle,
        request,
    } = case(PlannerName::HybridAstar);
    let case = Case {
        map,
        vehicle,
        request,
    };
    let ask = |request: Request| {
        found(plan_with(
            PlannerName::HybridAstar,
            &case,
            &request,
            &mut (),
        ))
    };
    let forward = ask(Request {
        gears: Gears::Forward,
        ..case.request.clone()
    });
    assert_eq!(forward.metrics.reverse_length_m, 0.0);
    let exact = ask(case.request.clone()).metrics.length_m;
    let any = Request {
        start_heading: StartHeading::Any,
        goal_heading: GoalHeading::Any,
        ..case.request.clone()
    };
    assert!(ask(any).metrics.length_m < 1.1 * exact);
    let turned = Pose2::at(
        case.request.goal.position(),
        case.request.goal.heading + std::f64::consts::PI,
    );
    let both_ways = Request {
        goal: turned,
        goal_heading: GoalHeading::Bidirectional,
        ..case.request.clone()
    };
    assert!(ask(both_ways).metrics.length_m < 1.1 * exact);
    let wide = GoalTolerance {
        xy_m: 0.5,
        yaw_rad: 0.3,
    };
    let near = ask(Request {
        goal_tolerance: wide,
        ..case.request.clone()
    });
    assert!(near.certificate.goal_error_m <= 0.5 && near.certificate.goal_error_rad <= 0.3);
}
