//! Planners over cells: shortest paths agree, and cars drive what they find or are told why not.

use super::{Case, found, plan_with};
use formicar::map::builtin;
use formicar::planner::{Outcome, PlannerName};
use formicar::progress::Status;
use formicar::scenario::{GoalHeading, Request, StartHeading};
use formicar::smoothing::{CornerRecord, Rounding};
use formicar::vehicle::Vehicle;

#[test]
fn no_grid_planner_beats_another_on_its_own_map() {
    for name in [
        "lei-map1",
        "lei-map2",
        "lei-map3",
        "wang-aisles",
        "wang-open",
        "aco20",
    ] {
        let builtin = builtin::BuiltinMap::by_name(name).expect("a built-in map");
        let ends = &builtin.requests[0];
        let case = Case {
            map: builtin.grid(),
            vehicle: Vehicle::point(),
            request: Request::new(ends.start, ends.goal),
        };
        let lengths = [PlannerName::Astar, PlannerName::Dijkstra].map(|planner| {
            found(plan_with(planner, &case, &case.request, &mut ()))
                .metrics
                .length_m
        });
        assert!(
            (lengths[0] - lengths[1]).abs() < 1e-9,
            "{name}: {lengths:?}"
        );
    }
}

/// The 3 m car of the paper on a built-in map, headings free.
fn driven(map: &str, planner: PlannerName) -> Outcome {
    let builtin = builtin::BuiltinMap::by_name(map).expect("a built-in map");
    let ends = &builtin.requests[0];
    let request = Request {
        start_heading: StartHeading::Any,
        goal_heading: GoalHeading::Any,
        ..Request::new(ends.start, ends.goal)
    };
    let case = Case {
        map: builtin.grid(),
        vehicle: Vehicle::lei2020(),
        request,
    };
    plan_with(planner, &case, &case.request, &mut ())
}

#[test]
fn planners_over_cells_drive_cars_around_rounded_corners() {
    for (map, planner) in [
        ("lei-map3", PlannerName::Dijkstra),
        ("lei-map3", PlannerName::ImprovedAstar),
        ("lei-map3", PlannerName::Aga),
    ] {
        let plan = found(driven(map, planner));
        let stages = &plan.stages;
        assert!(stages.nodes.len() > 2, "{planner:?}");
        assert!(!stages.corners.is_empty(), "{planner:?}");
        let is_rounded = |corner: &CornerRecord| corner.rounding != Rounding::None;
        assert!(stages.corners.iter().all(is_rounded), "{planner:?}");
        assert_eq!(stages.evolution.is_some(), planner == PlannerName::Aga);
    }
}

#[test]
fn what_a_planner_over_cells_cannot_give_a_car_is_named() {
    for (map, planner, status, words) in [
        (
            "lei-map2",
            PlannerName::Astar,
            Status::Infeasible,
            ["astar found a way of 56 cells", "hint: hybrid-astar"],
        ),
        (
            "lei-map3",
            PlannerName::Ga,
            Status::NoPath,
            ["free of collisions", "evolution.n_via_max"],
        ),
    ] {
        let Outcome::NotFound(failure) = driven(map, planner) else {
            panic!("{planner:?} found a path on {map}")
        };
        assert_eq!(failure.status, status, "{planner:?}");
        for word in words {
            assert!(failure.reason.contains(word), "{}", failure.reason);
        }
    }
}
